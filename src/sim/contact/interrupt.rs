//! Ending a solve from outside.
//!
//! Solvers know nothing of it: every one of them needs a displacement in each iteration, and the deformation
//! model refuses it when the solve shall end. What the solver makes of that error does not matter, as the
//! flag tells.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::elastic::{DeformationModel, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::boxed_clone::OwnedModel;

/// Asks whether the solve in progress shall end.
#[derive(Clone)]
pub(in crate::sim) struct Interrupt(Arc<dyn Fn() -> bool + Send + Sync>);

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

impl Interrupt {
    /// Asks `asked`.
    pub(in crate::sim) fn new(asked: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(asked))
    }
}

/// A deformation model that asks before each displacement, which every solver needs once an iteration, and
/// refuses it where the solve shall end; without an interrupt the model as it is.
#[derive(Debug)]
pub(in crate::sim) struct Interruptible<M: ?Sized = dyn OwnedModel> {
    /// The model that is asked.
    model: Box<M>,
    /// What may end the solve.
    interrupt: Option<Interrupt>,
    /// Whether a solve was refused its displacement. Shared with the same model on other grids.
    heeded: Arc<AtomicBool>,
}

impl Interruptible {
    /// The `model` with an interrupt or without.
    pub(in crate::sim) fn new(model: Box<dyn OwnedModel>, interrupt: Option<Interrupt>) -> Self {
        Self { model, interrupt, heeded: Arc::default() }
    }

    /// What may end the solve.
    pub(in crate::sim) fn interrupt(&self) -> Option<&Interrupt> {
        self.interrupt.as_ref()
    }

    /// Whether a displacement was refused.
    pub(in crate::sim) fn is_interrupted(&self) -> bool {
        self.heeded.load(Ordering::Relaxed)
    }

    /// Forgets what was heeded before; the flag that an interrupt of the solve to come sets.
    pub(in crate::sim) fn begin(&self) -> Arc<AtomicBool> {
        self.heeded.store(false, Ordering::Relaxed);
        Arc::clone(&self.heeded)
    }
}

impl Clone for Interruptible {
    /// The copy listens to the same interrupt; what it heeds is its own.
    fn clone(&self) -> Self {
        Self::new(self.model.clone(), self.interrupt.clone())
    }
}

impl<M: DeformationModel + ?Sized> DeformationModel for Interruptible<M> {
    fn grid(&self) -> Grid {
        self.model.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        if self.interrupt.as_ref().is_some_and(|interrupt| (interrupt.0)()) {
            self.heeded.store(true, Ordering::Relaxed);
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

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let model = self.model.on_grid(grid)?;
        let Some(interrupt) = &self.interrupt else { return Some(model) };
        let (interrupt, heeded) = (Some(interrupt.clone()), Arc::clone(&self.heeded));
        Some(Box::new(Interruptible::<dyn DeformationModel> { model, interrupt, heeded }))
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        self.model.approximations()
    }
}
