//! A history and the folder that it is written to.

use std::ops::ControlFlow;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim::{
    CheckpointError, MixedLubricationSim, Observer, RunFolder, SimError, StepRecord, Warning,
};

use crate::convert::{list, named};

pub(crate) struct Run {
    pub(crate) sim: MixedLubricationSim,
    /// Those that Python has not taken: a signal may come before it sees one.
    pub(crate) records: Vec<Taken>,
    /// The folder that steps are written to.
    pub(crate) folder: Option<RunFolder>,
}

impl Run {
    /// Keeps the record of a step with the warnings that it has added to the `known` ones.
    ///
    /// # Errors
    /// That of a folder that cannot be written to; it is left then.
    pub(crate) fn keep(&mut self, record: StepRecord, known: usize) -> Result<(), SimError> {
        let warnings = self.sim.warnings().get(known..).unwrap_or_default().to_vec();
        let written = self.folder.as_mut().map(|folder| folder.after_step(&self.sim, &record));
        self.records.push(Taken { record, warnings });
        match written {
            Some(ControlFlow::Break(())) => self.close(),
            _ => Ok(()),
        }
    }

    /// Writes the last checkpoint and the fields into the folder, if there is one, and leaves it.
    pub(crate) fn close(&mut self) -> Result<(), SimError> {
        self.folder.take().map_or(Ok(()), |folder| folder.finish(&self.sim))
    }

    /// Refuses to take over a checkpoint while a folder is open, whose history is another.
    pub(crate) fn refuse_folder(&self) -> Result<(), CheckpointError> {
        match &self.folder {
            None => Ok(()),
            Some(_) => Err(CheckpointError::Io {
                path: PathBuf::from("run folder"),
                source: std::io::Error::other("the simulation writes into a folder; close() it first"),
            }),
        }
    }
}

/// A step that was taken.
#[derive(Clone)]
pub(crate) struct Taken {
    pub(crate) record: StepRecord,
    /// Those that no step before has said.
    pub(crate) warnings: Vec<Warning>,
}

/// A record and the warnings of its step.
pub(crate) type RecordParts<'py> = (Bound<'py, PyDict>, Bound<'py, PyAny>);

impl Taken {
    pub(crate) fn parts<'py>(&self, py: Python<'py>) -> PyResult<RecordParts<'py>> {
        Ok((named(py, &self.record)?, list(py, &self.warnings)?))
    }
}
