//! Numbers of a solved bearing.

use super::RigidBearing;
use crate::lubricant::Lubricant;
use crate::reynolds::GivenFilmSolution;

/// Load over `eta u L A/h^2` with the mean film h up to which it is rounding.
const NO_LOAD: f64 = 1e-8;

/// Numbers of a solved bearing. A wide pad has forces, flows and power per metre of width.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct BearingNumbers {
    /// Load \[N\]: of a journal the magnitude of the force of film and contact.
    pub load: f64,
    /// Load of a pad without the pressure of its edges, the least of the four, where that is above ambient \[N\].
    pub load_above_edges: Option<f64>,
    /// Components of that force along the line of centers, towards the widest gap, and across \[N\].
    pub force: Option<[f64; 2]>,
    /// Attitude angle between load and line of centers \[rad\].
    pub attitude: Option<f64>,
    /// Distance of the axes over the clearance.
    pub eccentricity: Option<f64>,
    /// Sommerfeld number `W psi^2/(L D eta omega)` with the relative clearance `psi`.
    pub sommerfeld: Option<f64>,
    /// Film at the inlet of a pad, without its relief \[m\].
    pub inlet_film: Option<f64>,
    /// Film at the outlet of a pad, without its relief \[m\].
    pub outlet_film: Option<f64>,
    /// Distance of the center of pressure of a pad from its inlet \[m\].
    pub pressure_center: Option<f64>,
    /// Least film \[m\].
    pub least_film: f64,
    /// Largest pressure \[Pa\].
    pub pressure_max: f64,
    /// Friction force on the moving surface, against its motion \[N\].
    pub friction_moving: f64,
    /// Friction force on the surface at rest, along the motion \[N\].
    pub friction_resting: f64,
    /// Friction on the moving surface over the load; NaN of a film without load.
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
    /// Pressure-viscosity coefficient at ambient pressure \[1/Pa\].
    pub alpha: f64,
    /// Viscosity at the largest pressure over that at ambient pressure.
    pub viscosity_ratio: f64,
    /// Temperature of the oil \[K\]: with a heat balance the mean of supply and outlet.
    pub temperature: f64,
    /// Temperature of the supplied oil \[K\].
    pub supply_temperature: Option<f64>,
    /// Temperature of the oil at the outlet \[K\].
    pub outlet_temperature: Option<f64>,
    /// Power that the oil carries \[W\].
    pub carried_heat: Option<f64>,
}

/// The film of a bearing.
#[derive(Clone, Copy)]
pub(super) struct Thickness<'a> {
    /// At the nodes \[m\].
    pub(super) nodes: &'a [f64],
    /// Least film \[m\].
    pub(super) least: f64,
    /// Speed of the moving surface \[m/s\].
    pub(super) speed: f64,
}

impl RigidBearing {
    /// Numbers that all bearings have.
    pub(super) fn numbers(
        &self,
        lubricant: &Lubricant,
        load: f64,
        thickness: Thickness<'_>,
        film: &GivenFilmSolution,
    ) -> BearingNumbers {
        let [moving, resting] = film.friction;
        let (contact, law) = (film.contact.as_ref(), lubricant.viscosity());
        let pressure_max = film.pressure.iter().copied().fold(0.0, f64::max);
        let eta0 = law.viscosity(0.0);
        let (grid, count) = (film.grid(), thickness.nodes.len() as f64);
        let mean = thickness.nodes.iter().sum::<f64>() / count;
        let scale = eta0 * thickness.speed * grid.size_x() / (mean * mean) * grid.size_x() * grid.size_y();
        let load = if load.abs() > NO_LOAD * scale { load } else { 0.0 };
        let over_load = |value: f64| if load > 0.0 { value / load } else { f64::NAN };
        BearingNumbers {
            load,
            load_above_edges: None,
            force: None,
            attitude: None,
            eccentricity: None,
            sommerfeld: None,
            inlet_film: None,
            outlet_film: None,
            pressure_center: None,
            least_film: thickness.least,
            pressure_max,
            friction_moving: -moving,
            friction_resting: resting,
            friction_coefficient: over_load(-moving),
            cavitated_shear: film.cavitated_shear,
            contact_share: contact.map(|contact| over_load(contact.load)),
            contact_area: contact.map(|contact| contact.area),
            contact_friction: contact.map(|contact| contact.friction),
            film_over_rq: self.composite_rq().map(|rq| thickness.least / rq),
            side_flow: film.side_flow,
            edge_flows: film.edge_flows,
            groove_flow: None,
            hole_flow: self.holes.is_some().then(|| film.feed_flows.iter().sum()),
            bore_widening: None,
            power_loss: film.power_loss,
            eta0,
            alpha: lubricant.pressure_viscosity_coefficient(),
            viscosity_ratio: law.viscosity(pressure_max) / eta0,
            temperature: self.temperature,
            supply_temperature: None,
            outlet_temperature: None,
            carried_heat: None,
        }
    }
}

impl BearingNumbers {
    /// The numbers of a film that is not converged: those of its oil, all others NaN or `None`.
    pub(super) fn without_results(self) -> Self {
        let unknown = f64::NAN;
        Self {
            load: unknown,
            load_above_edges: None,
            force: None,
            attitude: None,
            eccentricity: None,
            sommerfeld: None,
            inlet_film: None,
            outlet_film: None,
            pressure_center: None,
            least_film: unknown,
            pressure_max: unknown,
            friction_moving: unknown,
            friction_resting: unknown,
            friction_coefficient: unknown,
            cavitated_shear: unknown,
            contact_share: None,
            contact_area: None,
            contact_friction: None,
            film_over_rq: None,
            side_flow: unknown,
            edge_flows: [unknown; 4],
            groove_flow: None,
            hole_flow: None,
            bore_widening: None,
            power_loss: unknown,
            viscosity_ratio: unknown,
            outlet_temperature: None,
            carried_heat: None,
            ..self
        }
    }
}
