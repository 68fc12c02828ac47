//! Time and memory of a piece of work.

use std::time::{Duration, Instant};

use peak_alloc::PeakAlloc;
use rustix::time::{ClockId, clock_gettime};

/// Counts the live bytes of the heap.
#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// How long a piece of work took.
#[derive(Clone, Copy, Debug)]
pub struct Took {
    /// By the clock on the wall.
    pub wall: Duration,
    /// Of all the process's threads.
    pub cpu: Duration,
}

impl Took {
    /// Seconds to judge by: the process's on one thread, the wall's on more.
    pub fn seconds(&self, threads: usize) -> f64 {
        if threads == 1 { self.cpu } else { self.wall }.as_secs_f64()
    }
}

/// A piece of work and what it cost. Memory is in MiB.
pub struct Measured<T> {
    pub done: T,
    pub took: Took,
    /// Live heap that it left.
    pub heap_mb: f64,
    /// The most live heap while it went on.
    pub peak_heap_mb: f64,
    /// By how much the process's largest resident set grew.
    pub peak_mb: f64,
}

/// Times a piece of work.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Took) {
    let (wall, cpu) = (Instant::now(), process_time());
    let done = std::hint::black_box(work());
    let took = Took {
        wall: wall.elapsed(),
        cpu: process_time().saturating_sub(cpu),
    };
    (done, took)
}

/// Measures a piece of work.
pub fn measured<T>(work: impl FnOnce() -> T) -> Measured<T> {
    let (resident, heap) = (largest_resident_mb(), heap_mb(HEAP.current_usage()));
    HEAP.reset_peak_usage();
    let (done, took) = timed(work);
    Measured {
        done,
        took,
        heap_mb: heap_mb(HEAP.current_usage()) - heap,
        peak_heap_mb: heap_mb(HEAP.peak_usage()) - heap,
        peak_mb: largest_resident_mb() - resident,
    }
}

fn heap_mb(bytes: usize) -> f64 {
    bytes as f64 / 1_048_576.0
}

fn process_time() -> Duration {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), now.tv_nsec.unsigned_abs() as u32)
}

/// The most memory that the process has held; 0 where the system does not say.
fn largest_resident_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|l| l.trim().trim_end_matches("kB").trim().parse::<f64>().ok());
    kib.unwrap_or(0.0) / 1024.0
}
