//! Journal bearings: films of eccentric circles, load vector, equilibrium under a load.
//!
//! | file | content |
//! |---|---|
//! | `feeds` | grooves and holes of the bush |
//! | `elastic_bore` | deflection of journal and bush under a pressure |
//! | `bearing` | the bearing, and its film at one position of the axis |
//! | `load_search` | the eccentricity at which the film carries a load |
//! | `elastic_equilibrium` | the same with that deflection, from small eccentricities on |
//! | `equilibrium` | a given eccentricity or load; feeds at their angle to the load |

mod bearing;
mod elastic_bore;
mod elastic_equilibrium;
mod equilibrium;
mod feeds;
mod load_search;

pub use bearing::{JournalBearing, JournalSolution};
pub use elastic_bore::ElasticBore;
pub use feeds::{Grooves, Holes};
