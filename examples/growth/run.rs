//! One run, and what its parts cost.

use std::path::Path;

use vpl::lang::{Memory, compile};
use vpl::plan::{ClosedLoop, Decision, Options, Part, Phase, Session, Simulated};
use vpl::sense::{Noise, Simulator};

use super::meter::{Clock, peak_mb, timed};
use super::program::Setting;

/// What a run cost: milliseconds of the process, the parts' a measurement.
#[derive(Clone, Debug, Default)]
pub struct Cost {
    check: f64,
    begin: f64,
    sense: f64,
    map: f64,
    detect: f64,
    score: f64,
    taken: usize,
    peak: f64,
}

impl Cost {
    pub const HEAD: [&'static str; 8] = [
        "check, ms",
        "begin, ms",
        "sense, ms",
        "map, ms",
        "detect, ms",
        "score, ms",
        "views",
        "memory, MB",
    ];

    pub fn of(&mut self, part: Part) -> &mut f64 {
        match part {
            Part::Sense => &mut self.sense,
            Part::Session(Phase::Map) => &mut self.map,
            Part::Session(Phase::Detect) => &mut self.detect,
            Part::Session(Phase::Score) => &mut self.score,
        }
    }

    pub fn words(&self) -> Vec<String> {
        let ms = [self.check, self.begin, self.sense, self.map, self.detect, self.score];
        let parts = ms.iter().map(|ms| format!("{ms:.1}"));
        parts
            .chain([self.taken.to_string(), format!("{:.0}", self.peak)])
            .collect()
    }
}

/// Runs a setting on one thread.
pub fn cost(setting: &Setting) -> Result<Cost, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    pool.map_err(|e| e.to_string())?;
    let text = setting.program();
    let (compiled, check) = timed(|| compile("growth.vpl", &Memory::of("growth.vpl", &text)));
    let rules = compiled.rules.ok_or_else(|| format!("{:?}", compiled.diagnostics))?;
    let (task, scene) = (&rules.tasks[0], &rules.scenes[0]);
    let simulator = Simulator::new(&scene.objects[0], scene.backdrop, &task.space, Path::new(""));
    let simulator = simulator.map_err(|e| e.to_string())?;
    let (session, begin) = timed(|| Session::new(&rules, &task.name, Options::default()));
    let mut session = session.map_err(|e| e.to_string())?;
    let mut cost = Cost {
        check,
        begin,
        ..Cost::default()
    };
    let sensor = Simulated {
        simulator: &simulator,
        camera: task.camera,
        noise: Noise::None,
        seed: 0,
    };
    let start = session.start();
    let mut turns = ClosedLoop::new(&mut session, sensor, start);
    loop {
        let mut clock = Clock::start();
        let step = turns
            .step(&mut |part| clock.lap(part, &mut cost))
            .map_err(|e| e.to_string())?;
        cost.taken += 1;
        if step.is_none_or(|step| matches!(step.decision, Decision::End(_))) {
            break;
        }
    }
    let taken = cost.taken as f64;
    for part in [&mut cost.sense, &mut cost.map, &mut cost.detect, &mut cost.score] {
        *part /= taken;
    }
    cost.peak = peak_mb();
    Ok(cost)
}
