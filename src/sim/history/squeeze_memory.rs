//! Lubricant mass of the previous contacts, for the squeeze term of the next one.
//!
//! A cell holds the mass per area `theta rho/rho_0 h`, as a film thickness \[m\]. Its time derivative is the
//! squeeze term of the Reynolds equation, by second-order differences from the third contact on.

use crate::error::InputError;
use crate::reynolds::Squeeze;

/// Largest ratio of successive steps for the second-order difference, which is unstable from a ratio of 2.4 on.
const LONGEST: f64 = 2.0;

/// Masses of the last two contacts and the lengths of the steps after them, newest first.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(in crate::sim) struct SqueezeMemory {
    /// `theta rho/rho_0 h` of every cell \[m\].
    masses: [Vec<f64>; 2],
    /// Lengths of the steps after these contacts \[s\].
    steps: [f64; 2],
}

impl SqueezeMemory {
    /// Zero masses.
    pub(in crate::sim) fn new(nodes: usize) -> Self {
        Self { masses: [vec![0.0; nodes], vec![0.0; nodes]], steps: [0.0; 2] }
    }

    /// Rejects fields that do not fit `grid`.
    #[cfg(feature = "serde")]
    pub(in crate::sim) fn validate(&self, grid: &crate::grid::Grid) -> Result<(), InputError> {
        for mass in &self.masses {
            grid.require_field("carried mass", mass)?;
        }
        self.steps.iter().try_for_each(|step| InputError::require_non_negative("last step", *step))
    }

    /// Stores the mass of a contact that lasted `time_step`.
    pub(in crate::sim) fn keep(&mut self, mass: &[f64], time_step: f64) {
        self.masses.swap(0, 1);
        self.masses[0].copy_from_slice(mass);
        self.steps = [time_step, self.steps[0]];
    }

    /// The squeeze term of the contact after `contacts` others; `None` for the first. It is second-order in time,
    /// first-order in the second contact and after a step more than twice as long as the previous one. The
    /// reference mass may be written to `combined`.
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
