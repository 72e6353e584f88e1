//! The share of the load that solids carry in rough contacts, in closed form.

use crate::error::InputError;

/// Steepness of the transition.
const STEEPNESS: f64 = 3.3;

/// A contact of isotropic random roughness, whose oil is entrained into the inlets of its asperities.
///
/// With the inlet number `L = eta0 alpha u l/(h_c^(4/3) Rq^(2/3))` solids carry the share
/// `1/(1 + (L/1.23)^3.3)` of the load: the pressure that the oil builds up in front of an asperity, as its gap
/// narrows from the roughness to the contact film over the correlation length, against what the asperity needs.
/// The smooth film, and with it the ratio lambda, is not in it.
///
/// A fit to numerical solutions whose cells resolve these inlets: steel point contacts in piezoviscous oils, Hertz
/// pressures of 0.45 to 1.6 GPa, Rq 40 to 200 nm, lengths 10 to 40 um, contact films of 1 to 5 nm, smooth films
/// thinner than Rq. Over the nine means of three surfaces in `docs/reference.csv` it errs by 0.053 on average, at most
/// 0.21; over its 27 surfaces, of contacts with few asperities, by 0.11 and 0.50. In solutions on coarse cells, three to
/// five in the length, solids carry more, as if `L` were 0.4 to 1 of it. It does not hold for lays, textures, profiles under line contacts or oils that pressure
/// does not thicken.
///
/// ```
/// use stribeck::analytic::MixedLoadShare;
/// let contact = MixedLoadShare {
///     entrainment_speed: 0.02, eta0: 0.004, alpha: 14.4e-9, correlation_length: 10e-6, contact_film: 1e-9,
///     composite_rq: 131.5e-9,
/// };
/// assert!((contact.load_ratio()? - 0.94).abs() < 0.05); // numerical solutions: 0.943
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MixedLoadShare {
    /// Mean of the two surface speeds `u` \[m/s\].
    pub entrainment_speed: f64,
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\].
    pub alpha: f64,
    /// Length `l` at which the autocorrelation of the composite roughness has fallen to 10 % \[m\].
    pub correlation_length: f64,
    /// Film at which solids touch `h_c` \[m\].
    pub contact_film: f64,
    /// Composite root mean square height `Rq` \[m\].
    pub composite_rq: f64,
}

impl MixedLoadShare {
    /// Inlet number at which solids carry half of the load.
    pub const HALF: f64 = 1.23;

    /// Inlet number at which solids carry `load_ratio` of the load, above 0 and below 1.
    ///
    /// ```
    /// # use stribeck::analytic::MixedLoadShare;
    /// assert!((MixedLoadShare::inlet_number_at(0.5) - MixedLoadShare::HALF).abs() < 1e-12);
    /// assert!((MixedLoadShare::inlet_number_at(0.97) - 0.43).abs() < 0.01);
    /// ```
    pub fn inlet_number_at(load_ratio: f64) -> f64 {
        Self::HALF * (1.0 / load_ratio - 1.0).powf(1.0 / STEEPNESS)
    }

    /// The inlet number `L`.
    ///
    /// # Errors
    /// [`InputError::Value`] naming the first field that is not finite and positive.
    ///
    /// ```
    /// # use stribeck::analytic::MixedLoadShare;
    /// let contact = MixedLoadShare {
    ///     entrainment_speed: 0.1, eta0: 0.01, alpha: 1e-8, correlation_length: 1e-5, contact_film: 1e-9,
    ///     composite_rq: 1e-6,
    /// };
    /// assert!((contact.inlet_number()? - 1.0).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn inlet_number(&self) -> Result<f64, InputError> {
        let fields = [
            ("entrainment_speed", self.entrainment_speed),
            ("eta0", self.eta0),
            ("alpha", self.alpha),
            ("correlation_length", self.correlation_length),
            ("contact_film", self.contact_film),
            ("composite_rq", self.composite_rq),
        ];
        fields.into_iter().try_for_each(|(field, value)| InputError::require_positive(field, value))?;
        let oil = self.eta0 * self.alpha * self.entrainment_speed * self.correlation_length;
        Ok(oil / (self.contact_film.powf(4.0 / 3.0) * self.composite_rq.powf(2.0 / 3.0)))
    }

    /// Share of the load that solids carry, 0 to 1.
    ///
    /// # Errors
    /// As of [`inlet_number`](Self::inlet_number).
    ///
    /// ```
    /// # use stribeck::analytic::MixedLoadShare;
    /// let slow = MixedLoadShare {
    ///     entrainment_speed: 0.123, eta0: 0.01, alpha: 1e-8, correlation_length: 1e-5, contact_film: 1e-9,
    ///     composite_rq: 1e-6,
    /// };
    /// assert!((slow.load_ratio()? - 0.5).abs() < 1e-12);
    /// assert!(MixedLoadShare { entrainment_speed: 1.0, ..slow }.load_ratio()? < 0.01);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn load_ratio(&self) -> Result<f64, InputError> {
        Ok(1.0 / (1.0 + (self.inlet_number()? / Self::HALF).powf(STEEPNESS)))
    }
}
