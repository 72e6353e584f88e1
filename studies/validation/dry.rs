//! Dry contacts: Hertz, the stresses below, and the contact area of rough bodies.

use rayon::prelude::*;
use stribeck::Grid;
use stribeck::analytic::{HertzPoint, Westergaard};
use stribeck::elastic::{DryProblem, DrySolver, PeriodicHalfSpace, stress_extremes};
use stribeck::metrics::hybrid_parameters;
use stribeck::sim::scene::{GridSpec, Load, SolverKind};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::{Autocorrelation, Form, RoughnessSpec, generate};

use crate::report::{Effort, Number, Outcome, Row};

fn smooth_scene(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    (scene.solver.kind, scene.solver.tolerance) = (SolverKind::Dry, 1e-9);
    (scene.roughness, scene.plastic, scene.wear, scene.lubricant) = (Default::default(), None, None, None);
    scene.motion.slide_roll_ratio = 0.0;
    scene
}

fn line_scene(n: usize) -> Outcome<Scene> {
    let mut scene = smooth_scene(16);
    scene.form = Form::Cylinder { radius: 10e-3 };
    let b = scene.hertz()?.half_width_x;
    scene.grid = GridSpec::Row { nx: n, x: [-3.0 * b, 3.0 * b] };
    Ok(scene)
}

fn solved(scene: &Scene) -> Outcome<ContactSolution> {
    let solution = solve_contact(scene)?;
    solution.report.require_converged()?;
    Ok(solution)
}

/// Half-width from the second moment of the pressure along x, `a^2/5` of a ball and `b^2/4` of a line.
fn half_width(solution: &ContactSolution, share: f64) -> f64 {
    let (mut moment, mut sum) = (0.0, 0.0);
    for ((x, _), p) in solution.grid.nodes().zip(&solution.state.pressure) {
        moment += x * x * p;
        sum += p;
    }
    (share * moment / sum).sqrt()
}

pub(crate) fn hertz(_effort: Effort) -> Outcome<Row> {
    let n = 512;
    let mut numbers = Vec::new();
    for (name, scene, share) in [("ball", smooth_scene(n), 5.0), ("line", line_scene(2 * n)?, 4.0)] {
        let solution = solved(&scene)?;
        let (exact, gpa) = (solution.hertz, 1e-9);
        let case = format!("{name} of {} x {} cells", solution.grid.nx(), solution.grid.ny());
        let (found, known) = (gpa * solution.pressure.max, gpa * exact.pressure);
        numbers.push(Number::relative("peak pressure", case.clone(), "GPa", known, found, 2e-5));
        let found = half_width(&solution, share);
        numbers.push(Number::relative(
            "half-width",
            case.clone(),
            "um",
            1e6 * exact.half_width_x,
            1e6 * found,
            5e-5,
        ));
        if name == "ball" {
            let known = exact.half_width_x.powi(2) / 9.525e-3;
            numbers.push(Number::relative(
                "approach",
                case,
                "um",
                1e6 * known,
                1e6 * solution.state.approach,
                2e-5,
            ));
        }
    }
    Ok(Row {
        name: "hertz",
        quantity: "Dry smooth contacts",
        reference: "closed form: Hertz (1882)",
        range: "ball and line, 1.15 GPa",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}

pub(crate) fn subsurface(effort: Effort) -> Outcome<Row> {
    let n = if effort.is_full() { 192 } else { 128 };
    let mut ball = smooth_scene(n);
    let a = ball.hertz()?.half_width_x;
    ball.grid = GridSpec::Cells { nx: n, ny: n, x: [-1.3 * a, 1.3 * a], y: [-1.3 * a, 1.3 * a] };
    let mut numbers = Vec::new();
    for (name, scene) in [("ball", ball), ("line", line_scene(1024)?)] {
        let solution = solved(&scene)?;
        let (width, peak) = (solution.hertz.half_width_x, solution.hertz.pressure);
        let depths: Vec<f64> = (0..61).map(|k| 0.02 * f64::from(k) * width).collect();
        let found = stress_extremes(&solution.grid, 0.3, &depths, &solution.state.pressure, None)?;
        let (mises, shear) = (found.von_mises, found.orthogonal_shear);
        // Johnson: ball, nu = 0.3; line: largest of the closed form on its axis.
        let [stress, depth] = if name == "ball" { [0.620, 0.48] } else { [0.558, 0.70] };
        numbers.push(Number::absolute(
            "von Mises stress over p_H",
            name,
            "",
            stress,
            mises.stress / peak,
            2e-3,
        ));
        numbers.push(Number::absolute(
            "its depth over the half-width",
            name,
            "",
            depth,
            mises.depth / width,
            0.02,
        ));
        if name == "line" {
            numbers.push(Number::absolute(
                "orthogonal shear over p_H",
                name,
                "",
                0.25,
                shear.stress / peak,
                1e-3,
            ));
            numbers.push(Number::absolute(
                "its depth over the half-width",
                name,
                "",
                0.5,
                shear.depth / width,
                0.02,
            ));
        }
    }
    Ok(Row {
        name: "subsurface",
        quantity: "Stresses below the surface",
        reference: "closed form: Johnson (1985), sections 3.4, 4.2 and 9.2",
        range: "ball and line, Poisson's ratio 0.3",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Equivalent modulus of the rough contacts \[Pa\], twice `E*`, and root mean square gradient of their surfaces.
const MODULUS: f64 = 200e9;
const GRADIENT: f64 = 0.03;

/// Corrected contact area times `E* g` over the load for a peak pressure of the smooth ball of `share` of `E* g`; `half` is
/// half of the box in half-widths, the correlation length `waves` cells.
fn area_over_load(n: usize, half: f64, share: f64, waves: f64, seed: u64) -> Outcome<f64> {
    let (dx, effective) = (1e-6, 0.5 * MODULUS);
    let (a, pressure) = (0.5 * n as f64 * dx / half, share * effective * GRADIENT);
    let radius = 2.0 * effective * a / (std::f64::consts::PI * pressure);
    let mut scene = smooth_scene(n);
    scene.form = Form::Sphere { radius };
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load = Load::force(HertzPoint::from_max_pressure(radius, radius, MODULUS, pressure)?.force);
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-half * a, half * a], y: [-half * a, half * a] };
    scene.solver.tolerance = 1e-6;
    let grid = scene.grid()?;
    let length = waves * dx;
    let spec = RoughnessSpec {
        autocorrelation: Autocorrelation::Gaussian,
        rq: GRADIENT * length / (4.0 * 10_f64.ln()).sqrt(),
        length_x: length,
        length_y: length,
        seed,
    };
    let heights = generate(&grid, &spec)?;
    let gradient = hybrid_parameters(&grid, &heights, None)?.sdq;
    let solution = MixedLubricationSim::builder(scene).disc_heights(heights).solve()?;
    solution.report.require_converged()?;
    Ok(solution.contact.corrected_area * effective * gradient / solution.hertz.force)
}

pub(crate) fn contact_area(effort: Effort) -> Outcome<Row> {
    let n = 1024;
    let mut cases = Vec::new();
    for (share, half) in [(0.1, 4.0), (0.2, 3.5)] {
        for waves in [24.0, 32.0] {
            cases.extend((1..=2).map(|seed| (share, half, waves, seed)));
        }
    }
    if !effort.is_full() {
        cases = vec![(0.2, 3.5, 24.0, 1)];
    }
    let bounds = [(8.0 / std::f64::consts::PI).sqrt(), (2.0 * std::f64::consts::PI).sqrt()];
    let numbers = (cases.into_par_iter())
        .map(|(share, half, waves, seed)| {
            let found = area_over_load(n, half, share, waves, seed)?;
            let case = format!("p_H {share} E* g; correlation length {waves} cells; seed {seed}");
            Ok(Number::between("area x E* x rms gradient over load", case, bounds, found))
        })
        .collect::<Outcome<_>>()?;
    Ok(Row {
        name: "contact_area",
        quantity: "Contact area of rough bodies over the load",
        reference: "bounds by theory: Persson (2001), 1.60, and Bush, Gibson and Thomas (1975), 2.51",
        range: "dry, Gaussian roughness on a ball, peak pressure of the smooth ball 0.1 and 0.2 of E* times the gradient",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Mean gap and largest pressure of one wave on `n` cells under a share of the pressure of full contact.
fn wave(exact: &Westergaard, mean_pressure: f64, n: usize) -> Outcome<[f64; 2]> {
    let grid = Grid::centred(n, 1, exact.wavelength / n as f64, 1.0)?;
    let gap: Vec<f64> = grid
        .nodes()
        .map(|(x, _)| exact.amplitude * (1.0 - (std::f64::consts::TAU * x / exact.wavelength).cos()))
        .collect();
    let mut body = PeriodicHalfSpace::new(grid, exact.equivalent_modulus)?;
    let (mut solver, mut pressure) = (DrySolver::new(n), vec![0.0; n]);
    let problem = DryProblem { gap: &gap, load: mean_pressure * grid.size_x(), limit: None };
    if !solver.solve(&problem, &mut body, &mut pressure, 1e-10, 1000)?.converged {
        return Err("the wave has not converged".into());
    }
    let mean_gap = solver.gap().iter().sum::<f64>() / n as f64;
    Ok([mean_gap, pressure.iter().copied().fold(0.0, f64::max)])
}

pub(crate) fn wavy_surface(_effort: Effort) -> Outcome<Row> {
    let exact = Westergaard { amplitude: 1e-7, wavelength: 1e-4, equivalent_modulus: 230e9 };
    let n = 513;
    let mut numbers = Vec::new();
    for share in [0.02, 0.1, 0.3, 0.6, 0.9] {
        let mean_pressure = share * exact.full_contact_pressure()?;
        let [gap, peak] = wave(&exact, mean_pressure, n)?;
        let case = format!("{share} of full contact; {n} cells");
        let (known, mpa) = (exact.mean_gap(mean_pressure)? / exact.amplitude, 1e-6);
        let gap = gap / exact.amplitude;
        numbers.push(Number::absolute("mean gap over amplitude", case.clone(), "", known, gap, 2e-5));
        let known = mpa * exact.pressure_at(0.0, mean_pressure)?;
        numbers.push(Number::relative("largest pressure", case, "MPa", known, mpa * peak, 1e-4));
    }
    Ok(Row {
        name: "wavy_surface",
        quantity: "Dry wavy surfaces",
        reference: "closed form: Westergaard (1939)",
        range: "0.02 to 0.9 of the pressure of full contact",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}
