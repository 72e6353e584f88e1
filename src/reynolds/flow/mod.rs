//! What the fluid does: mass balances of cells, flow through faces, and their derivatives.
//!
//! The unknowns are fluid pressures `p_f` and films `h` at the nodes. The net outflow of a cell over the
//! entrainment speed is a film thickness,
//!
//! `F = sum over faces of [theta rho h carried - mobility (potential difference)] + squeeze`,
//!
//! and so are its derivatives by pressures and films, with which Newton's method and all relaxations work.
//! Look into `face_mobility`, `inlet` and `shear_thinning` for what pressure drives through a face, `entrainment`
//! for what the surfaces carry, `spin` for what turning ones carry from row to row, `cavitation` for what a cell
//! without pressure holds, `discretisation` for how they add up, `balance` for the box as a whole.

mod balance;
mod cavitation;
mod discretisation;
mod entrainment;
mod face_mobility;
mod inlet;
mod node;
mod shear_thinning;
mod spin;

pub use balance::{FilmFlows, FlowBalance};
pub use cavitation::Cavitation;
pub(super) use discretisation::{Discretisation, HeldNeighbour, MARGIN, NearField};
pub use entrainment::Scheme;
pub use face_mobility::FaceMobility;
pub use shear_thinning::ShearThinning;
pub(super) use spin::Course;
pub(crate) use spin::require_spin;
