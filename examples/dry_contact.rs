//! A rough ball on a rough disc without oil: how the real contact area grows with the load, and how yielding
//! increases it.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use std::error::Error;

use stribeck::sim::{Scene, solve_contact};

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::azam_2019(96);
    scene.lubricant = None;
    println!("{:>9} {:>14} {:>14} {:>18}", "load", "contact area", "of that of", "largest pressure");
    println!("{:>9} {:>14} {:>14} {:>18}", "N", "um^2", "Hertz", "GPa");
    let mut areas = Vec::new();
    for load in [1.0, 4.0, 16.0] {
        for plastic in [None, scene.plastic] {
            let mut scene = scene.clone();
            scene.load.hertz_pressure = None;
            scene.load.force = Some(load);
            scene.plastic = plastic;
            let solution = solve_contact(&scene)?;
            solution.report.require_converged()?;
            let (contact, hertz) = (solution.contact, solution.hertz);
            println!(
                "{load:9.0} {:14.1} {:14.3} {:18.2} {}",
                contact.area * 1e12,
                contact.area / hertz.area,
                solution.pressure.max * 1e-9,
                if plastic.is_some() { "yields" } else { "elastic" }
            );
            areas.push(contact.area);
            assert!(contact.area < hertz.area, "asperities carry the load on less than the smooth contact");
        }
    }
    // Yielding asperities let more of their neighbours in, and more load brings more area.
    assert!(areas.chunks(2).all(|pair| pair[1] >= pair[0]));
    assert!(areas[4] > 4.0 * areas[0]);
    Ok(())
}
