//! Laws of film growth, flash temperature, plasticity and wear against exact solutions, and their invariants.
#![expect(clippy::float_cmp, reason = "tests")]

use std::f64::consts::PI;

use proptest::prelude::*;
use stribeck::plastic::{
    ElasticPerfectlyPlastic, PlasticDepth, PlasticityModel, split_depth, split_depth_into,
};
use stribeck::tribochem::{
    Activation, FilmGrowthLaw, FlashTemperature, Ghanbarzadeh, ThermalBody, Tribofilm, estimate_maximum_rise,
};
use stribeck::wear::{Archard, SurfaceLedger, WearDepth, WearLaw, WearPressure};
use stribeck::{Grid, InputError, SurfaceState};

fn contact(pressure: f64) -> SurfaceState {
    SurfaceState::new(pressure, 353.15)
        .with_solid_pressure(pressure)
        .with_shear_stress(0.115 * pressure)
        .with_sliding_speed(0.005)
        .with_in_contact(true)
}

fn grow(law: &dyn FilmGrowthLaw, time: f64) -> f64 {
    let mut states = vec![0.0; law.n_states()];
    law.advance(&contact(1e9), time, &mut states);
    law.thickness(&states)
}

// ---- film growth ----

#[test]
fn ghanbarzadeh_matches_its_published_table() {
    let law = Ghanbarzadeh::azam_2019();
    let (k, h_max, c3, c4): (f64, f64, f64, f64) =
        (1.380649e-23 * 353.15 / 6.62607015e-34 * 1.66e-16, 200e-9, 54.32e-9, 4.022e-4);
    let table = [
        (60.0, 12.84),
        (300.0, 55.19),
        (600.0, 92.25),
        (900.0, 116.89),
        (1800.0, 149.83),
        (2700.0, 156.63),
        (2947.0, 156.82),
        (3600.0, 155.99),
        (5400.0, 151.60),
        (7200.0, 148.65),
        (1e9, 145.68),
    ];
    for (time, nanometres) in table {
        let film = grow(&law, time);
        // The table is printed to 0.01 nm; the formula is matched to better than 1e-3 nm.
        assert!((film * 1e9 - nanometres).abs() <= 0.0051, "{time} s: {} nm", film * 1e9);
        let formula = h_max * (1.0 - (-k * time).exp()) - c3 * (1.0 - (-c4 * time).exp());
        assert!((film - formula).abs() < 1e-21, "{time} s: {film} {formula}");
    }
    let peak = (2900..3000).max_by(|&a, &b| grow(&law, f64::from(a)).total_cmp(&grow(&law, f64::from(b))));
    assert_eq!(peak, Some(2947));
}

#[test]
fn ghanbarzadeh_film_is_frozen_while_inactive_and_never_negative() {
    let law = Ghanbarzadeh::azam_2019();
    let mut states = [0.0; 2];
    law.advance(&contact(1e9), 600.0, &mut states);
    let before = states;
    law.advance(&contact(1e9).with_in_contact(false), 1e6, &mut states);
    assert_eq!(states, before);
    let removal_first = Ghanbarzadeh::new(10e-9, 1e-20, 50e-9, 1e-2).unwrap();
    assert_eq!(grow(&removal_first, 100.0), 0.0);
    assert_eq!(removal_first.rate(&contact(1e9), 0.0), 0.0);
}

#[test]
fn activation_selects_the_nodes() {
    let lubricated = contact(1e9).with_in_contact(false).with_solid_pressure(0.0).with_shear_stress(-1e7);
    let law = Ghanbarzadeh::azam_2019();
    for (activation, active) in
        [(Activation::SolidContact, false), (Activation::Pressure, true), (Activation::ShearStress, true)]
    {
        let law = law.clone().with_activation(activation);
        assert_eq!(law.rate(&lubricated, 0.0) > 0.0, active, "{activation:?}");
    }
}

/// `rate` is the derivative of `advance` for a film without history, for every law.
#[test]
fn rate_equals_the_derivative_of_advance() {
    let laws: [Box<dyn FilmGrowthLaw>; 4] = [
        Box::new(Ghanbarzadeh::azam_2019()),
        Box::new(Balanced { k: 1e-3, removal: 5e-4 }),
        Box::new(Quadratic { k: 1e-3 }),
        Box::new(Decaying),
    ];
    for law in laws {
        for thickness in [0.0, 20e-9, 60e-9] {
            let mut states = vec![0.0; law.n_states()];
            law.start(thickness, &mut states);
            assert_eq!(law.thickness(&states), thickness, "{law:?}");
            law.advance(&contact(1e9), 1e-2, &mut states);
            let slope = (law.thickness(&states) - thickness) / 1e-2;
            let rate = law.rate(&contact(1e9), thickness);
            assert!((slope - rate).abs() < 1e-4 * rate.abs(), "{law:?} at {thickness}: {slope} {rate}");
        }
    }
}

const LIMIT: f64 = 100e-9;

/// Growth toward `LIMIT` with removal proportional to the film: linear, with an equilibrium below the limit.
#[derive(Debug)]
struct Balanced {
    k: f64,
    removal: f64,
}

impl Balanced {
    fn balance(&self) -> f64 {
        LIMIT * self.k / (self.k + self.removal)
    }
}

impl FilmGrowthLaw for Balanced {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if at.in_contact { self.k * (LIMIT - thickness) - self.removal * thickness } else { 0.0 }
    }
    fn maximum_thickness(&self) -> f64 {
        LIMIT
    }
}

/// `h' = k (h_max - h)^2 / h_max`.
#[derive(Debug)]
struct Quadratic {
    k: f64,
}

impl FilmGrowthLaw for Quadratic {
    fn rate(&self, _at: &SurfaceState, thickness: f64) -> f64 {
        self.k * (LIMIT - thickness) * (LIMIT - thickness).abs() / LIMIT
    }
    fn maximum_thickness(&self) -> f64 {
        LIMIT
    }
}

/// `h' = c exp(-h / h_0)`, limited by the ceiling alone.
#[derive(Debug)]
struct Decaying;

impl FilmGrowthLaw for Decaying {
    fn rate(&self, _at: &SurfaceState, thickness: f64) -> f64 {
        1e-10 * (-thickness / 10e-9).exp()
    }
    fn maximum_thickness(&self) -> f64 {
        LIMIT
    }
}

/// Two constant rates with a jump at `h = 0.37 LIMIT`, the hardest case for an integrator.
#[derive(Debug)]
struct Jump;

impl FilmGrowthLaw for Jump {
    fn rate(&self, _at: &SurfaceState, thickness: f64) -> f64 {
        if thickness < 0.37 * LIMIT { 1e-10 } else { -2e-10 }
    }
    fn maximum_thickness(&self) -> f64 {
        LIMIT
    }
}

#[test]
fn default_integrator_handles_kinks_bounds_and_nan() {
    assert!((grow(&Jump, 100.0) - 10e-9).abs() < 1e-20);
    for time in [370.0, 371.0, 1e3, 1e6, 1e12] {
        assert!((grow(&Jump, time) - 0.37 * LIMIT).abs() < 1e-6 * LIMIT, "{time}: {}", grow(&Jump, time));
    }
    let mut states = [80e-9];
    Jump.advance(&contact(1e9), 100.0, &mut states);
    assert!((states[0] - 60e-9).abs() < 1e-18);
    // Growth stops at the ceiling.
    assert_eq!(grow(&Decaying, 1e30), LIMIT);

    #[derive(Debug)]
    struct Nonsense;
    impl FilmGrowthLaw for Nonsense {
        fn rate(&self, _at: &SurfaceState, _thickness: f64) -> f64 {
            f64::NAN
        }
        fn maximum_thickness(&self) -> f64 {
            LIMIT
        }
    }
    assert_eq!(grow(&Nonsense, 1.0), 0.0);
    for step in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
        assert_eq!(grow(&Decaying, step), 0.0);
        assert_eq!(grow(&Ghanbarzadeh::azam_2019(), step.min(0.0)), 0.0);
    }
}

proptest! {
    #[test]
    fn ghanbarzadeh_does_not_care_how_time_is_cut(
        cuts in prop::collection::vec(0.0..2000.0_f64, 1..12), temperature in 250.0..450.0_f64,
    ) {
        let law = Ghanbarzadeh::azam_2019();
        let at = contact(1e9).with_temperature(temperature);
        let (mut once, mut often) = ([0.0; 2], [0.0; 2]);
        law.advance(&at, cuts.iter().sum(), &mut once);
        for &cut in &cuts {
            law.advance(&at, cut, &mut often);
        }
        for (a, b) in once.iter().zip(&often) {
            prop_assert!((a - b).abs() <= 1e-12 * a.abs(), "{} {}", a, b);
        }
        let (a, b) = (law.thickness(&once), law.thickness(&often));
        prop_assert!((a - b).abs() <= 1e-12 * once[0]);
        prop_assert!((0.0..=200e-9).contains(&a));
    }

    /// Linear law: the only error is that of the numerical slope. Rates have rounding errors of about
    /// `3 eps k h_max` and the increment is 1e-5 h_max, so the relative error of the slope is
    /// `3 eps / 1e-5 = 7e-11` and that of the film less than twice that (half steps) times the distance to
    /// the equilibrium.
    #[test]
    fn default_integrator_is_exact_for_linear_laws(
        log_k in -6.0..4.0_f64, removal_share in 0.0..3.0_f64,
        start in 0.0..1.0_f64, log_time in -3.0..9.0_f64,
    ) {
        let law = Balanced { k: 10_f64.powf(log_k), removal: removal_share * 10_f64.powf(log_k) };
        let time = 10_f64.powf(log_time);
        let mut states = [start * LIMIT];
        law.advance(&contact(1e9), time, &mut states);
        let (from, balance) = (start * LIMIT, law.balance());
        let exact = balance + (from - balance) * (-(law.k + law.removal) * time).exp();
        let tolerance = 2e-10 * LIMIT;
        prop_assert!((states[0] - exact).abs() <= tolerance, "{} {}", states[0], exact);
        let (low, high) = (from.min(balance), from.max(balance));
        prop_assert!(states[0] >= low - tolerance && states[0] <= high + tolerance);
    }

    /// Nonlinear laws: full and half substeps differ by at most 1e-5. Extrapolation removes the third-order
    /// term, and contracting rates damp the rest. With 1e-4 a film just below saturation had an error of 5e-5
    /// after a very long step.
    #[test]
    fn default_integrator_follows_nonlinear_laws(
        log_k in -6.0..2.0_f64, start in 0.0..1.0_f64, log_time in -3.0..8.0_f64,
    ) {
        let (law, time) = (Quadratic { k: 10_f64.powf(log_k) }, 10_f64.powf(log_time));
        let mut states = [start * LIMIT];
        law.advance(&contact(1e9), time, &mut states);
        let left = (1.0 - start) / (1.0 + law.k * (1.0 - start) * time);
        let film = states[0] / LIMIT;
        prop_assert!((film - (1.0 - left)).abs() <= 1e-5, "{} {}", film, 1.0 - left);
        prop_assert!(states[0] >= start * LIMIT && states[0] <= LIMIT);

        let mut decaying = [start * LIMIT];
        Decaying.advance(&contact(1e9), time, &mut decaying);
        let exact = 10e-9 * ((start * LIMIT / 10e-9).exp() + 1e-2 * time).ln();
        prop_assert!((decaying[0] - exact.min(LIMIT)).abs() <= 1e-5 * LIMIT);
    }

    #[test]
    fn default_integrator_stays_between_start_and_balance(start in 0.0..1.0_f64, log_time in -3.0..12.0_f64) {
        let mut states = [start * LIMIT];
        Jump.advance(&contact(1e9), 10_f64.powf(log_time), &mut states);
        let (low, high) = (start.min(0.37) * LIMIT, start.max(0.37) * LIMIT);
        prop_assert!(states[0] >= low - 1e-9 * LIMIT && states[0] <= high + 1e-9 * LIMIT);
    }
}

#[test]
fn film_gain_less_loss_equals_its_volume() {
    let law = Ghanbarzadeh::azam_2019();
    let mut film = Tribofilm::bare(&law, 3);
    for step in 0..72 {
        film.advance(&law, 100.0, |node| contact(1e9).with_in_contact(node == 0 || (node == 1 && step < 6)))
            .unwrap();
    }
    assert!((film.thickness()[0] - grow(&law, 7200.0)).abs() < 1e-20);
    assert!((film.thickness()[1] - grow(&law, 600.0)).abs() < 1e-20);
    assert_eq!(film.thickness()[2], 0.0);
    let (volume, area) = (film.volume(2e-12), 2e-12);
    assert!((film.gained_volume(area) - film.lost_volume(area) - volume).abs() < 1e-12 * volume);
    assert!(film.lost_volume(area) > 0.0);
    let grown = film.grown_volume(&law, area).unwrap();
    let removed: f64 = film.states().chunks(2).map(|s| s[1] * area).sum();
    assert!((grown - removed - volume).abs() < 1e-12 * grown);
}

#[test]
fn film_rejects_bad_input_and_is_unchanged() {
    let law = Ghanbarzadeh::azam_2019();
    let mut film = Tribofilm::from_thickness(&law, &[50e-9, 0.0]).unwrap();
    assert_eq!(film.thickness(), [50e-9, 0.0]);
    let before = film.clone();
    assert!(film.advance(&law, f64::NAN, |_| contact(1e9)).is_err());
    assert!(film.advance(&law, -1.0, |_| contact(1e9)).is_err());
    assert!(matches!(film.advance(&Jump, 1.0, |_| contact(1e9)), Err(InputError::Shape { .. })));
    assert_eq!(film, before);
    assert!(Tribofilm::from_thickness(&law, &[-1e-9]).is_err());
    assert!(Tribofilm::from_thickness(&law, &[f64::NAN]).is_err());
    let rate_only = Tribofilm::bare(&Jump, 2);
    assert_eq!(rate_only.grown_volume(&Jump, 1.0), None);
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(Ghanbarzadeh::new(bad, 1e-16, 0.0, 0.0).is_err());
        assert!(Ghanbarzadeh::new(1e-7, bad, 0.0, 0.0).is_err());
        assert!(Ghanbarzadeh::new(1e-7, 1e-16, bad, 0.0).is_err());
        assert!(Ghanbarzadeh::new(1e-7, 1e-16, 0.0, bad).is_err());
    }
}

// ---- flash temperature ----

/// Unit flux on the cells within `radius`, weighted by the covered share of cells at the edge, and its mean
/// rise.
fn disc_rise(n: usize, speed: f64, bodies: [ThermalBody; 2], speeds_ratio: f64) -> (f64, f64, f64) {
    let radius = 1e-4;
    let grid = Grid::centred(n, n, 2.2 * radius / n as f64, 2.2 * radius / n as f64).unwrap();
    let flux: Vec<f64> = grid.nodes().map(|(x, y)| cell_share(&grid, x, y, radius)).collect();
    let mut flash = FlashTemperature::new(&grid, bodies, [speed, speeds_ratio * speed]).unwrap();
    let mut rise = vec![0.0; grid.len()];
    let report = flash.rise(&flux, &mut rise).unwrap();
    let total: f64 = flux.iter().sum();
    let mean = rise.iter().zip(&flux).map(|(t, w)| t * w).sum::<f64>() / total;
    assert!(report.mismatch <= 1e-4 * report.maximum, "{report:?}");
    let scale = radius / 46.0;
    (report.maximum / scale, mean / scale, report.iterations as f64)
}

fn cell_share(grid: &Grid, x: f64, y: f64, radius: f64) -> f64 {
    let inside = (0..64).filter(|k| {
        let (i, j) = (f64::from(k % 8), f64::from(k / 8));
        let xs = x + grid.dx() * ((i + 0.5) / 8.0 - 0.5);
        let ys = y + grid.dy() * ((j + 0.5) / 8.0 - 0.5);
        xs.hypot(ys) <= radius
    });
    inside.count() as f64 / 64.0
}

#[test]
fn stationary_disc_matches_the_classical_rise() {
    let (maximum, mean, iterations) = disc_rise(64, 0.0, [ThermalBody::STEEL; 2], 1.0);
    println!("rest: max {:.4} mean {:.4}", 2.0 * maximum, 2.0 * mean);
    assert!((2.0 * maximum - 1.0).abs() < 2e-3, "{maximum}");
    assert!((2.0 * mean / (8.0 / (3.0 * PI)) - 1.0).abs() < 2e-3, "{mean}");
    assert_eq!(iterations, 0.0);
}

#[test]
fn moving_disc_matches_tian_and_kennedy() {
    for peclet in [0.12, 1.18, 11.8] {
        let speed = 2.0 * 1.27e-5 * peclet / 1e-4;
        let (maximum, mean, _) = disc_rise(96, speed, [ThermalBody::STEEL; 2], 1.0);
        let max_form = 2.0 / (PI * (1.273 + peclet)).sqrt();
        let mean_form = 1.22 / (PI * (0.6575 + peclet)).sqrt();
        println!(
            "Pe {peclet}: max {:.4} / {max_form:.4}, mean {:.4} / {mean_form:.4}",
            2.0 * maximum,
            2.0 * mean
        );
        assert!((2.0 * maximum / max_form - 1.0).abs() < 0.10, "{peclet}");
        assert!((2.0 * mean / mean_form - 1.0).abs() < 0.10, "{peclet}");
    }
}

/// Cells larger than the thermal boundary layer (cell Peclet number 50) still give the strip limit
/// `2 q sqrt(l / (pi k rho c V))` of a square at high speed.
#[test]
fn coarse_cells_at_high_speed_match_the_strip_limit() {
    let (half, n) = (1e-4, 10);
    let grid = Grid::centred(n, n, 2.0 * half / n as f64, 2.0 * half / n as f64).unwrap();
    let steel = ThermalBody::STEEL;
    let speed = 2.0 * steel.diffusivity * 50.0 / grid.dx();
    let mut flash = FlashTemperature::new(&grid, [steel; 2], [speed; 2]).unwrap();
    let mut rise = vec![0.0; grid.len()];
    let _ = flash.rise(&vec![1.0; grid.len()], &mut rise).unwrap();
    let way = 2.0 * half - 0.5 * grid.dx();
    let strip = 2.0 * (way * steel.diffusivity / (PI * speed)).sqrt() / steel.conductivity;
    let found = 2.0 * rise[5 * n + n - 1];
    println!("strip: {found:e} / {strip:e}");
    assert!((found / strip - 1.0).abs() < 0.02, "{found} {strip}");
}

#[test]
fn unlike_bodies_have_equal_contact_temperatures() {
    let ceramic = ThermalBody { conductivity: 3.0, diffusivity: 1e-6 };
    for (bodies, ratio) in [
        ([ThermalBody::STEEL; 2], 0.0),
        ([ThermalBody::STEEL; 2], -1.0),
        ([ThermalBody::STEEL, ceramic], 1.0),
        ([ThermalBody::STEEL, ceramic], 0.0),
    ] {
        let (maximum, mean, iterations) = disc_rise(64, 3.0, bodies, ratio);
        println!(
            "ratio {ratio}, k2 {}: max {maximum:.4} mean {mean:.4} it {iterations}",
            bodies[1].conductivity
        );
        assert!(maximum > mean && mean > 0.0 && iterations < 60.0, "{iterations}");
    }
    // The heat of a perfect insulator flows into the other body.
    let insulator = ThermalBody { conductivity: 1e-9, diffusivity: 1e-6 };
    let (alone, ..) = disc_rise(32, 0.0, [ThermalBody::STEEL, insulator], 1.0);
    assert!((alone - 1.0).abs() < 5e-3, "{alone}");
}

#[test]
fn flash_temperature_is_linear_symmetric_and_rejects_bad_input() {
    let grid = Grid::centred(13, 7, 5e-6, 4e-6).unwrap();
    let flux: Vec<f64> =
        (0..grid.len()).map(|k| if k % 3 == 0 { 1e6 * (1 + k % 5) as f64 } else { 0.0 }).collect();
    let bodies = [ThermalBody::STEEL; 2];
    let mut forward = FlashTemperature::new(&grid, bodies, [2.0, 1.0]).unwrap();
    let mut backward = FlashTemperature::new(&grid, bodies, [-2.0, -1.0]).unwrap();
    let mut reversed = flux.clone();
    reversed.reverse();
    let (mut a, mut b, mut c) = (vec![0.0; 91], vec![0.0; 91], vec![0.0; 91]);
    let report = forward.rise(&flux, &mut a).unwrap();
    let _ = backward.rise(&reversed, &mut b).unwrap();
    let doubled: Vec<f64> = flux.iter().map(|q| 2.0 * q).collect();
    let _ = forward.clone().rise(&doubled, &mut c).unwrap();
    for k in 0..91 {
        assert!((a[k] - b[90 - k]).abs() < 1e-3 * report.maximum);
        assert!((2.0 * a[k] - c[k]).abs() < 1e-9 * report.maximum);
    }
    let _ = forward.rise(&[0.0; 91], &mut a).unwrap();
    assert!(a.iter().all(|t| *t == 0.0));
    assert!(forward.rise(&[0.0; 90], &mut a).is_err());
    assert!(forward.rise(&[f64::NAN; 91], &mut a).is_err());
    assert!(forward.rise(&[-1.0; 91], &mut a).is_err());
    let bad = ThermalBody { conductivity: 0.0, ..ThermalBody::STEEL };
    assert!(FlashTemperature::new(&grid, [bad, ThermalBody::STEEL], [1.0, 1.0]).is_err());
    assert!(FlashTemperature::new(&grid, bodies, [f64::INFINITY, 1.0]).is_err());
    assert!(estimate_maximum_rise(bodies, [f64::NAN, 1.0], 0.1, 1e9, 1e-4).is_err());
    assert!(estimate_maximum_rise(bodies, [1.0, 1.0], -0.1, 1e9, 1e-4).is_err());
}

/// The estimate against the full solution for the smooth contact of the reference scene.
#[test]
fn estimate_matches_the_field_for_a_smooth_contact() {
    let (radius, peak) = (149.83e-6, 1.15e9);
    let grid = Grid::centred(64, 64, 0.5e-3 / 64.0, 0.5e-3 / 64.0).unwrap();
    for (speeds, tolerance) in [([0.1025, 0.0975], 0.06), ([0.2, 0.1], 0.06), ([2.0, 0.5], 0.1)] {
        let sliding: f64 = speeds[0] - speeds[1];
        let flux: Vec<f64> = grid
            .nodes()
            .map(|(x, y)| 0.115 * sliding * peak * (1.0 - (x.hypot(y) / radius).powi(2)).max(0.0).sqrt())
            .collect();
        let mut flash = FlashTemperature::new(&grid, [ThermalBody::STEEL; 2], speeds).unwrap();
        let mut rise = vec![0.0; grid.len()];
        let report = flash.rise(&flux, &mut rise).unwrap();
        let estimate = estimate_maximum_rise([ThermalBody::STEEL; 2], speeds, 0.115, peak, radius).unwrap();
        println!("{speeds:?}: field {:.4} K, estimate {estimate:.4} K, {report:?}", report.maximum);
        assert!((report.maximum / estimate - 1.0).abs() < tolerance, "{speeds:?}");
    }
}

/// The heat partition takes about as many iterations on fine grids as on coarse ones, with smooth and with spotted heat, and its
/// result agrees with the operator itself.
#[test]
fn iterations_of_the_heat_partition_do_not_grow_with_the_grid() {
    for speeds in [[0.15, 0.05], [3.0, 0.0]] {
        for n in [32, 128] {
            let grid = Grid::centred(n, n, 5e-4 / n as f64, 5e-4 / n as f64).unwrap();
            for is_spotted in [false, true] {
                let flux: Vec<f64> = grid
                    .nodes()
                    .map(|(x, y)| {
                        let outside = is_spotted && (3e5 * x).sin() * (2.5e5 * y).sin() < 0.3;
                        let inside = (1.0 - (x * x + y * y) / 1.44e-8).max(0.0);
                        if outside { 0.0 } else { 1e7 * inside.sqrt() }
                    })
                    .collect();
                let mut flash = FlashTemperature::new(&grid, [ThermalBody::STEEL; 2], speeds).unwrap();
                let report = flash.rise(&flux, &mut vec![0.0; grid.len()]).unwrap();
                assert!(report.iterations <= 12, "{n} cells, {speeds:?}: {report:?}");
                assert!(report.mismatch < 1.5e-4 * report.maximum, "{n} cells, {speeds:?}: {report:?}");
            }
        }
    }
}

// ---- plasticity ----

#[test]
fn plastic_depth_accumulates_on_the_softer_body() {
    let model = ElasticPerfectlyPlastic::azam_2019();
    let films = [[0.0, 0.0, 200e-9], [0.0, 100e-9, 0.0]];
    let limits = films.map(|film| film.map(|h| model.pressure_limit(h, 0.0)));
    let (mut ball, mut disc) = ([0.0; 3], [0.0; 3]);
    split_depth_into(&[2e-9, 2e-9, 2e-9], [&limits[0], &limits[1]], [&mut ball, &mut disc]).unwrap();
    assert_eq!((ball, disc), ([1e-9, 0.0, 2e-9], [1e-9, 2e-9, 0.0]));
    let mut depth = PlasticDepth::new(3);
    depth.add(&ball).unwrap();
    let before = depth.clone();
    assert!(depth.add(&[1e-9, 1e-9, -1e-9]).is_err());
    assert!(depth.add(&[1e-9, f64::NAN, 0.0]).is_err());
    assert!(depth.add(&[1e-9]).is_err());
    assert_eq!(depth, before);
    let mut short = [0.0; 2];
    assert!(split_depth_into(&[0.0; 3], [&limits[0], &limits[1]], [&mut short, &mut disc]).is_err());
    assert!(model.contact_limit_into([&[0.0], &[0.0]], [&[0.0], &[0.0; 2]], &mut [0.0]).is_err());
}

#[test]
fn hardness_rejects_bad_input() {
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        assert!(ElasticPerfectlyPlastic::uniform(bad).is_err());
        assert!(ElasticPerfectlyPlastic::with_film(bad, 2e9, 2e-7).is_err());
        assert!(ElasticPerfectlyPlastic::with_film(6e9, bad, 2e-7).is_err());
        assert!(ElasticPerfectlyPlastic::with_film(6e9, 2e9, bad).is_err());
    }
    let uniform = ElasticPerfectlyPlastic::uniform(4e9).unwrap();
    assert_eq!(uniform.pressure_limit(1.0, 1.0), 4e9);
}

proptest! {
    #[test]
    fn hardness_is_clamped_and_falls_with_the_film(
        a in -1e-6..1e-6_f64, b in -1e-6..1e-6_f64, depth in 0.0..1e-6_f64,
    ) {
        let model = ElasticPerfectlyPlastic::azam_2019();
        let (thin, thick) = (a.min(b), a.max(b));
        let (soft, hard) = (model.pressure_limit(thick, depth), model.pressure_limit(thin, depth));
        prop_assert!(soft <= hard && soft >= 2e9 * (1.0 - 1e-12) && hard <= 6e9);
    }

    #[test]
    fn split_conserves_depth(overlap in -1e-6..1e-6_f64, a in 1e9..8e9_f64, b in 1e9..8e9_f64) {
        let [first, second] = split_depth(overlap, [a, b]);
        prop_assert!(first >= 0.0 && second >= 0.0);
        prop_assert_eq!(first + second, overlap.max(0.0));
        prop_assert_eq!(split_depth(overlap, [b, a]), [second, first]);
    }
}

// ---- wear ----

/// The mean depth is `K F s / (H A)` for any pressure distribution.
#[test]
fn mean_wear_depends_on_load_and_distance_alone() {
    let grid = Grid::centred(128, 128, 0.5e-3 / 128.0, 0.5e-3 / 128.0).unwrap();
    let hertz_radius = PI * 1.15e9 * 9.525e-3 / 229.67e9;
    let force = 2.0 / 3.0 * PI * hertz_radius * hertz_radius * 1.15e9;
    let shape: Vec<f64> = grid
        .nodes()
        .enumerate()
        .map(|(k, (x, y))| if x.hypot(y) < hertz_radius { (1 + k * 7919 % 13) as f64 } else { 0.0 })
        .collect();
    let scale = force / (shape.iter().sum::<f64>() * grid.cell_area());
    let mut wear = WearDepth::new(grid.len());
    for _ in 0..720 {
        wear.advance(&Archard::azam_2019(), 10.0, |node| (contact(scale * shape[node]), 0.0)).unwrap();
    }
    let over_box = wear.volume(grid.cell_area()) / (grid.size_x() * grid.size_y());
    let expected = 5.45e-8 * force * 36.0 / (6e9 * 0.25e-6);
    println!(
        "box {:.4} nm, Hertz {:.3} nm",
        over_box * 1e9,
        over_box * 0.25e-6 / (PI * hertz_radius.powi(2)) * 1e9
    );
    assert!((over_box / expected - 1.0).abs() < 1e-11, "{over_box} {expected}");
    assert!((over_box - 70.73e-9).abs() < 5e-12);
    let over_hertz = wear.volume(grid.cell_area()) / (PI * hertz_radius.powi(2));
    let expected = 5.45e-8 * 2.0 / 3.0 * 1.15e9 * 36.0 / 6e9;
    assert!((over_hertz / expected - 1.0).abs() < 1e-11, "{over_hertz} {expected}");
    assert!((over_hertz - 250.7e-9).abs() < 5e-11);
}

/// A film that grows from the start reduces the wear over two hours to 0.3670 of the bare coefficient.
#[test]
fn growing_film_reduces_the_mean_coefficient() {
    let (growth, law) = (Ghanbarzadeh::azam_2019(), Archard::azam_2019());
    let mut film = Tribofilm::bare(&growth, 1);
    let mut wear = WearDepth::new(1);
    let (step, mut mean_film) = (1.0, 0.0);
    for _ in 0..7200 {
        film.advance(&growth, 0.5 * step, |_| contact(1e9)).unwrap();
        wear.advance(&law, step, |node| (contact(1e9), film.thickness()[node])).unwrap();
        mean_film += film.thickness()[0] / 7200.0;
        film.advance(&growth, 0.5 * step, |_| contact(1e9)).unwrap();
    }
    let bare = law.depth_rate(&contact(1e9), 0.0) * 7200.0;
    println!("mean film {:.4} nm, ratio {:.5}", mean_film * 1e9, wear.values()[0] / bare);
    assert!((wear.values()[0] / bare - 0.3670).abs() < 1e-3 * 0.3670);
    assert!((mean_film - 140.66e-9).abs() < 0.01e-9);
}

#[test]
fn wear_pressure_selects_total_or_solid_pressure() {
    let at = contact(1e9).with_solid_pressure(0.25e9);
    let total = Archard::azam_2019();
    let solid = Archard::azam_2019().with_pressure(WearPressure::Solid);
    assert!((solid.depth_rate(&at, 0.0) / total.depth_rate(&at, 0.0) - 0.25).abs() < 1e-15);
    assert_eq!(total.depth_rate(&contact(-1e9), 0.0), 0.0);
}

#[test]
fn wear_rejects_bad_input() {
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(Archard::new(bad, 0.0, 1e-7, 6e9).is_err());
        assert!(Archard::new(1e-8, bad, 1e-7, 6e9).is_err());
        assert!(Archard::new(1e-8, 1e-9, bad, 6e9).is_err());
        assert!(Archard::new(1e-8, 1e-9, 1e-7, bad).is_err());
    }
    assert!(Archard::new(1e-9, 1e-8, 1e-7, 6e9).is_err());

    #[derive(Debug)]
    struct Healing;
    impl WearLaw for Healing {
        fn depth_rate(&self, _at: &SurfaceState, _film: f64) -> f64 {
            -1e-9
        }
    }
    let mut wear = WearDepth::new(2);
    assert!(wear.advance(&Healing, 1.0, |_| (contact(1e9), 0.0)).is_err());
    assert!(wear.advance(&Archard::azam_2019(), -1.0, |_| (contact(1e9), 0.0)).is_err());
    assert!(wear.values().iter().all(|z| *z == 0.0));
    assert!(SurfaceLedger::new(&[0.0; 2], &[0.0; 2], &[0.0; 1], &[0.0; 2]).is_err());
    let fields = [0.0; 2];
    let ledger = SurfaceLedger::new(&fields, &fields, &fields, &fields).unwrap();
    assert!(ledger.surface_into(&mut [0.0]).is_err());
    assert!(ledger.residual(&[f64::NAN, 0.0]).unwrap().is_nan());
}

proptest! {
    #[test]
    fn wear_is_finite_monotone_and_clamped(
        pressure in -1e9..1e10_f64, speed in 0.0..10.0_f64, a in -1e-6..1e-6_f64, b in -1e-6..1e-6_f64,
        steps in prop::collection::vec(0.0..100.0_f64, 1..8),
    ) {
        let law = Archard::azam_2019();
        let at = contact(pressure).with_sliding_speed(speed);
        let (thin, thick) = (law.depth_rate(&at, a.min(b)), law.depth_rate(&at, a.max(b)));
        let bare = 5.45e-8 / 6e9 * pressure.max(0.0) * speed;
        prop_assert!(thick <= thin && thin <= bare * (1.0 + 1e-12) && thick >= 0.1 * bare * (1.0 - 1e-12));
        let mut wear = WearDepth::new(1);
        let mut last = 0.0;
        for &step in &steps {
            wear.advance(&law, step, |_| (at, a)).unwrap();
            prop_assert!(wear.values()[0] >= last && wear.values()[0].is_finite());
            last = wear.values()[0];
        }
        let once = law.depth_rate(&at, a) * steps.iter().sum::<f64>();
        prop_assert!((last - once).abs() <= 1e-12 * once);
    }
}
