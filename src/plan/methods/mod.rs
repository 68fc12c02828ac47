//! Methods of choosing the next view: one file each, and one line in the list.
//!
//! A method sees the situation after a measurement and names a view. All stop by
//! eq. 11, save those that say themselves whether the view is worth taking.

mod ae;
mod af;
mod gn;
mod gno;
mod joint;
mod oa;
mod occluded;
mod pc;
mod pfdt;
mod prospect;
mod random;
mod rays;
mod rse;
mod rsv;
mod ts;
mod uv;

use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::error::PlanError;
use super::knowledge::Knowledge;
use super::look::{Look, Targets};
use super::score::{self, Gains, OverlapParts};
use super::status::Status;
use super::viewpoint::Viewpoint;
use super::world::World;
use crate::geometry::Point;
use rays::Reading;

/// A way of choosing views.
pub trait Method: Sync {
    /// Its name, lower case.
    fn name(&self) -> &'static str;
    /// The next view; `None` where no unvisited view is left.
    fn choose(&self, situation: &Situation<'_>, random: &mut Pcg64) -> Option<Choice>;
}

/// All methods, in the order of [`crate::rules::METHODS`].
const METHODS: &[&dyn Method] = &[
    &gn::Gn,
    &gno::Gno,
    &joint::Joint,
    &joint::Joint2,
    &oa::OcclusionAware(Reading::Published),
    &oa::OcclusionAware(Reading::Implemented),
    &uv::UnobservedVoxel(Reading::Published),
    &uv::UnobservedVoxel(Reading::Implemented),
    &rsv::RearSideVoxel(Reading::Published),
    &rsv::RearSideVoxel(Reading::Implemented),
    &rse::RearSideEntropy(Reading::Published),
    &rse::RearSideEntropy(Reading::Implemented),
    &pc::ProximityCount,
    &af::AreaFactor,
    &ae::AverageEntropy(Reading::Published),
    &ae::AverageEntropy(Reading::Implemented),
    &ts::TwoStages,
    &pfdt::Pfdt,
    &random::Random,
];

/// What a method chooses by.
pub struct Situation<'a> {
    /// The measured space.
    pub world: &'a dyn World,
    /// Library and task.
    pub knowledge: &'a Knowledge,
    /// Features, classes and visited views.
    pub status: &'a Status,
    /// All candidate views.
    pub candidates: &'a [Viewpoint],
    /// The gains of the unvisited ones.
    pub gains: &'a Gains,
    /// Where the camera stands.
    pub current: Point,
}

/// How a view stands in a method's ranking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rank {
    /// Position in [`Gains::views`].
    pub position: usize,
    /// The method's value of it; eq. 8 for GN and GNO.
    pub score: f64,
    /// G_ovlp.
    pub overlap: bool,
    /// The share that G_ovlp judges, where the method asks for it.
    pub share: Option<f64>,
}

/// A view and why it was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The view.
    pub best: Rank,
    /// Whether every view with gain failed the overlap constraint.
    pub relaxed: bool,
    /// A few that it was preferred to, best first; none where the method does not rank.
    pub rivals: Vec<Rank>,
    /// Whether a view is worth taking, by the method's own measure; where `None`,
    /// eq. 11 decides.
    pub worth: Option<Worth>,
}

/// A method's own measure of what is left to gain, voxel faces of new surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worth {
    /// The most that a view is expected to show.
    pub most: f64,
    /// The least that a view is worth taking for.
    pub least: f64,
}

impl Worth {
    /// s_ail: no view is worth taking.
    pub fn exhausted(&self) -> bool {
        self.most < self.least
    }
}

/// Most views that a choice tells of beside the chosen one.
const MOST_RIVALS: usize = 3;

/// The method of a name, case-insensitively.
///
/// # Errors
/// There is none; the message lists those there are.
pub fn method(name: &str) -> Result<&'static dyn Method, PlanError> {
    let known = METHODS.iter().find(|m| m.name().eq_ignore_ascii_case(name));
    known.copied().ok_or_else(|| PlanError::UnknownMethod {
        name: name.to_owned(),
        known: names().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", "),
    })
}

/// The names of all methods.
pub fn names() -> impl Iterator<Item = &'static str> {
    METHODS.iter().map(|m| m.name())
}

impl Situation<'_> {
    /// Positions of the unvisited views that gain something.
    pub fn gaining(&self) -> Vec<usize> {
        let positions = 0..self.gains.views.len();
        positions.filter(|k| self.gains.total(*k) > 0.0).collect()
    }

    /// The share that G_ovlp judges, for each of some ranks.
    pub fn overlaps(&self, parts: &OverlapParts, ranks: &[Rank]) -> Vec<f64> {
        let near = self.knowledge.criteria.near;
        let share = |rank: &Rank| score::overlap_share(&self.look(rank.position), parts, near);
        ranks.par_iter().map(share).collect()
    }

    /// G_so of every unvisited view after the gain floor, whatever W is.
    pub fn surfaces(&self) -> Vec<u64> {
        let rear = Targets::of(self.world, self.world.rear_side());
        let positions = (0..self.gains.views.len()).into_par_iter();
        let surface = |position: usize| score::surface_gain(&self.look(position), &rear, self.knowledge);
        positions.map(surface).collect()
    }

    /// What an unvisited view sees.
    pub fn look(&self, position: usize) -> Look<'_, dyn World + '_> {
        Look::of(self.world, self.view(position), self.knowledge.criteria.visibility)
    }

    /// The choice by a value of every unvisited view, without an overlap
    /// constraint.
    pub fn largest(&self, values: &[f64]) -> Option<Choice> {
        let rank = |(position, score): (usize, &f64)| Rank {
            position,
            score: *score,
            overlap: true,
            share: None,
        };
        let ranks = values.iter().enumerate().map(rank).collect();
        let (best, rivals) = self.ranked(ranks, |rank| rank.score)?;
        Some(Choice {
            best,
            relaxed: false,
            rivals,
            worth: None,
        })
    }

    /// The views of largest value, best first, as [`Situation::sort`] puts them. The
    /// first is the choice, the others of some value its rivals.
    pub fn ranked(&self, mut ranks: Vec<Rank>, value: impl Fn(&Rank) -> f64) -> Option<(Rank, Vec<Rank>)> {
        self.sort(&mut ranks, &value);
        ranks.truncate(1 + MOST_RIVALS);
        let mut ranks = ranks.into_iter();
        let best = ranks.next()?;
        Some((best, ranks.filter(|rank| value(rank) > 0.0).collect()))
    }

    /// Puts views of larger value first: of equals the nearest to the current view,
    /// then the lowest index.
    pub fn sort(&self, ranks: &mut [Rank], value: impl Fn(&Rank) -> f64) {
        ranks.sort_by(|a, b| {
            let nearer = || self.distance(a.position).total_cmp(&self.distance(b.position));
            let larger = value(b).total_cmp(&value(a));
            larger.then_with(nearer).then_with(|| a.position.cmp(&b.position))
        });
    }

    /// How far a view is from the current one, metres.
    pub fn distance(&self, position: usize) -> f64 {
        (self.view(position).eye() - self.current).norm()
    }

    fn view(&self, position: usize) -> &Viewpoint {
        &self.candidates[self.gains.views[position]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_can_name_every_method() {
        assert_eq!(names().collect::<Vec<_>>(), crate::rules::METHODS);
    }

    #[test]
    fn names_are_read_in_any_case_and_unknown_ones_list_what_exists() {
        assert_eq!(method("GNO").unwrap().name(), "gno");
        let message = method("best").err().unwrap().to_string();
        assert!(
            message.contains("`best`") && message.contains("`gn`, `gno`, `joint`"),
            "{message}"
        );
    }
}
