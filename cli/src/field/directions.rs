//! Which faces have their direction given: the flags of every command that computes a field.

use roundel::mesh::TriangleMesh;
use roundel::quad::{Constraint, curvature_constraints};

/// Directions by curvature and by number of face.
#[derive(clap::Args)]
pub struct Directions {
    /// Give this part of the faces, those with the most reliable curvature, the direction of least
    /// curvature; from 0 to 1
    #[arg(long, value_name = "FRACTION", default_value_t = 0.1, value_parser = fraction)]
    #[arg(allow_negative_numbers = true)]
    pub constrain_curvature: f64,

    /// Give this face this direction, in degrees counter-clockwise from its first edge; may be
    /// repeated, and comes before curvature
    #[arg(long, value_name = "FACE:DEGREES", value_parser = constraint)]
    pub fix: Vec<Constraint>,
}

impl Directions {
    /// The directions given on the command line, and those of curvature for other faces.
    pub fn constraints(&self, mesh: &TriangleMesh) -> roundel::Result<Vec<Constraint>> {
        let mut constraints = self.fix.clone();
        let mut free = vec![true; mesh.face_count()];
        for given in &constraints {
            if let Some(free) = free.get_mut(given.face) {
                *free = false;
            }
        }
        let mut curved = curvature_constraints(mesh, self.constrain_curvature)?;
        curved.retain(|c| free[c.face]);
        constraints.extend(curved);
        Ok(constraints)
    }
}

fn fraction(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number")?;
    match (0.0..=1.0).contains(&value) {
        true => Ok(value),
        false => Err("outside [0, 1]".into()),
    }
}

fn constraint(text: &str) -> Result<Constraint, String> {
    let (face, degrees) = text.split_once(':').ok_or("not FACE:DEGREES")?;
    let face = face
        .parse()
        .map_err(|_| "FACE is not the number of a face")?;
    let degrees: f64 = degrees.parse().map_err(|_| "DEGREES is not a number")?;
    match degrees.is_finite() {
        true => Ok(Constraint {
            face,
            angle: degrees.to_radians(),
        }),
        false => Err("DEGREES is not finite".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{constraint, fraction};

    #[test]
    fn a_direction_is_a_face_and_finite_degrees() {
        let given = constraint("7:-90").unwrap();
        assert_eq!((given.face, given.angle), (7, -std::f64::consts::FRAC_PI_2));
        for text in [
            "", "7", "7:", ":3", "-1:3", "1.5:3", "7:nan", "7:inf", "7:3:4",
        ] {
            assert!(constraint(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_fraction_is_at_most_one() {
        assert_eq!((fraction("0"), fraction("1")), (Ok(0.0), Ok(1.0)));
        for text in ["-0.1", "1.01", "nan", "a tenth", ""] {
            assert!(fraction(text).is_err(), "{text}");
        }
    }
}
