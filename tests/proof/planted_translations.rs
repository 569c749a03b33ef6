//! Planted lies about what may move for ever.

use roundel::proof::FaultKind;
use serde_json::{Value, json};

use crate::altered::{Lines, ROOT, statement};
use crate::planted::{Lie, Of};

/// The first translation leaves limits out, the last one holds an integer.
fn translations(lines: &mut Lines) -> &mut Vec<Value> {
    lines[ROOT]["root"]["translations"].as_array_mut().unwrap()
}

fn last(lines: &mut Lines) -> &mut Value {
    translations(lines).last_mut().unwrap()
}

/// Multiplies all steps of a direction.
fn times(translation: &mut Value, by: f64) {
    for step in translation["direction"].as_array_mut().unwrap() {
        step[1] = json!(by * step[1].as_f64().unwrap());
    }
}

/// The step of an unknown in the last direction.
fn step(lines: &mut Lines, unknown: u64) -> &mut Value {
    let steps = last(lines)["direction"].as_array_mut().unwrap();
    &mut steps.iter_mut().find(|step| step[0] == unknown).unwrap()[1]
}

pub const LIES: [Lie; 13] = [
    (
        "an unknown moves that is not there",
        Of::Translated,
        FaultKind::Reference,
        |l| last(l)["direction"][0][0] = json!(99),
    ),
    (
        "an unknown is held that is not there",
        Of::Translated,
        FaultKind::Reference,
        |l| last(l)["held"] = json!(99),
    ),
    (
        "an unknown moves twice",
        Of::Translated,
        FaultKind::Step,
        |l| last(l)["direction"][0][0] = last(l)["direction"][1][0].clone(),
    ),
    (
        "an unknown moves by nothing",
        Of::Translated,
        FaultKind::Step,
        |l| *step(l, 1) = json!(0.0),
    ),
    (
        "integers move by halves",
        Of::Translated,
        FaultKind::Step,
        |l| times(last(l), 0.25),
    ),
    (
        "a real number does not move with the others",
        Of::Translated,
        FaultKind::Step,
        |l| *step(l, 3) = json!(step(l, 3).as_f64().unwrap() * 1.5),
    ),
    (
        "the direction leads to a bound",
        Of::Translated,
        FaultKind::Step,
        |l| times(&mut translations(l)[0], -1.0),
    ),
    (
        "the direction leads to a bound that the steps have not found",
        Of::Translated,
        FaultKind::Step,
        |l| {
            let bounds = statement(l)["bounds"].as_array_mut().unwrap();
            let own = bounds.iter_mut().find(|own| own[0] == 1);
            own.unwrap()[2] = json!(1e9);
        },
    ),
    (
        "the direction leads to a side of a row",
        Of::Translated,
        FaultKind::Step,
        |l| statement(l)["inequalities"][1]["upper"] = json!(1e9),
    ),
    (
        "a row changes that has two sides",
        Of::Translated,
        FaultKind::Step,
        |l| statement(l)["inequalities"][0]["terms"][0][1] = json!(2.0 + 1e-9),
    ),
    (
        "an integer is held that does not move",
        Of::Translated,
        FaultKind::Step,
        |l| last(l)["held"] = json!(4),
    ),
    (
        "a real number is held",
        Of::Translated,
        FaultKind::Step,
        |l| last(l)["held"] = json!(3),
    ),
    (
        "a second direction is the first one",
        Of::Translated,
        FaultKind::Step,
        |l| {
            let again = last(l).clone();
            translations(l).push(again);
        },
    ),
];
