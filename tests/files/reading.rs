//! The meaning of each section of an MPS file.

use roundel::Model;
use roundel::problem::files::NamedProblem;
use roundel::problem::mps;

const COMPLETE: &str = "\
* everything that is read, in all the ways that it may be written
NAME  a title
OBJSENSE
    MIN
ROWS
 N cost
 E sum
 N other
\tE\tdifference
COLUMNS
 x cost 1 sum 1
 x other 7
 M1 'MARKER' 'INTORG'
 y sum 2e0 difference +3.5
 M2 'MARKER' 'INTEND'
 z difference -.5
RHS
 cost -10 other 3
 sum 4
BOUNDS
 FR x
 FR y
 FR z
QUADOBJ
 x x 2
 x y -1
 z y 0.5 z 4
ENDATA

* comments may follow
";

fn read(text: &str) -> NamedProblem {
    mps::parse(text.as_bytes()).unwrap()
}

#[test]
fn every_section_is_read() {
    let p = read(COMPLETE);
    assert_eq!(p.title(), "a title");
    assert_eq!(p.objective(), "cost");
    assert_eq!(p.variables(), ["x", "y", "z"]);
    assert_eq!(p.constraints(), ["sum", "difference"]);
    let m = Model::new(p.problem()).unwrap();
    assert_eq!(m.gradient(), [1.0, 0.0, 0.0]);
    assert_eq!(m.constant(), 10.0);
    assert_eq!(m.integer(), [false, true, false]);
    assert_eq!(m.constraint_rhs(), [4.0, 0.0]);
    let entries = |a: &roundel::internals::linalg::Sparse| a.entries().collect::<Vec<_>>();
    let rows = [(0, 0, 1.0), (0, 1, 2.0), (1, 1, 3.5), (1, 2, -0.5)];
    assert_eq!(entries(m.constraints()), rows);
    // In 1/2 x'Qx, an off-diagonal entry stands for two.
    assert_eq!(
        m.hessian().mul_symmetric(&[1.0, 1.0, 1.0]),
        [1.0, -0.5, 4.5]
    );
    let lower = [(0, 0, 2.0), (1, 0, -1.0), (2, 1, 0.5), (2, 2, 4.0)];
    assert_eq!(entries(m.hessian()), lower);
}

#[test]
fn both_triangles_mean_the_same_as_one() {
    let full = "QMATRIX\n x x 2\n x y -1\n y x -1\n z y 0.5 z 4\n y z 0.5\nENDATA\n";
    let (head, _) = COMPLETE.split_once("QUADOBJ").unwrap();
    let (full, half) = (read(&format!("{head}{full}")), read(COMPLETE));
    let hessian = |p: &NamedProblem| Model::new(p.problem()).unwrap().hessian().clone();
    assert_eq!(hessian(&full), hessian(&half));
}

#[test]
fn vector_names_carriage_returns_and_a_missing_title_change_nothing() {
    let other = COMPLETE
        .replace("NAME  a title\n", "")
        .replace("OBJSENSE\n    MIN", "OBJSENSE MINIMIZE")
        .replace(" cost -10 other 3\n sum 4", " R cost -10 other 3\n R sum 4")
        .replace(" FR ", "  FR B ")
        .replace('\n', " \r\n");
    let (p, q) = (read(&other), read(COMPLETE));
    assert_eq!(p.title(), "");
    let fingerprint = |p: &NamedProblem| crate::random::fingerprint(p.problem());
    assert_eq!(fingerprint(&p), fingerprint(&q));
}

#[test]
fn a_reader_may_give_one_byte_at_a_time() {
    let slow = std::io::BufReader::with_capacity(1, COMPLETE.as_bytes());
    assert_eq!(mps::parse(slow).unwrap().variables().len(), 3);
}

#[test]
fn a_file_without_constraints_and_quadratic_terms_is_a_problem() {
    let p = read("ROWS\n N f\nCOLUMNS\n x f 1\nBOUNDS\n FR x\nENDATA");
    assert_eq!(p.problem().constraints(), 0);
    assert!(Model::new(p.problem()).unwrap().hessian().is_empty());
}

#[test]
#[cfg(feature = "gzip")]
fn several_archives_in_a_row_are_one_file() {
    use std::io::Write;
    let mut bytes = Vec::new();
    for half in COMPLETE.as_bytes().chunks(COMPLETE.len() / 2) {
        let mut encoder = flate2::write::GzEncoder::new(&mut bytes, Default::default());
        encoder.write_all(half).unwrap();
        encoder.finish().unwrap();
    }
    assert_eq!(mps::parse(bytes.as_slice()).unwrap().variables().len(), 3);
}
