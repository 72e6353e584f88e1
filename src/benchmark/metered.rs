//! Elastic bodies that count their displacements and end a solve at its budget.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::budget::Budget;
use crate::elastic::{DeformationModel, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;

/// Work of one case so far, shared by its solves.
#[derive(Debug)]
pub(super) struct Meter {
    budget: Budget,
    started: Instant,
    displacements: Mutex<f64>,
    seconds: Mutex<f64>,
    is_exceeded: AtomicBool,
    /// Whether the benchmark was stopped.
    stop: Arc<AtomicBool>,
    /// First contradiction of a state that a contestant returned.
    fault: Mutex<Option<Fault>>,
}

/// A returned state that is not accepted.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// A state that does not fit the grid.
    WrongGrid(String),
    /// A state that is called converged and is not.
    FalselyConverged(String),
}

impl Meter {
    pub(super) fn new(budget: Budget, stop: Arc<AtomicBool>) -> Self {
        Self {
            budget,
            started: Instant::now(),
            displacements: Mutex::new(0.0),
            seconds: Mutex::new(0.0),
            is_exceeded: AtomicBool::new(false),
            stop,
            fault: Mutex::new(None),
        }
    }

    /// Counts a displacement on a grid with this `share` of the nodes; an error if the budget is used up.
    fn count(&self, share: f64) -> Result<(), InputError> {
        let mut displacements = self.displacements.lock().unwrap_or_else(PoisonError::into_inner);
        let is_late =
            self.started.elapsed().as_secs_f64() >= self.budget.seconds || self.stop.load(Ordering::Relaxed);
        if is_late || *displacements + share > self.budget.convolutions {
            self.is_exceeded.store(true, Ordering::Relaxed);
            let reason = "the budget is used up".to_owned();
            return Err(InputError::Conflict { field: "solve".to_owned(), reason });
        }
        *displacements += share;
        Ok(())
    }

    pub(super) fn is_exceeded(&self) -> bool {
        self.is_exceeded.load(Ordering::Relaxed)
    }

    pub(super) fn displacements(&self) -> f64 {
        *self.displacements.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn seconds(&self) -> f64 {
        *self.seconds.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn add_seconds(&self, seconds: f64) {
        *self.seconds.lock().unwrap_or_else(PoisonError::into_inner) += seconds;
    }

    pub(super) fn fault(&self) -> Option<Fault> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Keeps the first fault.
    pub(super) fn report(&self, fault: Fault) {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(fault);
    }
}

/// A deformation model with a meter. `D` holds the model, as a reference or in a box.
#[derive(Debug)]
pub(super) struct Metered<D> {
    pub(super) model: D,
    pub(super) meter: Arc<Meter>,
    /// Nodes of the grid of the case.
    pub(super) nodes: usize,
}

/// A place of a deformation model.
pub(super) trait Holder: std::fmt::Debug + Send + Sync {
    fn model(&self) -> &dyn DeformationModel;
    fn model_mut(&mut self) -> &mut dyn DeformationModel;
}

impl Holder for Box<dyn DeformationModel> {
    fn model(&self) -> &dyn DeformationModel {
        &**self
    }

    fn model_mut(&mut self) -> &mut dyn DeformationModel {
        &mut **self
    }
}

impl Holder for &mut (dyn DeformationModel + '_) {
    fn model(&self) -> &dyn DeformationModel {
        &**self
    }

    fn model_mut(&mut self) -> &mut dyn DeformationModel {
        &mut **self
    }
}

impl<D: Holder> DeformationModel for Metered<D> {
    fn grid(&self) -> Grid {
        self.model.model().grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.meter.count(self.grid().len() as f64 / self.nodes as f64)?;
        self.model.model_mut().displacement(pressure, out)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.model.model().influence(di, dj)
    }

    fn self_influence(&self, node: usize) -> f64 {
        self.model.model().self_influence(node)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let model = self.model.model().on_grid(grid)?;
        Some(Box::new(Metered { model, meter: Arc::clone(&self.meter), nodes: self.nodes }))
    }

    fn must_stop(&self) -> bool {
        self.model.model().must_stop()
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        self.model.model_mut().approximations()
    }
}
