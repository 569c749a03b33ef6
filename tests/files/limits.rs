//! The meaning of rows, ranges and bounds of an MPS file.

use roundel::problem::files::NamedProblem;
use roundel::problem::mps;

const INF: f64 = f64::INFINITY;

fn read(text: &str) -> NamedProblem {
    mps::parse(text.as_bytes()).unwrap()
}

/// The sides of the one row of type `kind` with the right side 4 and this section RANGES.
fn sides(kind: &str, ranges: &str) -> (usize, Vec<(f64, f64)>) {
    let text = format!(
        "ROWS\n N f\n {kind} a\nCOLUMNS\n x f 1 a 2\nRHS\n a 4\n{ranges}BOUNDS\n FR x\nENDATA\n"
    );
    let p = read(&text);
    let rows = p.problem().inequality_rows();
    let sides = rows.lower().iter().zip(rows.upper());
    let sides = sides.map(|(&l, &u)| (l, u)).collect();
    (p.problem().constraints(), sides)
}

#[test]
fn a_row_has_the_sides_that_its_type_and_range_say() {
    assert_eq!(sides("E", ""), (1, vec![]));
    assert_eq!(sides("L", ""), (0, vec![(-INF, 4.0)]));
    assert_eq!(sides("G", ""), (0, vec![(4.0, INF)]));
    for (kind, range, expected) in [
        ("L", 3.0, (1.0, 4.0)),
        ("L", -3.0, (1.0, 4.0)),
        ("G", 3.0, (4.0, 7.0)),
        ("G", -3.0, (4.0, 7.0)),
        ("E", 3.0, (4.0, 7.0)),
        ("E", -3.0, (1.0, 4.0)),
        ("L", 0.0, (4.0, 4.0)),
        ("L", 1e20, (-INF, 4.0)),
    ] {
        let ranges = format!("RANGES\n R a {range}\n");
        assert_eq!(sides(kind, &ranges), (0, vec![expected]), "{kind} {range}");
    }
    assert_eq!(sides("E", "RANGES\n a 0\n"), (1, vec![]));
}

#[test]
fn rows_without_a_finite_side_limit_nothing() {
    for (kind, right) in [("L", "1e30"), ("G", "-Infinity")] {
        let text = format!("ROWS\n N f\n {kind} a\nCOLUMNS\n x f 1 a 2\nRHS\n a {right}\nENDATA\n");
        let p = read(&text);
        let rows = p.problem().inequality_rows();
        assert_eq!((rows.lower(), rows.upper()), (&[-INF][..], &[INF][..]));
    }
}

#[test]
fn rows_keep_their_entries_and_names_among_rows_of_their_kind() {
    let p = read(
        "ROWS\n N f\n G g\n E e\n L l\n E d\nCOLUMNS\n x g 1 e 2\n x l 3\n y d 4 g 5\n y f 1\n\
         RHS\n e 6 d 7\n l 8 g 9\nENDATA\n",
    );
    assert_eq!(p.constraints(), ["e", "d"]);
    assert_eq!(p.inequalities(), ["g", "l"]);
    let rows = p.problem().inequality_rows();
    let row = |i: usize| rows.row(i).collect::<Vec<_>>();
    assert_eq!(row(0), [(0, 1.0), (1, 5.0)]);
    assert_eq!(row(1), [(0, 3.0)]);
    assert_eq!(
        (rows.lower(), rows.upper()),
        (&[9.0, -INF][..], &[INF, 8.0][..])
    );
    let model = roundel::Model::new(p.problem()).unwrap();
    assert_eq!(model.constraint_rhs(), [6.0, 7.0]);
    assert_eq!(model.constraints().row(1).collect::<Vec<_>>(), [(1, 4.0)]);
}

/// The bounds of a continuous and of an integer column with these lines of the section BOUNDS, in which `?`
/// stands for the column, and whether they are integer.
fn bounds(lines: &str) -> [(f64, f64, bool); 2] {
    let lines = [lines.replace('?', "x"), lines.replace('?', "n")].concat();
    let text = format!(
        "ROWS\n N f\nCOLUMNS\n x f 1\n M 'MARKER' 'INTORG'\n n f 1\n M 'MARKER' 'INTEND'\n\
         BOUNDS\n{lines}ENDATA\n"
    );
    let p = read(&text);
    let integer = roundel::Model::new(p.problem()).unwrap().integer().to_vec();
    [0, 1].map(|j| {
        let (lower, upper) = p.problem().bounds(j).unwrap();
        (lower, upper, integer[j])
    })
}

#[test]
fn a_column_without_a_bound_is_not_negative_and_an_integer_one_is_binary() {
    assert_eq!(bounds(""), [(0.0, INF, false), (0.0, 1.0, true)]);
}

#[test]
fn each_type_of_bound_means_what_other_solvers_read() {
    for (lines, lower, upper) in [
        (" LO B ? 2\n", 2.0, INF),
        (" UP B ? 2\n", 0.0, 2.0),
        (" UP B ? 0\n", 0.0, 0.0),
        (" UP B ? -2\n", -INF, -2.0),
        (" UP B ? -2\n LO B ? -3\n", -3.0, -2.0),
        (" FX B ? 2.5\n", 2.5, 2.5),
        (" FR B ?\n", -INF, INF),
        (" FR B ? 0\n", -INF, INF),
        (" MI B ?\n", -INF, INF),
        (" MI B ?\n UP B ? 4\n", -INF, 4.0),
        (" PL B ?\n", 0.0, INF),
        (" LO B ? -1e30\n UP B ? inf\n", -INF, INF),
    ] {
        let expected = [(lower, upper, false), (lower, upper, true)];
        assert_eq!(bounds(lines), expected, "{lines}");
    }
}

#[test]
fn the_name_of_the_bounds_may_be_left_out() {
    for lines in [" LO ? 2\n", " FR ?\n", " BV ?\n"] {
        assert_eq!(bounds(lines), bounds(&lines.replace('?', "B ?")), "{lines}");
    }
}

#[test]
fn bounds_of_integer_types_make_a_column_integer() {
    for (lines, lower, upper) in [
        (" BV B ?\n", 0.0, 1.0),
        (" BV B ? 1\n", 0.0, 1.0),
        (" LI B ? 2\n", 2.0, INF),
        (" LI B ? -2\n UI B ? 3\n", -2.0, 3.0),
    ] {
        assert_eq!(bounds(lines), [(lower, upper, true); 2], "{lines}");
    }
}
