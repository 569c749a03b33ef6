//! The planted lies: what is altered in a proof, and the fault that must be found.

use roundel::proof::FaultKind;
use serde_json::{Value, json};

use crate::altered::{
    CLAIM, Lines, PARTS, ROOT, add, certificates, claim, empty_by_rows, multipliers, node_with,
    nodes, part, recount, root_steps, statement, step_of,
};

/// Which proof is altered.
#[derive(Clone, Copy, PartialEq)]
pub enum Of {
    /// Two parts with a bound.
    Small,
    /// A tree without a point.
    Empty,
    /// An objective after the perspective reformulation.
    Switched,
    /// A tree from the multipliers of a flow.
    OddCycle,
    /// A tree with cuts.
    Lots,
    /// The closest points of two lattices.
    Lattice,
    /// What may move for ever.
    Translated,
}

/// What is altered, the fault that must be found, and the alteration.
pub type Lie = (&'static str, Of, FaultKind, fn(&mut Lines));

pub const LIES: [Lie; 64] = [
    // The file.
    ("the end is missing", Of::Small, FaultKind::Format, |l| {
        l.pop();
    }),
    ("another version", Of::Small, FaultKind::Format, |l| {
        l[0] = json!({ "roundel_proof": 2 });
    }),
    (
        "a wrong count of lines",
        Of::Small,
        FaultKind::Format,
        |l| {
            *l.last_mut().unwrap() = json!({ "end": 3 });
        },
    ),
    ("an unknown word", Of::Small, FaultKind::Format, |l| {
        statement(l)["trusted"] = json!(true);
    }),
    (
        "claim and root change places",
        Of::Small,
        FaultKind::Format,
        |l| {
            l.swap(CLAIM, ROOT);
        },
    ),
    ("a node too many", Of::Small, FaultKind::Format, |l| {
        let end = l.len() - 1;
        l.insert(end, json!({ "node": { "end": { "empty": [] } } }));
        recount(l);
    }),
    (
        "the last leaf is dropped",
        Of::Small,
        FaultKind::Format,
        |l| {
            l.remove(l.len() - 2);
            recount(l);
        },
    ),
    ("a value is no number", Of::Small, FaultKind::Format, |l| {
        claim(l)["values"][0] = json!("NaN");
    }),
    // Rows and unknowns that do not exist.
    (
        "a step by a row that is not there",
        Of::Small,
        FaultKind::Reference,
        |l| {
            step_of(l, "upper")[0] = json!(99);
        },
    ),
    (
        "a multiplier of a row that is not there",
        Of::Small,
        FaultKind::Reference,
        |l| {
            multipliers(l).next().unwrap()[0] = json!(99);
        },
    ),
    (
        "a branch on an unknown that is not there",
        Of::Small,
        FaultKind::Reference,
        |l| {
            node_with(l, "branch")["end"]["branch"][0] = json!(99);
        },
    ),
    (
        "a part of an unknown that is not there",
        Of::Small,
        FaultKind::Reference,
        |l| {
            part(l, 0)["unknowns"][0] = json!(99);
        },
    ),
    (
        "a row of an unknown that is not there",
        Of::Small,
        FaultKind::Reference,
        |l| {
            statement(l)["inequalities"][0]["terms"][0][0] = json!(99);
        },
    ),
    (
        "an integer that is not there",
        Of::Small,
        FaultKind::Reference,
        |l| {
            statement(l)["integers"][0] = json!(99);
        },
    ),
    // The statement.
    (
        "a square of negative weight",
        Of::Small,
        FaultKind::Statement,
        |l| {
            statement(l)["least_squares"][0]["weight"] = json!(-1.0);
        },
    ),
    (
        "an entry of Q above the diagonal",
        Of::Small,
        FaultKind::Statement,
        |l| {
            statement(l)["quadratic"][1] = json!([3, 4, 0.5]);
        },
    ),
    (
        "more unknowns than memory",
        Of::Small,
        FaultKind::Statement,
        |l| {
            statement(l)["variables"] = json!(1_u64 << 60);
        },
    ),
    // The point.
    (
        "an integer of the point is none",
        Of::Small,
        FaultKind::Point,
        |l| {
            add(&mut claim(l)["values"][0], 0.5);
        },
    ),
    (
        "an integer of the point is off by one",
        Of::Small,
        FaultKind::Point,
        |l| {
            add(&mut claim(l)["values"][5], 1.0);
        },
    ),
    (
        "a real of the point misses a row",
        Of::Small,
        FaultKind::Point,
        |l| {
            add(&mut claim(l)["values"][2], 1000.0);
        },
    ),
    (
        "an unknown of the point leaves its bounds",
        Of::Small,
        FaultKind::Point,
        |l| {
            claim(l)["values"][0] = json!(11.0);
        },
    ),
    ("a pinned unknown moves", Of::Small, FaultKind::Point, |l| {
        add(&mut claim(l)["values"][6], 1e-6);
    }),
    (
        "the point lacks a value",
        Of::Small,
        FaultKind::Point,
        |l| {
            claim(l)["values"].as_array_mut().unwrap().pop();
        },
    ),
    ("there is no point", Of::Small, FaultKind::Point, |l| {
        claim(l)["values"] = Value::Null;
        claim(l)["energy"] = Value::Null;
    }),
    // Its energy.
    ("the energy is too low", Of::Small, FaultKind::Energy, |l| {
        add(&mut claim(l)["energy"], -1e-9);
    }),
    (
        "the energy is that of another point",
        Of::Small,
        FaultKind::Energy,
        |l| {
            add(&mut claim(l)["values"][2], -0.125);
        },
    ),
    (
        "the energy is that of another objective",
        Of::Small,
        FaultKind::Energy,
        |l| {
            add(&mut statement(l)["constant"], 0.5);
        },
    ),
    // Steps.
    (
        "a bound is tighter than its row implies",
        Of::Small,
        FaultKind::Step,
        |l| {
            add(&mut step_of(l, "upper")[2], -1.0);
        },
    ),
    (
        "a bound is implied by another row",
        Of::Small,
        FaultKind::Step,
        |l| {
            step_of(l, "upper")[0] = json!(1);
        },
    ),
    (
        "a bound of an integer is a fraction",
        Of::Small,
        FaultKind::Step,
        |l| {
            root_steps(l).push(json!({ "upper": [0, 5, 5.5] }));
        },
    ),
    (
        "the side of a row is rounded too far",
        Of::Small,
        FaultKind::Step,
        |l| {
            add(&mut step_of(l, "row_upper")[1], -2.0);
        },
    ),
    (
        "the side of a row with a real is rounded",
        Of::Small,
        FaultKind::Step,
        |l| {
            root_steps(l).push(json!({ "row_upper": [1, 12.0] }));
        },
    ),
    (
        "the side of a row changes within a tree",
        Of::Small,
        FaultKind::Step,
        |l| {
            node_with(l, "branch")["steps"] = json!([{ "row_upper": [2, 6.0] }]);
        },
    ),
    (
        "a bound of an unknown that the row lacks",
        Of::Small,
        FaultKind::Step,
        |l| {
            root_steps(l).push(json!({ "upper": [2, 0, 9.0] }));
        },
    ),
    (
        "a row lacks the side that a step needs",
        Of::Small,
        FaultKind::Step,
        |l| {
            statement(l)["inequalities"][1]["upper"] = Value::Null;
        },
    ),
    // Parts.
    (
        "an unknown is in no part",
        Of::Small,
        FaultKind::Parts,
        |l| {
            let unknowns = part(l, 0)["unknowns"].as_array_mut().unwrap();
            unknowns.pop();
        },
    ),
    (
        "an unknown is in two parts",
        Of::Small,
        FaultKind::Parts,
        |l| {
            let shared = part(l, 0)["unknowns"][0].clone();
            part(l, 1)["unknowns"].as_array_mut().unwrap().push(shared);
        },
    ),
    (
        "a fixed unknown is in a part",
        Of::Small,
        FaultKind::Parts,
        |l| {
            part(l, 0)["unknowns"]
                .as_array_mut()
                .unwrap()
                .push(json!(6));
        },
    ),
    (
        "an unknown that is not fixed is in no part",
        Of::Small,
        FaultKind::Parts,
        |l| {
            statement(l)["pins"] = json!([]);
        },
    ),
    (
        "parts are coupled by the objective",
        Of::Small,
        FaultKind::Parts,
        |l| {
            let moved = part(l, 0)["unknowns"].as_array_mut().unwrap().pop();
            let own =
                json!({ "unknowns": [moved.unwrap()], "curvature": [0.0], "lower_bound": 0.0 });
            l[PARTS]["parts"].as_array_mut().unwrap().push(own);
        },
    ),
    // Convexity.
    ("Q curves downwards", Of::Small, FaultKind::NotConvex, |l| {
        // The point has zero there, so that its energy stays.
        let values = claim(l)["values"].clone();
        let zero = (3..6).find(|&j| values[j] == 0.0).unwrap();
        let entry = json!([zero, zero, -9.0]);
        statement(l)["quadratic"]
            .as_array_mut()
            .unwrap()
            .push(entry);
    }),
    (
        "more curvature than there is",
        Of::Small,
        FaultKind::NotConvex,
        |l| {
            part(l, 0)["curvature"][0] = json!(64.0);
        },
    ),
    (
        "less curvature than the bound needs",
        Of::Small,
        FaultKind::Bound,
        |l| {
            part(l, 0)["curvature"][0] = json!(-4.0);
        },
    ),
    (
        "a curvature that is no power of two",
        Of::Small,
        FaultKind::Certificate,
        |l| {
            part(l, 0)["curvature"][2] = json!(0.1);
        },
    ),
    // Branches.
    ("a branch on a real", Of::Small, FaultKind::Branch, |l| {
        node_with(l, "branch")["end"]["branch"][0] = json!(2);
    }),
    (
        "a branch between integers",
        Of::Small,
        FaultKind::Branch,
        |l| {
            add(&mut node_with(l, "branch")["end"]["branch"][1], 0.5);
        },
    ),
    (
        "a branch is one integer off",
        Of::Small,
        FaultKind::Bound,
        |l| {
            add(&mut node_with(l, "branch")["end"]["branch"][1], 1.0);
        },
    ),
    // Certificates.
    (
        "a multiplier holds a side that is not there",
        Of::Small,
        FaultKind::Certificate,
        |l| {
            let mut held = multipliers(l).filter(|m| m[0] == 1);
            let by = &mut held.next().unwrap()[1];
            *by = json!(-by.as_f64().unwrap());
        },
    ),
    (
        "multipliers have the other sign",
        Of::Small,
        FaultKind::Bound,
        |l| {
            for held in multipliers(l).filter(|m| m[0] == 0) {
                held[1] = json!(-held[1].as_f64().unwrap());
            }
        },
    ),
    (
        "multipliers are tripled",
        Of::Small,
        FaultKind::Bound,
        |l| {
            for held in multipliers(l) {
                held[1] = json!(3.0 * held[1].as_f64().unwrap());
            }
        },
    ),
    (
        "multipliers are left out",
        Of::Small,
        FaultKind::Bound,
        |l| {
            certificates(l).for_each(|c| c["multipliers"] = json!([]));
        },
    ),
    (
        "the points of certificates are elsewhere",
        Of::Small,
        FaultKind::Bound,
        |l| {
            certificates(l).for_each(|c| add(&mut c["point"][0], 2.0));
        },
    ),
    (
        "the point of a certificate lacks a value",
        Of::Small,
        FaultKind::Certificate,
        |l| {
            let first = certificates(l).next().unwrap();
            first["point"].as_array_mut().unwrap().pop();
        },
    ),
    (
        "a fraction has no denominator",
        Of::Small,
        FaultKind::Certificate,
        |l| {
            certificates(l).next().unwrap()["point"][0] = json!("1/0");
        },
    ),
    (
        "certificates are left out",
        Of::Small,
        FaultKind::Certificate,
        |l| {
            for node in nodes(l) {
                node.as_object_mut().unwrap().remove("certificate");
            }
        },
    ),
    // Bounds and claims.
    (
        "the bound of a part is too high",
        Of::Small,
        FaultKind::Bound,
        |l| {
            add(&mut part(l, 0)["lower_bound"], 1e-6);
        },
    ),
    (
        "the bound of all is too high",
        Of::Small,
        FaultKind::Claim,
        |l| {
            add(&mut claim(l)["lower_bound"], 1e-6);
        },
    ),
    (
        "leaves are called empty",
        Of::Small,
        FaultKind::NotEmpty,
        |l| {
            node_with(l, "bound")["end"] = json!({ "empty": [] });
        },
    ),
    (
        "an empty leaf's multipliers are left out",
        Of::Empty,
        FaultKind::NotEmpty,
        |l| {
            empty_by_rows(l)["end"] = json!({ "empty": [] });
        },
    ),
    (
        "an empty leaf's multiplier holds no side",
        Of::Empty,
        FaultKind::Certificate,
        |l| {
            for held in empty_by_rows(l)["end"]["empty"].as_array_mut().unwrap() {
                held[1] = json!(-held[1].as_f64().unwrap());
            }
        },
    ),
    (
        "an empty leaf's multiplier is zero",
        Of::Empty,
        FaultKind::NotEmpty,
        |l| {
            let held = empty_by_rows(l)["end"]["empty"].as_array_mut().unwrap();
            held.retain(|held| held[0] == 5);
        },
    ),
    (
        "the root is called empty",
        Of::Empty,
        FaultKind::NotEmpty,
        |l| {
            l[ROOT]["root"]["empty"] = json!([[0, 1.0], [5, -1.0]]);
            l.truncate(PARTS);
            l.push(Value::Null);
            recount(l);
        },
    ),
    (
        "a tree without a point has a leaf with a bound",
        Of::Empty,
        FaultKind::NotEmpty,
        |l| {
            empty_by_rows(l)["end"] = json!("bound");
        },
    ),
    (
        "a part without a point is left out",
        Of::Empty,
        FaultKind::Parts,
        |l| {
            l.truncate(PARTS);
            l.extend([json!({ "parts": [] }), Value::Null]);
            recount(l);
        },
    ),
];
