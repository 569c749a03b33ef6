//! The problems of the shared corpus read with the sizes of their reference, where it is present.

use std::path::Path;

use roundel::Model;
use roundel::problem::mps;

use crate::common::skip::skip;

#[test]
fn every_problem_of_the_corpus_has_the_sizes_of_its_reference() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let corpus = root.join("../shared/corpus");
    let Ok(reference) = std::fs::read(corpus.join("reference.json")) else {
        return skip("the corpus of problems is not there");
    };
    let reference: serde_json::Value = serde_json::from_slice(&reference).unwrap();
    let mut read = 0;
    for (name, sizes) in reference.as_object().unwrap() {
        let path = corpus.join(format!("{name}.mps.gz"));
        if !path.exists() {
            continue;
        }
        let p = mps::read(&path).unwrap();
        let model = Model::new(p.problem()).unwrap();
        let integers = model.integer().iter().filter(|&&b| b).count();
        assert_eq!(p.title(), name);
        assert_eq!(p.variables().len(), sizes["variables"], "{name}");
        assert_eq!(p.constraints().len(), sizes["constraints"], "{name}");
        assert_eq!(integers, sizes["integers"], "{name}");
        let mut text = Vec::new();
        mps::write_to(&mut text, &p).unwrap();
        let again = mps::parse(text.as_slice()).unwrap();
        assert_eq!(
            crate::random::fingerprint(again.problem()),
            crate::random::fingerprint(p.problem()),
            "{name}"
        );
        read += 1;
    }
    assert!(read > 0, "the reference lists no problem that is present");
}
