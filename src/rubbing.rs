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
