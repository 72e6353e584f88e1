//! Partition of friction heat for equal temperatures of both bodies in the contact.
//!
//! With the rises `T_1 = C_1 q_1` and `T_2 = C_2 q_2` of both surfaces and `q_1 + q_2 = q`, equal
//! temperatures at heated nodes require `(C_1 + C_2) q_1 = C_2 q`. For a layer of resistance `R` between the
//! bodies with the heat source in its middle the equation is `(C_1 + C_2 + R) q_1 = (C_2 + R/2) q`. The
//! operator is unsymmetric, as moving bodies advect heat downstream; hence generalized conjugate residuals
//! instead of conjugate gradients.

use crate::numerics::{Convolution, add_scaled, dot};

/// Number of search directions before a restart.
const DIRECTIONS: usize = 6;
/// Largest number of iterations.
const MAX_ITERATIONS: usize = 60;

/// A layer between the bodies: its thermal resistance at every node, and the self-influence of both bodies as
/// the scale of the preconditioner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resistance<'a> {
    /// Resistance at every node \[K m^2/W\].
    pub(super) nodes: &'a [f64],
    /// Rise of both bodies at a node per flux into its cell \[K m^2/W\].
    pub(super) self_influence: f64,
}

/// Generalized conjugate residual method for `S q = b`, on the heated nodes or, with a layer, on all nodes;
/// `q` is zero elsewhere. The residual never increases, so an early stop is never worse than the initial
/// guess.
#[derive(Debug, Clone)]
pub(super) struct PartitionSolver {
    /// `b - S q` \[K\].
    residual: Vec<f64>,
    /// Search directions since the restart, with orthogonal images.
    directions: Vec<Direction>,
}

/// A search direction and its image under the operator.
#[derive(Debug, Clone)]
struct Direction {
    /// The direction \[W/m^2\].
    search: Vec<f64>,
    /// Its image \[K\].
    image: Vec<f64>,
    /// Square of the norm of the image.
    norm_squared: f64,
}

impl PartitionSolver {
    /// Buffers for fields of `n_nodes`.
    pub(super) fn new(n_nodes: usize) -> Self {
        let zeros = || vec![0.0; n_nodes];
        let direction = || Direction { search: zeros(), image: zeros(), norm_squared: 0.0 };
        Self { residual: zeros(), directions: (0..DIRECTIONS).map(|_| direction()).collect() }
    }

    /// Iterates on `share` until the largest residual is below `tolerance` \[K\]; returns the number of
    /// iterations.
    pub(super) fn solve(
        &mut self,
        sum: &mut Convolution,
        (heated, layer): (&[f64], Option<Resistance<'_>>),
        target: &[f64],
        share: &mut [f64],
        tolerance: f64,
    ) -> usize {
        sum.apply(share, &mut self.residual);
        add_layer(layer, share, &mut self.residual);
        for ((r, &t), &q) in self.residual.iter_mut().zip(target).zip(heated) {
            *r = if q > 0.0 || layer.is_some() { t - *r } else { 0.0 };
        }
        for iteration in 0..MAX_ITERATIONS {
            if largest(&self.residual) <= tolerance || !self.improve(sum, (heated, layer), share, iteration) {
                return iteration;
            }
        }
        MAX_ITERATIONS
    }

    /// One iteration; `false` if the new direction has no image.
    fn improve(
        &mut self,
        sum: &mut Convolution,
        (heated, layer): (&[f64], Option<Resistance<'_>>),
        share: &mut [f64],
        iteration: usize,
    ) -> bool {
        let (older, rest) = self.directions.split_at_mut(iteration % DIRECTIONS);
        let Some(new) = rest.first_mut() else { return false };
        // scaled residual as the search direction
        new.search.copy_from_slice(&self.residual);
        if let Some(layer) = layer {
            for (search, resistance) in new.search.iter_mut().zip(layer.nodes) {
                *search /= layer.self_influence + resistance;
            }
        }
        sum.apply(&new.search, &mut new.image);
        add_layer(layer, &new.search, &mut new.image);
        for (value, &q) in new.image.iter_mut().zip(heated) {
            *value = if q > 0.0 || layer.is_some() { *value } else { 0.0 };
        }
        // orthogonalize its image against the earlier ones
        for old in older.iter() {
            let weight = -dot(&new.image, &old.image) / old.norm_squared;
            add_scaled(&mut new.image, weight, &old.image);
            add_scaled(&mut new.search, weight, &old.search);
        }
        new.norm_squared = dot(&new.image, &new.image);
        if !(new.norm_squared.is_finite() && new.norm_squared > 0.0) {
            return false;
        }
        // minimize the residual along it
        let length = dot(&self.residual, &new.image) / new.norm_squared;
        add_scaled(share, length, &new.search);
        add_scaled(&mut self.residual, -length, &new.image);
        true
    }
}

/// Adds the temperature difference across the layer under the flux `share` to `rise`.
fn add_layer(layer: Option<Resistance<'_>>, share: &[f64], rise: &mut [f64]) {
    let Some(layer) = layer else { return };
    for ((rise, flux), resistance) in rise.iter_mut().zip(share).zip(layer.nodes) {
        *rise += resistance * flux;
    }
}

/// Largest magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}
