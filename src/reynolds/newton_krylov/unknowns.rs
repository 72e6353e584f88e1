//! The unknowns of a Newton step and the linearised equations.
//!
//! A vector holds the unknowns alone, one after the other:
//!
//! | nodes | unknown | its row |
//! |---|---|---|
//! | open fluid | pressure | mass balance |
//! | fluid at the limit | plastic depth | mass balance |
//! | contact with fluid pressure, yielded or not | fluid pressure | mass balance |
//! | contact that has not yielded | total pressure | gap, which the flow takes as closed |
//! | | approach | load balance |
//!
//! Pressures count in reference pressures, films in deflections of a node under the reference pressure alone;
//! so all numbers are near one, and single precision will do: a Newton step is solved to some tenths, on a row
//! to the rounding of its numbers.

use super::linearisation::Linearisation;
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::active_set::{Fluid, Kind, Solid};
use crate::reynolds::coupled::{Coupled, UNPADDED};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// How well elastic responses are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Response {
    /// To single precision.
    Whole,
    /// To some per cent at large distances, at a quarter of the cost.
    Periodic,
}

/// The contact that is linearised at a state, and its mass balances.
pub(super) struct Linearised<'a, 'b> {
    pub(super) coupled: &'a mut Coupled,
    pub(super) problem: &'a mut LubricatedContact<'b>,
    pub(super) linearisation: &'a mut Linearisation,
}

/// Which nodes have which unknowns, and the changes of all nodes under a vector of them.
#[derive(Debug)]
pub(super) struct Unknowns {
    /// Nodes with a mass balance: open fluid, fluid at the limit, contact.
    balanced: Vec<u32>,
    /// Where the second and the third of these begin.
    limited_from: usize,
    contact_from: usize,
    /// Nodes in contact that have not yielded, and those that have.
    contact: Vec<u32>,
    yielded: Vec<u32>,
    /// Changes of total and fluid pressure that the sides of nodes prescribe \[Pa\].
    pinned: Vec<(u32, [f64; 2])>,
    /// One over the sizes of the mass balances.
    weights: Vec<f32>,
    /// The reference pressure \[Pa\] and the deflection of a node under it \[m\].
    pressure_unit: f64,
    film_unit: f64,
    /// Load of the reference pressure in one cell over the load; zero where the approach is held.
    cell_load: f64,
    /// Changes of total pressure \[Pa\] and of the film without plastic depth \[m\].
    pressure: Vec<f64>,
    elastic: Vec<f64>,
    /// Changes of fluid pressure, film and balance.
    fluid: Vec<f32>,
    film: Vec<f32>,
    balance: Vec<f32>,
}

/// Changes of one node in a linear step \[Pa, m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeChange {
    pub(super) pressure: f64,
    pub(super) fluid_pressure: f64,
    pub(super) film: f64,
    pub(super) elastic_film: f64,
    pub(super) balance: f64,
}

impl Unknowns {
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        let nodes = || Vec::with_capacity(n);
        Self {
            balanced: nodes(),
            limited_from: 0,
            contact_from: 0,
            contact: nodes(),
            yielded: nodes(),
            pinned: Vec::with_capacity(n),
            weights: Vec::with_capacity(n),
            pressure_unit: 1.0,
            film_unit: 1.0,
            cell_load: 0.0,
            pressure: vec![0.0; n],
            elastic: vec![0.0; n],
            fluid: vec![0.0; n],
            film: vec![0.0; n],
            balance: vec![0.0; n],
        }
    }

    /// Most unknowns that a grid can have.
    pub(super) fn most(grid: &Grid) -> usize {
        2 * grid.len() + 1
    }

    /// Number of unknowns.
    pub(super) fn len(&self) -> usize {
        self.balanced.len() + self.contact.len() + 1
    }

    /// Open nodes whose fluid pressure is unknown, the first unknowns.
    pub(super) fn open(&self) -> &[u32] {
        &self.balanced[..self.limited_from]
    }

    /// All nodes with a mass balance.
    pub(super) fn balanced(&self) -> &[u32] {
        &self.balanced
    }

    /// One over the size of the row of a mass balance.
    pub(super) fn weight(&self, row: usize) -> f32 {
        self.weights[row]
    }

    /// Nodes in contact that have not yielded.
    pub(super) fn contact(&self) -> &[u32] {
        &self.contact
    }

    /// Sorts the nodes by their sides.
    pub(super) fn sort(&mut self, coupled: &Coupled, problem: &LubricatedContact<'_>, state: &ContactState) {
        self.pressure_unit = problem.reference_pressure;
        self.film_unit = coupled.near.own * problem.reference_pressure;
        let area = coupled.fluid.grid.cell_area();
        self.cell_load = problem.box_load().map_or(0.0, |load| area * problem.reference_pressure / load);
        self.balanced.clear();
        push_all(&mut self.balanced, &coupled.kinds, Kind::is_open_fluid);
        self.limited_from = self.balanced.len();
        push_all(&mut self.balanced, &coupled.kinds, |kind| kind.fluid == Fluid::AtLimit);
        self.contact_from = self.balanced.len();
        push_all(&mut self.balanced, &coupled.kinds, |kind| kind.has_fluid_pressure() && kind.is_contact());
        self.contact.clear();
        push_all(&mut self.contact, &coupled.kinds, |kind| kind.solid == Solid::Contact);
        self.yielded.clear();
        push_all(&mut self.yielded, &coupled.kinds, |kind| kind.solid == Solid::Yielded);
        self.pinned.clear();
        for (k, kind) in coupled.kinds.iter().enumerate() {
            let (total, fluid) = (state.pressure[k], state.fluid_pressure[k]);
            let drop = if kind.has_balance() { 0.0 } else { -fluid };
            let pinned = match kind.solid {
                Solid::Open => [if kind.has_balance() { 0.0 } else { -total }, drop],
                Solid::Contact => [0.0, drop],
                Solid::Yielded => [problem.limit_at(k) - total, drop],
            };
            if pinned.iter().any(|change| change.abs() > 0.0) {
                self.pinned.push((k as u32, pinned));
            }
        }
    }

    /// Takes the size of the rows of the mass balances, by node.
    pub(super) fn set_row_sizes(&mut self, size: impl Fn(usize) -> f32) {
        self.weights.clear();
        self.weights.extend(self.balanced.iter().map(|&k| 1.0 / size(k as usize)));
    }

    /// Changes of all nodes under those that their sides prescribe and those of the vector `x`.
    pub(super) fn change(
        &mut self,
        at: &mut Linearised<'_, '_>,
        x: &[f32],
        response: Response,
    ) -> Result<(), InputError> {
        self.place(x);
        for (k, [total, fluid]) in &self.pinned {
            self.pressure[*k as usize] = *total;
            if *fluid != 0.0 {
                self.fluid[*k as usize] = (fluid / self.pressure_unit) as f32;
            }
        }
        self.respond(at, x, response)
    }

    /// The same where sides prescribe no change, from the `films` of each direction that the vector `x` is made
    /// of (see [`Unknowns::copy_films`]) and its share in it; no convolution.
    pub(super) fn change_by<'f>(
        &mut self,
        linearisation: &mut Linearisation,
        x: &[f32],
        films: impl Iterator<Item = (f64, &'f [f32])>,
    ) {
        self.place(x);
        self.elastic.fill(0.0);
        for (share, films) in films {
            let share = share * self.film_unit;
            for (elastic, film) in self.elastic.iter_mut().zip(films) {
                *elastic += share * f64::from(*film);
            }
        }
        self.flow_under(linearisation, x);
    }

    /// Whether the sides of nodes prescribe changes.
    pub(super) fn are_pinned(&self) -> bool {
        !self.pinned.is_empty()
    }

    /// The changes of films without plastic depth under the last vector, in film units.
    pub(super) fn copy_films(&self, out: &mut [f32]) {
        for (film, elastic) in out.iter_mut().zip(&self.elastic) {
            *film = (elastic / self.film_unit) as f32;
        }
    }

    /// What the equations lack at `state` under the changes that the sides of nodes prescribe; one convolution,
    /// none where nothing changes.
    pub(super) fn residual(
        &mut self,
        at: &mut Linearised<'_, '_>,
        state: &ContactState,
        out: &mut [f32],
    ) -> Result<(), InputError> {
        if self.pinned.is_empty() {
            self.elastic.fill(0.0);
            self.balance.fill(0.0);
        } else {
            out.fill(0.0);
            self.change(at, out, Response::Whole)?;
        }
        let changes = self.pinned.iter().map(|(_, [change, _])| change).sum::<f64>();
        let carried = (state.pressure.iter().sum::<f64>() + changes) / self.pressure_unit * self.cell_load;
        let (balances, rest) = out.split_at_mut(self.balanced.len());
        for ((row, &k), weight) in balances.iter_mut().zip(&self.balanced).zip(&self.weights) {
            let present = (at.coupled.balance[k as usize] / self.film_unit) as f32;
            *row = -weight * (self.balance[k as usize] + present);
        }
        let contact_film = at.problem.contact_film();
        for (row, &k) in rest.iter_mut().zip(&self.contact) {
            let present = (at.coupled.elastic_film[k as usize] - contact_film) / self.film_unit;
            *row = -((self.elastic[k as usize] / self.film_unit + present) as f32);
        }
        rest[self.contact.len()] = if self.cell_load > 0.0 { (1.0 - carried) as f32 } else { 0.0 };
        Ok(())
    }

    /// Film changes under the pressure changes of all nodes and a change of the approach.
    fn deform(
        &mut self,
        at: &mut Linearised<'_, '_>,
        approach: f32,
        response: Response,
    ) -> Result<(), InputError> {
        match response {
            Response::Whole => {
                at.problem.deformation.displacement_single(&self.pressure, &mut self.elastic)?;
                at.coupled.convolutions += 1.0;
            }
            Response::Periodic => {
                at.problem.deformation.displacement_periodic(&self.pressure, &mut self.elastic)?;
                at.coupled.convolutions += UNPADDED;
            }
        }
        let approach = f64::from(approach) * self.film_unit;
        self.elastic.iter_mut().for_each(|elastic| *elastic -= approach);
        Ok(())
    }

    /// Puts the pressures of the vector `x` where they belong.
    fn place(&mut self, x: &[f32]) {
        self.pressure.fill(0.0);
        self.fluid.fill(0.0);
        let (fluid, rest) = x.split_at(self.balanced.len());
        for (i, (&k, &x)) in self.balanced.iter().zip(fluid).enumerate() {
            if i < self.limited_from {
                self.pressure[k as usize] = f64::from(x) * self.pressure_unit;
            }
            if i < self.limited_from || i >= self.contact_from {
                self.fluid[k as usize] = x;
            }
        }
        for (&k, &x) in self.contact.iter().zip(rest) {
            self.pressure[k as usize] = f64::from(x) * self.pressure_unit;
        }
    }

    /// Films and balances under the pressures as they are placed.
    fn respond(
        &mut self,
        at: &mut Linearised<'_, '_>,
        x: &[f32],
        response: Response,
    ) -> Result<(), InputError> {
        self.deform(at, x[self.len() - 1], response)?;
        self.flow_under(at.linearisation, x);
        Ok(())
    }

    /// Balances under the fluid pressures as they are placed, films without plastic depth as they are, and the
    /// plastic depths of the vector `x`.
    fn flow_under(&mut self, linearisation: &mut Linearisation, x: &[f32]) {
        let per_unit = 1.0 / self.film_unit;
        for (film, elastic) in self.film.iter_mut().zip(&self.elastic) {
            *film = (elastic * per_unit) as f32;
        }
        let limited = self.limited_from..self.contact_from;
        for (&k, x) in self.balanced[limited.clone()].iter().zip(&x[limited]) {
            self.film[k as usize] += x;
        }
        self.flow(linearisation);
    }

    /// Balances under the changes of fluid pressure and film as they are.
    fn flow(&mut self, linearisation: &mut Linearisation) {
        // The plastic depth keeps the film of yielded nodes, their own rows that of the others in contact.
        for &k in self.yielded.iter().chain(&self.contact) {
            self.film[k as usize] = 0.0;
        }
        linearisation.product(&self.fluid, &self.film, &mut self.balance);
    }

    /// `out = J x`.
    pub(super) fn product(
        &mut self,
        at: &mut Linearised<'_, '_>,
        x: &[f32],
        response: Response,
        out: &mut [f32],
    ) -> Result<(), InputError> {
        self.place(x);
        self.respond(at, x, response)?;
        self.rows(out);
        out[self.len() - 1] = self.load(x) as f32;
        Ok(())
    }

    /// The column of the approach, without the load balance; no convolution.
    pub(super) fn approach_column(&mut self, linearisation: &mut Linearisation, out: &mut [f32]) {
        self.fluid.fill(0.0);
        self.elastic.fill(-self.film_unit);
        self.film.fill(-1.0);
        self.flow(linearisation);
        self.rows(out);
        out[self.len() - 1] = 0.0;
    }

    fn rows(&self, out: &mut [f32]) {
        let (balances, gaps) = out.split_at_mut(self.balanced.len());
        for ((row, &k), weight) in balances.iter_mut().zip(&self.balanced).zip(&self.weights) {
            *row = weight * self.balance[k as usize];
        }
        for (row, &k) in gaps.iter_mut().zip(&self.contact) {
            *row = (self.elastic[k as usize] / self.film_unit) as f32;
        }
    }

    /// The load that the pressures of a vector carry, over the load.
    pub(super) fn load(&self, x: &[f32]) -> f64 {
        let (fluid, rest) = x.split_at(self.balanced.len());
        let pressures = fluid[..self.limited_from].iter().chain(&rest[..self.contact.len()]);
        pressures.map(|&p| f64::from(p)).sum::<f64>() * self.cell_load
    }

    /// Largest change of a total pressure in a vector \[Pa\].
    pub(super) fn largest_pressure(&self, x: &[f32]) -> f64 {
        let pressures = x[..self.limited_from].iter().chain(&x[self.balanced.len()..self.len() - 1]);
        f64::from(pressures.fold(0.0_f32, |largest, change| largest.max(change.abs()))) * self.pressure_unit
    }

    /// Change of the approach of a vector \[m\].
    pub(super) fn approach(&self, x: &[f32]) -> f64 {
        f64::from(x[self.len() - 1]) * self.film_unit
    }

    /// Changes of node `k` at the last [`Unknowns::change`].
    pub(super) fn node(&self, k: usize) -> NodeChange {
        NodeChange {
            pressure: self.pressure[k],
            fluid_pressure: f64::from(self.fluid[k]) * self.pressure_unit,
            film: f64::from(self.film[k]) * self.film_unit,
            elastic_film: self.elastic[k],
            balance: f64::from(self.balance[k]) * self.film_unit,
        }
    }
}

fn push_all(nodes: &mut Vec<u32>, kinds: &[Kind], wanted: impl Fn(Kind) -> bool) {
    nodes.extend(kinds.iter().enumerate().filter(|(_, kind)| wanted(**kind)).map(|(k, _)| k as u32));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::{DeformationModel, HalfSpace};
    use crate::lubricant::{DowsonHigginson, Lubricant, Rheology, Roelands, ThermalRoelands};
    use crate::reynolds::problem::interior;
    use crate::reynolds::{Cavitation, FaceMobility, Scheme, ShearThinning};

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
        for scheme in [Scheme::FirstOrder, Scheme::SecondOrder, Scheme::Limited] {
            for face_mobility in [
                FaceMobility::Arithmetic,
                FaceMobility::ReducedPressure,
                FaceMobility::Wedge,
                FaceMobility::Inlet,
            ] {
                for spin in [None, Some(35e-6), Some(-60e-6)] {
                    check_product(scheme, face_mobility, Cavitation::Reynolds, (None, false), spin);
                    check_product(scheme, face_mobility, Cavitation::MassConserving, (None, false), spin);
                }
                check_product(scheme, face_mobility, Cavitation::MassConserving, (None, true), None);
                let laws = [Rheology::eyring(1e5), Rheology::eyring(1e7), Rheology::carreau(1e6, 0.5)];
                for law in laws {
                    let thinning = ShearThinning::new(law.unwrap(), 0.1).unwrap();
                    for is_warm in [false, true] {
                        let viscosity = (Some(thinning), is_warm);
                        check_product(scheme, face_mobility, Cavitation::Reynolds, viscosity, None);
                        let viscosity = (Some(thinning.directional()), is_warm);
                        check_product(scheme, face_mobility, Cavitation::Reynolds, viscosity, None);
                    }
                }
            }
        }
    }

    /// Oil, warm by another temperature in every film where `is_warm`.
    fn oil(grid: &Grid, is_warm: bool) -> Lubricant {
        let law = ThermalRoelands::new(Roelands::new(0.04, 0.6, 1.96e8).unwrap(), 313.15, 1.1).unwrap();
        let mut oil = Lubricant::new(law, DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap());
        if is_warm {
            let films: Vec<f64> = (0..grid.len()).map(|k| 340.0 + 25.0 * (k as f64).sin()).collect();
            oil.set_film_temperatures(313.15, &films, &films, 6.5e-4).unwrap();
        }
        oil
    }

    /// What all rows are of, at `t` times the step `x` from a state.
    fn rows_at(
        t: f64,
        x: &[f32],
        unknowns: &Unknowns,
        base: &ContactState,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
    ) -> Vec<f64> {
        let (mut state, grid) = (base.clone(), coupled.fluid.grid);
        let step = |i: usize| t * f64::from(x[i]);
        let mut depth = vec![0.0; grid.len()];
        for (i, &k) in unknowns.balanced.iter().enumerate() {
            let (k, kind) = (k as usize, coupled.kinds[k as usize]);
            let change = step(i) * unknowns.pressure_unit;
            match (kind.fluid, kind.solid) {
                (Fluid::AtLimit, _) => depth[k] = 10e-9 + step(i) * unknowns.film_unit,
                (_, Solid::Open) => {
                    (state.pressure[k], state.fluid_pressure[k]) =
                        (state.pressure[k] + change, state.fluid_pressure[k] + change);
                }
                _ => state.fluid_pressure[k] += change,
            }
        }
        for (i, &k) in unknowns.contact.iter().enumerate() {
            state.pressure[k as usize] += step(unknowns.balanced.len() + i) * unknowns.pressure_unit;
        }
        state.approach = step(x.len() - 1) * unknowns.film_unit;
        coupled.deform(problem, &mut state).unwrap();
        for (k, kind) in coupled.kinds.iter().enumerate() {
            // To the flow, contact keeps its film whatever the elastic one does.
            state.film[k] = if kind.is_contact() { 30e-9 } else { coupled.elastic_film[k] + depth[k] };
        }
        coupled.refresh(problem, &mut state);
        let balances = unknowns.balanced.iter().map(|&k| coupled.balance[k as usize]);
        let gaps = unknowns.contact.iter().map(|&k| coupled.elastic_film[k as usize]);
        let load = state.pressure.iter().sum::<f64>() * grid.cell_area() / problem.load;
        balances.chain(gaps).map(|film| film / unknowns.film_unit).chain([load]).collect()
    }

    fn check_product(
        scheme: Scheme,
        face_mobility: FaceMobility,
        cavitation: Cavitation,
        (shear_thinning, is_warm): (Option<ShearThinning>, bool),
        spin_radius: Option<f64>,
    ) {
        let grid = Grid::centred(N, N, 4e-6, 4e-6).unwrap();
        let (mut body, oil) = (HalfSpace::new(grid, 230e9).unwrap(), oil(&grid, is_warm));
        let (mut seed, mut displaced, mut coupled) = (7, vec![0.0; grid.len()], Coupled::new(grid));
        let base = mixed_state(&grid, &mut coupled, &mut seed);
        body.displacement(&base.pressure, &mut displaced).unwrap();
        let gap: Vec<f64> = displaced.iter().map(|u| 20e-9 + 100e-9 * noise(&mut seed) - u).collect();
        let mut problem = LubricatedContact::new(&gap, &mut body, 1.0, (1e-5, 1e-5), 1e9)
            .with_lubricant(Some(&oil))
            .with_entrainment_speed(0.1)
            .with_film_cutoff(1e-9)
            .with_scheme(scheme)
            .with_face_mobility(face_mobility)
            .with_cavitation(cavitation)
            .with_shear_thinning(shear_thinning)
            .with_spin_radius(spin_radius);
        let kinds = coupled.kinds.clone();
        coupled.configure(&problem);
        coupled.kinds = kinds;
        let mut unknowns = Unknowns::new(grid);
        unknowns.sort(&coupled, &problem, &base);
        unknowns.set_row_sizes(|_| 1.0);
        let changes = (1..unknowns.len()).map(|_| (1e-3 * (noise(&mut seed) - 0.5)) as f32);
        let x: Vec<f32> = changes.chain([5e-3]).collect();
        // The last leaves the flow of the state itself, which is linearised.
        let [up, down, _] =
            [0.1, -0.1, 0.0].map(|t| rows_at(t, &x, &unknowns, &base, &mut coupled, &mut problem));
        let mut linearisation = Linearisation::new(grid);
        linearisation.update(&coupled.fluid, coupled.near.own);
        let mut product = vec![0.0; x.len()];
        let mut at =
            Linearised { coupled: &mut coupled, problem: &mut problem, linearisation: &mut linearisation };
        unknowns.product(&mut at, &x, Response::Whole, &mut product).unwrap();
        let scale = product[..x.len() - 1].iter().fold(0.0_f32, |m, v| m.max(v.abs()));
        for (row, (up, down)) in up.iter().zip(&down).enumerate() {
            let scale = if row == x.len() - 1 { 1.0 } else { f64::from(scale) };
            let difference = (up - down) / 0.2;
            assert!(
                (difference - f64::from(product[row])).abs() < 2e-6 * scale,
                "{scheme:?}, {face_mobility:?}, {cavitation:?}, row {row} of {}: difference {difference:e}, product {:e}, scale {scale:e}",
                x.len(),
                product[row]
            );
        }
    }
}
