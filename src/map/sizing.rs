//! The size of the quads of a map.

use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;

/// The size of quads, as a number of them or as lengths of their edges in units of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub enum Sizing {
    /// As many squares as this cover the surface.
    Quads(usize),
    /// Edges of this length.
    EdgeLength(f64),
    /// Edges of these lengths in every face: along the arm that the field stores (its angle), and
    /// across it.
    Lengths(Vec<[f64; 2]>),
    /// As many quads as this, whose edges have lengths in these proportions in every face.
    Graded {
        /// How many.
        quads: usize,
        /// A length for every face, in any unit.
        lengths: Vec<f64>,
    },
}

impl Sizing {
    /// # Errors
    /// As [`Density::new`].
    pub(crate) fn check(&self, mesh: &TriangleMesh) -> Result<()> {
        Density::new(mesh, self).map(drop)
    }

    /// The number of quads, where one is asked for.
    pub fn quads(&self) -> Option<usize> {
        match self {
            Sizing::Quads(quads) | Sizing::Graded { quads, .. } => Some(*quads),
            Sizing::EdgeLength(_) | Sizing::Lengths(_) => None,
        }
    }

    /// The same sizes with another number of quads, where one is asked for.
    pub(crate) fn with_quads(&self, quads: usize) -> Self {
        match self {
            Sizing::Quads(_) => Sizing::Quads(quads),
            Sizing::Graded { lengths, .. } => Sizing::Graded {
                quads,
                lengths: lengths.clone(),
            },
            other => other.clone(),
        }
    }

    /// The same sizes on a mesh whose face k is, or is a part of, face `origins[k]`.
    pub(crate) fn on_faces(&self, origins: &[u32]) -> Self {
        match self {
            Sizing::Lengths(lengths) => {
                Sizing::Lengths(origins.iter().map(|&f| lengths[f as usize]).collect())
            }
            Sizing::Graded { quads, lengths } => Sizing::Graded {
                quads: *quads,
                lengths: origins.iter().map(|&f| lengths[f as usize]).collect(),
            },
            other => other.clone(),
        }
    }

    /// The lengths at every vertex, where they are graded: the mean of the faces around it. Else none.
    pub(crate) fn vertex_lengths(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let Sizing::Graded { lengths, .. } = self else {
            return Vec::new();
        };
        let mean = |v: usize| {
            let ring = mesh.ring(v);
            let count = ring.len() as f64;
            ring.map(|(face, _)| lengths[face]).sum::<f64>() / count
        };
        (0..mesh.vertex_count()).map(mean).collect()
    }

    /// The length of an edge of quads at every vertex, in units of the mesh: the mean of the faces around it.
    ///
    /// # Errors
    /// As [`Density::new`].
    pub(crate) fn lengths_at_vertices(&self, mesh: &TriangleMesh) -> Result<Vec<f64>> {
        let faces = match Density::new(mesh, self)? {
            Density::Uniform(density) => return Ok(vec![1.0 / density; mesh.vertex_count()]),
            Density::Faces(faces) => faces,
        };
        let mean = |v: usize| {
            let ring = mesh.ring(v);
            let count = ring.len() as f64;
            let lengths = ring.map(|(face, _)| 1.0 / (faces[face][0] * faces[face][1]).sqrt());
            lengths.sum::<f64>() / count
        };
        Ok((0..mesh.vertex_count()).map(mean).collect())
    }

    /// The length of an edge of quads, in units of the mesh; where faces have their own, the mean.
    pub fn edge_length(&self, mesh: &TriangleMesh) -> f64 {
        let area = mesh.surface_area();
        match self {
            Sizing::Quads(quads) | Sizing::Graded { quads, .. } => {
                (area / (*quads).max(1) as f64).sqrt()
            }
            Sizing::EdgeLength(length) => *length,
            Sizing::Lengths(lengths) => {
                let of_face = |(face, [along, across]): (usize, &[f64; 2])| {
                    0.5 * mesh.area(face) * (along + across)
                };
                let faces = lengths.iter().enumerate().take(mesh.face_count());
                faces.map(of_face).sum::<f64>() / area
            }
        }
    }
}

/// The number of unit squares per unit of length in every face.
#[derive(Debug, Clone)]
pub(super) enum Density {
    Uniform(f64),
    /// Along the arm that the field stores, and across.
    Faces(Vec<[f64; 2]>),
}

impl Density {
    /// # Errors
    /// [`Error::InvalidArgument`] for no quads and for lengths that are not above zero, with the
    /// face where there is one; [`Error::NotFinite`]; [`Error::LengthMismatch`].
    pub(super) fn new(mesh: &TriangleMesh, sizing: &Sizing) -> Result<Self> {
        match sizing {
            Sizing::Quads(0) | Sizing::Graded { quads: 0, .. } => Err(Error::InvalidArgument {
                what: "the number of quads is 0; it must be at least 1".into(),
                index: None,
            }),
            Sizing::Quads(quads) => {
                let density = (*quads as f64 / mesh.surface_area()).sqrt();
                Ok(Density::Uniform(density))
            }
            &Sizing::EdgeLength(length) => {
                check("edge length", length, None)?;
                Ok(Density::Uniform(1.0 / length))
            }
            Sizing::Lengths(lengths) => {
                check_count(mesh, lengths.len())?;
                for (face, &[along, across]) in lengths.iter().enumerate() {
                    check("edge lengths of faces", along, Some(face))?;
                    check("edge lengths of faces", across, Some(face))?;
                }
                let densities = lengths.iter().map(|pair| pair.map(|length| 1.0 / length));
                Ok(Density::Faces(densities.collect()))
            }
            Sizing::Graded { quads, lengths } => {
                check_count(mesh, lengths.len())?;
                let mut squares = 0.0;
                for (face, &length) in lengths.iter().enumerate() {
                    check("edge lengths of faces", length, Some(face))?;
                    squares += mesh.area(face) / (length * length);
                }
                let scale = (*quads as f64 / squares).sqrt();
                if !scale.is_normal() {
                    return Err(Error::NotFinite {
                        what: "the proportions of edge lengths",
                        position: 0,
                    });
                }
                let densities = lengths.iter().map(|length| [scale / length; 2]);
                Ok(Density::Faces(densities.collect()))
            }
        }
    }

    /// `factor` times this density.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        match self {
            Density::Uniform(density) => Density::Uniform(factor * density),
            Density::Faces(faces) => {
                Density::Faces(faces.iter().map(|pair| pair.map(|d| factor * d)).collect())
            }
        }
    }

    /// This density times a factor for every face.
    pub(super) fn graded(&self, factors: &[f64]) -> Self {
        let of = |face: usize| match self {
            Density::Uniform(density) => [*density; 2],
            Density::Faces(faces) => faces[face],
        };
        let graded = factors.iter().enumerate();
        Density::Faces(graded.map(|(face, f)| of(face).map(|d| f * d)).collect())
    }

    /// This density times two factors for every face, along the two arms of faces that are combed by these quarter
    /// turns.
    pub(super) fn stretched(&self, factors: &[[f64; 2]], quarters: &[u8]) -> Self {
        let stretched = |(face, [along, across]): (usize, &[f64; 2])| {
            let of_arms = self.of(face, quarters[face]);
            let new = [along * of_arms[0], across * of_arms[1]];
            match quarters[face] % 2 {
                0 => new,
                _ => [new[1], new[0]],
            }
        };
        Density::Faces(factors.iter().enumerate().map(stretched).collect())
    }

    /// The densities along the two arms of a face that is combed by these quarter turns.
    pub(super) fn of(&self, face: usize, quarters: u8) -> [f64; 2] {
        match self {
            Density::Uniform(density) => [*density; 2],
            Density::Faces(densities) => {
                let [along, across] = densities[face];
                match quarters % 2 {
                    0 => [along, across],
                    _ => [across, along],
                }
            }
        }
    }
}

fn check_count(mesh: &TriangleMesh, actual: usize) -> Result<()> {
    match actual == mesh.face_count() {
        true => Ok(()),
        false => Err(Error::LengthMismatch {
            what: "edge lengths of faces",
            expected: mesh.face_count(),
            actual,
        }),
    }
}

fn check(what: &'static str, length: f64, face: Option<usize>) -> Result<()> {
    // A reciprocal that overflows is no density either.
    if !length.is_finite() || (length > 0.0 && !(1.0 / length).is_finite()) {
        return Err(Error::NotFinite {
            what,
            position: face.unwrap_or(0),
        });
    }
    match length > 0.0 {
        true => Ok(()),
        false => Err(Error::InvalidArgument {
            what: format!("{what}: {length} is not above 0"),
            index: face,
        }),
    }
}
