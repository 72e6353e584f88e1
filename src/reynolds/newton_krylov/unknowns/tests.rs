//! Products of the linear system against differences of its equations.

use super::*;
use crate::elastic::{DeformationModel, HalfSpace, StripHalfSpace};
use crate::lubricant::{DowsonHigginson, Lubricant, Rheology, Roelands, ThermalRoelands};
use crate::reynolds::coupled::Changed;
use crate::reynolds::inner_nodes::interior;
use crate::reynolds::{Cavitation, FaceMobility, Scheme, ShearThinning};

const N: usize = 12;

fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

/// A state with nodes of every kind, films and pressures of the size of a real contact.
fn mixed_state(grid: &Grid, coupled: &mut Coupled, seed: &mut u64) -> ContactState {
    let mut state = ContactState::new(grid);
    for k in interior(grid) {
        let side = match k % 5 {
            0 => NodeState { fluid: Fluid::Active, solid: Solid::Contact },
            1 => NodeState { fluid: Fluid::Cavitated, solid: Solid::Open },
            2 if k % 2 == 0 => NodeState { fluid: Fluid::AtLimit, solid: Solid::Open },
            3 if k % 3 == 0 => NodeState { fluid: Fluid::Active, solid: Solid::Yielded },
            _ => NodeState { fluid: Fluid::Active, solid: Solid::Open },
        };
        coupled.active_set[k] = side;
        let fluid = 1e8 + 2e8 * noise(seed);
        state.fluid_pressure[k] = if side.fluid == Fluid::Cavitated { 0.0 } else { fluid };
        state.pressure[k] = state.fluid_pressure[k] + if side.is_contact() { 1e9 } else { 0.0 };
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
                check_product(plane(), scheme, face_mobility, Cavitation::Reynolds, (None, false), spin);
                check_product(
                    plane(),
                    scheme,
                    face_mobility,
                    Cavitation::MassConserving,
                    (None, false),
                    spin,
                );
            }
            for cavitation in [Cavitation::Reynolds, Cavitation::MassConserving] {
                check_product(strip(), scheme, face_mobility, cavitation, (None, false), None);
            }
            check_product(plane(), scheme, face_mobility, Cavitation::MassConserving, (None, true), None);
            let laws = [Rheology::eyring(1e5), Rheology::eyring(1e7), Rheology::carreau(1e6, 0.5)];
            for law in laws {
                let thinning = ShearThinning::new(law.unwrap(), 0.1).unwrap();
                for is_warm in [false, true] {
                    let viscosity = (Some(thinning), is_warm);
                    check_product(plane(), scheme, face_mobility, Cavitation::Reynolds, viscosity, None);
                    let viscosity = (Some(thinning.directional()), is_warm);
                    check_product(plane(), scheme, face_mobility, Cavitation::Reynolds, viscosity, None);
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

/// The functions of all rows, at `t` times the step `x` from a state.
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
        let (k, side) = (k as usize, coupled.active_set[k as usize]);
        let change = step(i) * unknowns.pressure_unit;
        match (side.fluid, side.solid) {
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
    coupled.displace(problem, &state).unwrap();
    for (k, side) in coupled.active_set.iter().enumerate() {
        // To the flow, contact keeps its film whatever the elastic one does.
        state.film[k] = if side.is_contact() { 30e-9 } else { coupled.elastic_film[k] + depth[k] };
    }
    coupled.evaluate(problem, &mut state, Changed::Film).unwrap();
    let balances = unknowns.balanced.iter().map(|&k| coupled.balance[k as usize]);
    let gaps = unknowns.contact.iter().map(|&k| coupled.elastic_film[k as usize]);
    let load = state.pressure.iter().sum::<f64>() * grid.cell_area() / problem.load;
    balances.chain(gaps).map(|film| film / unknowns.film_unit).chain([load]).collect()
}

fn plane() -> Grid {
    Grid::centred(N, N, 4e-6, 4e-6).unwrap()
}

fn strip() -> Grid {
    let edges = [0.0, 4e-6 * N as f64];
    Grid::strip(N, N, edges, edges).unwrap()
}

fn check_product(
    grid: Grid,
    scheme: Scheme,
    face_mobility: FaceMobility,
    cavitation: Cavitation,
    (shear_thinning, is_warm): (Option<ShearThinning>, bool),
    spin_radius: Option<f64>,
) {
    let mut body: Box<dyn DeformationModel> = if grid.is_strip() {
        Box::new(StripHalfSpace::new(grid, 230e9, 1e-2).unwrap())
    } else {
        Box::new(HalfSpace::new(grid, 230e9).unwrap())
    };
    let oil = oil(&grid, is_warm);
    let (mut seed, mut displaced, mut coupled) = (7, vec![0.0; grid.len()], Coupled::new(grid));
    let base = mixed_state(&grid, &mut coupled, &mut seed);
    body.displacement(&base.pressure, &mut displaced).unwrap();
    let gap: Vec<f64> = displaced.iter().map(|u| 20e-9 + 100e-9 * noise(&mut seed) - u).collect();
    let mut problem = LubricatedContact::new(&gap, &mut *body, 1.0, (1e-5, 1e-5), 1e9)
        .with_lubricant(Some(&oil))
        .with_entrainment_speed(0.1)
        .with_film_cutoff(1e-9)
        .with_scheme(scheme)
        .with_face_mobility(face_mobility)
        .with_cavitation(cavitation)
        .with_shear_thinning(shear_thinning)
        .with_spin_radius(spin_radius);
    let active_set = coupled.active_set.clone();
    coupled.configure(&problem);
    coupled.active_set = active_set;
    let mut unknowns = Unknowns::new(grid);
    unknowns.partition(&coupled, &problem, &base);
    unknowns.set_row_sizes(|_| 1.0);
    let changes = (1..unknowns.len()).map(|_| (1e-3 * (noise(&mut seed) - 0.5)) as f32);
    let x: Vec<f32> = changes.chain([5e-3]).collect();
    // The last evaluation is that of the state itself, which is linearized.
    let [up, down, _] =
        [0.1, -0.1, 0.0].map(|t| rows_at(t, &x, &unknowns, &base, &mut coupled, &mut problem));
    let mut linearization = Linearization::new(grid);
    linearization.update(&coupled.fluid, coupled.near.own);
    let mut product = vec![0.0; x.len()];
    let mut at =
        Linearized { coupled: &mut coupled, problem: &mut problem, linearization: &mut linearization };
    unknowns.product(&mut at, &x, Response::Padded, &mut product).unwrap();
    let scale = product[..x.len() - 1].iter().fold(0.0_f32, |m, v| m.max(v.abs()));
    for (row, (up, down)) in up.iter().zip(&down).enumerate() {
        let scale = if row == x.len() - 1 { 1.0 } else { f64::from(scale) };
        let difference = (up - down) / 0.2;
        assert!(
            (difference - f64::from(product[row])).abs() < 2e-6 * scale,
            "{grid:?}, {scheme:?}, {face_mobility:?}, {cavitation:?}, row {row} of {}: difference {difference:e}, product {:e}, scale {scale:e}",
            x.len(),
            product[row]
        );
    }
}
