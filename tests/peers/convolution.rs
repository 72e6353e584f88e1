//! Seconds of one elastic convolution, for the comparison with other codes (`tests/peers/compare.py`).
//!
//! ```text
//! peers_convolution NODES REPEATS
//! ```
//!
//! Prints one JSON object: the median time of a product, and the largest displacement under the Hertz
//! pressure of the reference ball \[m\].

use std::error::Error;
use std::io::{self, Write};
use std::time::Instant;

use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::sim::Scene;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut next = |name: &str| arguments.next().ok_or_else(|| format!("{name} is missing"));
    let (n, repeats): (usize, usize) = (next("NODES")?.parse()?, next("REPEATS")?.parse()?);
    let scene = Scene::azam_2019(n);
    let (grid, hertz) = (scene.grid()?, scene.hertz()?);
    let pressure: Vec<f64> = grid
        .nodes()
        .map(|(x, y)| {
            hertz.pressure
                * (1.0 - (x / hertz.half_width_x).powi(2) - (y / hertz.half_width_y).powi(2)).max(0.0).sqrt()
        })
        .collect();
    let mut body = HalfSpace::new(grid, scene.elastic.equivalent_modulus)?;
    let mut displacement = vec![0.0; grid.len()];
    let mut times = Vec::with_capacity(repeats.max(1));
    for _ in 0..repeats.max(1) {
        let start = Instant::now();
        body.displacement(&pressure, &mut displacement)?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    let largest = displacement.iter().copied().fold(0.0, f64::max);
    let result = serde_json::json!({ "seconds": times[times.len() / 2], "value": largest });
    writeln!(io::stdout(), "{result}")?;
    Ok(())
}
