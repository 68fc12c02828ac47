//! Time and memory of this process.

use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};

use super::run::Cost;

/// The process's milliseconds so far.
pub fn now_ms() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), now.tv_nsec.unsigned_abs() as u32).as_secs_f64() * 1e3
}

/// A piece of work and its milliseconds.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = now_ms();
    let done = work();
    (done, now_ms() - start)
}

/// The most memory that the process has held, MB; 0 where the system does not say.
pub fn peak_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|l| l.trim().trim_end_matches("kB").trim().parse::<f64>().ok());
    kib.unwrap_or(0.0) * 1.024e-3
}

/// Tells the parts of a run apart.
pub struct Clock(f64);

impl Clock {
    pub fn start() -> Self {
        Self(now_ms())
    }

    /// Adds what passed since the last lap to a part.
    pub fn lap(&mut self, part: vpl::plan::Part, cost: &mut Cost) {
        let now = now_ms();
        *cost.of(part) += now - self.0;
        self.0 = now;
    }
}
