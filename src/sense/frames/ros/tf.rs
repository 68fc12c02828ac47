//! The tree of frames that tf messages describe, over time.

use std::collections::BTreeMap;

use nalgebra::Translation3;

use super::messages::Transform;
use crate::geometry::Pose;

/// Longest way to a root; a longer one runs in a circle.
const MOST_LINKS: usize = 64;

/// Frames by name, each with its parent.
#[derive(Default)]
pub(super) struct Tree {
    links: BTreeMap<String, Link>,
}

struct Link {
    parent: String,
    /// `parent_from_child` by time, in seconds, once sorted.
    times: Vec<(f64, Pose)>,
    fixed: bool,
}

impl Tree {
    /// Adds a transform; `fixed` holds at all times.
    pub fn add(&mut self, transform: Transform, fixed: bool) {
        let link = self.links.entry(transform.child).or_insert_with(|| Link {
            parent: transform.header.frame,
            times: Vec::new(),
            fixed,
        });
        link.times.push((transform.header.time, transform.parent_from_child));
    }

    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// Brings the transforms of every frame into order of time.
    pub fn settle(&mut self) {
        for link in self.links.values_mut() {
            link.times.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
    }

    /// The root above a frame and `root_from_frame` at a time; `None` where the
    /// tree says nothing of that time.
    pub fn root_of<'a>(&'a self, frame: &str, time: f64) -> Option<(&'a str, Pose)> {
        let (mut name, mut root_from_frame) = (None, Pose::identity());
        let mut at = frame;
        for _ in 0..MOST_LINKS {
            let Some(link) = self.links.get(at) else {
                return name.map(|name| (name, root_from_frame));
            };
            root_from_frame = link.at(time)? * root_from_frame;
            at = &link.parent;
            name = Some(link.parent.as_str());
        }
        None
    }

    /// `to_from_from` between two frames of one tree.
    pub fn between(&self, to: &str, from: &str, time: f64) -> Option<Pose> {
        let ((a, root_from_to), (b, root_from_from)) = (self.root_of(to, time)?, self.root_of(from, time)?);
        (a == b).then(|| root_from_to.inverse() * root_from_from)
    }
}

impl Link {
    /// Between the two neighbours in time, blended; at most a tenth of a second
    /// beyond the first and the last.
    fn at(&self, time: f64) -> Option<Pose> {
        const BEYOND: f64 = 0.1;
        let ((first, last), after) = (
            (self.times.first()?, self.times.last()?),
            self.times.partition_point(|t| t.0 < time),
        );
        if self.fixed {
            return Some(last.1);
        }
        if time < first.0 - BEYOND || time > last.0 + BEYOND {
            return None;
        }
        let (Some(next), true) = (self.times.get(after), after > 0) else {
            return Some(if after == 0 { first.1 } else { last.1 });
        };
        let before = &self.times[after - 1];
        let share = (time - before.0) / (next.0 - before.0).max(f64::MIN_POSITIVE);
        let moved = before.1.translation.vector.lerp(&next.1.translation.vector, share);
        let turned = before.1.rotation.try_slerp(&next.1.rotation, share, 1e-9);
        Some(Pose::from_parts(
            Translation3::from(moved),
            turned.unwrap_or(next.1.rotation),
        ))
    }
}
