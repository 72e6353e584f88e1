//! Which way led to a solution.

use std::fmt;

use crate::displayed::serialize_as_displayed;

/// The way by which a solver that knows several has found the state of its report.
///
/// # Examples
///
/// ```
/// use stribeck::Strategy;
/// use stribeck::sim::{Scene, solve_contact};
/// let report = solve_contact(&Scene::azam_2019(32))?.report;
/// assert_eq!(report.strategy.map(|way| way.to_string()), Some("attempt_1".to_owned()));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Strategy {
    /// One of [`NewtonSettings::attempts`](crate::reynolds::NewtonSettings::attempts), counted from 1.
    Attempt(usize),
    /// By way of thicker contact films
    /// ([`NewtonSettings::least_film_ratio`](crate::reynolds::NewtonSettings::least_film_ratio)).
    Continuation,
}

serialize_as_displayed!(Strategy);

impl fmt::Display for Strategy {
    /// `attempt_1` and so on, `continuation`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Attempt(number) => write!(f, "attempt_{number}"),
            Self::Continuation => f.write_str("continuation"),
        }
    }
}
