//! exploration
#![expect(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
use std::time::Instant;
use stribeck::analytic::HertzPoint;
use stribeck::elastic::{DryProblem, DrySolver, DeformationModel, HalfSpace};
use stribeck::reynolds::{ContactSolver, ContactState, Dry, LubricatedContact, Scheme, StoppingRule};
use stribeck::surface::{Autocorrelation, Form, RoughnessSpec, generate};
use stribeck::Grid;

fn run(n: usize, rq: f64, seed: u64, limit: Option<f64>, tol: f64) {
    let hz = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
    let g = Grid::from_edges(n, n, [-0.25e-3, 0.25e-3], [-0.25e-3, 0.25e-3]).unwrap();
    let mut gap = vec![0.0; g.len()];
    Form::Sphere { radius: 9.525e-3 }.gap_into(&g, &mut gap).unwrap();
    if rq > 0.0 {
        let z = generate(&g, &RoughnessSpec { autocorrelation: Autocorrelation::Gaussian, rq, length_x: 10e-6, length_y: 10e-6, seed }).unwrap();
        for (a, z) in gap.iter_mut().zip(&z) { *a -= z; }
    }
    let lim = limit.map(|l| vec![l; g.len()]);
    let mut hs = HalfSpace::new(g, 229.67e9).unwrap();
    let mut pb = LubricatedContact { gap: &gap, deformation: &mut hs, lubricant: None, entrainment_speed: 0.0, squeeze: None, load: hz.load, pressure_limit: lim.as_deref(), film_cutoff: 1e-9, scheme: Scheme::FirstOrder, reference_half_widths: (hz.a_x, hz.a_y), reference_pressure: hz.p_max };
    let mut st = ContactState::new(&g);
    let mut s = Dry::new();
    let stop = StoppingRule { tolerance: tol, max_iterations: 2000 };
    let t = Instant::now();
    let r = s.solve(&mut pb, &mut st, &stop).unwrap();
    let dt = t.elapsed().as_secs_f64();
    let r2 = s.solve(&mut pb, &mut st, &stop).unwrap();
    let pmax = st.pressure.iter().copied().fold(0.0, f64::max);
    let nc = st.pressure.iter().filter(|&&p| p > 0.0).count();
    let a = (nc as f64 * g.cell_area() / std::f64::consts::PI).sqrt();
    let mut worst_open = 0.0_f64; let mut worst_free = 0.0_f64; let mut worst_lim = 0.0_f64; let mut el = vec![0.0; g.len()];
    let lv = limit.unwrap_or(f64::INFINITY);
    hs.displacement(&st.pressure, &mut el).unwrap();
    let mut nl = 0; let mut worst_film=0.0_f64;
    for k in 0..g.len() {
        let e = gap[k] + el[k] - st.approach; let p = st.pressure[k];
        if p <= 0.0 { worst_open = worst_open.max(-e); } else if p < lv { worst_free = worst_free.max(e.abs()); } else { nl += 1; worst_lim = worst_lim.max(e); }
        worst_film = worst_film.max((st.film[k] - e - st.plastic_depth[k]).abs());
    }
    let prof = g.nodes().zip(&st.pressure).map(|((x, y), p)| { let r = x.hypot(y)/hz.a_x; if r < 0.9 || r > 1.1 { ((p - hz.pressure_at(x, y)) / hz.p_max).abs() } else { 0.0 } }).fold(0.0, f64::max);
    let profall = g.nodes().zip(&st.pressure).map(|((x, y), p)| ((p - hz.pressure_at(x, y)) / hz.p_max).abs()).fold(0.0, f64::max);
    eprintln!("n {n} rq {rq:e} seed {seed} lim {limit:?} {} pass {} steps {} conv {} t {dt:.3} res {:?} | warm {} {} {} | pmax-1 {:.3e} appr-1 {:.3e} a/a-1 {:.3e} prof {prof:.2e} all {profall:.2e} | open {worst_open:.1e} free {worst_free:.1e} lim {worst_lim:.1e} nl {nl} film {worst_film:.1e}", r.status, r.work.iterations, r.work.inner_iterations, r.work.convolutions, r.residuals, r2.status, r2.work.iterations, r2.work.inner_iterations, pmax / hz.p_max - 1.0, st.approach / hz.approach - 1.0, a / hz.a_x - 1.0);
}

#[test]
fn explore() {
    for n in [32, 64, 65, 128, 256] { run(n, 0.0, 0, None, 1e-9); }
    for seed in 1..4 { for l in [None, Some(6e9), Some(2e9)] { for n in [64, 128] { run(n, 130e-9, seed, l, 1e-9); } } }
}


#[test]
fn explore_random() {
    let mut s = 12345_u64;
    let mut rnd = move || { s = s.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); (s >> 11) as f64 / (1u64 << 53) as f64 };
    let mut bad = [0; 8]; let mut hist = vec![];
    for case in 0..12000 {
        let n = if case % 5 == 0 { 32 } else { 16 };
        let g = Grid::centred(n, n, 1e-6, 1.3e-6).unwrap();
        let mut hs = HalfSpace::new(g, 2e11).unwrap();
        let rough = 10f64.powf(-9.0 + 4.0 * rnd());
        let gap: Vec<f64> = g.nodes().map(|(x, y)| 0.5 * (x * x + y * y) / 1e-4 * (case % 2) as f64 + rough * rnd()).collect();
        let mode = case % 3;
        let frac = 10f64.powf(-4.0 * rnd()); let frac = if case % 7 == 0 { 1.0 } else { frac };
        let lim: Option<Vec<f64>> = match mode { 0 => None, 1 => Some(vec![5e9; g.len()]), _ => Some((0..g.len()).map(|_| 5e9 * (0.01 + rnd())).collect()) };
        let cap: f64 = (0..n*n).filter(|k| k % n > 0 && k % n < n-1 && k / n > 0 && k / n < n-1).map(|k| lim.as_ref().map_or(5e9, |l| l[k])).sum::<f64>() * g.cell_area();
        let load = 0.9999 * cap * frac;
        let ph = 10f64.powf(7.0 + 4.0 * rnd());
        let start = 10f64.powf(-7.0 + 2.5 * rnd());
        let mut pb = LubricatedContact { gap: &gap, deformation: &mut hs, lubricant: None, entrainment_speed: 0.0, squeeze: None, load, pressure_limit: lim.as_deref(), film_cutoff: 1e-9, scheme: Scheme::FirstOrder, reference_half_widths: (30e-6, 30e-6), reference_pressure: ph };
        let mut st = ContactState::new(&g);
        for ((x, y), p) in g.nodes().zip(&mut st.pressure) { *p = if x.hypot(y) < start { ph } else { 0.0 }; }
        if case % 3 == 2 { for p in &mut st.pressure { *p = ph * rnd(); } }
        let r = Dry::new().solve(&mut pb, &mut st, &StoppingRule { tolerance: 1e-9, max_iterations: 500 }).unwrap();
        hist.push(r.work.iterations);
        if r.work.iterations > 20 { eprintln!("SLOW case {case} mode {mode} frac {frac:.2e} rough {rough:.1e} ph {ph:.1e} start {start:.1e} {:?}", r); }
        if r.status != stribeck::Status::Converged { bad[mode] += 1; if bad[mode] < 6 { eprintln!("case {case} mode {mode} frac {frac:.2e} rough {rough:.1e} {:?}", r); } }
    }
    hist.sort();
    eprintln!("bad {bad:?}; max passes {}, p99 {}", hist[hist.len() - 1], hist[hist.len() * 99 / 100]);
    let _ = (DrySolver::new(1), None::<DryProblem<'_>>);
}
