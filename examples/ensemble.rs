//! A sweep over loads and seeds on all threads of the machine, or over the ranks of an MPI program;
//! resumable.
//!
//! ```text
//! cargo run --release --example ensemble [-- FOLDER]
//! cargo build --release --example ensemble --features mpi && mpirun -n 2 target/release/examples/ensemble
//! ```
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use std::error::Error;
use std::path::{Path, PathBuf};

use stribeck::sim::Scene;
use stribeck::sim::ensemble::{Member, Outcome};

/// Steps between checkpoints.
const EVERY: u64 = 2;

fn members() -> Vec<Member> {
    let mut members = Vec::new();
    // The middle load cannot be built: the others do not mind.
    for pressure in [0.9e9, -1e9, 1.3e9] {
        for seed in [1, 2] {
            let mut scene = Scene::azam_2019(32).with_tribofilm();
            scene.load.hertz_pressure = Some(pressure);
            scene.solver.tolerance = 1e-3;
            let name = format!("{:.1}_gpa_seed_{seed}", pressure * 1e-9);
            scene.track.seed = seed;
            members.push(Member::new(name, scene, 4, 60.0));
        }
    }
    members
}

#[cfg(not(feature = "mpi"))]
fn run(folder: &Path) -> Result<Option<Vec<Outcome>>, Box<dyn Error>> {
    let threads = std::thread::available_parallelism()?.get();
    Ok(Some(stribeck::sim::ensemble::run_in(folder, &members(), threads, EVERY)?))
}

/// All outcomes on the first rank.
#[cfg(feature = "mpi")]
fn run(folder: &Path) -> Result<Option<Vec<Outcome>>, Box<dyn Error>> {
    use mpi::traits::Communicator;
    let universe = mpi::initialize().ok_or("MPI was started before")?;
    let world = universe.world();
    let outcomes = stribeck::sim::ensemble::run_over_ranks(&world, folder, &members(), 1, EVERY)?;
    Ok((world.rank() == 0).then_some(outcomes))
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("target/ensemble"), PathBuf::from);
    let Some(outcomes) = run(&folder)? else { return Ok(()) };
    for (member, outcome) in members().iter().zip(&outcomes) {
        match (&outcome.failure, outcome.records.last()) {
            (None, Some(last)) => println!(
                "{:18} {} steps, wear {:.17e} m, film {:.17e} m",
                member.name,
                outcome.records.len(),
                last.wear.disc_mean,
                last.tribofilm.disc_mean
            ),
            (Some(error), _) => println!("{:18} {error}", member.name),
            (None, None) => println!("{:18} no steps", member.name),
        }
    }
    assert_eq!(outcomes.iter().filter(|outcome| outcome.failure.is_none()).count(), 4);
    Ok(())
}
