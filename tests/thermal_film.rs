//! Temperature of the film: sections against exact solutions, contacts against their limits.

use stribeck::Grid;
use stribeck::analytic::{ShearedLayer, ThermalInlet};
use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{
    Barus, DensityLaw, DoolittleTait, DowsonHigginson, Lubricant, Rheology, ViscosityLaw,
};
use stribeck::reynolds::{
    ContactSolver, ContactState, LubricatedContact, NewtonKrylov, ShearThinning, StoppingRule,
};
use stribeck::sim::scene::{GridSpec, InletSpec};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::thermal::{FilmProfile, FilmSection, FilmThermal, LayerAdvection, SectionSolver};
use stribeck::tribochem::{FlashTemperature, ThermalBody};

use crate::common::free_volume::FREE_VOLUME;

const PROFILES: [FilmProfile; 2] = [FilmProfile::Parabola, FilmProfile::Collocation];
const BULK: f64 = 313.15;

/// `eta = eta_0 exp[-b (T - 300 K)]` with `b = 0.05 / K`.
#[derive(Debug, Clone)]
struct Exponential {
    viscosity: f64,
    temperature: f64,
}

impl ViscosityLaw for Exponential {
    fn viscosity(&self, _pressure: f64) -> f64 {
        self.viscosity * (-0.05 * (self.temperature - 300.0)).exp()
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        Some(Box::new(Self { temperature, ..self.clone() }))
    }
}

/// `eta = 0.1 Pa s exp[20e-9 p - 0.05 (T - 300 K)]`.
#[derive(Debug, Clone)]
struct Separable {
    temperature: f64,
}

impl ViscosityLaw for Separable {
    fn viscosity(&self, pressure: f64) -> f64 {
        0.1 * (20e-9 * pressure.clamp(0.0, 1.2e9) - 0.05 * (self.temperature - 300.0)).exp()
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        Some(Box::new(Self { temperature }))
    }
}

fn section<'a>(viscosity: &'a dyn ViscosityLaw, rheology: &'a Rheology) -> FilmSection<'a> {
    FilmSection {
        viscosity,
        rheology,
        conductivity: 0.14,
        pressure: 0.0,
        film: 1e-7,
        theta: 1.0,
        sliding: 2.0,
        surfaces: [300.0; 2],
        response: (0.0, 0.0),
        pressure_heat: 0.0,
        compression: [0.0; 8],
        advection: LayerAdvection::uniform(0.0, 300.0),
    }
}

fn smooth(speed: f64, ratio: f64) -> Scene {
    let mut scene = Scene::azam_2019(48);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.load.hertz_pressure = Some(0.8e9);
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (speed, ratio);
    scene.friction.eyring_stress = Some(5e6);
    scene.thermal.bulk_temperature = BULK;
    scene.grid = GridSpec::Cells { nx: 48, ny: 48, x: [-0.35e-3, 0.2e-3], y: [-0.22e-3, 0.22e-3] };
    let oil = scene.lubricant.as_mut().unwrap();
    (oil.eta0, oil.alpha, oil.formula_alpha) = (0.04, Some(18e-9), None);
    (oil.temperature, oil.roelands_s0) = (Some(BULK), Some(1.1));
    // The heat that is balanced is that in the box.
    oil.inlet = InletSpec::BoxEdge;
    scene
}

fn warm(scene: &Scene, properties: FilmThermal) -> ContactSolution {
    let mut scene = scene.clone();
    scene.lubricant.as_mut().unwrap().thermal = Some(properties);
    let solution = solve_contact(&scene).unwrap();
    solution.report.require_converged().unwrap();
    solution
}

#[test]
fn conduction_at_uniform_viscosity_is_exact() {
    let (oil, newtonian) = (Barus::new(0.1, 20e-9).unwrap(), Rheology::newtonian());
    for profile in PROFILES {
        let solver = SectionSolver::new(profile);
        let plain = section(&oil, &newtonian);
        let (heat, per_flux) = (0.1 * 4.0 / 1e-7, 1e-7 / 0.14);
        // Surfaces of two temperatures; heat of pressure flow and compression; advection.
        let found = solver.solve(&FilmSection { surfaces: [300.0, 310.0], ..plain });
        assert!((found.mean - 305.0 - heat * per_flux / 12.0).abs() < 1e-9);
        assert!((found.conducted / heat - 1.0).abs() < 1e-12);
        let found = solver.solve(&FilmSection { pressure_heat: 1e6, compression: [-2e5; 8], ..plain });
        let exact = per_flux * ((heat - 2e5) / 12.0 + 1e6 / 20.0);
        assert!((found.mean - 300.0 - exact).abs() < 1e-9, "{found:?}, {exact}");
        assert!((found.flow_viscosity / 0.1 - 1.0).abs() < 1e-12);
        // d2T/dz2 = m^2 (T - T_a) - q h/k with m^2 = c h/k: a hyperbolic cosine.
        let found = solver.solve(&FilmSection { advection: LayerAdvection::uniform(1e6, 299.0), ..plain });
        let (root, balanced) = ((1e6 * per_flux).sqrt(), 299.0 + heat / 1e6);
        let exact = balanced + (300.0 - balanced) * (0.5 * root).tanh() / (0.5 * root);
        assert!((found.mean - exact).abs() < 1e-9, "{found:?}, {exact}");
        assert!((found.conducted + found.carried - heat).abs() < 1e-9 * heat);
        // Surface temperatures proportional to the heat.
        let found = solver.solve(&FilmSection { response: (2e-6, 0.0), ..plain });
        assert!((found.mean - 300.0 - heat * (per_flux / 12.0 + 2e-6)).abs() < 1e-9);
        let still = solver.solve(&FilmSection { sliding: 0.0, ..plain });
        assert!((still.mean - 300.0).abs() < 1e-12 && still.stress == 0.0 && still.conducted == 0.0);
    }
}

/// Nahme's solution: exact by collocation, and by the parabola for small Nahme numbers.
#[test]
fn shear_stress_of_a_self_heated_film_matches_nahme() {
    let newtonian = Rheology::newtonian();
    for (nahme, even) in [(1e-3, 1e-8), (0.1, 3e-5), (1.0, 2e-3), (8.0, 0.05)] {
        let viscosity = nahme * 0.14 / (0.05 * 4.0);
        let law = Exponential { viscosity, temperature: 300.0 };
        let exact = ShearedLayer::new(nahme).unwrap().stress_ratio();
        let ratio = |profile| {
            let found = SectionSolver::new(profile).solve(&section(&law, &newtonian));
            found.stress / (viscosity * 2.0 / 1e-7)
        };
        let [parabola, collocation] = PROFILES.map(ratio);
        assert!((collocation / exact - 1.0).abs() < 1e-7, "{collocation} and {exact} at {nahme}");
        assert!((parabola / exact - 1.0).abs() < even, "{parabola} and {exact} at {nahme}");
    }
}

#[test]
fn heat_partition_depends_on_the_film_resistance() {
    let grid = Grid::centred(24, 24, 1e-5, 1e-5).unwrap();
    let heat: Vec<f64> = grid.nodes().map(|(x, y)| if x.hypot(y) < 8e-5 { 1e8 } else { 0.0 }).collect();
    let mut flash = FlashTemperature::new(&grid, [ThermalBody::STEEL; 2], [2.0, 0.5]).unwrap();
    let zeros = || vec![0.0; grid.len()];
    let (mut one, mut other, mut common) = (zeros(), zeros(), zeros());
    let expected = flash.rise(&heat, &mut common).unwrap();
    // No resistance at heated nodes.
    let resistance: Vec<f64> = heat.iter().map(|heat| if *heat > 0.0 { 0.0 } else { 1.0 }).collect();
    let report = flash.rises_through_film(&heat, &resistance, [&mut one, &mut other]).unwrap();
    for k in (0..grid.len()).filter(|k| heat[*k] > 0.0) {
        assert!((one[k] - common[k]).abs() < 1e-3 * expected.maximum);
    }
    assert!(report.mismatch < 2e-4 * expected.maximum);
    // A thick film: half of the heat to each surface.
    let _ = flash.rises_through_film(&heat, &vec![1.0; grid.len()], [&mut one, &mut other]).unwrap();
    let [first, second] = flash.fluxes();
    for k in 0..grid.len() {
        assert!((first[k] - 0.5 * heat[k]).abs() < 1e-3 * 1e8);
        assert!((first[k] + second[k] - heat[k]).abs() < 1e-6);
    }
    assert!(flash.rises_through_film(&heat, &vec![-1.0; grid.len()], [&mut one, &mut other]).is_err());
    assert!(flash.rises_through_film(&heat, &[0.0], [&mut one, &mut other]).is_err());
}

#[test]
fn slow_contacts_and_constant_viscosity_are_isothermal() {
    let slow = smooth(0.005, 0.0);
    let mut indifferent = smooth(2.0, 1.0);
    indifferent.lubricant.as_mut().unwrap().roelands_s0 = Some(0.0);
    let rigid = FilmThermal::new(0.14, 1.7e6, 0.0).unwrap();
    for (scene, properties) in [(slow, FilmThermal::default()), (indifferent, rigid)] {
        let (cool, warm) = (solve_contact(&scene).unwrap(), warm(&scene, properties));
        assert!((warm.film.central / cool.film.central - 1.0).abs() < 1e-6);
        assert!((warm.film.minimum / cool.film.minimum - 1.0).abs() < 1e-6);
        assert!((warm.friction.coefficient - cool.friction.coefficient).abs() < 1e-9);
        assert_eq!(warm.thermal.unwrap().solves, 1);
        assert_eq!(warm.report.work, cool.report.work);
    }
}

/// Between parallel surfaces `rho h` is fixed by the inlet, independent of the expansion.
#[test]
fn thermal_expansion_alone_thickens_the_film_in_proportion() {
    let mut scene = smooth(2.0, 1.0);
    scene.lubricant.as_mut().unwrap().roelands_s0 = Some(0.0);
    let (cool, warm) = (solve_contact(&scene).unwrap(), warm(&scene, FilmThermal::default()));
    let heat = warm.thermal.as_ref().unwrap();
    let at = warm.grid.interpolate(&warm.film_temperature, 0.0, 0.0).unwrap();
    let expected = (6.5e-4 * (at - BULK)).exp();
    let found = warm.film.central / cool.film.central;
    assert!(expected > 1.01 && (found / expected - 1.0).abs() < 2e-3, "{found} and {expected}");
    assert!(heat.solves > 1 && heat.change <= 5e-3);
}

/// A viscosity that is a product of functions of pressure and temperature has a uniform ratio.
#[test]
fn film_of_uniform_temperature_matches_the_isothermal_film() {
    let grid = Grid::centred(48, 48, 1e-5, 1e-5).unwrap();
    let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / 0.02).collect();
    let law = Separable { temperature: 300.0 };
    let solved = |oil: &Lubricant, thinning: Option<ShearThinning>| {
        let mut body = HalfSpace::new(grid, 230e9).unwrap();
        let mut problem = LubricatedContact::new(&gap, &mut body, 10.0, (1.1e-4, 1.1e-4), 5e8);
        (problem.lubricant, problem.entrainment_speed, problem.shear_thinning) = (Some(oil), 1.0, thinning);
        problem.reference_film = 1e-7;
        let mut state = ContactState::new(&grid);
        let rule = StoppingRule::new(1e-11, 20_000);
        let report = NewtonKrylov::new().solve(&mut problem, &mut state, &rule).unwrap();
        report.require_converged().unwrap();
        state
    };
    let thinned = ShearThinning::new(Rheology::eyring(5e6).unwrap(), 1.0).unwrap();
    for thinning in [None, Some(thinned)] {
        let mut oil = Lubricant::new(law.clone(), DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap());
        let isothermal = solved(&oil.clone().at_temperature(337.0), thinning);
        let films = vec![337.0; grid.len()];
        oil.set_film_temperatures(300.0, &films, &films, 6.5e-4).unwrap();
        let warm = solved(&oil, thinning);
        for (one, other) in warm.film.iter().zip(&isothermal.film) {
            assert!((one / other - 1.0).abs() < 1e-8, "{one:e} and {other:e}");
        }
        for (one, other) in warm.fluid_pressure.iter().zip(&isothermal.fluid_pressure) {
            assert!((one - other).abs() < 1e-8 * 1e9, "{one:e} and {other:e}");
        }
        // The mass is that of a less dense fluid.
        let centre = 24 * 48 + 24;
        let ratio = warm.mass[centre] / isothermal.mass[centre];
        assert!((ratio / (-6.5e-4_f64 * 37.0).exp() - 1.0).abs() < 1e-8, "{ratio}");
    }
}

/// `ratio_at` equals the ratio of the law at the temperature, except for the expansion at ambient pressure.
#[test]
fn density_varies_with_temperature_by_law_or_expansivity() {
    let law = DoolittleTait::new(FREE_VOLUME).unwrap();
    let mut oil = Lubricant::new(law, law);
    oil.set_film_temperatures(313.15, &[353.15], &[353.15], 0.0).unwrap();
    for pressure in [0.0, 1e8, 7e8] {
        let relative = law.ratio_at(pressure, 353.15).unwrap() * (1.0 + 8e-4 * 40.0);
        let at = DensityLaw::at_temperature(&law, 353.15).unwrap().ratio(pressure);
        assert!((relative / at - 1.0).abs() < 1e-12, "{relative} and {at}");
        let [viscosity, density] = oil.film_ratios(0, pressure);
        let exact = law.ratio_at(pressure, 353.15).unwrap() / law.ratio(pressure);
        assert!((density / exact - 1.0).abs() < 1e-4, "{density} and {exact}");
        let exact = law.viscosity_at(pressure, 353.15).unwrap() / law.viscosity(pressure);
        assert!((viscosity / exact - 1.0).abs() < 2e-3, "{viscosity} and {exact}");
    }
    let plain = DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap();
    assert!(plain.ratio_at(1e8, 353.15).is_none());
    assert!(oil.set_film_temperatures(313.15, &[f64::NAN], &[313.15], 0.0).is_err());
    assert!(oil.set_film_temperatures(313.15, &[313.15], &[], 0.0).is_err());
    assert!(oil.set_film_temperatures(0.0, &[313.15], &[313.15], 0.0).is_err());
}

#[test]
fn heating_reduces_film_and_friction_and_conserves_energy() {
    let scene = smooth(2.0, 1.0);
    let cool = solve_contact(&scene).unwrap();
    let [parabola, collocation] =
        PROFILES.map(|profile| warm(&scene, FilmThermal::default().with_profile(profile)));
    let rolling = warm(&smooth(2.0, 0.0), FilmThermal::default()).thermal.unwrap();
    assert!((parabola.film.central / collocation.film.central - 1.0).abs() < 0.015);
    assert!((parabola.friction.coefficient / collocation.friction.coefficient - 1.0).abs() < 0.04);
    for solution in [parabola, collocation] {
        let heat = solution.thermal.as_ref().unwrap();
        // Mass flow of the inlet; the film itself is thicker by its expansion.
        let [warm, cold] =
            [&solution, &cool].map(|at| at.grid.interpolate(&at.state.mass, 0.0, 0.0).unwrap());
        assert!(warm < 0.985 * cold, "{warm:e} and {cold:e}");
        assert!(solution.friction.coefficient < 0.85 * cool.friction.coefficient);
        assert!(heat.imbalance < 1e-9, "{:e}", heat.imbalance);
        assert!(heat.change <= 5e-3);
        // Except for the heat of rolling the heat is friction.
        let friction = solution.friction.coefficient * solution.hertz.force * scene.motion.sliding_speed();
        let share = (heat.heat - rolling.heat) / friction;
        assert!((share - 1.0).abs() < 0.01, "{share}");
        // The film is warmer than both surfaces, the slower surface warmer than the faster one.
        let (ball, disc) = (heat.surface_rise_ball, heat.surface_rise_disc);
        assert!(heat.film_temperature_max - BULK > disc && disc > ball && ball > 1.0, "{heat:?}");
        let fields = solution.fields();
        assert_eq!(fields.last().unwrap().0, "film_temperature");
    }
    assert!(cool.thermal.is_none() && cool.fields().len() == 6);
}

#[test]
fn mean_central_temperature_averages_the_hertz_ellipse_at_any_angle() {
    for angle in [0.0, 0.5] {
        let mut scene = smooth(1.0, 1.0);
        scene.form = Form::Ellipsoid { radius_x: 6e-3, radius_y: 15e-3, angle };
        let solution = warm(&scene, FilmThermal::default());
        let heat = solution.thermal.as_ref().unwrap();
        let central = |(x, y): (f64, f64)| solution.hertz.radius_squared(x, y).sqrt() <= 2.0 / 3.0;
        let nodes = solution.grid.nodes().zip(&solution.film_temperature).filter(|(node, _)| central(*node));
        let (sum, n) = nodes.fold((0.0, 0.0), |(sum, n), (_, temperature)| (sum + temperature, n + 1.0));
        assert!(
            (heat.film_temperature_mean_central - sum / n).abs() < 1e-9,
            "{angle} rad: {}",
            heat.film_temperature_mean_central
        );
        assert!(
            heat.film_temperature_mean_central > BULK + 5.0,
            "{angle} rad: {}",
            heat.film_temperature_mean_central
        );
    }
}

/// Pure rolling of a line contact: the formula neglects advection and was fitted to heavier loads.
#[test]
fn thermal_reduction_in_pure_rolling_is_close_to_the_formula() {
    let mut scene = smooth(5.0, 0.0);
    scene.form = Form::Cylinder { radius: 0.01 };
    scene.wear = None;
    scene.load.hertz_pressure = Some(0.5e9);
    let ratio = |nx| {
        let mut scene = scene.clone();
        scene.grid = GridSpec::Row { nx, x: [-0.4e-3, 0.15e-3] };
        let cool = solve_contact(&scene).unwrap();
        warm(&scene, FilmThermal::default()).film.central / cool.film.central
    };
    let inlet = ThermalInlet {
        entrainment_speed: 5.0,
        eta0: 0.04,
        temperature_coefficient: 18e-9 * 1.96e8 / 0.68 * 1.1 / (BULK - 138.0),
        conductivity: 0.14,
        pressure_over_modulus: 0.0,
        slide_roll_ratio: 0.0,
    };
    let [coarse, fine] = [128, 256].map(ratio);
    assert!((coarse - fine).abs() < 3e-3, "{coarse} and {fine}");
    let expected = inlet.murch_wilson().unwrap();
    assert!((expected..expected + 0.05).contains(&fine), "{fine} and {expected}");
}

#[test]
fn invalid_thermal_scenes_are_rejected_by_name() {
    let message = |scene: &Scene| solve_contact(scene).unwrap_err().to_string();
    let mut scene = smooth(1.0, 1.0);
    scene.lubricant.as_mut().unwrap().thermal = Some(FilmThermal::default());
    let mut wrong = scene.clone();
    (wrong.lubricant.as_mut().unwrap().temperature, wrong.lubricant.as_mut().unwrap().roelands_s0) =
        (None, None);
    assert!(message(&wrong).contains("lubricant.thermal: the viscosity does not know temperature"));
    let with = |change: fn(&mut FilmThermal)| {
        let mut scene = scene.clone();
        change(scene.lubricant.as_mut().unwrap().thermal.as_mut().unwrap());
        message(&scene)
    };
    assert!(with(|oil| oil.conductivity = 0.0).starts_with("lubricant.thermal.conductivity = 0"));
    assert!(with(|oil| oil.heat_capacity = -1.0).starts_with("lubricant.thermal.heat_capacity = -1"));
    assert!(with(|oil| oil.expansivity = f64::NAN).starts_with("lubricant.thermal.expansivity = NaN"));
    // Metres instead of W/(m K).
    let mut odd = scene;
    odd.lubricant.as_mut().unwrap().thermal.as_mut().unwrap().conductivity = 140.0;
    assert_eq!(odd.warnings()[0].field, "lubricant.thermal.conductivity");
}

#[test]
fn thermal_keys_and_json_values_round_trip() {
    let mut scene = smooth(2.0, 1.0);
    scene.lubricant.as_mut().unwrap().thermal = Some(FilmThermal::default());
    let read = Scene::from_toml(&scene.to_toml().unwrap()).unwrap();
    assert_eq!(read, scene);
    let text = scene.to_toml().unwrap();
    let with_unit = text.replace("heat_capacity = 1700000.0", "heat_capacity = \"1.7 MJ/(m^3 K)\"");
    assert_ne!(with_unit, text);
    assert_eq!(Scene::from_toml(&with_unit).unwrap(), scene);
    let unknown = text.replace("expansivity", "expansion");
    assert!(Scene::from_toml(&unknown).unwrap_err().to_string().contains("expansion"));
    let solution = solve_contact(&scene).unwrap();
    let json = serde_json::to_value(&solution).unwrap();
    let heat = solution.thermal.as_ref().unwrap();
    assert_eq!(json["thermal"]["film_temperature_max"], heat.film_temperature_max);
    assert!(json["thermal"]["imbalance"].as_f64().unwrap() < 1e-9);
    assert!(solution.to_string().contains("heat       film up to"));
    scene.lubricant.as_mut().unwrap().thermal = None;
    let json = serde_json::to_value(solve_contact(&scene).unwrap()).unwrap();
    assert!(json["thermal"].is_null());
}
