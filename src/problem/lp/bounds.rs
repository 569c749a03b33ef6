//! The section `bounds`.

use super::expression::text_of;
use super::tokens::{Token, Tokens};
use super::words::is_infinity;
use crate::error::Result;
use crate::problem::files::lines::{fault, limited};
use crate::problem::files::names::NameList;

/// The bounds of a variable, with the line that last changed them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    pub lower: f64,
    pub upper: f64,
    pub line: usize,
}

impl Default for Bound {
    fn default() -> Self {
        Bound {
            lower: 0.0,
            upper: f64::INFINITY,
            line: 0,
        }
    }
}

/// Reads one bound: `[number RELATION] NAME [RELATION number]` or `NAME free`.
pub(super) fn bound(tokens: &mut Tokens, names: &NameList, bounds: &mut [Bound]) -> Result<()> {
    let line = tokens.line()?;
    let before = match tokens.peek(0)? {
        Token::Name(name) if !is_infinity(name) => None,
        _ => {
            let number = number(tokens)?;
            Some((number, relation(tokens)?))
        }
    };
    let variable = match tokens.next()? {
        (Token::Name(name), line) => names.find(line, &name)?,
        (token, line) => {
            let message = format!("expected a variable, found {}", text_of(&token));
            return Err(fault(line, message));
        }
    };
    let bound = &mut bounds[variable];
    bound.line = line;
    let mut known = before.is_some();
    if let Some((number, relation)) = before {
        bound.set(-relation, number, line)?;
    }
    match tokens.peek(0)?.clone() {
        Token::Relation(relation) => {
            tokens.next()?;
            bound.set(relation, number(tokens)?, line)?;
            known = true;
        }
        Token::Name(word) if word.eq_ignore_ascii_case("free") && !known => {
            tokens.next()?;
            (bound.lower, bound.upper) = (f64::NEG_INFINITY, f64::INFINITY);
            known = true;
        }
        _ => {}
    }
    if !known {
        let found = text_of(tokens.peek(0)?);
        return Err(fault(
            line,
            format!("expected free, <=, = or >=, found {found}"),
        ));
    }
    Ok(())
}

impl Bound {
    fn set(&mut self, relation: i8, number: f64, line: usize) -> Result<()> {
        if relation >= 0 {
            self.lower = number;
        }
        if relation <= 0 {
            self.upper = number;
        }
        if self.lower == f64::INFINITY || self.upper == f64::NEG_INFINITY {
            return Err(fault(line, "no number meets this bound"));
        }
        Ok(())
    }
}

fn relation(tokens: &mut Tokens) -> Result<i8> {
    match tokens.next()? {
        (Token::Relation(relation), _) => Ok(relation),
        (token, line) => {
            let message = format!("expected <=, = or >=, found {}", text_of(&token));
            Err(fault(line, message))
        }
    }
}

/// Reads a number with signs, which may be infinite.
fn number(tokens: &mut Tokens) -> Result<f64> {
    let (_, sign) = super::expression::signs(tokens)?;
    match tokens.next()? {
        (Token::Number(number), _) => Ok(limited(sign * number)),
        (Token::Name(word), _) if is_infinity(&word) => Ok(sign * f64::INFINITY),
        (token, line) => Err(fault(
            line,
            format!("expected a number, found {}", text_of(&token)),
        )),
    }
}
