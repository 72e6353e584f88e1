//! Identification of solvers.

use std::fmt;
use std::str::FromStr;

use crate::displayed::serialize_as_displayed;
use crate::error::InputError;

/// The solver of a report: one of the crate, or a custom one by its name.
///
/// ```
/// use stribeck::SolverId;
/// assert_eq!(SolverId::NewtonKrylov.to_string(), "newton_krylov");
/// assert_eq!("newton_krylov".parse(), Ok(SolverId::NewtonKrylov));
/// assert_eq!(SolverId::Custom("steepest_descent").to_string(), "steepest_descent");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SolverId {
    /// [`NewtonKrylov`](crate::reynolds::NewtonKrylov).
    NewtonKrylov,
    /// [`SemiSystem`](crate::reynolds::SemiSystem).
    SemiSystem,
    /// [`Multigrid`](crate::reynolds::Multigrid).
    Multigrid,
    /// Started by [`Multigrid`](crate::reynolds::Multigrid) and finished by
    /// [`NewtonKrylov`](crate::reynolds::NewtonKrylov).
    MultigridThenNewton,
    /// [`Dry`](crate::reynolds::Dry).
    Dry,
    /// [`AsperityInlets`](crate::reynolds::AsperityInlets).
    AsperityInlets,
    /// [`Auto`](crate::reynolds::Auto); its reports name the selected solver.
    Auto,
    /// The solver of [`GivenFilm`](crate::reynolds::GivenFilm).
    GivenFilm,
    /// A custom solver.
    Custom(&'static str),
}

impl SolverId {
    /// Solvers of the crate.
    const OWN: [Self; 8] = [
        Self::NewtonKrylov,
        Self::SemiSystem,
        Self::Multigrid,
        Self::MultigridThenNewton,
        Self::Dry,
        Self::AsperityInlets,
        Self::Auto,
        Self::GivenFilm,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::NewtonKrylov => "newton_krylov",
            Self::SemiSystem => "semi_system",
            Self::Multigrid => "multigrid",
            Self::MultigridThenNewton => "multigrid+newton_krylov",
            Self::Dry => "dry",
            Self::AsperityInlets => "asperity_inlets",
            Self::Auto => "auto",
            Self::GivenFilm => "given_film",
            Self::Custom(name) => name,
        }
    }
}

serialize_as_displayed!(SolverId);

impl fmt::Display for SolverId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for SolverId {
    type Err = InputError;

    /// The solver of the crate with this name.
    ///
    /// # Errors
    /// [`InputError::Conflict`] for all other names; names of [`SolverId::Custom`] are unknown to the crate.
    fn from_str(name: &str) -> Result<Self, InputError> {
        Self::OWN.into_iter().find(|solver| solver.name() == name).ok_or_else(|| InputError::Conflict {
            field: "solver".to_owned(),
            reason: format!("no solver of the crate is called `{name}`"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solver_names_round_trip() {
        for solver in SolverId::OWN {
            assert_eq!(solver.to_string().parse(), Ok(solver));
        }
        let unknown = SolverId::Custom("own").to_string().parse::<SolverId>().unwrap_err();
        assert_eq!(unknown.to_string(), "solver: no solver of the crate is called `own`");
    }
}
