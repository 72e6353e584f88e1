//! Ending a solve from outside.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::elastic::{DeformationModel, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;

/// Asks whether the solve in progress shall end.
#[derive(Clone)]
pub(super) struct Interrupt(Arc<dyn Fn() -> bool + Send + Sync>);

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

impl Interrupt {
    pub(super) fn new(asked: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(asked))
    }
}

/// A deformation model that asks before each displacement, which every solver needs once an iteration, and
/// refuses it where the solve shall end.
#[derive(Debug)]
pub(super) struct Interruptible {
    model: Box<dyn DeformationModel>,
    interrupt: Interrupt,
    heeded: Arc<AtomicBool>,
}

impl Interruptible {
    /// The model that asks `interrupt`, and the flag that it sets when it refuses.
    pub(super) fn new(model: Box<dyn DeformationModel>, interrupt: Interrupt) -> (Self, Arc<AtomicBool>) {
        let heeded = Arc::new(AtomicBool::new(false));
        (Self { model, interrupt, heeded: Arc::clone(&heeded) }, heeded)
    }
}

impl DeformationModel for Interruptible {
    fn grid(&self) -> Grid {
        self.model.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        if (self.interrupt.0)() {
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

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let model = self.model.on_grid(grid)?;
        Some(Box::new(Self { model, interrupt: self.interrupt.clone(), heeded: Arc::clone(&self.heeded) }))
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        self.model.approximations()
    }
}
