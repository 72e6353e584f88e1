//! Root mean square height of the waves of random surfaces that a grid does not hold.

use std::f64::consts::{LN_10, TAU};

use super::autocorrelation::Autocorrelation;
use super::random::RandomSurface;
use super::random_shape::RandomShape;
use super::self_affine::SelfAffine;

impl RandomSurface {
    /// Root mean square height \[m\] of the waves with lengths between `longest` and `shortest` \[m\] of a surface whose
    /// waves longer than `cut` \[m\] have the root mean square height `rq`. Lengths along x and y count by their geometric
    /// mean.
    ///
    /// ```
    /// use stribeck::surface::{Autocorrelation, RandomShape, RandomSurface};
    /// let (length_x, length_y, autocorrelation) = (20e-6, 20e-6, Autocorrelation::Exponential);
    /// let shape = RandomShape::Correlated { autocorrelation, length_x, length_y };
    /// let surface = RandomSurface::new(shape, 100e-9, 1);
    /// // All waves below 4 um: their share of the spectrum (1 + (q b)^2)^-1.5 is (1 + (q b)^2)^-0.5.
    /// let wave = std::f64::consts::TAU / 4e-6 * 20e-6 / 10f64.ln();
    /// let share = 1.0 / wave.hypot(1.0);
    /// let rms = surface.rms_of_waves(4e-6, 4e-6, 0.0);
    /// assert!((rms / (100e-9 * (share / (1.0 - share)).sqrt()) - 1.0).abs() < 1e-12);
    /// ```
    pub fn rms_of_waves(&self, cut: f64, longest: f64, shortest: f64) -> f64 {
        let [held, low, high] = [cut, longest, shortest].map(|length| self.variance_above(TAU / length));
        let share = (high - low) / held;
        if share > 0.0 { self.rq * share.sqrt() } else { 0.0 }
    }

    /// Variance, of any scale, of the waves with wave numbers below `q` \[1/m\].
    fn variance_above(&self, q: f64) -> f64 {
        match self.shape {
            RandomShape::Correlated { autocorrelation, length_x, length_y } => {
                let length = (length_x * length_y).sqrt();
                match autocorrelation {
                    Autocorrelation::Gaussian => -(-(0.5 * q * length).powi(2) / LN_10).exp_m1(),
                    Autocorrelation::Exponential => 1.0 - 1.0 / (q * length / LN_10).hypot(1.0),
                }
            }
            RandomShape::SelfAffine(SelfAffine { hurst, longest, roll_off, shortest, .. }) => {
                let [low, bend, high] = [longest, roll_off, shortest].map(|length| TAU / length);
                let q = q.min(high);
                let plateau = 0.5 * ((q.min(bend) / bend).powi(2) - (low / bend).powi(2)).max(0.0);
                plateau + (1.0 - (bend / q.max(bend)).powf(2.0 * hurst)) / (2.0 * hurst)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;
    use crate::metrics::height_statistics;
    use crate::surface::{HeightScale, Synthesis};

    /// Height statistics of a fine surface against those of its waves longer than a cut.
    #[test]
    fn waves_between_two_lengths_have_the_height_of_generated_ones() {
        let affine = |longest: f64, shortest: f64| {
            let synthesis = Synthesis::RandomPhase;
            RandomShape::SelfAffine(SelfAffine { hurst: 0.7, longest, roll_off: 20e-6, shortest, synthesis })
        };
        let grid = Grid::centred(256, 256, 0.5e-6, 0.5e-6).unwrap();
        let whole = RandomSurface::new(affine(40e-6, 2e-6), 1e-7, 1).with_height(HeightScale::Exact);
        let whole_sq = height_statistics(&whole.generate(&grid).unwrap()).unwrap().sq;
        // The same spectrum without its waves below 5 um: heights per mode are those of the plateau.
        let [short, long] =
            [whole.rms_of_waves(2e-6, 5e-6, 2e-6), whole.rms_of_waves(2e-6, f64::INFINITY, 5e-6)];
        assert!((short.hypot(long) / whole_sq - 1.0).abs() < 1e-9);
        let exact = ((0.25f64.powf(1.4) - 0.1f64.powf(1.4))
            / 1.4
            / (0.5 * (1.0 - 0.25) + (1.0 - 0.1f64.powf(1.4)) / 1.4))
            .sqrt();
        assert!((short / 1e-7 / exact - 1.0).abs() < 1e-9, "{short:e}");
    }

    #[test]
    fn gaussian_surfaces_have_next_to_no_waves_below_a_quarter_of_their_length() {
        let autocorrelation = Autocorrelation::Gaussian;
        let shape = RandomShape::Correlated { autocorrelation, length_x: 10e-6, length_y: 10e-6 };
        let surface = RandomSurface::new(shape, 1e-7, 1);
        assert!(surface.rms_of_waves(2.5e-6, 2.5e-6, 0.0) < 1e-14);
        // exp(-(q l/2)^2/ln 10) of the variance is in waves beyond q.
        let beyond = (-std::f64::consts::PI.powi(2) / LN_10).exp();
        let rms = surface.rms_of_waves(10e-6, 10e-6, 0.0);
        assert!((rms / 1e-7 - (beyond / (1.0 - beyond)).sqrt()).abs() < 1e-12, "{rms:e}");
    }
}
