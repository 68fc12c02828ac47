//! Calls of primitives and the expressions in their arguments.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::FeatureId;
use crate::geometry::{Point, Pose, Vector};

/// A primitive with all its arguments, defaults filled in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Call {
    /// Name of the primitive, as registered in [`crate::primitives`].
    pub primitive: String,
    /// Arguments by parameter name. An optional parameter without a value is absent.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub arguments: BTreeMap<String, Expr>,
}

/// An argument: a constant, or something that is known once features are measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Expr {
    /// A constant.
    Value(Value),
    /// A `for each` variable of the rule: an edge of a measured feature.
    Variable(String),
    /// An attribute of a feature. Of a `many` antecedent: of the antecedent
    /// instance; of the consequent: the median over its measured instances.
    /// No value while the feature is not measured.
    Attribute {
        /// Whose.
        feature: FeatureId,
        /// Which, as listed in [`crate::primitives::attributes`]. The name
        /// `self` stands for the whole polygon.
        name: String,
    },
    /// The first that has a value.
    Else(Box<Expr>, Box<Expr>),
    /// Sum of two lengths, angles, shares or numbers, or of a point and a displacement.
    Add(Box<Expr>, Box<Expr>),
    /// Difference.
    Subtract(Box<Expr>, Box<Expr>),
    /// Product; one side is a number.
    Multiply(Box<Expr>, Box<Expr>),
    /// Quotient; the right side is a number.
    Divide(Box<Expr>, Box<Expr>),
    /// A list.
    List(Vec<Expr>),
    /// A primitive that gives a value (a point above a face, a dent of a shape).
    Call(Call),
}

/// A constant in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Value {
    /// Metres.
    Length(f64),
    /// Radians.
    Angle(f64),
    /// 0 to 1.
    Share(f64),
    /// Seconds.
    Time(f64),
    /// A bare number.
    Number(f64),
    /// A whole number of things.
    Count(u64),
    /// A colour.
    Colour(Colour),
    /// A text.
    Text(String),
    /// A unit vector, world axes.
    Direction(#[cfg_attr(test, schemars(with = "[f64; 3]"))] Vector),
    /// A point, metres.
    Point(#[cfg_attr(test, schemars(with = "[f64; 3]"))] Point),
    /// A pose: what it maps is said by the parameter.
    Pose(#[cfg_attr(test, schemars(with = "super::schema::Pose"))] Pose),
    /// One of a parameter's named alternatives.
    Choice(String),
}

/// An sRGB colour, written `#rrggbb` in the artefact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[cfg_attr(test, schemars(extend("pattern" = "^#[0-9a-fA-F]{6}$")))]
#[serde(into = "String", try_from = "String")]
pub struct Colour(pub [u8; 3]);

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

impl From<Colour> for String {
    fn from(colour: Colour) -> Self {
        colour.to_string()
    }
}

impl TryFrom<String> for Colour {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii());
        let byte = |d: &str, k: usize| u8::from_str_radix(&d[k..k + 2], 16).ok();
        digits
            .and_then(|d| Some(Self([byte(d, 0)?, byte(d, 2)?, byte(d, 4)?])))
            .ok_or_else(|| format!("`{text}` is not a colour like `#ff8000`"))
    }
}

/// An argument that is missing or not of the kind that a primitive needs. The
/// compiler never writes such a call; an edited artefact can hold one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` is not {expected}")]
pub struct BadArgument {
    name: String,
    expected: &'static str,
}

impl BadArgument {
    /// `name` is not `expected`.
    pub fn new(name: &str, expected: &'static str) -> Self {
        Self {
            name: name.to_owned(),
            expected,
        }
    }
}

/// Constant arguments by name, in SI units.
impl Call {
    /// The constant of an argument; `None` where it is absent or not constant.
    pub fn constant(&self, name: &str) -> Option<&Value> {
        match self.arguments.get(name) {
            Some(Expr::Value(value)) => Some(value),
            _ => None,
        }
    }

    /// A length, metres.
    pub fn length(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "a length", length)
    }

    /// An angle, radians.
    pub fn angle(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "an angle", angle)
    }

    /// A share, 0 to 1.
    pub fn share(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "a share", |v| match v {
            Value::Share(x) => Some(*x),
            _ => None,
        })
    }

    /// A bare number.
    pub fn number(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "a number", |v| match v {
            Value::Number(x) => Some(*x),
            Value::Count(n) => Some(*n as f64),
            _ => None,
        })
    }

    /// A count.
    pub fn count(&self, name: &str) -> Result<u64, BadArgument> {
        self.read(name, "a count", count)
    }

    /// A colour.
    pub fn colour(&self, name: &str) -> Result<Colour, BadArgument> {
        self.read(name, "a colour", |v| match v {
            Value::Colour(c) => Some(*c),
            _ => None,
        })
    }

    /// A text or a choice.
    pub fn text(&self, name: &str) -> Result<&str, BadArgument> {
        match self.constant(name) {
            Some(Value::Text(t) | Value::Choice(t)) => Ok(t),
            _ => Err(BadArgument::new(name, "a text")),
        }
    }

    /// A list of lengths, metres.
    pub fn lengths(&self, name: &str) -> Result<Vec<f64>, BadArgument> {
        self.list(name, "a list of lengths", length)
    }

    /// A list of angles, radians.
    pub fn angles(&self, name: &str) -> Result<Vec<f64>, BadArgument> {
        self.list(name, "a list of angles", angle)
    }

    /// A list of counts.
    pub fn counts(&self, name: &str) -> Result<Vec<u64>, BadArgument> {
        self.list(name, "a list of counts", count)
    }

    /// The calls in a list argument; none where it is absent.
    pub fn calls(&self, name: &str) -> Result<Vec<&Call>, BadArgument> {
        let expected = "a list of calls";
        match self.arguments.get(name) {
            None => Ok(Vec::new()),
            Some(Expr::List(items)) => items
                .iter()
                .map(|e| match e {
                    Expr::Call(call) => Ok(call),
                    _ => Err(BadArgument::new(name, expected)),
                })
                .collect(),
            Some(_) => Err(BadArgument::new(name, expected)),
        }
    }

    fn read<T>(
        &self,
        name: &str,
        expected: &'static str,
        take: impl Fn(&Value) -> Option<T>,
    ) -> Result<T, BadArgument> {
        self.constant(name)
            .and_then(take)
            .ok_or_else(|| BadArgument::new(name, expected))
    }

    fn list<T>(
        &self,
        name: &str,
        expected: &'static str,
        take: impl Fn(&Value) -> Option<T>,
    ) -> Result<Vec<T>, BadArgument> {
        let Some(Expr::List(items)) = self.arguments.get(name) else {
            return Err(BadArgument::new(name, expected));
        };
        items
            .iter()
            .map(|e| match e {
                Expr::Value(v) => take(v).ok_or_else(|| BadArgument::new(name, expected)),
                _ => Err(BadArgument::new(name, expected)),
            })
            .collect()
    }
}

fn length(v: &Value) -> Option<f64> {
    match v {
        Value::Length(x) => Some(*x),
        _ => None,
    }
}

fn angle(v: &Value) -> Option<f64> {
    match v {
        Value::Angle(x) => Some(*x),
        _ => None,
    }
}

fn count(v: &Value) -> Option<u64> {
    match v {
        Value::Count(n) => Some(*n),
        _ => None,
    }
}
