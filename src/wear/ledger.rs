//! Height balance of a surface.

use crate::error::InputError;

/// View of the height balance of a surface, all fields on the nodes of its body \[m\]:
/// `surface = initial - wear - plastic + film`.
///
/// ```
/// use stribeck::wear::SurfaceLedger;
/// let ledger = SurfaceLedger::new(&[10e-9, 20e-9], &[1e-9, 2e-9], &[0.0, 3e-9], &[5e-9, 0.0])?;
/// let mut surface = [0.0; 2];
/// ledger.surface_into(&mut surface)?;
/// assert!((surface[0] - 14e-9).abs() < 1e-23 && (surface[1] - 15e-9).abs() < 1e-23);
/// assert!((ledger.volumes(1e-12).wear - 3e-21).abs() < 1e-33);
/// assert!(ledger.residual(&surface)? < 1e-23);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SurfaceLedger<'a> {
    /// Initial heights \[m\].
    initial: &'a [f64],
    /// Worn depth \[m\].
    wear: &'a [f64],
    /// Plastic depth \[m\].
    plastic: &'a [f64],
    /// Tribofilm \[m\].
    film: &'a [f64],
}

/// Volumes of the height balance of a body \[m^3\].
///
/// # Examples
///
/// ```
/// use stribeck::wear::SurfaceLedger;
/// let (initial, wear, plastic, film) = ([0.0; 2], [2e-9, 0.0], [0.0, 1e-9], [5e-9, 5e-9]);
/// let ledger = SurfaceLedger::new(&initial, &wear, &plastic, &film)?;
/// let volumes = ledger.volumes(1e-12);
/// assert!((volumes.net() / 7e-21 - 1.0).abs() < 1e-12);
/// assert_eq!(ledger.residual(&[3e-9, 4e-9])?, 0.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Volumes {
    /// Worn volume.
    pub wear: f64,
    /// Plastic volume.
    pub plastic: f64,
    /// Volume of the tribofilm.
    pub film: f64,
}

impl Volumes {
    /// Change of the volume below the surface \[m^3\]: `film - wear - plastic`.
    pub fn net(&self) -> f64 {
        self.film - self.wear - self.plastic
    }
}

impl<'a> SurfaceLedger<'a> {
    /// View of the four fields.
    ///
    /// # Errors
    /// Fields of different lengths.
    pub fn new(
        initial: &'a [f64],
        wear: &'a [f64],
        plastic: &'a [f64],
        film: &'a [f64],
    ) -> Result<Self, InputError> {
        InputError::require_len("wear", wear, initial.len())?;
        InputError::require_len("plastic", plastic, initial.len())?;
        InputError::require_len("film", film, initial.len())?;
        Ok(Self { initial, wear, plastic, film })
    }

    /// Surface heights from the balance \[m\].
    fn heights(&self) -> impl Iterator<Item = f64> + '_ {
        let lost = self.wear.iter().zip(self.plastic);
        let rows = self.initial.iter().zip(lost).zip(self.film);
        rows.map(|((initial, (wear, plastic)), film)| initial - wear - plastic + film)
    }

    /// Overwrites `out` \[m\] with the present surface.
    ///
    /// # Errors
    /// A length of `out` other than that of the fields.
    pub fn surface_into(&self, out: &mut [f64]) -> Result<(), InputError> {
        InputError::require_len("out", out, self.initial.len())?;
        for (out, height) in out.iter_mut().zip(self.heights()) {
            *out = height;
        }
        Ok(())
    }

    /// Volumes on cells of `cell_area` \[m^2\].
    pub fn volumes(&self, cell_area: f64) -> Volumes {
        let volume = |field: &[f64]| field.iter().sum::<f64>() * cell_area;
        Volumes { wear: volume(self.wear), plastic: volume(self.plastic), film: volume(self.film) }
    }

    /// Largest difference \[m\] between a separately updated `surface` and the balance; NaN if any value is NaN.
    ///
    /// # Errors
    /// A length of `surface` other than that of the fields.
    pub fn residual(&self, surface: &[f64]) -> Result<f64, InputError> {
        InputError::require_len("surface", surface, self.initial.len())?;
        let differences = surface.iter().zip(self.heights()).map(|(kept, height)| (kept - height).abs());
        Ok(differences.fold(0.0, |largest: f64, d| if d.is_nan() || d > largest { d } else { largest }))
    }
}
