//! Every reader rejects pipes and devices at once: a pipe may block, a device has no end.
#![cfg(unix)]

use std::path::Path;
use std::process::Command;

use stribeck::Grid;
use stribeck::sim::{BodyStart, MixedLubricationSim, RunFolder, Scene, Schedule, solve_contact};
use stribeck::surface;
use stribeck::tribochem::GrowthCurve;

/// The message of each reader about `path`.
fn refusals(path: &Path) -> Vec<String> {
    let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build().unwrap();
    let mut scheduled = Scene::azam_2019(16);
    scheduled.schedule.load = Some(Schedule::Table { path: path.to_owned() });
    let grid = Grid::centred(4, 4, 1e-6, 1e-6).unwrap();
    vec![
        Scene::load(path).unwrap_err().to_string(),
        sim.restore(path).unwrap_err().to_string(),
        surface::read(path).unwrap_err().to_string(),
        solve_contact(&scheduled).unwrap_err().to_string(),
        BodyStart::read_npz(path, "ball", grid).unwrap_err().to_string(),
        GrowthCurve::read_csv(path).unwrap_err().to_string(),
    ]
}

#[test]
fn pipes_devices_and_folders_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let device = "this is a pipe or a device, give a file";
    for (path, reason) in [
        (pipe.as_path(), device),
        (Path::new("/dev/zero"), device),
        (folder.path(), "this is a folder, give a file"),
    ] {
        for error in refusals(path) {
            assert!(error.contains(path.to_str().unwrap()) && error.contains(reason), "{error}");
        }
    }
}

#[test]
fn history_and_lock_of_a_run_are_files() {
    let folder = tempfile::tempdir().unwrap();
    let build = || MixedLubricationSim::builder(Scene::azam_2019(16)).build().unwrap();
    RunFolder::create(folder.path(), &build(), 1).unwrap().finish(&build()).unwrap();
    for name in ["history.csv", "lock"] {
        let file = folder.path().join(name);
        std::fs::remove_file(&file).unwrap();
        assert!(Command::new("mkfifo").arg(&file).status().unwrap().success());
        let error = RunFolder::resume(folder.path(), &mut build(), 1).unwrap_err().to_string();
        assert!(error.contains(&format!("{name}: this is a pipe or a device")), "{error}");
    }
}
