//! What the fluid does: mass balances of cells, flow through faces, and their derivatives.

mod balance;
mod cavitation;
mod discretisation;
mod entrainment;
mod face_mobility;
mod inlet;
mod node;
mod shear_thinning;

pub use balance::FlowBalance;
pub use cavitation::Cavitation;
pub(super) use discretisation::{Discretisation, HeldNeighbour, MARGIN, NearField};
pub use entrainment::Scheme;
pub use face_mobility::FaceMobility;
pub use shear_thinning::ShearThinning;
