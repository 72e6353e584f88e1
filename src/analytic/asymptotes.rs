//! Asymptotes of Moes' film formulas.

/// Asymptotes that the formulas of Moes join, over `R (2U)^(1/2)`.
pub(super) struct Asymptotes {
    pub(super) rigid_isoviscous: f64,
    pub(super) elastic_isoviscous: f64,
    /// Bound of the film of elastic bodies in an isoviscous oil.
    pub(super) thickest_elastic: f64,
    pub(super) rigid_piezoviscous: f64,
    pub(super) elastic_piezoviscous: f64,
}

impl Asymptotes {
    /// The film of a point contact in all regimes, by Nijenbanning, Venner and Moes.
    pub(super) fn point_film(&self) -> f64 {
        let s = 1.5 * (1.0 + (-1.2 * self.elastic_isoviscous / self.elastic_piezoviscous).exp());
        let elastic = (self.elastic_isoviscous.powi(-4) + self.thickest_elastic.powi(-4)).powf(-0.375);
        let isoviscous = self.rigid_isoviscous.powf(1.5) + elastic;
        let piezoviscous = self.rigid_piezoviscous.powi(-8) + self.elastic_piezoviscous.powi(-8);
        (isoviscous.powf(2.0 * s / 3.0) + piezoviscous.powf(-s / 8.0)).powf(1.0 / s)
    }

    /// The film of a line contact in all regimes, by Moes.
    pub(super) fn line_film(&self) -> f64 {
        let s = (7.0 + 8.0 * (-2.0 * self.elastic_isoviscous / self.rigid_isoviscous).exp()) / 5.0;
        let isoviscous = self.rigid_isoviscous.powf(7.0 / 3.0) + self.elastic_isoviscous.powf(7.0 / 3.0);
        let piezoviscous = self.rigid_piezoviscous.powf(-3.5) + self.elastic_piezoviscous.powf(-3.5);
        (isoviscous.powf(3.0 * s / 7.0) + piezoviscous.powf(-2.0 * s / 7.0)).powf(1.0 / s)
    }
}
