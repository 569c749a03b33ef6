//! Reading: the records become a problem.

use std::collections::HashSet;
use std::io::BufRead;

use super::kind::{Kind, Unknowns};
use super::records::{Records, filled};
use crate::error::{Error, Result};
use crate::problem::files::NamedProblem;
use crate::problem::files::draft::{Draft, DraftRow};
use crate::problem::files::lines::{fault, quoted, unsupported};
use crate::problem::files::names::{check_name, check_title};

/// Reads plain text.
pub(super) fn parse_text(reader: &mut dyn BufRead) -> Result<NamedProblem> {
    let mut records = Records::new(reader);
    let record = records.expect("the name")?;
    let title = record.word(0)?.to_owned();
    check_title(&title).map_err(|reason| fault(record.line, reason))?;
    let kind = Kind::read(&records.expect("the problem type")?)?;
    let maximise = read_sense(&mut records)?;
    let variables = records.size("variables")?;
    if variables == 0 {
        return Err(Error::Empty);
    }
    let rows = if kind.constraints {
        records.size("constraints")?
    } else {
        0
    };
    let mut draft = Draft {
        title,
        objective: "OBJ".into(),
        maximise,
        ..Draft::default()
    };
    read_objective(&mut records, &kind, variables, &mut draft)?;
    if kind.quadratic_constraints {
        refuse_quadratic(&mut records, rows, variables)?;
    }
    let mut seen = HashSet::new();
    if kind.constraints {
        records.sparse(
            "the constraint matrix",
            [rows, variables],
            |line, [i, j], value| {
                is_new(line, &mut seen, (i, j))?;
                draft.entries.0.push(i);
                draft.entries.1.push(j);
                draft.entries.2.push(value);
                Ok(())
            },
        )?;
    }
    let record = records.expect("the value of infinity")?;
    let infinity = record.value(0)?;
    if infinity <= 0.0 {
        let message = format!("the value of infinity is {infinity}, which is not above 0");
        return Err(fault(record.line, message));
    }
    let sides = if kind.constraints {
        read_limits(&mut records, infinity, "sides of constraints", rows)?
    } else {
        Vec::new()
    };
    let row = |(i, (lower, upper)): (usize, (f64, f64))| DraftRow {
        name: format!("c{}", i + 1),
        lower,
        upper,
        equality: lower == upper,
    };
    draft.rows = sides.into_iter().enumerate().map(row).collect();
    let bounds = match kind.unknowns {
        Unknowns::Binary => filled(variables, (0.0, 1.0))?,
        _ => read_limits(&mut records, infinity, "bounds", variables)?,
    };
    (draft.lower, draft.upper) = bounds.into_iter().unzip();
    draft.integer = filled(variables, kind.unknowns != Unknowns::Continuous)?;
    if kind.unknowns == Unknowns::Mixed {
        read_types(&mut records, &mut draft)?;
    }
    draft.variables = (1..=variables).map(|j| format!("x{j}")).collect();
    read_starts(&mut records, &kind, &draft)?;
    read_names(&mut records, &mut draft)?;
    draft.into_problem()
}

fn read_sense(records: &mut Records) -> Result<bool> {
    let record = records.expect("the sense")?;
    let word = record.word(0)?;
    match word.to_ascii_lowercase().as_str() {
        "minimize" | "min" => Ok(false),
        "maximize" | "max" => Ok(true),
        _ => {
            let message = format!("expected minimize or maximize, found {}", quoted(word));
            Err(fault(record.line, message))
        }
    }
}

fn is_new(line: usize, seen: &mut HashSet<(usize, usize)>, (i, j): (usize, usize)) -> Result<()> {
    if seen.insert((i, j)) {
        return Ok(());
    }
    let message = format!("the entry ({}, {}) is given twice", i + 1, j + 1);
    Err(fault(line, message))
}

fn read_objective(
    records: &mut Records,
    kind: &Kind,
    variables: usize,
    draft: &mut Draft,
) -> Result<()> {
    if kind.quadratic_objective {
        let mut seen = HashSet::new();
        records.sparse("Q", [variables; 2], |line, [i, j], value| {
            // The lower triangle, though some files hold the upper.
            is_new(line, &mut seen, (i.max(j), i.min(j)))?;
            draft.quadratic.push(line, i, j, value);
            Ok(())
        })?;
    }
    draft.linear = records.vector("the linear objective", variables)?;
    draft.constant = records.number("the constant of the objective")?;
    Ok(())
}

/// Reads the quadratic terms of constraints, of which there must be none.
fn refuse_quadratic(records: &mut Records, rows: usize, variables: usize) -> Result<()> {
    let limits = [rows, variables, variables];
    records.sparse("quadratic constraints", limits, |line, [i, _, _], _| {
        let what = format!("constraint {} is a quadratic constraint", i + 1);
        Err(unsupported(line, what, Some(i)))
    })
}

/// Reads lower and upper limits, where `infinity` and beyond is none.
fn read_limits(
    records: &mut Records,
    infinity: f64,
    what: &str,
    len: usize,
) -> Result<Vec<(f64, f64)>> {
    let lower = records.vector(&format!("lower {what}"), len)?;
    let upper = records.vector(&format!("upper {what}"), len)?;
    let limit = |value: f64| match value {
        _ if value >= infinity => f64::INFINITY,
        _ if value <= -infinity => f64::NEG_INFINITY,
        _ => value,
    };
    let limits = lower.into_iter().zip(upper);
    let limits: Vec<(f64, f64)> = limits.map(|(l, u)| (limit(l), limit(u))).collect();
    let excludes_all = |&(l, u): &(f64, f64)| l == f64::INFINITY || u == f64::NEG_INFINITY;
    match limits.iter().position(excludes_all) {
        Some(i) => Err(Error::InvalidArgument {
            what: format!("{what}: number {} is infinite on the wrong side", i + 1),
            index: Some(i),
        }),
        None => Ok(limits),
    }
}

/// Reads the type of each unknown: 0 is continuous, 1 integer, 2 binary.
fn read_types(records: &mut Records, draft: &mut Draft) -> Result<()> {
    let types = records.vector("types of variables", draft.lower.len())?;
    for (j, kind) in types.into_iter().enumerate() {
        draft.integer[j] = match kind {
            0.0 => false,
            1.0 => true,
            2.0 => {
                draft.lower[j] = draft.lower[j].max(0.0);
                draft.upper[j] = draft.upper[j].min(1.0);
                true
            }
            _ => {
                return Err(Error::InvalidArgument {
                    what: format!("variable {} is of type {kind}, not 0, 1 or 2", j + 1),
                    index: Some(j),
                });
            }
        };
    }
    Ok(())
}

/// Reads starting points, which are not kept. A file may end before any of them.
fn read_starts(records: &mut Records, kind: &Kind, draft: &Draft) -> Result<()> {
    let (variables, rows) = (draft.variables.len(), draft.rows.len());
    let starts = [
        ("starting values", variables),
        ("starting multipliers", rows),
        ("starting dual variables", variables),
    ];
    for (k, (what, len)) in starts.into_iter().enumerate() {
        if k == 1 && !kind.constraints {
            continue;
        }
        match records.next()? {
            None => return Ok(()),
            Some(default) => drop(default.value(0)?),
        }
        records.sparse(what, [len], |_, _, _| Ok(()))?;
    }
    Ok(())
}

/// Reads the names of variables and of constraints, at which the file may end.
fn read_names(records: &mut Records, draft: &mut Draft) -> Result<()> {
    let line = read_list(records, &mut draft.variables)?;
    all_differ(line, &draft.variables)?;
    let mut rows: Vec<String> = draft.rows.iter().map(|row| row.name.clone()).collect();
    let line = read_list(records, &mut rows)?;
    all_differ(line, &rows)?;
    while rows.contains(&draft.objective) {
        draft.objective.push('_');
    }
    for (row, name) in draft.rows.iter_mut().zip(rows) {
        row.name = name;
    }
    Ok(())
}

/// Reads a count of names and as many lines `INDEX NAME`. Returns the last line.
fn read_list(records: &mut Records, names: &mut [String]) -> Result<usize> {
    let (mut last, count) = match records.next()? {
        None => return Ok(1),
        Some(record) => (record.line, record.count(0)?),
    };
    for _ in 0..count {
        let record = records.expect("names")?;
        let (index, name) = (record.index(0, names.len())?, record.word(1)?);
        last = record.line;
        check_name(name).map_err(|reason| fault(last, reason))?;
        names[index] = name.to_owned();
    }
    Ok(last)
}

fn all_differ(line: usize, names: &[String]) -> Result<()> {
    let mut seen = HashSet::with_capacity(names.len());
    match names.iter().find(|name| !seen.insert(name.as_str())) {
        None => Ok(()),
        Some(name) => Err(fault(line, format!("two are named {}", quoted(name)))),
    }
}
