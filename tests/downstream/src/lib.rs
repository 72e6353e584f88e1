//! Own laws for a contact: a film that a solution deposits, a soft liner on steel, an oil that stiffens
//! exponentially.

#[cfg(feature = "benchmark")]
pub mod benchmark;

use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::lubricant::ViscosityLaw;
use stribeck::tribochem::FilmGrowthLaw;
use stribeck::{Grid, InputError, SurfaceState};

/// Film that grows where solids rub, slower with depth.
#[derive(Debug)]
pub struct Deposited {
    /// Rate on the bare surface \[m/s\].
    pub rate: f64,
    /// Largest thickness \[m\].
    pub maximum: f64,
}

impl FilmGrowthLaw for Deposited {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if at.in_contact { self.rate * (1.0 - thickness / self.maximum) } else { 0.0 }
    }

    fn maximum_thickness(&self) -> f64 {
        self.maximum
    }
}

/// Half-space under a liner that is compressed in proportion to the pressure on it.
#[derive(Debug, Clone)]
pub struct Lined {
    substrate: HalfSpace,
    compliance: f64,
}

impl Lined {
    /// Liner of `compliance` \[m/Pa\] on a half-space of equivalent modulus `modulus` \[Pa\].
    ///
    /// # Errors
    /// A modulus or a compliance out of range.
    pub fn new(grid: Grid, modulus: f64, compliance: f64) -> Result<Self, InputError> {
        if !compliance.is_finite() || compliance < 0.0 {
            let (field, requirement) = ("compliance".to_owned(), "finite and >= 0");
            return Err(InputError::Value { field, value: compliance, requirement });
        }
        Ok(Self { substrate: HalfSpace::new(grid, modulus)?, compliance })
    }
}

impl DeformationModel for Lined {
    fn grid(&self) -> Grid {
        self.substrate.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.substrate.displacement(pressure, out)?;
        for (out, pressure) in out.iter_mut().zip(pressure) {
            *out += self.compliance * pressure;
        }
        Ok(())
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.substrate.influence(di, dj) + if di + dj == 0 { self.compliance } else { 0.0 }
    }
}

/// `eta = eta0 exp(alpha p)`, with the pressure bounded where the law loses its meaning.
#[derive(Debug)]
pub struct Exponential {
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Coefficient \[1/Pa\].
    pub alpha: f64,
    /// Pressure above which the viscosity stays \[Pa\].
    pub bound: f64,
}

impl ViscosityLaw for Exponential {
    fn viscosity(&self, pressure: f64) -> f64 {
        self.eta0 * (self.alpha * pressure.clamp(0.0, self.bound)).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::error::Error;
    use std::ops::ControlFlow;
    use stribeck::sim::{MixedLubricationSim, Observer, RunEnd, Scene, StepRecord};
    use stribeck::testing;

    const OIL: Exponential = Exponential { eta0: 0.004, alpha: 1.2e-8, bound: 1e9 };

    #[test]
    fn laws_keep_their_contracts() -> Result<(), Box<dyn Error>> {
        testing::film_growth_law(&Deposited { rate: 1e-10, maximum: 80e-9 })?;
        testing::viscosity_law(&OIL)?;
        let grid = Grid::centred(12, 10, 4e-6, 4e-6)?;
        testing::deformation_model(&mut Lined::new(grid, 230e9, 1e-16)?)?;
        Ok(())
    }

    #[test]
    fn laws_run_together() -> Result<(), Box<dyn Error>> {
        let mut scene = Scene::azam_2019(32);
        scene.solver.tolerance = 1e-4;
        let lined = Lined::new(scene.grid()?, scene.elastic.equivalent_modulus, 1e-16)?;
        let mut sim = MixedLubricationSim::builder(scene)
            .growth_law(Deposited { rate: 1e-10, maximum: 80e-9 })
            .viscosity(OIL)
            .deformation(lined)
            .build()?;
        let mut films = Vec::new();
        sim.run(4, 60.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
            films.push(record.tribofilm.disc_mean);
            ControlFlow::Continue(())
        })?;
        assert!(films.is_sorted_by(|earlier, later| earlier < later), "{films:?}");
        assert!(sim.ledger_residual()? < 1e-20);
        Ok(())
    }

    /// Stops the run at the first step whose film is thick enough.
    struct ThickEnough(f64);

    impl Observer for ThickEnough {
        fn after_step(&mut self, _: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
            if record.tribofilm.disc_mean > self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }

    #[test]
    fn stopped_run_is_resumed() -> Result<(), Box<dyn Error>> {
        let mut scene = Scene::azam_2019(32);
        scene.solver.tolerance = 1e-4;
        // Slow enough for solids to touch over much of the contact.
        scene.motion.entrainment_speed = 0.01;
        let law = Deposited { rate: 1e-10, maximum: 80e-9 };
        let mut sim = MixedLubricationSim::builder(scene).growth_law(law).build()?;
        assert_eq!(sim.run(20, 60.0, &mut ThickEnough(2e-9))?, RunEnd::Stopped);
        let stopped = sim.steps();
        assert!((1..20).contains(&stopped), "{stopped} steps");
        assert_eq!(sim.run(1, 60.0, &mut ThickEnough(1.0))?, RunEnd::Finished);
        assert_eq!(sim.steps(), stopped + 1);
        Ok(())
    }
}
