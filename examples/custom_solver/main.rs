//! A solver of one's own, driven by the same simulation, and its work beside that of the solver of the crate.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

mod steepest_descent;
use steepest_descent::SteepestDescent;
use stribeck::benchmark::{Benchmark, Case, Contestant};
use stribeck::sim::{MixedLubricationSim, Scene, SimError};

fn main() -> Result<(), SimError> {
    let mut scene = Scene::azam_2019(48);
    (scene.lubricant, scene.plastic) = (None, None);
    let cases = vec![Case::new("dry contact", scene.clone())];
    let benchmark =
        Benchmark::new(cases).contestant(Contestant::named("dry")?).tolerances([1e-2, 1e-3, 1e-4]);
    let own = Contestant::new("steepest_descent", |_| Box::new(SteepestDescent));
    let results = benchmark.contestant(own).run()?;
    println!("{}", results.summary());
    println!("{:>9} {:>19} {:>21}", "residual", "own: convolutions", "crate: convolutions");
    for tolerance in [1e-2, 1e-3, 1e-4] {
        scene.solver.tolerance = tolerance;
        let step = |builder: stribeck::sim::SimBuilder| builder.build()?.step(10.0);
        let own = step(MixedLubricationSim::builder(scene.clone()).solver(SteepestDescent))?;
        let crates = step(MixedLubricationSim::builder(scene.clone()))?;
        let [mine, theirs] = [&own, &crates].map(|step| step.report.work.convolutions);
        println!("{tolerance:9.0e} {mine:19} {theirs:21}");
        assert!(
            (own.contact.area_ratio / crates.contact.area_ratio - 1.0).abs() < 0.05,
            "both find the same contact"
        );
    }
    Ok(())
}
