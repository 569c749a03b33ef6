//! One line of a table: a solver on a mesh, ours or from the reference figures.

/// The figures of one solve; none where they are not known.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Row {
    /// The mesh of the table.
    pub mesh: String,
    /// The mesh's shape, and the size for which its row stands.
    pub shape: String,
    pub triangles: usize,
    /// The mesh that stands in for it, if the mesh itself is missing.
    pub stand_in: Option<String>,
    /// `roundel`, `thesis` or `original`.
    pub source: String,
    pub solver: String,
    /// How the solve ended.
    pub status: String,
    pub faces: Option<u64>,
    pub integers: Option<u64>,
    pub continuous: Option<u64>,
    pub energy: Option<f64>,
    pub irregular_vertices: Option<u64>,
    pub factor_nonzeros: Option<u64>,
    /// The seconds of the solve alone.
    pub seconds: Option<f64>,
    /// The peak memory of the whole process.
    pub peak_memory_bytes: Option<u64>,
    /// The ratio of the seconds to those on the next smaller mesh of the same shape and solver.
    pub growth: Option<f64>,
}

impl Row {
    /// Whether this is a reference figure.
    pub fn is_reference(&self) -> bool {
        self.source != "roundel"
    }

    /// The solver, and the source of a reference figure.
    pub fn label(&self) -> String {
        match self.source.as_str() {
            "thesis" => format!("thesis: {}", self.solver),
            _ => self.solver.clone(),
        }
    }
}

/// Fills in [`Row::growth`]; rows come small before large.
pub fn compare_sizes(rows: &mut [Row]) {
    for i in 0..rows.len() {
        let same = |r: &&Row| {
            r.shape == rows[i].shape && r.label() == rows[i].label() && r.mesh != rows[i].mesh
        };
        let before = rows[..i].iter().rev().find(same).and_then(|r| r.seconds);
        rows[i].growth = match (rows[i].seconds, before) {
            (Some(now), Some(before)) if before > 0.0 => Some(now / before),
            _ => None,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_from_one_size_to_the_next_of_the_same_solver() {
        let row = |shape: &str, size: usize, solver: &str, seconds| Row {
            mesh: format!("{shape}_{size}"),
            shape: shape.into(),
            solver: solver.into(),
            seconds,
            ..Row::default()
        };
        let mut rows = vec![
            row("cube", 1, "a", Some(2.0)),
            row("cube", 1, "b", Some(1.0)),
            row("cube", 4, "a", Some(9.0)),
            row("cube", 4, "b", None),
            row("ball", 4, "a", Some(5.0)),
        ];
        compare_sizes(&mut rows);
        let growth: Vec<_> = rows.iter().map(|r| r.growth).collect();
        assert_eq!(growth, [None, None, Some(4.5), None, None]);
    }
}
