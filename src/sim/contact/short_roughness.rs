//! Roughness shorter than the cells of the grid, on which solids carry more than on the grid.

use std::f64::consts::TAU;

use crate::grid::Grid;
use crate::reynolds::LubricatedContact;
use crate::sim::contact::asperity_inlets::height_and_slopes;
use crate::sim::contact::warnings::Warning;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{Roughness, Scene};

/// Octaves of wavelengths below two cells.
const OCTAVES: i32 = 12;
/// Pressure of elastic asperities over `E'` times the root mean square slope: contact area over load is 2 over
/// `E'/2` times the slope, between the theories of Persson and of Bush, Gibson and Thomas.
const ASPERITY_PRESSURE: f64 = 0.25;

/// Root mean square height \[m\] of the random waves of both bodies that are shorter than two cells and that the pressure of
/// the asperities does not flatten: octaves whose full-contact pressure `E' q A/4`, with the amplitude `A` and the wave
/// number `q`, is above it. Zero for other roughness.
pub(in crate::sim) fn short_roughness(
    scene: &Scene,
    grid: &Grid,
    heights: [&[f64]; 2],
    hertz: &HertzContact,
) -> f64 {
    let Ok(modulus) = scene.equivalent_modulus() else { return 0.0 };
    let [_, along, across] = height_and_slopes(grid, heights);
    let mut asperities = (ASPERITY_PRESSURE * modulus * along.hypot(across)).max(hertz.pressure);
    if let Some(plastic) = scene.plastic {
        asperities = scene.hardnesses(plastic.hardness).into_iter().fold(asperities, f64::min);
    }
    let bodies = [&scene.roughness.ball, &scene.roughness.disc];
    let random = bodies.into_iter().filter_map(|body| match body {
        Roughness::Random(surface) if surface.rq > 0.0 => Some(*surface),
        _ => None,
    });
    let random: Vec<_> = random.collect();
    let cut = 2.0 * if grid.ny() > 1 { grid.dx().max(grid.dy()) } else { grid.dx() };
    let mut square = 0.0;
    for octave in 0..OCTAVES {
        let longest = cut / 2_f64.powi(octave);
        let rms = random.iter().map(|surface| surface.rms_of_waves(cut, longest, 0.5 * longest));
        let rms = rms.fold(0.0, f64::hypot);
        let flattening = 0.25 * modulus * (TAU * 2_f64.sqrt() / longest) * 2_f64.sqrt() * rms;
        if flattening > asperities {
            square += rms * rms;
        }
    }
    square.sqrt()
}

/// A warning where the contact film is that of molecules alone and the surfaces have a `short` roughness \[m\] above it.
pub(in crate::sim) fn warning(scene: &Scene, grid: &Grid, short: f64) -> Option<Warning> {
    let film = scene.solver.film_cutoff;
    (scene.is_lubricated() && film <= LubricatedContact::FILM_CUTOFF && short > film).then(|| {
        Warning::new(
            "solver.film_cutoff",
            film,
            format!(
                "it is the size of molecules, and the random roughness has waves shorter than two cells of {:.2e} m that asperities \
                 do not flatten, with an Rq of {short:.2e} m: solids carry more than on these cells",
                grid.dx()
            ),
            "use smaller cells, or a shortest wave of four cells; a contact film larger by that Rq is far too large".to_owned(),
        )
    })
}
