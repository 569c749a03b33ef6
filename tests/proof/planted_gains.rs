//! Planted lies about what raises the bounds of a part: switches, the curvature of integers, and cuts.

use roundel::proof::FaultKind;
use serde_json::json;

use crate::altered::{add, cut, multipliers, part, statement, switch};
use crate::planted::{Lie, Of};

pub const LIES: [Lie; 24] = [
    // Switches.
    (
        "a switch of an unknown that is not there",
        Of::Switched,
        FaultKind::Reference,
        |l| {
            switch(l)["unknown"] = json!(99);
        },
    ),
    (
        "a switch of an unknown that is in no part",
        Of::Switched,
        FaultKind::Parts,
        |l| {
            part(l, 0)["unknowns"].as_array_mut().unwrap().remove(0);
        },
    ),
    (
        "a switch without what it holds",
        Of::Switched,
        FaultKind::Switch,
        |l| {
            switch(l)["steps"] = json!([]);
        },
    ),
    (
        "a switch that holds by another row",
        Of::Switched,
        FaultKind::Step,
        |l| {
            let row = &mut switch(l)["steps"][0]["upper"][0];
            *row = json!(row.as_u64().unwrap() + 1);
        },
    ),
    (
        "a switch that is another unknown",
        Of::Switched,
        FaultKind::Switch,
        |l| {
            switch(l)["binary"] = json!(3);
        },
    ),
    (
        "a switch that may be below zero",
        Of::Switched,
        FaultKind::Switch,
        |l| {
            let bounds = statement(l)["bounds"].as_array_mut().unwrap();
            let of_switch = bounds.iter_mut().find(|bounds| bounds[0] == 6);
            of_switch.unwrap()[1] = json!(-1.0);
        },
    ),
    (
        "a switch that is a real",
        Of::Switched,
        FaultKind::Switch,
        |l| {
            statement(l)["integers"] = json!([7]);
        },
    ),
    (
        "a switch that takes more than there is",
        Of::Switched,
        FaultKind::NotConvex,
        |l| {
            let product = &mut switch(l)["product"];
            *product = json!(3.0 * product.as_f64().unwrap());
        },
    ),
    (
        "a switch without its square",
        Of::Switched,
        FaultKind::NotConvex,
        |l| {
            switch(l)["square"] = json!(0.0);
        },
    ),
    (
        "the switches are left out",
        Of::Switched,
        FaultKind::Bound,
        |l| {
            part(l, 0)["switches"] = json!([]);
            part(l, 0)["curvature"] = json!(vec![0.0; 8]);
        },
    ),
    // Integers with all of their curvature.
    (
        "an integer has more curvature than there is",
        Of::OddCycle,
        FaultKind::NotConvex,
        |l| {
            add(&mut part(l, 0)["curvature"][1], 1e-9);
        },
    ),
    (
        "an integer with all of its curvature is a real",
        Of::OddCycle,
        FaultKind::Certificate,
        |l| {
            statement(l)["integers"] = json!([0, 1, 2, 3, 4, 5]);
        },
    ),
    (
        "a leaf of integers proves too little",
        Of::OddCycle,
        FaultKind::Bound,
        |l| {
            for multiplier in multipliers(l) {
                add(&mut multiplier[1], 0.75);
            }
        },
    ),
    (
        "the curvature of integers is left out",
        Of::OddCycle,
        FaultKind::Bound,
        |l| {
            part(l, 0)["curvature"] = json!(vec![0.0; 7]);
        },
    ),
    // Cuts.
    ("a cut that goes too far", Of::Lots, FaultKind::Cut, |l| {
        add(&mut cut(l)["lower"], 1e-3);
    }),
    (
        "a cut whose case is held with the wrong sign",
        Of::Lots,
        FaultKind::Cut,
        |l| {
            let by = &mut cut(l)["cases"][0]["by"];
            *by = json!(-by.as_f64().unwrap());
        },
    ),
    ("a cut of other cases", Of::Lots, FaultKind::Cut, |l| {
        add(&mut cut(l)["at"], 1.0);
    }),
    (
        "a cut whose cases leave a gap",
        Of::Lots,
        FaultKind::Cut,
        |l| {
            add(&mut cut(l)["at"], 0.5);
        },
    ),
    ("a cut that splits a real", Of::Lots, FaultKind::Cut, |l| {
        cut(l)["split"] = json!([[0, 1.0]]);
    }),
    (
        "a cut that splits what is no integer",
        Of::Lots,
        FaultKind::Cut,
        |l| {
            add(&mut cut(l)["split"][0][1], 0.5);
        },
    ),
    (
        "a cut by a row that is not there",
        Of::Lots,
        FaultKind::Reference,
        |l| {
            cut(l)["cases"][0]["multipliers"] = json!([[99, 1.0]]);
        },
    ),
    (
        "a cut by a side that is not there",
        Of::Lots,
        FaultKind::Certificate,
        |l| {
            cut(l)["cases"][0]["multipliers"] = json!([[3, -1.0]]);
        },
    ),
    (
        "a cut of an unknown that is not there",
        Of::Lots,
        FaultKind::Reference,
        |l| {
            cut(l)["terms"][0][0] = json!(99);
        },
    ),
    (
        "the cuts are left out",
        Of::Lots,
        FaultKind::Reference,
        |l| {
            part(l, 0)["cuts"] = json!([]);
        },
    ),
];
