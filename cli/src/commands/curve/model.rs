//! The model of each contact of a curve: asperity inlets where they hold, the resolved one elsewhere.

use stribeck::sim::ContactSolution;
use stribeck::sim::scene::{Scene, SolverModel};

/// Models of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
pub(crate) enum ModelChoice {
    /// Asperity inlets where their range holds, else the resolved model
    Auto,
    /// The resolved model
    Resolved,
    /// Asperity inlets for all contacts
    AsperityInlets,
}

/// Which model comes first for the next value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Plan {
    /// Asperity inlets, whose result is taken where they hold.
    TryInlets,
    /// Asperity inlets alone.
    Inlets,
    Resolved,
}

impl Plan {
    /// The choice of the options, or that of a scene whose table names the model.
    pub(super) fn new(choice: ModelChoice, scene: &Scene) -> Self {
        match choice {
            ModelChoice::AsperityInlets => Self::Inlets,
            ModelChoice::Resolved => Self::Resolved,
            ModelChoice::Auto if !scene.solver.model.is_resolved() => Self::Inlets,
            ModelChoice::Auto => Self::TryInlets,
        }
    }

    /// Model of the scene of the first attempt.
    pub(super) fn model(self) -> SolverModel {
        if self == Self::Resolved { SolverModel::Resolved } else { SolverModel::AsperityInlets }
    }

    /// The plan for the following values after asperity inlets did not hold for `solution`: another value changes the
    /// smooth film alone.
    pub(super) fn after(self, solution: &ContactSolution) -> Self {
        let is_film = solution.warnings.iter().any(|warning| warning.field == "solver.model");
        if is_film && solution.roughness.composite_rq > 0.0 { self } else { Self::Resolved }
    }
}

/// Values of which resolved points are wanted too: `count` of `all`, evenly spread.
pub(super) fn resolved_values(count: u32, all: usize) -> Vec<usize> {
    let count = (count as usize).min(all);
    let last = all.saturating_sub(1);
    match count {
        0 => Vec::new(),
        1 => vec![last / 2],
        _ => (0..count).map(|k| (k * last + (count - 1) / 2) / (count - 1)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::resolved_values;

    #[test]
    fn resolved_values_are_spread_over_all_and_each_occurs_once() {
        assert!(resolved_values(0, 13).is_empty());
        assert_eq!(resolved_values(1, 13), [6]);
        assert_eq!(resolved_values(3, 13), [0, 6, 12]);
        assert_eq!(resolved_values(4, 13), [0, 4, 8, 12]);
        assert_eq!(resolved_values(9, 3), [0, 1, 2]);
    }
}
