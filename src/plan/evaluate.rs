//! Expressions in the arguments of a call, evaluated on measured instances.
//!
//! A value that is not known *yet* (an attribute of a feature that is not
//! measured) is `None`: `else` takes over, and without one the call cannot be
//! made. What does not fit together is an error, never a missing value.

use std::collections::BTreeMap;

use super::attributes::{attribute, median};
use crate::detect::Measurement;
use crate::geometry::{Edge, Point, Vector};
use crate::predict;
use crate::primitives::{Arguments, Datum};
use crate::rules::{BadArgument, Call, Expr, FeatureId, Value};

/// What the names in a rule stand for.
pub struct Context<'a> {
    /// The antecedent instances.
    pub antecedents: BTreeMap<FeatureId, &'a Measurement>,
    /// The `for each` variables.
    pub variables: &'a BTreeMap<String, Edge>,
    /// The measured instances of a feature that is no antecedent.
    pub measured: &'a dyn Fn(FeatureId) -> Vec<&'a Measurement>,
}

type Evaluated = Result<Option<Datum>, BadArgument>;

impl Context<'_> {
    /// The arguments of a call; `None` where one has no value yet.
    ///
    /// # Errors
    /// An argument does not fit together.
    pub fn arguments(&self, call: &Call) -> Result<Option<Arguments>, BadArgument> {
        let mut evaluated = BTreeMap::new();
        for (name, expr) in &call.arguments {
            match self.value(expr)? {
                Some(datum) => evaluated.insert(name.clone(), datum),
                None => return Ok(None),
            };
        }
        Ok(Some(Arguments(evaluated)))
    }

    /// The value of an expression; `None` where it has none yet.
    ///
    /// # Errors
    /// It does not fit together.
    pub fn value(&self, expr: &Expr) -> Evaluated {
        match expr {
            Expr::Value(value) => Ok(Some(Datum::Constant(value.clone()))),
            Expr::Variable(name) => match self.variables.get(name) {
                Some(edge) => Ok(Some(Datum::Edge(*edge))),
                None => Err(BadArgument::new(name, "a `for each` variable of the rule")),
            },
            Expr::Attribute { feature, name } => self.attribute(*feature, name),
            Expr::Else(first, second) => match self.value(first)? {
                None => self.value(second),
                known => Ok(known),
            },
            Expr::Add(a, b) => self.both(a, b, |a, b| sum(a, b, 1.0)),
            Expr::Subtract(a, b) => self.both(a, b, |a, b| sum(a, b, -1.0)),
            Expr::Multiply(a, b) => self.both(a, b, product),
            Expr::Divide(a, b) => self.both(a, b, quotient),
            Expr::List(items) => {
                let items: Result<Option<Vec<Datum>>, BadArgument> = items.iter().map(|e| self.value(e)).collect();
                Ok(items?.map(Datum::List))
            }
            Expr::Call(call) => match self.arguments(call)? {
                Some(arguments) => predict::value(&call.primitive, &arguments),
                None => Ok(None),
            },
        }
    }

    /// Of an antecedent: that instance's. Of any other feature: the median over
    /// its measured instances.
    fn attribute(&self, feature: FeatureId, name: &str) -> Evaluated {
        if let Some(instance) = self.antecedents.get(&feature) {
            return attribute(instance, name).map(Some);
        }
        let measured = (self.measured)(feature);
        let values: Result<Vec<Datum>, BadArgument> = measured.into_iter().map(|m| attribute(m, name)).collect();
        Ok(median(&values?))
    }

    fn both(&self, a: &Expr, b: &Expr, of: impl Fn(Datum, Datum) -> Result<Datum, BadArgument>) -> Evaluated {
        match (self.value(a)?, self.value(b)?) {
            (Some(a), Some(b)) => of(a, b).and_then(finite).map(Some),
            _ => Ok(None),
        }
    }
}

/// `a + sign · b`.
fn sum(a: Datum, b: Datum, sign: f64) -> Result<Datum, BadArgument> {
    use Value::{Angle, Length, Point, Share, Time};
    if let Datum::Constant(Point(p)) = &a {
        return Ok(Datum::Constant(Point(p + displacement(&b)? * sign)));
    }
    let (Datum::Constant(x), Datum::Constant(y)) = (a, b) else {
        return Err(BadArgument::new("+", "a sum of two quantities"));
    };
    let value = match (&x, &y) {
        (Length(x), Length(y)) => Length(x + sign * y),
        (Angle(x), Angle(y)) => Angle(x + sign * y),
        (Share(x), Share(y)) => Share(x + sign * y),
        (Time(x), Time(y)) => Time(x + sign * y),
        _ => match (number(&x), number(&y)) {
            (Some(x), Some(y)) => Value::Number(x + sign * y),
            _ => return Err(BadArgument::new("+", "a sum of two quantities of one dimension")),
        },
    };
    Ok(Datum::Constant(value))
}

/// A displacement: a list of three lengths, or a point taken from the origin.
fn displacement(datum: &Datum) -> Result<Vector, BadArgument> {
    let bad = || BadArgument::new("+", "a point and a displacement");
    match datum {
        Datum::Constant(Value::Point(p)) => Ok(p.coords),
        Datum::List(items) => match items.as_slice() {
            [
                Datum::Constant(Value::Length(x)),
                Datum::Constant(Value::Length(y)),
                Datum::Constant(Value::Length(z)),
            ] => Ok(Point::new(*x, *y, *z).coords),
            _ => Err(bad()),
        },
        _ => Err(bad()),
    }
}

fn product(a: Datum, b: Datum) -> Result<Datum, BadArgument> {
    let (Datum::Constant(x), Datum::Constant(y)) = (&a, &b) else {
        return Err(BadArgument::new("*", "a product of a number and a quantity"));
    };
    match (number(x), number(y)) {
        (_, Some(factor)) => scaled(x, factor),
        (Some(factor), None) => scaled(y, factor),
        (None, None) => None,
    }
    .ok_or_else(|| BadArgument::new("*", "a product of a number and a quantity"))
}

fn quotient(a: Datum, b: Datum) -> Result<Datum, BadArgument> {
    let divided = match (&a, &b) {
        (Datum::Constant(x), Datum::Constant(y)) => number(y).and_then(|divisor| scaled(x, 1.0 / divisor)),
        _ => None,
    };
    divided.ok_or_else(|| BadArgument::new("/", "a quantity divided by a number"))
}

fn scaled(value: &Value, factor: f64) -> Option<Datum> {
    let value = match value {
        Value::Length(x) => Value::Length(x * factor),
        Value::Angle(x) => Value::Angle(x * factor),
        Value::Share(x) => Value::Share(x * factor),
        Value::Time(x) => Value::Time(x * factor),
        other => Value::Number(number(other)? * factor),
    };
    Some(Datum::Constant(value))
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(x) => Some(*x),
        Value::Count(n) => Some(*n as f64),
        _ => None,
    }
}

fn finite(datum: Datum) -> Result<Datum, BadArgument> {
    let finite = match &datum {
        Datum::Constant(Value::Length(x) | Value::Angle(x) | Value::Share(x) | Value::Time(x) | Value::Number(x)) => {
            x.is_finite()
        }
        Datum::Constant(Value::Point(p)) => p.coords.iter().all(|c| c.is_finite()),
        _ => true,
    };
    finite
        .then_some(datum)
        .ok_or_else(|| BadArgument::new("arithmetic", "finite: does it divide by zero?"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Polygon;

    const FACE: FeatureId = FeatureId(0);
    const SIDE: FeatureId = FeatureId(1);

    fn square(size: f64) -> Measurement {
        let corners = [(0., 0.), (size, 0.), (size, size), (0., size)];
        let vertices = corners.map(|(x, y)| Point::new(x, y, 0.0)).to_vec();
        Measurement::Face(Polygon::new(vertices).unwrap())
    }

    fn length(metres: f64) -> Expr {
        Expr::Value(Value::Length(metres))
    }

    fn height_of(feature: FeatureId) -> Expr {
        Expr::Attribute {
            feature,
            name: "height".into(),
        }
    }

    /// Evaluates with one antecedent, a square of 2 m, and measured sides.
    fn value(expr: &Expr, sides: &[Measurement]) -> Evaluated {
        let bottom = square(2.0);
        let variables = BTreeMap::from([(
            "edge".to_owned(),
            Edge {
                start: Point::origin(),
                end: Point::new(1., 0., 0.),
                face_normal: Vector::z(),
            },
        )]);
        let context = Context {
            antecedents: BTreeMap::from([(FACE, &bottom)]),
            variables: &variables,
            measured: &|feature| {
                if feature == SIDE {
                    sides.iter().collect()
                } else {
                    Vec::new()
                }
            },
        };
        context.value(expr)
    }

    fn metres(x: f64) -> Evaluated {
        Ok(Some(Datum::Constant(Value::Length(x))))
    }

    #[test]
    fn an_attribute_is_the_antecedents_or_the_median_over_the_measured() {
        assert_eq!(value(&height_of(FACE), &[]), metres(2.0));
        assert_eq!(
            value(&height_of(SIDE), &[square(1.0), square(5.0), square(3.0)]),
            metres(3.0)
        );
        assert_eq!(value(&height_of(SIDE), &[]), Ok(None));
    }

    #[test]
    fn else_takes_over_when_there_is_no_value_yet_and_never_on_error() {
        let or = |first: Expr| Expr::Else(Box::new(first), Box::new(length(0.3)));
        assert_eq!(value(&or(height_of(SIDE)), &[]), metres(0.3));
        assert_eq!(value(&or(height_of(SIDE)), &[square(0.2)]), metres(0.2));
        assert!(value(&or(Expr::Variable("corner".into())), &[]).is_err());
    }

    #[test]
    fn without_a_value_the_call_cannot_be_made() {
        let half = Expr::Divide(Box::new(height_of(SIDE)), Box::new(Expr::Value(Value::Number(2.0))));
        assert_eq!(value(&half, &[]), Ok(None));
        assert_eq!(value(&half, &[square(3.0)]), metres(1.5));
        assert_eq!(value(&Expr::List(vec![length(1.0), half]), &[]), Ok(None));
    }

    #[test]
    fn dimensions_must_fit_and_nothing_divides_by_zero() {
        let angle = Expr::Value(Value::Angle(1.0));
        let zero = Expr::Value(Value::Number(0.0));
        assert!(value(&Expr::Add(Box::new(length(1.0)), Box::new(angle)), &[]).is_err());
        assert!(value(&Expr::Divide(Box::new(length(1.0)), Box::new(zero)), &[]).is_err());
        assert_eq!(
            value(
                &Expr::Multiply(Box::new(Expr::Value(Value::Count(3))), Box::new(length(0.5))),
                &[]
            ),
            metres(1.5)
        );
    }

    #[test]
    fn a_point_behind_a_face_can_be_moved() {
        let behind = Expr::Call(Call {
            primitive: "behind".into(),
            arguments: BTreeMap::from([
                (
                    "face".to_owned(),
                    Expr::Attribute {
                        feature: FACE,
                        name: "self".into(),
                    },
                ),
                ("depth".to_owned(), length(3.0)),
            ]),
        });
        let by = Expr::List(vec![length(0.0), length(0.0), length(1.0)]);
        let moved = value(&Expr::Add(Box::new(behind), Box::new(by)), &[]);
        assert_eq!(moved, Ok(Some(Datum::Constant(Value::Point(Point::new(1., 1., -2.))))));
    }
}
