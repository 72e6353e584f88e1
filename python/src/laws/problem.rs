//! The contact that a solver in Python gets: a copy of the problem that outlives the call.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::Grid;
use stribeck::elastic::DeformationModel;
use stribeck::lubricant::Lubricant;
use stribeck::reynolds::{ContactState, EdgePressure, Evaluation, LubricatedContact, Squeeze, StoppingRule};

use super::{Failure, Function};
use crate::convert::{dictionary, field};
use crate::error::{raise, value};
use crate::scene::{Cells, grid_dict};

/// The arrays of a state, as `stribeck.laws.ContactState`.
pub(super) fn state_of_arrays<'py>(
    py: Python<'py>,
    grid: &Grid,
    state: &ContactState,
) -> PyResult<Bound<'py, PyAny>> {
    let fields: Bound<'py, PyDict> = dictionary!(py, {
        "pressure": field(py, grid, &state.pressure)?,
        "fluid_pressure": field(py, grid, &state.fluid_pressure)?,
        "film": field(py, grid, &state.film)?,
        "plastic_depth": field(py, grid, &state.plastic_depth)?,
        "theta": field(py, grid, &state.theta)?,
        "in_contact": field(py, grid, &state.in_contact)?,
        "approach": state.approach,
    });
    py.import("stribeck.laws")?.getattr("ContactState")?.call((), Some(&fields))
}

/// Takes pressures, plastic depth, content and approach from the arrays; all else follows from them.
pub(super) fn read_state(
    function: &Function,
    given: &Bound<'_, PyAny>,
    state: &mut ContactState,
) -> PyResult<()> {
    for (name, out) in [
        ("pressure", &mut state.pressure),
        ("fluid_pressure", &mut state.fluid_pressure),
        ("plastic_depth", &mut state.plastic_depth),
        ("theta", &mut state.theta),
    ] {
        function.take(&given.getattr(name)?, &format!("left as state.{name}"), out)?;
    }
    let mut approach = [f64::NAN];
    function.take(&given.getattr("approach")?, "left as state.approach", &mut approach)?;
    state.approach = approach[0];
    Ok(())
}

/// A contact to be solved, a copy that outlives the call.
#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct Problem {
    function: Arc<Function>,
    grid: Grid,
    gap: Vec<f64>,
    limit: Option<Vec<f64>>,
    squeeze: Option<(Vec<f64>, f64)>,
    lubricant: Option<Lubricant>,
    work: Mutex<(Box<dyn DeformationModel>, Evaluation)>,
    numbers: Numbers,
    stop: StoppingRule,
}

/// Values that are not fields.
struct Numbers {
    load: f64,
    edge: Option<(Vec<f64>, Option<f64>)>,
    entrainment_speed: f64,
    spin_radius: Option<f64>,
    film_cutoff: f64,
    supplied_film: Option<f64>,
    half_widths: (f64, f64),
    reference_pressure: f64,
    reference_film: f64,
    choices: Choices,
}

/// How its equations are written.
struct Choices {
    contact: stribeck::reynolds::ContactDefinition,
    scheme: stribeck::reynolds::Scheme,
    face_mobility: stribeck::reynolds::FaceMobility,
    cavitation: stribeck::reynolds::Cavitation,
    shear_thinning: Option<stribeck::reynolds::ShearThinning>,
}

impl Problem {
    pub(super) fn of(
        problem: &LubricatedContact<'_>,
        model: Box<dyn DeformationModel>,
        stop: &StoppingRule,
        function: Arc<Function>,
    ) -> Self {
        let grid = problem.grid();
        Self {
            function,
            grid,
            gap: problem.gap.to_vec(),
            limit: problem.pressure_limit.map(<[f64]>::to_vec),
            squeeze: problem.squeeze.map(|squeeze| (squeeze.previous_mass.to_vec(), squeeze.time_step)),
            lubricant: problem.lubricant.cloned(),
            work: Mutex::new((model, Evaluation::new(grid))),
            numbers: Numbers {
                load: problem.load,
                edge: problem.edge_pressure.map(|edge| (edge.field.to_vec(), edge.load_outside)),
                entrainment_speed: problem.entrainment_speed,
                spin_radius: problem.spin_radius,
                film_cutoff: problem.film_cutoff,
                supplied_film: problem.supplied_film,
                half_widths: problem.reference_half_widths,
                reference_pressure: problem.reference_pressure,
                reference_film: problem.reference_film,
                choices: Choices {
                    contact: problem.contact,
                    scheme: problem.scheme,
                    face_mobility: problem.face_mobility,
                    cavitation: problem.cavitation,
                    shear_thinning: problem.shear_thinning,
                },
            },
            stop: *stop,
        }
    }

    fn contact<'a>(&'a self, model: &'a mut dyn DeformationModel) -> LubricatedContact<'a> {
        let Numbers { load, edge, half_widths, reference_pressure, choices, .. } = &self.numbers;
        let squeeze = self.squeeze.as_ref();
        LubricatedContact::new(&self.gap, model, *load, *half_widths, *reference_pressure)
            .with_lubricant(self.lubricant.as_ref())
            .with_entrainment_speed(self.numbers.entrainment_speed)
            .with_spin_radius(self.numbers.spin_radius)
            .with_squeeze(
                squeeze.map(|(mass, time_step)| Squeeze { previous_mass: mass, time_step: *time_step }),
            )
            .with_pressure_limit(self.limit.as_deref())
            .with_film_cutoff(self.numbers.film_cutoff)
            .with_contact(choices.contact)
            .with_scheme(choices.scheme)
            .with_face_mobility(choices.face_mobility)
            .with_cavitation(choices.cavitation)
            .with_supplied_film(self.numbers.supplied_film)
            .with_edge_pressure(
                edge.as_ref()
                    .map(|(field, load_outside)| EdgePressure { field, load_outside: *load_outside }),
            )
            .with_shear_thinning(choices.shear_thinning)
            .with_reference_film(self.numbers.reference_film)
    }

    /// The load that the pressures in the box carry \[N\].
    fn box_load(&self) -> f64 {
        let outside = self.numbers.edge.as_ref().and_then(|(_, outside)| *outside);
        self.numbers.load - outside.unwrap_or(0.0)
    }

    /// A field that was handed over.
    fn values(&self, given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
        let mut values = vec![0.0; self.grid.len()];
        self.function.take(given, &format!("handed over as {name}"), &mut values)?;
        Ok(values)
    }

    /// The field that the lubricant makes of a pressure.
    fn of_oil<'py>(
        &self,
        py: Python<'py>,
        pressure: &Bound<'py, PyAny>,
        fill: impl Fn(&Lubricant, &[f64], &mut [f64]),
    ) -> PyResult<Bound<'py, PyAny>> {
        let Some(lubricant) = &self.lubricant else {
            let message = "solver: the contact is dry, it has no lubricant";
            return Err(raise(py, "SolverError", message, Some("lubricant"), None));
        };
        let pressure = self.values(pressure, "pressure")?;
        let mut out = vec![0.0; pressure.len()];
        fill(lubricant, &pressure, &mut out);
        Ok(field(py, &self.grid, &out)?.into_any())
    }
}

#[pymethods]
impl Problem {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = &self.numbers;
        Ok(dictionary!(py, {
            "grid": grid_dict(py, &self.grid)?,
            "load": self.box_load(),
            "entrainment_speed": numbers.entrainment_speed,
            "spin_radius": numbers.spin_radius,
            "contact_film": if self.lubricant.is_some() { numbers.film_cutoff } else { 0.0 },
            "lubricated": self.lubricant.is_some(),
            "supplied_film": numbers.supplied_film,
            "half_widths": numbers.half_widths,
            "reference_pressure": numbers.reference_pressure,
            "reference_film": numbers.reference_film,
            "tolerance": self.stop.tolerance,
            "max_iterations": self.stop.max_iterations,
        }))
    }

    #[getter]
    fn cells(&self) -> Cells {
        Cells(self.grid)
    }

    #[getter]
    fn gap<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(field(py, &self.grid, &self.gap)?.into_any())
    }

    #[getter]
    fn pressure_limit<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let limit = self.limit.as_ref();
        limit.map(|limit| Ok(field(py, &self.grid, limit)?.into_any())).transpose()
    }

    fn displacement<'py>(
        &self,
        py: Python<'py>,
        pressure: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let pressure = self.values(pressure, "pressure")?;
        let mut out = vec![0.0; pressure.len()];
        let done = py.detach(|| {
            let mut work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
            work.0.displacement(&pressure, &mut out)
        });
        if let Some(error) = Failure.take() {
            return Err(error);
        }
        value(py, done)?;
        Ok(field(py, &self.grid, &out)?.into_any())
    }

    fn viscosity<'py>(&self, py: Python<'py>, pressure: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.of_oil(py, pressure, |oil, pressure, out| oil.viscosity().fill(pressure, out))
    }

    fn density<'py>(&self, py: Python<'py>, pressure: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.of_oil(py, pressure, |oil, pressure, out| oil.density().fill(pressure, out))
    }

    /// The residuals of the state; overwrites all fields that depend on its pressures and its approach.
    fn evaluate<'py>(&self, py: Python<'py>, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
        let mut state = ContactState::new(&self.grid);
        read_state(&self.function, given, &mut state)?;
        let done = py.detach(|| {
            let mut work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
            let (model, evaluation) = &mut *work;
            evaluation.evaluate(&mut self.contact(model.as_mut()), &mut state)
        });
        if let Some(error) = Failure.take() {
            return Err(error);
        }
        let residuals = value(py, done.map_err(stribeck::sim::SimError::from))?;
        let found = state_of_arrays(py, &self.grid, &state)?;
        for name in ["film", "plastic_depth", "theta", "in_contact"] {
            given.setattr(name, found.getattr(name)?)?;
        }
        Ok(dictionary!(py, {
            "mass": residuals.mass,
            "load": residuals.load,
            "complementarity": residuals.complementarity,
        }))
    }
}
