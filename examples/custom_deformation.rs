//! A deformation model of one's own: steel under a thin compliant coating that yields in proportion to the
//! pressure on it.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::sim::scene::RoughnessPair;
use stribeck::sim::{MixedLubricationSim, Scene, SimError};
use stribeck::{Grid, InputError};

/// A coating of thickness `t` and confined modulus `M` on a half-space: `u = K p + (t/M) p`. Valid while the
/// coating is thin against the contact.
#[derive(Debug, Clone)]
struct Coated {
    substrate: HalfSpace,
    compliance: f64,
}

impl Coated {
    fn new(grid: Grid, modulus: f64, thickness: f64, confined_modulus: f64) -> Result<Self, InputError> {
        for (field, value, holds, requirement) in [
            ("coating.thickness", thickness, thickness >= 0.0, "finite and >= 0"),
            ("coating.confined_modulus", confined_modulus, confined_modulus > 0.0, "finite and > 0"),
        ] {
            if !holds || value.is_infinite() {
                return Err(InputError::Value { field: field.to_owned(), value, requirement });
            }
        }
        let compliance = thickness / confined_modulus;
        Ok(Self { substrate: HalfSpace::new(grid, modulus)?, compliance })
    }
}

impl DeformationModel for Coated {
    fn grid(&self) -> Grid {
        self.substrate.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.substrate.displacement(pressure, out)?;
        for (displacement, pressure) in out.iter_mut().zip(pressure) {
            *displacement += self.compliance * pressure;
        }
        Ok(())
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        let coating = if (di, dj) == (0, 0) { self.compliance } else { 0.0 };
        self.substrate.influence(di, dj) + coating
    }
}

fn main() -> Result<(), SimError> {
    let mut scene = Scene::azam_2019(96);
    // Smooth, elastic and in oil.
    scene.roughness = RoughnessPair::default();
    (scene.plastic, scene.wear) = (None, None);
    scene.motion.entrainment_speed = 5.0;
    scene.solver.tolerance = 1e-4;
    let (grid, modulus) = (scene.grid()?, scene.elastic.equivalent_modulus);
    println!("{:>14} {:>18} {:>18}", "coating", "largest pressure", "mean film");
    let mut peaks = Vec::new();
    for thickness in [0.0, 1e-6, 4e-6] {
        let mut coated = Coated::new(grid, modulus, thickness, 5e9)?;
        // Such a check belongs into the tests of a crate.
        assert_eq!(stribeck::testing::deformation_model(&mut coated), Ok(()));
        let mut sim = MixedLubricationSim::builder(scene.clone()).deformation(coated).build()?;
        let record = sim.step(1.0)?;
        let (peak, film) = (record.pressure.max, record.film.mean_central);
        println!("{:11.1} um {} GPa {} nm", thickness * 1e6, peak * 1e-9, film * 1e9);
        peaks.push(peak);
    }
    assert!(peaks.is_sorted_by(|harder, softer| harder > softer), "a coating spreads the load");
    Ok(())
}
