//! Which contacts are solved.

use std::fmt;

/// Cells along each side; surfaces are those of the first.
pub(crate) const CELLS: [usize; 5] = [64, 128, 256, 512, 1024];
/// Films at which solids touch \[m\].
pub(crate) const CUTOFFS: [f64; 6] = [0.3e-9, 0.5e-9, 1e-9, 2e-9, 3e-9, 5e-9];
/// The one that the mesh is studied with, the default of scenes \[m\].
pub(crate) const CUTOFF: f64 = 1e-9;
/// Cells of what is studied on one mesh.
pub(crate) const MESH: usize = 128;
/// Entrainment speed of the reference scene \[m/s\].
pub(crate) const SPEED: f64 = 0.1;
/// Entrainment speeds below it \[m/s\].
pub(crate) const SLOW: [f64; 1] = [1e-2];
/// Roughness of ball and disc of the reference scene \[m\].
pub(crate) const REFERENCE: [f64; 2] = [20e-9, 130e-9];
/// Surfaces of the coarser grids; finer ones are given the first alone.
pub(crate) const SEEDS: [u64; 3] = [1, 2, 3];
/// Largest grid that all surfaces are solved on.
pub(crate) const ALL_SEEDS: usize = 256;
/// A contact that sweeps solve with the paper's definition: entrainment speed \[m/s\] and roughness \[m\].
pub(crate) const FULLER: (f64, [f64; 2]) = (1.0, [6e-9, 39e-9]);

/// Largest grid on which sweeps are given the time that this contact takes.
const FULLER_PAPER: usize = 128;

/// What is taken for solid contact, and how fluid flows through faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Contact {
    Dry,
    /// Limited entrainment, faces that know where the edge of a contact lies, cavitation that conserves mass.
    Inlet,
    /// Entrainment of first order and the mean of the cubes of the films, Reynolds' condition.
    Means,
    /// One pressure, as in Azam et al. (2019).
    Paper,
}

pub(crate) const CONTACTS: [Contact; 4] = [Contact::Inlet, Contact::Means, Contact::Paper, Contact::Dry];

impl fmt::Display for Contact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Dry => "dry,,",
            Self::Inlet => "hard,inlet,mass_conserving",
            Self::Means => "hard,reduced_pressure,reynolds",
            Self::Paper => "paper,arithmetic,reynolds",
        })
    }
}

/// One contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Job {
    pub(crate) contact: Contact,
    pub(crate) cells: usize,
    /// Cells of the grid that the surfaces are generated on.
    pub(crate) coarsest: usize,
    pub(crate) seed: u64,
    pub(crate) cutoff: f64,
    pub(crate) speed: f64,
    pub(crate) rq: [f64; 2],
}

impl Job {
    fn new(contact: Contact, cells: usize, seed: u64) -> Self {
        Self { contact, cells, coarsest: CELLS[0], seed, cutoff: CUTOFF, speed: SPEED, rq: REFERENCE }
    }

    /// Sweeps that the paper's contact is given.
    pub(crate) fn sweeps(&self) -> u64 {
        if self.speed > SPEED { 30_000 } else { 10_000 }
    }

    /// The first columns of the table.
    pub(crate) fn key(&self) -> String {
        let Self { contact, cells, coarsest, seed, cutoff, speed, rq } = self;
        format!("{contact},{cells},{coarsest},{seed},{cutoff:e},{speed:e},{:e},{:e}", rq[0], rq[1])
    }
}

/// All contacts on grids of up to `finest` cells along each side.
pub(crate) fn all(finest: usize) -> Vec<Job> {
    let mut jobs = Vec::new();
    for cells in CELLS.into_iter().filter(|cells| *cells <= finest) {
        for contact in CONTACTS {
            jobs.extend(seeds(contact, cells).map(|seed| Job::new(contact, cells, seed)));
        }
        jobs.extend(cutoffs(cells));
        if cells == MESH {
            jobs.extend(SLOW.map(|speed| Job { speed, ..Job::new(Contact::Inlet, cells, 1) }));
        }
        if cells <= ALL_SEEDS {
            let (speed, rq) = FULLER;
            let contacts = if cells <= FULLER_PAPER { &CONTACTS[..3] } else { &CONTACTS[..2] };
            jobs.extend(contacts.iter().map(|c| Job { speed, rq, ..Job::new(*c, cells, 1) }));
        }
    }
    jobs
}

/// A few contacts on coarse grids.
pub(crate) fn quick() -> Vec<Job> {
    let jobs = [32, 64].into_iter().flat_map(|cells| CONTACTS.map(|contact| Job::new(contact, cells, 1)));
    jobs.map(|job| Job { coarsest: 32, ..job }).collect()
}

/// The paper's contact is swept thousands of times: one surface, and no grid beyond that of all others.
fn seeds(contact: Contact, cells: usize) -> impl Iterator<Item = u64> {
    let count = match contact {
        Contact::Paper => usize::from(cells <= ALL_SEEDS),
        _ if cells <= ALL_SEEDS => SEEDS.len(),
        _ => 1,
    };
    SEEDS.into_iter().take(count)
}

/// The contact films beside that of the mesh study; the finer the mesh, the fewer.
fn cutoffs(cells: usize) -> Vec<Job> {
    let (contacts, films, seeds) = match cells {
        64 => (&CONTACTS[..2], &CUTOFFS[..], &SEEDS[..1]),
        128 => (&CONTACTS[..3], &CUTOFFS[..], &SEEDS[..]),
        256 => (&CONTACTS[..2], &CUTOFFS[..], &SEEDS[..1]),
        _ => return Vec::new(),
    };
    let mut jobs = Vec::new();
    for contact in contacts {
        // The paper's contact has one surface everywhere.
        let seeds = if matches!(contact, Contact::Paper) { &seeds[..1] } else { seeds };
        for cutoff in films.iter().filter(|cutoff| **cutoff != CUTOFF) {
            let job = |seed: &u64| Job { cutoff: *cutoff, ..Job::new(*contact, cells, *seed) };
            jobs.extend(seeds.iter().map(job));
        }
    }
    jobs
}
