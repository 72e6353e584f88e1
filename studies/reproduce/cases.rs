//! The scene in its variants: the default, the contact film, the model as published, and what refines the
//! default.

use stribeck::reynolds::{Cavitation, ContactDefinition, FaceMobility, Scheme};
use stribeck::sim::Scene;
use stribeck::sim::scene::{GridSpec, Roughness, SolverModel};

/// Time of the test \[s\].
pub(crate) const TEST_TIME: f64 = 7200.0;
/// Cells of 7.8 um, on which the roughness of a box of 0.5 mm is made; finer meshes get it by its Fourier
/// series.
const CELLS: usize = 64;
const BOX: f64 = 0.5e-3;
const STEPS: u64 = 720;
/// Bound of every residual of a solve: one solve stands for hundreds of passages at one position of the
/// roughness, and its numbers scatter by some 10 % from one position to the next.
const TOLERANCE: f64 = 1e-3;

/// One variant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    /// Name of its files and columns.
    pub(crate) name: &'static str,
    /// Cells along each side on which the roughness is made.
    pub(crate) surface_cells: usize,
    /// Cells along each side of the contact.
    pub(crate) cells: usize,
    /// Length of each side \[m\].
    pub(crate) side: f64,
    pub(crate) steps: u64,
    /// Roughness seeds, from 1 on.
    pub(crate) seeds: u64,
    /// What is changed in the scene.
    pub(crate) change: fn(&mut Scene),
}

/// The default.
const DEFAULT: Case = Case {
    name: "default",
    surface_cells: CELLS,
    cells: CELLS,
    side: BOX,
    steps: STEPS,
    seeds: 8,
    change: |_| {},
};

/// All variants, in the order of the tables.
pub(crate) const CASES: [Case; 14] = [
    DEFAULT,
    Case { name: "contact_film_2nm", change: |scene| scene.solver.film_cutoff = 2e-9, ..DEFAULT },
    Case { name: "contact_film_5nm", change: |scene| scene.solver.film_cutoff = 5e-9, ..DEFAULT },
    Case { name: "contact_film_10nm", change: |scene| scene.solver.film_cutoff = 10e-9, ..DEFAULT },
    Case { name: "steps_2880", steps: 2880, seeds: 4, ..DEFAULT },
    Case { name: "steps_240", steps: 240, seeds: 2, ..DEFAULT },
    Case { name: "box_0.75mm", surface_cells: 96, cells: 96, side: 0.75e-3, steps: 240, seeds: 2, ..DEFAULT },
    Case { name: "mesh_64", steps: 40, seeds: 2, ..DEFAULT },
    Case { name: "mesh_128", cells: 128, steps: 40, seeds: 2, ..DEFAULT },
    Case { name: "mesh_256", cells: 256, steps: 40, seeds: 1, ..DEFAULT },
    Case { name: "inlets_128", cells: 128, steps: 40, seeds: 2, change: inlets, ..DEFAULT },
    Case { name: "inlets_512", cells: 512, steps: 40, seeds: 1, change: inlets, ..DEFAULT },
    Case { name: "published_flow", steps: 40, seeds: 2, change: published_flow, ..DEFAULT },
    Case { name: "published", steps: 40, seeds: 2, change: published, ..DEFAULT },
];

/// Flow and cavitation as published: first-order entrainment, arithmetic means of the mobilities, Reynolds'
/// condition. Solid contact is the crate's.
fn published_flow(scene: &mut Scene) {
    scene.solver.scheme = Some(Scheme::FirstOrder);
    scene.solver.face_mobility = Some(FaceMobility::Arithmetic);
    scene.solver.cavitation = Some(Cavitation::Reynolds);
}

/// Contacts by the inlets of their asperities.
fn inlets(scene: &mut Scene) {
    scene.solver.model = SolverModel::AsperityInlets;
}

/// Flow, cavitation and solid contact as published. Its sweeps take seven thousand convolutions to a residual
/// of a hundredth and a quarter of that to a tenth, with load and area ratio within 0.001.
fn published(scene: &mut Scene) {
    scene.solver.contact = ContactDefinition::UnifiedReynolds;
    scene.solver.tolerance = 0.1;
}

impl Case {
    /// The same, small enough for a check: half the cells, ten steps of 10 s, one seed.
    pub(crate) fn quick(self) -> Self {
        let (surface_cells, cells) = (self.surface_cells / 2, self.cells / 2);
        Self { surface_cells, cells, steps: 10, seeds: 1, ..self }
    }

    /// The scene, with or without tribofilm.
    pub(crate) fn scene(&self, seed: u64, film: bool) -> Scene {
        let mut scene = Scene::azam_2019(self.cells);
        if film {
            scene = scene.with_tribofilm();
        }
        let half = 0.5 * self.side;
        scene.grid = GridSpec::Cells { nx: self.cells, ny: self.cells, x: [-half, half], y: [-half, half] };
        for (body, seed) in [(&mut scene.roughness.ball, 2 * seed - 1), (&mut scene.roughness.disc, 2 * seed)]
        {
            if let Roughness::Random(random) = body {
                random.seed = seed;
            }
        }
        scene.solver.tolerance = TOLERANCE;
        scene.track.seed = seed;
        (self.change)(&mut scene);
        scene
    }
}
