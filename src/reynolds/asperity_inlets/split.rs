//! Fluid and solid share of the pressure of a dry contact, and its films.

use super::Field;
use super::compression::EdgePressures;
use super::flank::rise_in_inlet;
use crate::lubricant::Lubricant;

/// The film of a floating asperity over the contact film grows as the rise of the reduced pressure to this power: on
/// `gap ~ x^1.5` the rise falls as `h_1^(-4/3)`.
const LIFT: f64 = 0.75;

/// Oil and contact film of the asperities.
pub(super) struct Inlets<'a> {
    /// Pressure at the front edges.
    pub(super) edges: &'a EdgePressures,
    /// The oil.
    pub(super) oil: &'a Lubricant,
    /// `12 eta0 u` \[Pa m\].
    pub(super) entrainment: f64,
    /// Film of solid contact \[m\].
    pub(super) contact_film: f64,
}

/// Fluid pressure and film of the nodes under pressure.
#[derive(Debug, Default)]
pub(super) struct Split {
    /// Fluid pressure \[Pa\].
    pub(super) fluid: Vec<f64>,
    /// Film of nodes under pressure, zero elsewhere \[m\].
    pub(super) film: Vec<f64>,
    /// Whether solids carry a part.
    pub(super) solid: Vec<bool>,
}

impl Split {
    /// Splits the pressure of all asperities of `field`.
    pub(super) fn fill(&mut self, field: &Field<'_>, inlets: &Inlets<'_>) {
        let (nx, n) = (field.grid.nx(), field.grid.len());
        self.fluid.clear();
        self.film.clear();
        self.solid.clear();
        self.fluid.resize(n, 0.0);
        self.film.resize(n, 0.0);
        self.solid.resize(n, false);
        for j in 0..field.grid.ny() {
            let mut i = 0;
            while i < nx {
                // A run of nodes in contact, from its upstream edge on.
                let front = i;
                while i < nx && field.pressure[j * nx + i] > 0.0 {
                    i += 1;
                }
                if i > front {
                    // Rise of the reduced pressure in its inlet.
                    let rise = inlets.entrainment * rise_in_inlet(field, j, front, inlets.contact_film);
                    self.run(j * nx + front..j * nx + i, field.pressure, rise, inlets);
                }
                i += 1;
            }
        }
    }

    /// Splits one run of nodes under pressure along x. The flow of the inlet passes the run unchanged.
    fn run(&mut self, run: std::ops::Range<usize>, pressure: &[f64], rise: f64, inlets: &Inlets<'_>) {
        let contact_film = inlets.contact_film;
        // It floats where the inlet generates its whole pressure.
        let peak = run.clone().map(|k| pressure[k]).fold(0.0, f64::max);
        let needed = inlets.edges.needed_rise(peak);
        let floats = rise >= needed;
        let edge = if floats { peak } else { inlets.edges.pressure(rise).min(peak) };
        let film = if floats { contact_film * (rise / needed).powf(LIFT) } else { contact_film };
        let carried = inlets.oil.at(edge).density;
        // The fluid carries the pressure of the edge, solids the rest.
        for k in run {
            self.solid[k] = pressure[k] > edge;
            self.fluid[k] = pressure[k].min(edge);
            self.film[k] = film * carried / inlets.oil.at(self.fluid[k]).density;
        }
    }

    /// Mean film of the nodes under pressure above the contact film \[m\].
    pub(super) fn lift(&self, contact_film: f64) -> f64 {
        let films = self.film.iter().filter(|film| **film > 0.0);
        let (sum, count) = films.fold((0.0, 0_usize), |(sum, n), film| (sum + film - contact_film, n + 1));
        sum / count.max(1) as f64
    }
}
