//! Linear expressions, and the quadratic part of the objective.

use super::tokens::{Token, Tokens};
use super::words::is_infinity;
use crate::error::Result;
use crate::problem::files::draft::Entries;
use crate::problem::files::lines::{fault, quoted, unsupported};
use crate::problem::files::names::NameList;

/// The sum of terms and a constant.
#[derive(Debug, Default)]
pub(super) struct Expression {
    /// Variables and coefficients, in the order of the file.
    pub terms: Vec<(usize, f64)>,
    /// The sum of the numbers without a variable, if there are any.
    pub constant: Option<f64>,
}

/// Where an expression stands, and with it which quadratic terms are allowed.
pub(super) enum Place<'a> {
    Objective(&'a mut Entries),
    Row,
}

/// A name of a variable, which is new unless known.
pub(super) fn variable(names: &mut NameList, line: usize, name: &str) -> Result<usize> {
    match names.number(name) {
        Some(number) => Ok(number),
        None => names.insert(line, name),
    }
}

/// Reads `+` and `-`, and returns whether there was one and the sign of their product.
pub(super) fn signs(tokens: &mut Tokens) -> Result<(bool, f64)> {
    let mut found = (false, 1.0);
    loop {
        match tokens.peek(0)? {
            Token::Sign('+') => found.0 = true,
            Token::Sign('-') => found = (true, -found.1),
            _ => return Ok(found),
        }
        tokens.next()?;
    }
}

/// Reads a sum of terms, up to the first token that cannot go on with it.
pub(super) fn expression(
    tokens: &mut Tokens,
    names: &mut NameList,
    mut place: Place,
) -> Result<Expression> {
    let mut sum = Expression::default();
    let mut first = true;
    loop {
        let (signed, sign) = signs(tokens)?;
        if !signed && !first {
            return Ok(sum);
        }
        let line = tokens.line()?;
        match (tokens.peek(0)?.clone(), &mut place) {
            (Token::Number(number), _) => {
                tokens.next()?;
                match tokens.peek(0)?.clone() {
                    Token::Name(name) if *tokens.peek(1)? != Token::Sign(':') => {
                        tokens.next()?;
                        sum.terms
                            .push((variable(names, line, &name)?, sign * number));
                    }
                    _ => sum.add(sign * number),
                }
            }
            (Token::Name(name), _) if is_infinity(&name) => {
                tokens.next()?;
                sum.add(sign * f64::INFINITY);
            }
            (Token::Name(name), _) => {
                tokens.next()?;
                sum.terms.push((variable(names, line, &name)?, sign));
            }
            (Token::Sign('['), Place::Objective(quadratic)) => {
                tokens.next()?;
                quadratic_terms(tokens, names, sign, quadratic)?;
            }
            (Token::Sign('['), Place::Row) => {
                return Err(unsupported(line, "a quadratic constraint", None));
            }
            (token, _) if signed => {
                let message = format!("expected a term, found {}", text_of(&token));
                return Err(fault(line, message));
            }
            _ => return Ok(sum),
        }
        first = false;
    }
}

impl Expression {
    fn add(&mut self, number: f64) {
        self.constant = Some(self.constant.map_or(number, |sum| sum + number));
    }
}

/// Reads `TERMS ] / 2`, where each term is `[NUMBER] x ^ 2` or `[NUMBER] x * y`.
fn quadratic_terms(
    tokens: &mut Tokens,
    names: &mut NameList,
    outer: f64,
    quadratic: &mut Entries,
) -> Result<()> {
    let wrong = |what: &str, (token, line): (Token, usize)| {
        fault(line, format!("expected {what}, found {}", text_of(&token)))
    };
    while !tokens.take(']')? {
        let (_, sign) = signs(tokens)?;
        let mut factor = outer * sign;
        if let Token::Number(number) = tokens.peek(0)? {
            factor *= number;
            tokens.next()?;
        }
        let (i, line) = match tokens.next()? {
            (Token::Name(name), line) => (variable(names, line, &name)?, line),
            other => return Err(wrong("a variable", other)),
        };
        let (j, value) = match (tokens.next()?, tokens.next()?) {
            ((Token::Sign('^'), _), (Token::Number(2.0), _)) => (i, factor),
            ((Token::Sign('*'), _), (Token::Name(name), line)) => {
                let j = variable(names, line, &name)?;
                // [ x * y ] / 2 is 1/2 x'Qx for Q with two entries of 1/2.
                (j, if i == j { factor } else { factor / 2.0 })
            }
            ((Token::Sign('*' | '^'), _), other) => return Err(wrong("a second factor", other)),
            (other, _) => return Err(wrong("^ 2 or * and a variable", other)),
        };
        quadratic.push(line, i, j, value);
    }
    match (tokens.next()?, tokens.next()?) {
        ((Token::Sign('/'), _), (Token::Number(2.0), _)) => Ok(()),
        (other, _) => Err(wrong("/ 2 behind ]", other)),
    }
}

/// A token for messages.
pub(super) fn text_of(token: &Token) -> String {
    match token {
        Token::Number(number) => quoted(&number.to_string()),
        Token::Name(name) => quoted(name),
        Token::Relation(relation) => quoted(["<=", "=", ">="][(relation + 1) as usize]),
        Token::Sign(sign) => quoted(&sign.to_string()),
        Token::Arrow => quoted("->"),
        Token::Section(_, word) => quoted(word),
        Token::EndOfFile => "the end of the file".into(),
    }
}
