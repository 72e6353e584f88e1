//! Pressures of nodes with prescribed films: a rough inverse of the elastic response.

use super::coarse_films::CoarseFilms;
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::coupled::UNPADDED;

/// Levels of the rough inverse in contacts with solid contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Inverse {
    /// Blocks of nodes alone: enough for films that are wide.
    Blocks,
    /// Blocks, then nodes for their residual.
    Nodes,
}

/// Finds the pressures of nodes with prescribed films under given pressures of all others.
///
/// Blocks of nodes come first (see [`CoarseFilms`]): they resolve the wide displacements, which the inverse
/// convolution, masked to scattered nodes, overestimates by far. It then resolves their residual on the nodes.
///
/// With `w^2` the share of the pressure of a node that is found from its film, `w y` is that share, and the
/// equations are `w K w y = w` times the film: as symmetric as `K`, and contact nodes have the weight one.
#[derive(Debug)]
pub(super) struct PrescribedDisplacements {
    nodes: Vec<u32>,
    /// Square root of the share of a node's pressure that is found from its film.
    weights: Vec<f64>,
    /// None on a line, whose logarithmic response does not decay over a length.
    coarse: Option<CoarseFilms>,
    /// Bits of the influences of the body for which the blocks were made.
    influences: [u64; 4],
    pub(super) films: Vec<f64>,
    pub(super) pressures: Vec<f64>,
    scratch: Vec<f64>,
}

impl PrescribedDisplacements {
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        Self {
            nodes: Vec::with_capacity(n),
            weights: vec![0.0; n],
            coarse: None,
            influences: [0; 4],
            films: vec![0.0; n],
            pressures: vec![0.0; n],
            scratch: vec![0.0; n],
        }
    }

    /// Takes the elastic response of `body`, once for each; not counted in the work of a solve.
    pub(super) fn configure(&mut self, body: &mut dyn DeformationModel) -> Result<(), InputError> {
        let [own, along, across] = [(0, 0), (1, 0), (0, 1)].map(|(di, dj)| body.influence(di, dj));
        let influences = [own, along, across, body.self_influence(0)].map(f64::to_bits);
        if body.grid().ny() == 1 || (self.coarse.is_some() && self.influences == influences) {
            return Ok(());
        }
        self.coarse = Some(CoarseFilms::new(body)?);
        self.influences = influences;
        Ok(())
    }

    /// Takes the nodes with prescribed films and their weights, all above zero.
    pub(super) fn prepare(&mut self, nodes: impl Iterator<Item = (u32, f64)>) {
        self.nodes.clear();
        self.weights.fill(0.0);
        for (k, weight) in nodes {
            self.nodes.push(k);
            self.weights[k as usize] = weight;
        }
        if let Some(coarse) = &mut self.coarse {
            coarse.prepare(&self.nodes, &self.weights);
        }
    }

    /// Adds to the known `pressures` those that cause the prescribed `films`, in deflections of a node under unit
    /// pressure. Without solid contact (`screened` is false) the known pressures are wide and do not load these
    /// films. Returns the cost in convolutions.
    pub(super) fn solve(
        &mut self,
        body: &mut dyn DeformationModel,
        screened: bool,
        inverse: Inverse,
    ) -> Result<f64, InputError> {
        let Self { nodes, weights, coarse, films, pressures, scratch, .. } = self;
        if nodes.is_empty() {
            return Ok(0.0);
        }
        // Blocks of nodes, and their residual.
        let mut cost = UNPADDED;
        let own = body.influence(0, 0);
        let mut coarse = coarse.as_mut().filter(|_| screened);
        if let Some(coarse) = &mut coarse {
            let in_blocks = coarse.add_pressures(nodes, weights, films, pressures);
            if inverse == Inverse::Blocks {
                return Ok(in_blocks);
            }
            cost += UNPADDED + in_blocks;
            body.displacement_periodic(pressures, scratch)?;
            for &k in &*nodes {
                films[k as usize] -= scratch[k as usize] / own;
            }
        }
        // Inverse convolution on the weighted nodes.
        for (film, weight) in films.iter_mut().zip(&*weights) {
            *film *= weight;
        }
        body.pressure_estimate(films, scratch)?;
        if let Some(coarse) = coarse {
            // The blocks have found the means already; those of single nodes would load the whole contact.
            coarse.take_means(nodes, weights, scratch);
        }
        for &k in &*nodes {
            pressures[k as usize] += own * weights[k as usize] * scratch[k as usize];
        }
        Ok(cost)
    }
}
