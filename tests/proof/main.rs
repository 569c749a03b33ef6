//! Proofs.

#[path = "../branch/instance.rs"]
#[allow(dead_code)]
mod instance;
#[path = "../branch/kinds.rs"]
mod kinds;
#[path = "../common/random.rs"]
#[allow(dead_code)]
mod random;
#[path = "../certificate/rational.rs"]
#[allow(dead_code)]
mod rational;

use instance::Instance;
use roundel::{Options, Monitor, solve_with_proof};

type Kind = fn(u64) -> Instance;

const KINDS: [(&str, Kind); 13] = [
    ("bounds", kinds::bounds),
    ("ranges", kinds::ranges),
    ("equalities", kinds::equalities),
    ("free integers", kinds::free_integers),
    ("linear", kinds::linear),
    ("singular", kinds::singular),
    ("contradictory", kinds::contradictory),
    ("integrality", kinds::integrality),
    ("unbounded", kinds::unbounded),
    ("degenerate", kinds::degenerate),
    ("large", kinds::large),
    ("pinned", kinds::pinned),
    ("not convex", kinds::not_convex),
];

#[test]
fn explore() {
    for (name, kind) in KINDS {
        let mut tally = std::collections::BTreeMap::new();
        for seed in 0..300 {
            let problem = kind(seed).problem();
            let word = match solve_with_proof(&problem, &Options::default(), Monitor::default()) {
                Err(error) => {
                    if error.code() == "not_supported" { eprintln!("{name} {seed}: {error}"); }
                    error.code().to_owned()
                }
                Ok(proved) => {
                    let mut text = Vec::new();
                    proved.proof.write(&mut text).unwrap();
                    match roundel::proof::check_of(&problem, text.as_slice()) {
                        Err(fault) => { eprintln!("{name} {seed}: {fault}"); "refused".to_owned() }
                        Ok(verdict) => match (&proved.outcome, verdict.lower_bound) {
                            (Ok(s), Some(b)) => {
                                let gap = (s.energy() - b) / s.energy().abs().max(1.0);
                                if gap > 1e-8 { eprintln!("{name} {seed}: gap {gap} {:?} {:?}", s.status(), s.lower_bound()); }
                                if gap > 1e-8 { "weak".to_owned() } else if b > s.energy() {"above".to_owned()} else { "proved".to_owned() }
                            }
                            (Ok(_), None) => "none, with point".to_owned(),
                            (Err(_), None) => "none".to_owned(),
                            (Err(_), Some(_)) => "error with bound".to_owned(),
                        }
                    }
                }
            };
            *tally.entry(word).or_insert(0) += 1;
        }
        eprintln!("{name}: {tally:?}");
    }
}
