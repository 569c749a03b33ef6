//! Reading: the tokens of the sections become a problem.

use std::io::BufRead;

use super::bounds::{Bound, bound};
use super::expression::{Place, expression, text_of};
use super::rows::{Row, label, row};
use super::tokens::{Token, Tokens};
use super::words::Section;
use crate::error::{Error, Result};
use crate::problem::files::NamedProblem;
use crate::problem::files::draft::Draft;
use crate::problem::files::lines::{fault, quoted, unsupported};
use crate::problem::files::names::NameList;

/// Reads plain text.
pub(super) fn parse_text(reader: &mut dyn BufRead) -> Result<NamedProblem> {
    let mut tokens = Tokens::new(reader);
    let mut names = NameList::new("variable");
    let mut draft = read_objective(&mut tokens, &mut names)?;
    read_rows(&mut tokens, &mut names, &mut draft)?;
    draft.integer = vec![false; names.len()];
    let mut bounds = vec![Bound::default(); names.len()];
    loop {
        let line = tokens.line()?;
        match tokens.next()?.0 {
            Token::Section(Section::Bounds, _) => {
                while !ends(&mut tokens)? {
                    bound(&mut tokens, &names, &mut bounds)?;
                }
            }
            Token::Section(kind @ (Section::General | Section::Binary), _) => {
                read_integers(&mut tokens, &names, kind, &mut draft, &mut bounds)?;
            }
            Token::Section(Section::End, _) => break,
            // HiGHS writes the headers of sections that are empty.
            Token::Section(Section::Other, _) if ends(&mut tokens)? => {}
            Token::Section(Section::Other, word) => {
                return Err(unsupported(
                    line,
                    format!("section {}", quoted(&word)),
                    None,
                ));
            }
            Token::EndOfFile => return Err(fault(line, "the file ends without `end`")),
            token => {
                let message = format!("{} may not stand here", text_of(&token));
                return Err(fault(line, message));
            }
        }
    }
    let (token, line) = tokens.next()?;
    if token != Token::EndOfFile {
        return Err(fault(
            line,
            format!("{} stands behind `end`", text_of(&token)),
        ));
    }
    set_bounds(&mut draft, &names, bounds)?;
    draft.linear.resize(names.len(), 0.0);
    draft.variables = names.into_vec();
    draft.into_problem()
}

fn read_objective(tokens: &mut Tokens, names: &mut NameList) -> Result<Draft> {
    let line = tokens.line()?;
    let maximise = match tokens.next()?.0 {
        Token::Section(Section::Minimize, _) => false,
        Token::Section(Section::Maximize, _) => true,
        Token::EndOfFile => return Err(fault(line, "the file is empty")),
        token => {
            let message = format!("expected minimize or maximize, found {}", text_of(&token));
            return Err(fault(line, message));
        }
    };
    let mut draft = Draft {
        maximise,
        ..Draft::default()
    };
    draft.objective = label(tokens)?;
    let line = tokens.line()?;
    let sum = expression(tokens, names, Place::Objective(&mut draft.quadratic))?;
    draft.constant = sum.constant.unwrap_or(0.0);
    draft.linear = vec![0.0; names.len()];
    for (j, value) in sum.terms {
        draft.linear[j] += value;
    }
    if !draft.constant.is_finite() || draft.linear.iter().any(|value| !value.is_finite()) {
        return Err(fault(line, "the objective has an infinite term"));
    }
    Ok(draft)
}

fn read_rows(tokens: &mut Tokens, names: &mut NameList, draft: &mut Draft) -> Result<()> {
    let line = tokens.line()?;
    match tokens.next()?.0 {
        Token::Section(Section::SubjectTo, _) => {}
        token => {
            let message = format!("expected subject to, found {}", text_of(&token));
            return Err(fault(line, message));
        }
    }
    let mut labels = NameList::new("row");
    if draft.objective.is_empty() {
        draft.objective = "OBJ".into();
    }
    labels.insert(line, &draft.objective)?;
    let mut unnamed = Vec::new();
    while !ends(tokens)? {
        let Row {
            draft: row,
            terms,
            line,
        } = row(tokens, names)?;
        if row.name.is_empty() {
            unnamed.push(draft.rows.len());
        } else {
            labels.insert(line, &row.name)?;
        }
        for (j, value) in terms.into_iter().filter(|(_, value)| *value != 0.0) {
            draft.entries.0.push(draft.rows.len());
            draft.entries.1.push(j);
            draft.entries.2.push(value);
        }
        draft.rows.push(row);
    }
    // Rows without a name get one that no row has.
    for i in unnamed {
        let mut name = format!("R{}", i + 1);
        while labels.number(&name).is_some() {
            name.push('_');
        }
        labels.insert(line, &name)?;
        draft.rows[i].name = name;
    }
    Ok(())
}

/// Reads the names of integer or binary unknowns.
fn read_integers(
    tokens: &mut Tokens,
    names: &NameList,
    kind: Section,
    draft: &mut Draft,
    bounds: &mut [Bound],
) -> Result<()> {
    while !ends(tokens)? {
        let variable = match tokens.next()? {
            (Token::Name(name), line) => (names.find(line, &name)?, line),
            (token, line) => {
                let message = format!("expected a variable, found {}", text_of(&token));
                return Err(fault(line, message));
            }
        };
        let (variable, line) = variable;
        draft.integer[variable] = true;
        if kind == Section::Binary {
            let bound = &mut bounds[variable];
            bound.lower = bound.lower.max(0.0);
            bound.upper = bound.upper.min(1.0);
            bound.line = line;
        }
    }
    Ok(())
}

/// Whether a section or the file ends here.
fn ends(tokens: &mut Tokens) -> Result<bool> {
    Ok(matches!(
        tokens.peek(0)?,
        Token::Section(..) | Token::EndOfFile
    ))
}

fn set_bounds(draft: &mut Draft, names: &NameList, bounds: Vec<Bound>) -> Result<()> {
    if names.len() == 0 {
        return Err(Error::Empty);
    }
    for (j, bound) in bounds.iter().enumerate() {
        if bound.lower > bound.upper {
            let message = format!(
                "variable {} has the lower bound {} above the upper bound {}; without a lower bound in the \
                 file it is 0",
                quoted(names.name(j)),
                bound.lower,
                bound.upper
            );
            return Err(fault(bound.line, message));
        }
    }
    draft.lower = bounds.iter().map(|bound| bound.lower).collect();
    draft.upper = bounds.iter().map(|bound| bound.upper).collect();
    Ok(())
}
