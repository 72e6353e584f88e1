//! Solves, laws and simulation steps allocate nothing after their first call.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use stribeck::analytic::HertzPoint;
use stribeck::elastic::{DeformationModel, HalfSpace, ResponseApproximations};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Rheology, Roelands, ThermalRoelands};
use stribeck::reynolds::{
    ContactDefinition, ContactSolver, ContactState, Dry, FilmFlows, LubricatedContact, Multigrid,
    NewtonKrylov, Scheme, SemiSystem, ShearThinning, StoppingRule,
};
use stribeck::surface::{Autocorrelation, RoughnessSpec, generate};
use stribeck::thermal::{FilmFlow, FilmTemperature, FilmThermal};
use stribeck::tribochem::{FilmGrowthLaw, FlashTemperature, Ghanbarzadeh, ThermalBody, Tribofilm};
use stribeck::wear::{Archard, WearDepth};
use stribeck::{Grid, SolveReport, Status, SurfaceState};

thread_local! {
    // Per thread, as tests and harness run concurrently.
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

struct Counting;

#[expect(unsafe_code, reason = "there is no safe way to write a global allocator")]
// SAFETY: every call is handed to the system allocator as it is. Counting allocates nothing: the counter is
// initialised at compile time and needs no destructor.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller keeps the contract of `alloc`, which is that of the system allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: as in `alloc`.
        unsafe { System.realloc(pointer, layout, new_size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as in `alloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Result of `work` and its number of allocations.
fn counted<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = COUNT.get();
    let result = work();
    (result, COUNT.get() - before)
}

/// Even, odd, prime and oblong grids.
const SHAPES: [(usize, usize); 5] = [(16, 16), (15, 9), (17, 13), (31, 8), (64, 5)];

fn grids() -> impl Iterator<Item = Grid> {
    SHAPES.into_iter().map(|(nx, ny)| Grid::centred(nx, ny, 10e-6, 12e-6).unwrap())
}

fn touching() -> SurfaceState {
    SurfaceState::new(1e9, 353.15)
        .with_solid_pressure(1e9)
        .with_shear_stress(0.115e9)
        .with_sliding_speed(0.005)
        .with_in_contact(true)
}

#[test]
fn allocation_counter_counts() {
    assert_eq!(counted(|| vec![0_u8; 100]).1, 1);
    assert_eq!(counted(|| 1 + 1).1, 0);
}

#[test]
fn half_space_allocates_nothing() {
    for grid in grids() {
        let mut body = HalfSpace::new(grid, 230e9).unwrap();
        let pressure: Vec<f64> = grid.nodes().map(|(x, _)| 1e9 + 1e13 * x).collect();
        let mut out = vec![0.0; grid.len()];
        // No warm-up: the constructor allocates the buffers.
        let (result, allocations) = counted(|| body.displacement(&pressure, &mut out));
        assert!(result.is_ok() && allocations == 0, "displacement on {grid:?}: {allocations}");
        let (result, allocations) = counted(|| body.displacement_single(&pressure, &mut out));
        assert!(result.is_ok() && allocations == 0, "displacement estimate on {grid:?}: {allocations}");
        let (result, allocations) = counted(|| body.displacement_periodic(&pressure, &mut out));
        assert!(result.is_ok() && allocations == 0, "sketch on {grid:?}: {allocations}");
        let (result, allocations) = counted(|| body.pressure_estimate(&pressure, &mut out));
        assert!(result.is_ok() && allocations == 0, "estimate on {grid:?}: {allocations}");
    }
}

// ---- contact solvers ----

/// The residuals of the steps that a report of a lubricated solve holds.
const HISTORY: u64 = 1;

/// A rough ball whose Hertzian contact fills half of the box, limited to 3 GPa.
struct Scene {
    gap: Vec<f64>,
    limit: Vec<f64>,
    hertz: HertzPoint,
    body: HalfSpace,
}

impl Scene {
    fn new(nx: usize, ny: usize, rq: f64) -> Self {
        let hertz = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
        let half = 3.0 * hertz.half_width_x;
        let grid = Grid::from_edges(nx, ny, [-half, half], [-half, half]).unwrap();
        let spec = RoughnessSpec {
            autocorrelation: Autocorrelation::Gaussian,
            rq,
            length_x: 60e-6,
            length_y: 60e-6,
            seed: 3,
        };
        let rough = generate(&grid, &spec).unwrap();
        let ball = grid.nodes().map(|(x, y)| 0.5 * (x * x + y * y) / hertz.radius_x);
        Self {
            gap: ball.zip(rough).map(|(form, height)| form - height).collect(),
            limit: vec![3e9; grid.len()],
            hertz,
            body: HalfSpace::new(grid, 229.67e9).unwrap(),
        }
    }

    fn problem<'a>(&'a mut self, lubricant: Option<&'a Lubricant>) -> LubricatedContact<'a> {
        LubricatedContact::new(
            &self.gap,
            &mut self.body,
            self.hertz.force,
            (self.hertz.half_width_x, self.hertz.half_width_y),
            self.hertz.pressure,
        )
        .with_lubricant(lubricant)
        .with_entrainment_speed(0.5)
        .with_pressure_limit(Some(&self.limit))
        .with_scheme(Scheme::FirstOrder)
    }
}

/// Solves `problem` twice from zero pressure and once from its solution; returns the reports of the last two
/// and their allocations.
fn solve_again(
    solver: &mut dyn ContactSolver,
    problem: &mut LubricatedContact<'_>,
    stop: &StoppingRule,
) -> [(SolveReport, u64); 2] {
    let grid = problem.grid();
    let (mut first, mut second) = (ContactState::new(&grid), ContactState::new(&grid));
    let _ = solver.solve(problem, &mut first, stop).unwrap();
    let cold = counted(|| solver.solve(problem, &mut second, stop).unwrap());
    let warm = counted(|| solver.solve(problem, &mut second, stop).unwrap());
    [cold, warm]
}

#[test]
fn second_dry_solve_allocates_nothing() {
    // The last two use coarser grids.
    for (nx, ny) in SHAPES.into_iter().chain([(40, 36), (67, 33)]) {
        let mut scene = Scene::new(nx, ny, 100e-9);
        let stop = StoppingRule::new(1e-9, 500);
        for (report, allocations) in solve_again(&mut Dry::new(), &mut scene.problem(None), &stop) {
            assert_eq!(report.status, Status::Converged, "{report:?}");
            assert_eq!(allocations, 0, "{nx} x {ny}");
        }
    }
}

fn oil() -> Lubricant {
    let viscosity = Roelands::new(0.04, 0.6, 1.96e8).unwrap();
    Lubricant::new(viscosity, DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap())
}

#[test]
fn second_newton_krylov_solve_allocates_nothing() {
    let oil = oil();
    let eyring = ShearThinning::new(Rheology::eyring(5e6).unwrap(), 0.25).unwrap();
    for (nx, ny, thinning) in
        [(24, 24, None), (23, 19, None), (29, 32, None), (24, 24, Some(eyring)), (23, 19, Some(eyring))]
    {
        let mut scene = Scene::new(nx, ny, 50e-9);
        let stop = StoppingRule::default();
        let mut problem = scene.problem(Some(&oil));
        problem.shear_thinning = thinning;
        for (report, allocations) in solve_again(&mut NewtonKrylov::new(), &mut problem, &stop) {
            assert_eq!(report.status, Status::Converged, "{report:?}");
            assert_eq!(allocations, HISTORY, "{nx} x {ny}, {thinning:?}");
        }
    }
}

#[test]
fn second_semi_system_solve_allocates_nothing() {
    let oil = oil();
    // A full film, a mixed contact, and the unified Reynolds model, which need not converge in 50 sweeps.
    for (rq, contact) in [
        (0.0, ContactDefinition::Hard),
        (50e-9, ContactDefinition::Hard),
        (0.0, ContactDefinition::UnifiedReynolds),
    ] {
        for (nx, ny) in [(24, 24), (23, 19), (29, 32)] {
            let mut scene = Scene::new(nx, ny, rq);
            let is_paper = contact == ContactDefinition::UnifiedReynolds;
            let stop = StoppingRule::new(1e-6, if is_paper { 50 } else { 20_000 });
            let mut problem = scene.problem(Some(&oil));
            problem.contact = contact;
            for (report, allocations) in solve_again(&mut SemiSystem::default(), &mut problem, &stop) {
                assert!(is_paper || report.status == Status::Converged, "{report:?}");
                assert_eq!(allocations, HISTORY, "{nx} x {ny}, {contact:?}");
            }
        }
    }
}

#[test]
fn second_multigrid_solve_allocates_nothing() {
    let oil = oil();
    for (nx, ny) in [(48, 48), (51, 37)] {
        let mut scene = Scene::new(nx, ny, 0.0);
        let stop = StoppingRule::new(1e-6, 5);
        let mut problem = scene.problem(Some(&oil));
        problem.shear_thinning = Some(ShearThinning::new(Rheology::eyring(5e6).unwrap(), 0.25).unwrap());
        for (_, allocations) in solve_again(&mut Multigrid::new(), &mut problem, &stop) {
            assert_eq!(allocations, HISTORY, "{nx} x {ny}");
        }
    }
}

// ---- laws ----

/// Saturating growth through the default integration.
#[derive(Debug)]
struct Saturating;

impl FilmGrowthLaw for Saturating {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if at.in_contact { 1e-12 * (at.pressure - 1e16 * thickness) } else { 0.0 }
    }

    fn maximum_thickness(&self) -> f64 {
        100e-9
    }
}

#[test]
fn tribofilm_advance_allocates_nothing() {
    let laws: [&dyn FilmGrowthLaw; 2] = [&Ghanbarzadeh::azam_2019(), &Saturating];
    for law in laws {
        let mut film = Tribofilm::bare(law, 1000);
        let point = |node: usize| touching().with_in_contact(!node.is_multiple_of(3));
        let (result, allocations) = counted(|| film.advance(law, 60.0, point));
        assert!(result.is_ok() && allocations == 0, "{law:?}: {allocations}");
        assert!(film.volume(1e-12) > 0.0);
    }
}

#[test]
fn wear_depth_allocates_nothing() {
    let law = Archard::azam_2019();
    let mut wear = WearDepth::new(1000);
    let (result, allocations) =
        counted(|| wear.advance(&law, 60.0, |node| (touching(), node as f64 * 1e-10)));
    assert!(result.is_ok() && allocations == 0, "{allocations}");
}

#[test]
fn flash_temperature_allocates_nothing() {
    let cold_body = ThermalBody { conductivity: 20.0, ..ThermalBody::STEEL };
    for grid in grids() {
        let bodies = [ThermalBody::STEEL, cold_body];
        let mut flash = FlashTemperature::new(&grid, bodies, [1.0, -0.5]).unwrap();
        let heated = |(x, y): (f64, f64)| if x.hypot(y) < 60e-6 { 1e8 } else { 0.0 };
        let flux: Vec<f64> = grid.nodes().map(heated).collect();
        let mut rise = vec![0.0; grid.len()];
        let (report, allocations) = counted(|| flash.rise(&flux, &mut rise));
        let report = report.unwrap();
        assert!(report.maximum > 0.0 && report.iterations > 0, "{report:?}");
        assert_eq!(allocations, 0, "{grid:?}");
    }
}

#[test]
fn film_temperature_allocates_nothing() {
    let law = ThermalRoelands::new(Roelands::new(0.04, 0.6, 1.96e8).unwrap(), 313.15, 1.1).unwrap();
    let oil = Lubricant::new(law, DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap());
    for grid in grids() {
        let bodies = [ThermalBody::STEEL; 2];
        let properties = FilmThermal::default();
        let mut temperature = FilmTemperature::new(&grid, properties, bodies, [1.5, 0.5]).unwrap();
        let pressed = |(x, y): (f64, f64)| if x.hypot(y) < 60e-6 { 5e8 } else { 0.0 };
        let pressure: Vec<f64> = grid.nodes().map(pressed).collect();
        let (film, solid) = (vec![1e-7; grid.len()], vec![0.0; grid.len()]);
        let theta = vec![1.0; grid.len()];
        let mut flows = FilmFlows::default();
        flows.resize(grid.len());
        flows.through.fill(1e-7);
        let rheology = Rheology::eyring(5e6).unwrap();
        let flow = FilmFlow {
            lubricant: &oil,
            rheology: &rheology,
            pressure: &pressure,
            film: &film,
            theta: &theta,
            flows: &flows,
            boundary_heat: &solid,
            speeds: (1.0, 1.0),
            bulk_temperature: 313.15,
        };
        let (balance, allocations) = counted(|| temperature.update(&flow));
        let balance = balance.unwrap();
        assert!(balance.is_converged() && balance.generated > 0.0, "{balance:?}");
        assert_eq!(allocations, 0, "{grid:?}");
    }
}

#[test]
fn step_of_the_simulation_allocates_nothing() {
    let scene = stribeck::sim::Scene::azam_2019(32);
    let mut sim = stribeck::sim::MixedLubricationSim::builder(scene).build().unwrap();
    for _ in 0..30 {
        let _ = sim.step(10.0).unwrap();
    }
    let mut counts = Vec::new();
    for _ in 0..10 {
        let (record, allocations) = counted(|| sim.step(10.0).unwrap());
        assert_eq!(record.report.status, Status::Converged);
        counts.push(allocations);
    }
    assert_eq!(counts, [HISTORY; 10], "allocations in each step");
}

/// Roughness between nodes, steps by depth, a film, hardening and heat.
#[test]
fn step_with_all_processes_allocates_nothing() {
    use stribeck::sim::scene::{Flash, SolverKind};
    let mut scene = stribeck::sim::Scene::azam_2019(32).with_tribofilm();
    scene.solver.kind = SolverKind::Dry;
    scene.thermal.flash = Flash::On;
    if let Some(plastic) = &mut scene.plastic {
        (plastic.hardness, plastic.hardening_modulus) = (3e9, Some(1e16));
    }
    let builder = stribeck::sim::MixedLubricationSim::builder(scene);
    let mut sim = builder.motion(stribeck::surface::Advected).build().unwrap();
    let control = stribeck::sim::StepControl::new(7.0001, 1e-9);
    for _ in 0..10 {
        let _ = sim.step_within(&control).unwrap();
    }
    for _ in 0..5 {
        let (record, allocations) = counted(|| sim.step_within(&control).unwrap());
        assert_eq!((record.report.status, allocations), (Status::Converged, 0));
    }
}
