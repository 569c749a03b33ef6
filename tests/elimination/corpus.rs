//! The shared corpus reduces to the sizes of its reference, where the corpus is present.

use std::path::Path;

use roundel::problem::mps;
use serde_json::Value;

use super::common::skip::skip;
use super::reduce;

#[test]
fn the_corpus_reduces_to_the_counts_of_its_reference() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/corpus");
    let Ok(text) = std::fs::read_to_string(folder.join("reference.json")) else {
        return skip("the corpus of problems is not there");
    };
    let reference: serde_json::Map<String, Value> = serde_json::from_str(&text).unwrap();
    let mut reduced_to = 0;
    for (name, counts) in &reference {
        let path = folder.join(format!("{name}.mps.gz"));
        if !path.exists() {
            continue;
        }
        let problem = mps::read(&path).unwrap();
        let reduced = reduce(problem.problem()).unwrap();
        let count = |key: &str| counts[key].as_u64().unwrap() as usize;
        assert_eq!(
            reduced.integers().len(),
            count("reduced_integers"),
            "{name}"
        );
        assert_eq!(
            reduced.continuous().len(),
            count("reduced_continuous"),
            "{name}"
        );
        reduced_to += 1;
    }
    assert!(
        reduced_to > 0,
        "the reference is there, but none of its problems"
    );
}
