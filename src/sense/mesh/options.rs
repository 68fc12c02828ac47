//! What a caller states about a file whose format is silent.

use crate::geometry::Point;

/// What one unit of a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// Millimetres.
    Millimetres,
    /// Centimetres.
    Centimetres,
    /// Metres.
    Metres,
    /// Inches of 25.4 mm.
    Inches,
}

/// Which axis of a file points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// x.
    X,
    /// y, as in glTF.
    Y,
    /// z, as here.
    Z,
}

/// Statements about a mesh file. glTF needs neither; where they are given
/// they hold for it too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshOptions {
    /// What one unit of the file is.
    pub units: Option<Units>,
    /// Which axis of the file points up.
    pub up: Option<Axis>,
}

/// The units that an error lists.
pub(super) const EXTENTS_UNITS: [Units; 4] = [Units::Millimetres, Units::Centimetres, Units::Metres, Units::Inches];

impl Units {
    /// The unit of a name: `mm`, `cm`, `m` or `in`.
    pub fn named(name: &str) -> Option<Self> {
        EXTENTS_UNITS.into_iter().find(|u| u.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Millimetres => "mm",
            Self::Centimetres => "cm",
            Self::Metres => "m",
            Self::Inches => "in",
        }
    }

    /// Metres a unit.
    pub fn metres(self) -> f64 {
        match self {
            Self::Millimetres => 0.001,
            Self::Centimetres => 0.01,
            Self::Metres => 1.0,
            Self::Inches => 0.0254,
        }
    }
}

impl Axis {
    /// The axis of a name: `x`, `y` or `z`.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "x" => Some(Self::X),
            "y" => Some(Self::Y),
            "z" => Some(Self::Z),
            _ => None,
        }
    }

    /// A point of a file with this axis up, turned so that z is up. A rotation:
    /// x goes to x where it can (for x up, z goes to −x and y stays).
    pub(super) fn upright(self, p: &Point) -> Point {
        match self {
            Self::X => Point::new(-p.z, p.y, p.x),
            Self::Y => Point::new(p.x, -p.z, p.y),
            Self::Z => *p,
        }
    }
}
