//! Fits of growth-law constants to measured films.
//!
//! The constants of a law are positive and differ by orders of magnitude, so the fit uses their logarithms.
//! It returns a constant only if the measurement determines it, by the singular values of the Jacobian and
//! the width of the confidence interval. [`fit_growth_law`] accepts any law that can be constructed from a
//! slice of constants.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::fit_error::FitError;
use super::{FilmGrowthLaw, GrowthCurve, MeasuredFilm};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// Step of the difference quotients, in the logarithm of a constant.
const PROBE: f64 = 1e-5;
/// Largest condition number for which the constants count as independent.
const MAX_CONDITION: f64 = 1e6;
/// Largest ratio of interval end to value for which a constant counts as determined.
const WIDEST_FACTOR: f64 = 10.0;
/// Ratio of a constant to its initial value above which a failed fit counts as divergent.
const FARTHEST_FACTOR: f64 = 1e4;
/// Two-sided confidence level.
const LEVEL: f64 = 0.95;

/// A fitted constant.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FittedConstant {
    /// Its name.
    pub name: String,
    /// Best value.
    pub value: f64,
    /// Ends of the 95 % confidence interval.
    pub interval: [f64; 2],
}

/// A law with fitted constants.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct GrowthFit<L> {
    /// The law.
    pub law: L,
    /// Its constants, in the order of the initial values.
    pub constants: Vec<FittedConstant>,
    /// Residual standard deviation: root of the sum of squared residuals over the degrees of freedom \[m\].
    pub standard_deviation: f64,
}

/// Fits the constants of a law to a film measured under the constant conditions `at`.
///
/// `start` lists the names and positive initial values of the constants; `law` constructs the law from
/// values. Levenberg-Marquardt minimizes the sum of squared residuals over the logarithms of the constants.
/// The confidence intervals are those of the linearized problem, `ln c +- t s sqrt[(J^T J)^-1]`, with the
/// Student quantile `t` for the degrees of freedom. Measurement errors are assumed independent and equal.
///
/// # Errors
/// Too few points; constants that `law` rejects; no convergence; a constant that the measurement does not
/// determine because its effect is indistinguishable from that of the others, or because its interval exceeds
/// a factor of 10.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::tribochem::{FilmGrowthLaw, Ghanbarzadeh, GrowthCurve, fit_growth_law};
/// let at = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1e8).with_sliding_speed(0.005).with_in_contact(true);
/// // A film by the law itself, rounded to 0.1 nm.
/// let truth = Ghanbarzadeh::azam_2019();
/// let times: Vec<f64> = (1..=60).map(|k| 200.0 * f64::from(k)).collect();
/// let films = times.iter().map(|&time| {
///     let mut states = [0.0; 2];
///     truth.advance(&at, time, &mut states);
///     (truth.thickness(&states) * 1e10).round() * 1e-10
/// });
/// let curve = GrowthCurve::new(times.clone(), films.collect())?;
/// let start = [("h_max", 150e-9), ("x_tribo", 1e-16), ("C3", 20e-9), ("C4", 1e-3)];
/// let fit = fit_growth_law(&curve, &at, &start, |c| Ghanbarzadeh::new(c[0], c[1], c[2], c[3]))?;
/// for (constant, expected) in fit.constants.iter().zip([200e-9, 1.66e-16, 54.32e-9, 4.022e-4]) {
///     let [low, high] = constant.interval;
///     assert!(low < expected && expected < high, "{constant:?}");
/// }
/// # Ok::<(), stribeck::tribochem::FitError>(())
/// ```
pub fn fit_growth_law<L: FilmGrowthLaw>(
    curve: &GrowthCurve,
    at: &SurfaceState,
    start: &[(&str, f64)],
    law: impl Fn(&[f64]) -> Result<L, InputError>,
) -> Result<GrowthFit<L>, FitError> {
    fit_growth_law_to(&[MeasuredFilm::constant(curve, at)], start, law)
}

/// Fits the constants of a law to several films together, measured under varying conditions: several temperatures
/// and stresses determine energies and volumes of activation. Otherwise as [`fit_growth_law`].
///
/// # Errors
/// As of [`fit_growth_law`].
///
/// ```
/// use stribeck::tribochem::{FilmGrowthLaw, MeasuredFilm, ThermalArrhenius, fit_growth_law_to};
/// let truth = ThermalArrhenius::new(100e-9, 1e8, 1.25e-19)?;
/// let mut table = String::new();
/// for temperature in [350.0, 370.0, 390.0] {
///     let at = stribeck::SurfaceState::new(1e9, temperature).with_in_contact(true);
///     for k in 1..20 {
///         let (time, mut states) = (60.0 * f64::from(k), [0.0]);
///         truth.advance(&at, time, &mut states);
///         table += &format!("{time},{temperature},1e8,{:e}\n", states[0]);
///     }
/// }
/// let films = MeasuredFilm::from_csv(table.as_bytes())?;
/// let start = [("h_max", 80e-9), ("prefactor", 1e7), ("energy", 1.2e-19)];
/// let fit = fit_growth_law_to(&films, &start, |c| ThermalArrhenius::new(c[0], c[1], c[2]))?;
/// assert!((fit.constants[2].value / 1.25e-19 - 1.0).abs() < 1e-3, "{:?}", fit.constants);
/// # Ok::<(), stribeck::tribochem::FitError>(())
/// ```
pub fn fit_growth_law_to<L: FilmGrowthLaw>(
    films: &[MeasuredFilm],
    start: &[(&str, f64)],
    law: impl Fn(&[f64]) -> Result<L, InputError>,
) -> Result<GrowthFit<L>, FitError> {
    let points = films.iter().map(|film| film.times().len()).sum();
    let constants = start.len();
    if points <= constants {
        return Err(FitError::TooFewPoints { points, constants });
    }
    for (name, value) in start {
        InputError::require_positive(name, *value)?;
    }
    let values: Vec<f64> = start.iter().map(|(_, value)| *value).collect();
    law(&values)?;
    let thicknesses = films.iter().flat_map(MeasuredFilm::thicknesses);
    let scale = thicknesses.fold(0.0_f64, |largest, h| largest.max(h.abs()));
    if scale == 0.0 {
        let constant = start.first().map_or_else(String::new, |(name, _)| (*name).to_owned());
        return Err(FitError::Undetermined { constant, reason: "there is no film".to_owned() });
    }
    let logarithms = DVector::from_iterator(constants, values.iter().map(|value| value.ln()));
    let problem = Problem { films, points, law: &law, scale, logarithms };
    let (problem, report) = LevenbergMarquardt::new().with_patience(200).minimize(problem);
    if !report.termination.was_successful() {
        return Err(problem.failure(start, &report.termination));
    }
    problem.conclude(start)
}

/// Thickness by `law` at each time of `film` \[m\].
pub(crate) fn thicknesses<'a, L: FilmGrowthLaw + ?Sized>(
    law: &'a L,
    film: &'a MeasuredFilm,
) -> impl Iterator<Item = f64> + 'a {
    let (mut states, mut time) = (vec![0.0; law.n_states().max(1)], 0.0);
    film.times().iter().zip(film.conditions()).map(move |(&next, at)| {
        law.advance(at, next - time, &mut states);
        time = next;
        law.thickness(&states)
    })
}

/// Least-squares problem: residuals and Jacobian.
struct Problem<'a, F> {
    /// The measurements.
    films: &'a [MeasuredFilm],
    /// Number of their points.
    points: usize,
    /// Constructs the law from the constants.
    law: &'a F,
    /// Largest thickness, the scale of the residuals.
    scale: f64,
    /// Logarithms of the constants.
    logarithms: DVector<f64>,
}

impl<L: FilmGrowthLaw, F: Fn(&[f64]) -> Result<L, InputError>> Problem<'_, F> {
    /// The law for these logarithms of the constants.
    fn build(&self, logarithms: &DVector<f64>) -> Result<L, InputError> {
        let values: Vec<f64> = logarithms.iter().map(|l| l.exp()).collect();
        (self.law)(&values)
    }

    /// Relative residuals; `None` if the law rejects the constants.
    fn deviations(&self, logarithms: &DVector<f64>) -> Option<DVector<f64>> {
        let law = self.build(logarithms).ok()?;
        let mut deviations = Vec::with_capacity(self.points);
        for film in self.films {
            let computed = thicknesses(&law, film).zip(film.thicknesses());
            deviations.extend(computed.map(|(computed, measured)| (computed - measured) / self.scale));
        }
        let deviations = DVector::from_vec(deviations);
        deviations.iter().all(|d| d.is_finite()).then_some(deviations)
    }

    fn sensitivities(&self) -> Option<DMatrix<f64>> {
        let mut matrix = DMatrix::zeros(self.points, self.logarithms.len());
        for (k, mut column) in matrix.column_iter_mut().enumerate() {
            let [up, down] = [PROBE, -PROBE].map(|probe| {
                let mut moved = self.logarithms.clone();
                moved[k] += probe;
                self.deviations(&moved)
            });
            column.copy_from(&((up? - down?) / (2.0 * PROBE)));
        }
        Some(matrix)
    }

    /// Error of a minimization that stopped early. A constant far from its initial value is not determined by
    /// the measurement.
    fn failure(&self, start: &[(&str, f64)], termination: &TerminationReason) -> FitError {
        let ways =
            start.iter().zip(self.logarithms.iter()).map(|((name, value), l)| (name, (l - value.ln()).abs()));
        match ways.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((name, way)) if way.is_nan() || way > FARTHEST_FACTOR.ln() => FitError::Undetermined {
                constant: (*name).to_owned(),
                reason: "the residuals keep decreasing as it diverges from its initial value".to_owned(),
            },
            _ => FitError::NotConverged { reason: format!("{termination:?}") },
        }
    }

    fn conclude(self, start: &[(&str, f64)]) -> Result<GrowthFit<L>, FitError> {
        let lost = || FitError::NotConverged { reason: "the law rejects the fitted constants".to_owned() };
        let freedom = (self.points - start.len()) as f64;
        let deviations = self.deviations(&self.logarithms).ok_or_else(lost)?;
        let spread = (deviations.norm_squared() / freedom).sqrt();
        let variances = variances(&self.sensitivities().ok_or_else(lost)?, start)?;
        let quantile = StudentsT::new(0.0, 1.0, freedom)
            .map_err(|error| FitError::NotConverged { reason: error.to_string() })?
            .inverse_cdf(0.5 + 0.5 * LEVEL);
        let mut constants = Vec::with_capacity(start.len());
        for ((name, _), (logarithm, variance)) in start.iter().zip(self.logarithms.iter().zip(variances)) {
            let half = quantile * spread * variance.sqrt();
            if half > WIDEST_FACTOR.ln() {
                return Err(FitError::Undetermined {
                    constant: (*name).to_owned(),
                    reason: format!("its 95 % interval reaches to {:.1e} times its value", half.exp()),
                });
            }
            constants.push(FittedConstant {
                name: (*name).to_owned(),
                value: logarithm.exp(),
                interval: [(logarithm - half).exp(), (logarithm + half).exp()],
            });
        }
        Ok(GrowthFit {
            law: self.build(&self.logarithms)?,
            constants,
            standard_deviation: spread * self.scale,
        })
    }
}

/// Diagonal of `(J^T J)^-1`; an error if a combination of constants has no effect.
fn variances(sensitivities: &DMatrix<f64>, start: &[(&str, f64)]) -> Result<Vec<f64>, FitError> {
    let svd = sensitivities.clone().svd(false, true);
    let failed = || FitError::NotConverged { reason: "no singular values".to_owned() };
    let directions = svd.v_t.ok_or_else(failed)?;
    let largest = svd.singular_values.max();
    let (weakest, smallest) = svd.singular_values.argmin();
    if smallest.is_nan() || smallest * MAX_CONDITION <= largest {
        let (column, _) = directions.row(weakest).transpose().abs().argmax();
        let constant = start.get(column).map_or_else(String::new, |(name, _)| (*name).to_owned());
        let reason =
            "its effect on the film is indistinguishable from that of the other constants".to_owned();
        return Err(FitError::Undetermined { constant, reason });
    }
    let scaled = |k: usize| {
        let rows = directions.column(k);
        rows.iter().zip(svd.singular_values.iter()).map(|(v, s)| (v / s).powi(2)).sum()
    };
    Ok((0..start.len()).map(scaled).collect())
}

impl<L: FilmGrowthLaw, F: Fn(&[f64]) -> Result<L, InputError>> LeastSquaresProblem<f64, Dyn, Dyn>
    for Problem<'_, F>
{
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, logarithms: &DVector<f64>) {
        self.logarithms.copy_from(logarithms);
    }

    fn params(&self) -> DVector<f64> {
        self.logarithms.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.deviations(&self.logarithms)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.sensitivities()
    }
}
