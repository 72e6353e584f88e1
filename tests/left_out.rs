//! Warnings about physics that a scene leaves out: a contact on either side of each bound, in solves,
//! runs and before the solve.

use stribeck::sim::{MixedLubricationSim, Scene, Warning, solve_contact};

/// A smooth steel ball in an oil that thins, slow and cool.
const BALL: &str = r#"
form = { kind = "sphere", radius = 9.525e-3 }
elastic = { equivalent_modulus = 229.67e9 }
load = { hertz_pressure = 0.8e9 }
motion = { entrainment_speed = 0.5, slide_roll_ratio = 0.1 }
lubricant = { eta0 = 0.02, roelands_z = 0.68 }
grid = { nx = 48, ny = 48, x = [-0.25e-3, 0.25e-3], y = [-0.25e-3, 0.25e-3] }
friction = { eyring_stress = 5e6 }
solver = { tolerance = 1e-4 }
"#;
const ROLLER: &str = r#"
form = { kind = "cylinder", radius = 10e-3 }
elastic = { equivalent_modulus = 230e9 }
load = { force = 175e3 }
motion = { entrainment_speed = 0.02, slide_roll_ratio = 0.05 }
lubricant = { eta0 = 0.005, roelands_z = 0.68, alpha = 18e-9 }
grid = { nx = 256, x = [-0.4e-3, 0.3e-3] }
friction = { eyring_stress = 5e6 }
solver = { tolerance = 1e-4 }
[roughness.disc]
kind = "gaussian"
rq = 200e-9
length_x = 40e-6
length_y = 40e-6
seed = 1
"#;

fn scene(text: &str, changes: &[(&str, &str)]) -> Scene {
    let changed = changes.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    Scene::from_toml(&changed).unwrap_or_else(|error| panic!("{error}: {changed}"))
}

fn about<'a>(warnings: &'a [Warning], field: &str) -> Vec<&'a Warning> {
    warnings.iter().filter(|warning| warning.field == field).collect()
}

/// Those about `field` after a solve and after two steps of a run, which must be as many.
fn solved(scene: &Scene, field: &str) -> Vec<Warning> {
    let solution = solve_contact(scene).unwrap();
    solution.report.require_converged().unwrap();
    let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    sim.step(1.0).unwrap();
    sim.step(1.0).unwrap();
    assert_eq!(
        about(sim.warnings(), field).len(),
        about(&solution.warnings, field).len(),
        "{:?}",
        sim.warnings()
    );
    about(&solution.warnings, field).into_iter().cloned().collect()
}

/// Those about `field` before a solve.
fn expected(scene: &Scene, field: &str) -> usize {
    let sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    about(&sim.expected_warnings().unwrap(), field).len()
}

#[test]
fn hot_isothermal_film_warns() {
    let field = "friction.coefficient";
    let cool = scene(BALL, &[]);
    let hot = scene(BALL, &[("_speed = 0.5", "_speed = 2.0"), ("_ratio = 0.1", "_ratio = 0.7")]);
    assert!(solved(&cool, field).is_empty() && expected(&cool, field) == 0);
    let found = solved(&hot, field);
    assert!(found.len() == 1 && found[0].message.contains("1.4 m/s of sliding"), "{found:?}");
    assert!(found[0].remedy.contains("[lubricant.thermal]") && expected(&hot, field) == 1, "{found:?}");
    // Modelled, it is not left out.
    let temperature = "roelands_z = 0.68, temperature = 300.0, roelands_s0 = 1.1, thermal = {}";
    let changes = [
        ("_speed = 0.5", "_speed = 2.0"),
        ("_ratio = 0.1", "_ratio = 0.7"),
        ("roelands_z = 0.68", temperature),
    ];
    let modelled = scene(BALL, &changes);
    assert!(about(&solve_contact(&modelled).unwrap().warnings, field).is_empty());
}

/// The rise in the warning against the film of the same contact that has its own temperature.
#[test]
#[ignore = "slow"]
fn estimated_heating_is_within_a_quarter_of_the_thermal_film() {
    for (speed, ratio, eta0) in [("8.0", "1.5", "0.02"), ("2.0", "0.5", "0.02"), ("4.0", "1.0", "0.006")] {
        let oil = format!("eta0 = {eta0}, temperature = 353.15, roelands_s0 = 1.1");
        let changes = [
            ("_speed = 0.5", format!("_speed = {speed}")),
            ("_ratio = 0.1", format!("_ratio = {ratio}")),
            ("eta0 = 0.02", oil),
            ("solver =", "thermal = { bulk_temperature = 353.15 }\nsolver =".to_owned()),
        ];
        let mut changes: Vec<(&str, &str)> = changes.iter().map(|(from, to)| (*from, to.as_str())).collect();
        let found = solve_contact(&scene(BALL, &changes)).unwrap().warnings;
        let message = about(&found, "friction.coefficient")[0].message.clone();
        let rise =
            message.split("by about ").nth(1).unwrap().split(' ').next().unwrap().parse::<f64>().unwrap();
        changes.push(("roelands_z = 0.68", "roelands_z = 0.68, thermal = {}"));
        let thermal = solve_contact(&scene(BALL, &changes)).unwrap().thermal.unwrap();
        let found = thermal.film_temperature_mean_central - 353.15;
        assert!(
            (rise / found - 1.0).abs() < 0.25,
            "{speed} m/s, ratio {ratio}: {rise} K estimated, {found} K found"
        );
    }
}

#[test]
fn newtonian_stress_above_50_mpa_warns() {
    let field = "friction.fluid";
    let low = scene(BALL, &[("friction = { eyring_stress = 5e6 }", ""), ("_ratio = 0.1", "_ratio = 0.001")]);
    let high = scene(BALL, &[("friction = { eyring_stress = 5e6 }", "")]);
    assert!(solved(&low, field).is_empty());
    let found = solved(&high, field);
    assert!(
        found.len() == 1 && found[0].message.contains("Newtonian") && found[0].remedy.contains("eyring"),
        "{found:?}"
    );
    assert!(solved(&scene(BALL, &[]), field).is_empty(), "it thins");
    assert_eq!([expected(&low, field), expected(&high, field)], [0, 1]);
}

#[test]
fn ridges_that_touch_warn() {
    let field = "contact.load_ratio";
    let slow = scene(ROLLER, &[("_speed = 0.02", "_speed = 0.005")]);
    let fast = scene(ROLLER, &[("_speed = 0.02", "_speed = 0.5")]);
    let found = solved(&slow, field);
    assert!(found.len() == 1 && found[0].value > 0.5 && found[0].message.contains("ridges"), "{found:?}");
    // Ridges that carry nothing in a film of less than three Rq.
    let found = solved(&fast, field);
    assert!(found.len() == 1 && found[0].value < 0.01 && found[0].message.contains("ridges"), "{found:?}");
    assert!(found[0].remedy.contains("strip"), "{found:?}");
    let thick = scene(ROLLER, &[("_speed = 0.02", "_speed = 5.0"), ("rq = 200e-9", "rq = 20e-9")]);
    assert!(solved(&thick, field).is_empty());
    assert_eq!([expected(&slow, field), expected(&fast, field), expected(&thick, field)], [1, 1, 0]);
}

/// Heights of 1.5 um on 32 um in dry contact: more than 8 GPa of steel on steel without a limit.
#[test]
fn pressures_that_no_material_carries_warn() {
    let text = r#"
form = { kind = "sphere", radius = 9.525e-3 }
elastic = { equivalent_modulus = 229.67e9 }
load = { hertz_pressure = 1.2e9 }
motion = { entrainment_speed = 0.1, slide_roll_ratio = 0.05 }
grid = { nx = 48, ny = 48, x = [-0.25e-3, 0.25e-3], y = [-0.25e-3, 0.25e-3] }
solver = { edge_contact = true }
[roughness.disc]
kind = "gaussian"
rq = 1500e-9
length_x = 32e-6
length_y = 32e-6
seed = 1
"#;
    let field = "pressure.max";
    let found = solved(&scene(text, &[]), field);
    assert!(found.len() == 1 && found[0].remedy.contains("[plastic]"), "{found:?}");
    assert!(found[0].value > 0.035 * 229.67e9);
    let limited = scene(&format!("{text}[plastic]\nhardness = 7e9\n"), &[]);
    assert!(solved(&limited, field).is_empty());
}

#[test]
fn yield_beyond_the_pressure_limit_warns() {
    let plastic = |hardness: &str| {
        scene(BALL, &[("solver =", &format!("plastic = {{ hardness = {hardness} }}\nsolver ="))])
    };
    let found = |scene: &Scene, field: &str| about(&scene.warnings(), field).len();
    assert_eq!(
        [found(&plastic("0.79e9"), "plastic.hardness"), found(&plastic("0.81e9"), "plastic.hardness")],
        [1, 0]
    );
    // 0.62 times 0.8 GPa is 0.496 GPa.
    let stress = |strength: &str| {
        scene(BALL, &[("solver =", &format!("stress = {{ yield_strength = {strength} }}\nsolver ="))])
    };
    let field = "stress.yield_strength";
    assert_eq!([found(&stress("0.49e9"), field), found(&stress("0.51e9"), field)], [1, 0]);
    let once = solve_contact(&stress("0.45e9")).unwrap();
    assert_eq!(about(&once.warnings, field).len(), 1, "{:?}", once.warnings);
    // Asperities make more than the smooth contact: only the solve reports it.
    let rough = "\n[roughness.disc]\nkind = \"gaussian\"\nrq = 200e-9\nlength_x = 40e-6\nlength_y = 40e-6\nseed = 1\n";
    let mut asperities = scene(&format!("{BALL}{rough}"), &[("_speed = 0.5", "_speed = 0.01")]);
    asperities.stress = stress("0.6e9").stress;
    assert!(about(&asperities.warnings(), field).is_empty());
    let solution = solve_contact(&asperities).unwrap();
    assert!(solution.stress.unwrap().yield_ratio.unwrap() > 1.0);
    assert_eq!(about(&solution.warnings, field).len(), 1, "{:?}", solution.warnings);
}

#[test]
fn changes_within_a_passage_warn() {
    let ramp = |key: &str, duration: f64, from: f64, to: f64| {
        let table = format!(
            "\n[schedule.{key}]\nkind = \"ramps\"\ntimes = [0.0, {duration}]\nvalues = [{from}, {to}]\n"
        );
        scene(&format!("{BALL}{table}"), &[])
    };
    // A half-width of 0.104 mm is passed in 0.42 ms; the load changes by half.
    for (duration, count) in [(1.0, 0), (3e-3, 0), (1e-3, 1)] {
        let fast = ramp("load", duration, 18.0, 9.0);
        assert_eq!(about(&fast.warnings(), "schedule.load").len(), count, "{duration} s");
    }
    let fast = ramp("entrainment_speed", 1e-3, 0.5, 1.0);
    let found = fast.warnings();
    assert_eq!(about(&found, "schedule.entrainment_speed").len(), 1, "{found:?}");
    let with_squeeze = MixedLubricationSim::builder(fast).with_squeeze().build().unwrap();
    assert!(about(with_squeeze.warnings(), "schedule.entrainment_speed").is_empty());
}

#[test]
fn steep_and_high_roughness_warns() {
    let rough = |rq: &str| {
        let table = format!(
            "\n[roughness.disc]\nkind = \"gaussian\"\nrq = {rq}\nlength_x = 50e-6\nlength_y = 50e-6\nseed = 1\n"
        );
        MixedLubricationSim::builder(scene(&format!("{BALL}{table}"), &[]))
            .build()
            .unwrap()
            .warnings()
            .to_vec()
    };
    // The gradient of a Gaussian autocorrelation is 3.03 Rq/l, on cells of a fifth of the length a little less.
    for (rq, count) in [("4.5e-6", 0), ("7.5e-6", 1)] {
        assert_eq!(about(&rough(rq), "roughness.disc_gradient").len(), count, "{rq}");
    }
    // The Hertz approach is 1.14 um at 0.8 GPa.
    for (rq, count) in [("500e-9", 0), ("650e-9", 1)] {
        assert_eq!(about(&rough(rq), "roughness.composite_rq").len(), count, "{rq}");
    }
}
