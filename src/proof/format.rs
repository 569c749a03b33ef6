//! The lines of a proof, as they stand in its file: one JSON object a line.
//!
//! ```text
//! proof, statement, claim, root, parts, the nodes of each part's tree (if it has one) in preorder, end
//! ```
//!
//! Floats are written so that they are read back bit for bit. Rows are numbered with the equality
//! constraints first, then the two-sided rows.

use num_bigint::BigInt;
use serde::de::{self, Deserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};

use super::exact::Exact;

/// The version of the format.
pub(super) const VERSION: u32 = 1;

/// A line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Line {
    /// The version of the format.
    RoundelProof(u32),
    Statement(Statement),
    Claim(Claim),
    Root(Root),
    Parts(Vec<Part>),
    Node(Node),
    /// The number of lines before this one.
    End(usize),
}

/// Entries `(unknown, coefficient)`. Those of one unknown are summed.
pub(super) type Terms = Vec<(u32, f64)>;

/// The problem, as its caller stated it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Statement {
    pub variables: usize,
    /// Entries `(i, j, v)` of Q with `i >= j`; each also stands for its mirror image. They are summed.
    pub quadratic: Vec<(u32, u32, f64)>,
    pub linear: Terms,
    pub constant: f64,
    pub least_squares: Vec<Square>,
    pub constraints: Vec<Equation>,
    pub inequalities: Vec<Inequality>,
    /// Unknown, lower and upper bound. A bound that does not limit is null.
    pub bounds: Vec<(u32, Option<f64>, Option<f64>)>,
    pub integers: Vec<u32>,
    pub pins: Terms,
}

/// `weight (terms . x - rhs)^2`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Square {
    pub weight: f64,
    pub rhs: f64,
    pub terms: Terms,
}

/// `terms . x = rhs`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Equation {
    pub rhs: f64,
    pub terms: Terms,
}

/// `lower <= terms . x <= upper`. A side that does not limit is null.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Inequality {
    pub lower: Option<f64>,
    pub upper: Option<f64>,
    pub terms: Terms,
}

/// What is proved: the point has this energy, and none has less than the bound. Without a bound there is no
/// point, and none is given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Claim {
    pub values: Option<Vec<f64>>,
    /// The energy at the values, rounded to the next float above.
    pub energy: Option<f64>,
    pub lower_bound: Option<f64>,
}

/// What rows imply before any branch.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Root {
    pub steps: Vec<Step>,
    /// What is left out and held after the steps, because all points may move.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub translations: Vec<Translation>,
    /// Further unknowns, numbered after those of the problem, each the sum of terms of unknowns before it. They are
    /// equations, numbered after the rows of the problem.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub defined: Vec<Terms>,
    /// Multipliers of rows that contradict each other: there is no point, and no parts follow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub empty: Option<Multipliers>,
}

/// A direction along which all points may move for ever at the same energy. Limits that it leads away from are left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Translation {
    /// Unknowns and how far they move.
    pub direction: Vec<(u32, f64)>,
    /// The integer that is held between zero and the values that it moves by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub held: Option<u32>,
}

/// A bound that the sides of a row and the bounds of its other unknowns imply.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Step {
    /// Row, unknown, and the lower bound of the unknown.
    Lower(u32, u32, f64),
    /// Row, unknown, and the upper bound of the unknown.
    Upper(u32, u32, f64),
    /// A row of integers and its lower side, a multiple of the coefficients' common divisor.
    RowLower(u32, f64),
    /// A row of integers and its upper side, a multiple of the coefficients' common divisor.
    RowUpper(u32, f64),
}

impl Step {
    /// The number of its row.
    pub fn row_mut(&mut self) -> &mut u32 {
        match self {
            Step::Lower(row, ..) | Step::Upper(row, ..) => row,
            Step::RowLower(row, _) | Step::RowUpper(row, _) => row,
        }
    }
}

/// Unknowns that share no term of the objective with other unknowns that are not fixed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Part {
    pub unknowns: Vec<u32>,
    /// Rows of this part that follow from others, numbered after those of the problem.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cuts: Vec<Cut>,
    /// What is added to the objective before anything else.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub switches: Vec<Switch>,
    /// For each unknown zero, a power of two or the negative of one, or any number for an integer. The objective minus
    /// half of the sum of these times the squares of the unknowns is convex.
    pub curvature: Vec<f64>,
    /// What shows the bound without a tree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lattice: Option<Lattice>,
    /// No point has less energy in this part. Without a bound there is no point.
    pub lower_bound: Option<f64>,
}

impl Part {
    /// The nodes of the enumerations of its lattice.
    pub fn enumerated(&self) -> usize {
        let forms = self.lattice.iter().flat_map(|lattice| &lattice.forms);
        forms.map(|form| form.nodes as usize).sum()
    }
}

/// What is left of the objective of a part in its integers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Lattice {
    /// Equations, and the unknown that each one gives after those before it.
    pub solved: Vec<(u32, u32)>,
    /// One value for each unknown of the part.
    pub point: Vec<f64>,
    pub forms: Vec<Form>,
}

/// `weight |R (y - t)|^2`, where y are combinations of integers, and t those of the point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Form {
    pub combinations: Vec<Terms>,
    /// The rows of R, each from its diagonal on.
    pub rows: Vec<Vec<f64>>,
    /// Diagonals below the leading blocks of `R'R`: of one unknown, of two, and so on. There may be none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub diagonals: Vec<Vec<f64>>,
    pub weight: f64,
    /// What shows the least value without an enumeration, with a number that is taken off.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub splits: Vec<Split>,
    #[serde(default, skip_serializing_if = "is_zero")]
    pub level: f64,
    /// No integers y have a value of `|R (y - t)|^2` below this.
    pub square: f64,
    /// Where the enumeration that shows it goes: no further from t than this in any coordinate, and to so many nodes.
    pub reach: f64,
    pub nodes: u64,
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

/// `vector . y` is an integer, and so it is at most `at` or at least `at + 1`. `by` is its multiplier.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Split {
    /// Coordinates, and the entries there.
    pub vector: Vec<(u32, i32)>,
    pub at: f64,
    pub by: f64,
}

/// An unknown that is zero where a binary is, and what its part of the objective gains: `product (x - x z)` and
/// `square (z^2 - z)`, which are zero at all points with integers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Switch {
    pub unknown: u32,
    pub binary: u32,
    /// What leads from a binary that is zero to an unknown that is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step>,
    pub product: f64,
    pub square: f64,
}

/// The row `terms . x >= lower`, which follows in both cases of a split: `split . x` is an integer at all points with
/// integers, and so it is at most `at` or at least `at + 1`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Cut {
    pub terms: Terms,
    pub lower: f64,
    pub split: Terms,
    pub at: f64,
    /// The case of at most `at`, and that of more.
    pub cases: [Case; 2],
}

/// Why a row follows in a case: by this multiple of the case, and by rows with multipliers.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    pub by: f64,
    pub multipliers: Vec<(u32, f64)>,
}

/// Rows with their multipliers: positive ones hold upper sides, negative ones lower sides.
pub(super) type Multipliers = Vec<(u32, Number)>;

/// A node of a tree.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Node {
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step>,
    /// It bounds all leaves below that have none of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Certificate>,
    pub end: End,
}

/// How a node ends.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum End {
    /// The next node has `x <= at`, and the one after its tree has `x >= at + 1`.
    Branch(u32, f64),
    /// The nearest certificate proves the bound of the part.
    #[default]
    Bound,
    /// There is no point: the rows with these multipliers contradict each other within the bounds, or the
    /// bounds contradict themselves.
    Empty(Multipliers),
}

/// A point, one value for each unknown of the part, and multipliers of rows. Any of them give a bound.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Certificate {
    pub point: Vec<Number>,
    pub multipliers: Multipliers,
}

/// A float, or a fraction of two integers in quotes.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Number {
    Float(f64),
    Fraction(BigInt, BigInt),
}

impl Number {
    /// The float, if it is one.
    pub fn float(&self) -> Option<f64> {
        match self {
            Number::Float(x) => x.is_finite().then_some(*x),
            Number::Fraction(..) => None,
        }
    }

    /// The number, if there is one.
    pub fn exact(&self) -> Option<Exact> {
        match self {
            Number::Float(x) => Exact::of(*x),
            Number::Fraction(above, below) => Exact::fraction(above.clone(), below.clone()),
        }
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Number::Float(x) => to.serialize_f64(*x),
            Number::Fraction(above, below) => to.serialize_str(&format!("{above}/{below}")),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(NumberVisitor)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = Number;

    fn expecting(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        to.write_str("a number or a fraction in quotes")
    }

    fn visit_f64<E: de::Error>(self, x: f64) -> Result<Number, E> {
        Ok(Number::Float(x))
    }

    fn visit_i64<E: de::Error>(self, x: i64) -> Result<Number, E> {
        Ok(Number::Float(x as f64))
    }

    fn visit_u64<E: de::Error>(self, x: u64) -> Result<Number, E> {
        Ok(Number::Float(x as f64))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Number, E> {
        let parts = text.split_once('/');
        let parsed = parts.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        let (above, below) =
            parsed.ok_or_else(|| E::custom(format!("\"{text}\" is no fraction")))?;
        Ok(Number::Fraction(above, below))
    }
}
