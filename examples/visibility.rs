//! How often both kinds of visibility choose the same view, as a Markdown table.
//!
//! ```text
//! cargo run --release --example visibility -- FILE [STARTS] [METHOD]
//! ```
//!
//! Runs go by sight lines (`visibility exact`). A second session takes the same
//! measurements and decides by the centres of voxels; both decisions after every
//! measurement are compared. Start views are ⌊k · count / STARTS⌋.

use rayon::prelude::*;
use vpl::cli::Disk;
use vpl::lang;
use vpl::plan::{Decision, Options, Sensor, Session, Simulated};
use vpl::rules::{RuleSet, Scene, SceneObject, Visibility};
use vpl::sense::{Noise, Simulator};

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Decisions of one or more runs, by how they compare.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    all: u32,
    /// The same view, or an end.
    same: u32,
    /// One of the next best by sight lines.
    next: u32,
    /// What those are worth by sight lines, as shares of the best one's score, summed.
    worth: f64,
    /// One ends and the other does not.
    ends: u32,
}

impl Tally {
    fn and(self, other: Self) -> Self {
        Self {
            all: self.all + other.all,
            same: self.same + other.same,
            next: self.next + other.next,
            worth: self.worth + other.worth,
            ends: self.ends + other.ends,
        }
    }
}

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("which program?")?;
    let starts = arguments.next().map_or(Ok(4), |n| n.parse::<usize>())?;
    let method = arguments.next();
    let rules = lang::compile(&file, &Disk)
        .rules
        .ok_or("the program has errors; see `vpl check`")?;
    let scene = rules.scenes.first().ok_or("the program needs a scene")?;
    println!("| object | decisions | same view | one of the next three | worth | another | ends apart |");
    println!("|---|--:|--:|--:|--:|--:|--:|");
    let mut total = Tally::default();
    for object in &scene.objects {
        let tally = of_object(&rules, scene, object, starts, method.as_deref())?;
        print(&object.name, &tally);
        total = total.and(tally);
    }
    print("all", &total);
    Ok(())
}

fn of_object(
    rules: &RuleSet,
    scene: &Scene,
    object: &SceneObject,
    starts: usize,
    method: Option<&str>,
) -> Result<Tally, Failure> {
    let task = rules.tasks.first().ok_or("the program needs a task")?;
    let simulator = Simulator::new(object, scene.backdrop, &task.space, std::path::Path::new("."))?;
    let session = |visibility: Visibility, seed: u64| {
        let mut rules = rules.clone();
        rules.tasks[0].visibility = visibility;
        let options = Options {
            method: method.map(str::to_owned),
            seed,
            ..Options::default()
        };
        Session::new(&rules, &rules.tasks[0].name, options)
    };
    let of_start = |k: usize| {
        let (exact, centre) = (
            session(Visibility::Exact, k as u64)?,
            session(Visibility::Centre, k as u64)?,
        );
        let start = k * exact.views().len() / starts;
        let sensor = Simulated {
            simulator: &simulator,
            camera: task.camera,
            noise: Noise::None,
            seed: k as u64,
        };
        of_run(exact, centre, sensor, start)
    };
    let tallies: Vec<Tally> = (0..starts)
        .into_par_iter()
        .map(of_start)
        .collect::<Result<_, Failure>>()?;
    Ok(tallies.into_iter().fold(Tally::default(), Tally::and))
}

fn of_run(
    mut exact: Session,
    mut centre: Session,
    mut sensor: Simulated<'_>,
    mut view: usize,
) -> Result<Tally, Failure> {
    let mut tally = Tally::default();
    for n in 1.. {
        let pose = exact.views()[view];
        let observation = sensor.measure(n, view, &pose)?;
        exact.observe(view, &observation)?;
        centre.observe(view, &observation)?;
        tally.all += 1;
        match (exact.next_view(), centre.next_view()) {
            (Decision::Next(ours), Decision::Next(theirs)) => {
                let rival = ours.runners_up.iter().find(|r| r.view == theirs.chosen.view);
                if ours.chosen.view == theirs.chosen.view {
                    tally.same += 1;
                } else if let Some(rival) = rival {
                    tally.next += 1;
                    tally.worth += rival.score / ours.chosen.score;
                }
                view = ours.chosen.view;
            }
            (Decision::Next(ours), Decision::End(_)) => {
                tally.ends += 1;
                view = ours.chosen.view;
            }
            (Decision::End(_), Decision::Next(_)) => {
                tally.ends += 1;
                break;
            }
            (Decision::End(_), Decision::End(_)) => {
                tally.same += 1;
                break;
            }
        }
    }
    Ok(tally)
}

fn print(name: &str, tally: &Tally) {
    let share = |n: u32| 100.0 * f64::from(n) / f64::from(tally.all.max(1));
    let worth = 100.0 * tally.worth / f64::from(tally.next.max(1));
    let other = tally.all - tally.same - tally.next - tally.ends;
    println!(
        "| {name} | {} | {:.1} % | {:.1} % | {worth:.1} % | {:.1} % | {:.1} % |",
        tally.all,
        share(tally.same),
        share(tally.next),
        share(other),
        share(tally.ends)
    );
}
