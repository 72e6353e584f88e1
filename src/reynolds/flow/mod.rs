//! Fluid flow: mass balances of cells, fluxes through faces, and their derivatives.
//!
//! The unknowns are fluid pressures `p_f` and films `h` at the nodes. The net outflow of a cell over the
//! entrainment speed is a film thickness,
//!
//! `F = sum over faces of [theta rho h entrained - mobility (potential difference)] + squeeze`,
//!
//! and so are its derivatives by pressures and films, which Newton's method and all relaxations use.
//! `face_mobility`, `inlet` and `shear_thinning` define the pressure flow through a face, `entrainment` the entrained
//! flow, `spin` the entrainment across rows, `cavitation` the condition of a cell without pressure, `discretisation`
//! their sum, `balance` the balance of the box.

mod balance;
mod cavitation;
mod direction;
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
pub(super) use spin::SweepOrder;
pub(crate) use spin::require_spin;
