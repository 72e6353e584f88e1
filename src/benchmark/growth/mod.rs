//! Growth laws compared over measured films.
//!
//! Each law is fitted to all films together. Laws are ordered by their Akaike information criterion, corrected for
//! few points: `AICc = n ln(RSS/n) + 2 k + 2 k (k + 1)/(n - k - 1)` with `n` points, the sum of squared residuals
//! `RSS`, and `k` constants, the standard deviation included (Hurvich and Tsai, Biometrika 76, 1989, 297-307). A
//! difference above 10 is strong evidence for the law with the smaller value. A law that cannot be fitted is a row
//! with the reason.
//!
//! ```
//! use stribeck::benchmark::growth::{GrowthLaw, compare, laws};
//! use stribeck::tribochem::{FilmGrowthLaw, Ghanbarzadeh, MeasuredFilm, StressActivated};
//! let truth = Ghanbarzadeh::azam_2019();
//! let mut table = String::new();
//! let at = stribeck::SurfaceState::new(2e8, 353.15).with_shear_stress(2e8).with_in_contact(true);
//! for k in 1..40 {
//!     let (time, mut states) = (300.0 * f64::from(k), [0.0; 2]);
//!     truth.advance(&at, time, &mut states);
//!     // Rounded to 0.1 nm.
//!     table += &format!("{time},353.15,2e8,{:.1}e-9\n", 1e9 * truth.thickness(&states));
//! }
//! let films = MeasuredFilm::from_csv(table.as_bytes())?;
//! let own = GrowthLaw::new("own", [("h_max", 1e-7), ("rate", 1e-3)], |c| {
//!     Ok(Box::new(StressActivated::by_shear_stress(c[0], c[1], 0.0, 0.0)?))
//! });
//! let comparison = compare(&films, laws(&films).into_iter().chain([own]));
//! assert_eq!(comparison.rows()[0].law, "ghanbarzadeh");
//! assert!(comparison.svg().starts_with("<svg"));
//! # Ok::<(), stribeck::tribochem::FitError>(())
//! ```

mod comparison;
mod law;
mod picture;

pub use comparison::{GrowthComparison, GrowthRow, compare};
pub use law::{GrowthLaw, laws};
