//! The rows of the section `subject to`.

use super::expression::{Expression, Place, expression, text_of};
use super::tokens::{Token, Tokens};
use crate::error::Result;
use crate::problem::files::draft::DraftRow;
use crate::problem::files::lines::{fault, limited, unsupported};
use crate::problem::files::names::NameList;

/// A row and its terms.
pub(super) struct Row {
    /// The name, which is empty unless given.
    pub draft: DraftRow,
    pub terms: Vec<(usize, f64)>,
    pub line: usize,
}

/// Reads `[NAME :] a RELATION b [RELATION c]`, of which exactly one is no number.
pub(super) fn row(tokens: &mut Tokens, names: &mut NameList) -> Result<Row> {
    let line = tokens.line()?;
    let name = label(tokens)?;
    let mut parts = vec![expression(tokens, names, Place::Row)?];
    let mut relations = Vec::new();
    while let Token::Relation(relation) = *tokens.peek(0)? {
        let line = tokens.next()?.1;
        if relations.len() == 2 {
            return Err(fault(line, "a third relation in one row"));
        }
        relations.push(relation);
        parts.push(operand(tokens, names)?);
        let last = parts.len() - 1;
        if parts[last].terms.is_empty() && parts[last].constant.is_none() {
            let found = text_of(tokens.peek(0)?);
            return Err(fault(
                line,
                format!("expected a number or an expression, found {found}"),
            ));
        }
    }
    let end = tokens.line()?;
    match tokens.peek(0)? {
        Token::Arrow => return Err(unsupported(end, "an indicator", None)),
        token if relations.is_empty() => {
            let message = format!("expected <=, = or >= in a row, found {}", text_of(token));
            return Err(fault(end, message));
        }
        _ => {}
    }
    let (terms, lower, upper) = sides(line, parts, &relations)?;
    Ok(Row {
        draft: DraftRow {
            name,
            lower,
            upper,
            equality: relations == [0],
        },
        terms,
        line,
    })
}

/// Reads what stands behind a relation: a number, or an expression that goes on while signs do.
fn operand(tokens: &mut Tokens, names: &mut NameList) -> Result<Expression> {
    let (mut at, mut sign) = (0, 1.0);
    while let Token::Sign(c @ ('+' | '-')) = *tokens.peek(at)? {
        sign = if c == '-' { -sign } else { sign };
        at += 1;
    }
    // A right side ends its row: no term follows a number.
    let number = match tokens.peek(at)? {
        Token::Number(number) => Some(*number),
        Token::Name(name) if super::words::is_infinity(name) => Some(f64::INFINITY),
        _ => None,
    };
    let Some(number) = number else {
        return expression(tokens, names, Place::Row);
    };
    let starts_term = match (tokens.peek(at + 1)?.clone(), tokens.peek(at + 2)?) {
        (Token::Name(_), Token::Sign(':')) => false,
        // `3 <= 2 x <= 5`: a coefficient, since a relation or a further term comes behind the name.
        (Token::Name(_), _) => tokens.same_line(at, at + 1),
        _ => false,
    };
    if starts_term {
        return expression(tokens, names, Place::Row);
    }
    for _ in 0..=at {
        tokens.next()?;
    }
    Ok(Expression {
        terms: Vec::new(),
        constant: Some(sign * number),
    })
}

/// Reads `NAME :` if it is there.
pub(super) fn label(tokens: &mut Tokens) -> Result<String> {
    let is_label = *tokens.peek(1)? == Token::Sign(':');
    match tokens.peek(0)?.clone() {
        Token::Name(name) if is_label => {
            tokens.next()?;
            tokens.next()?;
            Ok(name)
        }
        _ => Ok(String::new()),
    }
}

/// Unknowns and their coefficients.
type Terms = Vec<(usize, f64)>;

/// The terms of a row, and its two sides.
fn sides(line: usize, mut parts: Vec<Expression>, relations: &[i8]) -> Result<(Terms, f64, f64)> {
    let linear = parts.iter().filter(|part| !part.terms.is_empty()).count();
    let at = parts.iter().position(|part| !part.terms.is_empty());
    let (Some(at), 1) = (at, linear) else {
        return Err(fault(
            line,
            "a row needs variables, on one side of its relations",
        ));
    };
    if parts.len() == 3 && (at != 1 || relations[0] != relations[1] || relations[0] == 0) {
        let message = "a row with two sides is `number <= expression <= number`, or with >= twice";
        return Err(fault(line, message));
    }
    let part = parts.remove(at);
    if part.constant.is_some_and(f64::is_infinite) {
        return Err(fault(line, "an infinite number is no term"));
    }
    let [mut lower, mut upper] = [f64::NEG_INFINITY, f64::INFINITY];
    for (k, (side, relation)) in parts.iter().zip(relations).enumerate() {
        // A constant beside the variables goes to the other side. Without one nothing is rounded.
        let number = side.constant.unwrap_or(0.0);
        let number = part.constant.map_or(number, |c| number - c);
        // The relation as it reads with the expression on its left.
        let relation = if k < at { -relation } else { *relation };
        let number = if relation == 0 {
            number
        } else {
            limited(number)
        };
        if relation >= 0 {
            lower = number;
        }
        if relation <= 0 {
            upper = number;
        }
    }
    if lower == f64::INFINITY || upper == f64::NEG_INFINITY || lower > upper {
        return Err(fault(
            line,
            format!("no number is between {lower} and {upper}"),
        ));
    }
    Ok((part.terms, lower, upper))
}
