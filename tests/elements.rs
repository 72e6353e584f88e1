//! Scenes of machine elements beside hand formulas: film, load, wear and friction.
#![expect(clippy::panic, reason = "tests")]

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use stribeck::Status;
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{
    ContactSolution, CyclePoint, MixedLubricationSim, RigidBearing, Scene, SceneFile, StepRecord,
};

/// Effective modulus of steel on steel, `E/(1 - v^2)` \[Pa\], viscosity \[Pa s\] and pressure-viscosity coefficient \[1/Pa\] of the scenes.
const MODULUS: f64 = 206e9 / 0.91;
const ETA: f64 = 0.02;
const ALPHA: f64 = 18e-9;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes").join(name)
}

fn solved(name: &str) -> ContactSolution {
    let scene = Scene::load(path(name)).unwrap();
    let solution = MixedLubricationSim::builder(scene).solve().unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{name}");
    let load = solution.state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
    let share = load / (solution.hertz.force - solution.pressure.load_outside);
    assert!((share - 1.0).abs() < 0.01, "{name}: {share} of the load");
    solution
}

fn close(name: &str, value: f64, expected: f64, tolerance: f64) {
    let deviation = value / expected - 1.0;
    assert!(deviation.abs() < tolerance, "{name}: {value:e} is {:.2} % off {expected:e}", 100.0 * deviation);
}

/// Central film of Hamrock and Dowson (1977) for hard point contacts.
fn hamrock_dowson(radius: f64, force: f64, speed: f64, ellipticity: f64) -> f64 {
    let (u, g, w) = (ETA * speed / (MODULUS * radius), ALPHA * MODULUS, force / (MODULUS * radius * radius));
    let by_shape = 1.0 - 0.61 * (-0.73 * ellipticity).exp();
    2.69 * radius * u.powf(0.67) * g.powf(0.53) * w.powf(-0.067) * by_shape
}

/// Radius of a sphere's Hertz contact, `(3 F R/(2 E'))^(1/3)`.
fn hertz_radius(radius: f64, force: f64, modulus: f64) -> f64 {
    (1.5 * force * radius / modulus).cbrt()
}

#[test]
fn traction_machine_has_the_film_of_hamrock_and_dowson() {
    let solution = solved("mtm.toml");
    close("film", solution.film.central, hamrock_dowson(9.525e-3, 37.0, 1.0, 1.0), 0.1);
    let a = hertz_radius(9.525e-3, 37.0, MODULUS);
    close("Hertz pressure", solution.hertz.pressure, 1.5 * 37.0 / (PI * a * a), 0.01);
    // Power loss of friction force and sliding speed; the stress of the film is at most Eyring's times ln(2 eta u/(h tau)).
    let friction = solution.friction;
    close("power", friction.power_loss, friction.coefficient * 37.0 * 0.5, 1e-9);
    assert!(friction.fluid > 0.02 && friction.fluid < 0.1 && friction.boundary.abs() < 1e-12, "{friction:?}");
    let ratio = solution.film.formula_ratio.unwrap();
    close("formula", solution.film.central / ratio, hamrock_dowson(9.525e-3, 37.0, 1.0, 1.0), 0.08);
}

/// Dowson and Toyoda (1979): `3.06 U^0.69 G^0.56 W^-0.10`.
#[test]
fn roller_of_a_bearing_has_the_film_of_dowson_and_toyoda() {
    let solution = solved("roller_bearing.toml");
    let radius = 1.0 / (1.0 / 5e-3 + 1.0 / 27.4955e-3);
    let (u, g, w) = (ETA * 2.492 / (MODULUS * radius), ALPHA * MODULUS, 186e3 / (MODULUS * radius));
    let film = 3.06 * radius * u.powf(0.69) * g.powf(0.56) * w.powf(-0.10);
    // Of an incompressible film: that of the oil is thinner by its density.
    let pressure = solution.pressure.central;
    let density = 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure);
    close("film", density * solution.film.central, film, 0.1);
    let half_width = (8.0 * 186e3 * radius / (PI * MODULUS)).sqrt();
    close("Hertz pressure", solution.hertz.pressure, 2.0 * 186e3 / (PI * half_width), 0.01);
}

/// The ellipse is 9 times as wide as long, beyond the range of the formula.
#[test]
fn ball_in_a_groove_has_the_film_of_hamrock_and_dowson() {
    let solution = solved("ball_bearing.toml");
    let radius = 1.0 / (1.0 / 3.97e-3 + 1.0 / 15.55e-3);
    close("film", solution.film.central, hamrock_dowson(radius, 556.0, 1.47, 9.3), 0.15);
}

/// All that is supplied flows through: film times density, `(1 + 0.6e-9 p/(1 + 1.7e-9 p))`, is the supplied film.
#[test]
fn starved_ball_has_the_film_that_is_supplied() {
    let solution = solved("starved.toml");
    let pressure = solution.pressure.central;
    let density = 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure);
    let flooded = hamrock_dowson(9.525e-3, 37.0, 1.0, 1.0);
    assert!(flooded > 2.0 * 40e-9, "{flooded}");
    close("film", density * solution.film.central, 40e-9, 0.08);
}

/// Isoviscous-elastic limit of Nijenbanning, Venner and Moes (1994) of a circular contact: `H = 3.18 (1 + 0.63)^(-14/25) M^(-2/15)`.
#[test]
fn hip_has_the_film_of_isoviscous_elastic_contacts() {
    let solution = solved("hip.toml");
    let (radius, modulus) = (14e-3 * 14.04e-3 / 0.04e-3_f64, 210e9_f64 / 0.91);
    let speed_number = modulus * radius / (2.5e-3 * 0.02);
    let load_number = 1500.0 / (modulus * radius * radius) * speed_number.powf(0.75);
    let film = 3.18 * 1.63_f64.powf(-0.56) * load_number.powf(-2.0 / 15.0) * radius / speed_number.sqrt();
    close("film", solution.film.central, film, 0.15);
    close("Hertz radius", solution.hertz.half_width_x, hertz_radius(radius, 1500.0, modulus), 0.01);
}

/// Archard's volume `K F s/H` of either body, and the friction of the boundary coefficient.
#[test]
fn dry_pin_has_the_wear_of_archard() {
    let scene = Scene::load(path("dry_wear.toml")).unwrap();
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let mut last = None;
    sim.run(10, 10.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        last = Some(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    let record = last.unwrap();
    let volume = 1e-7 * 10.0 * 0.1 * 100.0 / 6e9;
    close("ball", record.wear.ball_volume, volume, 1e-4);
    close("disc", record.wear.disc_volume, volume, 1e-4);
    close("friction", record.friction.coefficient, 0.6, 1e-6);
    close("power", record.friction.power_loss, 0.6 * 10.0 * 0.1, 1e-6);
    // The cap of the volume V that a plane cuts off a ball of radius R: a = (4 V R/pi)^(1/4).
    assert!((4.0 * volume * 5e-3 / PI).powf(0.25) < 0.2e-3);
}

/// The load of the plane slider is larger without side flow, `6 eta u L^2/h_2^2 f` with `f = (ln K - 2 (K - 1)/(K + 1))/(K - 1)^2`.
#[test]
fn plane_pad_is_the_slider_of_textbooks_and_dimples_lower_its_load_and_friction() {
    let text = std::fs::read_to_string(path("textured_pad.toml")).unwrap();
    let solve = |text: &str| RigidBearing::from_toml(text).unwrap().solve(|| false).unwrap().numbers;
    let textured = solve(&text);
    let plain: String =
        text.lines().filter(|line| !line.starts_with("dimple")).map(|line| format!("{line}\n")).collect();
    let wide: String =
        plain.lines().filter(|line| !line.starts_with("width")).map(|line| format!("{line}\n")).collect();
    let [plain, wide] = [plain, wide].map(|text| solve(&text));
    let k = 1.1_f64;
    let factor = (k.ln() - 2.0 * (k - 1.0) / (k + 1.0)) / (k - 1.0).powi(2);
    close("wide pad", wide.load, 6.0 * ETA * 1e-4 / 1e-10 * factor, 0.01);
    let friction = ETA * 1e-2 / 1e-5 * (4.0 * k.ln() / (k - 1.0) - 6.0 / (k + 1.0));
    close("friction of a wide pad", wide.friction_moving, friction, 0.01);
    assert!(
        plain.load < 0.6 * 0.01 * wide.load && textured.load < plain.load,
        "{} {}",
        textured.load,
        plain.load
    );
    assert!(textured.friction_moving < plain.friction_moving);
}

/// The center of pressure of a wide pad that narrows by `1 + k : 1` is at `1 - (k (6 + k) - 2 (3 + 2 k) ln(1 + k))/(2 k ((2 + k) ln(1 + k) - 2 k))` of its
/// length (Cameron), its load `6 eta u L^2/h^2 (ln(1 + k) - 2 k/(2 + k))/k^2`; the oil carries the power loss.
#[test]
fn tilting_pad_has_its_pivot_load_and_heat_balance() {
    let text = std::fs::read_to_string(path("thrust_pad.toml")).unwrap();
    let solve = |text: &str| RigidBearing::from_toml(text).unwrap().solve(|| false).unwrap().numbers;
    let pad = solve(&text);
    close("load", pad.load, 4000.0, 1e-5);
    close("pivot", pad.pressure_center.unwrap(), 30e-3, 1e-4);
    let leaving: f64 = pad.edge_flows.iter().map(|flow| flow.max(0.0)).sum();
    let rise = pad.outlet_temperature.unwrap() - pad.supply_temperature.unwrap();
    close("heat", 1.7e6 * leaving * rise, pad.power_loss, 0.01);
    let wide: String =
        text.lines().filter(|line| !line.starts_with("width")).map(|line| format!("{line}\n")).collect();
    // Per metre of width.
    let wide = solve(&wide.replace("4 kN", "100 kN/m"));
    let [inlet, outlet] = [wide.inlet_film, wide.outlet_film].map(Option::unwrap);
    let k = inlet / outlet - 1.0;
    let log = (1.0 + k).ln();
    let center =
        1.0 - (k * (6.0 + k) - 2.0 * (3.0 + 2.0 * k) * log) / (2.0 * k * ((2.0 + k) * log - 2.0 * k));
    close("center of a wide pad", center, 0.6, 0.002);
    let load = 6.0 * wide.eta0 * 20.0 * (50e-3 / outlet).powi(2) * (log - 2.0 * k / (2.0 + k)) / (k * k);
    close("load of a wide pad", wide.load, load, 0.01);
}

/// Without load the friction is that of Petroff; the eccentric axis adds `W c e sin(phi)/(2 R)` to the mean of both surfaces.
#[test]
fn journal_has_the_friction_of_petroff_and_of_its_load() {
    let SceneFile::Bearing(bearing) = SceneFile::load(path("journal.toml")).unwrap() else {
        panic!("another kind of scene")
    };
    let numbers = bearing.solve(|| false).unwrap().numbers;
    close("load", numbers.load, 2000.0, 1e-5);
    let (radius, clearance, speed) = (25e-3, 25e-6, 50.0 * PI * 50e-3);
    let petroff = numbers.eta0 * speed / clearance * 2.0 * PI * radius * 25e-3;
    let eccentricity = numbers.eccentricity.unwrap();
    assert!(numbers.friction_moving > 0.8 * petroff, "{} {petroff}", numbers.friction_moving);
    assert!(numbers.friction_moving < 1.1 * petroff / (1.0 - eccentricity * eccentricity).sqrt());
    let by_load = numbers.load * clearance / radius * eccentricity * numbers.attitude.unwrap().sin();
    close("difference of both", numbers.friction_moving - numbers.friction_resting, by_load, 0.02);
    close("power", numbers.power_loss, numbers.friction_moving * speed, 1e-9);
}

/// A flat follower: radius of curvature `r + s + s''`, speeds `w (r + s + s'')` and `w s''`. At the base circle and at the nose the film is
/// that of Dowson and Toyoda.
#[test]
#[ignore = "slow"]
fn cam_has_the_films_of_dowson_and_toyoda() {
    let mut scene = Scene::load(path("cam.toml")).unwrap();
    // Fewer steps than usual: the formula holds away from the reversals.
    scene.cycle.as_mut().unwrap().steps = Some(400);
    let points = MixedLubricationSim::builder(scene).solve_cycle(&mut |_| true).unwrap().points;
    let rate = 1000.0 * PI / 30.0;
    for (angle, lift, second, load) in
        [(0.0, 0.0, 0.0, 250.0), (180.0, 8e-3, -48e-3 / 75_f64.to_radians().powi(2), 250.0 + 30e3 * 8e-3)]
    {
        let near = |a: f64, b: f64| (a - angle).abs().total_cmp(&(b - angle).abs());
        let at = |point: &CyclePoint| point.angle.unwrap().to_degrees();
        let point = points.iter().min_by(|a, b| near(at(a), at(b))).unwrap();
        let name = |number: &str| format!("{number} at {angle} deg");
        let radius: f64 = 26e-3 + lift + second;
        let load = (load + 0.12 * rate * rate * second) / 12e-3;
        close(&name("radius"), point.radius, radius, 0.04);
        close(&name("load"), point.load, load, 0.01);
        let (radius, speeds) = (point.radius, [point.ball_speed, point.disc_speed]);
        close(&name("sliding"), speeds[0] - speeds[1], rate * (26e-3 + lift), 1e-6);
        // The oil of `stribeck init`.
        let (eta, modulus, mean) = (0.01, 210e9 / 0.91, 0.5 * (speeds[0] + speeds[1]).abs());
        let (u, w) = (eta * mean / (modulus * radius), point.load / (modulus * radius));
        let film = 3.06 * radius * u.powf(0.69) * (ALPHA * modulus).powf(0.56) * w.powf(-0.10);
        let density = |p: f64| 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p);
        close(&name("film"), density(point.hertz_pressure) * point.film_central, film, 0.1);
        let friction = point.friction_coefficient * point.load;
        close(&name("power"), point.friction_power, friction * (speeds[0] - speeds[1]), 1e-9);
    }
}

/// O'Sullivan and King (1988): a coating of a tenth of the radius, twice as stiff as the plate, raises the pressure by the factor 1.475.
#[test]
fn coated_plate_has_the_pressure_of_o_sullivan_and_king() {
    let solution = solved("coated.toml");
    close("pressure", solution.pressure.max, 1.475 * 146.912e6, 0.02);
    close(
        "bare contact",
        solution.hertz.half_width_x,
        hertz_radius(1e-3, solution.hertz.force, 4.6153846e9),
        1e-6,
    );
}

/// The smooth flanks of the gear scene have the film of Dowson and Toyoda.
#[test]
fn gear_flanks_have_the_film_of_dowson_and_toyoda() {
    let mut scene = Scene::load(path("gear.toml")).unwrap();
    scene.roughness = Default::default();
    scene.motion.roughness = Default::default();
    scene.grid = GridSpec::Row { nx: 272, x: [-0.5e-3, 0.35e-3] };
    let solution = MixedLubricationSim::builder(scene).solve().unwrap();
    assert_eq!(solution.report.status, Status::Converged);
    let (radius, modulus) = (10e-3, 230e9);
    let load = PI * radius * 1.2e9 * 1.2e9 / modulus * 2.0;
    close("load", solution.hertz.force, load, 1e-6);
    let (u, g, w) = (0.01 * 3.0 / (modulus * radius), 15e-9 * modulus, load / (modulus * radius));
    let film = 3.06 * radius * u.powf(0.69) * g.powf(0.56) * w.powf(-0.10);
    let pressure = solution.pressure.central;
    let density = 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure);
    close("film", density * solution.film.central, film, 0.1);
}
