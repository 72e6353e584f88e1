//! One contact: its surfaces, its solve, its line of the table.

use std::error::Error;
use std::path::Path;

use stribeck::reynolds::{Cavitation, ContactDefinition, FaceMobility, Scheme};
use stribeck::sim::scene::{FileRoughness, InletSpec, Roughness, RoughnessPair, SolverKind};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::{Autocorrelation, Heights, RoughnessSpec, generate, write_npy};

use crate::plan::{CONTACTS, Contact, Job};

/// Where the autocorrelation is 10 % \[m\].
const LENGTH: f64 = 10e-6;

pub(crate) const COLUMNS: &str = "contact,face_mobility,cavitation,cells,cells_of_surface,seed,film_cutoff_m,entrainment_speed_m_per_s,rq_ball_m,rq_disc_m,status,ran,\
     mass_residual,load_residual,complementarity_residual,iterations,convolutions,minimum_gap_m,area_ratio,load_ratio,\
     mean_film_m,friction_coefficient";

/// A contact and what became of it.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) job: Job,
    pub(crate) status: String,
    /// The solver that made the state.
    ran: String,
    /// Of mass, load and complementarity.
    pub(crate) residuals: [f64; 3],
    iterations: u64,
    convolutions: f64,
    /// Smallest gap \[m\].
    pub(crate) gap: f64,
    /// Area ratio, load ratio, mean film \[m\] and friction coefficient.
    pub(crate) values: [f64; 4],
}

impl Row {
    pub(crate) fn converged(&self) -> bool {
        self.status == "converged"
    }

    pub(crate) fn line(&self) -> String {
        let ([mass, load, complementarity], [area, share, film, friction]) = (self.residuals, self.values);
        format!(
            "{},{},{},{mass:.2e},{load:.2e},{complementarity:.2e},{},{:.0},{:.4e},{area:.6},{share:.6},{film:.5e},{friction:.6}",
            self.job.key(),
            self.status,
            self.ran,
            self.iterations,
            self.convolutions,
            self.gap
        )
    }

    pub(crate) fn parse(line: &str) -> Option<Self> {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |k: usize| fields.get(k)?.parse::<f64>().ok();
        let count = |k: usize| fields.get(k)?.parse::<u64>().ok();
        let kind = fields.get(..3)?.join(",");
        let job = Job {
            contact: CONTACTS.into_iter().find(|contact| contact.to_string() == kind)?,
            cells: fields.get(3)?.parse().ok()?,
            coarsest: fields.get(4)?.parse().ok()?,
            seed: count(5)?,
            cutoff: number(6)?,
            speed: number(7)?,
            rq: [number(8)?, number(9)?],
        };
        Some(Self {
            job,
            status: (*fields.get(10)?).to_owned(),
            ran: (*fields.get(11)?).to_owned(),
            residuals: [number(12)?, number(13)?, number(14)?],
            iterations: count(15)?,
            convolutions: number(16)?,
            gap: number(17)?,
            values: [number(18)?, number(19)?, number(20)?, number(21)?],
        })
    }
}

/// Solves a contact; its surfaces go through files in `folder`.
pub(crate) fn solve(job: &Job, folder: &Path) -> Result<Row, Box<dyn Error>> {
    let mut scene = Scene::azam_2019(job.cells);
    scene.motion.entrainment_speed = job.speed;
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    scene.solver.film_cutoff = job.cutoff;
    scene.solver.cavitation = Some(Cavitation::Reynolds);
    match job.contact {
        Contact::Dry => scene.solver.kind = SolverKind::Dry,
        Contact::Inlet => {
            scene.solver.scheme = Some(Scheme::Limited);
            scene.solver.face_mobility = Some(FaceMobility::Inlet);
            scene.solver.cavitation = Some(Cavitation::MassConserving);
        }
        Contact::Means => {
            scene.solver.scheme = Some(Scheme::FirstOrder);
            scene.solver.face_mobility = Some(FaceMobility::ReducedPressure);
        }
        Contact::Paper => {
            scene.solver.contact = ContactDefinition::UnifiedReynolds;
            scene.solver.max_iterations = job.sweeps();
        }
    }
    let rough = |name: &str, rq: f64, seed: u64| -> Result<Roughness, Box<dyn Error>> {
        let path = folder.join(name);
        let heights = heights(job, rq, seed)?;
        write_npy(&path, heights.nx(), heights.ny(), heights.heights())?;
        Ok(Roughness::File(FileRoughness { path, rq: None }))
    };
    scene.roughness = RoughnessPair {
        ball: rough("ball.npy", job.rq[0], 2 * job.seed - 1)?,
        disc: rough("disc.npy", job.rq[1], 2 * job.seed)?,
    };
    let solution = solve_contact(&scene)?;
    for name in ["ball.npy", "disc.npy"] {
        std::fs::remove_file(folder.join(name))?;
    }
    let report = solution.report;
    Ok(Row {
        job: *job,
        status: report.status.to_string(),
        ran: report.solver.to_string(),
        residuals: [report.residual.mass, report.residual.load, report.residual.complementarity],
        iterations: report.work.iterations,
        convolutions: report.work.convolutions,
        gap: solution.film.minimum_gap,
        values: [
            solution.contact.area_ratio,
            solution.contact.load_ratio,
            solution.film.mean_central,
            solution.friction.coefficient,
        ],
    })
}

/// Heights of one body on the grid of the contact: those of the coarsest grid by their Fourier series.
fn heights(job: &Job, rq: f64, seed: u64) -> Result<Heights, Box<dyn Error>> {
    let coarse = Scene::azam_2019(job.coarsest).grid()?;
    let autocorrelation = Autocorrelation::Gaussian;
    let spec = RoughnessSpec { autocorrelation, rq, length_x: LENGTH, length_y: LENGTH, seed };
    let heights = generate(&coarse, &spec)?;
    let surface = Heights::new(coarse.nx(), coarse.ny(), Some([coarse.dx(), coarse.dy()]), heights, None)?;
    Ok(surface.resample_fourier(job.cells, job.cells)?)
}
