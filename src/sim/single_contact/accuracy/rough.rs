//! A rough contact on meshes of halved cells: the surface is its Fourier series, errors are estimated.
//!
//! A rough contact has no order of convergence: asperities touch on one mesh and not on the next. Errors of
//! a mesh are estimated from the change since the mesh of half as many cells along each side
//! (`contact::mesh_error`);
//! meshes are refined until the estimate is below the accuracy. The Fourier series of the surface is
//! evaluated on each mesh, so the surface is the same on all. Without given cells, box and cells follow from
//! the spectra of the random surfaces, which must have a shortest wavelength.

use super::WorkUsed;
use super::plan::Plan;
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::report::Status;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::mesh_error::{self, CELLS_IN_HALF_WIDTH, Surfaces, require_half};
use crate::sim::contact::numbers::FrictionNumbers;
use crate::sim::contact::setup;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::scene::{GridSpec, Roughness, Scene, ShortestWaves};
use crate::sim::single_contact::prepared::{PreparedContact, prepare_heights};
use crate::surface::{HeightDistribution, RandomShape};

/// Largest number of nodes of a mesh.
pub(super) const MAX_NODES: usize = 1 << 20;
/// Cells per length over which a Gaussian autocorrelation falls to 10 %, and per shortest wavelength of a
/// self-affine surface. With a Gaussian autocorrelation the spectral density of waves shorter than two such
/// cells is below 1e-4 of its maximum.
const CELLS_IN_LENGTH: f64 = 3.0;
/// Outside the Hertz circle the gap is `1.2 e^1.5 a^2/R` at the distance `e a`. Asperities touch across gaps
/// up to five times Rq.
const GAP_BEYOND: f64 = 1.2;
/// Highest asperities in units of Rq.
const REACH: f64 = 5.0;
/// Margin between the outermost possible asperity contact and the edge of the box, in Hertz half-widths.
const ROOM: f64 = 0.3;

/// A contact on half the cells of its scene, on these cells, and on successively finer meshes.
pub(in crate::sim) struct Halving {
    /// The scene; its grid is the requested mesh.
    scene: Scene,
    /// Target error.
    accuracy: f64,
    /// Scene key that requests the estimate.
    field: &'static str,
    /// Heights of both bodies on any mesh.
    surfaces: Surfaces,
    /// Interrupt of the solve.
    interrupt: Option<Interrupt>,
    /// The contact on half the cells.
    half: PreparedContact,
    /// The contact on the requested mesh.
    whole: PreparedContact,
}

impl Halving {
    /// The first two meshes of `scene`. Its key `field` requests the `accuracy`; infinity accepts any error.
    pub(super) fn new(
        scene: Scene,
        accuracy: f64,
        field: &'static str,
        interrupt: Option<&Interrupt>,
    ) -> Result<Self, SimError> {
        let surfaces = surfaces(&scene, field)?;
        let mut halved = Scene { grid: scene.grid.with_counts(|n| n.div_ceil(2)), ..scene.clone() };
        // Whether the contact reaches the edge of the box is checked on the requested mesh only.
        halved.solver.edge_contact = true;
        // Errors of the scene itself come first, without a word about half the cells.
        let whole = on(&scene, &surfaces, interrupt)?;
        let half = on(&halved, &surfaces, interrupt).map_err(|error| on_half(error, field))?;
        Ok(Self { scene, accuracy, field, surfaces, interrupt: interrupt.cloned(), half, whole })
    }

    /// The warnings before the first solve.
    pub(super) fn into_warnings(self) -> Vec<Warning> {
        self.whole.warnings
    }

    /// Refines until the largest of the four estimated errors is at most the accuracy, a mesh does not converge,
    /// or the next one would be too large.
    pub(super) fn solve(
        self,
        observer: &mut dyn FnMut(&ContactSolution),
    ) -> Result<ContactSolution, SimError> {
        let Self { mut scene, accuracy, field, surfaces, interrupt, half, whole } = self;
        let mut coarse = half.solve().map_err(|error| on_half(error, field))?;
        let mut contact = whole;
        let mut work = WorkUsed::default();
        work.add(&coarse);
        observer(&coarse);
        loop {
            let mut solution = contact.solve()?;
            work.add(&solution);
            solution.error_estimate = mesh_error::estimate(&(&coarse).into(), &(&solution).into());
            observer(&solution);
            let FrictionNumbers { coefficient, fluid, .. } = solution.friction;
            let error = solution.error_estimate.map_or(f64::INFINITY, |e| e.of_cells([coefficient, fluid]));
            let finer = Scene { grid: scene.grid.with_counts(|n| 2 * n), ..scene.clone() };
            let unsolved = solution.report.status != Status::Converged;
            if error <= accuracy || unsolved || !is_affordable(&finer) {
                solution.report.work = work.on(&solution.grid);
                return Ok(solution);
            }
            contact = on(&finer, &surfaces, interrupt.as_ref())?;
            (coarse, scene) = (solution, finer);
        }
    }
}

/// The contact on the mesh of `scene`.
fn on(
    scene: &Scene,
    surfaces: &Surfaces,
    interrupt: Option<&Interrupt>,
) -> Result<PreparedContact, SimError> {
    prepare_heights(scene, interrupt, surfaces.on(&scene.grid()?)?)
}

/// Whether a mesh has at most [`MAX_NODES`] nodes and fits the allowed memory.
fn is_affordable(scene: &Scene) -> bool {
    scene.grid().is_ok_and(|grid| {
        grid.len() <= MAX_NODES && setup::validate_memory(&grid, scene.is_lubricated()).is_ok()
    })
}

/// The surfaces of a scene that can be halved in cells too.
fn surfaces(scene: &Scene, field: &str) -> Result<Surfaces, SimError> {
    setup::validate(scene)?;
    let grid = scene.grid()?;
    setup::validate_box(&grid, &scene.hertz()?, scene.form.is_line())?;
    setup::validate_memory(&grid, scene.is_lubricated())?;
    require_half(scene, field)?;
    Surfaces::new(scene, &grid)
}

/// An error on the mesh of half the cells.
fn on_half(error: SimError, field: &str) -> SimError {
    match error {
        SimError::Input(error) => SimError::Input(InputError::Conflict {
            field: field.to_owned(),
            reason: format!("on half the cells along each side: {error}"),
        }),
        other => other,
    }
}

/// The box of the smooth contact, enlarged to contain all asperities that may touch, with cells that resolve
/// the waves of the random surfaces.
pub(super) fn cells_of_waves(scene: &Scene, accuracy: f64) -> Result<GridSpec, SimError> {
    setup::validate(scene)?;
    let hertz = scene.hertz()?;
    let Waves { lengths: [along_x, along_y], rq } = waves(scene)?;
    let plan = Plan::of(scene, &hertz, accuracy)?.with_layer(scene)?;
    let depth = GAP_BEYOND * hertz.half_width_x.powi(2) / scene.form.radii().0;
    let reach = 1.0 + (REACH * rq / depth).powf(2.0 / 3.0) + ROOM;
    let [half_x, half_y] = hertz.half_extents();
    let x = [-plan.inlet.max(reach) * half_x, plan.outlet.max(reach) * half_x];
    let side = plan.side.max(reach) * half_y;
    let y = [-side, side];
    let cells = |[low, high]: [f64; 2], length: f64, axis: f64| {
        ((high - low) / (length / CELLS_IN_LENGTH).min(axis / CELLS_IN_HALF_WIDTH)).ceil()
    };
    let line = scene.form.is_line();
    let (nx, ny) = (cells(x, along_x, half_x), if line { 1.0 } else { cells(y, along_y, half_y) });
    if nx * ny > MAX_NODES as f64 {
        return Err(SimError::Input(InputError::Conflict {
            field: "grid.accuracy".to_owned(),
            reason: format!("the waves of the surfaces need {:.2e} nodes, more than {MAX_NODES}", nx * ny),
        }));
    }
    let (nx, ny) = (nx as usize, ny as usize);
    Ok(if line { GridSpec::Row { nx, x } } else { GridSpec::Cells { nx, ny, x, y } })
}

/// The random surfaces of both bodies.
struct Waves {
    /// Shortest correlation lengths or wavelengths along x and y \[m\].
    lengths: [f64; 2],
    /// Root mean square of the heights of both \[m\].
    rq: f64,
}

/// Whether the heights are normal and periodic, as far as the scene says.
fn is_normal(roughness: &Roughness) -> bool {
    match roughness {
        Roughness::Random(surface) => {
            surface.distribution == HeightDistribution::Normal && surface.boundary == Boundary::Periodic
        }
        Roughness::Texture(_) => false,
        _ => true,
    }
}

/// Shortest lengths and combined Rq. Rejects surfaces with waves of every length, heights that are not normal
/// or not periodic, and files; the error names the key to change.
fn waves(scene: &Scene) -> Result<Waves, SimError> {
    let needs_cells = |field: String, reason: &str| {
        let reason =
            format!("{reason}: give nx, ny, x and y, the cells that hold the surface, and solver.accuracy");
        Err(SimError::Input(InputError::Conflict { field, reason }))
    };
    let (mut lengths, mut square) = ([f64::INFINITY; 2], 0.0);
    for (roughness, body) in [(&scene.roughness.ball, "ball"), (&scene.roughness.disc, "disc")] {
        if roughness.is_smooth() {
            continue;
        }
        let key = |name: &str| format!("roughness.{body}.{name}");
        match (roughness, roughness.shortest_waves()) {
            _ if !is_normal(roughness) => {
                return needs_cells(
                    format!("roughness.{body}"),
                    "only normal heights that are periodic are refined without cells",
                );
            }
            (_, ShortestWaves::Of(shortest)) => {
                let rq = roughness.rq().unwrap_or(0.0);
                InputError::require_non_negative(&key("rq"), rq)?;
                square += rq.powi(2);
                let of_length = matches!(
                    roughness,
                    Roughness::Random(surface) if matches!(surface.shape, RandomShape::Correlated { .. })
                );
                let names = if of_length { ["length_x", "length_y"] } else { ["shortest"; 2] };
                for (axis, least) in lengths.iter_mut().enumerate() {
                    InputError::require_positive(&key(names[axis]), shortest[axis])?;
                    *least = least.min(shortest[axis]);
                }
            }
            (Roughness::Random(surface), ShortestWaves::Endless)
                if matches!(surface.shape, RandomShape::Correlated { .. }) =>
            {
                return needs_cells(
                    format!("roughness.{body}.kind = \"exponential\""),
                    "the surface has waves of every length and no finest ones to refine",
                );
            }
            (_, ShortestWaves::Endless) => {
                return needs_cells(
                    key("shortest"),
                    "without it the surface has waves of every length and no finest ones to refine",
                );
            }
            (Roughness::File(file), _) => {
                return needs_cells(
                    format!("roughness.{body}.path = {}", file.path.display()),
                    "the box that the heights belong to is not known",
                );
            }
            (_, ShortestWaves::Unknown) => {}
        }
    }
    Ok(Waves { lengths, rq: square.sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::scene::LayerSpec;

    #[test]
    fn soft_layer_widens_the_box() {
        let mut scene = Scene::azam_2019(32);
        scene.lubricant = None;
        scene.roughness.ball = Roughness::gaussian(1e-9, 40e-6, 1);
        scene.roughness.disc = Roughness::None;
        let inlet = |scene: &Scene| match cells_of_waves(scene, 0.01).unwrap() {
            GridSpec::Cells { x: [low, _], .. } => low,
            other => panic!("{other:?}"),
        };
        let bare = inlet(&scene);
        let soft = LayerSpec::new(50e-6, 1e9, 0.3);
        scene.elastic.layer =
            Some(soft.with_substrate_modulus(Some(210e9)).with_substrate_poisson(Some(0.3)));
        assert!(inlet(&scene) < 1.5 * bare, "{} and {bare}", inlet(&scene));
    }
}
