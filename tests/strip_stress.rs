//! Stresses below strips: those of plane strain for equal rows, of a wave across the flow, of many periods.

use std::f64::consts::{PI, TAU};

use stribeck::elastic::{StressField, stress_extremes, subsurface_stress};
use stribeck::sim::scene::{GridSpec, Load, Roughness, StressSpec};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{Grid, Status};

fn components(field: &StressField, k: usize) -> [f64; 6] {
    [field.xx[k], field.yy[k], field.zz[k], field.xy[k], field.xz[k], field.yz[k]]
}

/// A half-ellipse of pressure and of traction along x, of unit half-width.
fn band(grid: &Grid) -> Vec<f64> {
    grid.nodes().map(|(x, _)| (1.0 - x * x).max(0.0).sqrt()).collect()
}

/// Narrow and wide strips against cells a million lengths wide, whose middle is in plane strain.
#[test]
fn equal_rows_have_the_stresses_of_plane_strain() {
    let line = Grid::from_edges(64, 1, [-2.0, 2.0], [-1e6, 1e6]).unwrap();
    for (rows, width, poisson) in [(8, 0.3, 0.3), (9, 2.0, 0.3), (12, 6.0, 0.0), (6, 1.0, 0.5)] {
        let strip = Grid::strip(64, rows, [-2.0, 2.0], [-0.5 * width, 0.5 * width]).unwrap();
        for depth in [0.0, 0.03, 0.3, 0.8, 2.0] {
            let [plane, found] = [&line, &strip].map(|grid| {
                let loads = band(grid);
                subsurface_stress(grid, poisson, depth, &loads, Some(&loads)).unwrap()
            });
            for k in 0..strip.len() {
                for (c, (a, b)) in
                    components(&found, k).into_iter().zip(components(&plane, k % 64)).enumerate()
                {
                    assert!((a - b).abs() < 1e-6, "{rows} rows, depth {depth}, component {c}: {a} {b}");
                }
            }
        }
    }
}

/// `p cos(k y)` and `q cos(k y)` along x, far from the ends of the loads. Cells flatten the wave by `sin(e)/e`, `e = k dy/2`.
#[test]
fn ridges_along_the_flow_have_the_stresses_of_a_wave() {
    let (nx, ny, poisson) = (96, 64, 0.3);
    let grid = Grid::strip(nx, ny, [-3.0, 3.0], [0.0, 1.0]).unwrap();
    for waves in [1, 2] {
        let wave = TAU * f64::from(waves);
        let load: Vec<f64> = grid.nodes().map(|(_, y)| (wave * y).cos()).collect();
        let half = 0.5 * wave * grid.dy();
        let share = half.sin() / half;
        for depth in [0.05, 0.15, 0.4] {
            let decay = share * (-wave * depth).exp();
            let under = |pressure: f64, traction: f64| {
                let [p, q] = [pressure, traction].map(|f| load.iter().map(|l| f * l).collect::<Vec<_>>());
                subsurface_stress(&grid, poisson, depth, &p, Some(&q)).unwrap()
            };
            let (normal, tangential) = (under(1.0, 0.0), under(0.0, 1.0));
            for j in 0..ny {
                let (k, y, z) = (j * nx + nx / 2, wave * grid.y(j), wave * depth);
                let (zz, yy) = (-(1.0 + z) * decay * y.cos(), -(1.0 - z) * decay * y.cos());
                let exact = [poisson * (yy + zz), yy, zz, 0.0, 0.0, -z * decay * y.sin()];
                let sheared = [0.0, 0.0, 0.0, decay * y.sin(), -decay * y.cos(), 0.0];
                for (c, found) in components(&normal, k).into_iter().enumerate() {
                    // Cells have harmonics of the wave.
                    assert!(
                        (found - exact[c]).abs() < 3e-3,
                        "pressure, {c} at {depth}: {found} {}",
                        exact[c]
                    );
                }
                for (c, found) in components(&tangential, k).into_iter().enumerate() {
                    let error = found.abs() - sheared[c].abs();
                    assert!(error.abs() < 3e-3, "traction, {c} at {depth}: {found} {}", sheared[c]);
                }
            }
        }
    }
}

/// The middle of `2 n + 1` periods on a plain grid. The stresses of the missing periods fall as the inverse square of the
/// distance, their sum as the inverse of `n + 1/2`, which three numbers of periods extrapolate.
#[test]
fn strip_is_the_middle_of_many_periods() {
    let (nx, ny, width) = (12, 6, 1.0);
    let strip = Grid::strip(nx, ny, [-1.0, 1.0], [0.0, width]).unwrap();
    let pressure: Vec<f64> = (0..nx * ny).map(|k| (k * 7 % 11) as f64 / 11.0).collect();
    let traction: Vec<f64> = (0..nx * ny).map(|k| (k * 5 % 7) as f64 / 7.0 - 0.4).collect();
    for (depth, poisson) in [(0.0, 0.5), (0.1, 0.5), (0.4, 0.3), (1.5, 0.3)] {
        let found = subsurface_stress(&strip, poisson, depth, &pressure, Some(&traction)).unwrap();
        let many = [20, 40, 80].map(|n| {
            let periods = 2 * n + 1;
            let wide =
                Grid::from_edges(nx, periods * ny, [-1.0, 1.0], [0.0, width * periods as f64]).unwrap();
            let [p, q] = [&pressure, &traction].map(|load| load.repeat(periods));
            let stress = subsurface_stress(&wide, poisson, depth, &p, Some(&q)).unwrap();
            (0..nx * ny).flat_map(|k| components(&stress, n * nx * ny + k)).collect::<Vec<_>>()
        });
        // Polynomial of second order in the inverse of n + 1/2, at zero.
        let inverse = [20.5, 40.5, 80.5].map(|n: f64| n.recip());
        let weight = |i: usize| {
            (0..3).filter(|j| *j != i).map(|j| inverse[j] / (inverse[j] - inverse[i])).product::<f64>()
        };
        let exact = |k: usize| (0..3).map(|i| weight(i) * many[i][k]).sum::<f64>();
        let found = (0..nx * ny).flat_map(|k| components(&found, k));
        let apart = found.enumerate().fold(0.0_f64, |most, (k, a)| most.max((a - exact(k)).abs()));
        assert!(apart < 1e-5, "{depth}, {poisson}: {apart:e}");
    }
}

/// A roller of 1 GPa.
fn roller() -> Scene {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Cylinder { radius: 5e-3 };
    (scene.load, scene.roughness) = (Load::hertz_pressure(1e9), Default::default());
    (scene.plastic, scene.lubricant, scene.wear) = (None, None, None);
    scene.motion.slide_roll_ratio = 0.0;
    scene.grid = GridSpec::Row { nx: 160, x: [-0.25e-3, 0.25e-3] };
    let stress = scene.stress.insert(StressSpec::default());
    (stress.depths, stress.yield_strength) = (40, Some(1.5e9));
    scene
}

/// Johnson 1985, section 4.2: largest orthogonal shear 0.25 of the pressure, at a depth of 0.5 half-widths.
#[test]
fn smooth_strip_has_the_extremes_of_the_line() {
    let line = roller();
    let mut strip = line.clone();
    strip.grid = GridSpec::Strip { nx: 160, ny: 6, x: [-0.25e-3, 0.25e-3], y: Some([-0.05e-3, 0.05e-3]) };
    let [row, rows] = [line, strip].map(|scene| solve_contact(&scene).unwrap());
    let half_width = row.hertz.half_width_x;
    let [a, b] = [&row, &rows].map(|solution| solution.stress.unwrap());
    for (a, b) in [(a.von_mises, b.von_mises), (a.orthogonal_shear, b.orthogonal_shear)] {
        assert!((a.stress / b.stress - 1.0).abs() < 1e-4, "{a:?} {b:?}");
        assert!((a.depth - b.depth).abs() < 1e-4 * half_width, "{a:?} {b:?}");
    }
    assert!((b.orthogonal_shear.stress / 0.25e9 - 1.0).abs() < 0.01, "{b:?}");
    assert!((b.orthogonal_shear.depth / half_width - 0.5).abs() < 0.02, "{b:?}");
    assert!((a.yield_ratio.unwrap() / b.yield_ratio.unwrap() - 1.0).abs() < 1e-4);
}

/// Roughness raises the stresses near the surface above those of the smooth roller, and the period may begin anywhere.
#[test]
fn rough_strip_is_stressed_wherever_its_period_begins() {
    let mut scene = roller();
    scene.grid = GridSpec::Strip { nx: 128, ny: 40, x: [-0.25e-3, 0.25e-3], y: Some([-0.1e-3, 0.1e-3]) };
    let smooth = solve_contact(&scene).unwrap().stress.unwrap();
    scene.roughness.disc = Roughness::gaussian(80e-9, 25e-6, 1);
    let rough = solve_contact(&scene).unwrap();
    assert_eq!(rough.report.status, Status::Converged);
    assert!(rough.stress.unwrap().von_mises.stress > 1.3 * smooth.von_mises.stress);
    let (grid, depths) = (rough.grid, [0.0, 2e-6, 5e-6, 10e-6, 20e-6, 40e-6]);
    let pressure = &rough.state.pressure;
    let turned: Vec<f64> =
        pressure[7 * grid.nx()..].iter().chain(&pressure[..7 * grid.nx()]).copied().collect();
    let [a, b] =
        [pressure, &turned].map(|p| stress_extremes(&grid, 0.3, &depths, p, None).unwrap().von_mises);
    assert!((a.stress / b.stress - 1.0).abs() < 1e-12, "{a:?} {b:?}");
    let rows = (a.y - b.y) / grid.dy();
    assert!((rows - 7.0).abs() < 1e-6 || (rows + 33.0).abs() < 1e-6, "{rows} rows");
    assert!(a.stress < PI * rough.pressure.max);
}
