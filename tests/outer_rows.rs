//! Solid contact, wear and tribofilms that reach the edge of the box end a solve or a history.
#![expect(clippy::float_cmp, reason = "tests")]

use std::ops::ControlFlow;

use stribeck::sim::scene::{Exposure, GridSpec, SolverKind, WearLawSpec, WearSpec};
use stribeck::sim::{EdgeQuantity, MixedLubricationSim, Scene, SimError, StepRecord, solve_contact};
use stribeck::wear::WearPressure;

/// The reference scene on cells of 500 um / 48, its box ending `y` from the middle.
fn narrow(rows: usize) -> Scene {
    let mut scene = Scene::azam_2019(48);
    let half = 0.5 * rows as f64 * 500e-6 / 48.0;
    scene.grid = GridSpec::Cells { nx: 48, ny: rows, x: [-250e-6, 250e-6], y: [-half, half] };
    scene
}

#[test]
fn a_lubricated_contact_that_the_box_cuts_is_refused_with_a_box_that_holds_it() {
    let mut scene = narrow(24);
    let Err(SimError::BoxTooSmall(edge)) = solve_contact(&scene) else {
        panic!("the box ends within the contact")
    };
    assert_eq!((edge.quantity, edge.field), (EdgeQuantity::Solids, "grid.y"));
    assert!(edge.value > 1e-3 && edge.y.abs() > 100e-6, "{edge:?}");
    let text = edge.to_string();
    for part in
        ["solid contact", "edge of the box", "grid.y = [", "grid.ny = ", "% of the load", "edge_contact"]
    {
        assert!(text.contains(part), "`{part}` is not in `{text}`");
    }
    // Cells of the same size, and the contact within.
    let GridSpec::Cells { ny, y, .. } = &mut scene.grid else { panic!("cells") };
    (*ny, *y) = (edge.cells, edge.edges);
    let [dy, wide] = [500e-6 / 48.0, scene.grid().unwrap().dy()];
    assert!((wide / dy - 1.0).abs() < 1e-9);
    solve_contact(&scene).unwrap().report.require_converged().unwrap();
}

#[test]
fn a_lubricated_contact_at_the_edge_is_solved_where_the_scene_allows_it() {
    let mut scene = narrow(24);
    scene.solver.edge_contact = true;
    solve_contact(&scene).unwrap().report.require_converged().unwrap();
}

/// Dry and smooth bodies whose wear makes the contact wider than the box, by steps of 10 s until the error.
fn worn_to_the_edge(mut scene: Scene) -> (MixedLubricationSim, Vec<StepRecord>, SimError) {
    scene.solver.kind = SolverKind::Dry;
    scene.lubricant = None;
    scene.roughness = Default::default();
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let mut records = Vec::new();
    let error = sim.run(400, 10.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        ControlFlow::Continue(())
    });
    (sim, records, error.unwrap_err())
}

fn fast_wear(mut scene: Scene) -> Scene {
    let Some(WearSpec { law: WearLawSpec::Archard(law), .. }) = &mut scene.wear else { panic!("by Archard") };
    (law.coefficient, law.film_coefficient) = (3e-6, 3e-6);
    scene
}

#[test]
fn a_groove_that_reaches_the_edge_ends_the_history_and_keeps_its_steps() {
    let (sim, records, error) = worn_to_the_edge(fast_wear(narrow(40)));
    let SimError::BoxTooSmall(edge) = error else { panic!("{error}") };
    assert_eq!(edge.field, "grid.y");
    assert!(records.len() > 5, "{}", records.len());
    assert_eq!((sim.steps(), sim.time()), (records.len() as u64, records.last().unwrap().time));
    // The bodies are those of the last record: the groove is within the box.
    let disc = &sim.bodies()[1];
    assert_eq!(records.last().unwrap().wear.disc_max, disc.wear().iter().copied().fold(0.0, f64::max));
    let profile = sim.worn_profile(disc);
    assert!(profile[0] < 1e-8 && profile[20] > 1e-7, "{profile:?}");
}

/// Along x a body that moves is worn all over its patch; a body at rest has an edge there too.
#[test]
fn columns_count_for_a_body_at_rest_alone() {
    let mut scene = fast_wear(narrow(48));
    scene.grid = GridSpec::Cells { nx: 36, ny: 64, x: [-187.5e-6, 187.5e-6], y: [-333e-6, 333e-6] };
    let mut moving = scene.clone();
    moving.solver.kind = SolverKind::Dry;
    (moving.lubricant, moving.roughness) = (None, Default::default());
    let mut sim = MixedLubricationSim::builder(moving).build().unwrap();
    let records: Vec<StepRecord> = (0..6).map(|_| sim.step(10.0).unwrap()).collect();
    assert!(
        records[5].wear.disc_mean > 0.0 && sim.bodies()[1].wear()[32 * 36] > 0.0,
        "worn in the first column"
    );
    scene.motion.slide_roll_ratio = 2.0;
    let (_, _, error) = worn_to_the_edge(scene);
    let SimError::BoxTooSmall(edge) = error else { panic!("{error}") };
    assert_eq!(edge.field, "grid.x", "{edge}");
}

/// Fluid pressure reaches beyond the solids and wears with `"total"`: a box of 1.04 half-widths across.
#[test]
fn wear_of_the_fluid_pressure_at_the_edge_ends_the_history() {
    let mut scene = narrow(30);
    // Two rows at the edge count from 32 rows on.
    scene.grid = GridSpec::Cells { nx: 48, ny: 36, x: [-250e-6, 250e-6], y: [-156e-6, 156e-6] };
    scene.roughness = Default::default();
    scene.lubricant.as_mut().unwrap().eta0 = 0.04;
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (2.0, 0.5);
    scene.wear = Some(WearSpec::azam_2019().with_pressure(WearPressure::Total));
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let error = sim.step(600.0).unwrap_err();
    let SimError::BoxTooSmall(edge) = error else { panic!("{error}") };
    assert!(matches!(edge.quantity, EdgeQuantity::BallWear | EdgeQuantity::DiscWear), "{edge}");
    assert!(edge.value > 1e-9 && edge.to_string().contains("grid.y"), "{edge}");
    assert_eq!(sim.steps(), 0);
    assert!(sim.bodies().iter().all(|body| body.wear().iter().all(|depth| *depth == 0.0)));
}

/// Few asperities at the edge carry next to no load; their film grows as any.
#[test]
fn a_tribofilm_at_the_edge_ends_the_history() {
    let mut scene = narrow(48).with_tribofilm();
    scene.wear = Some(WearSpec::azam_2019().with_exposure(Exposure::ContactClock));
    let grid = scene.grid().unwrap();
    // A bump on the disc under the last row, which touches by a nanometre or so.
    let top = bump_that_touches(&scene);
    let heights = bumped(&scene, top);
    let mut sim = MixedLubricationSim::builder(scene).disc_heights(heights).build().unwrap();
    let error = sim.step(600.0).unwrap_err();
    let SimError::BoxTooSmall(edge) = error else { panic!("{error}") };
    assert!(matches!(edge.quantity, EdgeQuantity::BallTribofilm | EdgeQuantity::DiscTribofilm), "{edge}");
    assert!(edge.y.abs() > 0.9 * grid.y(47), "{edge}");
}

/// Heights of the disc of `scene`, smooth, with one node in the outermost row raised to `top` \[m\].
fn bumped(scene: &Scene, top: f64) -> Vec<f64> {
    let grid = scene.grid().unwrap();
    let mut heights = vec![0.0; grid.len()];
    heights[47 * 48 + 24] = top;
    heights
}

/// The film over the outermost row, less the contact film: a bump of that height touches.
fn bump_that_touches(scene: &Scene) -> f64 {
    let mut smooth = scene.clone();
    smooth.roughness.disc = stribeck::sim::scene::Roughness::None;
    let solution = solve_contact(&smooth).unwrap();
    solution.state.film[47 * 48 + 24] + 1e-9
}

/// The scene in a box that grows.
fn growing(mut scene: Scene) -> Scene {
    let GridSpec::Cells { nx, ny, x, y } = scene.grid else { panic!("cells") };
    scene.grid = GridSpec::Growing { nx, ny, x, y };
    scene
}

fn dry_and_smooth(mut scene: Scene) -> Scene {
    scene.solver.kind = SolverKind::Dry;
    (scene.lubricant, scene.roughness) = (None, Default::default());
    scene
}

/// A groove that leaves a narrow box is that of a box that was wide from the start.
#[test]
fn a_box_that_grows_wears_as_a_wide_one() {
    let narrow = growing(dry_and_smooth(fast_wear(narrow(40))));
    let mut wide = dry_and_smooth(fast_wear(self::narrow(48)));
    let GridSpec::Growing { nx, x, y, .. } = narrow.grid else { panic!("a box that grows") };
    wide.grid = GridSpec::Cells { nx, ny: 80, x, y: y.map(|edge| 2.0 * edge) };
    let [(narrow, grown), (wide, record)] = [narrow, wide].map(|scene| {
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        let mut last = None;
        for _ in 0..80 {
            last = Some(sim.step(10.0).unwrap());
        }
        (sim, last.unwrap())
    });
    assert_eq!((narrow.grid().nx(), narrow.grid().ny()), (48, 80));
    assert!(narrow.warnings().iter().any(|warning| warning.field == "grid.y"), "{:?}", narrow.warnings());
    for (grown, wide) in narrow.bodies().iter().zip(wide.bodies()) {
        let deepest = wide.wear().iter().copied().fold(0.0, f64::max);
        for (a, b) in grown.wear().iter().zip(wide.wear()) {
            assert!((a - b).abs() < 0.02 * deepest, "{a:e} {b:e}");
        }
    }
    for (grown, wide) in grown.wear.volume().into_iter().zip(record.wear.volume()) {
        assert!((grown / wide - 1.0).abs() < 1e-4, "{grown:e} {wide:e}");
    }
    assert!(narrow.ledger_residual().unwrap() < 1e-20);
}

#[test]
fn a_rough_box_that_grows_keeps_its_surfaces_and_their_rq() {
    let scene = growing(fast_wear(narrow(40)).with_tribofilm());
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let before = sim.bodies()[1].initial().to_vec();
    for _ in 0..400 {
        sim.step(10.0).unwrap();
        if sim.grid().ny() > 40 {
            break;
        }
    }
    let [rows, columns] = [sim.grid().ny(), sim.grid().nx()];
    assert_eq!((rows, columns), (80, 48));
    let disc = &sim.bodies()[1];
    assert_eq!(disc.initial()[20 * 48..60 * 48], before[..]);
    let [whole, beyond] = [disc.initial().to_vec(), disc.initial()[..20 * 48].to_vec()]
        .map(|heights| stribeck::metrics::height_statistics(&heights).unwrap().sq);
    assert!(
        (whole / 130e-9 - 1.0).abs() < 0.1 && (beyond / 130e-9 - 1.0).abs() < 0.2,
        "{whole:e} {beyond:e}"
    );
    assert!(disc.tribofilm().iter().any(|film| *film > 1e-9));
    assert!(sim.ledger_residual().unwrap() < 1e-20);
}

#[test]
fn a_run_that_has_grown_is_resumed_from_its_scene() {
    let scene = growing(dry_and_smooth(fast_wear(narrow(40))));
    let build = || MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let mut sim = build();
    while sim.grid().ny() == 40 {
        sim.step(10.0).unwrap();
    }
    let mut other = build();
    other.restore_checkpoint(&sim.checkpoint().unwrap()).unwrap();
    assert_eq!(other.grid(), sim.grid());
    assert_eq!(other.step(10.0).unwrap(), sim.step(10.0).unwrap());
}

#[test]
fn a_box_that_grows_is_read_and_written() {
    let text = growing(narrow(40)).to_toml().unwrap();
    assert!(text.contains("grows = true"), "{text}");
    assert_eq!(Scene::from_toml(&text).unwrap(), growing(narrow(40)));
    let cells = text.replace("grows = true", "grows = false");
    assert_eq!(Scene::from_toml(&cells).unwrap(), narrow(40));
}

#[test]
fn a_box_that_grows_is_refused_where_heights_are_known_in_one_box() {
    let scene = growing(narrow(40));
    let heights = vec![0.0; 40 * 48];
    let error = MixedLubricationSim::builder(scene).disc_heights(heights).build().unwrap_err().to_string();
    assert!(error.starts_with("grid.grows: disc_heights is known"), "{error}");
    let mut scene = growing(narrow(40));
    let file = stribeck::sim::scene::FileRoughness { path: "disc.npy".into(), rq: None };
    scene.roughness.disc = stribeck::sim::scene::Roughness::File(file);
    let error = MixedLubricationSim::builder(scene).build().unwrap_err().to_string();
    assert!(error.starts_with("grid.grows: a measured surface"), "{error}");
}
