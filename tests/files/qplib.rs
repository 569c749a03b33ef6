//! QPLIB files: what they mean, and what is refused with its line.

use roundel::problem::files::{self, NamedProblem};
use roundel::problem::qplib;
use roundel::{Error, Model};

use crate::Scratch;

const INF: f64 = f64::INFINITY;

const COMPLETE: &str = "\
! a comment
BAND  a name
CGL # convex, all kinds of unknowns, linear rows
minimize
3 # variables
3 # constraints
3 # entries of Q
1 1 2.0
2 1 -1.0
3 3 4.0
-0.5 # linear terms
1
2 1.5
7 # constant
4 # entries of rows
1 1 1.0
1 3 -1
2 2 2
3 1 5
1e10 # infinity
-1e10 # lower sides
2
2 3
3 1
4 # upper sides
2
2 3
3 1e10
0 # lower bounds
1
2 -1e10
9 # upper bounds
0
0 # types
2
1 1
3 2
0 # starting point
0
0
0
0
0
1 # names
2 middle
0
";

fn read(text: &str) -> NamedProblem {
    qplib::parse(text.as_bytes()).unwrap()
}

#[test]
fn every_part_is_read() {
    let p = read(COMPLETE);
    assert_eq!(p.title(), "BAND");
    assert_eq!(p.variables(), ["x1", "middle", "x3"]);
    assert_eq!(p.constraints(), ["c2"]);
    assert_eq!(p.inequalities(), ["c1", "c3"]);
    let model = Model::new(p.problem()).unwrap();
    let q: Vec<_> = model.hessian().entries().collect();
    assert_eq!(q, [(0, 0, 2.0), (1, 0, -1.0), (2, 2, 4.0)]);
    assert_eq!(model.gradient(), [-0.5, 1.5, -0.5]);
    assert_eq!(model.constant(), 7.0);
    assert_eq!(model.integer(), [true, false, true]);
    assert_eq!(model.constraint_rhs(), [3.0]);
    let rows = p.problem().inequality_rows();
    assert_eq!(
        (rows.lower(), rows.upper()),
        (&[-INF, 1.0][..], &[4.0, INF][..])
    );
    assert_eq!(rows.row(0).collect::<Vec<_>>(), [(0, 1.0), (2, -1.0)]);
    let bounds: Vec<_> = (0..3).map(|j| p.problem().bounds(j).unwrap()).collect();
    assert_eq!(bounds, [(0.0, 9.0), (-INF, 9.0), (0.0, 1.0)]);
}

#[test]
fn sections_are_left_out_where_the_type_says_so() {
    let p =
        read("b\nQBN\nmaximize\n2\n3\n1 1 -2\n2 1 3\n2 2 -5\n0\n0\n0\n1e20\n0\n0\n0\n0\n0\n0\n");
    assert!(p.maximises());
    assert_eq!(p.problem().bounds(1).unwrap(), (0.0, 1.0));
    assert_eq!(Model::new(p.problem()).unwrap().integer(), [true; 2]);
    let p = read("l\nLIB\nminimize\n1\n2\n0\n0\n1e20\n-3\n0\n3\n0\n");
    assert_eq!(p.problem().bounds(0).unwrap(), (-3.0, 3.0));
    assert_eq!(Model::new(p.problem()).unwrap().gradient(), [2.0]);
    assert_eq!(Model::new(p.problem()).unwrap().integer(), [true]);
}

#[test]
fn each_fault_is_reported_with_its_line_and_word() {
    let cases = [
        ("CGL", "CXL", false, 3, "CXL"),
        ("CGL", "\u{c}\nCGL", false, 3, "0x0c"),
        ("minimize", "smallest", false, 4, "smallest"),
        ("3 # variables", "x # variables", false, 5, "count"),
        ("3 # variables", "3000000", true, 5, "more than 2000000"),
        ("2 1 -1.0\n", "4 1 -1.0\n", false, 9, "index 4"),
        ("2 1 -1.0\n", "1 1 -1.0\n", false, 9, "given twice"),
        ("2 1 -1.0\n", "2 1\n", false, 9, "3 words"),
        ("2 1 -1.0\n", "2 1 one\n", false, 9, "'one'"),
        ("2 middle\n0\n", "2 x1\n0\n", false, 45, "'x1'"),
        (
            "1 # names\n2 middle\n0\n",
            "1\n",
            false,
            44,
            "the file ends",
        ),
    ];
    for (old, new, unsupported, line, word) in cases {
        assert!(COMPLETE.contains(old), "{old}");
        let text = COMPLETE.replacen(old, new, 1);
        let error = qplib::parse(text.as_bytes()).err();
        let error = error.unwrap_or_else(|| panic!("accepted: {new}"));
        let refused = matches!(error, Error::NotSupported { .. });
        assert_eq!(refused, unsupported, "{new}: {error}");
        assert_eq!(error.line(), Some(line), "{new}: {error}");
        assert!(error.to_string().contains(word), "{new}: {error}");
    }
}

#[test]
fn a_quadratic_constraint_is_refused_with_its_line() {
    let text = COMPLETE.replace("CGL", "CGQ");
    let with = text.replace("7 # constant\n", "7\n1\n2 1 1 3.0\n");
    let error = qplib::parse(with.as_bytes()).unwrap_err();
    assert!(matches!(error, Error::NotSupported { .. }), "{error}");
    assert_eq!((error.line(), error.index()), (Some(16), Some(1)));
    // Without such a term it is linear.
    read(&text.replace("7 # constant\n", "7\n0\n"));
}

#[test]
fn the_name_of_a_file_says_its_format() {
    let scratch = Scratch::new("formats");
    let path = scratch.file("p.qplib");
    std::fs::write(&path, COMPLETE).unwrap();
    let p = files::read(&path).unwrap();
    let bits = crate::random::fingerprint(p.problem());
    assert!(matches!(
        files::write(&path, &p),
        Err(Error::NotSupported { .. })
    ));
    let mut names = vec!["p.mps", "p.LP"];
    if cfg!(feature = "gzip") {
        names.extend(["p.mps.gz", "p.lp.gz"]);
    }
    for name in names {
        let path = scratch.file(name);
        files::write(&path, &p).unwrap();
        let again = files::read(&path).unwrap();
        assert_eq!(crate::random::fingerprint(again.problem()), bits, "{name}");
        assert_eq!(again.variables(), p.variables());
    }
}

#[test]
fn infinity_is_above_zero() {
    for infinity in ["0", "-1e10"] {
        let text = COMPLETE.replace("1e10 # infinity", infinity);
        let error = qplib::parse(text.as_bytes()).unwrap_err();
        let line = 1 + text.lines().position(|line| line == infinity).unwrap();
        assert_eq!(error.line(), Some(line), "{error}");
        assert!(error.to_string().contains("is not above 0"), "{error}");
    }
}

#[test]
fn a_lower_limit_that_is_infinite_is_refused() {
    let bounds = COMPLETE.replace("0 # lower bounds", "2e10 # lower bounds");
    let bounds = bounds.replace("9 # upper bounds", "3e10 # upper bounds");
    let sides = COMPLETE.replace("3 1e10\n", "3 -1e10\n");
    for (text, what, index) in [(bounds, "bounds", 0), (sides, "sides of constraints", 2)] {
        let error = qplib::parse(text.as_bytes()).unwrap_err();
        assert_eq!(error.index(), Some(index), "{error}");
        assert!(error.to_string().starts_with(what), "{error}");
    }
}
