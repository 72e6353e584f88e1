//! Conditions over a cycle: the table `[cycle]` as written.

use std::f64::consts::TAU;
use std::path::PathBuf;

use crate::error::InputError;
use crate::sim::scene::cycle_source::CycleSource;

/// Conditions of a contact over a cycle. Each list has one value per row; quantities without a list are those of the
/// scene. Between rows all quantities are linear in time.
///
/// # Examples
///
/// A ball that rubs a reciprocating disc:
///
/// ```
/// use stribeck::sim::scene::CycleSpec;
/// let turn = std::f64::consts::TAU;
/// let mut cycle = CycleSpec::default();
/// cycle.time = (0..=36).map(|k| f64::from(k) / 360.0).collect(); // 10 Hz
/// cycle.ball_speed = vec![0.0; 37];
/// cycle.disc_speed = cycle.time.iter().map(|time| 0.3 * (turn * 10.0 * time).cos()).collect();
/// assert!(!cycle.quasi_static && !cycle.once);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct CycleSpec {
    /// A text file in place of the lists: a line of names with units, `angle (deg)`, then the rows; commas, semicolons, tabs or
    /// blanks separate the cells.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub table: Option<PathBuf>,
    /// Times of the rows \[s\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub time: Vec<f64>,
    /// Angles of the rows in place of times \[rad\]; 2 pi take the period.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub angle: Vec<f64>,
    /// Time of a cycle, or of a turn \[s\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub period: Option<f64>,
    /// Load \[N\], of a line contact per length \[N/m\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub load: Vec<f64>,
    /// Speed of the ball along x relative to the contact \[m/s\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub ball_speed: Vec<f64>,
    /// Speed of the disc along x relative to the contact \[m/s\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub disc_speed: Vec<f64>,
    /// Reduced radius of a sphere or cylinder \[m\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub radius: Vec<f64>,
    /// Bulk temperature \[K\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub bulk_temperature: Vec<f64>,
    /// Steps of equal time in a cycle. If absent, one per half-width of entrained film where it passes fastest, 400 to 4000.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub steps: Option<usize>,
    /// Solves each row as a steady contact, without squeeze; as a passage of the surfaces where the roughness moves.
    pub quasi_static: bool,
    /// The table runs once from a steady first contact, as a tooth in mesh; otherwise it repeats.
    pub once: bool,
    /// Cycles of a history: the bodies wear and grow tribofilms from cycle to cycle. Absent: they do neither.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub repeat: Option<usize>,
    /// Cycles of a history that are solved, each for the wear and growth of `repeat / solved` cycles; all if absent.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub solved: Option<usize>,
}

impl CycleSpec {
    /// The cycles of a history that are solved, and the number of cycles that each stands for.
    pub(super) fn history(&self) -> Result<Option<(usize, f64)>, InputError> {
        let Some(repeat) = self.repeat else {
            return match self.solved {
                None => Ok(None),
                Some(solved) => Err(InputError::Conflict {
                    field: format!("cycle.solved = {solved}"),
                    reason: "are those of cycle.repeat cycles, which is missing".to_owned(),
                }),
            };
        };
        InputError::require(repeat >= 1, "cycle.repeat", repeat as f64, "at least 1")?;
        let solved = self.solved.unwrap_or(repeat);
        let requirement = "between 1 and cycle.repeat";
        InputError::require((1..=repeat).contains(&solved), "cycle.solved", solved as f64, requirement)?;
        Ok(Some((solved, repeat as f64 / solved as f64)))
    }

    /// Times of the rows \[s\], by angles where these are given.
    pub(super) fn times(&self, source: &CycleSource) -> Result<Vec<f64>, InputError> {
        let conflict = |field: &str, reason: &str| {
            Err(InputError::Conflict { field: field.to_owned(), reason: reason.to_owned() })
        };
        if let Some(period) = self.period {
            InputError::require_positive("cycle.period", period)?;
        }
        let (key, times) = match (self.time.as_slice(), self.angle.as_slice(), self.period) {
            ([], [], _) => return Err(source.without_rows()),
            ([], angles, Some(period)) => {
                ("angle", angles.iter().map(|angle| angle / TAU * period).collect())
            }
            ([], _, None) => {
                return conflict("cycle.period", "is missing: the time of a turn, for the angles");
            }
            (times, [], _) => ("time", times.to_vec()),
            _ => return conflict("cycle.time", "give times or angles, not both"),
        };
        let given: &[f64] = if key == "time" { &self.time } else { &self.angle };
        source.require_rows(key, given.len())?;
        for (row, value) in given.iter().enumerate() {
            source.require(value.is_finite(), (key, row), *value, "finite")?;
        }
        for (row, pair) in given.windows(2).enumerate() {
            let requirement = "above the row before, a cycle does not go back";
            source.require(pair[1] > pair[0], (key, row + 1), pair[1], requirement)?;
        }
        Ok(times)
    }
}
