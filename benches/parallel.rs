//! Gain of the feature `parallel`: the same work on one and on two threads, five runs of each in turns, as the medians of
//! times and gains. `cargo bench --bench parallel -- contact 1` runs the lines whose names contain `contact`, once.
#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark prints its times and stops at errors"
)]

use std::hint::black_box;
use std::time::Instant;

use stribeck::analytic::HertzPoint;
use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::sim::scene::Roughness;
use stribeck::sim::{Scene, solve_contact};
use stribeck::{Grid, set_num_threads};

/// Seconds of one run, by the clock.
type Run = Box<dyn FnMut() -> f64>;

/// A run on a grid of so many nodes along each axis.
type Work = fn(usize) -> Run;

/// Ten displacements of a half-space on `n` x `n` nodes under a Hertzian pressure.
fn displacement(n: usize) -> Run {
    let hertz = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
    let grid = Grid::from_edges(n, n, [-0.25e-3, 0.25e-3], [-0.25e-3, 0.25e-3]).unwrap();
    let pressure: Vec<f64> = grid.nodes().map(|(x, y)| hertz.pressure_at(x, y)).collect();
    let mut out = vec![0.0; grid.len()];
    Box::new(move || {
        let mut body = HalfSpace::new(grid, 229.67e9).unwrap();
        seconds(|| (0..10).for_each(|_| body.displacement(black_box(&pressure), &mut out).unwrap()))
    })
}

/// A solve of `scene`.
fn contact(scene: Scene) -> Run {
    Box::new(move || seconds(|| drop(black_box(solve_contact(&scene).unwrap()))))
}

/// Dry contact of rough surfaces on `n` x `n` nodes.
fn dry(n: usize) -> Run {
    let mut scene = Scene::azam_2019(n);
    scene.lubricant = None;
    for (roughness, seed) in [(&mut scene.roughness.ball, 1), (&mut scene.roughness.disc, 2)] {
        *roughness = Roughness::gaussian(50e-9, 10e-6, seed);
    }
    contact(scene)
}

/// The scene `rough.toml` on `n` x `n` nodes.
fn rough(n: usize) -> Run {
    let text = include_str!("../examples/scenes/rough.toml");
    let on = |axis: &str| (format!("{axis} = 128"), format!("{axis} = {n}"));
    let ((nx, nx_here), (ny, ny_here)) = (on("nx"), on("ny"));
    contact(Scene::from_toml(&text.replace(&nx, &nx_here).replace(&ny, &ny_here)).unwrap())
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let mut wanted: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with("--")).collect();
    let runs = wanted.last().and_then(|last| last.parse().ok());
    wanted.truncate(wanted.len() - usize::from(runs.is_some()));
    let works: [(&str, Work, usize); 6] = [
        ("10 displacements", displacement, 256),
        ("10 displacements", displacement, 512),
        ("10 displacements", displacement, 1024),
        ("dry contact", dry, 512),
        ("rough reference contact", rough, 256),
        ("rough reference contact", rough, 512),
    ];
    println!("| work | 1 thread, s | 2 threads, s | gain |\n|---|---|---|---|");
    for (name, work, n) in works {
        let name = format!("{name}, {n} x {n}");
        if !wanted.is_empty() && !wanted.iter().any(|part| name.contains(part)) {
            continue;
        }
        let mut run = work(n);
        let (mut times, mut gains) = ([vec![], vec![]], vec![]);
        for _ in 0..runs.unwrap_or(5) {
            let [one, two] = [1, 2].map(|threads| {
                set_num_threads(threads);
                run()
            });
            times[0].push(one);
            times[1].push(two);
            gains.push(one / two);
        }
        let [one, two] = times.map(median);
        println!("| {name} | {one:.3} | {two:.3} | {:.2} |", median(gains));
    }
}
