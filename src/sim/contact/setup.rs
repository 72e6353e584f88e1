//! Construction of the parts of a contact problem from a scene.
//!
//! One function per part: it reads the values of the scene, rejects values out of range with their key, and builds the
//! law, the solver or the heights. `ContactModel::new` calls them in order. A new named law is built here.

use crate::error::{InputError, format_number};
use crate::grid::Grid;
use crate::lubricant::DowsonHigginson;
use crate::metrics::mean_central_film_in;
use crate::reynolds::{
    AsperityInlets, Auto, Dry, Multigrid, NewtonKrylov, SemiSystem, StoppingRule, require_speed,
};
use crate::sim::contact::asperity_inlets;
use crate::sim::contact::boxed_clone::OwnedSolver;
use crate::sim::contact::friction_laws::boundary_law;
pub(in crate::sim) use crate::sim::contact::memory::validate_memory;
use crate::sim::contact::oil::viscosity_law;
use crate::sim::contact::strip;
use crate::sim::contact::warnings::{Warning, reject_units};
use crate::sim::error::SimError;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{FileRoughness, Roughness, Scene, SolverKind};
#[cfg(feature = "formats")]
use crate::surface::rescale;

/// Largest contact film over the smallest radius of the form.
const LARGEST_CUTOFF: f64 = 1e-3;
/// Least distance of an edge of a lubricated box from the middle, in Hertz half-widths.
const LEAST_ROOM: f64 = 0.5;

/// Checks all values of the scene except form, load, grid and roughness, used or not.
pub(in crate::sim) fn validate(scene: &Scene) -> Result<(), InputError> {
    validate_motion(scene)?;
    let friction = scene.friction;
    boundary_law(&friction, None)?;
    if let (Some(thickness), None) = (friction.covering_thickness, friction.film_coefficient) {
        return Err(InputError::Conflict {
            field: format!("friction.covering_thickness = {thickness:e}"),
            reason: "friction.film_coefficient is missing".to_owned(),
        });
    }
    friction.rheology()?;
    friction.shear_thinning(scene.motion.sliding_speed())?;
    scene.validate_materials()?;
    scene.layer()?;
    scene.bonded_films()?;
    if let Some(stress) = scene.stress {
        stress.validate(scene)?;
    }
    if let Some(bearing) = scene.bearing {
        bearing.rated_viscosity()?;
    }
    let thermal = scene.thermal;
    InputError::require_positive("thermal.bulk_temperature", thermal.bulk_temperature)?;
    InputError::require_positive("thermal.conductivity", thermal.conductivity)?;
    InputError::require_positive("thermal.diffusivity", thermal.diffusivity)?;
    validate_plastic(scene)?;
    validate_lubricant(scene)?;
    if let Some(spec) = scene.tribofilm {
        spec.law()?;
    }
    scene.track.validate()?;
    if let Some(wear) = scene.wear {
        wear.validate()?;
    }
    InputError::require_positive("solver.film_cutoff", scene.solver.film_cutoff)?;
    SemiSystem::new(scene.solver.relaxation, scene.solver.stiffness)?;
    if let Some(accuracy) = scene.solver.accuracy {
        validate_accuracy("solver.accuracy", accuracy)?;
    }
    stopping_rule(scene)?;
    asperity_inlets::validate(scene)?;
    strip::validate(scene)?;
    reject_units(scene)
}

/// Checks speeds of the surfaces.
fn validate_motion(scene: &Scene) -> Result<(), InputError> {
    let speed = scene.motion.entrainment_speed;
    if scene.is_lubricated() && scene.schedule.entrainment_speed.is_none() {
        require_speed("motion.entrainment_speed", speed)?;
    }
    let requirement =
        "finite and >= 0: the surfaces move along +x; mirror the scene in x for the other direction";
    InputError::require(speed.is_finite() && speed >= 0.0, "motion.entrainment_speed", speed, requirement)?;
    let ratio = scene.motion.slide_roll_ratio;
    InputError::require(ratio.is_finite(), "motion.slide_roll_ratio", ratio, "finite")
}

/// Checks the pressure limit.
fn validate_plastic(scene: &Scene) -> Result<(), InputError> {
    let Some(plastic) = scene.plastic else { return Ok(()) };
    InputError::require_positive("plastic.hardness", plastic.hardness)?;
    if let Some(film) = plastic.film_hardness {
        InputError::require_positive("plastic.film_hardness", film)?;
    }
    if let Some(modulus) = plastic.hardening_modulus {
        InputError::require_non_negative("plastic.hardening_modulus", modulus)?;
    }
    Ok(())
}

/// Checks the laws of the oil and its supply.
fn validate_lubricant(scene: &Scene) -> Result<(), InputError> {
    let Some(spec) = scene.lubricant else { return Ok(()) };
    viscosity_law(&spec, scene.thermal.bulk_temperature)?;
    DowsonHigginson::new(spec.density_a, spec.density_b)?;
    if let Some(properties) = spec.thermal {
        properties.validate().map_err(|error| error.within("lubricant.thermal"))?;
    }
    if let Some(alpha) = spec.formula_alpha {
        InputError::require_positive("lubricant.formula_alpha", alpha)?;
    }
    if let Some(film) = spec.supplied_film {
        InputError::require_positive("lubricant.supplied_film", film)?;
        if scene.is_lubricated() {
            scene.cavitation().require_conserved("lubricant.supplied_film", film)?;
        }
    }
    Ok(())
}

/// Checks a target relative error of the mesh.
pub(in crate::sim) fn validate_accuracy(field: &str, accuracy: f64) -> Result<(), InputError> {
    InputError::require((1e-4..=0.1).contains(&accuracy), field, accuracy, "between 1e-4 and 0.1")
}

/// Checks that the box contains the point of first contact and resolves the contact.
pub(in crate::sim) fn validate_box(
    grid: &Grid,
    hertz: &HertzContact,
    is_line: bool,
) -> Result<(), InputError> {
    for (field, n, free) in [("grid.nx", grid.nx(), false), ("grid.ny", grid.ny(), is_line)] {
        InputError::require(free || n >= 5, field, n as f64, "at least 5 for a contact solve")?;
    }
    let axes = [
        ("grid.x", grid.x(0) - 0.5 * grid.dx(), grid.size_x()),
        ("grid.y", grid.y(0) - 0.5 * grid.dy(), grid.size_y()),
    ];
    for (field, low, size) in axes {
        if low > 0.0 || low + size < 0.0 {
            return Err(InputError::Conflict {
                field: field.to_owned(),
                reason: format!(
                    "the bodies touch at 0, outside the box from {low:.6e} to {:.6e}",
                    low + size
                ),
            });
        }
    }
    let zeros = vec![0.0; grid.len()];
    mean_central_film_in(grid, &zeros, &hertz.ellipse()).map_err(|_| InputError::Conflict {
        field: "grid".to_owned(),
        reason: format!(
            "no node lies within two thirds of the Hertz half-widths {:.6e} x {:.6e} m, the cells are {:.6e} x {:.6e} m; a smaller box, or more cells",
            hertz.half_width_x,
            hertz.half_width_y,
            grid.dx(),
            grid.dy()
        ),
    })?;
    Ok(())
}

/// Checks that the box of a lubricated contact reaches beyond half of the Hertz contact.
pub(in crate::sim) fn validate_room(
    scene: &Scene,
    grid: &Grid,
    hertz: &HertzContact,
) -> Result<(), InputError> {
    let [half_x, half_y] = hertz.half_extents();
    let axes = [("grid.x", grid.x(0), grid.dx(), half_x), ("grid.y", grid.y(0), grid.dy(), half_y)];
    let with_edges = if grid.has_side_edges() { 2 } else { 1 };
    for ((field, first, step, half_width), count) in
        axes.into_iter().zip([grid.nx(), grid.ny()]).take(with_edges)
    {
        let low = first - 0.5 * step;
        let nearest = (-low).min(low + step * count as f64);
        if scene.is_lubricated() && nearest < LEAST_ROOM * half_width {
            return Err(InputError::Conflict {
                field: field.to_owned(),
                reason: format!(
                    "the box ends {nearest:.4e} m from the middle, inside of the contact with a Hertz half-width of {half_width:.4e} m; at \
                     least from {:.4e} to {:.4e} m",
                    -1.5 * half_width,
                    1.5 * half_width
                ),
            });
        }
    }
    Ok(())
}

/// Checks that the contact film is small enough for the parabolic form.
pub(in crate::sim) fn validate_film_cutoff(scene: &Scene) -> Result<(), InputError> {
    let (radius_x, radius_y) = scene.form.radii();
    let cutoff = scene.solver.film_cutoff;
    InputError::require(
        cutoff <= LARGEST_CUTOFF * radius_x.min(radius_y),
        "solver.film_cutoff",
        cutoff,
        "at most a thousandth of the smallest radius of the form",
    )
}

/// Checks that a uniform `hardness` \[Pa\] can carry the load on the inner nodes.
pub(in crate::sim) fn validate_hardness(
    hardness: f64,
    grid: &Grid,
    hertz: &HertzContact,
) -> Result<(), InputError> {
    let rows = if grid.has_side_edges() { grid.ny().saturating_sub(2) } else { grid.ny() };
    let nodes = grid.nx().saturating_sub(2) * rows;
    let largest = hardness * nodes as f64 * grid.cell_area();
    if nodes == 0 || hertz.force < largest {
        return Ok(());
    }
    let (length, unit) = (grid.contact_length(), if grid.has_side_edges() { "N" } else { "N/m" });
    Err(InputError::Conflict {
        field: format!("plastic.hardness = {}", format_number(hardness)),
        reason: format!(
            "the box carries less than {:.6e} {unit} at this pressure, the load is {:.6e} {unit}; a larger \
             hardness, less load or a wider box",
            largest / length,
            hertz.force / length
        ),
    })
}

/// The rough surface of one body.
pub(in crate::sim) struct RoughBody {
    /// Heights on the grid \[m\].
    pub(in crate::sim) heights: Vec<f64>,
    /// Rq of the measurement \[m\]; `None` for generated heights.
    pub(in crate::sim) measured_rq: Option<f64>,
    /// Doubts about the file that they are read from.
    pub(in crate::sim) file_warnings: Vec<Warning>,
}

/// Heights of one body on the grid.
pub(in crate::sim) fn heights(roughness: &Roughness, grid: &Grid, body: &str) -> Result<RoughBody, SimError> {
    if let Roughness::File(file) = roughness {
        return measured(file, grid, body);
    }
    let heights = generated(roughness, grid).map_err(|error| of_body(error, body))?;
    Ok(RoughBody { heights, measured_rq: None, file_warnings: Vec::new() })
}

/// The mesh of the box of `grid` on which the heights of one body are drawn.
pub(in crate::sim) fn own_mesh(roughness: &Roughness, grid: &Grid, body: &str) -> Result<Grid, InputError> {
    match roughness {
        Roughness::Random(surface) => surface.own_mesh(grid).map_err(|error| of_body(error, body)),
        _ => Ok(*grid),
    }
}

/// Heights of a generated surface.
fn generated(roughness: &Roughness, grid: &Grid) -> Result<Vec<f64>, InputError> {
    match roughness {
        Roughness::Random(surface) => surface.generate(grid),
        Roughness::Texture(texture) => texture.generate(grid),
        Roughness::None | Roughness::File(_) => Ok(vec![0.0; grid.len()]),
    }
}

impl Roughness {
    /// Heights on `grid` \[m\], positive out of the body, as in a scene with this roughness.
    ///
    /// # Errors
    /// A value that is out of range or does not fit the grid; a file that cannot be read.
    ///
    /// ```
    /// use stribeck::{Grid, sim::scene::Roughness};
    /// let grid = Grid::centred(64, 64, 2e-6, 2e-6)?;
    /// let heights = Roughness::gaussian(50e-9, 20e-6, 1).heights(&grid)?;
    /// assert!((stribeck::metrics::height_statistics(&heights)?.sq / 50e-9 - 1.0).abs() < 1e-9);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn heights(&self, grid: &Grid) -> Result<Vec<f64>, SimError> {
        match self {
            Self::File(file) => Ok(measured(file, grid, "file")?.heights),
            _ => Ok(generated(self, grid)?),
        }
    }
}

/// The error with the key of the body before the field.
fn of_body(mut error: InputError, body: &str) -> InputError {
    if let InputError::Value { field, .. } | InputError::Conflict { field, .. } = &mut error {
        let key = field.strip_prefix("roughness.").or(field.strip_prefix("texture.")).unwrap_or(field);
        *field = format!("roughness.{body}.{key}");
    }
    error
}

#[cfg(feature = "formats")]
fn measured(file: &FileRoughness, grid: &Grid, body: &str) -> Result<RoughBody, SimError> {
    if let Some(rq) = file.rq {
        InputError::require_non_negative(&format!("roughness.{body}.rq"), rq)?;
    }
    let unusable = |reason: String| InputError::Conflict { field: format!("roughness.{body}.path"), reason };
    let mut surface = crate::surface::read(&file.path).map_err(|error| unusable(error.to_string()))?;
    let unfit = |error| unusable(format!("{}: {error}", file.path.display()));
    let file_warnings = crate::sim::contact::warnings::of_file(body, &surface);
    let mut measured_rq = None;
    let mut heights = if surface.dx().is_none() {
        if (surface.nx(), surface.ny()) != (grid.nx(), grid.ny()) {
            return Err(SimError::Input(unusable(format!(
                "{} holds {} x {} heights without spacing, the grid has {} x {}",
                file.path.display(),
                surface.nx(),
                surface.ny(),
                grid.nx(),
                grid.ny()
            ))));
        }
        surface.fill_undefined().map_err(unfit)?;
        surface.heights().to_vec()
    } else {
        let level = surface.levelled().map_err(unfit)?;
        measured_rq = Some(crate::metrics::height_statistics(level.heights())?.sq);
        level.mean_free_on(grid).map_err(unfit)?
    };
    if let Some(rq) = file.rq {
        rescale(&mut heights, grid.nx(), |_| true, rq).ok_or_else(|| InputError::Conflict {
            field: format!("roughness.{body}.rq"),
            reason: "a flat surface cannot be rescaled".to_owned(),
        })?;
        measured_rq = None;
    }
    Ok(RoughBody { heights, measured_rq, file_warnings })
}

#[cfg(not(feature = "formats"))]
fn measured(file: &FileRoughness, _grid: &Grid, body: &str) -> Result<RoughBody, SimError> {
    Err(SimError::Input(InputError::Conflict {
        field: format!("roughness.{body}.path"),
        reason: format!("{}: the feature `formats` reads files and is not enabled", file.path.display()),
    }))
}

/// The solver of the scene.
pub(in crate::sim) fn solver(scene: &Scene) -> Result<Box<dyn OwnedSolver>, InputError> {
    let edge_contact = scene.solver.edge_contact;
    if !scene.solver.model.is_resolved() {
        return Ok(match edge_contact {
            true => Box::new(AsperityInlets::allowing_edge_contact()),
            false => Box::new(AsperityInlets::new()),
        });
    }
    Ok(match scene.solver.kind {
        SolverKind::Auto if edge_contact => Box::new(Auto::allowing_edge_contact()) as Box<dyn OwnedSolver>,
        SolverKind::Auto => Box::new(Auto::new()),
        SolverKind::NewtonKrylov => Box::new(NewtonKrylov::new()),
        SolverKind::Multigrid => Box::new(Multigrid::new()),
        SolverKind::Dry if edge_contact => Box::new(Dry::allowing_edge_contact()),
        SolverKind::Dry => Box::new(Dry::new()),
        SolverKind::SemiSystem => Box::new(SemiSystem::new(scene.solver.relaxation, scene.solver.stiffness)?),
    })
}

/// Tolerance and largest number of iterations.
pub(in crate::sim) fn stopping_rule(scene: &Scene) -> Result<StoppingRule, InputError> {
    let rule =
        StoppingRule { tolerance: scene.solver.tolerance, max_iterations: scene.solver.max_iterations };
    rule.validate()?;
    Ok(rule)
}
