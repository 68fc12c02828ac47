//! Axis-aligned boxes.

use serde::{Deserialize, Serialize};

use super::frame::{Point, Vector};

/// An axis-aligned box in the world, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: Point,
    /// The corner with the largest coordinates.
    pub max: Point,
}

impl Bounds {
    /// The box of the given centre and full extents.
    pub fn centred(centre: Point, size: Vector) -> Self {
        Self {
            min: centre - size / 2.0,
            max: centre + size / 2.0,
        }
    }

    /// The smallest box around finite points; `None` where there are none.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Point>) -> Option<Self> {
        let mut points = points.into_iter().filter(|p| p.coords.iter().all(|c| c.is_finite()));
        let first = *points.next()?;
        Some(points.fold(Self { min: first, max: first }, |b, p| Self {
            min: b.min.inf(p),
            max: b.max.sup(p),
        }))
    }

    /// The centre.
    pub fn centre(&self) -> Point {
        nalgebra::center(&self.min, &self.max)
    }

    /// Full extents along x, y and z.
    pub fn size(&self) -> Vector {
        self.max - self.min
    }

    /// Whether a point lies inside or on the border.
    pub fn contains(&self, p: &Point) -> bool {
        (0..3).all(|k| self.min[k] <= p[k] && p[k] <= self.max[k])
    }

    /// The parameters at which `origin + t · direction` enters and leaves the
    /// box, clipped to `t ≥ 0`; `None` where it misses.
    pub fn clip_ray(&self, origin: &Point, direction: &Vector) -> Option<(f64, f64)> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for k in 0..3 {
            if direction[k].abs() < 1e-15 {
                if origin[k] < self.min[k] || origin[k] > self.max[k] {
                    return None;
                }
                continue;
            }
            let a = (self.min[k] - origin[k]) / direction[k];
            let b = (self.max[k] - origin[k]) / direction[k];
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter <= leave).then_some((enter, leave))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_is_clipped_to_the_box() {
        let b = Bounds::centred(Point::origin(), Vector::repeat(2.0));
        let hit = b.clip_ray(&Point::new(-3.0, 0.0, 0.0), &Vector::x());
        assert_eq!(hit, Some((2.0, 4.0)));
        assert_eq!(b.clip_ray(&Point::new(-3.0, 2.0, 0.0), &Vector::x()), None);
        assert_eq!(b.clip_ray(&Point::new(3.0, 0.0, 0.0), &Vector::x()), None);
    }
}
