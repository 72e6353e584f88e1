//! The metrics against distributions and fields whose values are known in closed form.

use approx::assert_relative_eq;
use stribeck::lubricant::Rheology;
use stribeck::metrics::{
    AreaCorrelation, Axis, BearingCurve, composite_rq, contact_patches, contact_statistics,
    friction_coefficient, height_histogram, height_statistics, hybrid_parameters, lambda_ratio,
    mean_central_film, minimum_film, minimum_gap, profile_spectrum, radial_spectrum, viscous_shear_into,
};
use stribeck::{Boundary, Grid};

/// Quantile of the standard normal distribution by Newton's method on the series of the distribution
/// function.
fn quantile(share: f64) -> f64 {
    let mut z: f64 = 0.0;
    for _ in 0..60 {
        let density = (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let (mut term, mut sum, mut n) = (z, z, 1.0);
        while term.abs() > 1e-18 * sum.abs() {
            n += 2.0;
            term *= z * z / n;
            sum += term;
        }
        z -= ((0.5 + density * sum - share) / density).clamp(-0.5, 0.5);
    }
    z
}

/// Sk of the standard normal distribution and the share above half of it.
fn normal_core() -> (f64, f64) {
    let n = 4000;
    let (mut moment, mut square) = (0.0, 0.0);
    for k in 0..n {
        let ratio = -0.2 + 0.4 * (f64::from(k) + 0.5) / f64::from(n);
        moment -= ratio * quantile(0.5 + ratio);
        square += ratio * ratio;
    }
    let sk = -moment / square;
    // the share whose quantile is half of it
    let (mut low, mut high) = (0.5, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if quantile(middle) < 0.5 * sk { low = middle } else { high = middle }
    }
    (sk, 1.0 - low)
}

/// 2^20 heights that are exact normal quantiles of standard deviation `sq`, shuffled by a multiplicative
/// step.
fn normal_heights(sq: f64) -> Vec<f64> {
    let n = 1 << 20;
    let mut heights = vec![0.0; n];
    for (i, height) in heights.iter_mut().enumerate().take(n / 2) {
        *height = if i % 64 == 0 || i < 4096 { quantile((i as f64 + 0.5) / n as f64) } else { f64::NAN };
    }
    // linear between every 64th quantile away from the tail: error below 1e-6
    for i in 4096..n / 2 {
        if heights[i].is_nan() {
            let low = i / 64 * 64;
            let high = if low + 64 < n / 2 { heights[low + 64] } else { 0.0 };
            let span = if low + 64 < n / 2 { 64.0 } else { 63.5 };
            heights[i] = heights[low] + (high - heights[low]) * (i - low) as f64 / span;
        }
    }
    for i in 0..n / 2 {
        heights[n - 1 - i] = -heights[i];
    }
    (0..n).map(|i| sq * heights[(i * 40_503) % n]).collect()
}

#[test]
fn parameters_of_normal_heights_match_theory() {
    let sq = 130e-9;
    let heights = normal_heights(sq);
    let statistics = height_statistics(&heights).unwrap();
    assert_relative_eq!(statistics.sq, sq, max_relative = 1e-4);
    assert_relative_eq!(statistics.sa, 0.7979 * sq, max_relative = 1e-4);
    assert!(statistics.ssk.abs() < 1e-9);
    assert_relative_eq!(statistics.sku, 3.0, max_relative = 1e-3);
    let curve = BearingCurve::new(&heights).unwrap();
    let core = curve.core();
    // by quadrature: the line of least squares through the ratios 0.3 to 0.7 of the normal quantiles
    let (sk, smr1) = normal_core();
    assert_relative_eq!(core.sk, sk * sq, max_relative = 1e-3);
    assert_relative_eq!(core.smr1, smr1, max_relative = 2e-3);
    assert_relative_eq!(core.smr2, 1.0 - smr1, max_relative = 1e-3);
    // the mean of a normal deviate above h is density(h) - h share(h)
    let h = 0.5 * sk;
    let above = (-0.5 * h * h).exp() / (2.0 * std::f64::consts::PI).sqrt() - h * smr1;
    assert_relative_eq!(core.spk, 2.0 * above / smr1 * sq, max_relative = 5e-3);
    assert_relative_eq!(core.svk, core.spk, max_relative = 5e-3);
    let volumes = curve.volumes(0.1, 0.8).unwrap();
    assert_relative_eq!(volumes.vvv, 0.1116 * sq, max_relative = 0.01);
    assert_relative_eq!(volumes.vvc, 1.2173 * sq, max_relative = 0.01);
    assert_relative_eq!(volumes.vmp, 0.0473 * sq, max_relative = 0.01);
    assert_relative_eq!(volumes.vmc, 0.9059 * sq, max_relative = 0.01);
}

#[test]
fn parameters_of_a_sine_match_theory() {
    let heights: Vec<f64> =
        (0..4096).map(|i| 5.0 + 1e-6 * (2.0 * std::f64::consts::PI * f64::from(i) / 4096.0).sin()).collect();
    let statistics = height_statistics(&heights).unwrap();
    assert_relative_eq!(statistics.mean, 5.0, max_relative = 1e-14);
    assert_relative_eq!(statistics.sq, 1e-6 / 2f64.sqrt(), max_relative = 1e-8);
    assert_relative_eq!(statistics.sa, 2e-6 / std::f64::consts::PI, max_relative = 1e-6);
    assert_relative_eq!(statistics.sku, 1.5, max_relative = 1e-8);
    assert_relative_eq!(statistics.sz, 2e-6, max_relative = 1e-8);
    assert_relative_eq!(statistics.sp, statistics.sv, max_relative = 1e-8);
}

#[test]
fn flat_and_single_node_surfaces_have_zero_moments() {
    for heights in [vec![0.1; 1000], vec![-3e-9], vec![0.0; 7]] {
        let statistics = height_statistics(&heights).unwrap();
        assert!(statistics.sq < 1e-16);
        assert_eq!((statistics.ssk, statistics.sku), (0.0, 0.0));
        let curve = BearingCurve::new(&heights).unwrap();
        assert!(curve.core().sk.abs() < 1e-16);
        assert!(curve.volumes(0.1, 0.8).unwrap().vvv.abs() < 1e-16);
    }
}

#[test]
fn plateau_with_grooves_has_core_and_valleys() {
    // 90 % at 0..1 nm, 10 % in grooves down to -100 nm: nearly no peaks, deep valleys
    let heights: Vec<f64> = (0..10_000)
        .map(|i| if i < 9000 { 1e-9 * f64::from(i) / 9000.0 } else { -100e-9 * f64::from(i - 9000) / 1000.0 })
        .collect();
    let core = BearingCurve::new(&heights).unwrap().core();
    assert_relative_eq!(core.sk, 1e-9 / 0.9, max_relative = 0.01);
    assert!(core.spk < 0.01e-9 && core.smr1 < 0.01);
    assert_relative_eq!(core.smr2, 0.9, max_relative = 0.01);
    assert_relative_eq!(core.svk, 100e-9, max_relative = 0.02);
}

#[test]
fn empty_or_infinite_heights_are_rejected() {
    assert!(height_statistics(&[]).is_err());
    let error = height_statistics(&[0.0, f64::NAN]).unwrap_err().to_string();
    assert!(error.contains("heights[1]"), "{error}");
    assert!(BearingCurve::new(&[]).is_err());
    for n in 1..8 {
        let few: Vec<f64> = (0..n).map(|i| f64::from(i * i)).collect();
        let core = BearingCurve::new(&few).unwrap().core();
        assert!(core.sk >= 0.0 && core.smr1 <= core.smr2 && core.spk.is_finite() && core.svk.is_finite());
    }
    let curve = BearingCurve::new(&[1.0, 2.0]).unwrap();
    assert!(curve.volumes(0.9, 0.1).is_err() && curve.volumes(f64::NAN, 0.5).is_err());
    assert_relative_eq!(composite_rq(3.0, 4.0), 5.0);
}

#[test]
fn mean_film_averages_the_clipped_central_region() {
    let grid = Grid::centred(200, 150, 1e-6, 1e-6).unwrap();
    // film x^2 + y^2: mean over a disc of radius r is r^2/2
    let film: Vec<f64> = grid.nodes().map(|(x, y)| x * x + y * y).collect();
    let average = mean_central_film(&grid, &film, 60e-6, 60e-6).unwrap();
    assert_relative_eq!(average, 0.5 * 40e-6f64.powi(2), max_relative = 2e-3);
    // elliptical: mean of x^2 is (2/3 a_x)^2/4
    let film: Vec<f64> = grid.nodes().map(|(x, _)| x * x).collect();
    let average = mean_central_film(&grid, &film, 90e-6, 45e-6).unwrap();
    assert_relative_eq!(average, 0.25 * 60e-6f64.powi(2), max_relative = 5e-3);
    // negative gaps count as zero
    let film: Vec<f64> = grid.nodes().map(|(x, _)| if x < 0.0 { -1.0 } else { 1.0 }).collect();
    assert_relative_eq!(mean_central_film(&grid, &film, 60e-6, 60e-6).unwrap(), 0.5, max_relative = 1e-12);
    assert!(mean_central_film(&grid, &film, 1e-9, 1e-9).is_err());
    assert!(mean_central_film(&grid, &film[1..], 1e-6, 1e-6).is_err());
    assert!(mean_central_film(&grid, &film, 0.0, 1e-6).is_err());
}

#[test]
fn smallest_film_counts_loaded_nodes_only() {
    assert_eq!(minimum_film(&[1.0, -2.0, 3.0], &[1.0, 1.0, 1.0]).unwrap(), Some(-2.0));
    assert_eq!(minimum_film(&[1.0, -2.0], &[0.0, 0.0]).unwrap(), None);
    assert!(minimum_film(&[1.0], &[]).is_err());
    assert!(minimum_gap(&[]).is_err() && minimum_gap(&[f64::NAN]).is_err());
    assert!(lambda_ratio(1e-9, 0.0).unwrap().is_infinite());
    assert!(lambda_ratio(0.0, 0.0).is_err() && lambda_ratio(-1.0, 1.0).is_err());
}

#[test]
fn contact_statistics_match_hand_counts() {
    let grid = Grid::centred(128, 128, 0.5e-3 / 128.0, 0.5e-3 / 128.0).unwrap();
    let a = 149.83e-6;
    let inside: Vec<bool> = grid.nodes().map(|(x, y)| x.hypot(y) <= a).collect();
    let pressure: Vec<f64> =
        grid.nodes().map(|(x, y)| 1.15e9 * (1.0 - (x * x + y * y) / (a * a)).max(0.0).sqrt()).collect();
    let contact = contact_statistics(&grid, &inside, &pressure, 54.07, a, a).unwrap();
    assert_relative_eq!(contact.area_ratio, 1.0, max_relative = 0.01);
    assert_relative_eq!(contact.load_ratio, 1.0, max_relative = 1e-3);
    let all = vec![true; grid.len()];
    let contact = contact_statistics(&grid, &all, &pressure, 54.07, a, a).unwrap();
    assert_relative_eq!(contact.area, 0.25e-6, max_relative = 1e-12);
    assert_relative_eq!(contact.area_ratio, 1.0, max_relative = 0.01);
    assert!(contact_statistics(&grid, &all[1..], &pressure, 54.07, a, a).is_err());
    assert!(contact_statistics(&grid, &all, &pressure, 0.0, a, a).is_err());
}

#[test]
fn friction_is_the_sum_of_boundary_and_viscous_parts() {
    let grid = Grid::centred(10, 10, 1e-6, 1e-6).unwrap();
    let mut shear = vec![0.0; 100];
    viscous_shear_into(&[0.01; 100], &[1e-6; 100], 2.0, &Rheology::newtonian(), &mut shear).unwrap();
    assert_relative_eq!(shear[0], 2e4, max_relative = 1e-14);
    let mu = friction_coefficient(&grid, 0.115, &[0.5e9; 100], &shear, 0.1).unwrap();
    assert_relative_eq!(mu, (0.115 * 0.5e9 + 2e4) * 1e-10 / 0.1, max_relative = 1e-12);
    let mut film = vec![1e-9; 100];
    film[3] = -1e-9;
    let limited = Rheology::newtonian().with_limit(5e7).unwrap();
    viscous_shear_into(&[1e5; 100], &film, 1.0, &limited, &mut shear).unwrap();
    assert_eq!((shear[0], shear[3]), (5e7, 0.0));
    assert!(viscous_shear_into(&[-1.0], &[1.0], 1.0, &limited, &mut [0.0]).is_err());
    assert!(Rheology::newtonian().with_limit(0.0).is_err());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Rheology::eyring(bad).is_err(), "{bad}");
    }
    assert!(friction_coefficient(&grid, -0.1, &shear, &shear, 1.0).is_err());
}

/// White noise with a mean square near 1e-18.
fn scattered(count: usize) -> Vec<f64> {
    (0..count).map(|k| 1e-9 * ((k as f64 * 12.9898).sin() * 43_758.547).fract()).collect()
}

#[test]
fn spectra_integrate_to_the_mean_square() {
    use std::f64::consts::{PI, TAU};
    for (nx, ny) in [(64, 48), (63, 32), (40, 41)] {
        let grid = Grid::centred(nx, ny, 1e-6, 2e-6).unwrap();
        let heights = scattered(grid.len());
        let square = height_statistics(&heights).unwrap().sq.powi(2);
        // every profile has its own mean, which is missing in its spectrum
        for (axis, profiles) in [(Axis::X, ny), (Axis::Y, nx)] {
            let spectrum = profile_spectrum(&grid, &heights, axis, Boundary::Periodic).unwrap();
            let sum: f64 = spectrum.density.iter().sum::<f64>() * spectrum.wavenumber[0] / PI;
            let mean = heights.iter().sum::<f64>() / heights.len() as f64;
            let along = |line: usize| {
                let part = heights
                    .iter()
                    .enumerate()
                    .filter(|(k, _)| if axis == Axis::X { k / nx == line } else { k % nx == line });
                part.map(|(_, z)| z - mean).sum::<f64>() / (heights.len() / profiles) as f64
            };
            let means = (0..profiles).map(|line| along(line).powi(2)).sum::<f64>() / profiles as f64;
            assert_relative_eq!(sum + means, square, max_relative = 1e-10);
        }
    }
    // white noise: uniform density, variance times the area of a cell
    let grid = Grid::centred(256, 256, 1e-6, 1e-6).unwrap();
    let heights = scattered(grid.len());
    let square = height_statistics(&heights).unwrap().sq.powi(2);
    for boundary in [Boundary::Periodic, Boundary::Open] {
        let spectrum = radial_spectrum(&grid, &heights, boundary).unwrap();
        let rings = &spectrum.density[20..];
        assert_relative_eq!(
            rings.iter().sum::<f64>() / rings.len() as f64,
            square * 1e-12,
            max_relative = 0.03
        );
        assert_relative_eq!(spectrum.wavenumber[0], TAU / 256e-6, max_relative = 1e-9);
        assert_eq!(spectrum.wavenumber.len(), 128);
    }
    let few = Grid::centred(3, 8, 1e-6, 1e-6).unwrap();
    assert!(radial_spectrum(&few, &[0.0; 24], Boundary::Open).is_err());
    assert!(profile_spectrum(&few, &[0.0; 24], Axis::X, Boundary::Open).is_err());
    assert!(profile_spectrum(&few, &[0.0; 23], Axis::Y, Boundary::Open).is_err());
}

#[test]
fn autocorrelation_matches_the_mean_over_pairs_of_defined_points() {
    let (nx, ny) = (14, 11);
    let grid = Grid::centred(nx, ny, 1e-6, 2e-6).unwrap();
    let heights: Vec<f64> = scattered(nx * ny).iter().map(|z| z + 0.01).collect();
    let mask: Vec<bool> = (0..nx * ny).map(|k| k % 6 != 2).collect();
    for (defined, boundary) in [
        (None, Boundary::Open),
        (Some(mask.as_slice()), Boundary::Open),
        (None, Boundary::Periodic),
        (Some(mask.as_slice()), Boundary::Periodic),
    ] {
        let found = AreaCorrelation::new(&grid, &heights, defined, boundary).unwrap();
        let has = |k: usize| defined.is_none_or(|mask| mask[k]);
        let count = (0..nx * ny).filter(|&k| has(k)).count() as f64;
        let mean = (0..nx * ny).filter(|&k| has(k)).map(|k| heights[k]).sum::<f64>() / count;
        let pairs = |di: isize, dj: isize| {
            let (mut sum, mut pairs) = (0.0, 0.0);
            for k in (0..nx * ny).filter(|&k| has(k)) {
                let (i, j) = ((k % nx) as isize + di, (k / nx) as isize + dj);
                let (inside_x, inside_y) = ((0..nx as isize).contains(&i), (0..ny as isize).contains(&j));
                if boundary == Boundary::Open && !(inside_x && inside_y) {
                    continue;
                }
                let l = (j.rem_euclid(ny as isize) * nx as isize + i.rem_euclid(nx as isize)) as usize;
                if has(l) {
                    sum += (heights[k] - mean) * (heights[l] - mean);
                    pairs += 1.0;
                }
            }
            sum / pairs
        };
        let square = pairs(0, 0);
        for (di, dj) in [(0, 0), (1, 0), (0, 1), (-3, 2), (7, 5), (-7, -5), (4, -4)] {
            assert_relative_eq!(found.at(di, dj).unwrap(), pairs(di, dj) / square, epsilon = 1e-7);
        }
        assert_eq!((found.reach(), found.at(8, 0)), ((7, 5), None));
    }
    assert!(AreaCorrelation::new(&grid, &[1.0; 154], None, Boundary::Open).is_err());
}

#[test]
fn texture_aspect_ratio_matches_the_correlation_lengths() {
    // correlations that fall to 0.2 at 20 and 50 nodes; approximate, with a finite number of directions
    let grid = Grid::centred(512, 512, 1e-6, 1e-6).unwrap();
    let lengths = [20e-6, 50e-6].map(|length: f64| length / (0.2_f64.ln() / -std::f64::consts::LN_10).sqrt());
    let spec = stribeck::surface::RoughnessSpec {
        autocorrelation: stribeck::surface::Autocorrelation::Gaussian,
        rq: 1e-7,
        length_x: lengths[0],
        length_y: lengths[1],
        seed: 4,
    };
    let heights = stribeck::surface::generate(&grid, &spec).unwrap();
    let correlation = AreaCorrelation::new(&grid, &heights, None, Boundary::Periodic).unwrap();
    let spatial = correlation.spatial(0.2).unwrap();
    assert_relative_eq!(spatial.sal.unwrap(), 20e-6, max_relative = 0.1);
    assert_relative_eq!(spatial.str.unwrap(), 0.4, max_relative = 0.2);
    for threshold in [0.0, 1.0, -0.1, f64::NAN] {
        assert!(correlation.spatial(threshold).is_err());
    }
    // grooves stay correlated along their direction
    let grooves: Vec<f64> = grid.nodes().map(|(x, _)| (x / 5e-6).sin()).collect();
    let spatial = AreaCorrelation::new(&grid, &grooves, None, Boundary::Open).unwrap().spatial(0.2).unwrap();
    // cos(x / 5 um) = 0.2
    assert_relative_eq!(spatial.sal.unwrap(), 5e-6 * 0.2_f64.acos(), max_relative = 0.01);
    assert_eq!(spatial.str, None);
}

#[test]
fn core_line_is_that_of_least_squares() {
    // a worn surface: half of it a plateau that bends down, the rest valleys
    let heights: Vec<f64> = (0..1000)
        .map(|i| {
            let ratio = (f64::from(i) + 0.5) / 1000.0;
            if ratio < 0.5 { -ratio * ratio } else { -0.25 - 4.0 * (ratio - 0.5) }
        })
        .collect();
    let curve = BearingCurve::new(&heights).unwrap();
    // least squares of -r^2 between 0 and 0.4: slope -0.4, mean -0.16/3
    let (top, bottom) = curve.equivalent_line();
    assert_relative_eq!(top - bottom, 0.4, max_relative = 1e-3);
    let mean = heights.iter().sum::<f64>() / 1000.0;
    assert_relative_eq!(top, -0.16 / 3.0 + 0.4 * 0.2 - mean, max_relative = 1e-3);
    assert_relative_eq!(curve.core().sk, top - bottom, max_relative = 1e-14);
}

/// The formula turns a cosine of wave number k into its slope times
/// `(45 sin h - 9 sin 2h + sin 3h)/(30 h)` with `h = k dx`, which differs from 1 by `h^6/140`.
#[test]
fn slope_of_a_cosine_is_exact_to_sixth_order() {
    let error = |points: usize| {
        // three periods between the three points at each end
        let grid = Grid::centred(3 * points + 6, 1, 1e-6, 1e-6).unwrap();
        let wave = std::f64::consts::TAU / (points as f64 * 1e-6);
        let heights: Vec<f64> = grid.nodes().map(|(x, _)| 1e-6 * (wave * x).cos()).collect();
        let sdq = hybrid_parameters(&grid, &heights, None).unwrap().sdq;
        sdq * 2f64.sqrt() / (1e-6 * wave) - 1.0
    };
    for points in [8, 16, 32] {
        let h = std::f64::consts::TAU / points as f64;
        let factor = (45.0 * h.sin() - 9.0 * (2.0 * h).sin() + (3.0 * h).sin()) / (30.0 * h);
        assert_relative_eq!(error(points), factor - 1.0, max_relative = 1e-5);
    }
    let order = (error(16) / error(32)).log2();
    assert!((order - 6.0).abs() < 0.1, "{order}");
}

/// Software gauges are functions with stated parameters: here `A cos(2 pi x/L) cos(2 pi y/L)`, whose `Sdq` is
/// `2 pi A/(L sqrt 2)` and whose `Sdr` follows by quadrature over a period.
#[test]
fn gradient_and_area_of_a_software_gauge_are_the_stated_ones() {
    let (amplitude, length) = (2e-6, 32e-6);
    let wave = std::f64::consts::TAU / length;
    // six points more than four periods: slopes cover these exactly
    let grid = Grid::centred(134, 134, 1e-6, 1e-6).unwrap();
    let heights: Vec<f64> =
        grid.nodes().map(|(x, y)| amplitude * (wave * x).cos() * (wave * y).cos()).collect();
    let hybrid = hybrid_parameters(&grid, &heights, None).unwrap();
    let slope = amplitude * wave;
    // along x all 134 lines count, of which six stand beside whole periods
    assert_relative_eq!(hybrid.sdq, slope / 2f64.sqrt(), max_relative = 0.03);
    let n = 400;
    let mut sdr = 0.0;
    let turn = |m: usize| std::f64::consts::TAU * (m as f64 + 0.5) / n as f64;
    for k in 0..n * n {
        let (x, y) = (turn(k % n), turn(k / n));
        let (p, q) = (slope * x.sin() * y.cos(), slope * x.cos() * y.sin());
        sdr += ((1.0 + p * p + q * q).sqrt() - 1.0) / (n * n) as f64;
    }
    assert_relative_eq!(hybrid.sdr, sdr, max_relative = 1e-5);
    // of a row of whole periods and its six neighbours the stated slope
    let line = Grid::centred(134, 1, 1e-6, 1e-6).unwrap();
    let row: Vec<f64> = line.nodes().map(|(x, _)| amplitude * (wave * x).cos()).collect();
    let hybrid = hybrid_parameters(&line, &row, None).unwrap();
    assert_relative_eq!(hybrid.sdq, slope / 2f64.sqrt(), max_relative = 1e-6);
    // and the excess of the length of its curve
    let excess = |k: usize| (1.0 + (slope * turn(k).sin()).powi(2)).sqrt() - 1.0;
    assert_relative_eq!(hybrid.sdr, (0..n).map(excess).sum::<f64>() / n as f64, max_relative = 1e-5);
}

#[test]
fn area_of_a_small_map_with_a_gap_is_that_of_its_plane() {
    // the heights 1 to 12 in three rows, the second of the middle one undefined: slopes 1/2 along x and 2 along y
    let grid = Grid::centred(4, 3, 2.0, 2.0).unwrap();
    let heights: Vec<f64> = (1..=12).map(f64::from).collect();
    let defined: Vec<bool> = (0..12).map(|k| k != 5).collect();
    let hybrid = hybrid_parameters(&grid, &heights, Some(&defined)).unwrap();
    assert_relative_eq!(hybrid.sdq, 4.25_f64.sqrt(), max_relative = 1e-12);
    assert_relative_eq!(hybrid.sdr, 5.25_f64.sqrt() - 1.0, max_relative = 1e-12);
    // no point of a diagonal has neighbors along both axes
    let cross: Vec<bool> = (0..12).map(|k| [0, 1, 6, 10].contains(&k)).collect();
    assert!(hybrid_parameters(&grid, &heights, Some(&cross)).unwrap().sdr.is_nan());
}

#[test]
fn a_profile_has_no_texture_aspect() {
    let grid = Grid::centred(64, 1, 1e-6, 1e-6).unwrap();
    let wave: Vec<f64> = (0..64).map(|i| (f64::from(i) * std::f64::consts::TAU / 16.0).sin()).collect();
    let correlation = AreaCorrelation::new(&grid, &wave, None, Boundary::Periodic).unwrap();
    let spatial = correlation.spatial(0.2).unwrap();
    assert!(spatial.sal.is_some() && spatial.str.is_none(), "{spatial:?}");
}

#[test]
fn slopes_of_known_shapes() {
    // a roof with holes: the same slope wherever the seven points are on one side
    let grid = Grid::centred(400, 400, 1e-7, 1e-7).unwrap();
    let roof: Vec<f64> = grid.nodes().map(|(x, _)| x.abs()).collect();
    let mask: Vec<bool> = (0..grid.len()).map(|k| k % 17 != 3).collect();
    let hybrid = hybrid_parameters(&grid, &roof, Some(&mask)).unwrap();
    assert_relative_eq!(hybrid.sdq, 1.0, max_relative = 1e-2);
    assert_relative_eq!(hybrid.sdr, 2f64.sqrt() - 1.0, max_relative = 2e-2);
    assert!(hybrid_parameters(&grid, &roof, Some(&mask[1..])).is_err());
    let lone = Grid::centred(1, 1, 1.0, 1.0).unwrap();
    assert!(hybrid_parameters(&lone, &[0.0], None).is_err());
    // few points: five, three and two
    for (n, expected) in [(6, 3.0), (4, 3.0), (2, 3.0)] {
        let few = Grid::centred(n, 1, 1.0, 1.0).unwrap();
        let ramp: Vec<f64> = (0..n).map(|i| 3.0 * i as f64).collect();
        let hybrid = hybrid_parameters(&few, &ramp, None).unwrap();
        assert_relative_eq!(hybrid.sdq, expected, max_relative = 1e-14);
        assert_relative_eq!(hybrid.sdr, 10f64.sqrt() - 1.0, max_relative = 1e-14);
    }
}

#[test]
fn patches_of_discs_have_known_number_area_and_perimeter() {
    // discs of known area, one of them across the corner of a periodic grid
    let n = 256;
    let grid = Grid::centred(n, n, 1e-6, 1e-6).unwrap();
    let radii = [30e-6, 20e-6];
    let wrapped = |d: f64| (d + 128e-6).rem_euclid(256e-6) - 128e-6;
    let flags: Vec<bool> = grid
        .nodes()
        .map(|(x, y)| x.hypot(y) < radii[0] || wrapped(x - 127e-6).hypot(wrapped(y - 126e-6)) < radii[1])
        .collect();
    let periodic = contact_patches(&grid, &flags, Boundary::Periodic).unwrap();
    let open = contact_patches(&grid, &flags, Boundary::Open).unwrap();
    assert_eq!((periodic.areas.len(), open.areas.len()), (2, 5));
    for (area, radius) in periodic.areas.iter().zip(radii) {
        assert_relative_eq!(*area, std::f64::consts::PI * radius * radius, max_relative = 0.01);
    }
    // the perimeter of a disc of cells equals that of the enclosing square
    assert_relative_eq!(periodic.perimeter, 8.0 * (radii[0] + radii[1]), max_relative = 0.03);
    let whole: f64 = periodic.areas.iter().sum();
    let factor = (std::f64::consts::PI - 1.0 + std::f64::consts::LN_2) / 24.0;
    assert_relative_eq!(
        periodic.corrected_area,
        whole - factor * 1e-6 * periodic.perimeter,
        max_relative = 1e-12
    );
    let none = contact_patches(&grid, &vec![false; n * n], Boundary::Open).unwrap();
    assert!(none.areas.is_empty() && none.perimeter == 0.0 && none.corrected_area == 0.0);
    let all = contact_patches(&grid, &vec![true; n * n], Boundary::Periodic).unwrap();
    assert_eq!((all.areas.len(), all.perimeter), (1, 0.0));
    assert!(contact_patches(&grid, &[true], Boundary::Open).is_err());
}

#[test]
fn histograms_count_every_height_once() {
    let heights = scattered(1000);
    for classes in [1, 7, 1000] {
        let histogram = height_histogram(&heights, classes).unwrap();
        assert_eq!(histogram.density.len(), classes);
        assert_relative_eq!(
            histogram.density.iter().sum::<f64>() * histogram.width,
            1.0,
            max_relative = 1e-12
        );
    }
    for (heights, classes) in
        [(&[][..], 3), (&[1.0, 1.0], 3), (&[0.0, f64::NAN], 3), (&[0.0, 1.0], 0), (&[0.0, 1.0], usize::MAX)]
    {
        assert!(height_histogram(heights, classes).is_err());
    }
}
