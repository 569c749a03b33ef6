//! MPS as other solvers write it: maximisation, fixed format, the quadratic sections and their order.

use roundel::Model;
use roundel::problem::files::NamedProblem;
use roundel::problem::mps;

fn read(text: &str) -> NamedProblem {
    mps::parse(text.as_bytes()).unwrap()
}

#[test]
fn a_maximised_objective_is_negated() {
    let head = "ROWS\n N f\nCOLUMNS\n x f 3\nRHS\n f 5\nQUADOBJ\n x x -2\nENDATA\n";
    for sense in [
        "OBJSENSE\n    MAX\n",
        "OBJSENSE MAXIMIZE\n",
        "OBJSENSE\n Max\n",
    ] {
        let p = read(&format!("{sense}{head}"));
        assert!(p.maximises(), "{sense}");
        let model = Model::new(p.problem()).unwrap();
        assert_eq!(model.gradient(), [-3.0]);
        assert_eq!(model.constant(), 5.0);
        assert_eq!(model.hessian().values(), [2.0]);
    }
    assert!(!read(&head.replace("-2", "2")).maximises());
}

#[test]
fn names_with_blanks_are_read_by_the_columns_of_fixed_format() {
    let p = read(
        "\
NAME          A FIXED ONE
ROWS
 N  TOTAL CO
 L  ROW 1
 G  R
COLUMNS
    X ONE     TOTAL CO           1.0   ROW 1              2.5
    X ONE     R                 -1.0
    Y         ROW 1              4.0   R                  1.0
RHS
    RIGHT ON  ROW 1             10.0   R                  2.0
RANGES
    RANGE     ROW 1              3.0
BOUNDS
 UP BND SET   X ONE              4.0
 FR BND SET   Y
QUADOBJ
    X ONE     X ONE              2.0
    X ONE     Y                  0.5
    Y         Y                  3.0
ENDATA
",
    );
    assert_eq!(p.title(), "A FIXED ONE");
    assert_eq!(p.objective(), "TOTAL CO");
    assert_eq!(p.variables(), ["X ONE", "Y"]);
    assert_eq!(p.inequalities(), ["ROW 1", "R"]);
    let rows = p.problem().inequality_rows();
    assert_eq!(rows.row(0).collect::<Vec<_>>(), [(0, 2.5), (1, 4.0)]);
    assert_eq!((rows.lower()[0], rows.upper()[0]), (7.0, 10.0));
    assert_eq!(p.problem().bounds(0).unwrap(), (0.0, 4.0));
    let model = Model::new(p.problem()).unwrap();
    assert_eq!(model.gradient(), [1.0, 0.0]);
    assert_eq!(model.hessian().values(), [2.0, 0.5, 3.0]);
    // Free format has no blanks in names.
    let mut text = Vec::new();
    mps::write_to(&mut text, &p).unwrap();
    let again = mps::parse(text.as_slice()).unwrap();
    assert_eq!(again.variables(), ["X_ONE", "Y"]);
    assert_eq!(again.inequalities(), ["ROW_1", "R"]);
}

#[test]
fn a_line_off_the_columns_of_fixed_format_is_refused() {
    let text = "ROWS\n N  TOTAL CO\nCOLUMNS\n    X ONE    TOTAL CO           1.0\nENDATA\n";
    let error = mps::parse(text.as_bytes()).unwrap_err();
    assert_eq!(error.line(), Some(4), "{error}");
    assert!(error.to_string().contains("fixed format"), "{error}");
}

#[test]
fn quadratic_sections_have_several_names_and_places() {
    let body = "ROWS\n N f\n L c\nCOLUMNS\n x f 3 c 1\n";
    let rest = "RHS\n c 2\nRANGES\n c 1\n";
    let bounds = "BOUNDS\n MI x\n";
    for q in [
        "QSECTION f\n x x 2\n",
        "QSECTION\n x x 2\n",
        "QUADOBJ\n x x 2\n",
        "QMATRIX f\n x x 2\n",
    ] {
        for order in [[q, rest, bounds], [rest, bounds, q], [bounds, q, rest]] {
            let p = read(&format!("{body}{}ENDATA\n", order.concat()));
            assert_eq!(Model::new(p.problem()).unwrap().hessian().values(), [2.0]);
            assert_eq!(p.problem().inequality_rows().lower(), [1.0]);
            assert_eq!(p.problem().bounds(0).unwrap().0, f64::NEG_INFINITY);
        }
    }
}

#[test]
fn a_limit_that_readers_take_for_infinite_is_not_written() {
    let mut p = roundel::Problem::new(2).unwrap();
    p.set_bounds(&[1], &[0.0], &[1e25]).unwrap();
    let error = mps::write_to(Vec::new(), &NamedProblem::new(p)).unwrap_err();
    assert!(
        matches!(error, roundel::Error::NotSupported { .. }),
        "{error}"
    );
    assert_eq!(error.index(), Some(1));
}
