//! Kinematic viscosity over temperature by Walther's equation.

use super::viscosity_index::viscosity_index;
use crate::error::InputError;

/// One centistoke \[m^2/s\].
const CENTISTOKE: f64 = 1e-6;
/// Least viscosity of a given point, the end of the standard's range \[m^2/s\].
const LEAST: f64 = 0.21e-6;
/// Largest viscosity of a given point, the end of the standard's range \[m^2/s\].
const MOST: f64 = 20.0;
/// Least difference of the temperatures of two points \[K\].
const APART: f64 = 1.0;
/// Largest `log10 Z`: viscosities above 1e12 cSt have this value.
const MOST_DECADES: f64 = 12.0;
/// Temperatures of the viscosity index, 40 and 100 degrees Celsius \[K\].
pub(crate) const INDEX_TEMPERATURES: [f64; 2] = [313.15, 373.15];
/// Slopes between which that of a viscosity index is sought.
const SLOPES: [f64; 2] = [0.2, 12.0];
/// Bisections of that search.
const HALVINGS: usize = 60;
/// Largest jump of the index between two intervals of the standard.
const INDEX_STEP: f64 = 0.5;
/// Newton steps from `Z` to the viscosity.
const NEWTON_STEPS: usize = 50;

/// Walther's equation: `log10 log10 Z = A - B log10 T` with the temperature `T` in K and
/// `Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu^2)`, `nu` in cSt.
///
/// Range: 0.21 to 2e7 cSt for liquids without phase change. Outside of it viscosities stay finite, positive and
/// monotonic.
///
/// Source: ASTM D341, Standard Practice for Viscosity-Temperature Equations and Charts for Liquid Petroleum or
/// Hydrocarbon Products.
///
/// ```
/// use stribeck::lubricant::Walther;
/// let oil = Walther::new([[46e-6, 313.15], [6.8e-6, 373.15]])?;
/// assert!((oil.kinematic_viscosity(373.15) / 6.8e-6 - 1.0).abs() < 1e-9);
/// assert!((oil.viscosity_index()? - 102.0).abs() < 2.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walther {
    /// `A`.
    offset: f64,
    /// `B`.
    slope: f64,
}

impl Walther {
    /// The equation through two points of viscosity \[m^2/s\] and temperature \[K\].
    ///
    /// # Errors
    /// A viscosity outside of 0.21 to 2e7 cSt, temperatures less than 1 K apart, a viscosity that does not fall
    /// with temperature.
    pub fn new(points: [[f64; 2]; 2]) -> Result<Self, InputError> {
        points.iter().try_for_each(|point| validate(*point))?;
        let [[first, cold], [second, warm]] = points;
        let conflict = |reason: String| Err(InputError::Conflict { field: "kinematic".to_owned(), reason });
        if (warm - cold).abs() < APART {
            return conflict(format!(
                "both viscosities are at {:.2} degC; two temperatures are needed, 40 and 100 degC are usual",
                cold - 273.15
            ));
        }
        if (second - first) * (warm - cold) >= 0.0 {
            return conflict(format!(
                "the viscosity must fall with temperature, but it is {:.6} cSt at {:.2} degC and {:.6} cSt at {:.2} degC; \
                 are the two viscosities exchanged?",
                first / CENTISTOKE,
                cold - 273.15,
                second / CENTISTOKE,
                warm - 273.15
            ));
        }
        let slope = (loglog(first) - loglog(second)) / (warm.log10() - cold.log10());
        Ok(Self::through(points[0], slope))
    }

    /// The equation through one `point` of viscosity \[m^2/s\] and temperature \[K\] whose viscosity index is `index`.
    ///
    /// # Errors
    /// A viscosity outside of 0.21 to 2e7 cSt, an index that no oil through this point has.
    pub fn from_viscosity_index(point: [f64; 2], index: f64) -> Result<Self, InputError> {
        validate(point)?;
        InputError::require(index.is_finite(), "viscosity_index", index, "finite")?;
        // The index falls as the slope grows; slopes too steep for an index count as those of a low one.
        let is_flat =
            |slope: f64| Self::through(point, slope).viscosity_index().is_ok_and(|found| found > index);
        let [mut flat, mut steep] = SLOPES;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (flat + steep);
            if is_flat(middle) { flat = middle } else { steep = middle }
        }
        let oil = Self::through(point, 0.5 * (flat + steep));
        match oil.viscosity_index() {
            Ok(found) if (found - index).abs() < INDEX_STEP => Ok(oil),
            _ => Err(InputError::Conflict {
                field: format!("viscosity_index = {index}"),
                reason: format!(
                    "no oil of {:.6} cSt at {:.2} degC has this index with at least 2 cSt at 100 degC; give two \
                     viscosities instead",
                    point[0] / CENTISTOKE,
                    point[1] - 273.15
                ),
            }),
        }
    }

    /// The equation with this slope through a point.
    fn through([viscosity, temperature]: [f64; 2], slope: f64) -> Self {
        Self { offset: loglog(viscosity) + slope * temperature.log10(), slope }
    }

    /// Kinematic viscosity \[m^2/s\] at `temperature` \[K\], above zero.
    pub fn kinematic_viscosity(&self, temperature: f64) -> f64 {
        let decades = 10.0_f64.powf(self.offset - self.slope * temperature.log10()).min(MOST_DECADES);
        CENTISTOKE * centistokes(10.0_f64.powf(decades))
    }

    /// Temperature \[K\] of the kinematic viscosity `viscosity` \[m^2/s\].
    pub(super) fn temperature_of(&self, viscosity: f64) -> f64 {
        10.0_f64.powf((self.offset - loglog(viscosity)) / self.slope)
    }

    /// The slope `B`.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Viscosities at 40 and 100 degrees Celsius \[m^2/s\].
    pub fn index_viscosities(&self) -> [f64; 2] {
        INDEX_TEMPERATURES.map(|temperature| self.kinematic_viscosity(temperature))
    }

    /// Viscosity index, see [`viscosity_index`].
    ///
    /// # Errors
    /// A viscosity below 2 cSt at 100 degrees Celsius.
    pub fn viscosity_index(&self) -> Result<f64, InputError> {
        let [warm, hot] = self.index_viscosities();
        viscosity_index(warm, hot)
    }
}

/// Checks a point.
fn validate([viscosity, temperature]: [f64; 2]) -> Result<(), InputError> {
    InputError::require(
        (LEAST..=MOST).contains(&viscosity),
        "kinematic",
        viscosity,
        "0.21 to 2e7 cSt, that is 2.1e-7 to 20 m^2/s",
    )?;
    InputError::require_positive("kinematic", temperature)
}

/// `Z` of a viscosity \[cSt\].
fn z_of(nu: f64) -> f64 {
    nu + 0.7 + (-1.47 - 1.84 * nu - 0.51 * nu * nu).exp()
}

/// `log10 log10 Z` of a viscosity \[m^2/s\].
fn loglog(viscosity: f64) -> f64 {
    z_of(viscosity / CENTISTOKE).log10().log10()
}

/// The viscosity \[cSt\] of `Z`, at least one.
fn centistokes(z: f64) -> f64 {
    // Z is convex and increasing for all viscosities above that of Z = 1: Newton's method converges from above.
    let mut nu = (z - 0.7).max(0.12);
    for _ in 0..NEWTON_STEPS {
        let exponential = (-1.47 - 1.84 * nu - 0.51 * nu * nu).exp();
        let step = (nu + 0.7 + exponential - z) / (1.0 - (1.84 + 1.02 * nu) * exponential);
        nu = (nu - step).max(0.1);
        if step.abs() <= 1e-15 * nu {
            break;
        }
    }
    nu
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viscosity_is_the_inverse_of_z() {
        for nu in [0.15, 0.21, 0.5, 1.0, 2.0, 10.0, 1e4, 1e9] {
            assert!((centistokes(z_of(nu)) / nu - 1.0).abs() < 1e-12, "{nu}");
        }
    }
}
