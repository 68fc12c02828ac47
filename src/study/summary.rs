//! What the rows of a study say: means by method and object, and paired differences.

use std::collections::BTreeMap;

use super::design::{Design, Kind};
use super::row::Row;
use super::statistics::{Interval, bootstrap, mean};

/// The object of a line over all objects.
pub const ALL: &str = "all";

/// What the runs of an arm on an object came to, or on all of them.
#[derive(Clone, Debug)]
pub struct Line {
    /// Index into [`Design::arms`].
    pub arm: usize,
    /// The object, or [`ALL`].
    pub object: String,
    /// Start views.
    pub starts: usize,
    /// Runs.
    pub runs: usize,
    /// Measurements to the stop.
    pub views: Option<Interval>,
    /// Runs without a stop of their own.
    pub unfinished: usize,
    /// Measurements to 95, 97 and 99 %; a run that never came there counts the limit.
    pub to: [Option<Interval>; 3],
    /// Runs that never came to 95, 97 and 99 %.
    pub missing: [usize; 3],
    /// Mean share measured.
    pub coverage: Option<f64>,
    /// Mean area under the curve of coverage.
    pub area: Option<f64>,
    /// Mean length of the path, metres.
    pub path: Option<f64>,
    /// Right class, wrong class, undecided.
    pub decided: [usize; 3],
    /// Measurements from the first decoded marker on, and the best that were possible.
    pub from_first: Option<(Interval, f64)>,
    /// Runs by how they ended.
    pub outcomes: BTreeMap<String, usize>,
    /// Bounds that are not proven to be reached.
    pub open: usize,
}

/// How much more an arm needs than the first one, on the same object from the same start.
#[derive(Clone, Debug)]
pub struct Paired {
    /// Index into [`Design::arms`].
    pub arm: usize,
    /// Measurements to the stop.
    pub views: Option<Interval>,
    /// Measurements to 97 %.
    pub to97: Option<Interval>,
    /// Pairs.
    pub pairs: usize,
}

/// A study summed up.
#[derive(Clone, Debug)]
pub struct Summary {
    /// By arm, the objects in order and then all.
    pub lines: Vec<Line>,
    /// Every arm but the first against the first.
    pub paired: Vec<Paired>,
    /// By arm: mean coverage after each measurement.
    pub curves: Vec<Vec<f64>>,
}

impl Summary {
    /// The line of an arm and an object.
    pub fn line(&self, arm: usize, object: &str) -> Option<&Line> {
        self.lines.iter().find(|l| l.arm == arm && l.object == object)
    }
}

/// Sums up the rows of a study, or those that there are.
pub fn summarise(design: &Design, rows: &BTreeMap<u64, Row>) -> Summary {
    let mut by_arm: Vec<Vec<&Row>> = vec![Vec::new(); design.arms.len()];
    for job in &design.jobs {
        by_arm[job.arm].extend(rows.get(&job.index).filter(|row| row.outcome != "none"));
    }
    let mut lines = Vec::new();
    for (arm, rows) in by_arm.iter().enumerate() {
        for subject in &design.study.objects {
            let name = &subject.object.name;
            let own: Vec<&Row> = rows.iter().filter(|r| r.object == *name).copied().collect();
            lines.extend(line(design, arm, name, &own));
        }
        lines.extend(line(design, arm, ALL, rows));
    }
    let against = by_arm.first().map(|rows| units(design, 0, rows)).unwrap_or_default();
    let paired = (1..design.arms.len())
        .filter_map(|arm| paired(design, arm, &by_arm[arm], &against))
        .collect();
    let curves = by_arm
        .iter()
        .enumerate()
        .map(|(arm, rows)| curve(limit(design, arm), rows));
    Summary {
        curves: curves.collect(),
        lines,
        paired,
    }
}

fn limit(design: &Design, arm: usize) -> u32 {
    design.variant(arm).task.limit
}

/// What is averaged: a start of an object, its seeds taken together.
type Units = BTreeMap<(String, usize), (f64, f64)>;

/// Measurements to the stop and to 97 %, by object and start.
fn units(design: &Design, arm: usize, rows: &[&Row]) -> Units {
    let most = f64::from(limit(design, arm));
    let mut all: BTreeMap<(String, usize), Vec<(f64, f64)>> = BTreeMap::new();
    for row in rows {
        let to97 = row.to97.map_or(most, f64::from);
        let key = (row.object.clone(), row.start);
        all.entry(key).or_default().push((views(row), to97));
    }
    let averaged = all.into_iter().map(|(key, values)| {
        let n = values.len() as f64;
        let sum = values.iter().fold((0.0, 0.0), |s, v| (s.0 + v.0, s.1 + v.1));
        (key, (sum.0 / n, sum.1 / n))
    });
    averaged.collect()
}

/// Measurements to the stop; of a bound on an expectation, what is expected.
fn views(row: &Row) -> f64 {
    row.expected.unwrap_or(f64::from(row.views))
}

fn paired(design: &Design, arm: usize, rows: &[&Row], against: &Units) -> Option<Paired> {
    let own = units(design, arm, rows);
    let both: Vec<((f64, f64), (f64, f64))> = own
        .iter()
        .filter_map(|(key, value)| Some((*value, *against.get(key)?)))
        .collect();
    let differences =
        |of: fn(&(f64, f64)) -> f64| bootstrap(&both.iter().map(|(a, b)| of(a) - of(b)).collect::<Vec<_>>());
    (!both.is_empty()).then(|| Paired {
        arm,
        views: differences(|v| v.0),
        to97: differences(|v| v.1).filter(|_| !design.is_recognition()),
        pairs: both.len(),
    })
}

fn line(design: &Design, arm: usize, object: &str, rows: &[&Row]) -> Option<Line> {
    if rows.is_empty() {
        return None;
    }
    let most = limit(design, arm);
    let recognition = design.variant(arm).task.goal.confident;
    let averaged = |value: &dyn Fn(&Row) -> Option<f64>| {
        let mut by_unit: BTreeMap<(&str, usize), Vec<f64>> = BTreeMap::new();
        for row in rows {
            by_unit.entry((&row.object, row.start)).or_default().extend(value(row));
        }
        by_unit.values().filter_map(|values| mean(values)).collect::<Vec<f64>>()
    };
    let reach = |of: fn(&Row) -> Option<u32>| {
        let values = averaged(&|row| Some(of(row).map_or(f64::from(most), f64::from)));
        bootstrap(&values).filter(|_| !recognition)
    };
    let starts: std::collections::BTreeSet<usize> = rows.iter().map(|r| r.start).collect();
    let count = |holds: &dyn Fn(&Row) -> bool| rows.iter().filter(|row| holds(row)).count();
    let mut outcomes = BTreeMap::new();
    for row in rows {
        *outcomes.entry(row.outcome.clone()).or_insert(0) += 1;
    }
    let known: Vec<&Row> = rows.iter().filter(|r| r.best_from_first.is_some()).copied().collect();
    let from_first = bootstrap(
        &known
            .iter()
            .filter_map(|r| r.from_first().map(f64::from))
            .collect::<Vec<_>>(),
    );
    let best = mean(&known.iter().filter_map(|r| r.best_from_first).collect::<Vec<_>>());
    Some(Line {
        arm,
        object: object.to_owned(),
        starts: starts.len(),
        runs: rows.len(),
        views: bootstrap(&averaged(&|row| Some(views(row)))),
        unfinished: count(&|row| is_unfinished(row, recognition)),
        to: [reach(|r| r.to95), reach(|r| r.to97), reach(|r| r.to99)],
        missing: [
            count(&|r| r.to95.is_none()),
            count(&|r| r.to97.is_none()),
            count(&|r| r.to99.is_none()),
        ],
        coverage: mean(&averaged(&|row| row.coverage)),
        area: mean(&averaged(&|row| row.area)),
        path: mean(&averaged(&|row| Some(row.path))),
        decided: decided(rows),
        from_first: from_first.zip(best),
        outcomes,
        open: count(&|row| row.closed == Some(false)),
    })
}

fn is_unfinished(row: &Row, recognition: bool) -> bool {
    match row.outcome.as_str() {
        "goal" | "bound" | "oracle" => false,
        "view_limit" => true,
        _ => !recognition,
    }
}

/// Right class, wrong class, undecided. Of an object that is of no class, finding the
/// library contradicted is right.
fn decided(rows: &[&Row]) -> [usize; 3] {
    let mut counts = [0; 3];
    for row in rows {
        let right = match (&row.class, &row.truth) {
            (Some(class), Some(truth)) => Some(class == truth),
            (Some(_), None) => Some(false),
            (None, None) if row.outcome == "contradiction" => Some(true),
            (None, _) => None,
        };
        counts[match right {
            Some(true) => 0,
            Some(false) => 1,
            None => 2,
        }] += 1;
    }
    counts
}

/// Mean coverage after each measurement; what a run had at its stop it keeps.
fn curve(limit: u32, rows: &[&Row]) -> Vec<f64> {
    let curves: Vec<&[f64]> = rows
        .iter()
        .map(|r| r.curve.as_slice())
        .filter(|c| !c.is_empty())
        .collect();
    let longest = if curves.is_empty() { 0 } else { limit as usize };
    let at = |k: usize| curves.iter().map(|c| c[k.min(c.len() - 1)]).sum::<f64>() / curves.len() as f64;
    (0..longest).map(at).collect()
}

/// Arms that are methods of the planner.
pub fn is_method(design: &Design, arm: usize) -> bool {
    matches!(design.arms[arm].kind, Kind::Method(_))
}
