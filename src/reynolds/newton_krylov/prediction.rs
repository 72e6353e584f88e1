//! The state that a linear step predicts.

use super::linear_system::LinearSystem;
use super::snapshot::Snapshot;
use super::unknowns::NodeChange;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::state::ContactState;

/// The start of a step plus a share of the solution of its linear system, node by node; no vector of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prediction<'a> {
    start: &'a Snapshot,
    system: &'a LinearSystem,
    share: f64,
}

/// The prediction for one node.
#[derive(Debug, Clone, Copy)]
pub(super) struct PredictedNode {
    /// Total pressure \[Pa\].
    pub(super) pressure: f64,
    /// Fluid pressure \[Pa\].
    pub(super) fluid_pressure: f64,
    /// Film without plastic depth \[m\].
    pub(super) elastic_film: f64,
    /// Plastic depth of a node whose fluid is at the limit \[m\].
    pub(super) depth: f64,
    /// Changes over the step, already multiplied by its share.
    pub(super) change: NodeChange,
}

impl<'a> Prediction<'a> {
    /// The prediction at the `share` of the step that `system` has solved for at `start`.
    pub(super) fn new(start: &'a Snapshot, system: &'a LinearSystem, share: f64) -> Self {
        Self { start, system, share }
    }

    /// The prediction for node `k`.
    pub(super) fn node(&self, k: usize) -> PredictedNode {
        let (start, whole) = (self.start.node(k), self.system.node_change(k));
        let change = whole.times(self.share);
        // The film less the elastic film is the plastic depth.
        let depth = start.plastic_depth + self.share * (whole.film - whole.elastic_film);
        PredictedNode {
            pressure: start.pressure + change.pressure,
            fluid_pressure: start.fluid_pressure + change.fluid_pressure,
            elastic_film: start.elastic_film + change.elastic_film,
            depth: depth.max(0.0),
            change,
        }
    }

    /// Total pressure \[Pa\] and film without plastic depth \[m\] of node `k`.
    pub(super) fn pressure_and_film(&self, k: usize) -> [f64; 2] {
        let (start, change) = (self.start.node(k), self.system.node_change(k));
        [start.pressure + self.share * change.pressure, start.elastic_film + self.share * change.elastic_film]
    }

    /// Change of the approach over the step \[m\].
    pub(super) fn approach_change(&self) -> f64 {
        self.share * self.system.approach_change()
    }

    /// Linearization error of the films: the root mean square, weighted by pressure, of the films of `state`
    /// beyond the prediction, over the films or the contact film.
    pub(super) fn film_error(&self, coupled: &Coupled, state: &ContactState, contact_film: f64) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        let films = coupled.elastic_film.iter().zip(&state.film).zip(&state.pressure);
        for (k, ((elastic, film), p)) in films.enumerate() {
            let [_, predicted] = self.pressure_and_film(k);
            sum += p * ((elastic - predicted) / film.max(contact_film)).powi(2);
            weight += p;
        }
        (sum / weight).sqrt()
    }

    /// The mean of the films of `state` beyond the prediction, weighted by pressure; zero without pressure.
    pub(super) fn mean_rise(&self, coupled: &Coupled, state: &ContactState) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (k, (film, pressure)) in coupled.elastic_film.iter().zip(&state.pressure).enumerate() {
            let [_, predicted] = self.pressure_and_film(k);
            sum += pressure * (film - predicted);
            weight += pressure;
        }
        if weight > 0.0 { sum / weight } else { 0.0 }
    }
}
