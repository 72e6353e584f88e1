//! Parts of a simulation that work on buffers of their own and are copied with it.
//!
//! A clone of a simulation needs deformation model and solver of its own, which trait objects do not give.
//! What a builder takes is `Clone`, so that these traits are implemented for all of it.

use crate::elastic::DeformationModel;
use crate::reynolds::ContactSolver;

/// A deformation model that can be copied.
pub(in crate::sim) trait OwnedModel: DeformationModel {
    /// A copy with buffers of its own.
    fn copied(&self) -> Box<dyn OwnedModel>;
}

impl<T: DeformationModel + Clone + 'static> OwnedModel for T {
    fn copied(&self) -> Box<dyn OwnedModel> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn OwnedModel> {
    fn clone(&self) -> Self {
        // Of the model, not of its box.
        (**self).copied()
    }
}

/// A solver that can be copied.
pub(in crate::sim) trait OwnedSolver: ContactSolver {
    /// A copy with buffers of its own.
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
