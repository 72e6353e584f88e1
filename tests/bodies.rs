//! Bodies: materials of each, and bodies that begin a run with the marks of an earlier one.
#![expect(clippy::float_cmp, reason = "equal histories are equal to the last bit")]

use std::ops::ControlFlow;

use stribeck::Grid;
use stribeck::sim::scene::{Elastic, Flash, Material};
use stribeck::sim::{BodyStart, MixedLubricationSim, RunFolder, Scene, StepRecord, solve_contact, write_npz};
use stribeck::surface::Fixed;
use stribeck::tribochem::ThermalArrhenius;

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(32).with_tribofilm();
    scene.solver.tolerance = 1e-4;
    scene
}

fn run(sim: &mut MixedLubricationSim, steps: u64) -> Vec<StepRecord> {
    let mut records = Vec::new();
    sim.run(steps, 60.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    records
}

#[test]
fn moduli_of_both_bodies_make_the_equivalent_one() {
    let mut scene = scene();
    scene.elastic = Elastic::default();
    scene.materials.ball = Material::default().with_modulus(Some(400e9)).with_poisson(Some(0.2));
    scene.materials.disc = Material::default().with_modulus(Some(210e9)).with_poisson(Some(0.3));
    let expected = 2.0 / ((1.0 - 0.04) / 400e9 + (1.0 - 0.09) / 210e9);
    assert!((scene.equivalent_modulus().unwrap() / expected - 1.0).abs() < 1e-14);
    let mut short = scene.clone();
    short.elastic.equivalent_modulus = scene.equivalent_modulus().unwrap();
    short.materials = Default::default();
    let [pair, short] = [&scene, &short].map(|scene| solve_contact(scene).unwrap());
    assert_eq!(pair.state.pressure, short.state.pressure);
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
}

#[test]
fn the_softer_body_yields() {
    let plastic = |ball: Option<f64>, disc: Option<f64>| {
        let mut scene = scene();
        (scene.tribofilm, scene.wear) = (None, None);
        scene.plastic.as_mut().unwrap().film_hardness = None;
        (scene.materials.ball.hardness, scene.materials.disc.hardness) = (ball, disc);
        let mut sim = MixedLubricationSim::builder(scene.clone()).motion(Fixed).build().unwrap();
        let record = &run(&mut sim, 1)[0];
        let single = solve_contact(&scene).unwrap();
        assert_eq!(single.pressure.max, record.pressure.max);
        let volumes = sim.bodies().each_ref().map(|body| body.plastic_depth().iter().sum::<f64>());
        (record.pressure.max, volumes)
    };
    let (pressure, [ball, disc]) = plastic(Some(3e9), None);
    assert!(pressure == 3e9 && ball > 0.0 && disc == 0.0, "{pressure} {ball} {disc}");
    let (pressure, [ball, disc]) = plastic(Some(9e9), Some(2.5e9));
    assert!(pressure == 2.5e9 && ball == 0.0 && disc > 0.0, "{pressure} {ball} {disc}");
    // One hardness by both ways.
    let (_, both) = plastic(Some(3e9), Some(3e9));
    let mut common = scene();
    (common.tribofilm, common.wear) = (None, None);
    let spec = common.plastic.as_mut().unwrap();
    (spec.hardness, spec.film_hardness) = (3e9, None);
    let mut sim = MixedLubricationSim::builder(common).motion(Fixed).build().unwrap();
    run(&mut sim, 1);
    assert_eq!(both, sim.bodies().each_ref().map(|body| body.plastic_depth().iter().sum::<f64>()));
}

#[test]
fn the_harder_body_wears_less() {
    let mut scene = scene();
    (scene.tribofilm, scene.plastic) = (None, None);
    scene.materials.ball.hardness = Some(12e9);
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let [ball, disc] = run(&mut sim, 2)[1].wear.mean();
    assert!((disc / ball - 2.0).abs() < 1e-9, "{ball} {disc}");
}

#[test]
fn a_body_that_conducts_little_is_hot() {
    let rise = |conductivity: Option<f64>| {
        let mut scene = scene();
        scene.motion.slide_roll_ratio = 1.0;
        scene.thermal.flash = Flash::On;
        scene.materials.ball.conductivity = conductivity;
        let sim = MixedLubricationSim::builder(scene);
        let mut sim = sim.motion(Fixed).build().unwrap();
        (run(&mut sim, 1)[0].flash_rise.unwrap(), sim.flash_estimate())
    };
    let (usual, ceramic) = (rise(None), rise(Some(2.0)));
    assert_eq!(rise(Some(46.0)), usual);
    // Nearly all of the heat goes into the disc.
    assert!(ceramic.0 > 1.4 * usual.0 && ceramic.0 < 2.2 * usual.0, "{ceramic:?} {usual:?}");
    assert!(ceramic.1 > 1.4 * usual.1 && ceramic.1 < 2.2 * usual.1, "{ceramic:?} {usual:?}");
}

#[test]
fn materials_out_of_range_are_named() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene();
        change(&mut scene);
        let error = solve_contact(&scene).unwrap_err().to_string();
        assert_eq!(MixedLubricationSim::builder(scene).build().unwrap_err().to_string(), error);
        error
    };
    let steel = Material::default().with_modulus(Some(210e9)).with_poisson(Some(0.3));
    let pair = |ball: Material, disc: Material| {
        refused(&move |scene| {
            scene.elastic = Elastic::default();
            (scene.materials.ball, scene.materials.disc) = (ball, disc);
        })
    };
    let error = pair(steel, Material::default());
    assert!(error.contains("materials.disc.modulus") && error.contains("missing"), "{error}");
    let error = pair(steel.with_poisson(None), steel);
    assert!(error.contains("materials.ball.poisson"), "{error}");
    let error = pair(steel.with_poisson(Some(0.6)), steel);
    assert!(error.contains("materials.ball.poisson = 0.6"), "{error}");
    let error = pair(steel, steel.with_modulus(Some(-1.0)));
    assert!(error.contains("materials.disc.modulus = -1"), "{error}");
    let error = pair(Material::default(), Material::default());
    assert!(error.contains("elastic.equivalent_modulus"), "{error}");
    let error = refused(&|scene| (scene.materials.ball, scene.materials.disc) = (steel, steel));
    assert!(
        error.contains("elastic.equivalent_modulus = 2.2967e11") && error.contains("only one"),
        "{error}"
    );
    let error = refused(&|scene| scene.materials.disc.hardness = Some(f64::NAN));
    assert!(error.contains("materials.disc.hardness = NaN"), "{error}");
    let error = refused(&|scene| scene.materials.ball.diffusivity = Some(0.0));
    assert!(error.contains("materials.ball.diffusivity = 0"), "{error}");
    let error = refused(&|scene| {
        (scene.plastic, scene.wear) = (None, None);
        scene.materials.ball.hardness = Some(6e9);
    });
    assert!(error.contains("materials.ball.hardness = 6e9"), "{error}");
}

/// The steps after those of an earlier run, from memory and from its archive, are the ones that it would have
/// taken.
#[test]
fn bodies_start_from_the_end_of_another_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut soft = scene();
    soft.plastic.as_mut().unwrap().hardness = 3e9;
    let build = || MixedLubricationSim::builder(soft.clone()).motion(Fixed);
    let mut first = build().build().unwrap();
    let mut files = RunFolder::create(folder.path(), &first, 0).unwrap();
    first.run(2, 60.0, &mut files).unwrap();
    files.finish(&first).unwrap();
    let starts = first.starts();
    let grid = first.grid();
    let read = ["ball", "disc"]
        .map(|name| BodyStart::read_npz(folder.path().join("fields.npz"), name, grid).unwrap());
    assert_eq!(read, starts);
    let volumes = |sim: &MixedLubricationSim| sim.bodies().each_ref().map(|body| body.worn_volume());
    let before = volumes(&first);
    let next = &run(&mut first, 1)[0];
    assert!(next.tribofilm.disc_mean > 0.0 && next.plastic.volume > 0.0, "{next:?}");
    let [ball, disc] = starts;
    let mut second = build().ball_start(ball).disc_start(disc).build().unwrap();
    assert_eq!((second.time(), second.steps()), (0.0, 0));
    assert!(second.ledger_residual().unwrap() < 1e-21);
    let again = &run(&mut second, 1)[0];
    let mut expected = next.clone();
    (expected.step, expected.time) = (0, 60.0);
    // A body that begins a run has worn nothing in it.
    (expected.wear.ball_volume, expected.wear.disc_volume) = (again.wear.ball_volume, again.wear.disc_volume);
    assert_eq!(*again, expected);
    for ((after, before), again) in volumes(&first).iter().zip(before).zip(volumes(&second)) {
        assert!(again > 0.0 && ((after - before) / again - 1.0).abs() < 1e-9, "{after} {before} {again}");
    }
    for (body, old) in second.bodies().iter().zip(first.bodies()) {
        assert_eq!(body.surface(), old.surface());
    }
    // Under another law with other states the thickness is kept.
    let [ball, _] = second.starts();
    let law = ThermalArrhenius::new(200e-9, 1e-3, 0.1).unwrap();
    let third = build().growth_law(law).ball_start(ball).build().unwrap();
    assert_eq!(third.bodies()[0].tribofilm(), second.bodies()[0].tribofilm());
}

#[test]
fn starts_that_do_not_fit_are_named() {
    let grid = scene().grid().unwrap();
    let n = grid.len();
    let start = || BodyStart::new(grid, vec![0.0; n]);
    let refused = |start: BodyStart| {
        MixedLubricationSim::builder(scene()).ball_start(start).build().unwrap_err().to_string()
    };
    // Another count of cells, and as many cells of another size.
    let other = Scene::azam_2019(16).grid().unwrap();
    let error = refused(BodyStart::new(other, vec![0.0; 256]));
    assert!(
        error.contains("ball start") && error.contains("16 x 16") && error.contains("32 x 32"),
        "{error}"
    );
    let wide = Grid::centred(32, 32, 2.0 * grid.dx(), grid.dy()).unwrap();
    let error = refused(BodyStart::new(wide, vec![0.0; n]));
    assert!(error.contains("ball start") && error.contains("3.125e-5 x 1.5625e-5 m"), "{error}");
    let error = refused(start().with_wear(vec![0.0; 7]));
    assert!(error.contains("ball start wear has 7 values, expected 1024"), "{error}");
    let mut depth = vec![0.0; n];
    depth[5] = -1e-9;
    let error = refused(start().with_plastic_depth(depth.clone()));
    assert!(error.contains("ball start plastic depth[0][5] = -1e-9"), "{error}");
    depth[5] = f64::NAN;
    let error = refused(start().with_tribofilm(depth.clone()));
    assert!(error.contains("ball start tribofilm[0][5] = NaN"), "{error}");
    depth[5] = 300e-9;
    let error = refused(start().with_tribofilm(depth.clone()));
    assert!(error.contains("ball start tribofilm = 3") && error.contains("largest thickness"), "{error}");
    let builder = MixedLubricationSim::builder(Scene::azam_2019(32));
    let error = builder.ball_start(start().with_tribofilm(depth)).build().unwrap_err().to_string();
    assert!(error.contains("ball start tribofilm") && error.contains("no tribofilm"), "{error}");
    let builder = MixedLubricationSim::builder(scene()).disc_heights(vec![0.0; n]);
    let error = builder.disc_start(start()).build().unwrap_err().to_string();
    assert!(error.contains("disc start"), "{error}");

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.npz");
    let small = Grid::centred(16, 16, 1e-6, 1e-6).unwrap();
    let read = |name: &str| BodyStart::read_npz(&path, name, grid);
    assert!(read("ball").unwrap_err().to_string().contains("fields.npz"));
    std::fs::write(&path, b"no archive").unwrap();
    assert!(read("ball").unwrap_err().to_string().contains("fields.npz"));
    write_npz(&path, &small, &[("ball_initial", &[0.0; 256])]).unwrap();
    let error = read("disc").unwrap_err().to_string();
    assert!(error.contains("disc_initial"), "{error}");
    let error = read("ball").unwrap_err().to_string();
    assert!(error.contains("ball_initial") && error.contains("16 x 16"), "{error}");
    write_npz(&path, &grid, &[("ball_initial", &vec![1e-9; n])]).unwrap();
    assert_eq!(read("ball").unwrap(), BodyStart::new(grid, vec![1e-9; n]));
}
