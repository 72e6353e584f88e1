//! Laws as Python hands them over, in place of those of a scene.

use pyo3::prelude::*;
use stribeck::Grid;
use stribeck::sim::SimBuilder;

use super::fluid::OfPressure;
use super::{
    Deformation, Density, Friction, Function, Growth, Motion, Plasticity, PyLaw, Solver, Viscosity, Wear,
};

/// A deformation model with its estimate of pressures and its influence coefficients.
type PyElastic = (String, Py<PyAny>, [Option<Py<PyAny>>; 2]);

/// Each law is its identity and its function, some with a number, a word or a second function behind.
#[derive(FromPyObject)]
pub(crate) struct PyLaws {
    /// With the largest thickness \[m\].
    #[pyo3(item)]
    growth: Option<(String, Py<PyAny>, f64)>,
    #[pyo3(item)]
    wear: Option<PyLaw>,
    #[pyo3(item)]
    friction: Option<PyLaw>,
    #[pyo3(item)]
    deformation: Option<PyElastic>,
    /// With whether it takes a temperature.
    #[pyo3(item)]
    viscosity: Option<(String, Py<PyAny>, bool)>,
    #[pyo3(item)]
    density: Option<(String, Py<PyAny>, bool)>,
    /// With whether it hardens.
    #[pyo3(item)]
    plasticity: Option<(String, Py<PyAny>, bool)>,
    /// With the places that it visits.
    #[pyo3(item)]
    motion: Option<(String, Py<PyAny>, String)>,
    #[pyo3(item)]
    solver: Option<PyLaw>,
}

impl PyLaws {
    /// Whether there is one.
    pub(crate) fn any(&self) -> bool {
        self.growth.is_some()
            || self.wear.is_some()
            || self.friction.is_some()
            || self.deformation.is_some()
            || self.viscosity.is_some()
            || self.density.is_some()
            || self.plasticity.is_some()
            || self.motion.is_some()
            || self.solver.is_some()
    }

    /// The builder with these laws on `grid` at the bulk `temperature` \[K\].
    pub(crate) fn put_into(
        self,
        py: Python<'_>,
        builder: SimBuilder,
        grid: &Grid,
        temperature: f64,
    ) -> PyResult<SimBuilder> {
        let mut builder = builder;
        if let Some((identity, call, maximum_thickness)) = self.growth {
            let function = Function::new("growth law", (identity, call), *grid);
            builder = builder.growth_law(Growth { function, maximum_thickness });
        }
        if let Some(law) = self.wear {
            builder = builder.wear_law(Wear(Function::new("wear law", law, *grid)));
        }
        if let Some(law) = self.friction {
            builder = builder.boundary_friction(Friction(Function::new("boundary friction", law, *grid)));
        }
        let of_pressure = |name, (identity, call, thermal)| {
            OfPressure::new(Function::new(name, (identity, call), *grid), thermal, temperature)
        };
        if let Some(law) = self.viscosity {
            builder = builder.viscosity(Viscosity(of_pressure("viscosity law", law)));
        }
        if let Some(law) = self.density {
            builder = builder.density(Density(of_pressure("density law", law)));
        }
        if let Some((identity, call, hardens)) = self.plasticity {
            let function = Function::new("plasticity model", (identity, call), *grid);
            builder = builder.plasticity(Plasticity { function, hardens });
        }
        if let Some((identity, call, visits)) = self.motion {
            builder =
                builder.motion(Motion::new(py, Function::new("motion", (identity, call), *grid), &visits)?);
        }
        let deformation = self.deformation.map(|(identity, displacement, [estimate, influence])| {
            let estimate =
                estimate.map(|call| Function::new("pressure estimate", (identity.clone(), call), *grid));
            let displacement = Function::new("deformation model", (identity, displacement), *grid);
            Deformation::new(py, displacement, estimate, influence)
        });
        let deformation = deformation.transpose()?;
        if let Some(law) = self.solver {
            builder = builder.solver(Solver::new(Function::new("solver", law, *grid), deformation.clone()));
        }
        Ok(match deformation {
            Some(model) => builder.deformation(model),
            None => builder,
        })
    }
}
