//! The block preconditioner of the linearised equations: sparse LU of the fluid equations, masked inverse convolution of the
//! contact equations, load balance as a border.

use super::linearisation::Linearisation;
use super::unknowns::Unknowns;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{GridLu, STENCIL};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;

/// Cost of a pressure estimate in convolutions: transforms of a quarter of the points, without padding.
const ESTIMATE: f64 = 0.25;
/// Ratio of pressure flow to the entrainment of the elastic response of a node at which half of its pressure is found from
/// its film. Where the ratio is small, upstream fixes the film and the pressure is what makes it, as in solid contact;
/// where it is large, pressure flow fixes the pressure.
const BALANCED: f64 = 10.0;
/// The ratio beyond which the film does not enter.
const FREE: f64 = 1000.0;
/// Film of a node per own pressure over the self-influence: this times the square root of the ratio, between 1 and
/// [`WIDEST`]. Pressure flow smooths pressures over about that many cells, and wide pressures move films more. Solid contact
/// screens them: none of that where there is any.
const WIDTH: f64 = 0.4;
const WIDEST: f64 = 6.0;
/// The ratio below which, beside solid contact, pressure is found from the film alone and pressure flow left out.
const STIFF: f64 = 0.1;

/// Sparse LU of the fluid equations, masked inverse convolution of the contact equations, load balance as a border.
#[derive(Debug)]
pub(super) struct BlockPreconditioner {
    stencil: Vec<f32>,
    lu: GridLu,
    /// By how much the unknown of a node moves its pressure: one or zero.
    moves: Vec<f32>,
    /// Film per unknown of the fluid block.
    response: Vec<f32>,
    /// Square root of the share of a fluid node's pressure that is found from its film.
    film_share: Vec<f32>,
    fluid: Vec<f32>,
    gap: Vec<f64>,
    contact: Vec<f64>,
    /// `M^-1` times the column of the approach.
    border: Vec<f32>,
    /// Load that this vector carries.
    border_load: f32,
    column: Vec<f32>,
}

impl BlockPreconditioner {
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        let most = Unknowns::most(&grid);
        Self {
            stencil: vec![0.0; STENCIL * n],
            lu: GridLu::new(grid.nx(), grid.ny()),
            moves: vec![0.0; n],
            response: vec![0.0; n],
            film_share: vec![0.0; n],
            fluid: vec![0.0; n],
            gap: vec![0.0; n],
            contact: vec![0.0; n],
            border: vec![0.0; most],
            border_load: 1.0,
            column: vec![0.0; most],
        }
    }

    /// Factorises the fluid block, and gives the mass balances the sizes of its diagonal; false where the block has no finite
    /// factors.
    pub(super) fn prepare(
        &mut self,
        coupled: &Coupled,
        linearisation: &Linearisation,
        unknowns: &mut Unknowns,
        problem: &LubricatedContact<'_>,
    ) -> bool {
        self.film_share.fill(0.0);
        if problem.lubricant.is_none() {
            return true;
        }
        self.find_shares(coupled, unknowns);
        for row in self.stencil.chunks_exact_mut(STENCIL) {
            row.copy_from_slice(&[1.0, 0.0, 0.0, 0.0, 0.0]);
        }
        for &k in unknowns.balanced() {
            let k = k as usize;
            let row = linearisation.stencil_row(k, &self.moves, &self.response);
            self.stencil[STENCIL * k..][..STENCIL].copy_from_slice(&row);
        }
        unknowns.set_row_sizes(|k| self.stencil[STENCIL * k].abs().max(1.0));
        self.lu.factorise(&self.stencil)
    }

    /// How the fluid block treats every node.
    fn find_shares(&mut self, coupled: &Coupled, unknowns: &Unknowns) {
        // On a line the inverse of the logarithmic kernel is too poor for pressures from films.
        let by_film = coupled.fluid.grid.ny() > 1;
        let screened = coupled.kinds.iter().any(|kind| kind.is_contact());
        self.moves.fill(0.0);
        self.response.fill(0.0);
        for &k in unknowns.balanced() {
            self.moves[k as usize] = 1.0;
        }
        for &k in unknowns.limited() {
            (self.moves[k as usize], self.response[k as usize]) = (0.0, 1.0);
        }
        for &k in unknowns.open() {
            let k = k as usize;
            self.response[k] = 1.0;
            if !by_film {
                continue;
            }
            let ratio = coupled.fluid.flow_ratio(k, coupled.near).max(0.0);
            if screened {
                if ratio < STIFF {
                    (self.moves[k], self.film_share[k]) = (0.0, 1.0);
                }
                continue;
            }
            self.response[k] = (WIDTH * ratio.sqrt()).clamp(1.0, WIDEST) as f32;
            if ratio < FREE {
                self.film_share[k] = (1.0 + (ratio / BALANCED).sqrt()).sqrt().recip() as f32;
            }
        }
    }

    /// Prepares the border: what the blocks make of the column of the approach.
    pub(super) fn border(
        &mut self,
        unknowns: &mut Unknowns,
        coupled: &mut Coupled,
        linearisation: &mut Linearisation,
        problem: &mut LubricatedContact<'_>,
    ) -> Result<(), InputError> {
        let n = unknowns.len();
        let (mut column, mut border) = (std::mem::take(&mut self.column), std::mem::take(&mut self.border));
        unknowns.approach_column(linearisation, &mut column[..n]);
        let result = self.blocks(unknowns, coupled, problem, &column[..n], &mut border[..n]);
        border[n - 1] = 0.0;
        self.border_load = unknowns.load(&border[..n]);
        (self.column, self.border) = (column, border);
        result
    }

    /// `out = M^-1 r`.
    pub(super) fn apply(
        &mut self,
        unknowns: &Unknowns,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        r: &[f32],
        out: &mut [f32],
    ) -> Result<(), InputError> {
        let last = unknowns.len() - 1;
        self.blocks(unknowns, coupled, problem, r, out)?;
        let excess = unknowns.load(out) - r[last];
        let approach = if self.border_load == 0.0 { 0.0 } else { excess / self.border_load };
        for (o, b) in out[..last].iter_mut().zip(&self.border) {
            *o -= approach * b;
        }
        out[last] = approach;
        Ok(())
    }

    fn blocks(
        &mut self,
        unknowns: &Unknowns,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        r: &[f32],
        out: &mut [f32],
    ) -> Result<(), InputError> {
        let own = coupled.near.own;
        let (balanced, open, contact) = (unknowns.balanced(), unknowns.open(), unknowns.contact());
        if problem.lubricant.is_some() {
            self.fluid.fill(0.0);
            for (row, (&k, r)) in balanced.iter().zip(r).enumerate() {
                self.fluid[k as usize] = r / unknowns.weight(row);
            }
            self.lu.solve(&mut self.fluid);
        }
        let by_film = open.iter().any(|&k| self.film_share[k as usize] > 0.0);
        let gaps = &r[balanced.len()..];
        if by_film || !contact.is_empty() {
            self.gap.fill(0.0);
            for (&k, r) in contact.iter().zip(gaps) {
                self.gap[k as usize] = own * f64::from(*r);
            }
            for &k in open {
                let k = k as usize;
                self.gap[k] = own * f64::from(self.film_share[k] * self.response[k] * self.fluid[k]);
            }
            problem.deformation.pressure_estimate(&self.gap, &mut self.contact)?;
            coupled.convolutions += ESTIMATE;
        }
        let (fluid, pressures) = out.split_at_mut(balanced.len());
        for (out, &k) in fluid.iter_mut().zip(balanced) {
            let k = k as usize;
            let share = self.film_share[k];
            *out = if share > 0.0 {
                share * self.contact[k] as f32 + (1.0 - share * share) * self.fluid[k]
            } else {
                self.fluid[k]
            };
        }
        for (out, &k) in pressures.iter_mut().zip(contact) {
            *out = self.contact[k as usize] as f32;
        }
        pressures[contact.len()] = 0.0;
        Ok(())
    }
}
