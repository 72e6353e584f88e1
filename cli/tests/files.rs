//! Files of the command: none is replaced without `--force`, none is left half written.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{assert_refused, error_of, repository, stribeck, text};

/// A smooth dry contact on few cells.
fn scene(folder: &Path) -> PathBuf {
    let path = folder.join("scene.toml");
    let scene = "[form]\nkind = \"sphere\"\nradius = 9.5e-3\n[elastic]\nequivalent_modulus = 2.3e11\n[load]\nforce = 20.0\n\
                 [motion]\nentrainment_speed = 0.5\nslide_roll_ratio = 0.1\n\
                 [grid]\nnx = 24\nny = 24\nx = [-2e-4, 2e-4]\ny = [-2e-4, 2e-4]\n";
    fs::write(&path, scene).unwrap();
    path
}

/// A contact in oil on few cells.
fn oiled(folder: &Path) -> PathBuf {
    let path = folder.join("oiled.toml");
    let scene = fs::read_to_string(scene(folder)).unwrap();
    let oil = "[lubricant]\neta0 = 0.02\nalpha = 2e-8\nroelands_z = 0.68\n";
    fs::write(&path, scene + oil).unwrap();
    path
}

/// Names of the files in `folder`, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Each file that a subcommand writes is kept when another one of the same name is to be written.
#[test]
fn an_existing_file_is_replaced_with_force_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (dry, oil, out) = (scene(folder.path()), oiled(folder.path()), folder.path().join("out"));
    fs::create_dir(&out).unwrap();
    let file = |name: &str| out.join(name);
    let surface = folder.path().join("plain.txt");
    fs::write(&surface, "# unit: um\n1 2\n3 5\n").unwrap();
    let fields = file("fields.npz");
    let rows = file("rows.csv");
    let (dry, oil, surface, to) = (text(&dry), text(&oil), text(&surface), text(&out));
    let steps = ["--steps", "1", "--time-step", "1"];
    let cases: [(Vec<&str>, &str); 8] = [
        (vec!["solve", dry, "--fields", text(&fields)], "fields.npz"),
        (vec!["solve", dry, "--plot", "--out", to], "scene_maps.svg"),
        (vec!["solve", dry, "--plot", "--out", to], "scene_profile.png"),
        (vec!["curve", oil, "--points", "2", "--from", "1", "--to", "2", "--out", to], "oiled_curve.csv"),
        (
            vec!["curve", oil, "--points", "2", "--from", "1", "--to", "2", "--plot", "--out", to],
            "oiled_curve.svg",
        ),
        (vec!["surface", surface, "--plot", "--out", to], "plain_surface.svg"),
        ([&["run", dry, "--csv", text(&rows)], steps.as_slice()].concat(), "rows.csv"),
        ([&["run", dry, "--out", to], steps.as_slice()].concat(), "run.toml"),
    ];
    for (arguments, name) in cases {
        fs::write(file(name), "mine").unwrap();
        assert_refused(&arguments, &[name, "the file exists; --force writes over it"]);
        assert_eq!(fs::read_to_string(file(name)).unwrap(), "mine", "{arguments:?}");
        let output = stribeck(&[arguments.as_slice(), &["--force"]].concat());
        assert!(output.status.success(), "{arguments:?} {output:?}");
        assert_ne!(fs::read(file(name)).unwrap(), b"mine", "{arguments:?}");
        assert!(names(&out).iter().all(|name| !name.ends_with(".partial")), "{:?}", names(&out));
        fs::remove_dir_all(&out).unwrap();
        fs::create_dir(&out).unwrap();
    }
}

/// The fields of a solve do not replace those of a run, from which another run may begin.
#[test]
fn fields_of_a_run_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let (dry, out) = (scene(folder.path()), folder.path().join("run"));
    let run = ["run", text(&dry), "--steps", "1", "--time-step", "1", "--out", text(&out)];
    assert!(stribeck(&run).status.success());
    let fields = out.join("fields.npz");
    let before = fs::read(&fields).unwrap();
    assert_refused(&["solve", text(&dry), "--fields", text(&fields)], &["fields.npz", "--force"]);
    assert_eq!(fs::read(&fields).unwrap(), before);
}

#[test]
fn two_outputs_of_one_name_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (dry, out) = (scene(folder.path()), folder.path().join("run"));
    let csv = out.join("history.csv");
    let run =
        ["run", text(&dry), "--steps", "1", "--time-step", "1", "--out", text(&out), "--csv", text(&csv)];
    assert_refused(&run, &["history.csv: two outputs of this command have this name"]);
}

/// `/dev/full` is a disk without space.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_in_plain_words_and_leaves_no_part_of_a_file() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let (dry, oil, out) = (scene(folder.path()), oiled(folder.path()), folder.path().join("out"));
    fs::create_dir(&out).unwrap();
    let (dry, oil, to) = (text(&dry), text(&oil), text(&out));
    let full = "the disk is full";
    assert_refused(&["solve", dry, "--fields", "/dev/full"], &["/dev/full: ", full]);
    let steps = ["--steps", "1", "--time-step", "1", "--csv", "/dev/full"];
    assert_refused(&[&["run", dry], steps.as_slice()].concat(), &["/dev/full: ", full]);
    symlink("/dev/full", out.join("oiled_curve.csv")).unwrap();
    let curve = ["curve", oil, "--points", "2", "--from", "1", "--to", "2", "--out", to];
    assert_refused(&curve, &["oiled_curve.csv: ", full]);
    symlink("/dev/full", out.join("scene_maps.png")).unwrap();
    assert_refused(&["solve", dry, "--plot", "--out", to], &["scene_maps.png: ", full]);
    assert_eq!(names(&out), ["oiled_curve.csv", "scene_maps.png", "scene_maps.svg"]);
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_stribeck"))
        .args(["solve", dry])
        .stdout(fs::File::options().write(true).open("/dev/full").unwrap())
        .output()
        .unwrap();
    let message = error_of(&output);
    assert!(
        output.status.code() == Some(2) && message.contains(&format!("standard output: {full}")),
        "{message}"
    );
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_the_solve() {
    let folder = tempfile::tempdir().unwrap();
    let (dry, file) = (scene(folder.path()), folder.path().join("a_file"));
    fs::write(&file, "").unwrap();
    let below = file.join("fields.npz");
    assert_refused(
        &["solve", text(&dry), "--fields", text(&below)],
        &["fields.npz: ", "is a file, not a folder"],
    );
    assert_refused(
        &["solve", text(&dry), "--fields", text(folder.path())],
        &["this is a folder, give a file"],
    );
    let nowhere = folder.path().join("nowhere").join("fields.npz");
    assert_refused(
        &["solve", text(&dry), "--fields", text(&nowhere)],
        &["there is no folder", "nowhere; make it first"],
    );
    for command in ["solve", "run"] {
        let rest: &[&str] =
            if command == "run" { &["--steps", "1", "--time-step", "1"] } else { &["--plot"] };
        let arguments = [&[command, text(&dry), "--out", text(&file)], rest].concat();
        assert_refused(&arguments, &["a_file: ", "is a file, not a folder"]);
    }
}

/// The folder is made, and the same command once more says how to go on.
#[test]
fn repeated_curve_names_both_remedies() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/scenes/smooth.toml");
    let out = folder.path().join("new").join("folder");
    let arguments = ["curve", text(&scene), "--points", "2", "--from", "1", "--to", "2", "--out", text(&out)];
    let output = stribeck(&arguments);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(names(&out), ["smooth_curve.csv"]);
    assert_refused(&arguments, &["smooth_curve.csv: the file exists", "--out FOLDER writes elsewhere"]);
}
