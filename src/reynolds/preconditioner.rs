//! The linearised equations and their block preconditioner.
//!
//! A vector of unknowns holds, for `n` nodes, `n` first unknowns, `n` second ones and the approach:
//!
//! | node | first unknown, its row | second unknown, its row |
//! |---|---|---|
//! | fluid | pressure, mass balance | none |
//! | fluid at the limit | plastic depth over self-influence, mass balance | none |
//! | contact | total pressure, gap | fluid pressure, mass balance |
//! | yielded contact | none | fluid pressure, mass balance |
//! | cavitated, boundary | none | none |
//!
//! All rows are film thicknesses \[m\], all unknowns but the approach are pressures \[Pa\].

use super::ReynoldsError;
use super::active_set::{Fluid, Kind, Solid};
use super::coupled::Coupled;
use super::discretisation::NearField;
use super::problem::LubricatedContact;
use super::state::ContactState;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{GridLu, STENCIL};

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

/// The product of the linearised equations with a vector.
#[derive(Debug, Clone)]
pub(super) struct Unknowns {
    pressure_change: Vec<f64>,
    fluid_change: Vec<f64>,
    film_change: Vec<f64>,
    elastic_change: Vec<f64>,
}

/// Changes of one node in a linear step.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeChange {
    pub(super) pressure: f64,
    pub(super) fluid_pressure: f64,
    pub(super) film: f64,
    pub(super) elastic_film: f64,
}

impl Unknowns {
    pub(super) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            pressure_change: zeros(),
            fluid_change: zeros(),
            film_change: zeros(),
            elastic_change: zeros(),
        }
    }

    /// The load balance as a film thickness: missing load over load times the self-deflection under the reference
    /// pressure.
    pub(super) fn load_row(problem: &LubricatedContact<'_>, near: NearField, missing: f64) -> f64 {
        missing / problem.load * near.own * problem.reference_pressure
    }

    /// Elastic change of the films under the step `x`; one convolution.
    fn elastic_film_change(
        &mut self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        x: &[f64],
    ) -> Result<(), InputError> {
        let n = coupled.kinds.len();
        for (k, kind) in coupled.kinds.iter().enumerate() {
            self.pressure_change[k] = if kind.fluid == Fluid::AtLimit { 0.0 } else { x[k] };
        }
        problem.deformation.displacement(&self.pressure_change, &mut self.film_change)?;
        coupled.convolutions += 1.0;
        for change in &mut self.film_change {
            *change -= x[2 * n];
        }
        Ok(())
    }

    /// Changes of fluid pressure and film under the step `x`, whose elastic film change is in `film_change`.
    fn resolve(&mut self, coupled: &Coupled, x: &[f64]) {
        let n = coupled.kinds.len();
        for (k, kind) in coupled.kinds.iter().enumerate() {
            self.fluid_change[k] = match (kind.fluid, kind.solid) {
                (Fluid::AtLimit, _) => 0.0,
                (_, Solid::Open) => x[k],
                _ => x[n + k],
            };
            if kind.fluid == Fluid::AtLimit {
                self.film_change[k] += coupled.near.own * x[k];
            } else if kind.solid == Solid::Yielded {
                // The plastic depth keeps the film.
                self.film_change[k] = 0.0;
            }
        }
    }

    /// Turns the step `x` into changes of every quantity of the nodes; one convolution.
    pub(super) fn expand(
        &mut self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        x: &[f64],
    ) -> Result<(), InputError> {
        self.elastic_film_change(coupled, problem, x)?;
        self.elastic_change.copy_from_slice(&self.film_change);
        self.resolve(coupled, x);
        Ok(())
    }

    /// Changes of node `k` after [`Unknowns::expand`].
    pub(super) fn node(&self, k: usize) -> NodeChange {
        NodeChange {
            pressure: self.pressure_change[k],
            fluid_pressure: self.fluid_change[k],
            film: self.film_change[k],
            elastic_film: self.elastic_change[k],
        }
    }

    /// Change of the mass balance of node `k` after [`Unknowns::resolve`].
    pub(super) fn balance_change(&self, coupled: &Coupled, state: &ContactState, k: usize) -> f64 {
        coupled.fluid.balance_change(k, &state.film, &self.fluid_change, &self.film_change)
    }

    /// `out = J x`; one convolution.
    pub(super) fn product(
        &mut self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
        x: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        self.elastic_film_change(coupled, problem, x)?;
        self.local_product(coupled, problem, state, x, out);
        Ok(())
    }

    /// The product for a vector that holds an approach alone; no convolution.
    fn approach_product(
        &mut self,
        coupled: &Coupled,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        x: &[f64],
        out: &mut [f64],
    ) {
        let n = coupled.kinds.len();
        self.pressure_change.fill(0.0);
        self.film_change.fill(-x[2 * n]);
        self.local_product(coupled, problem, state, x, out);
    }

    fn local_product(
        &mut self,
        coupled: &Coupled,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        x: &[f64],
        out: &mut [f64],
    ) {
        let n = coupled.kinds.len();
        let (first, rest) = out.split_at_mut(n);
        let (second, load) = rest.split_at_mut(n);
        self.resolve(coupled, x);
        for (k, kind) in coupled.kinds.iter().enumerate() {
            first[k] = if kind.solid == Solid::Contact { self.film_change[k] } else { 0.0 };
            second[k] = 0.0;
            if kind.has_balance() {
                let change = self.balance_change(coupled, state, k);
                if kind.is_contact() {
                    second[k] = change;
                } else {
                    first[k] = change;
                }
            }
        }
        let load_change = self.pressure_change.iter().sum::<f64>() * coupled.fluid.grid.cell_area();
        load[0] = Self::load_row(problem, coupled.near, load_change);
    }
}

/// Sparse LU of the fluid equations, masked inverse convolution of the contact equations, load balance as a border.
#[derive(Debug)]
pub(super) struct BlockPreconditioner {
    stencil: Vec<f64>,
    /// Sides of the nodes as the fluid block sees them: nodes too stiff to be moved by pressure flow count as fluid at
    /// the limit.
    kinds: Vec<Kind>,
    lu: GridLu,
    /// Film per unknown of the fluid block \[m/Pa\].
    response: Vec<f64>,
    /// Square root of the share of a fluid node's pressure that is found from its film.
    film_share: Vec<f64>,
    fluid: Vec<f64>,
    gap: Vec<f64>,
    contact: Vec<f64>,
    /// `M^-1` times the column of the approach.
    border: Vec<f64>,
    /// Load that this vector carries, as a film.
    border_load: f64,
    column: Vec<f64>,
}

impl BlockPreconditioner {
    pub(super) fn new(grid: Grid) -> Result<Self, ReynoldsError> {
        let zeros = || vec![0.0; grid.len()];
        Ok(Self {
            stencil: vec![0.0; STENCIL * grid.len()],
            kinds: vec![Kind::BOUNDARY; grid.len()],
            lu: GridLu::new(grid.nx(), grid.ny()),
            response: zeros(),
            film_share: zeros(),
            fluid: zeros(),
            gap: zeros(),
            contact: zeros(),
            border: vec![0.0; 2 * grid.len() + 1],
            border_load: 1.0,
            column: vec![0.0; 2 * grid.len() + 1],
        })
    }

    /// Factorises the fluid block of the current state.
    pub(super) fn prepare(
        &mut self,
        coupled: &Coupled,
        state: &ContactState,
        problem: &LubricatedContact<'_>,
    ) -> Result<(), ReynoldsError> {
        if problem.lubricant.is_none() {
            return Ok(());
        }
        self.find_shares(coupled);
        let own = coupled.near.own;
        for (k, row) in self.stencil.chunks_exact_mut(STENCIL).enumerate() {
            let balanced = coupled.kinds[k].has_balance();
            let values = if balanced {
                coupled.fluid.stencil_row(k, &self.kinds, &state.film, &self.response)
            } else {
                [own, 0.0, 0.0, 0.0, 0.0]
            };
            row.copy_from_slice(&values);
        }
        if self.lu.factorise(&self.stencil) { Ok(()) } else { Err(ReynoldsError::SingularFluidBlock) }
    }

    /// How the fluid block treats every node.
    fn find_shares(&mut self, coupled: &Coupled) {
        let own = coupled.near.own;
        // On a line the inverse of the logarithmic kernel is too poor for pressures from films.
        let by_film = coupled.fluid.grid.ny() > 1;
        let screened = coupled.kinds.iter().any(|kind| kind.is_contact());
        for (k, kind) in coupled.kinds.iter().enumerate() {
            (self.kinds[k], self.film_share[k], self.response[k]) = (*kind, 0.0, 0.0);
            if kind.fluid == Fluid::AtLimit {
                self.response[k] = own;
            } else if kind.is_open_fluid() {
                self.response[k] = own;
                let ratio = coupled.fluid.flow_ratio(k, coupled.near).max(0.0);
                if screened && by_film && ratio < STIFF {
                    self.kinds[k].fluid = Fluid::AtLimit;
                    self.film_share[k] = 1.0;
                } else if !screened && by_film {
                    self.response[k] = own * (WIDTH * ratio.sqrt()).clamp(1.0, WIDEST);
                    if ratio < FREE {
                        self.film_share[k] = (1.0 + (ratio / BALANCED).sqrt()).sqrt().recip();
                    }
                }
            }
        }
    }

    /// Diagonal of row `k` of the fluid block \[m/Pa\].
    pub(super) fn diagonal(&self, k: usize) -> f64 {
        self.stencil[STENCIL * k]
    }

    /// Prepares the border: what the blocks make of the column of the approach.
    pub(super) fn border(
        &mut self,
        unknowns: &mut Unknowns,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<(), InputError> {
        let n = coupled.kinds.len();
        self.border.fill(0.0);
        self.border[2 * n] = 1.0;
        let mut column = std::mem::take(&mut self.column);
        unknowns.approach_product(coupled, problem, state, &self.border, &mut column);
        let mut border = std::mem::take(&mut self.border);
        self.blocks(coupled, problem, &column, &mut border)?;
        border[2 * n] = 0.0;
        self.border_load = carried_load(coupled, problem, &border);
        self.border = border;
        self.column = column;
        Ok(())
    }

    /// `out = M^-1 r`.
    pub(super) fn apply(
        &mut self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        r: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let n = coupled.kinds.len();
        self.blocks(coupled, problem, r, out)?;
        let excess = carried_load(coupled, problem, out) - r[2 * n];
        let approach = if self.border_load == 0.0 { 0.0 } else { excess / self.border_load };
        for (o, b) in out.iter_mut().zip(&self.border) {
            *o -= approach * b;
        }
        out[2 * n] = approach;
        Ok(())
    }

    fn blocks(
        &mut self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        r: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let n = coupled.kinds.len();
        for (k, kind) in coupled.kinds.iter().enumerate() {
            self.fluid[k] = match (kind.has_balance(), kind.is_contact()) {
                (true, false) => r[k],
                (true, true) => r[n + k],
                _ => 0.0,
            };
        }
        if problem.lubricant.is_some() {
            self.lu.solve(&mut self.fluid);
        }
        let mut any = false;
        for (k, kind) in coupled.kinds.iter().enumerate() {
            self.gap[k] = if kind.solid == Solid::Contact {
                r[k]
            } else {
                self.film_share[k] * self.response[k] * self.fluid[k]
            };
            any |= kind.solid == Solid::Contact || self.film_share[k] > 0.0;
        }
        if any {
            problem.deformation.pressure_estimate(&self.gap, &mut self.contact)?;
            coupled.convolutions += ESTIMATE;
        }
        for (k, kind) in coupled.kinds.iter().enumerate() {
            let share = self.film_share[k];
            let fluid = if share > 0.0 {
                share * self.contact[k] + (1.0 - share * share) * self.fluid[k]
            } else {
                self.fluid[k]
            };
            let (first, second) = placed(*kind, self.contact[k], fluid);
            out[k] = first;
            out[n + k] = second;
        }
        out[2 * n] = 0.0;
        Ok(())
    }
}

/// Where the results of the two blocks go.
fn placed(kind: Kind, contact: f64, fluid: f64) -> (f64, f64) {
    let fluid = if kind.has_balance() { fluid } else { 0.0 };
    match kind.solid {
        Solid::Open => (fluid, 0.0),
        Solid::Contact => (contact, fluid),
        Solid::Yielded => (0.0, fluid),
    }
}

/// The load that the pressures of a vector of unknowns carry, as a film.
fn carried_load(coupled: &Coupled, problem: &LubricatedContact<'_>, x: &[f64]) -> f64 {
    let sum: f64 = coupled
        .kinds
        .iter()
        .zip(x)
        .filter(|(kind, _)| kind.fluid != Fluid::AtLimit)
        .map(|(_, change)| change)
        .sum();
    Unknowns::load_row(problem, coupled.near, sum * coupled.fluid.grid.cell_area())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::{DeformationModel, HalfSpace};
    use crate::lubricant::{DowsonHigginson, Lubricant, Roelands};
    use crate::reynolds::problem::interior;
    use crate::reynolds::{Scheme, ShearThinning};

    const N: usize = 12;

    fn noise(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A state with every kind of node in it, films and pressures of the size of a real contact.
    fn mixed_state(grid: &Grid, coupled: &mut Coupled, seed: &mut u64) -> ContactState {
        let mut state = ContactState::new(grid);
        for k in interior(grid) {
            let kind = match k % 5 {
                0 => Kind { fluid: Fluid::Active, solid: Solid::Contact },
                1 => Kind { fluid: Fluid::Cavitated, solid: Solid::Open },
                2 if k % 2 == 0 => Kind { fluid: Fluid::AtLimit, solid: Solid::Open },
                3 if k % 3 == 0 => Kind { fluid: Fluid::Active, solid: Solid::Yielded },
                _ => Kind { fluid: Fluid::Active, solid: Solid::Open },
            };
            coupled.kinds[k] = kind;
            let fluid = 1e8 + 2e8 * noise(seed);
            state.fluid_pressure[k] = if kind.fluid == Fluid::Cavitated { 0.0 } else { fluid };
            state.pressure[k] = state.fluid_pressure[k] + if kind.is_contact() { 1e9 } else { 0.0 };
        }
        state
    }

    #[test]
    fn product_is_the_derivative_of_the_equations() {
        check_product(None);
        for eyring_stress in [1e5, 1e7] {
            check_product(Some(ShearThinning { eyring_stress, sliding_speed: 0.1 }));
        }
    }

    fn check_product(shear_thinning: Option<ShearThinning>) {
        let grid = Grid::centred(N, N, 4e-6, 4e-6).unwrap();
        let mut body = HalfSpace::new(grid, 230e9).unwrap();
        let oil = Lubricant::new(
            Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
            DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
        );
        let mut seed = 7;
        let mut displaced = vec![0.0; grid.len()];
        let mut coupled = Coupled::new(grid);
        let base = mixed_state(&grid, &mut coupled, &mut seed);
        body.displacement(&base.pressure, &mut displaced).unwrap();
        let gap: Vec<f64> = displaced.iter().map(|u| 20e-9 + 100e-9 * noise(&mut seed) - u).collect();
        let mut problem = LubricatedContact {
            gap: &gap,
            deformation: &mut body,
            lubricant: Some(&oil),
            entrainment_speed: 0.1,
            squeeze: None,
            load: 1.0,
            pressure_limit: None,
            film_cutoff: 1e-9,
            contact: Default::default(),
            scheme: Scheme::FirstOrder,
            face_mobility: Default::default(),
            shear_thinning,
            reference_half_widths: (1e-5, 1e-5),
            reference_pressure: 1e9,
            reference_film: 0.0,
        };
        let kinds = coupled.kinds.clone();
        coupled.configure(&problem);
        coupled.kinds = kinds;
        let n = grid.len();
        let mut x = vec![0.0; 2 * n + 1];
        for (k, kind) in coupled.kinds.iter().enumerate() {
            if kind.fluid != Fluid::Boundary && !(kind.fluid == Fluid::Cavitated) {
                x[k] = if kind.solid == Solid::Yielded { 0.0 } else { 1e6 * (noise(&mut seed) - 0.5) };
                x[n + k] = if kind.is_contact() { 1e6 * (noise(&mut seed) - 0.5) } else { 0.0 };
            }
        }
        x[2 * n] = 1e-10;
        let mut rows_at = |t: f64, coupled: &mut Coupled| -> Vec<f64> {
            let mut state = base.clone();
            let own = coupled.near.own;
            for (k, kind) in coupled.kinds.iter().enumerate() {
                if kind.fluid != Fluid::AtLimit {
                    state.pressure[k] += t * x[k];
                    state.fluid_pressure[k] += t * if kind.is_contact() { x[n + k] } else { x[k] };
                }
            }
            state.approach = t * x[2 * n];
            problem.deformation.displacement(&state.pressure, &mut coupled.elastic_film).unwrap();
            for (k, kind) in coupled.kinds.iter().enumerate() {
                coupled.elastic_film[k] += gap[k] - state.approach;
                let depth = if kind.fluid == Fluid::AtLimit { 10e-9 + t * own * x[k] } else { 0.0 };
                // Yielded contact keeps its film whatever the elastic one does.
                state.film[k] =
                    if kind.solid == Solid::Yielded { 30e-9 } else { coupled.elastic_film[k] + depth };
            }
            coupled.refresh(&problem, &mut state);
            let mut rows = vec![0.0; 2 * n + 1];
            for (k, kind) in coupled.kinds.iter().enumerate() {
                let balance = if kind.has_balance() { coupled.balance[k] } else { 0.0 };
                match kind.solid {
                    Solid::Open => rows[k] = balance,
                    Solid::Contact => (rows[k], rows[n + k]) = (coupled.elastic_film[k], balance),
                    Solid::Yielded => rows[n + k] = balance,
                }
            }
            let load = state.pressure.iter().sum::<f64>() * grid.cell_area();
            rows[2 * n] = Unknowns::load_row(&problem, coupled.near, load);
            rows
        };
        let (up, down) = (rows_at(1e-2, &mut coupled), rows_at(-1e-2, &mut coupled));
        let mut state = base.clone();
        let _ = rows_at(0.0, &mut coupled);
        state.film.clone_from(&coupled.elastic_film);
        for (k, kind) in coupled.kinds.iter().enumerate() {
            state.film[k] += if kind.fluid == Fluid::AtLimit { 10e-9 } else { 0.0 };
            if kind.solid == Solid::Yielded {
                state.film[k] = 30e-9;
            }
        }
        let mut product = vec![0.0; 2 * n + 1];
        Unknowns::new(grid).product(&mut coupled, &mut problem, &state, &x, &mut product).unwrap();
        let scale = product.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        for k in 0..=2 * n {
            let difference = (up[k] - down[k]) / 2e-2;
            assert!(
                (difference - product[k]).abs() < 1e-6 * scale,
                "row {k}: difference {difference:e}, product {:e}, scale {scale:e}",
                product[k]
            );
        }
    }
}
