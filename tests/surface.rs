//! Forms, generated and measured surfaces, files, and motion of the roughness.

use std::io::Write;
use std::path::{Path, PathBuf};

use approx::assert_relative_eq;
use stribeck::metrics::height_statistics;
use stribeck::surface::{
    Advected, AlongTrack, Autocorrelation, FileError, Fixed, Form, FourierShift, Heights, Offset,
    RandomShift, RoughnessMotion, RoughnessSpec, SurfaceError, generate, read, write_npy,
};
use stribeck::{Grid, InputError};

// ---------------------------------------------------------------- form

#[test]
fn forms_are_parabolas_about_the_origin() {
    let grid = Grid::from_edges(7, 5, [-3e-4, 4e-4], [-2e-4, 3e-4]).unwrap();
    let mut gap = vec![f64::NAN; grid.len()];
    let form = Form::Ellipsoid { radius_x: 20e-3, radius_y: 10e-3, angle: 0.0 };
    form.gap_into(&grid, &mut gap).unwrap();
    for (h, (x, y)) in gap.iter().zip(grid.nodes()) {
        assert_relative_eq!(*h, x * x / 40e-3 + y * y / 20e-3, max_relative = 1e-14);
    }
    assert_eq!(Form::Sphere { radius: 3.0 }.radii(), (3.0, 3.0));
    let error = Form::Sphere { radius: -1.0 }.gap_into(&grid, &mut gap).unwrap_err();
    assert!(error.to_string().contains("form.radius"), "{error}");
    assert!(form.gap_into(&grid, &mut gap[1..]).is_err());
    assert!(Form::Ellipsoid { radius_x: 1.0, radius_y: f64::NAN, angle: 0.0 }.validate().is_err());
}

// ---------------------------------------------------------------- generation

fn spec(autocorrelation: Autocorrelation, length_x: f64, length_y: f64, seed: u64) -> RoughnessSpec {
    RoughnessSpec { autocorrelation, rq: 130e-9, length_x, length_y, seed }
}

/// Normalised periodic autocorrelation at a lag of `(di, dj)` nodes.
fn correlation(heights: &[f64], grid: &Grid, di: usize, dj: usize) -> f64 {
    let (nx, ny) = (grid.nx(), grid.ny());
    let (mut product, mut square) = (0.0, 0.0);
    for j in 0..ny {
        for i in 0..nx {
            let z = heights[j * nx + i];
            product += z * heights[(j + dj) % ny * nx + (i + di) % nx];
            square += z * z;
        }
    }
    product / square
}

#[test]
fn generated_surfaces_have_the_requested_autocorrelation() {
    let grid = Grid::centred(512, 480, 1e-6, 1e-6).unwrap();
    for (kind, middle) in
        [(Autocorrelation::Gaussian, 10f64.powf(-0.25)), (Autocorrelation::Exponential, 10f64.powf(-0.5))]
    {
        let (mut at_x, mut at_y, mut at_half) = (0.0, 0.0, 0.0);
        for seed in 0..4 {
            let heights = generate(&grid, &spec(kind, 10e-6, 6e-6, seed)).unwrap();
            at_x += correlation(&heights, &grid, 10, 0) / 4.0;
            at_y += correlation(&heights, &grid, 0, 6) / 4.0;
            at_half += correlation(&heights, &grid, 5, 0) / 4.0;
            let single = correlation(&heights, &grid, 10, 0);
            assert!((single - 0.1).abs() < 0.03, "{kind:?} seed {seed}: {single}");
        }
        assert!((at_x - 0.1).abs() < 0.015 && (at_y - 0.1).abs() < 0.015, "{kind:?} {at_x} {at_y}");
        assert!((at_half - middle).abs() < 0.02, "{kind:?} {at_half} instead of {middle}");
    }
}

#[test]
fn generated_surfaces_have_exact_height_and_normal_distribution() {
    for (nx, ny) in [(512, 512), (251, 340)] {
        let grid = Grid::centred(nx, ny, 1e-6, 1.5e-6).unwrap();
        for kind in [Autocorrelation::Gaussian, Autocorrelation::Exponential] {
            let heights = generate(&grid, &spec(kind, 10e-6, 10e-6, 7)).unwrap();
            let statistics = height_statistics(&heights).unwrap();
            assert_relative_eq!(statistics.sq, 130e-9, max_relative = 1e-12);
            assert!(statistics.mean.abs() < 1e-12 * 130e-9);
            // some 5000 independent patches: standard errors 0.035 and 0.07
            assert!(statistics.ssk.abs() < 0.15, "{}", statistics.ssk);
            assert!((statistics.sku - 3.0).abs() < 0.3, "{}", statistics.sku);
        }
    }
}

#[test]
fn a_seed_pins_the_surface() {
    let grid = Grid::centred(64, 48, 4e-6, 4e-6).unwrap();
    let heights = generate(&grid, &spec(Autocorrelation::Gaussian, 20e-6, 20e-6, 42)).unwrap();
    // recorded from the first version of the generator, which had other transforms
    let recorded = [
        (0, -1.317_904_814_815_66e-7),
        (1, -1.304_539_742_834_627_5e-7),
        (64, -1.194_414_510_277_255_4e-7),
        (1000, 4.721_220_856_157_662e-8),
        (3071, -5.996_337_334_655_508e-8),
    ];
    for (k, value) in recorded {
        assert_relative_eq!(heights[k], value, epsilon = 5e-8 * 130e-9);
    }
    assert_eq!(heights, generate(&grid, &spec(Autocorrelation::Gaussian, 20e-6, 20e-6, 42)).unwrap());
    assert_ne!(heights, generate(&grid, &spec(Autocorrelation::Gaussian, 20e-6, 20e-6, 43)).unwrap());
}

#[test]
fn opposite_edges_fit_together() {
    let grid = Grid::centred(96, 96, 1e-6, 1e-6).unwrap();
    let heights = generate(&grid, &spec(Autocorrelation::Gaussian, 30e-6, 30e-6, 1)).unwrap();
    let largest = |a: usize, b: usize| {
        (0..96).map(|j| (heights[j * 96 + a] - heights[j * 96 + b]).abs()).fold(0.0, f64::max)
    };
    // steps across the seam are of the size of steps elsewhere
    assert!(largest(95, 0) < 2.0 * largest(40, 41).max(largest(60, 61)), "{}", largest(95, 0));
}

#[test]
fn extreme_and_bad_specifications() {
    let grid = Grid::centred(32, 32, 1e-6, 1e-6).unwrap();
    let white = generate(&grid, &spec(Autocorrelation::Gaussian, 1e-12, 1e-12, 5)).unwrap();
    assert!(correlation(&white, &grid, 1, 0).abs() < 0.15);
    let longest = generate(&grid, &spec(Autocorrelation::Exponential, 32e-6, 32e-6, 5)).unwrap();
    assert_relative_eq!(height_statistics(&longest).unwrap().sq, 130e-9, max_relative = 1e-12);
    let smooth = RoughnessSpec { rq: 0.0, ..spec(Autocorrelation::Gaussian, 1e-6, 1e-6, 5) };
    assert_eq!(generate(&grid, &smooth).unwrap(), vec![0.0; 1024]);
    let bad = [
        ("roughness.rq", RoughnessSpec { rq: -1e-9, ..smooth }),
        ("roughness.rq", RoughnessSpec { rq: f64::NAN, ..smooth }),
        ("roughness.length_x", RoughnessSpec { length_x: 0.0, ..smooth }),
        ("roughness.length_x", RoughnessSpec { length_x: 33e-6, ..smooth }),
        ("roughness.length_y", RoughnessSpec { length_y: f64::INFINITY, ..smooth }),
    ];
    for (field, spec) in bad {
        let error = generate(&grid, &spec).unwrap_err().to_string();
        assert!(error.starts_with(field), "{error}");
    }
    let single = Grid::centred(1, 1, 1e-6, 1e-6).unwrap();
    assert!(generate(&single, &spec(Autocorrelation::Gaussian, 1e-6, 1e-6, 5)).is_err());
}

// ---------------------------------------------------------------- motion

#[test]
fn shifts_depend_on_seed_body_and_step_and_fill_the_grid() {
    let shift = |seed, body, step, nx, ny| {
        let grid = Grid::centred(nx, ny, 1e-6, 1e-6).unwrap();
        let offset = RandomShift { seed }.offset(body, step, 1.0, 0.1, &grid);
        assert!(offset.fraction.abs() < f64::EPSILON);
        (offset.columns, offset.rows)
    };
    assert_eq!(shift(11, 0, 5, 128, 96), shift(11, 0, 5, 128, 96));
    let mut seen = std::collections::HashSet::new();
    let (mut sum_x, mut sum_y) = (0, 0);
    for body in 0..2 {
        for step in 0..1000 {
            let (sx, sy) = shift(11, body, step, 128, 96);
            assert!(sx < 128 && sy < 96);
            seen.insert((sx, sy));
            sum_x += sx;
            sum_y += sy;
        }
    }
    assert!(seen.len() > 1700, "{} different shifts of 2000", seen.len());
    assert!((sum_x as f64 / 2000.0 - 63.5).abs() < 4.0 && (sum_y as f64 / 2000.0 - 47.5).abs() < 3.0);
    assert_ne!(shift(11, 0, 5, 8192, 8192), shift(11, 1, 5, 8192, 8192));
    assert_ne!(shift(11, 0, 5, 8192, 8192), shift(12, 0, 5, 8192, 8192));
    // recorded: a resumed run must repeat it
    assert_eq!(shift(11, 1, 77, 1000, 1000), (669, 628));
}

#[test]
fn places_along_the_track_are_even_for_each_body_and_of_one_on_the_other() {
    let grid = Grid::centred(128, 96, 1e-6, 1e-6).unwrap();
    for seed in [0, 5, u64::MAX] {
        let column = |body, draw| AlongTrack { seed }.offset(body, draw, 7.0, 0.1, &grid).columns;
        let even = |places: Vec<usize>| {
            for eighth in 0..8 {
                let count = places.iter().filter(|place| **place / 16 == eighth).count();
                assert!((count as i64 - 90).abs() <= 3, "{count} of 720 places in eighth {eighth}");
            }
        };
        for body in [0, 1] {
            even((1..721).map(|draw| column(body, draw)).collect());
        }
        even((1..721).map(|draw| (column(0, draw) + 128 - column(1, draw)) % 128).collect());
    }
    let motion = AlongTrack { seed: 5 };
    assert_eq!(motion.offset(0, 0, 7.0, 0.1, &grid), Offset::default());
    // At rest relative to the contact.
    assert_eq!(motion.offset(0, 9, 7.0, 0.0, &grid), Offset::default());
    assert_eq!(Fixed.offset(0, 9, 7.0, 0.1, &grid), Offset::default());
    assert_ne!(motion.offset(0, 9, 7.0, 0.1, &grid), AlongTrack { seed: 6 }.offset(0, 9, 7.0, 0.1, &grid));
}

#[test]
fn a_carried_pattern_moves_with_its_body_and_comes_round() {
    let grid = Grid::centred(64, 5, 2e-6, 1e-6).unwrap();
    let at = |time, speed| Advected.offset(0, 9, time, speed, &grid);
    assert_eq!(at(0.0, 0.1), Offset::default());
    // 1.5 cells downstream: column 0 of the grid has the heights 1.5 columns upstream.
    let offset = at(3e-6, 1.0);
    assert_eq!((offset.columns, offset.rows), (62, 0));
    assert!((offset.fraction - 0.5).abs() < 1e-9);
    let backwards = at(3e-6, -1.0);
    assert_eq!(backwards.columns, 1);
    assert!((backwards.fraction - 0.5).abs() < 1e-9);
    let round = at(64.0 * 2e-6, 1.0);
    assert!(round.fraction < 1e-9 || round.fraction > 1.0 - 1e-9, "{round:?}");
    assert_eq!(at(f64::NAN, 1.0), Offset::default());
}

#[test]
fn shifts_by_parts_of_a_cell_keep_what_they_must() {
    for nx in [15, 16] {
        let ny = 3;
        // Two waves that the grid resolves in each row.
        let wave = |x: f64, j: usize| {
            let turn = std::f64::consts::TAU * x / nx as f64;
            (3.0 * turn).sin() + 0.3 * (5.0 * turn + j as f64).cos() + j as f64
        };
        let field: Vec<f64> = (0..nx * ny).map(|k| wave((k % nx) as f64, k / nx)).collect();
        let mut fourier = FourierShift::new(nx);
        let offset = Offset { columns: 4, rows: 1, fraction: 0.3 };
        let (mut seen, mut back) = (vec![0.0; nx * ny], vec![0.0; nx * ny]);
        fourier.apply(&field, ny, offset, &mut seen).unwrap();
        for (k, value) in seen.iter().enumerate() {
            let expected = wave((k % nx) as f64 + 4.3, (k / nx + 1) % ny);
            assert!((value - expected).abs() < 1e-12, "{nx}: {value} {expected}");
        }
        let inverse = Offset { columns: nx - 5, rows: ny - 1, fraction: 0.7 };
        fourier.apply(&seen, ny, inverse, &mut back).unwrap();
        assert!(field.iter().zip(&back).all(|(a, b)| (a - b).abs() < 1e-12));
        for fraction in [-0.1, 1.1, f64::NAN] {
            let offset = Offset { fraction, ..offset };
            assert!(fourier.apply(&field, ny, offset, &mut seen).is_err());
        }
        assert!(fourier.apply(&field[1..], ny, offset, &mut seen).is_err());
    }
}

// ---------------------------------------------------------------- measured surfaces

/// A smooth test surface with points of `d` metres.
fn waves(nx: usize, ny: usize, d: f64) -> Heights {
    let heights = (0..nx * ny)
        .map(|k| {
            let (x, y) = ((k % nx) as f64 * d, (k / nx) as f64 * d);
            1e-7 * (x / 3e-6).sin() * (y / 4e-6).cos()
        })
        .collect();
    Heights::new(nx, ny, Some([d, d]), heights, None).unwrap()
}

#[test]
fn holes_are_filled_with_what_surrounds_them() {
    let plane: Vec<f64> =
        (0..20 * 15).map(|k| 1e-8 * f64::from(k % 20) - 2e-8 * f64::from(k / 20) + 3e-6).collect();
    let mut mask = vec![true; 300];
    for (i, j) in [(5, 5), (6, 5), (7, 5), (6, 6), (6, 7), (12, 9), (13, 9), (12, 10), (13, 10)] {
        mask[j * 20 + i] = false;
    }
    let mut damaged = plane.clone();
    damaged[6 * 20 + 6] = f64::NAN;
    damaged[5 * 20 + 5] = 1e30;
    let mut surface = Heights::new(20, 15, Some([1e-6, 1e-6]), damaged, Some(mask)).unwrap();
    assert_eq!((surface.undefined(), surface.heights()[106].is_finite()), (9, true));
    assert!(matches!(
        surface.resample(&Grid::centred(5, 5, 1e-6, 1e-6).unwrap()),
        Err(SurfaceError::Undefined { points: 9 })
    ));
    surface.fill_undefined().unwrap();
    assert_eq!((surface.undefined(), surface.defined()), (0, None));
    for (found, expected) in surface.heights().iter().zip(&plane) {
        assert_relative_eq!(*found, *expected, epsilon = 1e-15);
    }
    let mut nothing = Heights::new(3, 2, None, vec![0.0; 6], Some(vec![false; 6])).unwrap();
    assert!(matches!(nothing.fill_undefined(), Err(SurfaceError::AllUndefined { points: 6 })));
    assert!(matches!(nothing.remove_plane(), Err(SurfaceError::AllUndefined { points: 6 })));
}

#[test]
fn the_plane_of_least_squares_is_removed() {
    // bumps that correlate with no plane, a tilt, an offset of a metre, and wild undefined points
    let (nx, ny) = (40, 30);
    let bump = |k: usize| if (k % nx + k / nx).is_multiple_of(2) { 1e-7 } else { -1e-7 };
    let tilted: Vec<f64> =
        (0..nx * ny).map(|k| 1e-3 + 1e-6 * (k % nx) as f64 + 3e-6 * (k / nx) as f64 + bump(k)).collect();
    let mut surface = Heights::new(nx, ny, None, tilted.clone(), None).unwrap();
    surface.remove_plane().unwrap();
    for (k, z) in surface.heights().iter().enumerate() {
        assert_relative_eq!(*z, bump(k), epsilon = 2e-9);
    }
    let mut mask = vec![true; nx * ny];
    (0..nx * ny).filter(|k| k % 7 == 3).for_each(|k| mask[k] = false);
    let mut surface = Heights::new(nx, ny, None, tilted, Some(mask)).unwrap();
    surface.remove_plane().unwrap();
    assert!(surface.heights().iter().all(|z| z.abs() < 1.1e-7));
    // a single row leaves the slope across it open
    let mut row = Heights::new(5, 1, None, vec![0.0, 1.0, 2.0, 3.0, 4.0], None).unwrap();
    row.remove_plane().unwrap();
    assert!(row.heights().iter().all(|z| z.abs() < 1e-14));
    let mut huge = Heights::new(2, 2, None, vec![f64::MAX; 4], None).unwrap();
    let _ = huge.remove_plane();
}

#[test]
fn resampling_averages_or_interpolates_a_centred_window() {
    let surface = waves(200, 160, 0.25e-6);
    // the middle of the surface is the middle of the grid
    let value =
        |x: f64, y: f64| 1e-7 * ((x + 25e-6 - 0.125e-6) / 3e-6).sin() * ((y + 20e-6 - 0.125e-6) / 4e-6).cos();
    for (n, d, tolerance) in
        [(30, 1e-6, 2e-9), (380, 0.1e-6, 3e-10), (120, 0.25e-6, 1e-20), (97, 0.31e-6, 1e-9)]
    {
        let grid = Grid::centred(n, n, d, d).unwrap();
        let heights = surface.resample(&grid).unwrap();
        for (z, (x, y)) in heights.iter().zip(grid.nodes()) {
            assert_relative_eq!(*z, value(x, y), epsilon = tolerance);
        }
    }
    let error = surface.resample(&Grid::centred(51, 10, 1e-6, 1e-6).unwrap()).unwrap_err().to_string();
    assert!(error.contains("5.000e-5 m x 4.000e-5 m") && error.contains("5.100e-5 m"), "{error}");
    // averages keep the mean exactly
    let grid = Grid::centred(7, 9, 50e-6 / 7.0, 40e-6 / 9.0).unwrap();
    let average = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    assert_relative_eq!(
        average(&surface.resample(&grid).unwrap()),
        average(surface.heights()),
        epsilon = 1e-21
    );
}

#[test]
fn mirrored_tiles_are_continuous_and_periodic() {
    let surface = waves(83, 204, 1e-6);
    for (n, d) in [(128, 0.5e-3 / 128.0), (500, 1e-6), (777, 0.5e-3 / 777.0)] {
        let grid = Grid::centred(n, n, d, d).unwrap();
        let heights = surface.resample_mirrored(&grid).unwrap();
        // x: 8 windows of 62.5 um, y: 4 of 125 um; slope of the waves at most 1e-7/3e-6
        let bound = 1.05 * d * 1e-7 / 3e-6 + 1e-12;
        for j in 0..n {
            for i in 0..n {
                let z = heights[j * n + i];
                assert!((heights[j * n + (i + 1) % n] - z).abs() < bound);
                assert!((heights[(j + 1) % n * n + i] - z).abs() < bound);
                assert_relative_eq!(heights[j * n + (n - 1 - i)], z, epsilon = 1e-18);
            }
        }
    }
    // a grid that the surface would cover is still periodic
    let grid = Grid::centred(60, 60, 1e-6, 1e-6).unwrap();
    let heights = surface.resample_mirrored(&grid).unwrap();
    assert_relative_eq!(heights[0], heights[59], epsilon = 1e-18);
    let tiny = Heights::new(1, 1, Some([1e-12, 1e-12]), vec![0.0], None).unwrap();
    assert!(matches!(tiny.resample_mirrored(&grid), Err(SurfaceError::Input(InputError::Conflict { .. }))));
    assert!(matches!(
        Heights::new(1, 1, None, vec![0.0], None).unwrap().resample(&grid),
        Err(SurfaceError::NoSpacing)
    ));
}

#[test]
fn fitting_levels_fills_tiles_and_centres() {
    let source = waves(200, 100, 0.5e-6);
    let mut mask = vec![true; 20_000];
    (0..200).for_each(|k| mask[37 * k % 20_000] = false);
    let tilted =
        source.heights().iter().enumerate().map(|(k, z)| 1e-3 + z + 1e-8 * (k % 200) as f64).collect();
    let measured =
        Heights::new(200, 100, None, tilted, Some(mask)).unwrap().with_spacing(0.5e-6, 0.5e-6).unwrap();
    let grid = Grid::centred(256, 256, 0.5e-3 / 256.0, 0.5e-3 / 256.0).unwrap();
    let heights = measured.fit_to_grid(&grid).unwrap();
    let statistics = height_statistics(&heights).unwrap();
    assert!(statistics.mean.abs() < 1e-18);
    let expected = height_statistics(source.heights()).unwrap().sq;
    assert!((statistics.sq / expected - 1.0).abs() < 0.2, "{} {expected}", statistics.sq);
}

#[test]
fn heights_check_their_shape() {
    assert!(Heights::new(0, 3, None, vec![], None).is_err());
    assert!(Heights::new(2, 2, None, vec![0.0; 3], None).is_err());
    assert!(Heights::new(2, 2, None, vec![0.0; 4], Some(vec![true; 3])).is_err());
    assert!(Heights::new(2, 2, Some([1e-6, 0.0]), vec![0.0; 4], None).is_err());
    assert!(Heights::new(2, 1, None, vec![0.0, f64::NAN], None).is_err());
    assert!(Heights::new(usize::MAX, 2, None, vec![], None).is_err());
    let surface = waves(5, 4, 1e-6);
    let cropped = surface.crop_to(3, 2).unwrap();
    assert_eq!(cropped.heights()[..3], surface.heights()[6..9]);
    assert!(surface.crop_to(6, 2).is_err() && surface.crop_to(0, 2).is_err());
    assert!(surface.with_spacing(-1.0, 1.0).is_err());
}

// ---------------------------------------------------------------- files

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, content: &[u8]) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }
}

fn npy(header: &str, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&(header.len() as u16).to_le_bytes());
    bytes.extend_from_slice(header.as_bytes());
    bytes.extend_from_slice(data);
    bytes
}

fn header(descr: &str, fortran: bool, shape: &str) -> String {
    let order = if fortran { "True" } else { "False" };
    format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n")
}

#[test]
fn npy_files_come_back_as_written() {
    let folder = Folder::new();
    let path = folder.0.path().join("a.npy");
    let field: Vec<f64> = (0..12).map(|k| f64::from(k) * 1e-9 - 5e-9).collect();
    write_npy(&path, 4, 3, &field).unwrap();
    let heights = read(&path).unwrap();
    assert_eq!((heights.nx(), heights.ny(), heights.dx(), heights.undefined()), (4, 3, None, 0));
    assert_eq!(heights.heights(), field);
    assert!(write_npy(&path, 5, 3, &field).is_err());
    let nowhere = folder.0.path().join("missing/a.npy");
    assert!(matches!(
        write_npy(&nowhere, 4, 3, &field),
        Err(SurfaceError::File { error: FileError::Io { .. } })
    ));
}

#[test]
fn npy_types_and_orders_are_understood() {
    let folder = Folder::new();
    let expected = [1.0, -2.0, 3.0, 4.0, 5.0, 6.0];
    let cases: [(&str, Vec<u8>); 7] = [
        ("<f4", expected.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect()),
        (">f8", expected.iter().flat_map(|v: &f64| v.to_be_bytes()).collect()),
        ("<i2", expected.iter().flat_map(|v| (*v as i16).to_le_bytes()).collect()),
        (">i4", expected.iter().flat_map(|v| (*v as i32).to_be_bytes()).collect()),
        ("|i1", expected.iter().flat_map(|v| (*v as i8).to_le_bytes()).collect()),
        ("<i8", expected.iter().flat_map(|v| (*v as i64).to_le_bytes()).collect()),
        // binary16 of the same numbers
        (
            "<f2",
            [0x3c00_u16, 0xc000, 0x4200, 0x4400, 0x4500, 0x4600]
                .iter()
                .flat_map(|v| v.to_le_bytes())
                .collect(),
        ),
    ];
    for (descr, data) in cases {
        let path = folder.write("b.npy", &npy(&header(descr, false, "(2, 3)"), &data));
        let heights = read(&path).unwrap();
        assert_eq!((heights.nx(), heights.ny()), (3, 2));
        assert_eq!(heights.heights(), expected, "{descr}");
        // the same bytes in Fortran order: the first index, y, runs fastest
        let path = folder.write("c.npy", &npy(&header(descr, true, "(2, 3)"), &data));
        assert_eq!(read(&path).unwrap().heights(), [1.0, 3.0, 5.0, -2.0, 4.0, 6.0], "{descr}");
    }
    let path = folder.write("d.npy", &npy(&header("|u1", false, "(1, 2)"), &[0, 255]));
    assert_eq!(read(&path).unwrap().heights(), [0.0, 255.0]);
    let path = folder.write("e.npy", &npy(&header("|u1", true, "(3,)"), &[1, 2, 3]));
    let profile = read(&path).unwrap();
    assert_eq!((profile.nx(), profile.ny(), profile.heights()), (3, 1, [1.0, 2.0, 3.0].as_slice()));
}

#[test]
fn damaged_npy_files_are_refused_by_name() {
    let folder = Folder::new();
    let nan: Vec<u8> = [1.0, 2.0, 3.0, f64::NAN].iter().flat_map(|v: &f64| v.to_le_bytes()).collect();
    let long = format!("{}{}", header("<f8", false, "(1, 1)"), " ".repeat(60_000));
    let nested = format!("{{'descr': {}", "[".repeat(60_000));
    let cases = [
        (npy(&header("<f8", false, "(2, 3)"), &nan), "needs 48 bytes of data, found 32"),
        (npy(&header("<f8", false, "(1, 3)"), &nan), "found more"),
        (npy(&header("<f8", false, "(4294967296, 4294967296)"), &nan), "at most 2^26"),
        (npy(&header("<f8", false, "(0, 4)"), &nan), "at least 1"),
        (npy(&header("<f8", false, "(2, 2, 1)"), &nan), "shape (2, 2, 1)"),
        (npy(&header("<f8", false, "()"), &nan), "shape ()"),
        (npy(&header("<f8", false, "(99999999999999999999999, 1)"), &nan), "shape"),
        (npy(&header("<c16", false, "(2, 1)"), &nan), "not supported"),
        (npy(&header("<f16", false, "(2, 1)"), &nan), "not supported"),
        (npy(&header("|O", false, "(2, 1)"), &nan), "not supported"),
        (npy("", &nan), "descr"),
        (npy(&nested, &nan), "not supported"),
        (npy(&long, &nan[..7]), "found 7"),
        (b"\x93NUMPY".to_vec(), "magic"),
        (b"\x93NUMPY\x09\x00\x00\x00".to_vec(), "version 9"),
        (b"\x93NUMPY\x02\x00\xff\xff\xff\xff".to_vec(), "header of 4294967295 bytes"),
        (b"\x93NUMPY\x01\x00\xff\x00{'descr'".to_vec(), "the header needs 255 bytes"),
        (b"P5 something else".to_vec(), "neither"),
        (Vec::new(), "neither"),
    ];
    for (content, expected) in cases {
        let path = folder.write("broken.npy", &content);
        let error = read(&path).unwrap_err().to_string();
        assert!(error.contains(expected) && error.contains("broken.npy"), "{expected}: {error}");
    }
    assert!(matches!(
        read(folder.0.path().join("none.npy")),
        Err(SurfaceError::File { error: FileError::Io { .. } })
    ));
    assert!(read(folder.0.path()).is_err());
}

/// `main.xml` of a surface of 3 x 2 points, 1 um by 2 um apart.
fn main_xml(data_type: &str, cz: &str, record3: &str) -> String {
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
  <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>
    <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>1e-6</Increment><Offset>0</Offset></CX>
    <CY><AxisType>I</AxisType><DataType>D</DataType><Increment> 2e-6 </Increment><Offset>0</Offset></CY>
    <CZ><AxisType>A</AxisType><DataType>{data_type}</DataType>{cz}</CZ>
  </Axes></Record1>
  <Record3><MatrixDimension><SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>{record3}</Record3>
</p:ISO5436_2>"#
    )
}

const LINK: &str = "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink>";

fn x3p(xml: &str, data: &[u8]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    for (name, content) in [("main.xml", xml.as_bytes()), ("bindata/data.bin", data)] {
        writer.start_file(name, options).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn read_x3p(folder: &Folder, xml: &str, data: &[u8]) -> Result<Heights, SurfaceError> {
    read(folder.write("surface.x3p", &x3p(xml, data)))
}

#[test]
fn x3p_files_of_every_type_are_read() {
    let folder = Folder::new();
    let metres = [1e-6, 2e-6, -3e-6, 4e-6, 5e-6, 6e-6];
    let double: Vec<u8> = metres.iter().flat_map(|v: &f64| v.to_le_bytes()).collect();
    let heights = read_x3p(&folder, &main_xml("D", "", LINK), &double).unwrap();
    assert_eq!((heights.nx(), heights.ny(), heights.undefined()), (3, 2, 0));
    assert_eq!((heights.dx(), heights.dy()), (Some(1e-6), Some(2e-6)));
    assert_eq!(heights.heights(), metres);
    let single: Vec<u8> = metres.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect();
    let heights = read_x3p(&folder, &main_xml("F", "", LINK), &single).unwrap();
    assert_relative_eq!(heights.heights()[2], -3e-6, max_relative = 1e-7);
    let scaled = "<Increment>1e-9</Increment><Offset>1e-3</Offset>";
    let short: Vec<u8> =
        [1000_i16, 2000, -3000, 4000, 5000, 6000].iter().flat_map(|v| v.to_le_bytes()).collect();
    let long: Vec<u8> =
        [1000_i32, 2000, -3000, 4000, 5000, 6000].iter().flat_map(|v| v.to_le_bytes()).collect();
    for (name, data) in [("I", short), ("L", long)] {
        let heights = read_x3p(&folder, &main_xml(name, scaled, LINK), &data).unwrap();
        for (found, expected) in heights.heights().iter().zip(metres) {
            assert_relative_eq!(*found, 1e-3 + expected, epsilon = 1e-18);
        }
    }
}

#[test]
fn x3p_profiles_are_surfaces_of_one_row() {
    let folder = Folder::new();
    let data: Vec<u8> = [1e-6, 2e-6, -3e-6].iter().flat_map(|v: &f64| v.to_le_bytes()).collect();
    let row = main_xml("D", "<Increment/>", LINK).replace("<SizeY>2", "<SizeY>1");
    let found = read_x3p(&folder, &row, &data).unwrap();
    assert_eq!((found.nx(), found.ny(), found.dx(), found.dy()), (3, 1, Some(1e-6), Some(2e-6)));
    let start = row.find("<CY>").unwrap();
    let end = row.find("</CY>").unwrap();
    let axis = "<CY><AxisType>A</AxisType>";
    let profile = format!("{}{axis}{}", &row[..start], &row[end..]).replace("SUR", "PRF");
    let found = read_x3p(&folder, &profile, &data).unwrap();
    assert_eq!((found.nx(), found.ny(), found.dx(), found.dy()), (3, 1, Some(1e-6), Some(1e-6)));
    assert_eq!(found.heights(), [1e-6, 2e-6, -3e-6]);
}

#[test]
fn x3p_undefined_points_and_lists_are_understood() {
    let folder = Folder::new();
    let data: Vec<u8> =
        [1e-6, f64::NAN, -3e-6, 4e-6, 5e-6, 6e-6].iter().flat_map(|v: &f64| v.to_le_bytes()).collect();
    let mut heights = read_x3p(&folder, &main_xml("D", "", LINK), &data).unwrap();
    assert_eq!((heights.undefined(), heights.defined().unwrap()[1]), (1, false));
    heights.fill_undefined().unwrap();
    assert_relative_eq!(heights.heights()[1], 1e-6, max_relative = 1e-12); // mean of 1, -3 and 5
    let list = "<DataList><Datum>1e-6</Datum><Datum>0;0;2e-6</Datum><Datum/><Datum>4</Datum><Datum>5</Datum><Datum>6</Datum></DataList>";
    let heights = read_x3p(&folder, &main_xml("D", "", list), &[]).unwrap();
    assert_eq!(heights.heights(), [1e-6, 2e-6, 0.0, 4.0, 5.0, 6.0]);
    assert_eq!(heights.undefined(), 1);
}

#[test]
fn damaged_x3p_files_are_refused_by_name() {
    let folder = Folder::new();
    let data = [0_u8; 48];
    let good = main_xml("D", "", LINK);
    let deep = format!("{}{}", "<a>".repeat(200_000), "</a>".repeat(200_000));
    let cases: Vec<(String, &[u8], &str)> = vec![
        (good.clone(), &data[..40], "40 bytes, 3 x 2 x 1 points need 48"),
        (good.clone(), &[0; 49], "more than the expected 48"),
        (good.replace(">3<", ">99999999<").replace(">2<", ">99999999<"), &data, "at most 2^26"),
        (good.replace(">3<", ">-3<"), &data, "SizeX is not a count: -3"),
        (good.replace(">3<", ">0<"), &data, "at least 1"),
        (good.replace(">1e-6<", ">zero<"), &data, "CX/Increment"),
        (good.replace(">1e-6<", ">-1e-6<"), &data, "dx = -0.000001"),
        (good.replace(">D</DataType></CZ>", ">Q</DataType></CZ>"), &data, "heights of type Q"),
        (good.replace("data.bin", "other.bin"), &data, "other.bin"),
        (good.replace("SUR", "PCL"), &data, "feature type PCL"),
        (good.replace("SUR", "PRF"), &data, "a profile of 2 rows"),
        (good.replace("<SizeZ>1", "<SizeZ>2"), &data, "2 surfaces"),
        (good.replace("</DataLink>", "<ValidPointsLink>v</ValidPointsLink></DataLink>"), &data, "part v"),
        (good.replace(LINK, ""), &data, "PointDataLink"),
        (good.replace(LINK, "<DataList><Datum>1</Datum></DataList>"), &data, "1 heights instead of 6"),
        (good.replace(LINK, "<DataList><Datum>x</Datum></DataList>"), &data, "datum 0"),
        (good.replace("<AxisType>I", "<AxisType>A"), &data, "type A"),
        ("<p>".to_owned(), &data, "main.xml"),
        (String::new(), &data, "main.xml"),
        (deep, &data, "main.xml"),
    ];
    for (xml, data, expected) in cases {
        let error = read_x3p(&folder, &xml, data).unwrap_err().to_string();
        assert!(error.contains(expected) && error.contains("surface.x3p"), "{expected}: {error}");
    }
}

/// Reads without panicking; a file that still reads must hold 3 x 2 sound heights.
fn survives(path: &Path) {
    if let Ok(heights) = read(path) {
        assert!(heights.heights().iter().all(|h| h.is_finite()));
    }
}

#[test]
fn no_truncation_or_flipped_byte_makes_the_reader_panic() {
    let folder = Folder::new();
    let data: Vec<u8> = [1e-6_f64; 6].iter().flat_map(|v| v.to_le_bytes()).collect();
    for bytes in [x3p(&main_xml("D", "", LINK), &data), npy(&header("<f8", false, "(2, 3)"), &data)] {
        for length in 0..bytes.len() {
            survives(&folder.write("cut", &bytes[..length]));
            let mut flipped = bytes.clone();
            flipped[length] ^= 1 << (length % 8);
            survives(&folder.write("flipped", &flipped));
        }
    }
}
