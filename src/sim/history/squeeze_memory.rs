//! What the contacts before carried along, which the next one squeezes.
//!
//! A cell holds the mass `theta rho/rho_0 h` per area, as a film thickness \[m\]. Its change in time is the
//! squeeze of Reynolds' equation; the difference is of second order from the third contact on.

use crate::error::InputError;
use crate::reynolds::Squeeze;

/// Longest step over the one before with which the difference of second order is taken; from 2.4 on it is
/// unstable.
const LONGEST: f64 = 2.0;

/// Masses of the last two contacts and the steps after them, newest first.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(in crate::sim) struct SqueezeMemory {
    /// `theta rho/rho_0 h` of every cell \[m\].
    masses: [Vec<f64>; 2],
    /// Lengths of the steps after these contacts \[s\].
    steps: [f64; 2],
}

impl SqueezeMemory {
    /// Nothing remembered yet.
    pub(in crate::sim) fn new(nodes: usize) -> Self {
        Self { masses: [vec![0.0; nodes], vec![0.0; nodes]], steps: [0.0; 2] }
    }

    /// Refuses fields that are not those of a simulation on `grid`.
    #[cfg(feature = "serde")]
    pub(in crate::sim) fn validate(&self, grid: &crate::grid::Grid) -> Result<(), InputError> {
        for mass in &self.masses {
            grid.require_field("carried mass", mass)?;
        }
        self.steps.iter().try_for_each(|step| InputError::require_non_negative("last step", *step))
    }

    /// Takes over the mass of a contact that lasted `time_step`.
    pub(in crate::sim) fn keep(&mut self, mass: &[f64], time_step: f64) {
        self.masses.swap(0, 1);
        self.masses[0].copy_from_slice(mass);
        self.steps = [time_step, self.steps[0]];
    }

    /// The squeeze of the contact after `contacts` others, none of the first. It is of second order in time,
    /// of first order in the second contact and after a step more than twice as long as the one before. What
    /// it refers to may be written to `combined`.
    pub(in crate::sim) fn squeeze<'a>(
        &'a self,
        contacts: u64,
        combined: &'a mut [f64],
    ) -> Result<Option<Squeeze<'a>>, InputError> {
        let [newest, oldest] = &self.masses;
        match contacts {
            0 => Ok(None),
            2.. if self.steps[0] <= LONGEST * self.steps[1] => {
                Squeeze::second_order([newest, oldest], self.steps, combined).map(Some)
            }
            _ => Ok(Some(Squeeze { previous_mass: newest, time_step: self.steps[0] })),
        }
    }
}
