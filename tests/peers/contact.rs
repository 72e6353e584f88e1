//! Seconds of one dry contact from its undeformed gap, for the comparison with other codes
//! (`tests/peers/compare.py`).
//!
//! ```text
//! peers_contact SCENE.toml FIELDS.npz
//! ```
//!
//! Solves the scene once, writes its fields, then times kernel, transforms and solve from the gap in them.
//! Prints one JSON object: the median time of three, status, steps of conjugate gradients, the largest pressure
//! \[Pa\] and the contact area \[m^2\] of the scene.

use std::error::Error;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;

use stribeck::elastic::HalfSpace;
use stribeck::reynolds::{ContactSolver, ContactState, Dry, LubricatedContact, StoppingRule};
use stribeck::sim::{Scene, solve_contact, write_npz};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let mut next = |name: &str| arguments.next().ok_or_else(|| format!("{name} is missing"));
    let (scene, fields) = (Scene::load(next("SCENE")?)?, next("FIELDS")?);
    let solution = solve_contact(&scene)?;
    write_npz(&fields, &solution.grid, &solution.fields())?;

    let (grid, hertz) = (solution.grid, solution.hertz);
    let stop = StoppingRule::default().with_tolerance(scene.solver.tolerance);
    let limits = scene.plastic.map(|plastic| vec![plastic.hardness; grid.len()]);
    let mut times = Vec::with_capacity(3);
    let mut report = solution.report;
    for _ in 0..3 {
        let start = Instant::now();
        let mut body = HalfSpace::new(grid, scene.elastic.equivalent_modulus)?;
        let half_widths = (hertz.half_width_x, hertz.half_width_y);
        let mut problem =
            LubricatedContact::new(&solution.gap, &mut body, hertz.force, half_widths, hertz.pressure)
                .with_pressure_limit(limits.as_deref());
        let mut state = ContactState::new(&grid);
        report = Dry::new().solve(&mut problem, &mut state, &stop)?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    let result = serde_json::json!({
        "seconds": times[1],
        "status": report.status,
        "steps": report.work.inner_iterations,
        "largest_pressure": solution.pressure.max,
        "area": solution.contact.area,
    });
    writeln!(io::stdout(), "{result}")?;
    Ok(())
}
