//! Objectives that are not convex: each is refused with the line that shows it, and what is convex is read.

use roundel::problem::files::NamedProblem;
use roundel::problem::{lp, mps, qplib};
use roundel::{Error, Monitor, Options, Result, solve_with};

/// Two columns in a row `<=`, with this sense and these lines of a quadratic section.
fn mps_with(sense: &str, section: &str, lines: &str) -> Result<NamedProblem> {
    let text = format!(
        "OBJSENSE {sense}\nROWS\n N f\n L c\nCOLUMNS\n x f 1 c 1\n y f 1 c 1\nRHS\n R c 9\n{section}\n{lines}ENDATA\n"
    );
    mps::parse(text.as_bytes())
}

fn lp_with(sense: &str, terms: &str, rest: &str) -> Result<NamedProblem> {
    let text =
        format!("{sense}\n f: x + y +\n [\n{terms}\n ] / 2\nst\n c: x + y <= 9\n{rest}end\n");
    lp::parse(text.as_bytes())
}

fn qplib_with(sense: &str, entries: [&str; 3]) -> Result<NamedProblem> {
    let entries = entries.join("\n");
    let text = format!("b\nQBN\n{sense}\n2\n3\n{entries}\n0\n0\n0\n1e20\n0\n0\n0\n0\n0\n0\n");
    qplib::parse(text.as_bytes())
}

/// The line, the variable and the direction of the error, whose text has all these words.
fn refused(read: Result<NamedProblem>, words: &[&str]) -> (usize, usize, Vec<f64>) {
    let error = read.err().unwrap_or_else(|| panic!("accepted: {words:?}"));
    assert_eq!(error.code(), "not_convex", "{error}");
    let text = error.to_string();
    for word in words {
        assert!(text.contains(word), "'{word}' is not in: {text}");
    }
    let (Some(line), Some(variable)) = (error.line(), error.index()) else {
        panic!("{text}");
    };
    assert!(text.starts_with(&format!("line {line}: ")), "{text}");
    (line, variable, error.direction().unwrap().to_vec())
}

#[test]
fn a_negative_square_is_refused_in_every_section_and_format() {
    for section in ["QUADOBJ", "QSECTION f", "QMATRIX"] {
        let read = mps_with("MIN", section, " x x 2\n y y -3\n");
        let words = ["not convex", "-3 on the diagonal at 'y'", "check the signs"];
        assert_eq!(refused(read, &words), (12, 1, vec![0.0, 1.0]), "{section}");
    }
    let read = lp_with("min", " x ^ 2\n - 3 y ^ 2", "");
    assert_eq!(refused(read, &["-3 on the diagonal at 'y'"]).0, 5);
    let read = qplib_with("minimize", ["1 1 2", "2 1 0", "2 2 -3"]);
    let (line, variable, _) = refused(read, &["'x2'", "for a binary, x^2 = x"]);
    assert_eq!((line, variable), (8, 1));
}

#[test]
fn the_sense_of_the_file_decides_which_sign_is_refused() {
    let lines = " x x 2\n y y 3\n";
    assert!(mps_with("MIN", "QUADOBJ", lines).is_ok());
    let words = ["not concave", "2 on the diagonal at 'x'", "maximised"];
    assert_eq!(refused(mps_with("MAX", "QUADOBJ", lines), &words).0, 11);
    let negative = " x x -2\n y y -3\n";
    assert!(mps_with("MAX", "QUADOBJ", negative).is_ok());
    assert_eq!(refused(mps_with("MIN", "QUADOBJ", negative), &[]).0, 11);
    assert!(lp_with("max", " - x ^ 2 - y ^ 2", "").is_ok());
    assert!(lp_with("max", " x ^ 2", "").is_err());
    assert!(qplib_with("maximize", ["1 1 -2", "2 1 2", "2 2 -2"]).is_ok());
    assert!(qplib_with("maximize", ["1 1 2", "2 1 0", "2 2 -2"]).is_err());
}

#[test]
fn a_product_too_large_for_its_squares_is_refused_and_the_largest_is_read() {
    // The determinant 4 * 9 - 6^2 is zero.
    assert!(mps_with("MIN", "QUADOBJ", " x x 4\n x y 6\n y y 9\n").is_ok());
    let read = mps_with("MIN", "QUADOBJ", " x x 4\n x y 6.001\n y y 9\n");
    let words = ["the entry 6.001 of Q at 'y' and 'x' is too large for 9 and 4"];
    let (line, variable, direction) = refused(read, &words);
    assert_eq!((line, variable), (12, 0));
    let [x, y] = direction[..] else { panic!() };
    let curvature = 4.0 * x * x + 2.0 * 6.001 * x * y + 9.0 * y * y;
    assert!(curvature < 0.0 && x == 1.0, "{curvature} along {x}, {y}");
    // LP halves products: 12 x y is 6 in Q.
    assert!(lp_with("min", " 4 x ^ 2 + 12 x * y + 9 y ^ 2", "").is_ok());
    let read = lp_with("min", " 4 x ^ 2\n + 12.1 x * y\n + 9 y ^ 2", "");
    assert_eq!(refused(read, &["6.05"]).0, 5);
    let read = qplib_with("minimize", ["1 1 4", "2 1 -7", "2 2 9"]);
    assert_eq!(refused(read, &["-7"]).0, 7);
}

#[test]
fn a_product_without_a_square_is_refused() {
    for lines in [" x x 2\n x y 1\n", " y y 2\n y x 1\n", " x x 0\n x y -1\n"] {
        let (line, _, direction) = refused(mps_with("MIN", "QUADOBJ", lines), &["'x'", "'y'"]);
        assert_eq!(line, 12, "{lines}");
        let largest = direction.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        assert_eq!(largest, 1.0, "{direction:?}");
    }
}

#[test]
fn entries_are_judged_by_their_sums_and_the_first_line_is_told() {
    // Sums of 2 and -1, and of 0.5 and 0.5 beside ones.
    assert!(lp_with("min", " - x ^ 2 + y ^ 2\n + 2 x ^ 2", "").is_ok());
    let read = lp_with("min", " 2 x ^ 2 + y ^ 2\n - x ^ 2\n - 2 x ^ 2", "");
    assert_eq!(refused(read, &["-1 on the diagonal at 'x'"]).0, 6);
    let terms = " x ^ 2 + y ^ 2 + 1.5 x * y\n + 1.5 y * x";
    assert_eq!(refused(lp_with("min", terms, ""), &["1.5"]).0, 5);
    assert!(lp_with("min", " x ^ 2 + y ^ 2 + 1.5 x * y - 1.5 y * x", "").is_ok());
    let read = mps_with("MIN", "QUADOBJ", " y y -1\n x x -1\n");
    assert_eq!(refused(read, &["'y'"]).0, 11);
}

#[test]
fn rounding_errors_are_no_curvature() {
    // (a x + b y)^2 with products that are rounded to 12 digits, and what cancellation leaves beside ones.
    let (a, b) = (1.0 / 3.0, 1.0 / 7.0);
    let lines = format!(
        " x x {:.12e}\n x y {:.12e}\n y y {:.12e}\n",
        a * a,
        a * b,
        b * b
    );
    assert!(mps_with("MIN", "QUADOBJ", &lines).is_ok());
    assert!(mps_with("MIN", "QUADOBJ", " x x 1\n y y -1e-17\n").is_ok());
    assert!(mps_with("MIN", "QUADOBJ", " x x 1\n x y 1e-17\n").is_ok());
    assert!(mps_with("MIN", "QUADOBJ", " x x 1\n y y -1e-8\n").is_err());
}

#[test]
fn what_constraints_hold_is_left_to_the_solver() {
    // -x^2 + y^2 with x = y / 2 is convex, and with x = 2 y it is not.
    let text = |row: &str| {
        format!(
            "min\n f: x + [ - x ^ 2 + y ^ 2 ] / 2\nst\n c: {row}\nbounds\n x free\n y free\nend\n"
        )
    };
    let solved = |row| {
        let named = lp::parse(text(row).as_bytes()).unwrap();
        let solved = solve_with(named.problem(), &Options::default(), Monitor::default());
        solved.map_err(|error| named.located(error))
    };
    let energy = solved("2 x - y = 0").unwrap().energy();
    assert!((energy + 1.0 / 6.0).abs() < 1e-12, "{energy}");
    let error = solved("x - 2 y = 0").unwrap_err();
    assert!(
        matches!(error, Error::NotConvexAt { line: 2, .. }),
        "{error}"
    );
    assert!(error.to_string().contains("variable 'x'"), "{error}");
    assert!(lp::parse(text("x - 2 y <= 0").as_bytes()).is_err());
    // A fixed unknown has no curvature.
    let fixed = "min\n f: y + [ - x ^ 2 + y ^ 2 ] / 2\nst\n c: x + y <= 5\nbounds\n x = 2\nend\n";
    let named = lp::parse(fixed.as_bytes()).unwrap();
    let solved = solve_with(named.problem(), &Options::default(), Monitor::default());
    assert!((solved.unwrap().energy() + 2.0).abs() < 1e-9);
    let integer = fixed.replace("x = 2", "1.5 <= x <= 2.25");
    assert!(lp::parse(integer.as_bytes()).is_err());
    assert!(lp::parse(integer.replace("end", "general\n x\nend").as_bytes()).is_ok());
}

#[test]
fn what_three_squares_alone_show_is_for_the_solver_which_names_the_line() {
    // Ones on the diagonal and -0.9 beside them: each pair is convex, the sum of all three is not.
    let terms = " x ^ 2 + y ^ 2\n + z ^ 2 - 1.8 x * y\n - 1.8 y * z - 1.8 x * z";
    let named = lp_with("min", terms, "bounds\n x free\n y free\n z free\n").unwrap();
    let error = solve_with(named.problem(), &Options::default(), Monitor::default()).unwrap_err();
    let variable = error.index().unwrap();
    let located = named.located(error.clone());
    assert_eq!(located.index(), error.index());
    assert_eq!(located.direction(), error.direction());
    assert_eq!(located.line(), Some([4, 4, 5][variable]));
    // Without a file there is no line, and other errors stay what they are.
    let bare = NamedProblem::new(named.problem().clone());
    assert_eq!(bare.located(error.clone()), error);
    assert_eq!(named.located(Error::Empty), Error::Empty);
}
