//! The elements of a proof that lies alter.

use serde_json::{Value, json};

/// The lines of a proof, as JSON.
pub type Lines = Vec<Value>;

pub const STATEMENT: usize = 1;
pub const CLAIM: usize = 2;
pub const ROOT: usize = 3;
pub const PARTS: usize = 4;
pub const NODES: usize = 5;

pub fn statement(lines: &mut Lines) -> &mut Value {
    &mut lines[STATEMENT]["statement"]
}

pub fn claim(lines: &mut Lines) -> &mut Value {
    &mut lines[CLAIM]["claim"]
}

pub fn root_steps(lines: &mut Lines) -> &mut Vec<Value> {
    lines[ROOT]["root"]["steps"].as_array_mut().unwrap()
}

pub fn part(lines: &mut Lines, number: usize) -> &mut Value {
    &mut lines[PARTS]["parts"][number]
}

/// The first cut.
pub fn cut(lines: &mut Lines) -> &mut Value {
    &mut part(lines, 0)["cuts"][0]
}

/// The first switch.
pub fn switch(lines: &mut Lines) -> &mut Value {
    &mut part(lines, 0)["switches"][0]
}

pub fn nodes(lines: &mut Lines) -> impl Iterator<Item = &mut Value> {
    let count = lines.len();
    lines[NODES..count - 1]
        .iter_mut()
        .map(|line| &mut line["node"])
}

/// The certificates of all nodes.
pub fn certificates(lines: &mut Lines) -> impl Iterator<Item = &mut Value> {
    nodes(lines).filter_map(|node| node.get_mut("certificate"))
}

/// All multipliers of all certificates.
pub fn multipliers(lines: &mut Lines) -> impl Iterator<Item = &mut Value> {
    certificates(lines).flat_map(|c| c["multipliers"].as_array_mut().unwrap())
}

/// The first node that ends in this way.
pub fn node_with<'a>(lines: &'a mut Lines, end: &str) -> &'a mut Value {
    nodes(lines)
        .find(|node| node["end"] == end || node["end"].get(end).is_some())
        .unwrap()
}

/// The first leaf that rows with multipliers show to be empty.
pub fn empty_by_rows(lines: &mut Lines) -> &mut Value {
    let has_rows = |node: &&mut Value| node["end"]["empty"].as_array().is_some_and(|m| m.len() > 1);
    nodes(lines).find(has_rows).unwrap()
}

/// The first step of this kind, anywhere.
pub fn step_of<'a>(lines: &'a mut Lines, kind: &str) -> &'a mut Value {
    let holders = lines.iter_mut().filter_map(|line| {
        let name = ["root", "node"]
            .into_iter()
            .find(|name| line.get(name).is_some());
        line.get_mut(name?)
    });
    let all = holders.filter_map(|holder| holder.get_mut("steps")?.as_array_mut());
    let all = all.flatten();
    let mut found = all.filter_map(|step| step.get_mut(kind));
    found.next().unwrap()
}

pub fn add(value: &mut Value, by: f64) {
    *value = json!(value.as_f64().unwrap() + by);
}

/// Sets the count of the last line to what it has to be.
pub fn recount(lines: &mut Lines) {
    let before = lines.len() - 1;
    lines[before] = json!({ "end": before });
}
