//! Pressures of the nodes whose films are given: a rough inverse of the elastic response.

use super::coarse_films::CoarseFilms;
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::coupled::UNPADDED;

/// Share of the inverse convolution that is taken: it holds the films of all other nodes, which in truth give way. A single node
/// has about three quarters of the stiffness that it has between nodes that are held.
const YIELDING: f64 = 0.75;

/// Finds the pressures of nodes whose films are given under given pressures of all others.
///
/// Blocks of nodes come first (see [`CoarseFilms`]): they take the wide displacements, of which the inverse convolution,
/// masked to scattered nodes, makes far too much. It then takes what is left, on the nodes.
#[derive(Debug)]
pub(super) struct GivenFilms {
    nodes: Vec<u32>,
    /// None on a line, whose response has no length to fall off in.
    coarse: Option<CoarseFilms>,
    /// Influences of the body that the blocks are made for, their bits.
    influences: [u64; 3],
    pub(super) films: Vec<f64>,
    pub(super) pressures: Vec<f64>,
    scratch: Vec<f64>,
}

impl GivenFilms {
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        Self {
            nodes: Vec::with_capacity(n),
            coarse: None,
            influences: [0; 3],
            films: vec![0.0; n],
            pressures: vec![0.0; n],
            scratch: vec![0.0; n],
        }
    }

    /// Takes the elastic response of `body`, once for each: no part of the work of a solve.
    pub(super) fn configure(&mut self, body: &mut dyn DeformationModel) -> Result<(), InputError> {
        let influences = [(0, 0), (1, 0), (0, 1)].map(|(di, dj)| body.influence(di, dj).to_bits());
        if body.grid().ny() == 1 || (self.coarse.is_some() && self.influences == influences) {
            return Ok(());
        }
        self.coarse = Some(CoarseFilms::new(body)?);
        self.influences = influences;
        Ok(())
    }

    /// Takes the nodes whose films are given.
    pub(super) fn prepare(&mut self, nodes: impl Iterator<Item = u32>) {
        self.nodes.clear();
        self.nodes.extend(nodes);
        if let Some(coarse) = &mut self.coarse {
            coarse.prepare(&self.nodes);
        }
    }

    /// From `films`, in deflections of a node under unit pressure and zero where they are not given, and `pressures` as far as they
    /// are known, those where films are given. Returns the cost in convolutions.
    pub(super) fn solve(
        &mut self,
        body: &mut dyn DeformationModel,
        screened: bool,
    ) -> Result<f64, InputError> {
        let Self { nodes, coarse, films, pressures, scratch, .. } = self;
        if nodes.is_empty() {
            return Ok(0.0);
        }
        let mut cost = UNPADDED;
        let own = body.influence(0, 0);
        if let Some(coarse) = coarse.as_mut().filter(|_| screened) {
            cost += UNPADDED + coarse.add_pressures(nodes, films, pressures);
            body.displacement_sketch(pressures, scratch)?;
            for &k in &*nodes {
                films[k as usize] -= scratch[k as usize] / own;
            }
        }
        body.pressure_estimate(films, scratch)?;
        let share = if screened { YIELDING * own } else { own };
        for &k in &*nodes {
            pressures[k as usize] += share * scratch[k as usize];
        }
        Ok(cost)
    }
}
