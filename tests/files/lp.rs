//! LP files: what each section means, and what is refused with its line.

use roundel::problem::files::NamedProblem;
use roundel::problem::lp;
use roundel::{Error, Model};

const INF: f64 = f64::INFINITY;

const COMPLETE: &str = "\
\\ everything that is read
Minimize
 cost: 2 x - y + 3e0z + 4 + [ 2 x ^ 2 - 3 x * y + 5 y*y ] / 2 \\ a comment
   - 1.5 w
Subject To
 sum: x + 2 y
  - z = 3
 c2: -1 <= x - y <= 4
 x + z >= 2
 most: 5 >= 2 w + z
 R3: 2 x + 1 <= 7
Bounds
 x <= 8
 -2 <= y <= inf
 -infinity <= z <= 5
 w free
Generals
 x
Binary
 v1
End
";

fn read(text: &str) -> NamedProblem {
    lp::parse(text.as_bytes()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

#[test]
fn every_section_is_read() {
    let p = read(&COMPLETE.replace("z = 3", "z + 0 v1 = 3"));
    assert_eq!(p.objective(), "cost");
    assert_eq!(p.variables(), ["x", "y", "z", "w", "v1"]);
    assert_eq!(p.constraints(), ["sum"]);
    assert_eq!(p.inequalities(), ["c2", "R3_", "most", "R3"]);
    let model = Model::new(p.problem()).unwrap();
    assert_eq!(model.gradient(), [2.0, -1.0, 3.0, -1.5, 0.0]);
    assert_eq!(model.constant(), 4.0);
    let q: Vec<_> = model.hessian().entries().collect();
    assert_eq!(q, [(0, 0, 2.0), (1, 0, -1.5), (1, 1, 5.0)]);
    assert_eq!(model.integer(), [true, false, false, false, true]);
    let rows = p.problem().inequality_rows();
    assert_eq!(rows.lower(), [-1.0, 2.0, -INF, -INF]);
    assert_eq!(rows.upper(), [4.0, INF, 5.0, 6.0]);
    assert_eq!(rows.row(2).collect::<Vec<_>>(), [(3, 2.0), (2, 1.0)]);
    let bounds: Vec<_> = (0..5).map(|j| p.problem().bounds(j).unwrap()).collect();
    let expected = [
        (0.0, 8.0),
        (-2.0, INF),
        (-INF, 5.0),
        (-INF, INF),
        (0.0, 1.0),
    ];
    assert_eq!(bounds, expected);
}

#[test]
fn words_are_known_in_their_other_forms() {
    let text =
        "MAXIMISE obj:x+y\nst\n a: x + y =< 2\nbound\n x = 1.5\n+inf >= y >= -3\ngen\n y\nend";
    let p = read(text);
    assert!(p.maximises());
    let model = Model::new(p.problem()).unwrap();
    assert_eq!(model.gradient(), [-1.0, -1.0]);
    assert_eq!(p.problem().bounds(0).unwrap(), (1.5, 1.5));
    assert_eq!(p.problem().bounds(1).unwrap(), (-3.0, INF));
    assert!(model.integer()[1]);
}

#[test]
fn sections_that_are_not_supported_may_be_empty() {
    let p = read("min\n o: x\nst\n a: x >= 1\nbounds\ngen\nsemi\nbin\nend\n");
    assert_eq!(p.inequalities(), ["a"]);
}

#[test]
fn each_fault_is_reported_with_its_line_and_word() {
    let cases = [
        ("Minimize\n", "Minimal\n", false, 2, "minimize"),
        ("Subject To\n", "", false, 5, "subject to"),
        ("/ 2 \\", "/ 3 \\", false, 3, "/ 2"),
        ("x ^ 2", "x ^ 3", false, 3, "second factor"),
        (
            " c2: -1",
            " sum: -1",
            false,
            8,
            "'sum' is already on line 6",
        ),
        (
            " c2: -1 <= x - y",
            " c2: [ x ^ 2 ]",
            true,
            8,
            "quadratic constraint",
        ),
        (
            " c2: -1 <= x - y <= 4",
            " c2: x = 1 -> y <= 4",
            true,
            8,
            "indicator",
        ),
        (
            " c2: -1 <= x - y <= 4",
            " c2: 4 <= x - y <= -1",
            false,
            8,
            "between 4 and -1",
        ),
        (
            " c2: -1 <= x - y <= 4",
            " c2: 4 <= 5",
            false,
            8,
            "variables",
        ),
        (
            " c2: -1 <= x - y <= 4",
            " c2: -1 <= x - y >= 4",
            false,
            8,
            "two sides",
        ),
        (" x <= 8\n", " q <= 8\n", false, 13, "no variable 'q'"),
        (" x <= 8\n", " x <= -8\n", false, 13, "lower bound 0 above"),
        (" x <= 8\n", " x <= y\n", false, 13, "expected a number"),
        (" x <= 8\n", " x >= inf\n", false, 13, "no number"),
        (" w free\n", " w fee\n", false, 16, "'fee'"),
        (
            "Binary\n v1\n",
            "Semi-Continuous\n x\n",
            true,
            19,
            "Semi-Continuous",
        ),
        ("Binary\n v1\n", "SOS\n s1: S1:: x:1\n", true, 19, "SOS"),
        (
            "Binary\n v1\n",
            "General Constraints\n g: x\n",
            true,
            19,
            "General Constraints",
        ),
        ("Binary\n v1\nEnd\n", "", false, 18, "end"),
        ("End\n", "End\n x\n", false, 22, "behind"),
        (" x <= 8\n", " x <= 8 ^\n", false, 13, "'^'"),
    ];
    let good = COMPLETE.replace("z = 3", "z + 0 v1 = 3");
    for (old, new, unsupported, line, word) in cases {
        assert!(good.contains(old), "{old}");
        let text = good.replacen(old, new, 1);
        let error = lp::parse(text.as_bytes()).err();
        let error = error.unwrap_or_else(|| panic!("accepted: {new}"));
        let refused = matches!(error, Error::NotSupported { .. });
        assert_eq!(refused, unsupported, "{new}: {error}");
        assert_eq!(error.line(), Some(line), "{new}: {error}");
        assert!(error.to_string().contains(word), "{new}: {error}");
    }
}

#[test]
fn names_that_lp_does_not_allow_are_changed_when_written() {
    let p = roundel::Problem::new(4).unwrap();
    let names = ["free", "3x", "e5", "good_1"].map(String::from).to_vec();
    let p = NamedProblem::with_names(p, "", "st", names, vec![], vec![]).unwrap();
    let mut text = Vec::new();
    lp::write_to(&mut text, &p).unwrap();
    let again = lp::parse(text.as_slice()).unwrap();
    assert_eq!(again.variables(), ["_free", "_3x", "_e5", "good_1"]);
    assert_eq!(again.objective(), "_st");
}
