//! Helpers of several tests.

pub(crate) mod coated;
pub(crate) mod dense;
pub(crate) mod free_volume;
pub(crate) mod pocket_slider;
pub(crate) mod rolling;
pub(crate) mod runs;
pub(crate) mod scene_text;

use std::path::PathBuf;

/// The program of the example `name`. `cargo test` builds it; a run of one file of tests does not.
pub(crate) fn example(name: &str) -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let folder = test.ancestors().nth(2).unwrap().join("examples");
    let program = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(
        program.exists(),
        "{} is missing: `cargo build --release --example {name}` builds it",
        program.display()
    );
    program
}
