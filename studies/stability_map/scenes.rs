//! The scenes of the map.

use std::fmt;
use std::path::PathBuf;

use stribeck::InputError;
use stribeck::analytic::HertzLine;
use stribeck::sim::Scene;
use stribeck::sim::scene::{
    FileRoughness, FlowThinning, GridSpec, InletSpec, LayerSpec, PlasticSpec, Roughness, RoughnessPair,
};
use stribeck::surface::{Autocorrelation, Form, RoughnessSpec};
use stribeck::thermal::FilmThermal;

/// Hertz pressure of the reference scene \[Pa\] and half of its box \[m\]; boxes grow with the Hertz radius,
/// which grows with the pressure.
const REFERENCE: (f64, f64) = (1.15e9, 0.25e-3);
/// Of the roller of line contacts \[m\]; half of their box in Hertz half-widths.
const ROLLER_RADIUS: f64 = 10e-3;
const LINE_HALF_BOX: f64 = 1.7;
/// Share of ball and disc in the composite roughness, those of the reference scene.
const SHARES: [f64; 2] = [20.0 / 131.529, 130.0 / 131.529];

/// Of scenes with all of it: largest shear stress of the oil over its pressure, 2 um of a carbon coating on
/// the disc, Young's modulus \[Pa\] and Poisson's ratio of the steel below, radius of spin over the half-width
/// of the box.
const LIMITING_STRESS: f64 = 0.06;
const COATING: LayerSpec = LayerSpec::new(2e-6, 300e9, 0.25);
const STEEL: (f64, f64) = (210e9, 0.3);
const SPIN_RADIUS: f64 = 2.0;

/// Between the seeds of ball and disc.
const DISC_SEED: u64 = 100;

pub(crate) const SPEEDS: [f64; 5] = [10.0, 1.0, 0.1, 0.01, 0.001];
pub(crate) const ROUGHNESSES: [f64; 5] = [0.0, 20e-9, 60e-9, 130e-9, 300e-9];
pub(crate) const LENGTHS: [f64; 2] = [10e-6, 40e-6];
pub(crate) const PRESSURES: [f64; 3] = [0.5e9, 1.15e9, 2.0e9];
pub(crate) const HARDNESSES: [Option<f64>; 3] = [None, Some(6e9), Some(2e9)];

/// Which part of the map a scene belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
    /// Every combination on the coarse grid.
    Battery,
    /// A choice of them on finer grids.
    Finer,
    /// Roughness ten times longer along or across the flow.
    Anisotropic,
    /// Exponential autocorrelation: no shortest wavelength but that of the mesh.
    Exponential,
    /// Both roughnesses carried through the contact, with squeeze: a cell or four of the grid in a step.
    Transient,
    /// A measured disc.
    Measured,
    /// More load than the hardness can carry in the box: to be refused.
    Infeasible,
    /// A roller on a flat, not among those of the map.
    Line,
}

impl fmt::Display for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Battery => "battery",
            Self::Finer => "finer",
            Self::Anisotropic => "anisotropic",
            Self::Exponential => "exponential",
            Self::Transient => "transient",
            Self::Measured => "measured",
            Self::Infeasible => "infeasible",
            Self::Line => "line",
        })
    }
}

/// What varies between the scenes.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) group: Group,
    pub(crate) nodes: usize,
    /// Entrainment speed \[m/s\].
    pub(crate) speed: f64,
    /// Composite roughness \[m\].
    pub(crate) rq: f64,
    /// Autocorrelation lengths along and across the flow \[m\].
    pub(crate) lengths: [f64; 2],
    /// Hertz pressure \[Pa\].
    pub(crate) pressure: f64,
    pub(crate) hardness: Option<f64>,
    /// Cells that the mean surface moves on in a step of a transient scene; zero in the others.
    pub(crate) cells: u32,
    /// Slide-roll ratio of a contact with all of it: a film with a temperature of its own, shear thinning in
    /// its flow, a limiting stress and a coated disc; none where it has none of these.
    pub(crate) sliding: Option<f64>,
    /// Seed of the ball's roughness; the disc's is [`DISC_SEED`] more.
    pub(crate) seed: u64,
}

impl Case {
    fn new(group: Group, nodes: usize, speed: f64, rq: f64) -> Self {
        Self {
            group,
            nodes,
            speed,
            rq,
            lengths: [LENGTHS[0]; 2],
            pressure: REFERENCE.0,
            hardness: HARDNESSES[1],
            cells: 0,
            sliding: None,
            seed: 0,
        }
    }

    /// The scene of this case.
    pub(crate) fn scene(&self) -> Result<Scene, InputError> {
        let mut scene = Scene::azam_2019(self.nodes);
        let half = REFERENCE.1 * self.pressure / REFERENCE.0;
        scene.grid = GridSpec::Cells { nx: self.nodes, ny: self.nodes, x: [-half, half], y: [-half, half] };
        if self.group == Group::Line {
            let modulus = scene.elastic.equivalent_modulus;
            let hertz = HertzLine::from_max_pressure(ROLLER_RADIUS, modulus, self.pressure)?;
            let half = LINE_HALF_BOX * hertz.half_width;
            scene.form = Form::Cylinder { radius: ROLLER_RADIUS };
            scene.grid = GridSpec::Row { nx: self.nodes, x: [-half, half] };
        }
        scene.load.hertz_pressure = Some(self.pressure);
        scene.motion.entrainment_speed = self.speed;
        if let Some(oil) = &mut scene.lubricant {
            // The same equations for all solvers, multigrid among them.
            oil.inlet = InletSpec::BoxEdge;
        }
        scene.plastic = self.hardness.map(PlasticSpec::new);
        let rough = |body: usize| self.roughness(body);
        scene.roughness = RoughnessPair { ball: rough(0), disc: rough(1) };
        if let (Some(ratio), Some(oil)) = (self.sliding, &mut scene.lubricant) {
            scene.motion.slide_roll_ratio = ratio;
            scene.friction.eyring_stress = Some(5e6);
            scene.friction.flow_thinning = Some(FlowThinning::Directional);
            scene.friction.limiting_stress_coefficient = Some(LIMITING_STRESS);
            let coating = COATING.with_substrate_modulus(Some(STEEL.0));
            scene.elastic.layer = Some(coating.with_substrate_poisson(Some(STEEL.1)));
            scene.thermal.bulk_temperature = 353.15;
            (oil.temperature, oil.roelands_s0) = (Some(353.15), Some(1.1));
            oil.thermal = Some(FilmThermal::default());
            if self.group != Group::Line {
                scene.motion.spin_radius = Some(SPIN_RADIUS * half);
            }
        }
        Ok(scene)
    }

    fn roughness(&self, body: usize) -> Roughness {
        let rq = self.rq * SHARES[body];
        let [length_x, length_y] = self.lengths;
        let seed = self.seed.wrapping_add(DISC_SEED * body as u64);
        let random = |autocorrelation| {
            Roughness::from(RoughnessSpec { autocorrelation, rq, length_x, length_y, seed })
        };
        match self.group {
            _ if self.rq <= 0.0 => Roughness::None,
            Group::Exponential => random(Autocorrelation::Exponential),
            Group::Measured if body == 1 => Roughness::File(FileRoughness {
                path: PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/data/surfaces/cut.txt"),
                rq: Some(rq),
            }),
            _ => random(Autocorrelation::Gaussian),
        }
    }
}

/// All cases of the map, or `all_lines` in their place, with roughness of this seed; with `quick` a handful of
/// the battery on a coarser grid.
pub(crate) fn cases(all_lines: bool, quick: bool, seed: u64) -> Vec<Case> {
    let mut cases = if all_lines {
        lines()
    } else if quick {
        let transient = Case { cells: 1, ..Case::new(Group::Transient, 32, 0.1, 20e-9) };
        battery(32).into_iter().step_by(37).chain(infeasible(32)).chain([transient]).collect()
    } else {
        [battery(64), finer(), variants(), infeasible(64)].concat()
    };
    for case in &mut cases {
        case.seed = seed;
    }
    cases
}

fn battery(nodes: usize) -> Vec<Case> {
    let mut cases = Vec::new();
    for speed in SPEEDS {
        for rq in ROUGHNESSES {
            for length in LENGTHS {
                if rq <= 0.0 && length > LENGTHS[0] {
                    continue; // smooth: no length
                }
                for pressure in PRESSURES {
                    for hardness in HARDNESSES {
                        let case = Case::new(Group::Battery, nodes, speed, rq);
                        cases.push(Case { lengths: [length; 2], pressure, hardness, ..case });
                    }
                }
            }
        }
    }
    cases
}

fn finer() -> Vec<Case> {
    let mut cases = Vec::new();
    for nodes in [128, 256] {
        for speed in [1.0, 0.1, 0.01] {
            for rq in [20e-9, 130e-9] {
                cases.push(Case::new(Group::Finer, nodes, speed, rq));
            }
        }
    }
    cases
}

fn variants() -> Vec<Case> {
    let mut cases = Vec::new();
    for speed in [1.0, 0.1, 0.01] {
        for rq in [20e-9, 130e-9] {
            for lengths in [[100e-6, 10e-6], [10e-6, 100e-6]] {
                cases.push(Case { lengths, ..Case::new(Group::Anisotropic, 64, speed, rq) });
            }
            for hardness in HARDNESSES {
                cases.push(Case { hardness, ..Case::new(Group::Exponential, 64, speed, rq) });
            }
            for cells in [1, 4] {
                cases.push(Case { cells, ..Case::new(Group::Transient, 64, speed, rq) });
            }
            cases.push(Case::new(Group::Measured, 64, speed, rq));
        }
    }
    cases
}

/// Rough line contacts.
fn lines() -> Vec<Case> {
    let mut cases = Vec::new();
    for &speed in &SPEEDS[1..] {
        for &rq in &ROUGHNESSES[1..] {
            for (length, pressure) in LENGTHS.into_iter().zip([PRESSURES[0], PRESSURES[1]]) {
                for hardness in [None, HARDNESSES[2]] {
                    let case = Case::new(Group::Line, 512, speed, rq);
                    cases.push(Case { lengths: [length; 2], pressure, hardness, ..case });
                }
            }
        }
    }
    cases
}

/// Hardness times box is less than the load.
fn infeasible(nodes: usize) -> Vec<Case> {
    PRESSURES
        .iter()
        .map(|&pressure| {
            let hardness = Some(0.05 * pressure);
            Case { pressure, hardness, ..Case::new(Group::Infeasible, nodes, 0.1, 60e-9) }
        })
        .collect()
}
