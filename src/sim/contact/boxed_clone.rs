//! Cloning of boxed components with own buffers.
//!
//! A clone of a simulation needs its own deformation model and solver, which plain trait objects cannot clone. A
//! builder accepts types that are `Clone`, for which these traits are implemented.

use crate::elastic::DeformationModel;
use crate::reynolds::ContactSolver;

/// A deformation model that can be cloned in its box.
pub(in crate::sim) trait OwnedModel: DeformationModel {
    /// A copy with its own buffers.
    fn copied(&self) -> Box<dyn OwnedModel>;
}

impl<T: DeformationModel + Clone + 'static> OwnedModel for T {
    fn copied(&self) -> Box<dyn OwnedModel> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn OwnedModel> {
    fn clone(&self) -> Self {
        // Copy the model, not its box.
        (**self).copied()
    }
}

/// A solver that can be cloned in its box.
pub(in crate::sim) trait OwnedSolver: ContactSolver {
    /// A copy with its own buffers.
    fn copied(&self) -> Box<dyn OwnedSolver>;
}

impl<T: ContactSolver + Clone + 'static> OwnedSolver for T {
    fn copied(&self) -> Box<dyn OwnedSolver> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn OwnedSolver> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}
