//! Rigid bearings of scenes: shape, motion, relief, feeds, heat balance.

use std::path::PathBuf;

use serde::Deserialize;

/// Shape and motion of a rigid bearing.
///
/// ```
/// use stribeck::sim::scene::{BearingSpec, JournalPosition, PadFilm};
/// let position = JournalPosition::Load(2000.0);
/// let journal =
///     BearingSpec::Journal { diameter: 50e-3, width: 25e-3, clearance: 25e-6, speed: 7.85, position };
/// let film = PadFilm::Given { inlet: 2e-6, outlet: 1e-6 };
/// assert_ne!(journal, BearingSpec::Pad { length: 1e-2, width: None, film, step: None, speed: 1.0 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum BearingSpec {
    /// A journal in a bush: [`JournalBearing`](crate::reynolds::JournalBearing).
    Journal {
        /// Diameter of the journal \[m\].
        diameter: f64,
        /// Width of the bearing \[m\].
        width: f64,
        /// Radial clearance \[m\].
        clearance: f64,
        /// Speed of the surface of the journal \[m/s\].
        speed: f64,
        /// Position of its axis.
        position: JournalPosition,
    },
    /// A pad over a moving plane: inclined, or with a step (Rayleigh).
    Pad {
        /// Length along the motion \[m\].
        length: f64,
        /// Width \[m\]; `None` for a pad that is wide, with forces per metre.
        width: Option<f64>,
        /// Films at inlet and outlet.
        film: PadFilm,
        /// Length of the part with the film of the inlet before a step \[m\]; `None` for an inclined pad.
        step: Option<f64>,
        /// Speed of the moving plane \[m/s\].
        speed: f64,
    },
}

/// Films of a pad at its inlet and outlet.
///
/// ```
/// use stribeck::sim::scene::PadFilm;
/// let given = PadFilm::Given { inlet: 20e-6, outlet: 10e-6 };
/// assert_ne!(given, PadFilm::Fixed { load: 500.0, taper: 10e-6 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PadFilm {
    /// Prescribed films.
    Given {
        /// At the inlet \[m\].
        inlet: f64,
        /// At the outlet \[m\].
        outlet: f64,
    },
    /// A fixed inclination or step, in equilibrium with a load.
    Fixed {
        /// The load \[N\].
        load: f64,
        /// Film at the inlet less that at the outlet \[m\].
        taper: f64,
    },
    /// A pad that tilts about a pivot, in equilibrium with a load.
    Pivoted {
        /// The load \[N\].
        load: f64,
        /// Distance of the pivot from the inlet \[m\]: the center of pressure lies there.
        pivot: f64,
    },
}

/// Position of the axis of a journal.
///
/// ```
/// use stribeck::sim::scene::JournalPosition;
/// assert_ne!(JournalPosition::Eccentricity(0.5), JournalPosition::Load(0.5));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JournalPosition {
    /// Distance of the axes over the clearance.
    Eccentricity(f64),
    /// In equilibrium with this load \[N\].
    Load(f64),
}

/// Relief of the resting surface of a pad; the film is larger by its depth below its highest point.
///
/// ```
/// use stribeck::sim::scene::PadRelief;
/// let relief = PadRelief::Dimples { diameter: 1e-3, depth: 5e-6, density: 0.2 };
/// assert_ne!(relief, PadRelief::File { path: "pad.npy".into(), spacing: None });
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PadRelief {
    /// Round dimples on a square lattice in the middle of the pad, with the depth `depth (1 - (2 r/diameter)^2)`.
    Dimples {
        /// Diameter of the rim \[m\].
        diameter: f64,
        /// Depth in the middle \[m\].
        depth: f64,
        /// Area of the dimples over that of their lattice.
        density: f64,
    },
    /// Heights of a file, averaged on the cells; its corner is that of the pad.
    File {
        /// The file.
        path: PathBuf,
        /// Spacing of its points \[m\], where the file has none.
        spacing: Option<f64>,
    },
}

/// Axial grooves in the bush of a journal: [`Grooves`](crate::reynolds::Grooves).
///
/// ```
/// use stribeck::sim::scene::GrooveSpec;
/// let opposite =
///     GrooveSpec { angles: vec![std::f64::consts::PI], width: 5e-3, length: Some(20e-3), pressure: 2e5 };
/// assert_eq!(opposite.angles.len(), 1);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct GrooveSpec {
    /// Angles of their middles from the load, in the direction of rotation \[rad\].
    pub angles: Vec<f64>,
    /// Width along the circumference \[m\].
    pub width: f64,
    /// Length along the axis \[m\]; `None` for 0.8 of the width of the bearing.
    pub length: Option<f64>,
    /// Pressure above ambient \[Pa\].
    pub pressure: f64,
}

/// Round holes that feed the film of a journal ([`Holes`](crate::reynolds::Holes)) or of a pad, in the middle of its width.
///
/// ```
/// use stribeck::sim::scene::HoleSpec;
/// let opposite = HoleSpec { places: vec![std::f64::consts::PI], diameter: 5e-3, pressure: 2e5 };
/// assert_eq!(opposite.places.len(), 1);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct HoleSpec {
    /// Angles of their middles from the load \[rad\], in the direction of rotation; of a pad distances from its inlet \[m\].
    pub places: Vec<f64>,
    /// Diameter \[m\].
    pub diameter: f64,
    /// Pressure above ambient \[Pa\].
    pub pressure: f64,
}

/// Roughness of a bearing in the mean: [`MeanRoughness`](crate::reynolds::MeanRoughness). Its table is `[given_film.roughness]`.
///
/// ```
/// use stribeck::sim::scene::RoughnessSpec;
/// let lapped = RoughnessSpec {
///     rq: [0.2e-6, 0.3e-6], gamma: 1.0, asperity_number: 0.05, rq_over_radius: 0.01, equivalent_modulus: 230e9,
///     boundary_friction: 0.1,
/// };
/// assert_eq!(lapped.gamma, 1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoughnessSpec {
    /// Root mean square heights of the moving and of the resting surface \[m\].
    pub rq: [f64; 2],
    /// Peklenik number: correlation length along the motion over that across.
    #[serde(default = "isotropic")]
    pub gamma: f64,
    /// Density times radius of the asperities times root mean square height.
    pub asperity_number: f64,
    /// Root mean square height over radius of the asperities.
    pub rq_over_radius: f64,
    /// Equivalent modulus of both bodies \[Pa\].
    pub equivalent_modulus: f64,
    /// Friction coefficient of solid contact.
    pub boundary_friction: f64,
}

/// Peklenik number of isotropic roughness.
fn isotropic() -> f64 {
    1.0
}

/// Heat balance of a bearing: the through-flow of oil carries a share of the power loss, and the oil has the mean of supply and
/// outlet temperature (ISO 7902-1).
///
/// ```
/// use stribeck::sim::scene::HeatBalance;
/// let balance = HeatBalance { supply_temperature: 313.15, heat_capacity: 1.7e6, share: 1.0 };
/// // 100 W in 10 ml/s
/// assert!((balance.rise(100.0, 1e-5) - 5.882).abs() < 1e-3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatBalance {
    /// Temperature of the supplied oil \[K\].
    pub supply_temperature: f64,
    /// Heat capacity of a volume of oil \[J/(m^3 K)\].
    pub heat_capacity: f64,
    /// Share of the power loss that the oil carries; the rest leaves through the bodies.
    pub share: f64,
}

impl HeatBalance {
    /// Rise of the temperature of the oil from supply to outlet \[K\] with the power loss \[W\] and the flow \[m^3/s\].
    #[must_use]
    pub fn rise(&self, power_loss: f64, flow: f64) -> f64 {
        self.share * power_loss / (self.heat_capacity * flow)
    }
}
