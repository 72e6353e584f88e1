//! Cases around the reference contact, from full film to dry contact.

use crate::analytic::HertzLine;
use crate::benchmark::case::{Case, HeightsOnGrid, History};
use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::scene::{
    FlowThinning, GridSpec, InletSpec, LayerSpec, PlasticSpec, Roughness, RoughnessPair,
};
use crate::sim::{Scene, SimError};
use crate::surface::{Autocorrelation, Form, RoughnessSpec, read_bytes, rescale};
use crate::thermal::FilmThermal;

/// Hertz pressure of the reference scene \[Pa\] and half of its box \[m\]; boxes grow with the Hertz radius,
/// which grows with the pressure.
const REFERENCE: (f64, f64) = (1.15e9, 0.25e-3);
/// Roller of line contacts \[m\]; half of their box in Hertz half-widths.
const ROLLER_RADIUS: f64 = 10e-3;
const LINE_HALF_BOX: f64 = 1.7;
/// Share of ball and disc in the composite roughness, those of the reference scene.
const SHARES: [f64; 2] = [20.0 / 131.529, 130.0 / 131.529];
/// Difference of the seeds of disc and ball.
const DISC_SEED: u64 = 100;
/// Contacts of a transient case; the first has no squeeze.
const STEPS: u32 = 6;
/// A measured disc.
const MEASURED: &[u8] = include_bytes!("../../../tests/data/surfaces/cut.txt");

const SPEEDS: [f64; 5] = [10.0, 1.0, 0.1, 0.01, 0.001];
const ROUGHNESSES: [f64; 5] = [0.0, 20e-9, 60e-9, 130e-9, 300e-9];
const LENGTHS: [f64; 2] = [10e-6, 40e-6];
const PRESSURES: [f64; 3] = [0.5e9, 1.15e9, 2.0e9];
const HARDNESSES: [f64; 3] = [f64::INFINITY, 6e9, 2e9];

/// Thermal cases: largest shear stress of the oil over its pressure, 2 um of a carbon coating on the disc, Young's
/// modulus \[Pa\] and Poisson's ratio of the steel below, radius of spin over the half-width of the box, and slide-roll
/// ratios in turn.
const LIMITING_STRESS: f64 = 0.06;
const COATING: LayerSpec = LayerSpec::new(2e-6, 300e9, 0.25);
const STEEL: (f64, f64) = (210e9, 0.3);
const SPIN_RADIUS: f64 = 2.0;
const SLIDE_ROLL_RATIOS: [f64; 4] = [0.05, 0.5, 1.0, 2.0];

/// Varied values of a case.
#[derive(Debug, Clone, Copy)]
struct Contact {
    group: &'static str,
    nodes: usize,
    /// Entrainment speed \[m/s\].
    speed: f64,
    /// Composite roughness \[m\].
    rq: f64,
    /// Correlation lengths along and across the flow \[m\].
    lengths: [f64; 2],
    /// Hertz pressure \[Pa\].
    pressure: f64,
    /// Infinite for elastic bodies \[Pa\].
    hardness: f64,
    /// Cells that the mean surface moves in a step; zero for a single contact.
    cells: u32,
    seed: u64,
}

impl Contact {
    fn new(group: &'static str, nodes: usize, speed: f64, rq: f64, seed: u64) -> Self {
        let (pressure, hardness) = (REFERENCE.0, HARDNESSES[1]);
        Self { group, nodes, speed, rq, lengths: [LENGTHS[0]; 2], pressure, hardness, cells: 0, seed }
    }

    /// Half of the box \[m\].
    fn half_box(&self) -> f64 {
        REFERENCE.1 * self.pressure / REFERENCE.0
    }

    fn scene(&self) -> Result<Scene, InputError> {
        let (nodes, half) = (self.nodes, self.half_box());
        let mut scene = Scene::azam_2019(nodes);
        scene.grid = GridSpec::Cells { nx: nodes, ny: nodes, x: [-half, half], y: [-half, half] };
        if self.group == "line" {
            let modulus = scene.elastic.equivalent_modulus;
            let half = LINE_HALF_BOX
                * HertzLine::from_max_pressure(ROLLER_RADIUS, modulus, self.pressure)?.half_width;
            scene.form = Form::Cylinder { radius: ROLLER_RADIUS };
            scene.grid = GridSpec::Row { nx: nodes, x: [-half, half] };
        }
        scene.load.hertz_pressure = Some(self.pressure);
        scene.motion.entrainment_speed = self.speed;
        // Solvers are compared, not boxes: solids may touch at the edge.
        scene.solver.edge_contact = true;
        // The same equations for all solvers, multigrid among them.
        scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
        scene.plastic = self.hardness.is_finite().then(|| PlasticSpec::new(self.hardness));
        scene.roughness = RoughnessPair { ball: self.roughness(0), disc: self.roughness(1) };
        Ok(scene)
    }

    fn roughness(&self, body: usize) -> Roughness {
        if self.rq <= 0.0 {
            return Roughness::None;
        }
        let autocorrelation = if self.group == "exponential" {
            Autocorrelation::Exponential
        } else {
            Autocorrelation::Gaussian
        };
        let [length_x, length_y] = self.lengths;
        let seed = self.seed.wrapping_add(DISC_SEED * body as u64);
        let rq = self.rq * SHARES[body];
        Roughness::from(RoughnessSpec { autocorrelation, rq, length_x, length_y, seed })
    }

    /// The case, with a name by its varied values.
    fn case(&self) -> Result<Case, SimError> {
        let Self { group, nodes, speed, rq, lengths: [length_x, length_y], pressure, hardness, cells, seed } =
            *self;
        let scene = self.scene()?;
        let step = f64::from(cells) * scene.grid()?.dx() / speed;
        let mut name = format!(
            "{group} {nodes}: u {speed} m/s, Rq {:.0} nm, {:.0} x {:.0} um, {:.2} GPa, H {} GPa",
            1e9 * rq,
            1e6 * length_x,
            1e6 * length_y,
            1e-9 * pressure,
            1e-9 * hardness
        );
        if cells > 0 {
            name += &format!(", {cells} cells a step");
        }
        name += &format!(", seed {seed}");
        let parameters = [
            ("speed_m_per_s", speed),
            ("rq_m", rq),
            ("length_x_m", length_x),
            ("length_y_m", length_y),
            ("pressure_pa", pressure),
            ("hardness_pa", hardness),
            ("nodes", nodes as f64),
            ("cells_per_step", f64::from(cells)),
        ];
        let case = Case::new(name, scene)
            .with_tags([group, if rq > 0.0 { "rough" } else { "smooth" }])
            .with_parameters(parameters.map(|(name, value)| (name.to_owned(), value)).to_vec())
            .with_history((cells > 0).then(|| History::transient(STEPS, step)));
        Ok(if group == "measured" { self.with_measured_disc(case) } else { case })
    }

    /// The case with a measured disc, scaled to the roughness of the disc.
    fn with_measured_disc(&self, mut case: Case) -> Case {
        let (ball, rq) = (self.roughness(0), self.rq * SHARES[1]);
        case.scene.roughness = RoughnessPair { ball: Roughness::None, disc: Roughness::None };
        let disc = move |grid: &Grid| -> Result<Vec<f64>, SimError> {
            let mut heights = read_bytes(MEASURED, "cut.txt")?.levelled()?.mean_free_on(grid)?;
            // The measured heights are not flat.
            let _ = rescale(&mut heights, grid.nx(), |_| true, rq);
            Ok(heights)
        };
        case.with_heights(Some(HeightsOnGrid::new(move |grid| Ok([ball.heights(grid)?, disc(grid)?]))))
    }
}

fn cases(contacts: &[Contact]) -> Result<Vec<Case>, SimError> {
    contacts.iter().map(Contact::case).collect()
}

/// All combinations on 64 x 64 cells.
fn battery_contacts(seed: u64) -> Vec<Contact> {
    let mut contacts = Vec::new();
    for speed in SPEEDS {
        for rq in ROUGHNESSES {
            // A smooth contact has no length.
            for length in LENGTHS.into_iter().take(if rq > 0.0 { 2 } else { 1 }) {
                for pressure in PRESSURES {
                    for hardness in HARDNESSES {
                        let contact = Contact::new("battery", 64, speed, rq, seed);
                        contacts.push(Contact { lengths: [length; 2], pressure, hardness, ..contact });
                    }
                }
            }
        }
    }
    contacts
}

/// Finer meshes, other roughness, moving roughness, and loads that the hardness cannot carry.
fn corner_contacts(seed: u64) -> Vec<Contact> {
    let mut contacts = Vec::new();
    let new = |group, nodes, speed, rq| Contact::new(group, nodes, speed, rq, seed);
    let pairs = [1.0, 0.1, 0.01].map(|speed| [20e-9, 130e-9].map(|rq| (speed, rq)));
    for nodes in [128, 256] {
        contacts.extend(pairs.as_flattened().iter().map(|&(speed, rq)| new("finer", nodes, speed, rq)));
    }
    for &(speed, rq) in pairs.as_flattened() {
        for lengths in [[100e-6, 10e-6], [10e-6, 100e-6]] {
            contacts.push(Contact { lengths, ..new("anisotropic", 64, speed, rq) });
        }
        for hardness in HARDNESSES {
            contacts.push(Contact { hardness, ..new("exponential", 64, speed, rq) });
        }
        for cells in [1, 4] {
            contacts.push(Contact { cells, ..new("transient", 64, speed, rq) });
        }
        contacts.push(new("measured", 64, speed, rq));
    }
    contacts.extend(PRESSURES.map(|pressure| {
        let hardness = 0.05 * pressure;
        Contact { pressure, hardness, ..new("infeasible", 64, 0.1, 60e-9) }
    }));
    contacts
}

pub(super) fn battery(seed: u64) -> Result<Vec<Case>, SimError> {
    cases(&battery_contacts(seed))
}

pub(super) fn corners(seed: u64) -> Result<Vec<Case>, SimError> {
    cases(&corner_contacts(seed))
}

/// Rough line contacts.
pub(super) fn lines(seed: u64) -> Result<Vec<Case>, SimError> {
    let mut contacts = Vec::new();
    for &speed in &SPEEDS[1..] {
        for &rq in &ROUGHNESSES[1..] {
            for (length, pressure) in LENGTHS.into_iter().zip([PRESSURES[0], PRESSURES[1]]) {
                for hardness in [HARDNESSES[0], HARDNESSES[2]] {
                    let contact = Contact::new("line", 512, speed, rq, seed);
                    contacts.push(Contact { lengths: [length; 2], pressure, hardness, ..contact });
                }
            }
        }
    }
    cases(&contacts)
}

/// Contacts of the map on 64 x 64 cells without motion of the roughness, with all thermal effects.
pub(super) fn thermal(seed: u64) -> Result<Vec<Case>, SimError> {
    let contacts = [battery_contacts(seed), corner_contacts(seed)].concat().into_iter();
    let contacts = contacts.filter(|contact| contact.cells == 0 && contact.nodes <= 64);
    let heated = contacts.zip(SLIDE_ROLL_RATIOS.into_iter().cycle()).map(|(contact, ratio)| {
        let mut case = contact.case()?;
        heat(&mut case.scene, ratio, contact.half_box());
        case.name += &format!(", thermal, SRR {ratio}");
        Ok(case)
    });
    heated.collect()
}

/// Film temperature, shear thinning, a limiting stress, a coated disc, and spin.
fn heat(scene: &mut Scene, ratio: f64, half_box: f64) {
    let Some(oil) = &mut scene.lubricant else { return };
    (oil.temperature, oil.roelands_s0) = (Some(353.15), Some(1.1));
    oil.thermal = Some(FilmThermal::default());
    scene.motion.slide_roll_ratio = ratio;
    scene.motion.spin_radius = Some(SPIN_RADIUS * half_box);
    scene.friction.eyring_stress = Some(5e6);
    scene.friction.flow_thinning = Some(FlowThinning::Directional);
    scene.friction.limiting_stress_coefficient = Some(LIMITING_STRESS);
    let coating = COATING.with_substrate_modulus(Some(STEEL.0));
    scene.elastic.layer = Some(coating.with_substrate_poisson(Some(STEEL.1)));
    scene.thermal.bulk_temperature = 353.15;
}
