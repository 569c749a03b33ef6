//! What is run: the test bed and the growth of section 5.3 of the thesis, and its ordering.

use roundel::Strategy;

/// Which of the two problems of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// The orientation field.
    Field,
    /// The seamless parametrization.
    Map,
}

impl Family {
    /// As the reference figures and the CSV files call it.
    pub fn name(self) -> &'static str {
        match self {
            Family::Field => "field",
            Family::Map => "map",
        }
    }
}

/// What a table shows of its rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Solvers against each other: energy over time.
    TestBed,
    /// One mesh at several sizes: time and memory over size.
    Growth,
    /// The same solver with and without a fill-reducing ordering.
    Ordering,
}

/// A mesh to run on.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Name of its file, without extension.
    pub name: String,
    /// The mesh, whatever its size.
    pub shape: &'static str,
    /// What the size stands for in the name, and how many triangles that is.
    pub triangles: usize,
    /// The file to subdivide where there is none of this name.
    pub coarse: Option<&'static str>,
    /// The procedural shape that stands in for it.
    pub stand_in: &'static str,
    /// Part of the faces whose direction is given by curvature.
    pub constrained: f64,
    /// Quads that the map aims at.
    pub quads: usize,
}

/// A way to solve.
#[derive(Debug, Clone, PartialEq)]
pub struct Solver {
    /// As tables call it.
    pub name: String,
    /// Flags of the program.
    pub flags: Vec<String>,
}

/// One table.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// Name of its CSV file.
    pub name: &'static str,
    /// Its heading.
    pub title: &'static str,
    /// The problem that is solved.
    pub family: Family,
    /// What is compared.
    pub kind: Kind,
    /// Rows, small meshes before large ones of the same shape.
    pub subjects: Vec<Subject>,
    /// Columns.
    pub solvers: Vec<Solver>,
}

/// All tables, without meshes of more than `most` triangles.
pub fn all(most: usize) -> Vec<Experiment> {
    let table = |name, title, family, kind| Experiment {
        name,
        title,
        family,
        kind,
        subjects: match kind {
            Kind::TestBed => limited(test_bed(), most),
            Kind::Growth => limited(growth(), most),
            Kind::Ordering => vec![gear(most)],
        },
        solvers: match kind {
            Kind::Ordering => orderings(),
            _ => solvers(family),
        },
    };
    vec![
        table(
            "table-5.1",
            "Table 5.1: orientation field",
            Family::Field,
            Kind::TestBed,
        ),
        table(
            "table-5.2",
            "Table 5.2: parametrization",
            Family::Map,
            Kind::TestBed,
        ),
        table(
            "table-5.3",
            "Table 5.3: growth, orientation field",
            Family::Field,
            Kind::Growth,
        ),
        table(
            "table-5.4",
            "Table 5.4: growth, parametrization",
            Family::Map,
            Kind::Growth,
        ),
        table(
            "ordering",
            "Fill-reducing ordering, parametrization",
            Family::Map,
            Kind::Ordering,
        ),
    ]
}

/// The four rocker arms, with as many constrained faces as the thesis has.
fn test_bed() -> Vec<Subject> {
    let sizes = [
        ("200", 200, 47),
        ("1k", 1_000, 159),
        ("2k", 2_000, 586),
        ("20k", 20_000, 2_240),
    ];
    let rocker_arm = |(size, triangles, given): (&str, usize, usize)| Subject {
        name: format!("rockerarm_{size}"),
        shape: "rockerarm",
        triangles,
        coarse: None,
        stand_in: "gear",
        constrained: given as f64 / triangles as f64,
        quads: 1_000,
    };
    sizes.map(rocker_arm).into()
}

fn growth() -> Vec<Subject> {
    let sizes = [
        ("10k", 10_000),
        ("50k", 50_000),
        ("200k", 200_000),
        ("800k", 800_000),
    ];
    let shapes = [
        ("armadillo", "gear", 3_000, "armadillo_200k"),
        ("cube", "rounded-cube", 600, "cube_200k"),
    ];
    let mut subjects = Vec::new();
    for (shape, stand_in, quads, coarse) in shapes {
        subjects.extend(sizes.map(|(size, triangles)| Subject {
            name: format!("{shape}_{size}"),
            shape,
            triangles,
            coarse: (triangles == 800_000).then_some(coarse),
            stand_in,
            constrained: 0.1,
            quads,
        }));
    }
    subjects
}

/// The pinion of the thesis: a shape with many sharp features.
fn gear(most: usize) -> Subject {
    Subject {
        name: "pinion".into(),
        shape: "pinion",
        triangles: most.min(26_000),
        coarse: None,
        stand_in: "gear",
        constrained: 0.1,
        quads: 1_500,
    }
}

/// Those that are not too large; without any, the largest of every shape at a sixteenth, a quarter
/// and all of what is allowed.
fn limited(subjects: Vec<Subject>, most: usize) -> Vec<Subject> {
    let fitting = subjects.iter().filter(|s| s.triangles <= most);
    let fitting: Vec<Subject> = fitting.cloned().collect();
    if !fitting.is_empty() {
        return fitting;
    }
    let mut shrunk: Vec<Subject> = Vec::new();
    for subject in subjects {
        if shrunk.iter().any(|s| s.shape == subject.shape) {
            continue;
        }
        shrunk.extend([most / 16, most / 4, most].map(|triangles| Subject {
            name: format!("{}_{triangles}", subject.shape),
            triangles,
            ..subject.clone()
        }));
    }
    shrunk
}

/// Nodes of a proof in the tables: seconds. What they do not prove takes minutes, or for ever.
const NODES: &str = "100000000";

/// Every strategy as it comes, proofs within [`NODES`], and the adaptive one with the thesis'
/// parameters.
fn solvers(family: Family) -> Vec<Solver> {
    let mut solvers: Vec<Solver> = Strategy::ALL
        .into_iter()
        .map(|strategy| Solver {
            name: strategy.name().into(),
            flags: ["--strategy", strategy.name(), "--nodes", NODES]
                .map(String::from)
                .into(),
        })
        .collect();
    let preset = match family {
        Family::Field => "orientation_field",
        Family::Map => "parametrization",
    };
    solvers.push(Solver {
        name: "adaptive, thesis' parameters".into(),
        flags: vec!["--preset".into(), preset.into()],
    });
    solvers
}

fn orderings() -> Vec<Solver> {
    let both = [("fill-reducing", "fill_reducing"), ("natural", "natural")];
    let solver = |(name, word): (&str, &str)| Solver {
        name: name.into(),
        flags: ["--strategy", "adaptive", "--ordering", word]
            .map(String::from)
            .into(),
    };
    both.map(solver).into()
}

#[cfg(test)]
mod tests {
    use roundel::search::PRESETS;

    use super::*;

    #[test]
    fn every_strategy_runs_in_every_table_but_that_of_the_ordering() {
        for experiment in all(usize::MAX) {
            let has = |s: &Strategy| experiment.solvers.iter().any(|x| x.name == s.name());
            let complete = Strategy::ALL.iter().all(has);
            assert_eq!(complete, experiment.kind != Kind::Ordering);
            assert!(!experiment.subjects.is_empty());
        }
    }

    #[test]
    fn a_limit_leaves_what_fits_or_shrinks_what_does_not() {
        for (most, rows) in [(usize::MAX, 8), (50_000, 4), (2_000, 6)] {
            let left = limited(growth(), most);
            assert_eq!(left.len(), rows, "{most}");
            assert!(left.iter().all(|s| s.triangles <= most));
        }
        assert_eq!(limited(test_bed(), 2_000).len(), 3);
    }

    #[test]
    fn the_thesis_parameters_are_presets_of_the_library() {
        for family in [Family::Field, Family::Map] {
            let solvers = solvers(family);
            let preset = &solvers.last().unwrap().flags[1];
            assert!(PRESETS.iter().any(|p| p.name == preset), "{preset}");
        }
    }
}
