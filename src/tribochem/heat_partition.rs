//! Partition of friction heat for equal temperatures of both bodies in the contact.
//!
//! With the rises `T_1 = C_1 q_1` and `T_2 = C_2 q_2` of both surfaces and `q_1 + q_2 = q`, equal
//! temperatures at heated nodes require `(C_1 + C_2) q_1 = C_2 q`. For a layer of resistance `R` between the
//! bodies with the heat source in its middle the equation is `(C_1 + C_2 + R) q_1 = (C_2 + R/2) q`. The
//! operator is unsymmetric, as moving bodies advect heat downstream; hence generalized conjugate residuals
//! instead of conjugate gradients. Between bodies that touch they are preconditioned by the inverse of the
//! operator on the periodic grid, through a layer by its diagonal.

use std::sync::Arc;

use crate::numerics::{Convolution, ConvolutionPlan, add_scaled, dot};

/// Number of search directions before a restart.
const DIRECTIONS: usize = 6;
/// Largest number of iterations.
const MAX_ITERATIONS: usize = 60;

/// Generalized conjugate residual method for `S q = b`, on the heated nodes or, with a layer, on all nodes;
/// `q` is zero elsewhere. The residual never increases, so an early stop is never worse than the initial
/// guess.
#[derive(Debug, Clone)]
pub(super) struct PartitionSolver {
    /// The operator over the self-influence. Single precision serves: the tolerance is a thousand times its rounding.
    sum: Convolution<f32>,
    /// Inverse of the operator on the periodic grid, times the self-influence.
    inverse: Convolution<f32>,
    /// Rise of both bodies at a node per flux into its cell \[K m^2/W\].
    pub(super) self_influence: f64,
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
    /// Buffers for fields of `n_nodes`. `bodies` are the rises of both bodies under a flux, `periodic` their sum on the
    /// periodic grid, `self_influence` the rise of both at a node per flux into its cell \[K m^2/W\].
    pub(super) fn new(
        n_nodes: usize,
        [first, second]: [&ConvolutionPlan; 2],
        periodic: &ConvolutionPlan,
        self_influence: f64,
    ) -> Self {
        let zeros = || vec![0.0; n_nodes];
        let sum = Convolution::new(Arc::new(first.plus(second).to_single(1.0 / self_influence)));
        let inverse = Convolution::new(Arc::new(periodic.inverse_with(0.0).to_single(self_influence)));
        let direction = || Direction { search: zeros(), image: zeros(), norm_squared: 0.0 };
        let directions = (0..DIRECTIONS).map(|_| direction()).collect();
        Self { sum, inverse, self_influence, residual: zeros(), directions }
    }

    /// Iterates on `share` until the largest residual is below `tolerance` \[K\]; returns the number of
    /// iterations. `layer` is the thermal resistance of a layer between the bodies at every node \[K m^2/W\].
    pub(super) fn solve(
        &mut self,
        (heated, layer): (&[f64], Option<&[f64]>),
        target: &[f64],
        share: &mut [f64],
        tolerance: f64,
    ) -> usize {
        self.sum.apply_scaled(share, [1.0, self.self_influence], &mut self.residual);
        add_layer(layer, share, &mut self.residual);
        for ((r, &t), &q) in self.residual.iter_mut().zip(target).zip(heated) {
            *r = if q > 0.0 || layer.is_some() { t - *r } else { 0.0 };
        }
        for iteration in 0..MAX_ITERATIONS {
            if largest(&self.residual) <= tolerance || !self.improve((heated, layer), share, iteration) {
                return iteration;
            }
        }
        MAX_ITERATIONS
    }

    /// One iteration; `false` if the new direction has no image.
    fn improve(
        &mut self,
        (heated, layer): (&[f64], Option<&[f64]>),
        share: &mut [f64],
        iteration: usize,
    ) -> bool {
        let (older, rest) = self.directions.split_at_mut(iteration % DIRECTIONS);
        let Some(new) = rest.first_mut() else { return false };
        // preconditioned residual as the search direction
        match layer {
            Some(layer) => {
                let scales = layer.iter().map(|resistance| self.self_influence + resistance);
                for ((search, residual), scale) in new.search.iter_mut().zip(&self.residual).zip(scales) {
                    *search = residual / scale;
                }
            }
            None => {
                self.inverse.apply(&self.residual, &mut new.search);
                for (search, &q) in new.search.iter_mut().zip(heated) {
                    *search = if q > 0.0 { *search } else { 0.0 };
                }
            }
        }
        self.sum.apply_scaled(&new.search, [1.0, self.self_influence], &mut new.image);
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
fn add_layer(layer: Option<&[f64]>, share: &[f64], rise: &mut [f64]) {
    let Some(layer) = layer else { return };
    for ((rise, flux), resistance) in rise.iter_mut().zip(share).zip(layer) {
        *rise += resistance * flux;
    }
}

/// Largest magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}
