//! The strategy that led to a solution.

use std::fmt;

use crate::displayed::serialize_as_displayed;

/// Strategy of a solver with several that found the reported state.
///
/// # Examples
///
/// ```
/// use stribeck::Strategy;
/// use stribeck::sim::{Scene, solve_contact};
/// let report = solve_contact(&Scene::azam_2019(32))?.report;
/// assert_eq!(report.strategy.map(|way| way.to_string()), Some("attempt".to_owned()));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Strategy {
    /// From the given state or the dry contact.
    Attempt,
    /// Continuation in the contact film, from thicker films
    /// ([`NewtonSettings::least_film_ratio`](crate::reynolds::NewtonSettings::least_film_ratio)).
    Continuation,
}

serialize_as_displayed!(Strategy);

impl fmt::Display for Strategy {
    /// `attempt`, `continuation`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Attempt => "attempt",
            Self::Continuation => "continuation",
        })
    }
}
