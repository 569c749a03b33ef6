//! The shared mixed-integer quadratic programs, where they are present: each is read, written as MPS and as LP,
//! and read back unchanged.

use std::path::Path;

use roundel::problem::{lp, mps};

use crate::common::skip::skip;
use crate::random::{fingerprint, fingerprint_without_zeros};

#[test]
fn every_shared_program_is_read_and_written_unchanged() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let Ok(files) = std::fs::read_dir(root.join("../shared/miqp")) else {
        return skip("the shared programs are not there");
    };
    let mut paths: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    paths.retain(|path| path.to_string_lossy().ends_with(".mps.gz"));
    assert!(!paths.is_empty());
    for path in paths {
        let p = mps::read(&path).unwrap();
        let name = path.display();
        let mut text = Vec::new();
        mps::write_to(&mut text, &p).unwrap();
        let again = mps::parse(text.as_slice()).unwrap();
        let bits = fingerprint(p.problem());
        assert_eq!(fingerprint(again.problem()), bits, "{name}");
        text.clear();
        lp::write_to(&mut text, &p).unwrap();
        let again = lp::parse(text.as_slice()).unwrap();
        let bits = fingerprint_without_zeros(p.problem());
        assert_eq!(fingerprint_without_zeros(again.problem()), bits, "{name}");
    }
}
