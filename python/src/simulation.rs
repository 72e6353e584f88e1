//! Histories.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Mutex, TryLockError};

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim::{MixedLubricationSim, SimError, StepControl, StepRecord};

use crate::convert::{field, named, on_grid};
use crate::error::{ForPython, raise, value};
use crate::laws::Failure;
use crate::record::record_dict;
use crate::scene::{Scene, conditions_dict, grid_dict};
use crate::solution::{Parts, parts_of};
use crate::start::BodyStart;

#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct Simulation {
    sim: Mutex<MixedLubricationSim>,
    failure: Failure,
}

type Arrays<'py> = Bound<'py, PyDict>;

impl Simulation {
    /// What `act` makes of the simulation, with the interpreter free meanwhile; an exception of a law or a signal comes first.
    fn act<T: Send, E: ForPython + Send>(
        &self,
        py: Python<'_>,
        act: impl FnOnce(&mut MixedLubricationSim) -> Result<T, E> + Send,
    ) -> PyResult<T> {
        drop(self.failure.take());
        let acted = py.detach(|| match self.sim.try_lock() {
            Ok(mut sim) => Some(act(&mut sim)),
            Err(TryLockError::Poisoned(poisoned)) => Some(act(&mut poisoned.into_inner())),
            Err(TryLockError::WouldBlock) => None,
        });
        if let Some(error) = self.failure.take() {
            return Err(error);
        }
        match acted {
            Some(acted) => value(py, acted),
            None => Err(Self::busy(py)),
        }
    }

    /// What `look` reads.
    fn look<T>(&self, py: Python<'_>, look: impl FnOnce(&MixedLubricationSim) -> PyResult<T>) -> PyResult<T> {
        match self.sim.try_lock() {
            Ok(sim) => look(&sim),
            Err(TryLockError::Poisoned(poisoned)) => look(&poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(Self::busy(py)),
        }
    }

    fn busy(py: Python<'_>) -> PyErr {
        let message = "the simulation is taking a step, on another thread or in the call that asks";
        raise(py, "BusyError", message, None, None)
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, scene: &Scene, parts: Parts<'_>, squeeze: bool) -> PyResult<Self> {
        let (mut builder, failure) = parts.builder(py, scene)?;
        if squeeze {
            builder = builder.with_squeeze();
        }
        let built = py.detach(|| builder.build());
        if let Some(error) = failure.take() {
            return Err(error);
        }
        Ok(Self { sim: Mutex::new(value(py, built)?), failure })
    }

    fn step<'py>(&self, py: Python<'py>, time_step: f64, depth: f64) -> PyResult<Bound<'py, PyDict>> {
        let control = StepControl { longest: time_step, depth };
        let record = self.act(py, |sim| sim.step_within(&control))?;
        record_dict(py, &record)
    }

    /// One step towards the time `end`; none where it is reached.
    fn step_towards<'py>(
        &self,
        py: Python<'py>,
        end: f64,
        time_step: f64,
        depth: f64,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let control = StepControl { longest: time_step, depth };
        let record = self.act(py, |sim| {
            let mut first = None;
            sim.run_until(end, &control, &mut |_: &MixedLubricationSim, record: &StepRecord| {
                first = Some(*record);
                ControlFlow::Break(())
            })?;
            Ok::<_, SimError>(first)
        })?;
        record.map(|record| record_dict(py, &record)).transpose()
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.act(py, |sim| sim.save(path))
    }

    fn restore(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.act(py, |sim| sim.restore(path))
    }

    fn restore_under_other_conditions(&self, py: Python<'_>, path: PathBuf) -> PyResult<Vec<String>> {
        self.act(py, |sim| sim.restore_under_other_conditions(path))
    }

    /// Takes over everything that later steps of `other` depend on.
    fn copy_from(&self, py: Python<'_>, other: &Self) -> PyResult<()> {
        let kept = other.act(py, |sim| sim.checkpoint())?;
        self.act(py, |sim| sim.restore_checkpoint(&kept))
    }

    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyBytes>> {
        let kept = self.act(py, |sim| sim.checkpoint())?;
        Ok(pyo3::types::PyBytes::new(py, &kept))
    }

    /// The contact of the bodies as they stand under `load`, `entrainment_speed`, `slide_roll_ratio` and `bulk_temperature`.
    #[pyo3(signature = (load=None, entrainment_speed=None, slide_roll_ratio=None, bulk_temperature=None))]
    fn solve_under<'py>(
        &self,
        py: Python<'py>,
        load: Option<f64>,
        entrainment_speed: Option<f64>,
        slide_roll_ratio: Option<f64>,
        bulk_temperature: Option<f64>,
    ) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
        let solution = self.act(py, |sim| {
            let mut conditions = sim.conditions();
            conditions.load = load.unwrap_or(conditions.load);
            let motion = &mut conditions.motion;
            motion.entrainment_speed = entrainment_speed.unwrap_or(motion.entrainment_speed);
            motion.slide_roll_ratio = slide_roll_ratio.unwrap_or(motion.slide_roll_ratio);
            conditions.bulk_temperature = bulk_temperature.unwrap_or(conditions.bulk_temperature);
            sim.solve_under(&conditions)
        })?;
        parts_of(py, &solution)
    }

    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        self.look(py, |sim| Ok(sim.time()))
    }

    #[getter]
    fn steps(&self, py: Python<'_>) -> PyResult<u64> {
        self.look(py, |sim| Ok(sim.steps()))
    }

    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.look(py, |sim| {
            Ok(named!(py, {
                "grid": grid_dict(py, &sim.grid())?,
                "conditions": conditions_dict(py, &sim.conditions())?,
                "motion": format!("{:?}", sim.motion()),
                "flash_estimate": sim.flash_estimate(),
                "models_flash_temperature": sim.models_flash_temperature(),
                "ledger_residual": value(py, sim.ledger_residual())?,
            }))
        })
    }

    /// The fields of both bodies.
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Vec<Arrays<'py>>> {
        self.look(py, |sim| {
            let grid = sim.grid();
            let array = |values: &[f64]| -> PyResult<Bound<'py, PyArray2<f64>>> { field(py, &grid, values) };
            sim.bodies()
                .iter()
                .map(|body| {
                    Ok(named!(py, {
                        "initial": array(body.initial())?,
                        "surface": array(body.surface())?,
                        "wear": array(body.wear_depth())?,
                        "plastic_depth": array(body.plastic_depth())?,
                        "tribofilm": array(body.film_thickness())?,
                        "worn_profile": numpy::PyArray1::from_vec(py, sim.worn_profile(body)),
                    }))
                })
                .collect()
        })
    }

    /// The fields of the last contact.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Arrays<'py>> {
        self.look(py, |sim| {
            let (grid, state) = (sim.grid(), sim.state());
            Ok(named!(py, {
                "pressure": field(py, &grid, &state.pressure)?,
                "fluid_pressure": field(py, &grid, &state.fluid_pressure)?,
                "film": field(py, &grid, &state.film)?,
                "theta": field(py, &grid, &state.content)?,
                "plastic_depth": field(py, &grid, &state.plastic_depth)?,
                "in_contact": field(py, &grid, &state.in_contact)?,
            }))
        })
    }

    fn starts(&self, py: Python<'_>) -> PyResult<[BodyStart; 2]> {
        self.look(py, |sim| Ok(sim.starts().map(BodyStart)))
    }

    fn mean_on_track(&self, py: Python<'_>, values: numpy::PyReadonlyArray2<'_, f64>) -> PyResult<f64> {
        self.look(py, |sim| value(py, sim.mean_on_track(on_grid(py, "field", &values, &sim.grid())?)))
    }
}
