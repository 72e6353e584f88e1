//! The viscosity index.

use crate::error::InputError;

/// First viscosity of an interval at 100 degrees Celsius \[cSt\] and the coefficients of `L = a Y^2 + b Y + c` and
/// `H = d Y^2 + e Y + f` in it.
const INTERVALS: [(f64, [f64; 3], [f64; 3]); 16] = [
    (2.0, [1.14673, 1.7576, -0.109], [0.84155, 1.5521, -0.077]),
    (3.8, [3.38095, -15.4952, 33.196], [0.78571, 1.7929, -0.183]),
    (4.4, [2.5, -7.2143, 13.812], [0.82143, 1.5679, 0.119]),
    (5.0, [0.101, 16.635, -45.469], [0.04985, 9.1613, -18.557]),
    (6.4, [3.35714, -23.5643, 78.466], [0.22619, 7.7369, -16.656]),
    (7.0, [0.01191, 21.475, -72.87], [0.79762, -0.7321, 14.61]),
    (7.7, [0.41858, 16.1558, -56.04], [0.05794, 10.5156, -28.24]),
    (9.0, [0.88779, 7.5527, -16.6], [0.26665, 6.7015, -10.81]),
    (12.0, [0.7672, 10.7972, -38.18], [0.20073, 8.4658, -22.49]),
    (15.0, [0.97305, 5.3135, -2.2], [0.28889, 5.9741, -4.93]),
    (18.0, [0.97256, 5.25, -0.98], [0.24504, 7.416, -16.73]),
    (22.0, [0.91413, 7.4759, -21.82], [0.20323, 9.1267, -34.23]),
    (28.0, [0.87031, 9.7157, -50.77], [0.18411, 10.1015, -46.75]),
    (40.0, [0.84703, 12.6752, -133.31], [0.17029, 11.4866, -80.62]),
    (55.0, [0.85921, 11.1009, -83.19], [0.1713, 11.368, -76.94]),
    (70.0, [0.83531, 14.6731, -216.246], [0.16841, 11.8493, -96.947]),
];

/// Viscosity index of an oil with the kinematic viscosities `at_40` and `at_100` degrees Celsius \[m^2/s\].
///
/// Up to 100: `VI = 100 (L - U)/(L - H)` with the viscosity `U` at 40 degrees and those of the reference oils of the
/// same viscosity `Y` at 100 degrees, of index 0 (`L`) and 100 (`H`). Above: `VI = 100 + (10^N - 1)/0.00715`,
/// `N = log(H/U)/log Y`. Needs at least 2 cSt at 100 degrees.
///
/// Source: ASTM D2270, Standard Practice for Calculating Viscosity Index from Kinematic Viscosity at 40 and 100 C.
///
/// ```
/// use stribeck::lubricant::viscosity_index;
/// // The two examples of the standard.
/// assert_eq!(viscosity_index(73.30e-6, 8.86e-6)?.round(), 92.0);
/// assert_eq!(viscosity_index(22.83e-6, 5.05e-6)?.round(), 156.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
///
/// # Errors
/// A viscosity that is not finite and positive, less than 2 cSt at 100 degrees.
pub fn viscosity_index(at_40: f64, at_100: f64) -> Result<f64, InputError> {
    InputError::require_positive("viscosity at 40 degC", at_40)?;
    InputError::require(
        at_100.is_finite() && at_100 >= 2e-6,
        "viscosity at 100 degC",
        at_100,
        "at least 2 cSt = 2e-6 m^2/s, below which the viscosity index is not defined",
    )?;
    let (u, y) = (1e6 * at_40, 1e6 * at_100);
    let interval = INTERVALS.iter().rev().find(|(first, ..)| *first <= y).unwrap_or(&INTERVALS[0]);
    let at = |[a, b, c]: [f64; 3]| (a * y + b) * y + c;
    let (l, h) = (at(interval.1), at(interval.2));
    Ok(if u >= h {
        100.0 * (l - u) / (l - h)
    } else {
        let n = (h / u).log10() / y.log10();
        100.0 + (10.0_f64.powf(n) - 1.0) / 0.00715
    })
}
