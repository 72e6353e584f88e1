//! Grid, elastic bodies and lubricant of a contact, from custom components or the scene.

use crate::elastic::{HalfSpace, LayeredHalfSpace, LineHalfSpace, StripHalfSpace};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{DensityLaw, Lubricant, ViscosityLaw};
use crate::reynolds::{ContactDefinition, require_spin};
use crate::sim::contact::boxed_clone::{OwnedModel, OwnedSolver};
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::{custom_laws, oil, setup};
use crate::sim::error::SimError;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{PlasticSpec, Scene};

/// Custom components that replace parts of the scene.
#[derive(Debug, Default)]
pub(in crate::sim) struct CustomComponents {
    /// Elastic bodies.
    pub(in crate::sim) deformation: Option<Box<dyn OwnedModel>>,
    /// Viscosity law.
    pub(in crate::sim) viscosity: Option<Box<dyn ViscosityLaw>>,
    /// Density law.
    pub(in crate::sim) density: Option<Box<dyn DensityLaw>>,
    /// Solver, whose solutions are verified.
    pub(in crate::sim) solver: Option<Box<dyn OwnedSolver>>,
    /// Whether the caller verifies its solutions.
    pub(in crate::sim) is_checked: bool,
    /// Interrupt of solves.
    pub(in crate::sim) interrupt: Option<Interrupt>,
}

/// The grid of a scene whose values are in range and whose box contains the contact.
pub(in crate::sim) fn validated_grid(scene: &Scene) -> Result<Grid, SimError> {
    setup::validate(scene)?;
    let grid = scene.grid()?;
    let hertz = scene.hertz()?;
    setup::validate_box(&grid, &hertz, scene.form.is_line())?;
    setup::validate_room(scene, &grid, &hertz)?;
    if let Some(radius) = scene.motion.spin_radius {
        let supplied = scene.lubricant.is_some_and(|lubricant| lubricant.supplied_film.is_some());
        let is_paper = scene.solver.contact != ContactDefinition::Hard;
        require_spin(("motion.spin_radius", radius), &grid, supplied, is_paper)?;
    }
    setup::validate_film_cutoff(scene)?;
    setup::validate_memory(&grid, scene.is_lubricated())?;
    Ok(grid)
}

/// Custom laws of viscosity and density.
pub(in crate::sim) type CustomOil = (Option<Box<dyn ViscosityLaw>>, Option<Box<dyn DensityLaw>>);

/// The lubricant at `temperature` \[K\], by custom laws or those of the scene; `None` for a dry scene.
pub(in crate::sim) fn lubricant(
    scene: &Scene,
    temperature: f64,
    (viscosity, density): CustomOil,
) -> Result<Option<Lubricant>, InputError> {
    let given = [("viscosity", viscosity.is_some()), ("density", density.is_some())];
    if let (None, Some((law, _))) = (&scene.lubricant, given.iter().find(|(_, given)| *given)) {
        return Err(InputError::Conflict {
            field: (*law).to_owned(),
            reason: "a law is given, but the scene has no lubricant".to_owned(),
        });
    }
    let viscosity = match viscosity {
        None => oil::viscosity(scene, temperature)?,
        Some(law) => {
            let law = law.at_temperature(temperature).unwrap_or(law);
            custom_laws::require_viscosity(&*law, temperature)?;
            Some(law)
        }
    };
    let density = match density {
        None => oil::density(scene, temperature)?,
        Some(law) => {
            let law = law.at_temperature(temperature).unwrap_or(law);
            custom_laws::require_density(&*law)?;
            Some(law)
        }
    };
    Ok(match (scene.is_lubricated(), viscosity, density) {
        (true, Some(viscosity), Some(density)) => Some(Lubricant::from_boxed(viscosity, density)),
        _ => None,
    })
}

/// Checks that the grid and the hardness of `plastic`, if any, suffice for the smallest and the largest load of the
/// schedule.
pub(in crate::sim) fn validate_loads(
    scene: &Scene,
    plastic: Option<PlasticSpec>,
    grid: &Grid,
    operating_schedule: &OperatingSchedule,
) -> Result<(), InputError> {
    if scene.schedule.load.is_none() {
        return Ok(());
    }
    for load in operating_schedule.loads() {
        let hertz = scene.hertz_under(load)?.on(grid);
        setup::validate_box(grid, &hertz, scene.form.is_line())?;
        if let Some(plastic) = plastic {
            let [ball, disc] = scene.hardnesses(plastic.hardness);
            setup::validate_hardness(ball.min(disc), grid, &hertz)?;
        }
    }
    Ok(())
}

/// The custom elastic model, or that of the scene. It must be on the grid and have a positive stiffness.
pub(in crate::sim) fn checked_deformation(
    scene: &Scene,
    grid: Grid,
    own: Option<Box<dyn OwnedModel>>,
) -> Result<Box<dyn OwnedModel>, SimError> {
    let own_deformation = own.is_some();
    let deformation = match own {
        Some(model) if model.grid() != grid => {
            return Err(SimError::Input(InputError::Conflict {
                field: "deformation".to_owned(),
                reason: "the grid of the model is not that of the scene".to_owned(),
            }));
        }
        Some(model) => model,
        None => half_space(scene, grid, scene.form.radii().0.max(grid.size_x()))?,
    };
    let influence = deformation.influence(0, 0);
    if !influence.is_normal() || influence < 0.0 {
        return Err(SimError::Input(InputError::Conflict {
            field: if own_deformation { "deformation" } else { "grid" }.to_owned(),
            reason: format!(
                "a cell of {:.3e} x {:.3e} m deflects by {influence:e} m under a pressure of 1 Pa, which must be a \
                 positive number and no subnormal one",
                grid.dx(),
                grid.dy()
            ),
        }));
    }
    Ok(deformation)
}

/// The elastic half-space of the scene. Displacements of a line contact are relative to the distance `reference` \[m\].
pub(in crate::sim) fn half_space(
    scene: &Scene,
    grid: Grid,
    reference: f64,
) -> Result<Box<dyn OwnedModel>, InputError> {
    let modulus = scene.equivalent_modulus()?;
    let layer = scene.layer()?;
    Ok(match (layer, scene.form.is_line()) {
        (None, _) if grid.is_strip() => Box::new(StripHalfSpace::new(grid, modulus, reference)?),
        (Some(layer), _) if grid.is_strip() => {
            Box::new(LayeredHalfSpace::strip(grid, modulus, layer, reference)?)
        }
        (None, false) => Box::new(HalfSpace::new(grid, modulus)?),
        (None, true) => Box::new(LineHalfSpace::new(grid, modulus, reference)?),
        (Some(layer), false) => Box::new(LayeredHalfSpace::new(grid, modulus, layer)?),
        (Some(layer), true) => Box::new(LayeredHalfSpace::plane_strain(grid, modulus, layer, reference)?),
    })
}
