//! Numbers of a solved bearing.

/// Numbers of a solved bearing. A wide pad has forces, flows and power per metre of width.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct BearingNumbers {
    /// Load \[N\]: of a journal the magnitude of the force of film and contact.
    pub load: f64,
    /// Components of that force along the line of centers, towards the widest gap, and across \[N\].
    pub force: Option<[f64; 2]>,
    /// Attitude angle between load and line of centers \[rad\].
    pub attitude: Option<f64>,
    /// Distance of the axes over the clearance.
    pub eccentricity: Option<f64>,
    /// Sommerfeld number.
    pub sommerfeld: Option<f64>,
    /// Least film \[m\].
    pub least_film: f64,
    /// Largest pressure \[Pa\].
    pub pressure_max: f64,
    /// Friction force on the moving surface, against its motion \[N\].
    pub friction_moving: f64,
    /// Friction force on the surface at rest, along the motion \[N\].
    pub friction_resting: f64,
    /// Friction on the moving surface over the load.
    pub friction_coefficient: f64,
    /// Shear force on either surface by cavitated fluid \[N\].
    pub cavitated_shear: f64,
    /// Share of the load that solid contact of rough surfaces carries.
    pub contact_share: Option<f64>,
    /// Area of contact \[m^2\].
    pub contact_area: Option<f64>,
    /// Part of the friction by solid contact \[N\].
    pub contact_friction: Option<f64>,
    /// Least film over the root mean square height of both surfaces together.
    pub film_over_rq: Option<f64>,
    /// Flow out through both sides \[m^3/s\].
    pub side_flow: f64,
    /// Flow out through inlet, outlet and both sides of a pad; through both ends of the film of a journal and both sides
    /// \[m^3/s\]. Negative where oil enters.
    pub edge_flows: [f64; 4],
    /// Flow from the grooves of a journal \[m^3/s\].
    pub groove_flow: Option<f64>,
    /// Flow from the holes \[m^3/s\].
    pub hole_flow: Option<f64>,
    /// Largest widening of the film by the deflection of an elastic bore \[m\].
    pub bore_widening: Option<f64>,
    /// Power of the moving surface against friction \[W\].
    pub power_loss: f64,
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Temperature of the oil \[K\]: with a heat balance the mean of supply and outlet.
    pub temperature: f64,
    /// Temperature of the supplied oil \[K\].
    pub supply_temperature: Option<f64>,
    /// Temperature of the oil at the outlet \[K\].
    pub outlet_temperature: Option<f64>,
    /// Power that the oil carries \[W\].
    pub carried_heat: Option<f64>,
}
