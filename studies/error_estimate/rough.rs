//! Random mixed contacts: small ones, so that a reference on a finer mesh is affordable. All meshes have the
//! same waves.

use std::error::Error;
use std::path::Path;

use stribeck::Status;
use stribeck::reynolds::{Cavitation, FaceMobility};
use stribeck::sim::scene::{FileRoughness, GridSpec, Roughness, RoughnessPair};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::{Autocorrelation, Form, Heights, RoughnessSpec, generate, write_npy};

pub(crate) struct Options {
    pub(crate) first: u64,
    pub(crate) scenes: u64,
    pub(crate) cells: usize,
    pub(crate) finer: usize,
    pub(crate) waves: Option<usize>,
    pub(crate) face_mobility: Option<FaceMobility>,
    pub(crate) cavitation: Option<Cavitation>,
}

impl Default for Options {
    fn default() -> Self {
        Self { first: 1, scenes: 20, cells: 64, finer: 4, waves: None, face_mobility: None, cavitation: None }
    }
}

/// Box of Azam et al. (2019) \[m\]; all lengths of a contact but those of its surfaces shrink with its own.
const BOX: f64 = 0.5e-3;
/// Errors below this are those of solves that end, and say nothing of an estimate.
const NEGLIGIBLE: f64 = 1e-4;
const NAMES: [&str; 4] = ["load ratio", "area ratio", "mean film", "friction"];

/// One random contact.
struct Contact {
    seed: u64,
    speed: f64,
    rq: f64,
    cutoff: f64,
    size: f64,
    length: f64,
    elastic: bool,
}

impl Contact {
    /// Evenly spread over the ranges by multiples of powers of a root.
    fn new(seed: u64) -> Self {
        let root = (0..60).fold(2.0_f64, |root, _| (1.0 + root).powf(1.0 / 7.0));
        let share = |k: i32| (seed as f64 * root.powi(-k)).fract();
        let between = |k: i32, low: f64, high: f64| low * (high / low).powf(share(k));
        let size = 64.0 * between(4, 2e-6, 4e-6);
        Self {
            seed,
            speed: between(1, 0.005, 1.0),
            rq: between(2, 40e-9, 200e-9),
            cutoff: between(3, 0.5e-9, 3e-9),
            size,
            length: size / 32.0 * (2.0 + 3.0 * share(5)),
            elastic: share(6) < 0.3,
        }
    }

    fn solve(
        &self,
        options: &Options,
        cells: usize,
        folder: &Path,
    ) -> Result<ContactSolution, Box<dyn Error>> {
        let mut scene = Scene::azam_2019(cells);
        scene.form = Form::Sphere { radius: 9.525e-3 * self.size / BOX };
        scene.motion.entrainment_speed = self.speed;
        scene.solver.film_cutoff = self.cutoff;
        scene.solver.estimate = cells == options.cells;
        scene.solver.face_mobility = options.face_mobility;
        if let Some(cavitation) = options.cavitation {
            scene.solver.cavitation = Some(cavitation);
        }
        if self.elastic {
            scene.plastic = None;
        }
        let edges = [-0.5 * self.size, 0.5 * self.size];
        let waves = options.waves.unwrap_or(options.cells / 2);
        scene.grid = GridSpec::Cells { nx: waves, ny: waves, x: edges, y: edges };
        let given = scene.grid()?;
        let rough = |name: &str, rq: f64, seed: u64| -> Result<Roughness, Box<dyn Error>> {
            let autocorrelation = Autocorrelation::Gaussian;
            let [length_x, length_y] = [self.length; 2];
            let spec = RoughnessSpec { autocorrelation, rq, length_x, length_y, seed };
            let surface = Heights::new(waves, waves, None, generate(&given, &spec)?, None)?;
            let path = folder.join(name);
            write_npy(&path, cells, cells, surface.resample_fourier(cells, cells)?.heights())?;
            Ok(Roughness::File(FileRoughness { path, rq: None }))
        };
        scene.roughness = RoughnessPair {
            ball: rough("ball.npy", 0.15 * self.rq, 2 * self.seed)?,
            disc: rough("disc.npy", self.rq, 2 * self.seed + 1)?,
        };
        scene.grid = GridSpec::Cells { nx: cells, ny: cells, x: edges, y: edges };
        Ok(solve_contact(&scene)?)
    }
}

/// Load ratio, area ratio, mean film and friction.
fn numbers(solution: &ContactSolution) -> [f64; 4] {
    let contact = solution.contact;
    [contact.load_ratio, contact.area_ratio, solution.film.mean_central, solution.friction.coefficient]
}

pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    println!(
        "| contact | speed, m/s | contact film, nm | Rq, nm | load ratio | mean film, nm | errors and estimates, %: {} |",
        NAMES.join(" | ")
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let (mut held, mut ratios, mut total) = ([0; 4], [const { Vec::new() }; 4], 0);
    for seed in options.first..options.first + options.scenes {
        let contact = Contact::new(seed);
        let solution = contact.solve(options, options.cells, folder.path())?;
        let finer = contact.solve(options, options.finer * options.cells, folder.path())?;
        let [found, truth] = [&solution, &finer].map(numbers);
        let (speed, cutoff, rq) = (contact.speed, 1e9 * contact.cutoff, 1e9 * contact.rq);
        print!("| {seed} | {speed:.3} | {cutoff:.2} | {rq:.0} | {:.3} | {:.1} |", found[0], 1e9 * found[2]);
        let (Some(estimate), Status::Converged) = (solution.error_estimate, finer.report.status) else {
            println!(" not solved | | | |");
            continue;
        };
        let estimates = [
            estimate.contact_load_ratio,
            estimate.contact_area_ratio,
            estimate.film_mean_central,
            estimate.friction_coefficient,
        ];
        total += 1;
        for (k, estimate) in estimates.into_iter().enumerate() {
            let scale = if k < 2 { 1.0 } else { truth[k] };
            let error = (found[k] - truth[k]).abs() / scale;
            held[k] += usize::from(error <= estimate.max(NEGLIGIBLE));
            if error > NEGLIGIBLE {
                ratios[k].push(estimate / error);
            }
            print!(" {:.2}, {:.2} |", 100.0 * error, 100.0 * estimate);
        }
        println!();
    }
    println!();
    for (k, name) in NAMES.into_iter().enumerate() {
        let ratios = &mut ratios[k];
        ratios.sort_by(f64::total_cmp);
        let median = ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN);
        println!(
            "{name}: {} of {total} hold; estimate over error {median:.1} in the median of {} contacts",
            held[k],
            ratios.len()
        );
    }
    Ok(())
}
