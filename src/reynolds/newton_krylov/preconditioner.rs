//! The preconditioner of the linearized equations: the fluid equations, by sparse LU or another [`FluidBlock`], then
//! the pressures of the nodes with prescribed films, load balance as a border.

use super::fluid_block::FluidBlock;
use super::linearization::Linearization;
use super::prescribed_displacements::{Inverse, PrescribedDisplacements};
use super::unknowns::{Linearized, Unknowns};
use super::weak_coupling::FREE;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{FieldLines, STENCIL, for_each_range, map_nodes};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;

// Coupling of films and pressures of the fluid, by the ratio `R` of pressure flow to the entrainment of the elastic
// response of a node. Where it is small, the film is determined upstream and the pressure follows from it, as in solid
// contact; where it is large, pressure flow determines the pressure, and beyond `FREE` the film does not enter.

/// `R` below which pressure is found from the film alone, without pressure flow.
const STIFF: f64 = 0.1;
/// `R` at which half of the pressure of a node is found from its film.
const BALANCED: f64 = 3.0;

/// The fluid equations in which films respond to their own pressures alone, solved by a [`FluidBlock`]; then the
/// pressures of contact nodes, and of those whose films the first block has found, under the pressures of all
/// others; load balance as a border.
#[derive(Debug)]
pub(super) struct BlockPreconditioner {
    stencil: Vec<f32>,
    fluid_block: Box<dyn FluidBlock>,
    /// Square root of the share of a fluid node's pressure that is found from its film.
    film_weight: Vec<f32>,
    /// Nodes that are not filled, upstream of a node with a balance.
    is_coupled: Vec<bool>,
    fluid: Vec<f32>,
    /// Whether solids touch anywhere, which screens the pressures of the fluid.
    screened: bool,
    given: PrescribedDisplacements,
    /// `M^-1` times the column of the approach.
    border: Vec<f32>,
    /// Load that this vector carries.
    border_load: f32,
    column: Vec<f32>,
}

impl BlockPreconditioner {
    pub(super) fn new(grid: Grid, fluid_block: Box<dyn FluidBlock>) -> Self {
        let n = grid.len();
        let most = Unknowns::most(&grid);
        Self {
            stencil: vec![0.0; STENCIL * n],
            fluid_block,
            film_weight: vec![0.0; n],
            is_coupled: vec![false; n],
            fluid: vec![0.0; n],
            screened: false,
            given: PrescribedDisplacements::new(grid),
            border: vec![0.0; most],
            border_load: 1.0,
            column: vec![0.0; most],
        }
    }

    /// Takes the elastic response of the problem.
    pub(super) fn configure(&mut self, problem: &mut LubricatedContact<'_>) -> Result<(), InputError> {
        self.given.configure(problem.deformation)
    }

    /// Factorizes the fluid block, and scales the mass balances by its rows; false where the block has no finite
    /// factors or the solve must stop.
    pub(super) fn prepare(
        &mut self,
        coupled: &Coupled,
        linearization: &Linearization,
        unknowns: &mut Unknowns,
        problem: &LubricatedContact<'_>,
    ) -> bool {
        // Solid contact screens the pressures of the fluid.
        self.screened = coupled.active_set.iter().any(|node_state| node_state.is_contact());
        // Nodes with prescribed films. On a line the inverse of the logarithmic kernel is too poor for pressures
        // from films.
        if problem.lubricant.is_some() && coupled.fluid.grid.ny() > 1 {
            self.find_shares(coupled);
        } else {
            self.film_weight.fill(0.0);
        }
        let contact = unknowns.contact().iter().map(|&k| (k, 1.0));
        let open = unknowns.open().iter().map(|&k| (k, f64::from(self.film_weight[k as usize])));
        self.given.prepare(contact.chain(open.filter(|(_, weight)| *weight > 0.0)));
        if problem.lubricant.is_none() {
            return true;
        }
        // Assemble the five-point matrix of the fluid; all other nodes have the identity.
        self.mark_coupled(linearization, unknowns);
        let (active_set, film_weight, is_coupled) =
            (&coupled.active_set, &self.film_weight, &self.is_coupled);
        let dof_map = |node: usize| match active_set[node].dof_map() {
            [_, film] if film_weight[node] >= 1.0 => [0.0, film],
            both => both,
        };
        let n = is_coupled.len();
        for_each_range(FieldLines::new(&mut self.stencil, STENCIL), n, n, |nodes, stencil| {
            for (k, row) in nodes.zip(stencil.values.chunks_exact_mut(STENCIL)) {
                let has_row = active_set[k].has_balance() || is_coupled[k];
                row.copy_from_slice(&if has_row {
                    linearization.stencil_row(k, dof_map, is_coupled)
                } else {
                    [1.0, 0.0, 0.0, 0.0, 0.0]
                });
            }
        });
        // Scale the rows and factorize.
        unknowns.set_row_sizes(|k| self.fluid_block.row_size(self.stencil[STENCIL * k]));
        self.fluid_block.prepare(&self.stencil, &|| problem.deformation.must_stop())
    }

    /// Marks the nodes whose inflow reaches a node with a balance.
    fn mark_coupled(&mut self, linearization: &Linearization, unknowns: &Unknowns) {
        self.is_coupled.fill(false);
        if linearization.mark_all_coupled(&mut self.is_coupled) {
            return;
        }
        for &k in unknowns.balanced() {
            linearization.mark_coupled(k as usize, |_| true, &mut self.is_coupled);
        }
    }

    /// Share of the pressure of each open node that is found from its film; zero elsewhere.
    fn find_shares(&mut self, coupled: &Coupled) {
        map_nodes(&mut self.film_weight, |k, weight| {
            *weight = 0.0;
            if !coupled.active_set[k].is_open_fluid() {
                return;
            }
            // Pressure flow over entrainment by the elastic response decides between film and pressure.
            let ratio = coupled.fluid.flow_ratio(k, coupled.near).max(0.0);
            if ratio < STIFF {
                *weight = 1.0;
            } else if ratio < FREE {
                *weight = (1.0 + (ratio / BALANCED).sqrt()).sqrt().recip() as f32;
            }
        });
    }

    /// Prepares the border: the blocks applied to the column of the approach, which moves all films alike.
    pub(super) fn border(
        &mut self,
        unknowns: &mut Unknowns,
        at: &mut Linearized<'_, '_>,
    ) -> Result<(), InputError> {
        let n = unknowns.len();
        let (mut column, mut border) = (std::mem::take(&mut self.column), std::mem::take(&mut self.border));
        unknowns.approach_column(at.linearization, &mut column[..n]);
        let into = &mut border[..n];
        let result = self.blocks(unknowns, at, &column[..n], into, Inverse::Blocks);
        border[n - 1] = 0.0;
        self.border_load = unknowns.load(&border[..n]) as f32;
        (self.column, self.border) = (column, border);
        result
    }

    /// `out = M^-1 r`.
    pub(super) fn apply(
        &mut self,
        unknowns: &Unknowns,
        at: &mut Linearized<'_, '_>,
        r: &[f32],
        out: &mut [f32],
    ) -> Result<(), InputError> {
        let last = unknowns.len() - 1;
        self.blocks(unknowns, at, r, out, Inverse::Nodes)?;
        // Eliminate the border: the approach restores the load.
        let excess = unknowns.load(out) as f32 - r[last];
        let approach = if self.border_load == 0.0 { 0.0 } else { excess / self.border_load };
        for (o, b) in out[..last].iter_mut().zip(&self.border) {
            *o -= approach * b;
        }
        out[last] = approach;
        Ok(())
    }

    /// The blocks without the border, of `r` into `out`.
    fn blocks(
        &mut self,
        unknowns: &Unknowns,
        at: &mut Linearized<'_, '_>,
        r: &[f32],
        out: &mut [f32],
        inverse: Inverse,
    ) -> Result<(), InputError> {
        let (balanced, open, contact) = (unknowns.balanced(), unknowns.open(), unknowns.contact());
        // Fluid: pressures, plastic depths and flows from the mass balances.
        if at.problem.lubricant.is_some() {
            self.fluid.fill(0.0);
            for (row, (&k, r)) in balanced.iter().zip(r).enumerate() {
                self.fluid[k as usize] = r / unknowns.weight(row);
            }
            self.fluid_block.solve(&self.stencil, &mut self.fluid);
        }
        // Prescribed displacements: pressures of contact, and the share of fluid pressures found from films.
        let gaps = &r[balanced.len()..];
        let PrescribedDisplacements { films, pressures, .. } = &mut self.given;
        films.fill(0.0);
        pressures.fill(0.0);
        for (&k, r) in contact.iter().zip(gaps) {
            films[k as usize] = f64::from(*r);
        }
        for k in open.iter().map(|&k| k as usize) {
            films[k] = f64::from(self.fluid[k]);
            pressures[k] = f64::from((1.0 - self.film_weight[k].powi(2)) * self.fluid[k]);
        }
        at.coupled.convolutions += self.given.solve(at.problem.deformation, self.screened, inverse)?;
        // Gather the vector.
        let found = &self.given.pressures;
        let (fluid, pressures) = out.split_at_mut(balanced.len());
        let (in_open, in_others) = fluid.split_at_mut(open.len());
        for (out, &k) in in_open.iter_mut().zip(open) {
            *out = found[k as usize] as f32;
        }
        for (out, &k) in in_others.iter_mut().zip(&balanced[open.len()..]) {
            *out = self.fluid[k as usize];
        }
        for (out, &k) in pressures.iter_mut().zip(contact) {
            *out = found[k as usize] as f32;
        }
        pressures[contact.len()] = 0.0;
        Ok(())
    }
}
