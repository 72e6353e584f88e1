//! Signals of the process while Rust works.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::laws::Failure;

/// Time between two looks for signals.
const PERIOD: Duration = Duration::from_millis(50);

/// A question whether a signal has raised an exception, which is kept; asked again within
/// [`PERIOD`] it does not look.
pub(crate) fn on_signal() -> impl Fn() -> bool + Send + Sync + 'static {
    let looked = Mutex::new(Instant::now());
    move || {
        if Failure.is_set() {
            return true;
        }
        let Ok(mut looked) = looked.lock() else { return false };
        if looked.elapsed() < PERIOD {
            return false;
        }
        *looked = Instant::now();
        drop(looked);
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => false,
            Err(error) => {
                Failure.keep(error);
                true
            }
        }
    }
}

/// The same, or whether it is `deadline`.
pub(crate) fn on_signal_or_at(deadline: Instant) -> impl Fn() -> bool + Send + Sync + 'static {
    let signal = on_signal();
    move || signal() || Instant::now() >= deadline
}
