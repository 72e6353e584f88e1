//! Which contacts the reference is made of: rough contacts of the reference scene cut down to an eighth, box
//! and radius, so that meshes become as fine as inlets of asperities need. Pressures, heights, wave lengths
//! and speeds are those of the large scene, and so is the flow in front of an asperity.

use stribeck::reynolds::{Cavitation, FaceMobility, Scheme};
use stribeck::sim::Scene;
use stribeck::sim::scene::{GridSpec, InletSpec};
use stribeck::surface::Form;

/// Over the box and the radius of the reference scene.
pub(crate) const SCALE: f64 = 1.0 / 8.0;
/// Cells of the mesh that surfaces are generated on: those of 7.8 um of the mesh study. Waves are 15.6 um
/// long or longer.
pub(crate) const SURFACE_CELLS: usize = 8;
/// Cells along each side, 3.9 um to 0.12 um.
pub(crate) const CELLS: [usize; 6] = [16, 32, 64, 128, 256, 512];
/// Surfaces of each scene.
pub(crate) const SEEDS: [u64; 3] = [1, 2, 3];
/// Cells of the finest mesh of all but the transition with mass conservation.
const FINEST_OF_OTHERS: usize = 256;
/// A rough contact at several speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Miniature {
    pub(crate) name: &'static str,
    /// Of ball and disc \[m\].
    pub(crate) rq: [f64; 2],
    /// Where the autocorrelation is 10 % \[m\].
    pub(crate) length: f64,
    pub(crate) film_cutoff: f64,
    /// Entrainment speeds \[m/s\]: little contact, the transition, much contact.
    pub(crate) speeds: [f64; 3],
}

pub(crate) const MINIATURES: [Miniature; 3] = [
    Miniature {
        name: "reference",
        rq: [20e-9, 130e-9],
        length: 10e-6,
        film_cutoff: 1e-9,
        speeds: [0.1, 0.05, 0.02],
    },
    Miniature {
        name: "rougher",
        rq: [30e-9, 200e-9],
        length: 14e-6,
        film_cutoff: 1e-9,
        speeds: [0.15, 0.07, 0.03],
    },
    Miniature {
        name: "smoother",
        rq: [15e-9, 80e-9],
        length: 12e-6,
        film_cutoff: 1e-9,
        speeds: [0.1, 0.04, 0.015],
    },
];

/// Entrainment and flow through faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Law {
    Inlet,
    Wedge,
    Means,
}

pub(crate) const LAWS: [Law; 3] = [Law::Inlet, Law::Wedge, Law::Means];

impl Law {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Wedge => "wedge",
            Self::Inlet => "inlet",
            Self::Means => "means",
        }
    }

    fn choices(self) -> (Scheme, FaceMobility) {
        match self {
            Self::Wedge => (Scheme::Limited, FaceMobility::Wedge),
            Self::Inlet => (Scheme::Limited, FaceMobility::Inlet),
            Self::Means => (Scheme::FirstOrder, FaceMobility::ReducedPressure),
        }
    }
}

pub(crate) const CAVITATIONS: [(Cavitation, &str); 2] =
    [(Cavitation::MassConserving, "mass_conserving"), (Cavitation::Reynolds, "reynolds")];

/// One contact on one mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Run {
    pub(crate) miniature: Miniature,
    pub(crate) speed: f64,
    pub(crate) cavitation: (Cavitation, &'static str),
    pub(crate) law: Law,
    pub(crate) seed: u64,
    pub(crate) cells: usize,
}

impl Run {
    /// The first columns of the table.
    pub(crate) fn key(&self) -> String {
        let Self { miniature, speed, cavitation, law, seed, cells } = self;
        format!("{},{speed},{},{},{seed},{cells}", miniature.name, cavitation.1, law.name())
    }

    /// Cells of the finest mesh: the transition is where limits are far, means of cubes are there to be
    /// judged.
    pub(crate) fn finest(&self) -> usize {
        let in_transition = self.case().is_transition() && self.cavitation.0 == Cavitation::MassConserving;
        match self.law {
            Law::Means => 128,
            _ if in_transition => CELLS[CELLS.len() - 1],
            _ => FINEST_OF_OTHERS,
        }
    }

    fn case(&self) -> Case {
        let Self { miniature, speed, cavitation, .. } = *self;
        Case { miniature, speed, cavitation }
    }

    /// The scene without its roughness.
    pub(crate) fn scene(&self) -> Scene {
        let mut scene = Scene::azam_2019(self.cells);
        scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
        if let Form::Sphere { radius } = &mut scene.form {
            *radius *= SCALE;
        }
        if let GridSpec::Cells { x, y, .. } = &mut scene.grid {
            for edge in x.iter_mut().chain(y) {
                *edge *= SCALE;
            }
        }
        scene.motion.entrainment_speed = self.speed;
        scene.solver.film_cutoff = self.miniature.film_cutoff;
        scene.solver.cavitation = Some(self.cavitation.0);
        let (scheme, face_mobility) = self.law.choices();
        scene.solver.scheme = Some(scheme);
        scene.solver.face_mobility = Some(face_mobility);
        scene
    }
}

/// All contacts with the first law, each on its finest mesh of up to `finest` cells along each side, the
/// finest first.
pub(crate) fn all(finest: usize) -> Vec<Run> {
    let mut runs = Vec::new();
    for seed in SEEDS {
        for Case { miniature, speed, cavitation } in cases() {
            let run = Run { miniature, speed, cavitation, law: LAWS[0], seed, cells: 0 };
            runs.push(Run { cells: finest.min(run.finest()), ..run });
        }
    }
    runs.sort_by_key(|run| std::cmp::Reverse(run.finest()));
    runs
}

/// A scene at a speed under one condition of cavitation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    pub(crate) miniature: Miniature,
    pub(crate) speed: f64,
    pub(crate) cavitation: (Cavitation, &'static str),
}

impl Case {
    fn is_transition(&self) -> bool {
        self.speed.total_cmp(&self.miniature.speeds[1]).is_eq()
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for cavitation in CAVITATIONS {
        for miniature in MINIATURES {
            let speeds = match cavitation.0 {
                Cavitation::Reynolds => &miniature.speeds[1..2],
                _ => &miniature.speeds[..],
            };
            cases.extend(speeds.iter().map(|speed| Case { miniature, speed: *speed, cavitation }));
        }
    }
    cases
}
