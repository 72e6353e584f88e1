//! From a scene to the pieces of a contact problem.

use super::SimError;
use super::scene::{FileRoughness, RandomRoughness, Roughness, Scene, SchemeKind, SolverKind};
use crate::analytic::{FilmConditions, HertzPoint};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{DensityLaw, DowsonHigginson, Roelands, ViscosityLaw};
use crate::metrics::height_statistics;
use crate::reynolds::{Auto, ContactSolver, Dry, NewtonKrylov, Scheme, SemiSystem, StoppingRule};
use crate::surface::{Autocorrelation, RoughnessSpec, generate};

/// Checks what is not checked where it is used.
pub(super) fn validate(scene: &Scene) -> Result<(), InputError> {
    let speed = scene.motion.entrainment_speed;
    InputError::require_non_negative("motion.entrainment_speed", speed)?;
    if scene.is_lubricated() {
        InputError::require_positive("motion.entrainment_speed", speed)?;
        InputError::require_positive("solver.film_cutoff", scene.solver.film_cutoff)?;
    }
    let ratio = scene.motion.slide_roll_ratio;
    InputError::require(ratio.is_finite(), "motion.slide_roll_ratio", ratio, "finite")?;
    let friction = scene.friction;
    InputError::require_non_negative("friction.boundary_coefficient", friction.boundary_coefficient)?;
    InputError::require_positive("friction.limiting_shear_stress", friction.limiting_shear_stress)?;
    InputError::require_positive("thermal.bulk_temperature", scene.thermal.bulk_temperature)?;
    if let Some(plastic) = scene.plastic {
        InputError::require_positive("plastic.hardness", plastic.hardness)?;
        if let Some(film) = plastic.film_hardness {
            InputError::require_positive("plastic.film_hardness", film)?;
        }
    }
    Ok(())
}

/// Heights of one body on the grid \[m\].
pub(super) fn heights(roughness: &Roughness, grid: &Grid, body: &str) -> Result<Vec<f64>, SimError> {
    match roughness {
        Roughness::None => Ok(vec![0.0; grid.len()]),
        Roughness::Gaussian(random) => generated(random, Autocorrelation::Gaussian, grid),
        Roughness::Exponential(random) => generated(random, Autocorrelation::Exponential, grid),
        Roughness::File(file) => measured(file, grid, body),
    }
}

fn generated(random: &RandomRoughness, shape: Autocorrelation, grid: &Grid) -> Result<Vec<f64>, SimError> {
    let spec = RoughnessSpec {
        autocorrelation: shape,
        rq: random.rq,
        length_x: random.length_x,
        length_y: random.length_y,
        seed: random.seed,
    };
    Ok(generate(grid, &spec)?)
}

#[cfg(feature = "formats")]
fn measured(file: &FileRoughness, grid: &Grid, body: &str) -> Result<Vec<f64>, SimError> {
    let surface = crate::surface::read(&file.path)?;
    let mut heights = if surface.dx().is_none() {
        if (surface.nx(), surface.ny()) != (grid.nx(), grid.ny()) {
            return Err(SimError::Input(InputError::Conflict {
                field: format!("roughness.{body}.path"),
                reason: format!(
                    "{} holds {} x {} heights without spacing, the grid has {} x {}",
                    file.path.display(),
                    surface.nx(),
                    surface.ny(),
                    grid.nx(),
                    grid.ny()
                ),
            }));
        }
        surface.heights().to_vec()
    } else {
        surface.fit_to_grid(grid)?
    };
    if let Some(rq) = file.rq {
        InputError::require_non_negative(&format!("roughness.{body}.rq"), rq)?;
        rescale(&mut heights, rq, body)?;
    }
    Ok(heights)
}

#[cfg(not(feature = "formats"))]
fn measured(file: &FileRoughness, _grid: &Grid, body: &str) -> Result<Vec<f64>, SimError> {
    Err(SimError::Input(InputError::Conflict {
        field: format!("roughness.{body}.path"),
        reason: format!("{}: the feature `formats` reads files and is not enabled", file.path.display()),
    }))
}

#[cfg_attr(not(feature = "formats"), expect(dead_code, reason = "only files are rescaled"))]
fn rescale(heights: &mut [f64], rq: f64, body: &str) -> Result<(), InputError> {
    let statistics = height_statistics(heights)?;
    if statistics.sq == 0.0 && rq > 0.0 {
        return Err(InputError::Conflict {
            field: format!("roughness.{body}.rq"),
            reason: "a flat surface cannot be rescaled".to_owned(),
        });
    }
    let factor = if statistics.sq > 0.0 { rq / statistics.sq } else { 0.0 };
    for h in heights {
        *h = (*h - statistics.mean) * factor;
    }
    Ok(())
}

/// The viscosity law of the scene.
pub(super) fn viscosity(scene: &Scene) -> Result<Option<Box<dyn ViscosityLaw>>, InputError> {
    let Some(spec) = scene.lubricant.filter(|_| scene.is_lubricated()) else { return Ok(None) };
    let law = match spec.alpha {
        None => Roelands::new(spec.eta0, spec.roelands_z, spec.roelands_p0)?,
        Some(alpha) => Roelands::from_alpha(spec.eta0, alpha, spec.roelands_z, spec.roelands_p0)?,
    };
    Ok(Some(Box::new(law)))
}

/// The density law of the scene.
pub(super) fn density(scene: &Scene) -> Result<Option<Box<dyn DensityLaw>>, InputError> {
    let Some(spec) = scene.lubricant.filter(|_| scene.is_lubricated()) else { return Ok(None) };
    Ok(Some(Box::new(DowsonHigginson::new(spec.density_a, spec.density_b)?)))
}

/// The solver of the scene.
pub(super) fn solver(scene: &Scene) -> Result<Box<dyn ContactSolver>, InputError> {
    Ok(match scene.solver.kind {
        SolverKind::Auto => Box::new(Auto::new()) as Box<dyn ContactSolver>,
        SolverKind::NewtonKrylov => Box::new(NewtonKrylov::new()),
        SolverKind::Dry => Box::new(Dry::new()),
        SolverKind::SemiSystem => {
            Box::new(SemiSystem::new(scene.solver.relaxation, scene.solver.stiffness)?)
        }
    })
}

pub(super) fn stopping_rule(scene: &Scene) -> Result<StoppingRule, InputError> {
    let rule =
        StoppingRule { tolerance: scene.solver.tolerance, max_iterations: scene.solver.max_iterations };
    rule.validate()?;
    Ok(rule)
}

pub(super) fn scheme(scene: &Scene) -> Scheme {
    match scene.solver.scheme {
        SchemeKind::FirstOrder => Scheme::FirstOrder,
    }
}

/// Conditions of the film formulas; none without a lubricant.
pub(super) fn film_conditions(
    scene: &Scene,
    hertz: &HertzPoint,
    viscosity: Option<&dyn ViscosityLaw>,
) -> Option<FilmConditions> {
    let law = viscosity?;
    Some(FilmConditions {
        entrainment_speed: scene.motion.entrainment_speed,
        viscosity: law.viscosity(0.0),
        pressure_viscosity: law.log_slope(0.0),
        equivalent_modulus: scene.elastic.equivalent_modulus,
        radius: scene.form.radii().0,
        load: hertz.load,
        ellipticity: hertz.a_y / hertz.a_x,
    })
}
