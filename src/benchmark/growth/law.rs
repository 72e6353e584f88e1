//! Growth laws with constants to be fitted.

use std::fmt;
use std::sync::Arc;

use crate::error::InputError;
use crate::surface_state::SurfaceState;
use crate::tribochem::{
    FilmGrowthLaw, Ghanbarzadeh, MeasuredFilm, ProportionalRemoval, StressActivated, ThermalArrhenius,
};

/// Activation energy \[J\] and activation volume \[m^3\] where films do not determine them: Gosvami et al.,
/// Science 348, 2015, 102-106.
const ENERGY: f64 = 1.28e-19;
const VOLUME: f64 = 3.8e-30;
/// Boltzmann and Planck constants \[J/K, J s\].
const BOLTZMANN: f64 = 1.380_649e-23;
const PLANCK: f64 = 6.626_070_15e-34;

/// Makes a law from its constants.
type Make = dyn Fn(&[f64]) -> Result<Box<dyn FilmGrowthLaw>, InputError> + Send + Sync;

/// A growth law by name, with initial values of the constants to be fitted.
#[derive(Clone)]
pub struct GrowthLaw {
    pub(super) name: String,
    pub(super) start: Vec<(String, f64)>,
    pub(super) make: Arc<Make>,
}

impl fmt::Debug for GrowthLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GrowthLaw").field("name", &self.name).field("start", &self.start).finish()
    }
}

impl GrowthLaw {
    /// The law `name` with positive initial values; `make` makes it from the constants in their order.
    pub fn new<N: Into<String>>(
        name: impl Into<String>,
        start: impl IntoIterator<Item = (N, f64)>,
        make: impl Fn(&[f64]) -> Result<Box<dyn FilmGrowthLaw>, InputError> + Send + Sync + 'static,
    ) -> Self {
        let start = start.into_iter().map(|(name, value)| (name.into(), value)).collect();
        Self { name: name.into(), start, make: Arc::new(make) }
    }
}

/// A law in a box.
#[derive(Debug)]
pub(super) struct Boxed(pub(super) Box<dyn FilmGrowthLaw>);

impl FilmGrowthLaw for Boxed {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        self.0.rate(at, thickness)
    }

    fn maximum_thickness(&self) -> f64 {
        self.0.maximum_thickness()
    }

    fn n_states(&self) -> usize {
        self.0.n_states()
    }

    fn thickness(&self, states: &[f64]) -> f64 {
        self.0.thickness(states)
    }

    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        self.0.advance(at, time_step, states);
    }
}

/// Rough values of some films.
struct Guess {
    thickness: f64,
    /// Rate constant \[1/s\].
    rate: f64,
    temperature: f64,
    has_temperatures: bool,
    has_stresses: bool,
    has_pressures: bool,
}

impl Guess {
    fn of(films: &[MeasuredFilm]) -> Self {
        let thickness =
            films.iter().flat_map(MeasuredFilm::thicknesses).fold(1e-12_f64, |most, h| most.max(*h));
        let points = || films.iter().flat_map(|film| film.times().iter().zip(film.thicknesses()));
        // The first time at half of the largest thickness.
        let half = points().filter(|(_, h)| **h >= 0.5 * thickness).map(|(time, _)| *time);
        let half = half.fold(f64::INFINITY, f64::min).clamp(1e-9, 1e12);
        let conditions = || films.iter().flat_map(MeasuredFilm::conditions);
        let varies = |of: fn(&SurfaceState) -> f64| {
            let (low, high) =
                conditions().map(of).fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
            high > 1.001 * low
        };
        Self {
            thickness,
            rate: std::f64::consts::LN_2 / half,
            temperature: conditions().next().map_or(353.15, |at| at.temperature),
            has_temperatures: varies(|at| at.temperature),
            has_stresses: varies(|at| at.shear_stress),
            has_pressures: varies(|at| at.pressure),
        }
    }
}

/// The laws of the crate, with initial values for `films`. An activation energy is fitted if temperatures differ by
/// a thousandth or more, an activation volume if stresses do; otherwise they have the values of Gosvami et al. (2015).
pub fn laws(films: &[MeasuredFilm]) -> Vec<GrowthLaw> {
    let guess = Guess::of(films);
    let (limit, rate) = (("maximum_thickness", 1.1 * guess.thickness), guess.rate);
    let x_tribo = rate * PLANCK / (BOLTZMANN * guess.temperature);
    let prefactor = rate * (ENERGY / (BOLTZMANN * guess.temperature)).exp();
    let first_order = [limit, ("prefactor", prefactor)];
    let removal = [
        ("maximum_thickness", 4.0 * guess.thickness),
        ("growth_rate", prefactor * guess.thickness),
        ("removal_rate", rate),
    ];
    vec![
        GrowthLaw::new(
            "ghanbarzadeh",
            [
                ("maximum_thickness", 1.4 * guess.thickness),
                ("x_tribo", x_tribo),
                ("removal_limit", 0.4 * guess.thickness),
                ("removal_rate", 0.3 * rate),
            ],
            |c| boxed(Ghanbarzadeh::new(c[0], c[1], c[2], c[3])),
        ),
        GrowthLaw::new("ghanbarzadeh, no removal", [limit, ("x_tribo", x_tribo)], |c| {
            boxed(Ghanbarzadeh::new(c[0], c[1], 0.0, 0.0))
        }),
        activated("thermal_arrhenius", &first_order, &guess, false, |c, energy, _| {
            boxed(ThermalArrhenius::new(c[0], c[1], energy))
        }),
        activated(
            "stress_activated, shear",
            &first_order,
            &guess,
            guess.has_stresses,
            |c, energy, volume| boxed(StressActivated::by_shear_stress(c[0], c[1], energy, volume)),
        ),
        activated(
            "stress_activated, normal",
            &first_order,
            &guess,
            guess.has_pressures,
            |c, energy, volume| boxed(StressActivated::by_normal_stress(c[0], c[1], energy, volume)),
        ),
        activated("proportional_removal", &removal, &guess, guess.has_stresses, |c, energy, volume| {
            boxed(ProportionalRemoval::new(c[0], c[1], energy, volume, c[2]))
        }),
    ]
}

/// A law with an activation energy and volume, each fitted or fixed.
fn activated(
    name: &str,
    start: &[(&str, f64)],
    guess: &Guess,
    has_volume: bool,
    make: impl Fn(&[f64], f64, f64) -> Result<Box<dyn FilmGrowthLaw>, InputError> + Send + Sync + 'static,
) -> GrowthLaw {
    let has_energy = guess.has_temperatures;
    let mut start = start.to_vec();
    let energy = has_energy.then_some(("activation_energy", ENERGY));
    start.extend(energy.into_iter().chain(has_volume.then_some(("activation_volume", VOLUME))));
    let own = start.len() - usize::from(has_energy) - usize::from(has_volume);
    GrowthLaw::new(name, start, move |c| {
        let energy = if has_energy { c[own] } else { ENERGY };
        let volume = if has_volume { c[own + usize::from(has_energy)] } else { VOLUME };
        make(c, energy, volume)
    })
}

fn boxed(
    law: Result<impl FilmGrowthLaw + 'static, InputError>,
) -> Result<Box<dyn FilmGrowthLaw>, InputError> {
    law.map(|law| Box::new(law) as Box<dyn FilmGrowthLaw>)
}
