//! Interruption of a solve by the caller.
//!
//! Solvers need no support for it: every solver computes a displacement in each iteration, and the deformation model
//! returns an error when the solve is interrupted. A flag records this, whatever the solver does with the error. Newton's
//! method also asks `must_stop` within its factorization, which takes long on large meshes.
//! Preparations of large meshes poll the interrupt between their parts, once laws and bodies are valid: an error of
//! the input comes before the first poll.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::elastic::{DeformationModel, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::boxed_clone::OwnedModel;
use crate::sim::error::SimError;

/// Callback that returns whether to interrupt the present solve.
#[derive(Clone)]
pub(in crate::sim) struct Interrupt(Arc<dyn Fn() -> bool + Send + Sync>);

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

impl Interrupt {
    /// An interrupt with the callback `asked`.
    pub(in crate::sim) fn new(asked: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(asked))
    }
}

/// A deformation model that polls the interrupt before each displacement, once per iteration of any solver, and then
/// returns an error if interrupted. Without an interrupt it is the model itself.
#[derive(Debug)]
pub(in crate::sim) struct Interruptible<M: ?Sized = dyn OwnedModel> {
    /// The wrapped model.
    model: Box<M>,
    /// The interrupt, if any.
    interrupt: Option<Interrupt>,
    /// Whether an interrupt was returned as an error. Shared with the same model on other grids.
    was_interrupted: Arc<AtomicBool>,
}

impl Interruptible {
    /// The `model` with an optional interrupt.
    pub(in crate::sim) fn new(model: Box<dyn OwnedModel>, interrupt: Option<Interrupt>) -> Self {
        Self { model, interrupt, was_interrupted: Arc::default() }
    }

    /// The interrupt, if any.
    pub(in crate::sim) fn interrupt(&self) -> Option<&Interrupt> {
        self.interrupt.as_ref()
    }

    /// Polls the interrupt, if any.
    ///
    /// # Errors
    /// An interruption.
    pub(in crate::sim) fn poll(&self) -> Result<(), SimError> {
        match &self.interrupt {
            Some(interrupt) if (interrupt.0)() => Err(SimError::Interrupted),
            _ => Ok(()),
        }
    }

    /// Whether the solve was interrupted.
    pub(in crate::sim) fn is_interrupted(&self) -> bool {
        self.was_interrupted.load(Ordering::Relaxed)
    }

    /// Resets and returns the flag, before a solve.
    pub(in crate::sim) fn begin(&self) -> Arc<AtomicBool> {
        self.was_interrupted.store(false, Ordering::Relaxed);
        Arc::clone(&self.was_interrupted)
    }
}

impl Clone for Interruptible {
    /// The copy has the same interrupt and a flag of its own.
    fn clone(&self) -> Self {
        Self::new(self.model.clone(), self.interrupt.clone())
    }
}

impl<M: DeformationModel + ?Sized> DeformationModel for Interruptible<M> {
    fn grid(&self) -> Grid {
        self.model.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        if self.must_stop() {
            return Err(InputError::Conflict {
                field: "solve".to_owned(),
                reason: "it was interrupted".to_owned(),
            });
        }
        self.model.displacement(pressure, out)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.model.influence(di, dj)
    }

    fn self_influence(&self, node: usize) -> f64 {
        self.model.self_influence(node)
    }

    fn must_stop(&self) -> bool {
        let asked = || self.interrupt.as_ref().is_some_and(|interrupt| (interrupt.0)());
        // the callback may return true only once
        let stops = self.was_interrupted.load(Ordering::Relaxed) || asked() || self.model.must_stop();
        self.was_interrupted.fetch_or(stops, Ordering::Relaxed);
        stops
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let model = self.model.on_grid(grid)?;
        let Some(interrupt) = &self.interrupt else { return Some(model) };
        let (interrupt, was_interrupted) = (Some(interrupt.clone()), Arc::clone(&self.was_interrupted));
        Some(Box::new(Interruptible::<dyn DeformationModel> { model, interrupt, was_interrupted }))
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        self.model.approximations()
    }
}
