//! Wrong inputs: each ends with status 2 and one line with field, value and remedy, and prints nothing else.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use std::path::Path;

use common::{assert_refused, stribeck, text};

/// A mixed contact without a mistake.
const GOOD: &str = r#"
[form]
kind = "sphere"
radius = "9.525 mm"
[elastic]
equivalent_modulus = "230 GPa"
[load]
force = "20 N"
[motion]
entrainment_speed = 0.1
slide_roll_ratio = 0.05
[lubricant]
eta0 = 0.01
alpha = "18 1/GPa"
roelands_z = 0.68
[grid]
nx = 24
ny = 24
x = ["-0.25 mm", "0.25 mm"]
y = ["-0.25 mm", "0.25 mm"]
[roughness.disc]
kind = "gaussian"
rq = "50 nm"
length_x = "70 um"
length_y = "70 um"
seed = 1
[plastic]
hardness = "6 GPa"
[friction]
boundary_coefficient = 0.115
eyring_stress = "5 MPa"
[solver]
tolerance = 1e-5
"#;

/// A table of the good scene.
const ROUGHNESS: &str =
    "kind = \"gaussian\"\nrq = \"50 nm\"\nlength_x = \"70 um\"\nlength_y = \"70 um\"\nseed = 1";
const MODULUS: &str = "equivalent_modulus = \"230 GPa\"";
const X: &str = "x = [\"-0.25 mm\", \"0.25 mm\"]\ny";

/// Text of the good scene, a mistake in its place, and words of the message.
const SCENES: [(&str, &str, &[&str]); 71] = [
    // Numbers and units.
    (
        "\"9.525 mm\"",
        "\"9,525 mm\"",
        &["form.radius = \"9,525 mm\"", "decimal separator is a point: \"9.525 mm\""],
    ),
    (
        X,
        "x = [\"-5 um\", \"5 um\"]\ny",
        &["grid.x: the box ends 5.0000e-6 m", "inside of the contact", "at least from"],
    ),
    ("\"18 1/GPa\"", "18e9", &["lubricant.alpha = 1.8e10", "is implausible", "2e-8 is usual"]),
    ("hardness = \"6 GPa\"", "hardness = \"0.05 GPa\"", &["less than 1.050347e1 N at th", "less load"]),
    ("roelands_z = 0.68", "roelands_z = 68", &["lubricant.roelands_z = 68", "0.6 is usual"]),
    (
        "boundary_coefficient = 0.115",
        "boundary_coefficient = 11.5",
        &["friction.boundary_coefficient = 11.5", "did you mean 11.5 %"],
    ),
    (
        "[solver]",
        "[thermal]\nbulk_temperature = 80\n[solver]",
        &["thermal.bulk_temperature = 80", "did you mean 80 degC = 353.15 K"],
    ),
    (
        "[solver]",
        "[wear]\nexposure = \"track\"\ncoefficient = \"1e-6 mm3/(N m)\"\n[solver]",
        &["wear.coefficient = \"1e-6 mm3/(N m)\"", "specific wear rate", "times the hardness", "it is 6e-6"],
    ),
    ("\"9.525 mm\"", "9,525e-3", &["line 4", "9,525e-3", "decimal separator is a point: \"9.525e-3\""]),
    ("\"9.525 mm\"", "9.525 mm", &["line 4", "a number with a unit is text in quotes: \"9.525 mm\""]),
    ("\"9.525 mm\"", "\"9.525\"", &["form.radius = \"9.525\"", "the unit is missing", "mm"]),
    ("\"9.525 mm\"", "\"3/8 inch\"", &["form.radius = \"3/8 inch\"", "mm"]),
    ("\"9.525 mm\"", "\"\"", &["form.radius = \"\"", "must be a number"]),
    ("\"9.525 mm\"", "[9.5e-3]", &["form.radius", "a list, expected a number"]),
    ("\"9.525 mm\"", "{ mm = 9.5 }", &["form.radius", "a table, expected a number"]),
    ("\"9.525 mm\"", "0", &["form.radius = 0", "> 0"]),
    ("\"9.525 mm\"", "nan", &["form.radius = NaN"]),
    ("\"9.525 mm\"", "inf", &["form.radius = inf"]),
    ("\"9.525 mm\"", "9525", &["form.radius = 9525", "did you mean 9525 um"]),
    ("\"230 GPa\"", "230", &["elastic.equivalent_modulus = 230", "did you mean 230 GPa"]),
    ("\"230 GPa\"", "\"-230 GPa\"", &["elastic.equivalent_modulus = -2.3e11", "> 0"]),
    ("\"20 N\"", "\"20 kg\"", &["load.force = \"20 kg\"", "N, mN or kN"]),
    ("\"20 N\"", "-20", &["load.force = -20", "> 0"]),
    ("force = \"20 N\"", "hertz_pressure = 1.0", &["load.hertz_pressure = 1", "did you mean 1 GPa"]),
    ("= 0.1\n", "= -3\n", &["motion.entrainment_speed = -3", "flows along +x"]),
    ("= 0.1\n", "= \"-3 m/s\"\n", &["motion.entrainment_speed = -3", "flows along +x"]),
    ("= 0.1\n", "= \"100 rpm\"\n", &["motion.entrainment_speed = \"100 rpm\"", "m/s"]),
    ("= 0.05", "= \"5 percent\"", &["motion.slide_roll_ratio = \"5 percent\"", "%"]),
    ("= 0.05", "= nan", &["motion.slide_roll_ratio = NaN"]),
    ("eta0 = 0.01", "eta0 = \"4 cSt\"", &["lubricant.eta0 = \"4 cSt\"", "density", "\"3.4 mPa s\""]),
    ("eta0 = 0.01", "eta0 = \"32 mm\u{b2}/s\"", &["lubricant.eta0", "density", "\"27.2 mPa s\""]),
    ("eta0 = 0.01", "eta0 = 0", &["lubricant.eta0 = 0", "> 0"]),
    ("\"18 1/GPa\"", "12", &["lubricant.alpha = 12", "did you mean 12 1/GPa"]),
    ("\"18 1/GPa\"", "0.022", &["lubricant.alpha = 0.022", "did you mean 0.022 1/MPa"]),
    ("\"18 1/GPa\"", "\"18 GPa\"", &["lubricant.alpha = \"18 GPa\"", "1/GPa"]),
    ("roelands_z = 0.68", "roelands_z = \"0,68\"", &["lubricant.roelands_z", "0,68", "expected a number"]),
    ("rq = \"50 nm\"", "rq = 0.05", &["roughness.disc.rq = 0.05", "did you mean 0.05 um"]),
    ("rq = \"50 nm\"", "rq = 50", &["roughness.disc.rq = 50", "did you mean 50 nm"]),
    ("rq = \"50 nm\"", "rq = -5e-8", &["roughness.disc.rq = -5e-8", ">= 0"]),
    ("length_x = \"70 um\"", "length_x = \"70 u\"", &["roughness.disc.length_x = \"70 u\"", "um"]),
    (
        "length_x = \"70 um\"",
        "length_x = 70",
        &["roughness.disc.length_x = 70", "at most the size of the grid"],
    ),
    ("\"6 GPa\"", "6", &["plastic.hardness = 6", "did you mean 6 GPa"]),
    ("\"6 GPa\"", "\"60 HRC\"", &["plastic.hardness = \"60 HRC\"", "GPa"]),
    ("\"5 MPa\"", "5", &["friction.eyring_stress = 5", "did you mean 5 MPa"]),
    ("[solver]", "[thermal]\nbulk_temperature = \"80 F\"\n[solver]", &["thermal.bulk_temperature", "degC"]),
    ("tolerance = 1e-5", "film_cutoff = 1", &["solver.film_cutoff = 1", "did you mean 1 nm"]),
    ("tolerance = 1e-5", "tolerance = 2", &["solver.tolerance = 2", "at most"]),
    // Tables, keys and types.
    ("\"sphere\"", "\"ball\"", &["form.kind", "ball", "sphere"]),
    ("radius = ", "raduis = ", &["raduis", "radius"]),
    ("[form]", "[Form]", &["Form", "form"]),
    (MODULUS, "youngs_modulus = \"210 GPa\"", &["youngs_modulus", "equivalent_modulus"]),
    ("force = ", "load = ", &["load", "force"]),
    ("nx = 24\n", "", &["missing key `nx`", "grid"]),
    ("nx = 24", "nx = 24.0", &["grid.nx", "24.0", "whole number"]),
    ("nx = 24", "nx = -24", &["grid.nx", "-24", "whole number"]),
    ("nx = 24", "nx = 99999999", &["grid.nx", "at most"]),
    ("nx = 24\n", "nx = 24\nnx = 25\n", &["duplicate key", "nx = 25"]),
    ("[roughness.disc]", "[roughness.flat]", &["flat", "ball", "disc"]),
    ("[roughness.disc]", "[[roughness.disc]]", &["roughness.disc", "a list where a table is expected"]),
    ("seed = 1", "seed = -1", &["roughness.disc.seed", "-1", "whole number from 0"]),
    ("tolerance = 1e-5", "estimate = \"yes\"", &["solver.estimate", "yes", "true or false"]),
    ("[solver]", "[solver", &["[solver", "]"]),
    // Limits.
    (X, "x = [\"0.25 mm\", \"-0.25 mm\"]\ny", &["grid.x = -0.00025", "above the lower edge"]),
    (X, "x = [\"0.1 mm\", \"0.25 mm\"]\ny", &["grid.x", "outside the box"]),
    (X, "x = [-0,25e-3, 0,25e-3]\ny", &["grid.x", "a list of 4", "two outer edges", "decimal point"]),
    (
        "[solver]",
        "[schedule.load]\nkind = \"steps\"\ntimes = [5, 0]\nvalues = [20, 30]\n[solver]",
        &["schedule.load.times[0] = 5"],
    ),
    // Files.
    (ROUGHNESS, "kind = \"file\"\npath = \"none.npy\"", &["roughness.disc.path", "none.npy"]),
    (
        ROUGHNESS,
        "kind = \"file\"\npath = \"folder\"",
        &["roughness.disc.path", "this is a folder, give a file"],
    ),
    (ROUGHNESS, "kind = \"file\"\npath = \"empty.txt\"", &["roughness.disc.path", "empty.txt"]),
    (ROUGHNESS, "kind = \"file\"\npath = \"binary.bin\"", &["roughness.disc.path", "binary.bin"]),
    (
        ROUGHNESS,
        "kind = \"file\"\npath = \"micrometres.txt\"",
        &["roughness.disc_rq = 0.0", "did you mean 0.0", "um"],
    ),
];

/// Writes the files that mistakes name into `folder`.
fn write_files(folder: &Path) {
    std::fs::create_dir(folder.join("folder")).unwrap();
    std::fs::write(folder.join("empty.txt"), "").unwrap();
    std::fs::write(folder.join("binary.bin"), (0..=255).collect::<Vec<u8>>()).unwrap();
    let height = |node: usize| format!("{:e} ", 0.05 * ((37 * node % 24) as f64 / 24.0 - 0.5));
    let row = |j: usize| (0..24).map(|i| height(i + 7 * j)).collect::<String>() + "\n";
    std::fs::write(folder.join("micrometres.txt"), (0..24).map(row).collect::<String>()).unwrap();
}

#[test]
fn wrong_scenes_are_refused_by_every_subcommand() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    let (path, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    let (scene, out) = (text(&path), text(&out));
    let commands: [&[&str]; 4] = [
        &["check", scene],
        &["solve", scene],
        &["curve", scene, "--points", "2", "--from", "0.1", "--to", "0.2", "--out", out],
        &["run", scene, "--steps", "1", "--time-step", "1"],
    ];
    std::fs::write(&path, GOOD).unwrap();
    assert!(stribeck(commands[0]).status.success());
    for (from, to, words) in SCENES {
        assert!(GOOD.contains(from), "{from}");
        std::fs::write(&path, GOOD.replacen(from, to, 1)).unwrap();
        for command in commands {
            assert_refused(command, &[&["scene.toml: "], words].concat());
        }
    }
    let left = std::fs::read_dir(out).map_or(0, Iterator::count);
    assert_eq!(left, 0, "files of curves that did not begin");
}

#[test]
fn wrong_options_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(place("scene.toml"), GOOD).unwrap();
    // S, N, D, F: the scene, a new file, a folder and a file that is no scene.
    let cases: [(&str, &[&str]); 44] = [
        ("curve S --over velocity", &["velocity", "slide_roll_ratio"]),
        ("curve S --over temperature", &["--over temperature", "lubricant.grade"]),
        ("curve S --over load --from 1m", &["--from = \"1m\"", "N, mN or kN"]),
        ("curve S --over load --to 1uN", &["--to = \"1uN\"", "kN"]),
        ("curve S --over slide_roll_ratio --from 1 --to 10%", &["--to = 0.1 must be above --from = 1"]),
        ("completion cmd", &["cmd", "bash"]),
        ("slove S", &["slove", "solve"]),
        ("solve", &["<SCENE>"]),
        ("solve N", &["new.toml: ", "no such file"]),
        ("solve D", &["folder: this is a folder, give a file"]),
        ("solve F", &["binary.bin: the file is not text"]),
        ("solve S --fields D", &["folder: this is a folder, give a file"]),
        ("solve S --plots", &["--plots", "--plot"]),
        ("check S --force", &["--force"]),
        ("curve S --from 0", &["--from = 0", "> 0"]),
        ("curve S --from -3", &["--from = -3", "+x"]),
        ("curve S --from 0,1", &["--from = \"0,1\"", "a point: \"0.1\""]),
        ("curve S --from 1m", &["--from = \"1m\"", "m/s"]),
        ("curve S --to nan", &["--to = NaN"]),
        ("curve S --from 1 --to 0.1", &["--to = 0.1 m/s must be above --from = 1 m/s"]),
        ("curve S --points 1", &["--points = \"1\"", "from 2 to 1000"]),
        ("curve S --points 2.5", &["--points = \"2.5\"", "whole number"]),
        ("curve S --seeds 0", &["--seeds = \"0\"", "from 1 to 1000"]),
        ("run S", &["--duration", "--time-step"]),
        ("run S --steps 0 --time-step 1", &["--steps = \"0\"", "from 1"]),
        ("run S --steps 1 --time-step 1,5", &["--time-step = \"1,5\"", "a point: \"1.5\""]),
        ("run S --duration 2hours", &["--duration = \"2hours\"", "h"]),
        ("run S --duration 1e300 --time-step 1e-300", &["time_step = 1e-300", "longer"]),
        ("run S --steps 1 --time-step 1 --resume", &["--out"]),
        ("run S --steps 1 --time-step 1 --csv D", &["folder: this is a folder, give a file"]),
        ("run S --steps 1 --time-step 1 --out F", &["binary.bin: ", "give a folder"]),
        ("run S --steps 1 --time-step 1 --resume --force --out D", &["--force", "--resume"]),
        ("surface N", &["new.toml: No such file"]),
        ("surface D", &["folder: this is a folder, give a file"]),
        ("surface F", &["binary.bin: neither x3p"]),
        ("surface S", &["scene.toml: no heights", "`stribeck check` takes scene files"]),
        ("solve S --fields missing/x.npz", &["missing/x.npz: there is no folder missing; make it first"]),
        ("init missing/x.toml", &["missing/x.toml: there is no folder missing; make it first"]),
        ("init N --radius 9,525mm", &["--radius = \"9,525mm\"", "a point: \"9.525mm\""]),
        ("init N --eta0 4cSt", &["--eta0 = \"4cSt\"", "density"]),
        ("init N --alpha 12", &["--alpha = 12", "did you mean 12 1/GPa"]),
        ("init N --speed -3", &["--speed = -3", "+x"]),
        ("init N --roughness 50", &["--roughness = 50", "did you mean 50 nm"]),
        ("init S", &["scene.toml: ", "exists; --force writes over it"]),
    ];
    for (line, words) in cases {
        let argument = |word: &str| match word {
            "S" => place("scene.toml"),
            "N" => place("new.toml"),
            "D" => place("folder"),
            "F" => place("binary.bin"),
            _ => word.to_owned(),
        };
        assert_refused(&line.split_whitespace().map(argument).collect::<Vec<_>>(), words);
        assert!(!folder.path().join("new.toml").exists(), "{line}");
    }
}

#[test]
fn manual_pages_have_the_options_of_the_command() {
    let page = |arguments: &[&str]| String::from_utf8(stribeck(arguments).stdout).unwrap();
    assert!(page(&["man"]).starts_with(".ie"), "roff");
    let solve = page(&["man", "solve"]);
    assert!(solve.contains(".TH") && solve.contains("\\-\\-report"), "{solve}");
    assert_refused(&["man", "solv"], &["there is no subcommand solv", "--help"]);
}
