//! Arguments of a call once its expressions are evaluated.

use std::collections::BTreeMap;

use crate::geometry::{Edge, Point, Polygon, Pose, Vector};
use crate::rules::{BadArgument, Colour, Value};

/// A value at run time: a constant, or a part of a measured feature.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// A constant.
    Constant(Value),
    /// An edge of a measured face.
    Edge(Edge),
    /// All edges of a measured face.
    Edges(Vec<Edge>),
    /// A measured face.
    Polygon(Polygon),
    /// A list.
    List(Vec<Datum>),
}

/// Evaluated arguments by parameter name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arguments(pub BTreeMap<String, Datum>);

impl Arguments {
    /// Whether an optional argument has a value.
    pub fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// A length, metres.
    pub fn length(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "a length", |d| match d {
            Datum::Constant(Value::Length(x)) => Some(*x),
            _ => None,
        })
    }

    /// An angle, radians.
    pub fn angle(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "an angle", |d| match d {
            Datum::Constant(Value::Angle(x)) => Some(*x),
            _ => None,
        })
    }

    /// A whole number.
    pub fn count(&self, name: &str) -> Result<u64, BadArgument> {
        self.read(name, "a whole number", |d| match d {
            Datum::Constant(Value::Count(n)) => Some(*n),
            _ => None,
        })
    }

    /// A share, 0 to 1.
    pub fn share(&self, name: &str) -> Result<f64, BadArgument> {
        self.read(name, "a share", |d| match d {
            Datum::Constant(Value::Share(x)) => Some(*x),
            _ => None,
        })
    }

    /// A colour.
    pub fn colour(&self, name: &str) -> Result<Colour, BadArgument> {
        self.read(name, "a colour", |d| match d {
            Datum::Constant(Value::Colour(c)) => Some(*c),
            _ => None,
        })
    }

    /// A text or a choice.
    pub fn text(&self, name: &str) -> Result<&str, BadArgument> {
        match self.0.get(name) {
            Some(Datum::Constant(Value::Text(t) | Value::Choice(t))) => Ok(t),
            _ => Err(BadArgument::new(name, "a text")),
        }
    }

    /// A unit vector, world axes.
    pub fn direction(&self, name: &str) -> Result<Vector, BadArgument> {
        self.read(name, "a direction", |d| match d {
            Datum::Constant(Value::Direction(v)) => Some(*v),
            _ => None,
        })
    }

    /// A point, metres, world axes.
    pub fn point(&self, name: &str) -> Result<Point, BadArgument> {
        self.read(name, "a point", |d| match d {
            Datum::Constant(Value::Point(p)) => Some(*p),
            _ => None,
        })
    }

    /// A pose.
    pub fn pose(&self, name: &str) -> Result<Pose, BadArgument> {
        self.read(name, "a pose", |d| match d {
            Datum::Constant(Value::Pose(p)) => Some(*p),
            _ => None,
        })
    }

    /// An edge of a measured face, world axes.
    pub fn edge(&self, name: &str) -> Result<Edge, BadArgument> {
        self.read(name, "an edge", edge)
    }

    /// A list of edges of measured faces, world axes.
    pub fn edges(&self, name: &str) -> Result<Vec<Edge>, BadArgument> {
        self.read(name, "a list of edges", |d| match d {
            Datum::Edges(edges) => Some(edges.clone()),
            Datum::List(items) => items.iter().map(edge).collect(),
            _ => None,
        })
    }

    /// A measured face, world axes.
    pub fn polygon(&self, name: &str) -> Result<&Polygon, BadArgument> {
        match self.0.get(name) {
            Some(Datum::Polygon(p)) => Ok(p),
            _ => Err(BadArgument::new(name, "a face")),
        }
    }

    fn read<T>(
        &self,
        name: &str,
        expected: &'static str,
        take: impl Fn(&Datum) -> Option<T>,
    ) -> Result<T, BadArgument> {
        self.0
            .get(name)
            .and_then(take)
            .ok_or_else(|| BadArgument::new(name, expected))
    }
}

fn edge(d: &Datum) -> Option<Edge> {
    match d {
        Datum::Edge(e) => Some(*e),
        _ => None,
    }
}
