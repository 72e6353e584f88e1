//! Fluid and solid share of the pressure of a dry contact, and its films.

use std::ops::Range;

use super::Field;
use super::compression::EdgePressures;
use super::flank::Front;
use super::valley_flow::ValleyFlow;
use crate::lubricant::Lubricant;

/// The film of a floating asperity over the contact film grows as the rise of the reduced pressure to this power: on
/// `gap ~ x^1.5` the rise falls as `h_1^(-4/3)`.
const LIFT: f64 = 0.75;

/// Oil and contact film of the asperities.
pub(super) struct Inlets<'a> {
    /// Pressure at the front edges.
    pub(super) edges: &'a EdgePressures,
    /// Flow through the valleys in front of them.
    pub(super) valleys: &'a ValleyFlow,
    /// The oil.
    pub(super) oil: &'a Lubricant,
    /// `12 eta0 u` \[Pa m\].
    pub(super) entrainment: f64,
    /// Film of solid contact \[m\].
    pub(super) contact_film: f64,
    /// Largest film of a floating asperity \[m\].
    pub(super) highest_film: f64,
    /// Pressure of a dry contact one flank length behind its edge over the slope of the flank, `3/8 E' h_c` \[Pa m\].
    pub(super) stiffness: f64,
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
    /// The asperities.
    runs: Vec<Run>,
}

/// Nodes under pressure along x.
#[derive(Debug, Clone)]
struct Run {
    nodes: Range<usize>,
    /// Largest pressure \[Pa\].
    peak: f64,
    /// Rise of the reduced pressure in front of it without density \[Pa\].
    rise: f64,
    /// Pressure of the dry contact one flank length behind its edge \[Pa\].
    behind: f64,
}

impl Run {
    /// Fluid pressure at the front edge \[Pa\] at `factor` times the rise; the peak where the run floats.
    fn edge(&self, edges: &EdgePressures, factor: f64) -> f64 {
        // It floats where the inlet generates its whole pressure.
        if factor * self.rise >= edges.needed_rise(self.peak, self.behind) {
            self.peak
        } else {
            edges.pressure(factor * self.rise, self.behind).min(self.peak)
        }
    }
}

impl Split {
    /// Splits the pressure of all asperities of `field`.
    pub(super) fn fill(&mut self, field: &Field<'_>, inlets: &Inlets<'_>) {
        let (nx, n) = (field.grid.nx(), field.grid.len());
        self.fluid.clear();
        self.film.clear();
        self.solid.clear();
        self.runs.clear();
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
                    let nodes = j * nx + front..j * nx + i;
                    let front = Front::new(field, inlets.valleys, (j, front), inlets.contact_film);
                    let run = Run {
                        peak: nodes.clone().map(|k| field.pressure[k]).fold(0.0, f64::max),
                        nodes,
                        rise: inlets.entrainment * front.rise,
                        behind: inlets.stiffness * front.slope,
                    };
                    self.share(&run, field.pressure, inlets);
                    self.runs.push(run);
                }
                i += 1;
            }
        }
    }

    /// Share of the sum of `pressure` that solids carry at `factor` times the rises of the last split.
    pub(super) fn solid_share(&self, pressure: &[f64], edges: &EdgePressures, factor: f64) -> f64 {
        let (mut solid, mut whole) = (0.0, 0.0);
        for run in &self.runs {
            // Solids carry the pressure above that at the edge.
            let edge = run.edge(edges, factor);
            for p in &pressure[run.nodes.clone()] {
                solid += (p - edge).max(0.0);
                whole += p;
            }
        }
        if whole > 0.0 { solid / whole } else { 0.0 }
    }

    /// Splits the pressure of one run. The flow of the inlet passes the run unchanged.
    fn share(&mut self, run: &Run, pressure: &[f64], inlets: &Inlets<'_>) {
        let edge = run.edge(inlets.edges, 1.0);
        let lift = (run.rise / inlets.edges.needed_rise(run.peak, run.behind)).powf(LIFT).max(1.0);
        let film = (inlets.contact_film * lift).min(inlets.highest_film);
        let carried = inlets.oil.at(edge).density;
        // The fluid carries the pressure of the edge, solids the rest.
        for k in run.nodes.clone() {
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
