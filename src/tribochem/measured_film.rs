//! Measured films under varying conditions.

use std::io::Read;
use std::path::Path;

use super::fit_error::FitError;
use super::growth_curve::GrowthCurve;
use super::measured_rows::{read_rows, read_text};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// A film measured at several times of a rubbing test that began with a bare surface, and the conditions from one
/// measurement to the next.
///
/// ```
/// use stribeck::tribochem::MeasuredFilm;
/// let table = "time_s,temperature_k,stress_pa,thickness_m\n\
///              60,353,2e8,10e-9\n600,353,2e8,60e-9\n\
///              60,373,2e8,20e-9\n600,373,2e8,90e-9\n";
/// // Times that do not ascend begin another film.
/// let films = MeasuredFilm::from_csv(table.as_bytes())?;
/// assert_eq!((films.len(), films[1].times().len()), (2, 2));
/// assert_eq!(films[1].conditions()[0].temperature, 373.0);
/// # Ok::<(), stribeck::tribochem::FitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredFilm {
    curve: GrowthCurve,
    conditions: Vec<SurfaceState>,
}

impl MeasuredFilm {
    /// A film with `conditions` that hold up to the time of the same index.
    ///
    /// # Errors
    /// As many conditions as points are needed.
    pub fn new(curve: GrowthCurve, conditions: Vec<SurfaceState>) -> Result<Self, InputError> {
        let (expected, found) = (curve.times().len(), conditions.len());
        if expected != found {
            return Err(InputError::Shape { field: "conditions".to_owned(), expected, found });
        }
        Ok(Self { curve, conditions })
    }

    /// A film measured under the constant conditions `at`.
    pub(super) fn constant(curve: &GrowthCurve, at: &SurfaceState) -> Self {
        Self { curve: curve.clone(), conditions: vec![*at; curve.times().len()] }
    }

    /// Films from comma-separated text: time \[s\], temperature \[K\], stress \[Pa\], thickness \[m\], and optionally
    /// pressure \[Pa\]. Without a pressure, shear stress and pressure are both the stress, so that laws of either can
    /// be compared. A first row without numbers is a heading; lines that start with `#` are skipped. The surface is
    /// in solid contact.
    ///
    /// # Errors
    /// [`FitError::Csv`] with the line of a row that is not four or five numbers; a temperature, stress or pressure that
    /// is not positive; errors of [`GrowthCurve::new`].
    pub fn from_csv(reader: impl Read) -> Result<Vec<Self>, FitError> {
        let mut rows: Vec<Vec<[f64; 5]>> = Vec::new();
        read_rows(reader, "time, temperature, stress and thickness", |k, numbers| {
            let row = match *numbers {
                [Some(time), Some(temperature), Some(stress), Some(film)] => {
                    [time, temperature, stress, film, stress]
                }
                [Some(time), Some(temperature), Some(stress), Some(film), Some(pressure)] => {
                    [time, temperature, stress, film, pressure]
                }
                _ => return k == 0 && numbers.iter().all(Option::is_none),
            };
            match rows.last_mut() {
                Some(film) if film.last().is_some_and(|last| row[0] > last[0]) => film.push(row),
                _ => rows.push(vec![row]),
            }
            true
        })?;
        if rows.is_empty() {
            return Err(FitError::TooFewPoints { points: 0, constants: 0 });
        }
        rows.iter().map(|rows| Ok(Self::of_rows(rows)?)).collect()
    }

    /// The film of rows of time, temperature, stress, thickness and pressure.
    fn of_rows(rows: &[[f64; 5]]) -> Result<Self, InputError> {
        let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let mut conditions = Vec::with_capacity(rows.len());
        for [_, temperature, stress, _, pressure] in rows {
            InputError::require_positive("temperature", *temperature)?;
            InputError::require_positive("stress", *stress)?;
            InputError::require_positive("pressure", *pressure)?;
            let at = SurfaceState::new(*pressure, *temperature).with_solid_pressure(*pressure);
            let at = at.with_shear_stress(*stress).with_sliding_speed(0.1);
            conditions.push(at.with_in_contact(true));
        }
        Self::new(GrowthCurve::new(column(0), column(3))?, conditions)
    }

    /// Reads a file; see [`from_csv`](Self::from_csv).
    ///
    /// # Errors
    /// [`FitError::Io`] if the file cannot be read or has more than 16 MB; errors of [`from_csv`](Self::from_csv).
    pub fn read_csv(path: impl AsRef<Path>) -> Result<Vec<Self>, FitError> {
        Self::from_csv(read_text(path.as_ref())?.as_bytes())
    }

    /// Times since the surface was bare \[s\].
    pub fn times(&self) -> &[f64] {
        self.curve.times()
    }

    /// Thickness at each time \[m\].
    pub fn thicknesses(&self) -> &[f64] {
        self.curve.thicknesses()
    }

    /// Conditions up to each time.
    pub fn conditions(&self) -> &[SurfaceState] {
        &self.conditions
    }
}
