//! Manufactured solutions: film and pressures are given, and sources in the mass balance and in the gap make them the
//! exact solution of a full film and of a mixed contact. Errors decrease at the order of the discretization.

use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    ContactSolver, ContactState, FaceMobility, LubricatedContact, NewtonKrylov, Scheme, Squeeze, StoppingRule,
};
use stribeck::{Grid, Status};

/// Half of the box \[m\].
const LENGTH: f64 = 1e-4;
const MODULUS: f64 = 226e9;
/// Largest fluid pressure \[Pa\].
const PEAK: f64 = 2e8;
/// Largest solid pressure of the mixed contact \[Pa\].
const SOLID_PEAK: f64 = 1e8;

/// Exact fields as functions of the position in units of `LENGTH`, and the conditions under which they hold.
struct Exact {
    film: fn(f64, f64) -> f64,
    solid: fn(f64, f64) -> f64,
    film_cutoff: f64,
    speed: f64,
}

const FULL_FILM: Exact = Exact {
    film: |x, y| 1e-6 * (1.0 + 0.3 * (2.0 * x).sin() + 0.2 * y * y),
    solid: |_, _| 0.0,
    film_cutoff: 1e-9,
    // Entrainment of the magnitude of pressure flow.
    speed: 20.0,
};

const MIXED: Exact = Exact {
    film: |x, y| {
        let outside = (-inside(x, y)).max(0.0);
        4e-7 + 1e-7 * outside * outside / (1.0 + outside)
    },
    solid: |x, y| SOLID_PEAK * inside(x, y).max(0.0),
    film_cutoff: 4e-7,
    speed: 2.0,
};

/// Positive on the disc on which the solids of the mixed contact touch, one at its center, zero at its edge.
fn inside(x: f64, y: f64) -> f64 {
    let radius = 0.45;
    1.0 - ((x - 0.1).powi(2) + y * y) / (radius * radius)
}

/// Fluid pressure \[Pa\], zero at the edge of the box.
fn fluid_pressure(x: f64, y: f64) -> f64 {
    PEAK * (1.0 - x * x) * (1.0 - y * y)
}

/// Root-mean-square errors of film, fluid pressure and solid pressure on the inner nodes, relative to the largest
/// exact values, and the share of the nodes at which solids touch.
struct Errors {
    film: f64,
    fluid: f64,
    solid: f64,
    touching: f64,
}

impl Exact {
    fn film_at(&self, (x, y): (f64, f64)) -> f64 {
        (self.film)(x / LENGTH, y / LENGTH)
    }

    fn solid_at(&self, (x, y): (f64, f64)) -> f64 {
        (self.solid)(x / LENGTH, y / LENGTH)
    }

    /// Mass at the previous time with which the mass balance holds: its source, by differences of the exact functions
    /// over lengths far below the cells.
    fn previous_mass(&self, oil: &Lubricant, time_step: f64, (x, y): (f64, f64)) -> f64 {
        let tiny = 1e-4 * LENGTH;
        let mass = |x: f64, y: f64| oil.at(fluid_at((x, y))).density * self.film_at((x, y));
        let flow = |x: f64, y: f64, along: [f64; 2]| {
            let at = |sign: f64| fluid_at((x + sign * tiny * along[0], y + sign * tiny * along[1]));
            let viscosity = oil.viscosity().viscosity(fluid_at((x, y)));
            let mobility = mass(x, y) * self.film_at((x, y)).powi(2) / (12.0 * viscosity);
            mobility * (at(1.0) - at(-1.0)) / (2.0 * tiny)
        };
        let outflow = self.speed * (mass(x + tiny, y) - mass(x - tiny, y))
            - (flow(x + tiny, y, [1.0, 0.0]) - flow(x - tiny, y, [1.0, 0.0]))
            - (flow(x, y + tiny, [0.0, 1.0]) - flow(x, y - tiny, [0.0, 1.0]));
        mass(x, y) + time_step * outflow / (2.0 * tiny)
    }

    /// Elastic displacement of the exact pressures at the nodes of `grid` \[m\], on a grid of a third of its spacing.
    fn displacement(&self, grid: &Grid) -> Vec<f64> {
        let (nx, ny) = (grid.nx(), grid.ny());
        let fine = Grid::centred(3 * nx, 3 * ny, grid.dx() / 3.0, grid.dy() / 3.0).unwrap();
        let pressure: Vec<f64> = fine.nodes().map(|at| fluid_at(at).max(0.0) + self.solid_at(at)).collect();
        let mut displacement = vec![0.0; fine.len()];
        HalfSpace::new(fine, MODULUS).unwrap().displacement(&pressure, &mut displacement).unwrap();
        (0..grid.len()).map(|k| displacement[(3 * (k / nx) + 1) * 3 * nx + 3 * (k % nx) + 1]).collect()
    }

    /// Errors of the solution on `n` by `n` nodes.
    fn errors(&self, n: usize, scheme: Scheme, face_mobility: FaceMobility) -> Errors {
        let step = 2.0 * LENGTH / n as f64;
        let grid = Grid::centred(n, n, step, step).unwrap();
        let oil = Lubricant::new(
            Roelands::from_alpha(0.01, 1e-8, 0.6, 1.96e8).unwrap(),
            DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
        );
        let nodes: Vec<(f64, f64)> = grid.nodes().collect();
        let time_step = LENGTH / self.speed;
        let previous_mass: Vec<f64> =
            nodes.iter().map(|&at| self.previous_mass(&oil, time_step, at)).collect();
        let gap: Vec<f64> =
            nodes.iter().zip(self.displacement(&grid)).map(|(&at, u)| self.film_at(at) - u).collect();
        let mut state = ContactState::new(&grid);
        for (k, &at) in nodes.iter().enumerate() {
            state.fluid_pressure[k] = fluid_at(at).max(0.0);
            state.pressure[k] = state.fluid_pressure[k] + self.solid_at(at);
        }
        let load = state.pressure.iter().sum::<f64>() * grid.cell_area();
        let mut body = HalfSpace::new(grid, MODULUS).unwrap();
        let mut problem = LubricatedContact::new(&gap, &mut body, load, (LENGTH, LENGTH), PEAK)
            .with_lubricant(Some(&oil))
            .with_entrainment_speed(self.speed)
            .with_squeeze(Some(Squeeze { previous_mass: &previous_mass, time_step }))
            .with_film_cutoff(self.film_cutoff)
            .with_scheme(scheme)
            .with_face_mobility(face_mobility)
            .with_reference_film(1e-6);
        let stop = StoppingRule::new(1e-9, 50);
        let report = NewtonKrylov::new().solve(&mut problem, &mut state, &stop).unwrap();
        assert_eq!(report.status, Status::Converged, "{n} nodes: {report:?}");
        let inner = |k: usize| (1..n - 1).contains(&(k % n)) && (1..n - 1).contains(&(k / n));
        let rms = |scale: f64, error: &dyn Fn(usize) -> f64| {
            let sum: f64 = (0..grid.len()).filter(|k| inner(*k)).map(|k| error(k).powi(2)).sum();
            (sum / ((n - 2) * (n - 2)) as f64).sqrt() / scale
        };
        let fluid = |k: usize| state.fluid_pressure[k] - fluid_at(nodes[k]);
        let solid = |k: usize| state.pressure[k] - state.fluid_pressure[k] - self.solid_at(nodes[k]);
        Errors {
            film: rms(1e-6, &|k| state.film[k] - self.film_at(nodes[k])),
            fluid: rms(PEAK, &fluid),
            solid: rms(SOLID_PEAK, &solid),
            touching: state.in_contact.iter().filter(|touches| **touches).count() as f64 / grid.len() as f64,
        }
    }
}

/// Exact fluid pressure at a position \[m\].
fn fluid_at((x, y): (f64, f64)) -> f64 {
    fluid_pressure(x / LENGTH, y / LENGTH)
}

#[test]
fn full_films_converge_at_the_order_of_the_scheme() {
    for face_mobility in
        [FaceMobility::Arithmetic, FaceMobility::ReducedPressure, FaceMobility::Wedge, FaceMobility::Inlet]
    {
        for (scheme, least, most) in
            [(Scheme::FirstOrder, 0.85, 1.5), (Scheme::SecondOrder, 1.8, 2.3), (Scheme::Limited, 1.8, 2.3)]
        {
            let [coarse, fine] = [64, 128].map(|n| FULL_FILM.errors(n, scheme, face_mobility));
            assert!(fine.touching <= 0.0, "a full film");
            let order = (coarse.fluid / fine.fluid).log2();
            assert!(
                order > least && order < most,
                "{scheme:?}, {face_mobility:?}: order {order}, {:e} and {:e}",
                coarse.fluid,
                fine.fluid
            );
        }
    }
}

/// Kinks of film and solid pressure are at the edge of the contact.
#[test]
fn mixed_contacts_converge_at_second_order() {
    for face_mobility in [FaceMobility::Wedge, FaceMobility::Inlet] {
        let [coarse, fine] = [64, 128].map(|n| MIXED.errors(n, Scheme::Limited, face_mobility));
        for (field, coarse, fine) in [
            ("film", coarse.film, fine.film),
            ("fluid pressure", coarse.fluid, fine.fluid),
            ("solid pressure", coarse.solid, fine.solid),
        ] {
            let order = (coarse / fine).log2();
            assert!(
                order > 1.8 && order < 2.2,
                "{face_mobility:?}: order {order} of {field}, {coarse:e} and {fine:e}"
            );
        }
        // The disc has 0.159 of the area of the box.
        assert!((fine.touching / 0.159 - 1.0).abs() < 0.05, "{}", fine.touching);
    }
}
