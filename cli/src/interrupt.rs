//! Ctrl-C: the first one ends a computation in good order, the second one at once.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::output;

/// Set by the first interruption.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);
/// Exit status of a program that an interruption ends.
const KILLED: i32 = 130;

/// Listens from now on; `message` is printed at the first interruption.
pub(crate) fn listen(message: &'static str) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(move || {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            process::exit(KILLED);
        }
        output::complain("interrupted", &format!("{message}; once more ends it at once"));
    })
}

/// Whether there was an interruption.
pub(crate) fn is_requested() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}
