//! Planted lies about the closest points of lattices.

use roundel::proof::FaultKind;
use serde_json::{Value, json};

use crate::altered::{Lines, ROOT, add, part, statement};
use crate::planted::{Lie, Of};

/// The lattice of the first part.
fn lattice(lines: &mut Lines) -> &mut Value {
    &mut part(lines, 0)["lattice"]
}

/// Its form.
fn form(lines: &mut Lines) -> &mut Value {
    &mut lattice(lines)["forms"][0]
}

/// Multiplies a number.
fn times(number: &mut Value, by: f64) {
    *number = json!(by * number.as_f64().unwrap());
}

pub const LIES: [Lie; 28] = [
    // Unknowns that are defined.
    (
        "an unknown is defined by one that is not there",
        Of::Lattice,
        FaultKind::Reference,
        |l| {
            l[ROOT]["root"]["defined"][0][0][0] = json!(99);
        },
    ),
    (
        "an unknown is defined by itself",
        Of::Lattice,
        FaultKind::Reference,
        |l| {
            l[ROOT]["root"]["defined"][0][0][0] = json!(10);
        },
    ),
    (
        "an unknown is defined by halves of integers",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            for term in l[ROOT]["root"]["defined"][0].as_array_mut().unwrap() {
                times(&mut term[1], 0.5);
            }
        },
    ),
    (
        "an unknown is not defined",
        Of::Lattice,
        FaultKind::Reference,
        |l| {
            l[ROOT]["root"]["defined"] = json!([]);
        },
    ),
    // Equations and what they give.
    (
        "an equation that is not there",
        Of::Lattice,
        FaultKind::Reference,
        |l| {
            lattice(l)["solved"][0][0] = json!(99);
        },
    ),
    (
        "an equation gives an unknown that is not there",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            lattice(l)["solved"][0][1] = json!(99);
        },
    ),
    (
        "an equation gives an unknown that it does not have",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            lattice(l)["solved"][0][1] = json!(7);
        },
    ),
    (
        "an equation is solved twice",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            let solved = lattice(l)["solved"].as_array_mut().unwrap();
            let first = solved[0].clone();
            solved.push(first);
        },
    ),
    (
        "an equation is left out",
        Of::Lattice,
        FaultKind::NotConvex,
        |l| {
            lattice(l)["solved"].as_array_mut().unwrap().remove(0);
        },
    ),
    // The form.
    (
        "a combination of an unknown that is not there",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            form(l)["combinations"][0][0][0] = json!(99);
        },
    ),
    (
        "a combination of a real",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            form(l)["combinations"][0][0][0] = json!(7);
        },
    ),
    (
        "a combination with halves",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            times(&mut form(l)["combinations"][0][0][1], 0.5);
        },
    ),
    (
        "an integer of a combination is a real",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            let integers = statement(l)["integers"].as_array_mut().unwrap();
            integers.retain(|j| j != 3);
        },
    ),
    (
        "a combination is another one",
        Of::Lattice,
        FaultKind::NotConvex,
        |l| {
            add(&mut form(l)["combinations"][0][0][1], 1.0);
        },
    ),
    ("a row too few", Of::Lattice, FaultKind::Lattice, |l| {
        form(l)["rows"].as_array_mut().unwrap().pop();
    }),
    (
        "a row that is too short",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            form(l)["rows"][0].as_array_mut().unwrap().pop();
        },
    ),
    (
        "a diagonal entry that is not positive",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            times(&mut form(l)["rows"][1][0], -1.0);
        },
    ),
    (
        "a form that is larger than the objective",
        Of::Lattice,
        FaultKind::NotConvex,
        |l| {
            times(&mut form(l)["rows"][0][0], 1.0 + 1e-9);
        },
    ),
    (
        "a weight that is too large",
        Of::Lattice,
        FaultKind::NotConvex,
        |l| {
            form(l)["weight"] = json!(0.5 + 1e-12);
        },
    ),
    (
        "a weight that is negative",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            times(&mut form(l)["weight"], -1.0);
        },
    ),
    (
        "a diagonal that is not below its block",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            times(&mut form(l)["diagonals"][1][0], 4.0);
        },
    ),
    (
        "a diagonal too many",
        Of::Lattice,
        FaultKind::Lattice,
        |l| {
            let diagonals = form(l)["diagonals"].as_array_mut().unwrap();
            diagonals.push(json!([0.0]));
        },
    ),
    ("a point is nearer", Of::Lattice, FaultKind::Bound, |l| {
        times(&mut form(l)["square"], 1.0 + 1e-9);
    }),
    (
        "points are further away",
        Of::Lattice,
        FaultKind::Bound,
        |l| {
            form(l)["reach"] = json!(0.25);
        },
    ),
    (
        "an enumeration takes more nodes",
        Of::Lattice,
        FaultKind::Bound,
        |l| {
            form(l)["nodes"] = json!(2);
        },
    ),
    (
        "the curvature is more than there is",
        Of::Lattice,
        FaultKind::NotConvex,
        |l| {
            for curvature in part(l, 0)["curvature"].as_array_mut().unwrap() {
                times(curvature, 2f64.powi(60));
            }
        },
    ),
    (
        "the point is another one",
        Of::Lattice,
        FaultKind::Bound,
        |l| {
            add(&mut lattice(l)["point"][0], 0.125);
        },
    ),
    (
        "a part proves more than its lattice",
        Of::Lattice,
        FaultKind::Bound,
        |l| {
            add(&mut part(l, 0)["lower_bound"], 1e-6);
        },
    ),
];
