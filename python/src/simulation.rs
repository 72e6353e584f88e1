//! Histories.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Mutex, TryLockError};

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim::{CheckpointError, MixedLubricationSim, RunFolder, SimError, StepControl, StepRecord};

use crate::convert::{dictionary, field, list, named, on_grid};
use crate::error::{ForPython, raise, value};
use crate::laws::Failure;
use crate::run::{RecordParts, Run, Taken};
use crate::scene::{Cells, Scene};
use crate::solution::{Parts, Solved, Start, parts_of};
use crate::start::BodyStart;

#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct Simulation {
    run: Mutex<Run>,
}

type Arrays<'py> = Bound<'py, PyDict>;

impl Simulation {
    /// The result of `act` on the simulation, with the interpreter free meanwhile; an exception of a law or a
    /// signal comes first.
    fn act<T: Send, E: ForPython + Send>(
        &self,
        py: Python<'_>,
        act: impl FnOnce(&mut Run) -> Result<T, E> + Send,
    ) -> PyResult<T> {
        // That of a law which asks for this, if it has failed.
        let outer = Failure.take();
        let acted = py.detach(|| match self.run.try_lock() {
            Ok(mut run) => Some(act(&mut run)),
            Err(TryLockError::Poisoned(poisoned)) => Some(act(&mut poisoned.into_inner())),
            Err(TryLockError::WouldBlock) => None,
        });
        let raised = Failure.take();
        if let Some(outer) = outer {
            Failure.keep(outer);
        }
        if let Some(error) = raised {
            return Err(error);
        }
        match acted {
            Some(acted) => value(py, acted),
            None => Err(Self::busy(py)),
        }
    }

    /// The result of `look` on the simulation.
    fn look<T>(&self, py: Python<'_>, look: impl FnOnce(&MixedLubricationSim) -> PyResult<T>) -> PyResult<T> {
        match self.run.try_lock() {
            Ok(run) => look(&run.sim),
            Err(TryLockError::Poisoned(poisoned)) => look(&poisoned.into_inner().sim),
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
    #[pyo3(signature = (scene, parts, squeeze, start=None))]
    fn new(
        py: Python<'_>,
        scene: &Scene,
        parts: Parts<'_>,
        squeeze: bool,
        start: Option<Start<'_>>,
    ) -> PyResult<Self> {
        let mut builder = parts.builder(py, scene)?;
        if let Some(start) = start {
            builder = builder.contact_start(start.state(py, scene)?);
        }
        if squeeze {
            builder = builder.with_squeeze();
        }
        let built = py.detach(|| builder.build());
        if let Some(error) = Failure.take() {
            return Err(error);
        }
        let run = Run { sim: value(py, built)?, records: Vec::new(), folder: None };
        Ok(Self { run: Mutex::new(run) })
    }

    fn step(&self, py: Python<'_>, time_step: f64, depth: f64) -> PyResult<()> {
        let control = StepControl::new(time_step, depth);
        self.act(py, |run| {
            let known = run.sim.warnings().len();
            let record = run.sim.step_within(&control)?;
            run.keep(record, known)
        })
    }

    /// One step towards the time `end`; whether there was one to take.
    fn step_towards(&self, py: Python<'_>, end: f64, time_step: f64, depth: f64) -> PyResult<bool> {
        let control = StepControl::new(time_step, depth);
        self.act(py, |run| {
            let known = run.sim.warnings().len();
            let mut first = None;
            run.sim.run_until(end, &control, &mut |_: &MixedLubricationSim, record: &StepRecord| {
                first = Some(record.clone());
                ControlFlow::Break(())
            })?;
            let is_taken = first.is_some();
            first.map_or(Ok(()), |record| run.keep(record, known))?;
            Ok::<_, SimError>(is_taken)
        })
    }

    /// The records since this was last called.
    fn take_records<'py>(&self, py: Python<'py>) -> PyResult<Vec<RecordParts<'py>>> {
        let mut run = match self.run.try_lock() {
            Ok(run) => run,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return Err(Self::busy(py)),
        };
        let records = std::mem::take(&mut run.records);
        drop(run);
        records.iter().map(|taken| taken.parts(py)).collect()
    }

    /// Goes on with the run in the folder at `path`, of which the parts `accept` may differ, or begins one there; a checkpoint
    /// after each `every` steps.
    fn open_folder(&self, py: Python<'_>, path: PathBuf, every: u64, accept: Vec<String>) -> PyResult<()> {
        let accept: Vec<&str> = accept.iter().map(String::as_str).collect();
        self.act(py, |run| {
            let (folder, records) = RunFolder::resume_accepting(path, &mut run.sim, every, &accept)?;
            run.folder = Some(folder);
            run.records = records.into_iter().map(|record| Taken { record, warnings: Vec::new() }).collect();
            Ok::<_, SimError>(())
        })
    }

    fn close_folder(&self, py: Python<'_>) -> PyResult<()> {
        self.act(py, Run::close)
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.act(py, |run| run.sim.save(path))
    }

    /// Takes over the checkpoint at `path`, of which the parts `accept` may differ; those that do.
    fn restore(&self, py: Python<'_>, path: PathBuf, accept: Vec<String>) -> PyResult<Vec<String>> {
        let accept: Vec<&str> = accept.iter().map(String::as_str).collect();
        self.act(py, |run| {
            run.refuse_folder()?;
            let differences = run.sim.restore_accepting(path, &accept)?;
            run.records.clear();
            Ok::<_, CheckpointError>(differences)
        })
    }

    fn restore_under_other_conditions(&self, py: Python<'_>, path: PathBuf) -> PyResult<Vec<String>> {
        self.act(py, |run| {
            run.refuse_folder()?;
            let differences = run.sim.restore_under_other_conditions(path)?;
            run.records.clear();
            Ok::<_, CheckpointError>(differences)
        })
    }

    /// Takes over the `bytes` of [`checkpoint`](Self::checkpoint), under other conditions too.
    fn restore_bytes(&self, py: Python<'_>, bytes: &[u8]) -> PyResult<Vec<String>> {
        self.act(py, |run| run.sim.restore_checkpoint_under_other_conditions(bytes))
    }

    /// A simulation of its own that stands where this one does; it writes into no folder.
    fn fork(&self, py: Python<'_>) -> PyResult<Self> {
        let sim = self.act(py, |run| Ok::<_, SimError>(run.sim.clone()))?;
        Ok(Self { run: Mutex::new(Run { sim, records: Vec::new(), folder: None }) })
    }

    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyBytes>> {
        let kept = self.act(py, |run| run.sim.checkpoint())?;
        Ok(pyo3::types::PyBytes::new(py, &kept))
    }

    /// The contact of the bodies as they stand under `load`, `entrainment_speed`, `slide_roll_ratio` and
    /// `bulk_temperature`.
    #[pyo3(signature = (load=None, entrainment_speed=None, slide_roll_ratio=None, bulk_temperature=None))]
    fn solve_under<'py>(
        &self,
        py: Python<'py>,
        load: Option<f64>,
        entrainment_speed: Option<f64>,
        slide_roll_ratio: Option<f64>,
        bulk_temperature: Option<f64>,
    ) -> PyResult<Solved<'py>> {
        let solution = self.act(py, |run| {
            let mut conditions = run.sim.conditions();
            conditions.load = load.unwrap_or(conditions.load);
            let motion = &mut conditions.motion;
            motion.entrainment_speed = entrainment_speed.unwrap_or(motion.entrainment_speed);
            motion.slide_roll_ratio = slide_roll_ratio.unwrap_or(motion.slide_roll_ratio);
            conditions.bulk_temperature = bulk_temperature.unwrap_or(conditions.bulk_temperature);
            run.sim.solve_under(&conditions)
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

    /// The scene, with a box that has grown as it is now.
    fn scene(&self, py: Python<'_>) -> PyResult<Scene> {
        self.look(py, |sim| Ok(Scene(sim.scene().clone())))
    }

    fn grid(&self, py: Python<'_>) -> PyResult<Cells> {
        self.look(py, |sim| Ok(Cells(sim.grid())))
    }

    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.look(py, |sim| list(py, &sim.warnings()))
    }

    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.look(py, |sim| {
            Ok(dictionary!(py, {
                "conditions": named(py, &sim.conditions())?,
                "roughness_motion": format!("{:?}", sim.motion()),
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
                    Ok(dictionary!(py, {
                        "initial": array(body.initial())?,
                        "surface": array(body.surface())?,
                        "wear": array(body.wear())?,
                        "plastic_depth": array(body.plastic_depth())?,
                        "tribofilm": array(body.tribofilm())?,
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
            Ok(dictionary!(py, {
                "pressure": field(py, &grid, &state.pressure)?,
                "fluid_pressure": field(py, &grid, &state.fluid_pressure)?,
                "film": field(py, &grid, &state.film)?,
                "theta": field(py, &grid, &state.theta)?,
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
