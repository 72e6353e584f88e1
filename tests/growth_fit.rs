//! Growth-law constants from measured films: recovery from noise, honest intervals, refusals.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal};
use stribeck::SurfaceState;
use stribeck::tribochem::{
    FilmGrowthLaw, FitError, Ghanbarzadeh, GrowthCurve, GrowthFit, ThermalArrhenius, fit_growth_law,
};

const TRUTH: [f64; 4] = [200e-9, 1.66e-16, 54.32e-9, 4.022e-4];
const START: [(&str, f64); 4] = [("h_max", 150e-9), ("x_tribo", 1e-16), ("C3", 20e-9), ("C4", 1e-3)];
fn rubbing() -> SurfaceState {
    SurfaceState::new(1e9, 353.15)
        .with_solid_pressure(1e9)
        .with_shear_stress(1e8)
        .with_sliding_speed(0.005)
        .with_in_contact(true)
}

fn ghanbarzadeh(constants: &[f64]) -> Result<Ghanbarzadeh, stribeck::InputError> {
    Ghanbarzadeh::new(constants[0], constants[1], constants[2], constants[3])
}

/// The film of the paper's constants at `points` times up to `end`, with Gaussian noise of `sigma`.
fn measured(points: u32, end: f64, sigma: f64, seed: u64) -> GrowthCurve {
    let law = Ghanbarzadeh::azam_2019();
    let mut noise = ChaCha8Rng::seed_from_u64(seed);
    let normal = Normal::new(0.0, sigma).unwrap();
    let times: Vec<f64> = (1..=points).map(|k| end * f64::from(k) / f64::from(points)).collect();
    let films = times.iter().map(|&time| {
        let mut states = [0.0; 2];
        law.advance(&rubbing(), time, &mut states);
        law.thickness(&states) + normal.sample(&mut noise)
    });
    GrowthCurve::new(times.clone(), films.collect()).unwrap()
}

fn fit(curve: &GrowthCurve) -> Result<GrowthFit<Ghanbarzadeh>, FitError> {
    fit_growth_law(curve, &rubbing(), &START, ghanbarzadeh)
}

#[test]
fn fit_of_exact_films_recovers_the_constants() {
    let fit = fit(&measured(60, 14400.0, 0.0, 1)).unwrap();
    for (constant, expected) in fit.constants.iter().zip(TRUTH) {
        assert!((constant.value / expected - 1.0).abs() < 1e-5, "{constant:?}");
    }
    assert!(fit.standard_deviation < 1e-13, "{}", fit.standard_deviation);
}

/// The 95 % intervals of 40 noisy measurements contain the constants in about 95 of 100 cases.
#[test]
fn confidence_intervals_of_noisy_films_cover_the_constants() {
    let (mut held, mut total, mut worst) = (0, 0, 0.0_f64);
    for seed in 0..40 {
        let fit = fit(&measured(200, 14400.0, 1e-9, seed)).unwrap();
        assert!((fit.standard_deviation / 1e-9 - 1.0).abs() < 0.25, "{}", fit.standard_deviation);
        for (constant, expected) in fit.constants.iter().zip(TRUTH) {
            let [low, high] = constant.interval;
            held += usize::from(low <= expected && expected <= high);
            total += 1;
            worst = worst.max((constant.value / expected).ln().abs());
        }
    }
    let share = held as f64 / total as f64;
    println!(
        "{held} of {total} intervals hold the constant, worst value off by a factor of {:.2}",
        worst.exp()
    );
    assert!((0.88..=0.99).contains(&share), "{share}");
}

#[test]
fn undetermined_constants_are_rejected() {
    // The first minutes determine the growth rate alone.
    let early = fit(&measured(40, 60.0, 1e-9, 3)).unwrap_err();
    assert!(matches!(early, FitError::Undetermined { .. }), "{early}");
    // A plateau without its transient.
    let times: Vec<f64> = (0..30).map(|k| 1e6 + f64::from(k)).collect();
    let plateau = GrowthCurve::new(times, vec![145.68e-9; 30]).unwrap();
    let late = fit(&plateau).unwrap_err();
    assert!(matches!(late, FitError::Undetermined { .. } | FitError::NotConverged { .. }), "{late}");
    // At a single temperature prefactor and barrier are degenerate.
    let arrhenius = |c: &[f64]| ThermalArrhenius::new(c[0], c[1], c[2]);
    let start = [("h_max", 150e-9), ("prefactor", 1e8), ("energy", 1.2e-19)];
    let one_temperature =
        fit_growth_law(&measured(40, 1800.0, 1e-9, 3), &rubbing(), &start, arrhenius).unwrap_err();
    assert!(matches!(one_temperature, FitError::Undetermined { .. }), "{one_temperature}");
    // The film does not grow at an inactive node.
    let idle = rubbing().with_in_contact(false);
    let idle = fit_growth_law(&measured(40, 7200.0, 1e-9, 3), &idle, &START, ghanbarzadeh).unwrap_err();
    assert!(matches!(idle, FitError::Undetermined { .. }), "{idle}");
    let few = fit(&measured(4, 7200.0, 0.0, 3)).unwrap_err();
    assert!(matches!(few, FitError::TooFewPoints { points: 4, constants: 4 }), "{few}");
    let nothing = fit(&GrowthCurve::new(vec![1.0, 2.0, 3.0, 4.0, 5.0], vec![0.0; 5]).unwrap()).unwrap_err();
    assert!(matches!(nothing, FitError::Undetermined { .. }), "{nothing}");
}

#[test]
fn invalid_tables_and_initial_values_are_rejected() {
    assert!(GrowthCurve::new(vec![1.0, 1.0], vec![0.0; 2]).is_err());
    assert!(GrowthCurve::new(vec![-1.0, 1.0], vec![0.0; 2]).is_err());
    assert!(GrowthCurve::new(vec![1.0, 2.0], vec![0.0, f64::NAN]).is_err());
    assert!(GrowthCurve::new(vec![1.0], vec![0.0; 2]).is_err());
    let error = GrowthCurve::from_csv("time,film\n1,2e-9\n2\n".as_bytes()).unwrap_err();
    assert!(error.to_string().starts_with("line 3"), "{error}");
    let error = GrowthCurve::from_csv("1,2e-9\n# remark\n2,film\n".as_bytes()).unwrap_err();
    assert!(error.to_string().contains("2,film"), "{error}");
    let error = GrowthCurve::read_csv("no/such/file.csv").unwrap_err();
    assert!(error.to_string().contains("no/such/file.csv"), "{error}");
    let path = std::env::temp_dir().join(format!("stribeck_growth_{}.csv", std::process::id()));
    std::fs::File::create(&path).unwrap().set_len(17 << 20).unwrap();
    let error = GrowthCurve::read_csv(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert!(error.to_string().contains("the file has 17825792 bytes"), "{error}");
    let curve = measured(40, 7200.0, 1e-9, 3);
    let negative = [("h_max", -1.0), ("x_tribo", 1e-16), ("C3", 20e-9), ("C4", 1e-3)];
    let error = fit_growth_law(&curve, &rubbing(), &negative, ghanbarzadeh).unwrap_err();
    assert!(error.to_string().contains("h_max"), "{error}");
}
