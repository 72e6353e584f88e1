//! Preparation of measured surfaces: form, filters, arrangement, transfer; and made textures.

use std::f64::consts::{LN_2, PI, TAU};

use approx::assert_relative_eq;
use stribeck::metrics::height_statistics;
use stribeck::surface::{DimpleLayout, GrooveDirection, Heights, LengthUnit, SurfaceError, Texture};
use stribeck::{Boundary, Grid, InputError};

const SPACING: f64 = 1e-6;

fn surface(nx: usize, ny: usize, height: impl Fn(f64, f64) -> f64) -> Heights {
    let points = (0..nx * ny).map(|k| (k % nx, k / nx));
    let heights =
        points.map(|(i, j)| height((i as f64 + 0.5) * SPACING, (j as f64 + 0.5) * SPACING)).collect();
    Heights::new(nx, ny, Some([SPACING, SPACING]), heights, None).unwrap()
}

fn with_holes(surface: &Heights, every: usize) -> Heights {
    let mask = (0..surface.heights().len()).map(|k| k % every != 3).collect();
    let spacing = surface.dx().zip(surface.dy()).map(|(dx, dy)| [dx, dy]);
    Heights::new(surface.nx(), surface.ny(), spacing, surface.heights().to_vec(), Some(mask)).unwrap()
}

// ---------------------------------------------------------------- form

#[test]
fn polynomials_up_to_their_degree_vanish() {
    // height of a polynomial of degree 4 in units of the surface
    let poly = |x: f64, y: f64| {
        let (u, v) = (x / 60e-6, y / 40e-6);
        1e-3 + 1e-6 * (u - 2.0 * v + 0.5 * u * v - u.powi(3) + 2.0 * u * u * v * v - v.powi(4))
    };
    for whole in [surface(60, 40, poly), with_holes(&surface(60, 40, poly), 7)] {
        for degree in 0..=10 {
            let mut flat = whole.clone();
            flat.remove_polynomial(degree).unwrap();
            let largest = flat.heights().iter().fold(0.0_f64, |largest, z| largest.max(z.abs()));
            if degree >= 4 {
                assert!(largest < 1e-16, "degree {degree}: {largest}");
            } else {
                assert!(largest > 1e-8, "degree {degree}: {largest}");
            }
        }
    }
    let mut whole = surface(5, 5, poly);
    assert!(matches!(whole.remove_polynomial(11), Err(SurfaceError::Input(InputError::Value { .. }))));
    // more terms than points along an axis
    whole.remove_polynomial(8).unwrap();
    assert!(whole.heights().iter().all(|z| z.abs() < 1e-15));
}

#[test]
fn removed_form_is_orthogonal_to_the_remaining_heights() {
    let rough = |x: f64, y: f64| 1e-7 * ((x / 3e-6).sin() + (y / 5e-6).cos()) + 2e-3 * x;
    let mut left = with_holes(&surface(50, 31, rough), 11);
    left.remove_polynomial(2).unwrap();
    let mask = left.defined().unwrap();
    let term = |power_x: i32, power_y: i32| {
        let points = left.heights().iter().zip(mask).enumerate().filter(|(_, (_, flag))| **flag);
        points
            .map(|(k, (z, _))| {
                z * (k as f64 % 50.0 / 25.0 - 1.0).powi(power_x)
                    * ((k / 50) as f64 / 15.5 - 1.0).powi(power_y)
            })
            .sum::<f64>()
    };
    for (a, b) in [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)] {
        assert!(term(a, b).abs() < 1e-18, "{a} {b}: {}", term(a, b));
    }
    assert!(term(3, 0).abs() > 1e-9);
}

#[test]
fn spheres_are_found_wherever_their_top_is() {
    // tops beside the middle, balls and sockets, flat and steep caps
    for (radius, x0, y0) in [
        (9.525e-3, 12e-6, 7e-6),
        (-3e-3, 30e-6, 90e-6),
        (60e-6, 25e-6, 21e-6),
        (0.5, -1e-3, 0.0),
        (40e-6, 20e-6, 15e-6),
    ] {
        let sphere = |x: f64, y: f64| {
            let square: f64 = radius * radius - (x - x0).powi(2) - (y - y0).powi(2);
            f64::signum(radius) * (square.sqrt() - radius.abs()) + 4e-3
        };
        for whole in [surface(40, 30, sphere), with_holes(&surface(40, 30, sphere), 5)] {
            let mut flat = whole;
            let found = flat.remove_sphere().unwrap();
            assert_relative_eq!(found, radius, max_relative = 1e-5);
            let largest = flat.heights().iter().fold(0.0_f64, |largest, z| largest.max(z.abs()));
            assert!(largest < 1e-14, "{radius}: {largest}");
        }
    }
    // roughness on a ball
    let rough = |x: f64, y: f64| 5e-9 * ((x + 2.0 * y) / 2e-6).sin();
    let mut ball =
        surface(100, 100, |x, y| (1e-4_f64 - (x - 50e-6).powi(2) - (y - 50e-6).powi(2)).sqrt() + rough(x, y));
    assert_relative_eq!(ball.remove_sphere().unwrap(), 1e-2, max_relative = 0.02);
    assert_relative_eq!(
        height_statistics(ball.heights()).unwrap().sq,
        5e-9 / 2f64.sqrt(),
        max_relative = 0.02
    );
    // a line, and a flat
    let mut line = surface(30, 1, |x, _| (1e-6 - (x - 9e-6).powi(2)).sqrt());
    assert_relative_eq!(line.remove_sphere().unwrap(), 1e-3, max_relative = 1e-6);
    let mut flat = surface(10, 10, |x, y| 1e-3 + 0.1 * x - 0.2 * y);
    assert!(flat.remove_sphere().unwrap().abs() > 1e3);
    let without = Heights::new(2, 2, None, vec![0.0; 4], None);
    assert!(matches!(without.unwrap().remove_sphere(), Err(SurfaceError::NoSpacing)));
    // spikes that reach far above their distance are no cap
    let mut spikes = surface(6, 6, |x, y| if x + y < 5e-6 { 1.0 } else { 0.0 });
    let _ = spikes.remove_sphere();
}

// ---------------------------------------------------------------- filters

#[test]
fn the_gaussian_filter_transmits_what_the_standard_says() {
    let cutoff = 24e-6;
    for (waves_x, waves_y) in [(0, 4), (2, 0), (4, 0), (8, 3), (0, 12)] {
        let (nx, ny) = (96, 80);
        let q = [TAU * f64::from(waves_x) / 96e-6, TAU * f64::from(waves_y) / 80e-6];
        let wave = |x: f64, y: f64| 3e-3 + 1e-7 * (q[0] * x + q[1] * y + 0.3).sin();
        let square = (q[0] * q[0] + q[1] * q[1]) / (TAU * TAU);
        let transmission = (-LN_2 * cutoff * cutoff * square).exp();
        let before = surface(nx, ny, wave);
        let (mut smooth, mut rough) = (before.clone(), before.clone());
        smooth.s_filter(cutoff, Boundary::Periodic).unwrap();
        rough.l_filter(cutoff, Boundary::Periodic).unwrap();
        for (k, z) in before.heights().iter().enumerate() {
            assert_relative_eq!(smooth.heights()[k] - 3e-3, transmission * (z - 3e-3), epsilon = 1e-17);
            assert_relative_eq!(rough.heights()[k], (1.0 - transmission) * (z - 3e-3), epsilon = 1e-17);
        }
        if waves_x == 4 {
            assert_relative_eq!(transmission, 0.5, max_relative = 1e-12);
        }
    }
}

/// The sum of the standard's weights over the defined points, point by point.
fn direct(surface: &Heights, cutoff: f64, k: usize) -> f64 {
    let nx = surface.nx();
    let alpha = (LN_2 / PI).sqrt();
    let (mut sum, mut weights) = (0.0, 0.0);
    for (l, z) in surface.heights().iter().enumerate() {
        if surface.defined().is_some_and(|mask| !mask[l]) {
            continue;
        }
        let (dx, dy) = ((l % nx) as f64 - (k % nx) as f64, (l / nx) as f64 - (k / nx) as f64);
        let weight = (-PI * (dx * dx + dy * dy) * (SPACING / (alpha * cutoff)).powi(2)).exp();
        sum += weight * z;
        weights += weight;
    }
    sum / weights
}

#[test]
fn edges_and_holes_are_filtered_with_what_is_defined() {
    let rough = |x: f64, y: f64| 1e-7 * ((x / 2e-6).sin() * (y / 3e-6).cos() + x / 1e-5) + 0.02;
    for whole in [surface(31, 22, rough), with_holes(&surface(31, 22, rough), 5), surface(40, 1, rough)] {
        let mut smooth = whole.clone();
        smooth.s_filter(12e-6, Boundary::Open).unwrap();
        assert_eq!(smooth.defined(), whole.defined());
        for k in 0..whole.heights().len() {
            let defined = whole.defined().is_none_or(|mask| mask[k]);
            let expected = if defined { direct(&whole, 12e-6, k) } else { 0.0 };
            assert_relative_eq!(smooth.heights()[k], expected, epsilon = 1e-16);
        }
    }
}

#[test]
fn filters_refuse_bad_cutoffs() {
    let mut whole = surface(20, 10, |x, _| x);
    for cutoff in [0.0, -1e-6, f64::NAN, f64::INFINITY, 21e-6] {
        let error = whole.s_filter(cutoff, Boundary::Open).unwrap_err().to_string();
        assert!(error.starts_with("cutoff = "), "{error}");
        assert!(whole.l_filter(cutoff, Boundary::Periodic).is_err());
    }
    let mut without = Heights::new(2, 1, None, vec![0.0, 1.0], None).unwrap();
    assert!(matches!(without.s_filter(1.0, Boundary::Open), Err(SurfaceError::NoSpacing)));
    let nothing = Heights::new(2, 1, Some([1.0, 1.0]), vec![0.0; 2], Some(vec![false; 2]));
    assert!(matches!(nothing.unwrap().s_filter(1.0, Boundary::Open), Err(SurfaceError::AllUndefined { .. })));
    // a cut-off far below the spacing changes nothing
    let before = whole.clone();
    whole.s_filter(1e-13, Boundary::Open).unwrap();
    assert!(whole.heights().iter().zip(before.heights()).all(|(a, b)| (a - b).abs() < 1e-19));
}

// ---------------------------------------------------------------- arrangement

#[test]
fn parts_turns_and_mirror_images() {
    let heights = (0..12).map(f64::from).collect();
    let mut mask = vec![true; 12];
    mask[6] = false;
    let whole = Heights::new(4, 3, Some([1e-6, 2e-6]), heights, Some(mask)).unwrap();
    let whole = whole.with_unit(LengthUnit::Nanometre);
    let part = whole.crop([1, 1], 2, 2).unwrap();
    assert_eq!(
        (part.heights(), part.defined().unwrap()),
        (&[5.0, 0.0, 9.0, 10.0][..], &[true, false, true, true][..])
    );
    assert_eq!((part.unit(), part.dy()), (Some(LengthUnit::Nanometre), Some(2e-6)));
    assert_eq!(whole.crop([0, 0], 2, 1).unwrap().defined(), None);
    for (first, nx, ny) in
        [([3, 0], 2, 1), ([0, 0], 0, 1), ([0, 3], 1, 1), ([usize::MAX, 0], 2, 1), ([0, 0], 1, 4)]
    {
        assert!(whole.crop(first, nx, ny).is_err(), "{first:?}");
    }
    let turned = whole.rotated_90();
    assert_eq!((turned.nx(), turned.ny(), turned.dx(), turned.dy()), (3, 4, Some(2e-6), Some(1e-6)));
    // the lower right corner comes to the upper right
    assert_eq!((turned.heights()[11], turned.heights()[0]), (3.0, 8.0));
    assert_eq!(turned.rotated_90().rotated_90().rotated_90(), whole);
    assert_eq!(whole.mirrored_x().mirrored_y(), turned.rotated_90());
    let tiled = whole.tile_mirrored().unwrap();
    assert_eq!((tiled.nx(), tiled.ny(), tiled.undefined()), (8, 6, 4));
    for j in 0..6 {
        for i in 0..8 {
            assert_eq!(tiled.heights()[j * 8 + i].to_bits(), tiled.heights()[(5 - j) * 8 + 7 - i].to_bits());
        }
    }
    let large = Heights::new(1 << 13, 1 << 12, None, vec![0.0; 1 << 25], None).unwrap();
    assert!(large.tile_mirrored().is_err());
}

#[test]
fn tapered_edges_fit_together() {
    let whole = surface(64, 48, |x, y| 5e-3 + 1e-4 * x - 2e-4 * y);
    let mut tapered = whole.clone();
    tapered.taper(12e-6).unwrap();
    let statistics = height_statistics(whole.heights()).unwrap();
    let edge = (0..64).map(|i| tapered.heights()[i]).chain((0..48).map(|j| tapered.heights()[j * 64 + 63]));
    assert!(edge.into_iter().all(|z| (z - statistics.mean).abs() < 0.01 * statistics.sz));
    assert_eq!(tapered.heights()[24 * 64 + 30].to_bits(), whole.heights()[24 * 64 + 30].to_bits());
    // half way in the window passes half
    let share = (5.5_f64 / 12.0 * 0.5 * PI).sin().powi(2);
    assert_relative_eq!(
        tapered.heights()[24 * 64 + 5] - statistics.mean,
        share * (whole.heights()[24 * 64 + 5] - statistics.mean),
        max_relative = 1e-9
    );
    for width in [0.0, -1.0, f64::NAN, 25e-6] {
        assert!(tapered.taper(width).is_err(), "{width}");
    }
}

#[test]
fn heights_are_scaled_to_the_requested_parameter() {
    let mut whole = with_holes(&surface(30, 20, |x, y| 1.0 + 1e-3 * (x / 3e-6).sin() + y), 4);
    whole.set_rq(77e-9).unwrap();
    let mask = whole.defined().unwrap();
    let defined: Vec<f64> = whole.heights().iter().zip(mask).filter(|(_, f)| **f).map(|(z, _)| *z).collect();
    let statistics = height_statistics(&defined).unwrap();
    assert_relative_eq!(statistics.sq, 77e-9, max_relative = 1e-12);
    assert!(statistics.mean.abs() < 1e-20);
    whole.set_rq(0.0).unwrap();
    assert!(whole.heights().iter().all(|z| *z == 0.0));
    assert!(whole.set_rq(1e-9).is_err() && whole.set_rq(-1e-9).is_err() && whole.set_rq(f64::NAN).is_err());
}

// ---------------------------------------------------------------- Fourier resampling

#[test]
fn resolved_waves_survive_fourier_resampling() {
    let wave = |x: f64, y: f64| {
        1e-7 * ((TAU * 3.0 * x / 40e-6).sin() + (TAU * (2.0 * x / 40e-6 - 4.0 * y / 30e-6) + 1.0).cos())
            + 2e-3
    };
    let whole = surface(40, 30, wave);
    for (nx, ny) in [(40, 30), (80, 60), (17, 19), (13, 12), (41, 300), (40, 31), (9, 10)] {
        let other = whole.resample_fourier(nx, ny).unwrap();
        let (dx, dy) = (other.dx().unwrap(), other.dy().unwrap());
        assert_relative_eq!(dx * nx as f64, 40e-6, max_relative = 1e-12);
        for (k, z) in other.heights().iter().enumerate() {
            let (x, y) = ((k % nx) as f64 + 0.5, (k / nx) as f64 + 0.5);
            assert_relative_eq!(*z, wave(x * dx, y * dy), epsilon = 1e-17);
        }
    }
    // the mean stays whatever is left out, and finer is undone by coarser
    let rough = surface(21, 16, |x, y| ((x * 1.3e6).sin() * 9.0).sin() + (y * 2.1e6).cos());
    let mean = |s: &Heights| s.heights().iter().sum::<f64>() / s.heights().len() as f64;
    for (nx, ny) in [(5, 4), (10, 8), (50, 37), (42, 32)] {
        let other = rough.resample_fourier(nx, ny).unwrap();
        assert_relative_eq!(mean(&other), mean(&rough), epsilon = 1e-14);
        if nx > 21 {
            let back = other.resample_fourier(21, 16).unwrap();
            assert!(back.heights().iter().zip(rough.heights()).all(|(a, b)| (a - b).abs() < 1e-13));
        }
    }
    assert!(rough.resample_fourier(0, 3).is_err() && rough.resample_fourier(1 << 20, 1 << 20).is_err());
    assert!(matches!(with_holes(&rough, 9).resample_fourier(3, 3), Err(SurfaceError::Undefined { .. })));
}

// ---------------------------------------------------------------- textures

#[test]
fn dimples_have_the_requested_places_and_depths() {
    let grid = Grid::from_edges(240, 160, [-1e-4, 2e-4], [0.0, 2e-4]).unwrap();
    let dimples = |layout, pitch| Texture::Dimples { radius: 20e-6, depth: 2e-6, pitch, layout };
    let share = PI * 0.16;
    for layout in [DimpleLayout::Square, DimpleLayout::Random { seed: 3 }] {
        let heights = dimples(layout, 49e-6).generate(&grid).unwrap();
        let low = heights.iter().copied().fold(0.0, f64::min);
        assert!(low > -2e-6 * (1.0 + 1e-12) && low < -1.99e-6, "{low}");
        let covered = heights.iter().filter(|z| **z < 0.0).count() as f64 / heights.len() as f64;
        assert_relative_eq!(covered, share, max_relative = 0.03);
        // volume of a paraboloid: half of that of the cylinder
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        assert_relative_eq!(mean, -0.5 * 2e-6 * share, max_relative = 0.02);
    }
    let random = |seed| dimples(DimpleLayout::Random { seed }, 50e-6).generate(&grid).unwrap();
    assert_eq!(random(1), random(1));
    assert_ne!(random(1), random(2));
    for bad in [
        dimples(DimpleLayout::Square, 39e-6),
        dimples(DimpleLayout::Square, 1e-12),
        dimples(DimpleLayout::Square, 1.0),
        dimples(DimpleLayout::Square, f64::NAN),
        Texture::Dimples { radius: -1.0, depth: 1.0, pitch: 1e-4, layout: DimpleLayout::Square },
        Texture::Dimples { radius: 1e-6, depth: 0.0, pitch: 1e-4, layout: DimpleLayout::Square },
    ] {
        assert!(bad.generate(&grid).unwrap_err().to_string().starts_with("texture."));
    }
}

#[test]
fn grooves_have_the_requested_direction() {
    let grid = Grid::centred(120, 120, 1e-6, 1e-6).unwrap();
    let grooves = |direction| Texture::Grooves { width: 12e-6, depth: 1e-6, pitch: 30e-6, direction };
    let along_x = grooves(GrooveDirection::AlongX).generate(&grid).unwrap();
    let along_y = grooves(GrooveDirection::AlongY).generate(&grid).unwrap();
    let crossed = grooves(GrooveDirection::Crossed).generate(&grid).unwrap();
    for (k, z) in crossed.iter().enumerate() {
        let (i, j) = (k % 120, k / 120);
        assert_eq!(along_x[k].to_bits(), along_x[j * 120].to_bits());
        assert_eq!(along_y[k].to_bits(), along_y[i].to_bits());
        assert_eq!(z.to_bits(), along_x[k].min(along_y[k]).to_bits());
    }
    // four grooves with parabolic cross-sections
    let mean = along_x.iter().sum::<f64>() / 14_400.0;
    assert_relative_eq!(mean, -2.0 / 3.0 * 1e-6 * 12.0 / 30.0, max_relative = 0.01);
    let wide =
        Texture::Grooves { width: 31e-6, depth: 1e-6, pitch: 30e-6, direction: GrooveDirection::AlongX };
    assert!(wide.generate(&grid).unwrap_err().to_string().contains("above the width"));
}

#[test]
fn cylinders_of_any_direction_and_tilt_are_removed() {
    let grid = Grid::centred(60, 48, 10e-6, 12e-6).unwrap();
    for (angle, tilt, radius) in
        [(0.0_f64, 0.0_f64, 4e-3_f64), (0.4, 0.05, 4e-3), (1.9, -0.1, -6e-3), (1.2, 0.0, 1.0)]
    {
        let (sin, cos) = angle.sin_cos();
        let heights: Vec<f64> = grid
            .nodes()
            .map(|(x, y)| {
                let (u, v) = (x * cos + y * sin, y * cos - x * sin - 30e-6);
                tilt * u + radius.signum() * (1.0 + tilt * tilt).sqrt() * (radius * radius - v * v).sqrt()
            })
            .collect();
        let mut surface = Heights::new(60, 48, Some([10e-6, 12e-6]), heights, None).unwrap();
        let found = surface.remove_cylinder().unwrap();
        assert!((found / radius - 1.0).abs() < 1e-5, "{angle}: {found}, expected {radius}");
        assert!(surface.heights().iter().all(|z| z.abs() < 1e-12), "{angle}");
    }
    let mut lost = Heights::new(4, 4, None, vec![0.0; 16], None).unwrap();
    assert!(matches!(lost.remove_cylinder(), Err(SurfaceError::NoSpacing)));
}
