//! The closed-form solutions against high-precision values, identities and published numbers.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use stribeck::analytic::{
    FilmConditions, HertzPoint, Westergaard, equivalent_modulus, rectangle_displacement, rectangle_potential,
};

#[test]
fn rectangle_potential_matches_high_precision_values() {
    let table = include_str!("data/rectangle_potential.csv");
    let mut rows = 0;
    for line in table.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
        let error = (rectangle_potential(row[0], row[1], row[2], row[3]) / row[4] - 1.0).abs();
        assert!(error <= 1e-13, "{line}: relative error {error:e}");
        rows += 1;
    }
    assert_eq!(rows, 425);
}

#[test]
fn rectangle_potential_is_additive_and_symmetric() {
    for (x, y) in [(0.3, 0.2), (1.0, 0.5), (7.9, -3.0), (40.0, 11.0), (-1.0, 1.0)] {
        let whole = rectangle_potential(x, y, 1.0, 0.5);
        let halves = rectangle_potential(x - 0.5, y, 0.5, 0.5) + rectangle_potential(x + 0.5, y, 0.5, 0.5);
        assert_relative_eq!(whole, halves, max_relative = 3e-14);
        assert_relative_eq!(whole, rectangle_potential(-x, -y, 1.0, 0.5), max_relative = 1e-15);
        assert_relative_eq!(whole, rectangle_potential(y, x, 0.5, 1.0), max_relative = 1e-14);
    }
}

#[test]
fn rectangle_potential_is_defined_for_all_arguments() {
    assert!(rectangle_potential(f64::NAN, 0.0, 1.0, 1.0).is_nan());
    assert!(rectangle_potential(0.0, 0.0, f64::INFINITY, 1.0).is_nan());
    assert!(rectangle_potential(0.0, 0.0, -1.0, 1.0).is_nan());
    assert!(rectangle_potential(0.0, 0.0, 0.0, 1.0).abs() < f64::MIN_POSITIVE);
    assert!(rectangle_potential(0.1, 0.1, 1e-12, 1e6) > 0.0);
    assert!(rectangle_displacement(0.0, 0.0, 1.0, 1.0, 1.0, -1.0).is_nan());
}

#[test]
fn hertz_circular_matches_the_published_contact() {
    let modulus = equivalent_modulus([209e9, 0.3], [209e9, 0.3]).unwrap();
    assert_relative_eq!(modulus, 229.67e9, max_relative = 2e-6);
    let contact = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
    assert_relative_eq!(contact.half_width_x, 149.83e-6, max_relative = 5e-5);
    assert_relative_eq!(contact.force, 54.07, max_relative = 1e-4);
    assert_relative_eq!(contact.mean_pressure(), 0.767e9, max_relative = 1e-3);
    assert_relative_eq!(contact.approach, 2357e-9, max_relative = 1e-4);
    assert_relative_eq!(
        contact.approach,
        contact.half_width_x * contact.half_width_x / 9.525e-3,
        max_relative = 1e-14
    );
    let back = HertzPoint::from_load(9.525e-3, 9.525e-3, 229.67e9, contact.force).unwrap();
    assert_relative_eq!(back.pressure, 1.15e9, max_relative = 1e-14);
    assert_relative_eq!(
        back.half_width_x,
        (1.5 * back.force * 9.525e-3 / 229.67e9).cbrt(),
        max_relative = 1e-14
    );
}

/// `(Rx, Ry, long semi-axis, short, p_max, approach)` for E' = 2.3e11 Pa and 50 N, from
/// `tests/data/hertz_ellipse.py`.
const ELLIPSES: [[f64; 6]; 4] = [
    [0.015, 0.01, 0.00018118625206229306, 0.00013829924616772202, 952722312.3775166, 2.0506160057407018e-06],
    [0.02, 0.01, 0.00020823180593762083, 0.00013131008172487395, 873104553.9253107, 1.946129003230728e-06],
    [0.1, 0.01, 0.0004326558289861109, 9.615754999123851e-05, 573832897.119747, 1.3982690527941707e-06],
    [10.0, 0.01, 0.0026739038821425756, 3.939599802261073e-05, 226627961.28116268, 4.3509033155673427e-07],
];

#[test]
fn hertz_elliptical_matches_high_precision_values() {
    for [rx, ry, long, short, p_max, approach] in ELLIPSES {
        let along = HertzPoint::from_load(rx, ry, 230e9, 50.0).unwrap();
        let across = HertzPoint::from_load(ry, rx, 230e9, 50.0).unwrap();
        for (contact, a_x, a_y) in [(along, long, short), (across, short, long)] {
            assert_relative_eq!(contact.half_width_x, a_x, max_relative = 1e-13);
            assert_relative_eq!(contact.half_width_y, a_y, max_relative = 1e-13);
            assert_relative_eq!(contact.pressure, p_max, max_relative = 1e-13);
            assert_relative_eq!(contact.approach, approach, max_relative = 1e-13);
            assert_relative_eq!(contact.force, 50.0, max_relative = 1e-13);
        }
    }
}

#[test]
fn hertz_pressure_deforms_the_half_space_into_the_shape_of_the_body() {
    // the displacement under the elliptical pressure closes the gap: u(x, y) + x^2/2Rx + y^2/2Ry = approach
    let contact = HertzPoint::from_load(20e-3, 8e-3, 230e9, 50.0).unwrap();
    let n = 200;
    let (hx, hy) = (contact.half_width_x / f64::from(n), contact.half_width_y / f64::from(n));
    for (x, y) in
        [(0.0, 0.0), (0.6 * contact.half_width_x, 0.0), (0.0, 0.6 * contact.half_width_y), (0.4e-4, 0.3e-4)]
    {
        let mut displacement = 0.0;
        for j in -n..n {
            for i in -n..n {
                let (px, py) = ((f64::from(i) + 0.5) * hx, (f64::from(j) + 0.5) * hy);
                let pressure = contact.pressure_at(px, py);
                displacement += rectangle_displacement(x - px, y - py, 0.5 * hx, 0.5 * hy, pressure, 230e9);
            }
        }
        let total = displacement + x * x / 40e-3 + y * y / 16e-3;
        assert_relative_eq!(total, contact.approach, max_relative = 2e-4);
    }
}

#[test]
fn hertz_axis_ratio_matches_its_limits() {
    for excess in [1e-15, 1e-12, 1e-8, 1e-4] {
        let near = HertzPoint::from_load(10e-3 * (1.0 + excess), 10e-3, 230e9, 50.0).unwrap();
        // to first order the ratio of the axes is the ratio of the radii to the power 2/3
        assert_relative_eq!(
            near.half_width_x / near.half_width_y,
            1.0 + 2.0 / 3.0 * excess,
            epsilon = 1e-15 + excess * excess
        );
    }
    let line = HertzPoint::from_load(1e5, 1e-2, 230e9, 50.0).unwrap();
    assert!(line.half_width_x / line.half_width_y > 1e3);
}

#[test]
fn hertz_rejects_bad_input_by_name() {
    let error = HertzPoint::from_load(0.0, 1e-2, 230e9, 50.0).unwrap_err().to_string();
    assert!(error.contains("radius_x"), "{error}");
    let error = HertzPoint::from_load(1e-2, 1e-2, 230e9, f64::NAN).unwrap_err().to_string();
    assert!(error.contains("load"), "{error}");
    assert!(HertzPoint::from_max_pressure(1e-2, 1e-2, -1.0, 1e9).is_err());
    assert!(HertzPoint::from_max_pressure(1e-2, 1e-12, 1e9, 1e9).is_err());
    assert!(HertzPoint::from_load(1e-2, 1e-2, 1e-300, 1e300).is_err());
    assert!(equivalent_modulus([209e9, 0.7], [209e9, 0.3]).is_err());
}

fn scene() -> FilmConditions {
    FilmConditions {
        entrainment_speed: 0.1,
        eta0: 0.004,
        alpha: 14.94e-9,
        equivalent_modulus: 229.67e9,
        radius: 9.525e-3,
        load: 54.07,
        ellipticity: 1.0,
    }
}

#[test]
fn film_formulas_match_the_films_of_the_scene() {
    let scene = scene();
    assert_relative_eq!(scene.speed_parameter(), 1.8285e-13, max_relative = 1e-4);
    assert_relative_eq!(scene.material_parameter(), 3431.0, max_relative = 1e-3);
    assert_relative_eq!(scene.load_parameter(), 2.595e-6, max_relative = 1e-3);
    assert_relative_eq!(scene.moes_load(), 5518.0, max_relative = 1e-3);
    assert_relative_eq!(scene.moes_lubricant(), 2.67, max_relative = 1e-3);
    assert_relative_eq!(scene.hamrock_dowson_central().unwrap(), 9.356e-9, max_relative = 2e-4);
    assert_relative_eq!(scene.hamrock_dowson_minimum().unwrap(), 5.132e-9, max_relative = 2e-4);
    assert_relative_eq!(scene.moes_central().unwrap(), 8.23e-9, max_relative = 1e-3);
}

#[test]
fn film_formulas_scale_with_speed_and_reject_bad_input() {
    let slow = scene();
    let fast = FilmConditions { entrainment_speed: 1.0, ..slow };
    let ratio = fast.hamrock_dowson_central().unwrap() / slow.hamrock_dowson_central().unwrap();
    assert_relative_eq!(ratio, 10f64.powf(0.67), max_relative = 1e-12);
    assert!(fast.moes_central().unwrap() > slow.moes_central().unwrap());
    assert!(FilmConditions { load: 0.0, ..slow }.hamrock_dowson_central().is_err());
    assert!(FilmConditions { eta0: f64::INFINITY, ..slow }.hamrock_dowson_minimum().is_err());
    assert!(FilmConditions { ellipticity: 0.0, ..slow }.moes_central().is_err());
}

#[test]
fn westergaard_pressure_integrates_to_the_mean_pressure() {
    let wave = Westergaard { amplitude: 0.2e-6, wavelength: 50e-6, equivalent_modulus: 230e9 };
    let full = wave.full_contact_pressure().unwrap();
    assert_relative_eq!(full, PI * 115e9 * 0.2e-6 / 50e-6, max_relative = 1e-14);
    for share in [0.05, 0.4, 0.9, 1.0, 1.5] {
        let n = 20_000;
        let mean = (0..n)
            .map(|i| wave.pressure_at((f64::from(i) + 0.5) / f64::from(n) * 50e-6, share * full).unwrap())
            .sum::<f64>()
            / f64::from(n);
        assert_relative_eq!(mean, share * full, max_relative = 1e-5);
        let width = wave.contact_half_width(share * full).unwrap();
        if share < 1.0 {
            assert!(wave.pressure_at(0.999 * width, share * full).unwrap() > 0.0);
            assert!(wave.pressure_at(1.001 * width, share * full).unwrap().abs() < f64::MIN_POSITIVE);
        }
    }
    assert!(wave.contact_half_width(-1.0).is_err());
}

#[test]
fn westergaard_pressure_flattens_the_wave() {
    // plane strain: du/dx = -(4/(pi E')) PV integral of p(s)/(x - s), periodic form with cot; inside the
    // contact the slope must cancel that of the surface
    let wave = Westergaard { amplitude: 0.2e-6, wavelength: 50e-6, equivalent_modulus: 230e9 };
    let mean = 0.4 * wave.full_contact_pressure().unwrap();
    let (x, n) = (5e-6, 400_000);
    let step = 50e-6 / f64::from(n);
    let mut sum = 0.0;
    for i in 0..n {
        // nodes half a step from x on either side: the midpoint rule gives the principal value
        let s = x + (f64::from(i) + 0.5) * step;
        sum += wave.pressure_at(s, mean).unwrap() / (PI * (x - s) / 50e-6).tan() * step;
    }
    let slope = -4.0 / (PI * 230e9) * PI / 50e-6 * sum;
    let surface = -0.2e-6 * 2.0 * PI / 50e-6 * (2.0 * PI * x / 50e-6).sin();
    assert_relative_eq!(slope, surface, max_relative = 1e-3);
}
