//! Time of a solve.

use std::time::Instant;

/// Nanoseconds that the present thread has run on a processor, where the system counts them (Linux).
#[cfg(target_os = "linux")]
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok()
}

#[cfg(not(target_os = "linux"))]
fn processor_time() -> Option<f64> {
    None
}

/// Processor time above which it is exact to a few per cent: the system counts it in steps of milliseconds \[s\].
const EXACT: f64 = 0.05;

/// A stopwatch of the processor time of the present thread. Short times, and all where the system does not count it,
/// are those on the clock.
pub(super) struct Stopwatch {
    processor: Option<f64>,
    clock: Instant,
}

impl Stopwatch {
    pub(super) fn start() -> Self {
        Self { processor: processor_time(), clock: Instant::now() }
    }

    /// Seconds since the start.
    pub(super) fn seconds(&self) -> f64 {
        let on_clock = self.clock.elapsed().as_secs_f64();
        match (self.processor, processor_time()) {
            (Some(start), Some(now)) if 1e-9 * (now - start) > EXACT => 1e-9 * (now - start),
            _ => on_clock,
        }
    }
}
