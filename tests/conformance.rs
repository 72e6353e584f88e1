//! Every law, model and solver of the crate keeps the contract of its trait, and the checks find those who do
//! not.

use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::lubricant::{Barus, DensityLaw, DowsonHigginson, Incompressible, Roelands, ViscosityLaw};
use stribeck::plastic::{ElasticPerfectlyPlastic, IsotropicHardening, PlasticityModel};
use stribeck::reynolds::{Auto, Dry, Multigrid, NewtonKrylov, SemiSystem};
use stribeck::surface::{Advected, AlongTrack, Fixed, Offset, PointRevisit, RandomShift, RoughnessMotion};
use stribeck::testing::{
    boundary_friction, contact_solver, deformation_model, density_law, film_growth_law, plasticity_model,
    roughness_motion, viscosity_law, wear_law,
};
use stribeck::tribochem::{
    Activation, ELECTRON_VOLT, FilmGrowthLaw, Ghanbarzadeh, ProportionalRemoval, StressActivated,
    ThermalArrhenius,
};
use stribeck::wear::{Archard, FrictionalEnergy, WearLaw, WearPressure};
use stribeck::{BoundaryFriction, ConstantFriction, FilmFriction, Grid, InputError, SurfaceState};

#[test]
fn growth_laws_satisfy_the_contract() {
    let energy = 0.8 * ELECTRON_VOLT;
    let thermal = ThermalArrhenius::new(200e-9, 1.0, energy).unwrap().calibrated(1.2215e-3, 353.15).unwrap();
    let shear = StressActivated::by_shear_stress(200e-9, 1.0, energy, 0.13e-27).unwrap();
    let shear = shear.calibrated(1.2215e-3, 1.3e8, 353.15).unwrap();
    let normal = StressActivated::by_normal_stress(150e-9, 1.0, energy, 3.8e-30).unwrap();
    let normal = normal.calibrated(1.2215e-3, 6e9, 353.15).unwrap();
    let removal = ProportionalRemoval::new(200e-9, 50.0, energy, 0.09e-27, 1e-3).unwrap();
    let steady = ProportionalRemoval::new(200e-9, 1e-10, 0.0, 0.0, 0.0).unwrap();
    for activation in [Activation::SolidContact, Activation::Pressure, Activation::ShearStress] {
        film_growth_law(&Ghanbarzadeh::azam_2019().with_activation(activation)).unwrap();
        film_growth_law(&thermal.clone().with_activation(activation)).unwrap();
        film_growth_law(&shear.clone().with_activation(activation)).unwrap();
        film_growth_law(&normal.clone().with_activation(activation)).unwrap();
        film_growth_law(&removal.clone().with_activation(activation)).unwrap();
        film_growth_law(&steady.clone().with_activation(activation)).unwrap();
    }
}

/// Three rates for the default integration: smooth, stiff, and with a kink.
#[derive(Debug)]
struct Quadratic;

impl FilmGrowthLaw for Quadratic {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        let left = 1.0 - thickness / 100e-9;
        if at.in_contact { 1e-10 * left * left } else { 0.0 }
    }
    fn maximum_thickness(&self) -> f64 {
        100e-9
    }
}

#[derive(Debug)]
struct Kinked;

impl FilmGrowthLaw for Kinked {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if at.in_contact {
            1e-2 * (70e-9 - thickness).max(0.0) - 1e-3 * (thickness - 50e-9).max(0.0)
        } else {
            0.0
        }
    }
    fn maximum_thickness(&self) -> f64 {
        100e-9
    }
}

#[test]
fn laws_of_a_rate_alone_satisfy_the_contract() {
    film_growth_law(&Quadratic).unwrap();
    film_growth_law(&Kinked).unwrap();
}

/// A NaN state behind a finite thickness.
#[derive(Debug)]
struct Hidden;

impl FilmGrowthLaw for Hidden {
    fn rate(&self, _: &SurfaceState, _: f64) -> f64 {
        0.0
    }
    fn maximum_thickness(&self) -> f64 {
        100e-9
    }
    fn thickness(&self, states: &[f64]) -> f64 {
        states[0].max(0.0)
    }
    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        if at.in_contact && states[0] == 0.0 && time_step > 0.0 {
            states[0] = f64::NAN;
        }
    }
}

#[test]
fn nan_states_behind_a_finite_thickness_are_detected() {
    assert_eq!(film_growth_law(&Hidden).unwrap_err().clause, "states are finite");
    let mut scene = stribeck::sim::Scene::azam_2019(16);
    // Slow enough for solid contact.
    scene.motion.entrainment_speed = 1e-3;
    let mut sim = stribeck::sim::MixedLubricationSim::builder(scene).growth_law(Hidden).build().unwrap();
    let error = sim.step(10.0).unwrap_err().to_string();
    assert!(error.contains("tribofilm.states"), "{error}");
}

#[test]
fn wear_laws_satisfy_the_contract() {
    wear_law(&Archard::azam_2019()).unwrap();
    wear_law(&Archard::azam_2019().with_pressure(WearPressure::Solid)).unwrap();
    wear_law(&Archard::azam_2019().with_film_hardness(2e9).unwrap()).unwrap();
    wear_law(&FrictionalEnergy::new(7.9e-17, 7.9e-18, 200e-9).unwrap()).unwrap();
}

#[test]
fn fluid_laws_satisfy_the_contract() {
    viscosity_law(&Roelands::new(0.004, 0.68, 1.96e8).unwrap()).unwrap();
    viscosity_law(&Roelands::from_alpha(0.004, 14.94e-9, 0.68, 1.96e8).unwrap()).unwrap();
    viscosity_law(&Barus::new(0.04, 20e-9).unwrap()).unwrap();
    density_law(&DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap()).unwrap();
    density_law(&Incompressible).unwrap();
}

#[test]
fn plasticity_models_satisfy_the_contract() {
    plasticity_model(&ElasticPerfectlyPlastic::azam_2019()).unwrap();
    plasticity_model(&ElasticPerfectlyPlastic::uniform(2e9).unwrap()).unwrap();
    plasticity_model(&IsotropicHardening::new(ElasticPerfectlyPlastic::azam_2019(), 1e16).unwrap()).unwrap();
}

#[test]
fn deformation_models_satisfy_the_contract() {
    for (nx, ny) in [(8, 8), (7, 13), (16, 9)] {
        let grid = Grid::centred(nx, ny, 1e-6, 1.5e-6).unwrap();
        deformation_model(&mut HalfSpace::new(grid, 230e9).unwrap()).unwrap();
    }
}

/// Independent springs: a node deflects under its own pressure alone.
#[derive(Debug)]
struct Winkler {
    grid: Grid,
    compliance: f64,
}

impl DeformationModel for Winkler {
    fn grid(&self) -> Grid {
        self.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        for (field, found) in [("pressure", pressure.len()), ("out", out.len())] {
            if found != self.grid.len() {
                return Err(InputError::Shape { field: field.to_owned(), expected: self.grid.len(), found });
            }
        }
        out.iter_mut().zip(pressure).for_each(|(u, p)| *u = self.compliance * p);
        Ok(())
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        if (di, dj) == (0, 0) { self.compliance } else { 0.0 }
    }
}

#[test]
fn local_deformation_models_satisfy_the_contract() {
    let grid = Grid::centred(8, 7, 1e-6, 1e-6).unwrap();
    deformation_model(&mut Winkler { grid, compliance: 1e-16 }).unwrap();
    for compliance in [0.0, -1e-16] {
        let broken = deformation_model(&mut Winkler { grid, compliance }).unwrap_err().to_string();
        assert!(broken.contains("displacement is positive"), "{broken}");
    }
}

#[test]
fn solvers_satisfy_the_contract() {
    contact_solver(&mut Dry::new(), false).unwrap();
    contact_solver(&mut Auto::new(), false).unwrap();
    contact_solver(&mut Auto::new(), true).unwrap();
    contact_solver(&mut NewtonKrylov::new(), true).unwrap();
    contact_solver(&mut SemiSystem::new(0.2, 6.0).unwrap(), true).unwrap();
    contact_solver(&mut Multigrid::new(), true).unwrap();
}

#[test]
fn motions_satisfy_the_contract() {
    roughness_motion(&Fixed).unwrap();
    roughness_motion(&Advected).unwrap();
    for seed in [0, 1, u64::MAX] {
        roughness_motion(&AlongTrack { seed }).unwrap();
        roughness_motion(&RandomShift { seed }).unwrap();
    }
}

/// Moves across the track but declares another revisit.
#[derive(Debug)]
struct Straying(PointRevisit);

impl RoughnessMotion for Straying {
    fn offset(&self, _body: usize, draw: u64, _time: f64, _speed: f64, _grid: &Grid) -> Offset {
        Offset { columns: 0, rows: (draw % 3) as usize, fraction: 0.0 }
    }
    fn visits(&self, _speed: f64) -> PointRevisit {
        self.0
    }
}

/// An invalid fraction.
#[derive(Debug)]
struct Lost;

impl RoughnessMotion for Lost {
    fn offset(&self, _body: usize, draw: u64, _time: f64, _speed: f64, _grid: &Grid) -> Offset {
        Offset { fraction: if draw > 1 { f64::NAN } else { 0.0 }, ..Offset::default() }
    }
    fn visits(&self, _speed: f64) -> PointRevisit {
        PointRevisit::Track
    }
}

/// Laws that violate one clause each.
#[derive(Debug)]
enum Broken {
    GrowsIdle,
    Overshoots,
    CountsSteps,
    NotANumber,
}

impl FilmGrowthLaw for Broken {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        match self {
            Self::NotANumber => f64::NAN,
            Self::GrowsIdle => 1e-3 * (100e-9 - thickness),
            _ if at.in_contact => 1e-3 * (100e-9 - thickness),
            _ => 0.0,
        }
    }
    fn maximum_thickness(&self) -> f64 {
        100e-9
    }
    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        if !at.in_contact && !matches!(self, Self::GrowsIdle) {
            return;
        }
        let step = match self {
            // Forward Euler.
            Self::Overshoots => 1e-3 * time_step,
            // Backward Euler: stable, but dependent on the division of the step.
            _ => 1e-3 * time_step / (1.0 + 1e-3 * time_step),
        };
        states[0] += step * (100e-9 - states[0]);
    }
}

/// Field results that differ from node results.
#[derive(Debug)]
struct Apart;

impl FilmGrowthLaw for Apart {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if at.in_contact { 1e-3 * (100e-9 - thickness) } else { 0.0 }
    }
    fn maximum_thickness(&self) -> f64 {
        100e-9
    }
    fn advance_all(&self, _: &[SurfaceState], _: f64, states: &mut [f64]) {
        states.fill(50e-9);
    }
}

impl WearLaw for Apart {
    fn depth_rate(&self, at: &SurfaceState, _film: f64) -> f64 {
        1e-20 * at.pressure * at.sliding_speed
    }
    fn depth_rates(&self, _: &[SurfaceState], _: &[f64], rates: &mut [f64]) {
        rates.fill(1e-12);
    }
}

impl BoundaryFriction for Apart {
    fn coefficient(&self, _: f64, _: f64, _: [f64; 2]) -> f64 {
        0.1
    }
    fn coefficients(&self, _: &[f64], _: f64, _: [&[f64]; 2], coefficients: &mut [f64]) {
        coefficients.fill(0.2);
    }
}

#[derive(Debug)]
struct Softening;

impl PlasticityModel for Softening {
    fn pressure_limit(&self, _film: f64, depth: f64) -> f64 {
        6e9 / (1.0 + depth / 1e-7)
    }
}

#[derive(Debug)]
struct Healing;

impl WearLaw for Healing {
    fn depth_rate(&self, _at: &SurfaceState, _film: f64) -> f64 {
        -1e-9
    }
}

#[derive(Debug)]
struct Thinning;

impl ViscosityLaw for Thinning {
    fn viscosity(&self, pressure: f64) -> f64 {
        0.01 / (1.0 + pressure.max(0.0) / 1e9)
    }
}

#[derive(Debug)]
struct WrongSlope;

impl DensityLaw for WrongSlope {
    fn ratio(&self, pressure: f64) -> f64 {
        1.0 + 1e-10 * pressure.max(0.0)
    }
    fn slope(&self, _pressure: f64) -> f64 {
        2e-10
    }
}

#[test]
fn violated_contracts_are_detected() {
    for (law, clause) in [
        (Broken::GrowsIdle, "any"),
        (Broken::Overshoots, "between zero and the largest"),
        (Broken::CountsSteps, "may be divided"),
        (Broken::NotANumber, "rates are finite"),
    ] {
        let violation = film_growth_law(&law).unwrap_err();
        assert!(clause == "any" || violation.to_string().contains(clause), "{violation}");
    }
    for (motion, clause) in [
        (&Straying(PointRevisit::Permanent) as &dyn RoughnessMotion, "keeps its offset"),
        (&Straying(PointRevisit::Track), "keeps its row"),
        (&Lost, "from 0 to 1"),
    ] {
        let violation = roughness_motion(motion).unwrap_err();
        assert!(violation.clause.contains(clause), "{violation}");
    }
    roughness_motion(&Straying(PointRevisit::Patch)).unwrap();
    assert!(plasticity_model(&Softening).unwrap_err().clause.contains("do not fall"));
    assert!(wear_law(&Healing).unwrap_err().clause.contains("never negative"));
    assert_eq!(film_growth_law(&Apart).unwrap_err().clause, "fields advance like their nodes");
    assert_eq!(wear_law(&Apart).unwrap_err().clause, "fields have the rates of their nodes");
    assert_eq!(boundary_friction(&Apart).unwrap_err().clause, "fields have the coefficients of their nodes");
    assert!(viscosity_law(&Thinning).unwrap_err().clause.contains("does not fall"));
    assert!(density_law(&WrongSlope).unwrap_err().clause.contains("derivative"));
    // A dry solver cannot solve a lubricated contact, and the check reports it.
    assert!(contact_solver(&mut Dry::new(), true).is_err());
}

/// A coefficient that depends on the number of calls.
#[derive(Debug, Default)]
struct Counting(std::sync::atomic::AtomicU32);

impl BoundaryFriction for Counting {
    fn coefficient(&self, _: f64, _: f64, _: [f64; 2]) -> f64 {
        f64::from(self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
    }
}

/// A Stribeck-like law that divides by the speed.
#[derive(Debug)]
struct Diverging;

impl BoundaryFriction for Diverging {
    fn coefficient(&self, _: f64, sliding_speed: f64, _: [f64; 2]) -> f64 {
        1e-3 / sliding_speed
    }
}

#[test]
fn boundary_friction_laws_satisfy_the_contract() {
    boundary_friction(&ConstantFriction::new(0.115).unwrap()).unwrap();
    boundary_friction(&FilmFriction::new(0.08, 0.12, 20e-9).unwrap()).unwrap();
    boundary_friction(&FilmFriction::new(0.12, 0.0, 1e-12).unwrap()).unwrap();
    let violation = boundary_friction(&Counting::default()).unwrap_err();
    assert_eq!(violation.clause, "coefficients depend on the arguments alone");
    let violation = boundary_friction(&Diverging).unwrap_err();
    assert_eq!(violation.clause, "coefficients are finite and not negative");
}
