//! Benchmarks: contestants that fail in every way, references, repeated and resumed runs.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use stribeck::benchmark::{
    Benchmark, Budget, Case, Cases, Contestant, HeightsOnGrid, History, Limits, Quantity, Results, Row,
    Verdict,
};
use stribeck::reynolds::{
    ContactSolver, ContactState, Evaluation, LubricatedContact, NewtonKrylov, ReynoldsError, StoppingRule,
};
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{Scene, SimError, solve_contact};
use stribeck::{Residuals, SolveReport, SolverId, Status, Work};

/// Ways to fail.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    Panics,
    Hangs,
    Repeats,
    OtherGrid,
    Lies,
    LiesAboutLoad,
    NotFinite,
    Refuses,
}

#[derive(Debug)]
struct Faulty(Fault);

impl ContactSolver for Faulty {
    fn id(&self) -> SolverId {
        SolverId::Custom("faulty")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let converged = SolveReport::new(self.id(), Status::Converged, Residuals::default());
        let converged = converged.with_work(Work::default());
        match self.0 {
            Fault::Panics => panic!("a deliberate panic"),
            Fault::Hangs => std::thread::sleep(Duration::from_secs(20)),
            Fault::Repeats => loop {
                Evaluation::new(problem.grid()).evaluate(problem, state)?;
            },
            Fault::OtherGrid => {
                let nodes = state.film.len() / 4;
                state.film.truncate(nodes);
                state.pressure.truncate(nodes);
            }
            Fault::Lies => {}
            Fault::LiesAboutLoad => {
                let _ = NewtonKrylov::new().solve(problem, state, stop)?;
                state.pressure.iter_mut().for_each(|p| *p *= 1.01);
                state.fluid_pressure.iter_mut().for_each(|p| *p *= 1.01);
            }
            Fault::NotFinite => state.pressure.fill(f64::NAN),
            Fault::Refuses => {
                let reason = "not today";
                return Err(ReynoldsError::WrongSolver { solver: self.id(), reason });
            }
        }
        Ok(converged)
    }
}

fn faulty(fault: Fault) -> Contestant {
    Contestant::new(format!("{fault:?}"), move |_| Box::new(Faulty(fault)))
}

/// A rough contact on a coarse grid.
fn rough() -> Case {
    let mut scene = Scene::azam_2019(20);
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(stribeck::sim::scene::InletSpec::BoxEdge));
    Case::new("rough", scene).with_tags(["rough"])
}

fn auto() -> Contestant {
    Contestant::named("auto").unwrap()
}

fn one(contestant: Contestant, budget: Budget) -> Row {
    let benchmark = Benchmark::new(vec![rough()]).contestant(contestant).budget(budget);
    benchmark.run().unwrap().rows()[0].clone()
}

#[test]
fn faulty_contestants_are_rows_with_reasons_and_the_others_continue() {
    let budget = Budget::default().with_seconds(1.0);
    let faults = [
        (Fault::Panics, Verdict::Panicked, "a deliberate panic"),
        (Fault::Hangs, Verdict::GivenUp, "did not return"),
        (Fault::Repeats, Verdict::OutOfBudget, "displacements"),
        (Fault::OtherGrid, Verdict::WrongGrid, "state.pressure has 100 values, expected 400"),
        (Fault::Lies, Verdict::FalselyConverged, "residuals"),
        (Fault::LiesAboutLoad, Verdict::FalselyConverged, "load"),
        (Fault::NotFinite, Verdict::FalselyConverged, "not finite"),
        (Fault::Refuses, Verdict::Refused, "not today"),
    ];
    let benchmark = Benchmark::new(vec![rough()]).budget(budget);
    let contestants = faults.iter().map(|(fault, ..)| faulty(*fault)).chain([auto()]);
    let results = benchmark.contestants(contestants).run().unwrap();
    for ((fault, verdict, word), row) in faults.iter().zip(results.rows()) {
        assert_eq!(row.verdict, *verdict, "{fault:?}: {row:?}");
        assert!(row.reason.contains(word), "{fault:?}: {}", row.reason);
    }
    assert!(results.rows()[8].is_solved());
    let words = results.summary();
    assert!(words.contains("Panics fails in 1 of 1 runs"), "{words}");
    assert!(words.contains("No run is solved by all contestants"), "{words}");
}

#[test]
fn budget_of_convolutions_ends_a_solve_at_the_same_place_in_every_run() {
    let budget = Budget::default().with_convolutions(9.0);
    let [first, second] = [(); 2].map(|()| one(auto(), budget));
    assert_eq!(first.verdict, Verdict::OutOfBudget);
    assert!(first.displacements > 7.0 && first.displacements <= 9.0, "{first:?}");
    assert_eq!(first.displacements.to_bits(), second.displacements.to_bits());
}

#[test]
fn cases_without_solution_are_refused_and_known_by_the_summary() {
    let cases = Cases::named("corners", 1).unwrap().tagged("infeasible").every(2);
    let results = Benchmark::new(cases).contestant(auto()).run().unwrap();
    assert_eq!(results.rows().len(), 2);
    for row in results.rows() {
        assert_eq!(row.verdict, Verdict::Refused);
        assert!(row.reason.starts_with("plastic.hardness"), "{}", row.reason);
    }
    let words = results.summary();
    assert!(!words.contains("fails"), "{words}");
    assert!(
        words.contains("2 of 2 runs are refused for every contestant") && words.contains("plastic.hardness"),
        "{words}"
    );
}

#[test]
fn estimates_of_mesh_errors_are_left_out_and_grids_by_accuracy_are_refused_with_the_remedy() {
    let mut estimated = rough();
    (estimated.scene.solver.estimate, estimated.scene.solver.accuracy) = (true, Some(0.02));
    let mut adaptive = rough();
    adaptive.name = "adaptive".to_owned();
    adaptive.scene.grid = GridSpec::Accuracy { accuracy: 0.02 };
    let results = Benchmark::new(vec![estimated, adaptive]).contestant(auto()).run().unwrap();
    assert!(results.rows()[0].is_solved(), "{:?}", results.rows()[0]);
    assert_eq!(results.rows()[1].verdict, Verdict::Refused);
    assert!(results.rows()[1].reason.contains("replace it by nx, ny, x and y"), "{:?}", results.rows()[1]);
}

#[test]
fn reference_of_another_scene_is_a_remark_and_no_error_is_computed() {
    let mut other = rough().scene;
    other.motion.entrainment_speed *= 2.0;
    let limits = |scene: &Scene| Limits::of(scene).unwrap().with(Quantity::LoadRatio, 0.5, 0.0);
    let own = rough().with_reference(Some(limits(&rough().scene)));
    let mut foreign = rough().with_reference(Some(limits(&other)));
    foreign.name = "foreign".to_owned();
    let results = Benchmark::new(vec![own, foreign]).contestant(auto()).meshes([20, 24]).run().unwrap();
    for row in &results.rows()[..2] {
        let expected = (row.value(Quantity::LoadRatio) / 0.5 - 1.0).abs();
        assert!((row.error - expected).abs() < 1e-12 && row.reason.is_empty(), "{row:?}");
    }
    for row in &results.rows()[2..] {
        assert!(row.is_solved() && row.error.is_nan(), "{row:?}");
        assert!(row.reason.contains("the reference is of the scene"), "{}", row.reason);
    }
}

#[test]
fn values_are_those_of_the_contact_and_repeated_runs_are_equal_in_all_but_seconds() {
    let mut history = rough().with_history(Some(History::transient(3, 1e-4)));
    history.name = "history".to_owned();
    let cases = vec![rough(), history];
    let run = |threads| {
        let own = Contestant::new("own", |_| Box::new(NewtonKrylov::new()));
        let benchmark = Benchmark::new(cases.clone()).contestants([auto(), own]).threads(threads);
        benchmark.tolerances([1e-4, 1e-6]).run().unwrap()
    };
    let without_seconds = |results: &Results| -> Vec<String> {
        let rows = results.rows().iter().map(|row| {
            let mut row = row.clone();
            row.seconds = 0.0;
            format!("{row:?}")
        });
        rows.collect()
    };
    let (one, two) = (run(1), run(2));
    assert_eq!(without_seconds(&one), without_seconds(&two));
    assert!(one.rows().iter().all(Row::is_solved), "{}", one.summary());
    let mut scene = rough().scene;
    scene.solver.tolerance = 1e-6;
    let solution = solve_contact(&scene).unwrap();
    let row = &one.rows()[1];
    let bits = |values: [f64; 4]| values.map(f64::to_bits);
    assert_eq!(
        bits([
            row.convolutions,
            row.value(Quantity::LoadRatio),
            row.value(Quantity::CentralFilm),
            row.minimum_gap
        ]),
        bits([
            solution.report.work.convolutions,
            solution.contact.load_ratio,
            solution.film.central,
            solution.film.minimum_gap
        ])
    );
    assert!(row.displacements > 0.0 && row.displacements <= row.convolutions, "{row:?}");
    // All contacts of a history, of which the last one is reported.
    assert!(one.rows()[3].all_convolutions > 2.0 * one.rows()[3].convolutions);
}

#[test]
fn stopped_benchmarks_continue_and_end_with_the_same_table() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("deep/rows.csv");
    let solved = Arc::new(AtomicUsize::new(0));
    let counting = |solved: &Arc<AtomicUsize>| {
        let solved = Arc::clone(solved);
        Contestant::new("own, \"counted\"", move |_| {
            solved.fetch_add(1, Ordering::Relaxed);
            Box::new(NewtonKrylov::new())
        })
    };
    let cases = || Cases::named("battery", 1).unwrap().tagged("smooth").every(9);
    let benchmark = || Benchmark::new(cases()).meshes([16]).threads(1).file(&file);
    let whole = Benchmark::new(cases()).meshes([16]).contestant(counting(&solved)).run().unwrap();
    let done = Mutex::new(0);
    let stopped = benchmark()
        .contestant(counting(&solved))
        .observe(|_, count, _| *done.lock().unwrap() = count)
        .interrupt(|| *done.lock().unwrap() >= 2)
        .run();
    let kept = Results::read(&file).unwrap().rows().len();
    assert!(matches!(stopped, Err(SimError::Interrupted)) || kept == whole.rows().len(), "{stopped:?}");
    // The last line of a process that was killed is not complete.
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, &text[..text.len() - 20]).unwrap();
    solved.store(0, Ordering::Relaxed);
    let resumed = benchmark().contestant(counting(&solved)).run().unwrap();
    // The input of each contact is checked by a solver of its own.
    assert_eq!(solved.load(Ordering::Relaxed), 2 * (whole.rows().len() + 1 - kept));
    for (row, expected) in resumed.rows().iter().zip(whole.rows()) {
        assert_eq!((&row.case, row.convolutions), (&expected.case, expected.convolutions));
        assert_eq!(row.values.map(f64::to_bits), expected.values.map(f64::to_bits));
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap(), resumed.to_csv());
    // Another contestant keeps these rows.
    let other = benchmark().contestant(auto()).run().unwrap();
    assert_eq!(Results::read(&file).unwrap().rows().len(), resumed.rows().len() + other.rows().len());
}

#[test]
fn invalid_plans_and_tables_are_rejected_by_name() {
    let message = |benchmark: Benchmark<'_>| benchmark.run().unwrap_err().to_string();
    let plan = || Benchmark::new(vec![rough()]).contestant(auto());
    assert!(message(Benchmark::new(vec![rough()])).starts_with("benchmark: there is no case"));
    assert!(
        message(Benchmark::new(vec![rough(), rough()]).contestant(auto()))
            .contains("two cases are called `rough`")
    );
    assert!(message(plan().contestant(auto())).contains("two contestants are called `auto`"));
    assert!(message(plan().tolerances([0.5])).starts_with("solver.tolerance = 0.5"));
    assert!(message(plan().meshes([4])).starts_with("meshes = 4"));
    assert!(message(plan().budget(Budget::default().with_seconds(f64::NAN))).starts_with("budget.seconds"));
    let history = rough().with_history(Some(History::new(0, 1.0)));
    assert!(message(Benchmark::new(vec![history]).contestant(auto())).contains("history.contacts = 0"));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("other.csv");
    std::fs::write(&file, "a,b\n1,2\n").unwrap();
    assert!(message(plan().file(&file)).contains("line 1: not the head"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "a,b\n1,2\n");
    let table = plan().run().unwrap().to_csv();
    let error = Results::from_csv(&table.replace("converged", "done")).unwrap_err();
    assert!(error.to_string().contains("line 2: cannot read verdict = `done`"), "{error}");
    for (text, word) in [
        ("simplex", "unknown value"),
        ("newton_krylov:step_bound", "is not KEY=VALUE"),
        ("newton_krylov:step_bound=fast", "`fast` is no value of `step_bound`"),
        ("newton_krylov:step_bound=-1", "newton.step_bound"),
        ("auto:tolerance=1e-3", "no setting of a contestant"),
        ("auto:face_mobility=round", "unknown value"),
    ] {
        let error = Contestant::named(text).unwrap_err().to_string();
        assert!(error.contains(word), "{text}: {error}");
    }
}

#[test]
fn case_files_are_read_and_their_errors_name_line_and_case() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("scene.toml", &Scene::azam_2019(24).to_toml().unwrap());
    write(
        "cases.toml",
        "[[case]]\nname = \"a\"\nscene = \"scene.toml\"\ntags = [\"rough\"]\nparameters = { speed = 0.1 }\n\
         history = { contacts = 2, time_step = 10.0 }\nreference = { scene = \"0\", load_ratio = [0.3, 0.1] }\n",
    );
    let path = folder.path().join("cases.toml");
    let cases = Cases::load(&path).unwrap();
    let case = &cases.cases[0];
    assert!(case.has_tag("rough") && case.history == Some(History::new(2, 10.0)));
    assert_eq!(case.reference.as_ref().unwrap().get(Quantity::LoadRatio), Some((0.3, 0.1)));
    assert_eq!(case.scene, Scene::azam_2019(24));
    let error = |text: &str| {
        write("bad.toml", text);
        Cases::load(folder.path().join("bad.toml")).unwrap_err().to_string()
    };
    assert!(error("[[case]]\nname = 1\nscene = \"s\"\n").contains("line 2"));
    assert!(error("[[case]]\nname = \"a\"\nscene = \"scene.toml\"\ntag = 1\n").contains("tag"));
    assert!(error("[[case]]\nname = \"a\"\nscene = \"none.toml\"\n").contains("case `a`"));
    assert_eq!(error("[[case]]\nname = \"a\"\nscene = \"none.toml\"\n").matches("none.toml").count(), 1);
}

#[test]
fn lists_are_repeatable_and_have_unique_names() {
    for (name, count) in [("battery", 405), ("corners", 63), ("map", 468), ("lines", 64), ("thermal", 444)] {
        let cases = Cases::named(name, 3).unwrap();
        assert_eq!(cases.len(), count, "{name}");
        let mut names: Vec<&str> = cases.cases.iter().map(|case| case.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{name}");
    }
    let draw = |seed| {
        let cases = Cases::named("battery", 1).unwrap().draw(5, seed);
        cases.cases.into_iter().map(|case| case.name).collect::<Vec<_>>()
    };
    assert_eq!(draw(1), draw(1));
    assert_ne!(draw(1), draw(2));
    assert!(Cases::named("none", 1).is_err());
}

/// The published limit of a small rough contact is met on a mesh of 64 cells to the stated error of such meshes.
#[test]
fn reference_cases_have_the_published_limits() {
    let mut cases = Cases::named("references", 1).unwrap();
    assert_eq!(cases.len(), 36);
    cases.cases.retain(|case| case.name == "reference: u 0.1 m/s, mass_conserving, surface 1");
    let results = Benchmark::new(cases).contestant(auto()).meshes([32, 128]).run().unwrap();
    let [coarse, fine] = results.rows() else { panic!("{results:?}") };
    assert!((fine.value(Quantity::MeanFilm) / 8.35384e-8 - 1.0).abs() < 0.01, "{fine:?}");
    assert!((fine.value(Quantity::LoadRatio) - 0.1135).abs() < 0.08, "{fine:?}");
    assert!(coarse.error.is_finite() && fine.error < coarse.error, "{results:?}");
}

#[test]
fn own_surfaces_on_any_grid_are_solved() {
    let heights = HeightsOnGrid::new(|grid| {
        let wave = grid.nodes().map(|(x, _)| 20e-9 * (x / 10e-6).cos()).collect();
        Ok([wave, vec![0.0; grid.len()]])
    });
    let mut scene = rough().scene;
    scene.roughness = Default::default();
    let smooth = Case::new("smooth", scene.clone());
    let waves = Case::new("waves", scene).with_heights(Some(heights));
    let results = Benchmark::new(vec![smooth, waves]).contestant(auto()).meshes([20]).run().unwrap();
    let [smooth, waves] = results.rows() else { panic!("{results:?}") };
    assert!(smooth.is_solved() && waves.is_solved());
    assert!(waves.value(Quantity::MinimumFilm) < smooth.value(Quantity::MinimumFilm));
}

/// Of contestants that take 10 and 20 units of work, one is the best everywhere and the other within a factor of 2.
#[test]
fn pictures_show_verdicts_orders_and_escape_names() {
    let started = Instant::now();
    let cases = Cases::named("battery", 1).unwrap().tagged("smooth").every(5);
    let results = Benchmark::new(cases)
        .contestants([auto(), Contestant::new("<own> & co", |_| Box::new(NewtonKrylov::new()))])
        .meshes([16])
        .tolerances([1e-2, 1e-6])
        .run()
        .unwrap();
    assert!(started.elapsed() < Duration::from_secs(300));
    for svg in [results.stability_map(), results.work_precision(), results.performance_profile()] {
        assert!(svg.contains("&lt;own&gt; &amp; co") && svg.ends_with("</svg>\n"), "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
    let empty = Results::default();
    for svg in [empty.stability_map(), empty.work_precision(), empty.performance_profile()] {
        assert!(svg.starts_with("<svg") && !svg.contains("NaN"), "{svg}");
    }
    assert!(results.summary().contains("takes the fewest convolutions over the"), "{}", results.summary());
}
