//! Measured film thickness over time.

use std::io::Read;
use std::path::Path;

use super::fit_error::FitError;
use super::measured_rows::{read_rows, read_text};
use crate::error::InputError;

/// A film measured at several times of a rubbing test that began with a bare surface.
///
/// ```
/// use stribeck::tribochem::GrowthCurve;
/// let table = "time_s,thickness_m\n60,12.8e-9\n600,92.3e-9\n1800,149.8e-9\n";
/// let curve = GrowthCurve::from_csv(table.as_bytes())?;
/// assert_eq!(curve.times(), [60.0, 600.0, 1800.0]);
/// assert_eq!(curve.thicknesses()[1], 92.3e-9);
/// assert!(GrowthCurve::from_csv("60,12.8e-9\n600,thick\n".as_bytes()).is_err());
/// # Ok::<(), stribeck::tribochem::FitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct GrowthCurve {
    /// Ascending times \[s\].
    times: Vec<f64>,
    /// Thickness at each time \[m\].
    thicknesses: Vec<f64>,
}

impl GrowthCurve {
    /// A curve of `times` \[s\] since the surface was bare, ascending, and `thicknesses` \[m\]; noise may
    /// make a thickness negative.
    ///
    /// # Errors
    /// Slices of different length, a value not finite, a negative time, times that do not ascend.
    pub fn new(times: Vec<f64>, thicknesses: Vec<f64>) -> Result<Self, InputError> {
        InputError::require_len("thickness", &thicknesses, times.len())?;
        InputError::require_finite("time", &times)?;
        InputError::require_finite("thickness", &thicknesses)?;
        for pair in times.windows(2) {
            if let [before, after] = pair {
                InputError::require(after > before, "time", *after, "later than the one before it")?;
            }
        }
        if let Some(&first) = times.first() {
            InputError::require_non_negative("time", first)?;
        }
        Ok(Self { times, thicknesses })
    }

    /// A curve from comma-separated text with two columns, time \[s\] and thickness \[m\]. A first row
    /// without numbers is a heading; lines that start with `#` are skipped.
    ///
    /// # Errors
    /// [`FitError::Csv`] with the line of a row that is not two numbers; those of [`GrowthCurve::new`].
    pub fn from_csv(reader: impl Read) -> Result<Self, FitError> {
        let (mut times, mut thicknesses) = (Vec::new(), Vec::new());
        read_rows(reader, "a time and a thickness", |row, numbers| match *numbers {
            [Some(time), Some(thickness)] => {
                times.push(time);
                thicknesses.push(thickness);
                true
            }
            [None, None] => row == 0,
            _ => false,
        })?;
        Ok(Self::new(times, thicknesses)?)
    }

    /// Reads a file; see [`GrowthCurve::from_csv`].
    ///
    /// # Errors
    /// [`FitError::Io`] where the file cannot be read or has more than 16 MB; those of
    /// [`GrowthCurve::from_csv`].
    pub fn read_csv(path: impl AsRef<Path>) -> Result<Self, FitError> {
        Self::from_csv(read_text(path.as_ref())?.as_bytes())
    }

    /// Times since the surface was bare \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Thickness at each time \[m\].
    pub fn thicknesses(&self) -> &[f64] {
        &self.thicknesses
    }
}
