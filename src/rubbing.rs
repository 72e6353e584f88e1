//! What a surface point feels while it rubs: the input of film growth and wear laws.

/// The state of one surface node during a step, all SI. Laws read from it what they need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RubbingPoint {
    /// Total pressure, fluid and solid \[Pa\].
    pub pressure: f64,
    /// Share of the pressure that solid contact carries \[Pa\].
    pub solid_pressure: f64,
    /// Shear stress on the surface \[Pa\].
    pub shear_stress: f64,
    /// Surface temperature, bulk plus flash \[K\].
    pub temperature: f64,
    /// Sliding speed between the surfaces, never negative \[m/s\].
    pub sliding_speed: f64,
    /// Gap between the surfaces \[m\].
    pub film_thickness: f64,
    /// Whether the node counts as solid contact.
    pub in_contact: bool,
}

impl RubbingPoint {
    /// The state of a point that lies `share` of the way from this node to `other`; the nearer one decides on
    /// contact.
    pub(crate) fn towards(&self, other: &Self, share: f64) -> Self {
        let mix = |here: f64, there: f64| here + share * (there - here);
        Self {
            pressure: mix(self.pressure, other.pressure),
            solid_pressure: mix(self.solid_pressure, other.solid_pressure),
            shear_stress: mix(self.shear_stress, other.shear_stress),
            temperature: mix(self.temperature, other.temperature),
            sliding_speed: mix(self.sliding_speed, other.sliding_speed),
            film_thickness: mix(self.film_thickness, other.film_thickness),
            in_contact: if share < 0.5 { self.in_contact } else { other.in_contact },
        }
    }
}
