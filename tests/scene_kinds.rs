//! Tagged tables of scene files: laws, kinds of roughness, forms.
#![expect(clippy::panic, reason = "tests")]

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::scene_text::{assert_names, dry, error_of};
use stribeck::Boundary;
use stribeck::sim::scene::{
    FrictionalEnergySpec, GridSpec, InletSpec, Roughness, RoughnessPair, WearLawSpec, WearSpec,
};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::{
    Autocorrelation, DimpleLayout, Form, GrooveDirection, HeightDistribution, HeightScale, RandomShape,
    RandomSurface, SelfAffine, Synthesis, Texture,
};
use stribeck::tribochem::{
    Activation, ELECTRON_VOLT, ProportionalRemoval, StressActivated, ThermalArrhenius,
};
use stribeck::wear::FrictionalEnergy;

/// A scene with the table `[tribofilm]` or `[wear]` and another law of viscosity.
const LAWS: [&str; 6] = [
    "[tribofilm]\nlaw = \"thermal_arrhenius\"\nmaximum_thickness = \"150 nm\"\nprefactor = 1e9\nactivation_energy = \"0.8 eV\"",
    "[tribofilm]\nlaw = \"stress_activated\"\nstress = \"shear\"\nmaximum_thickness = 2e-7\nprefactor = 1e9\n\
     activation_energy = \"77.2 kJ/mol\"\nactivation_volume = \"0.13 nm^3\"",
    "[tribofilm]\nlaw = \"stress_activated\"\nstress = \"normal\"\nmaximum_thickness = 2e-7\nprefactor = 1e9\n\
     activation_energy = 1.2e-19\nactivation_volume = \"3.8 A^3\"\nactivation = \"pressure\"",
    "[tribofilm]\nlaw = \"proportional_removal\"\nmaximum_thickness = 2e-7\ngrowth_rate = \"0.2 nm/s\"\n\
     activation_energy = 0\nactivation_volume = 0\nremoval_rate = \"0.12 1/min\"",
    "[wear]\nexposure = \"contact_clock\"\nlaw = \"frictional_energy\"\nvolume_per_energy = \"1e-6 mm^3/J\"",
    "[lubricant.viscosity]\nlaw = \"barus\"\neta0 = \"4 mPa s\"\nalpha = \"15 1/GPa\"",
];

/// The laws of the file are those of the crate with the same constants.
#[test]
fn laws_are_taken_by_name() {
    let scenes: Vec<Scene> = LAWS.iter().map(|table| Scene::from_toml(&dry(table)).unwrap()).collect();
    for scene in &scenes {
        assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), *scene);
    }
    let law = |scene: &Scene| format!("{:?}", scene.tribofilm.unwrap().law().unwrap());
    let thermal = ThermalArrhenius::new(150e-9, 1e9, 0.8 * ELECTRON_VOLT).unwrap();
    assert_eq!(law(&scenes[0]), format!("{thermal:?}"));
    let energy = 77.2 * (1e3 / 6.02214076e23);
    let shear = StressActivated::by_shear_stress(2e-7, 1e9, energy, 0.13e-27).unwrap();
    assert_eq!(law(&scenes[1]), format!("{shear:?}"));
    let normal = StressActivated::by_normal_stress(2e-7, 1e9, 1.2e-19, 3.8e-30).unwrap();
    assert_eq!(law(&scenes[2]), format!("{:?}", normal.with_activation(Activation::Pressure)));
    let removal = ProportionalRemoval::new(2e-7, 0.2e-9, 0.0, 0.0, 0.12 * (1.0 / 60.0)).unwrap();
    assert_eq!(law(&scenes[3]), format!("{removal:?}"));
    let wear = scenes[4].wear.unwrap().law(6e9, Some(2e-7)).unwrap();
    assert_eq!(format!("{wear:?}"), format!("{:?}", FrictionalEnergy::new(1e-15, 1e-15, 2e-7).unwrap()));
    assert!(scenes.iter().all(|scene| scene.warnings().is_empty()));
    // A few per cent from Roelands' law of the reference scene.
    let mut oil = Scene::azam_2019(32);
    oil.lubricant = Scene::from_toml(&dry(LAWS[5])).unwrap().lubricant;
    let [film, usual] =
        [oil, Scene::azam_2019(32)].map(|scene| scene.formula_film().unwrap().unwrap().central);
    assert!((film / usual - 1.0).abs() < 0.05, "{film:e} {usual:e}");
}

/// A history with each law: the film grows, the surfaces wear.
#[test]
fn histories_run_with_laws_by_name() {
    for table in &LAWS[..5] {
        let mut scene = Scene::azam_2019(16);
        let laws = Scene::from_toml(&dry(table)).unwrap();
        (scene.tribofilm, scene.wear) = (laws.tribofilm, laws.wear);
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        let record = sim.step(60.0).unwrap();
        let changed = if laws.wear.is_some() { record.wear.mean() } else { record.tribofilm.mean() };
        assert!(changed[0] > 0.0 && changed[1] > 0.0, "{table}: {changed:?}");
    }
}

#[test]
fn laws_name_what_does_not_fit() {
    assert_names(
        &dry("[tribofilm]\nlaw = \"thermal_arrhenius\"\nx_tribo = 1.0"),
        &["x_tribo", "thermal_arrhenius"],
    );
    let missing = "missing keys: `tribofilm.growth_rate`, `tribofilm.activation_energy`, \
                   `tribofilm.activation_volume`, `tribofilm.removal_rate`, `wear.volume_per_energy`";
    let short = "[tribofilm]\nlaw = \"proportional_removal\"\nmaximum_thickness = 1e-7\n[wear]\nexposure = \"track\"\nlaw = \"frictional_energy\"";
    assert!(error_of(&dry(short)).contains(missing), "{}", error_of(&dry(short)));
    assert_names(&dry("[tribofilm]\nlaw = \"linear\""), &["linear", "ghanbarzadeh"]);
    assert_names(&dry("[tribofilm]\nactivation_energy = \"1 GPa\""), &["tribofilm.activation_energy", "eV"]);
    assert_names(&dry("[tribofilm]\nmaximum_thickness = true"), &["maximum_thickness", "expected a number"]);
    assert_names(
        &dry("[wear]\nexposure = \"track\"\nlaw = \"frictional_energy\"\nhardness = 1e9"),
        &["hardness", "frictional_energy"],
    );
    let mut scene = Scene::azam_2019(16);
    let law = FrictionalEnergySpec { volume_per_energy: 1e-15, film_volume_per_energy: 2e-15 };
    scene.wear = Some(WearSpec::azam_2019().with_law(WearLawSpec::FrictionalEnergy(law)));
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.contains("wear.film_volume_per_energy"), "{error}");
}

const DISC: &str = "[roughness.disc]\n";
/// The keys of a generated disc and the heights they give.
fn generated() -> [(&'static str, Roughness); 6] {
    let shape = RandomShape::SelfAffine(SelfAffine {
        hurst: 0.8,
        longest: 2e-4,
        roll_off: 5e-5,
        shortest: 1.5e-5,
        synthesis: Synthesis::RandomPhase,
    });
    let gaussian = RandomShape::Correlated {
        autocorrelation: Autocorrelation::Gaussian,
        length_x: 4e-5,
        length_y: 6e-5,
    };
    let endless = SelfAffine {
        longest: f64::INFINITY,
        shortest: 0.0,
        synthesis: Synthesis::FilteredNoise,
        hurst: 0.7,
        roll_off: 5e-5,
    };
    [
        (
            "kind = \"self_affine\"\nrq = \"50 nm\"\nhurst = 0.8\nroll_off = \"50 um\"\nlongest = 2e-4\nshortest = 1.5e-5\n\
             synthesis = \"random_phase\"\nseed = 3",
            Roughness::Random(RandomSurface::new(shape, 50e-9, 3)),
        ),
        (
            "kind = \"self_affine\"\nrq = 5e-8\nhurst = 0.7\nroll_off = 5e-5\nboundary = \"open\"",
            Roughness::Random(
                RandomSurface::new(RandomShape::SelfAffine(endless), 50e-9, 0).with_boundary(Boundary::Open),
            ),
        ),
        (
            "kind = \"gaussian\"\nrq = 5e-8\nlength_x = 4e-5\nlength_y = 6e-5\nskewness = -1\nkurtosis = 5\nheight = \"ensemble\"",
            Roughness::Random(
                RandomSurface::new(gaussian, 50e-9, 0)
                    .with_height(HeightScale::Ensemble)
                    .with_distribution(HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 }),
            ),
        ),
        (
            "kind = \"dimples\"\nradius = \"60 um\"\ndepth = \"0.2 um\"\npitch = 2.5e-4\nlayout = \"random\"\nseed = 7",
            Roughness::Texture(Texture::Dimples {
                radius: 60e-6,
                depth: 2e-7,
                pitch: 2.5e-4,
                layout: DimpleLayout::Random { seed: 7 },
            }),
        ),
        (
            "kind = \"dimples\"\nradius = 6e-5\ndepth = 2e-7\npitch = 2.5e-4",
            Roughness::Texture(Texture::Dimples {
                radius: 60e-6,
                depth: 2e-7,
                pitch: 2.5e-4,
                layout: DimpleLayout::Square,
            }),
        ),
        (
            "kind = \"grooves\"\nwidth = \"100 um\"\ndepth = 1e-7\npitch = 2.5e-4\ndirection = \"along_y\"",
            Roughness::Texture(Texture::Grooves {
                width: 100e-6,
                depth: 1e-7,
                pitch: 2.5e-4,
                direction: GrooveDirection::AlongY,
            }),
        ),
    ]
}

/// Each kind is the surface of the crate with the same numbers, in the file, in the solve and after a round
/// trip.
#[test]
fn generated_surfaces_are_taken_by_name() {
    for (keys, roughness) in generated() {
        let scene = Scene::from_toml(&dry(&format!("{DISC}{keys}\n"))).unwrap();
        assert_eq!(scene.roughness.disc, roughness, "{keys}");
        assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
        let grid = scene.grid().unwrap();
        let heights = match roughness {
            Roughness::Random(surface) => surface.generate(&grid).unwrap(),
            Roughness::Texture(texture) => texture.generate(&grid).unwrap(),
            _ => panic!("not generated"),
        };
        let sim = MixedLubricationSim::builder(scene).build().unwrap();
        assert!(sim.bodies()[1].initial() == heights, "{keys}");
        assert!(sim.bodies()[1].initial().iter().any(|height| *height != 0.0), "{keys}");
    }
    let drawn = "kind = \"gaussian\"\nrq = 5e-8\nlength_x = 4e-5\nlength_y = 6e-5\ncells = [24, 32]\n";
    let scene = Scene::from_toml(&dry(&format!("{DISC}{drawn}"))).unwrap();
    let Roughness::Random(surface) = &scene.roughness.disc else { panic!("not random") };
    assert_eq!(surface.cells, Some([24, 32]));
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    // A stated default is the default.
    let plain = "kind = \"gaussian\"\nrq = 5e-8\nlength_x = 4e-5\nlength_y = 6e-5\nheight = \"exact\"\nboundary = \"periodic\"\n";
    let scene = Scene::from_toml(&dry(&format!("{DISC}{plain}"))).unwrap();
    let shape = RandomShape::Correlated {
        autocorrelation: Autocorrelation::Gaussian,
        length_x: 4e-5,
        length_y: 6e-5,
    };
    assert_eq!(scene.roughness.disc, Roughness::Random(RandomSurface::new(shape, 5e-8, 0)));
    assert!(scene.to_toml().unwrap().contains("kind = \"gaussian\""));
}

#[test]
fn generated_surfaces_name_what_does_not_fit() {
    let disc = |keys: &str| dry(&format!("{DISC}{keys}\n"));
    for (keys, parts) in [
        ("kind = \"self_affine\"\nrq = 1e-8", ["roughness.disc.hurst", "roughness.disc.roll_off"]),
        ("kind = \"dimples\"\nradius = 1e-5\nrq = 1e-8", ["`rq`", "dimples"]),
        ("kind = \"dimples\"\nradius = 1e-5\ndepth = 1e-7\npitch = 1e-4\nseed = 1", ["`seed`", "dimples"]),
        ("kind = \"grooves\"", ["roughness.disc.pitch", "roughness.disc.direction"]),
        (
            "kind = \"grooves\"\nwidth = 1e-5\ndepth = 1e-7\npitch = 2e-3\ndirection = \"along_x\"",
            ["roughness.disc.pitch", "0.002"],
        ),
        ("kind = \"dimples\"\nradius = -1\ndepth = 1e-7\npitch = 1e-4", ["roughness.disc.radius", "-1"]),
        ("kind = \"self_affine\"\nrq = 1e-8\nhurst = 1.5\nroll_off = 1e-4", ["roughness.disc.hurst", "1.5"]),
        (
            "kind = \"gaussian\"\nrq = 1e-8\nlength_x = 1e-4\nlength_y = 1e-4\nskewness = 1",
            ["kurtosis", "missing"],
        ),
        (
            "kind = \"gaussian\"\nrq = 1e-8\nlength_x = 1e-4\nlength_y = 1e-4\nskewness = 2\nkurtosis = 3",
            ["roughness.disc.kurtosis", "skewness 2"],
        ),
        (
            "kind = \"gaussian\"\nrq = 1e-8\nlength_x = 1e-4\nlength_y = 1e-4\ncells = [24, 1]",
            ["roughness.disc.cells = [24, 1]", "one row"],
        ),
    ] {
        assert_names(&disc(keys), &parts);
    }
    let many =
        Scene::from_toml(&disc("kind = \"self_affine\"\nrq = 5e-8\nhurst = 0.7\nroll_off = 5e-5")).unwrap();
    assert!(many.warnings().iter().any(|warning| warning.message.contains("waves down to any length")));
    let short = disc("kind = \"self_affine\"\nrq = 5e-8\nhurst = 0.7\nroll_off = 5e-5\nshortest = 2e-5");
    let warnings = Scene::from_toml(&short).unwrap().warnings();
    assert!(warnings.iter().any(|warning| warning.field == "grid.nx"), "{warnings:?}");
}

/// An ellipse on 48 x 48 cells whose first axis is turned by `angle`, under 1 GPa.
fn turned(radii: [f64; 2], angle: f64, lubricated: bool) -> Scene {
    let mut scene = Scene::azam_2019(48);
    scene.form = Form::Ellipsoid { radius_x: radii[0], radius_y: radii[1], angle };
    (scene.roughness, scene.plastic, scene.wear) = (RoughnessPair::default(), None, None);
    scene.load.hertz_pressure = Some(1e9);
    scene.motion.entrainment_speed = 1.0;
    let [x, y] = scene.hertz().unwrap().half_extents();
    scene.grid = GridSpec::Cells { nx: 48, ny: 48, x: [-1.8 * x, 1.8 * x], y: [-1.8 * y, 1.8 * y] };
    let oil = scene.lubricant.filter(|_| lubricated);
    scene.lubricant = oil.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    scene
}

/// Entrainment does not act on dry bodies: pressure and approach are those of the Hertz ellipse, turned.
#[test]
fn dry_contact_turns_with_the_ellipse() {
    let scene = turned([1e-2, 3e-2], 0.5, false);
    let (hertz, solution) = (scene.hertz().unwrap(), solve_contact(&scene).unwrap());
    assert!(solution.report.require_converged().is_ok());
    assert!((solution.pressure.max / 1e9 - 1.0).abs() < 5e-3, "{}", solution.pressure.max);
    assert!((solution.contact.area_ratio - 1.0).abs() < 0.05, "{}", solution.contact.area_ratio);
    let (sin, cos) = 0.5_f64.sin_cos();
    for ((x, y), p) in solution.grid.nodes().zip(&solution.state.pressure) {
        let (along, across) =
            ((cos * x + sin * y) / hertz.half_width_x, (cos * y - sin * x) / hertz.half_width_y);
        let inside = 1.0 - along * along - across * across;
        assert!((inside - 1.0 + hertz.radius_squared(x, y)).abs() < 1e-9);
        // Next to the rim the cells are wider than the fall of the pressure.
        if inside.abs() > 0.2 {
            assert!((p / 1e9 - inside.max(0.0).sqrt()).abs() < 0.03, "{x:e} {y:e}: {p:e}, {inside}");
        }
    }
}

/// A turn by a right angle exchanges the radii; one by the other sign is the mirror image; a circle stays as
/// it is.
#[test]
fn film_turns_with_the_ellipse() {
    let solved = |scene: &Scene| {
        let solution = solve_contact(scene).unwrap();
        assert!(solution.report.require_converged().is_ok());
        solution
    };
    let [upright, quarter] = [turned([1e-2, 2e-2], 0.0, true), turned([2e-2, 1e-2], FRAC_PI_2, true)];
    let films = [&upright, &quarter].map(|scene| solved(scene).film.central);
    assert!((films[0] / films[1] - 1.0).abs() < 1e-6, "{films:?}");
    let formulas = [&upright, &quarter].map(|scene| scene.formula_film().unwrap().unwrap().central);
    assert!((formulas[0] / formulas[1] - 1.0).abs() < 1e-9, "{formulas:?}");

    let film = |scene: &Scene| solved(scene).film.central;
    let [left, right] = [0.6, -0.6].map(|angle| solved(&turned([1e-2, 2e-2], angle, true)));
    let nx = left.grid.nx();
    for (row, mirrored) in left.state.film.chunks(nx).zip(right.state.film.chunks(nx).rev()) {
        assert!(row.iter().zip(mirrored).all(|(a, b)| (a / b - 1.0).abs() < 1e-4));
    }
    // The inlet is oblique: films at y and -y differ, those of the upright ellipse do not.
    let lopsided = |solution: &ContactSolution| {
        let [row, mirrored] = [12, 35].map(|j| solution.state.film[j * nx + 20]);
        (row / mirrored - 1.0).abs()
    };
    assert!(lopsided(&left) > 0.02 && lopsided(&solved(&upright)) < 1e-4);
    // The turn changes the film as it changes the formula.
    let formula = turned([1e-2, 2e-2], 0.6, true).formula_film().unwrap().unwrap().central;
    let (ratio, expected) = (left.film.central / films[0], formula / formulas[0]);
    assert!((ratio / expected - 1.0).abs() < 0.03, "{ratio} {expected}");

    let [ball, turned_ball] = [0.0, 1.0].map(|angle| film(&turned([1e-2, 1e-2], angle, true)));
    assert!((ball / turned_ball - 1.0).abs() < 1e-6, "{ball} {turned_ball}");
}

#[test]
fn angles_are_read_with_their_unit() {
    let ellipse = dry("").replace(
        "kind = \"sphere\"\nradius = 9.525e-3",
        "kind = \"ellipsoid\"\nradius_x = 1e-2\nradius_y = 2e-2\nangle = \"30 deg\"",
    );
    let scene = Scene::from_toml(&ellipse).unwrap();
    assert_eq!(scene.form, Form::Ellipsoid { radius_x: 1e-2, radius_y: 2e-2, angle: PI / 6.0 });
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    assert_names(&ellipse.replace("\"30 deg\"", "30"), &["form.angle", "30", "deg"]);
    assert_names(&ellipse.replace("30 deg", "30 mm"), &["form.angle", "30 mm", "rad or deg would do"]);
    assert_names(&ellipse.replace("ellipsoid", "sphere"), &["kind = \"sphere\""]);
    let mut oblique = turned([1e-2, 2e-2], 0.6, true);
    assert!(
        oblique.warnings().iter().any(|warning| warning.message.contains("along an axis of the ellipse"))
    );
    oblique.form = Form::Ellipsoid { radius_x: 1e-2, radius_y: 2e-2, angle: f64::NAN };
    assert!(solve_contact(&oblique).unwrap_err().to_string().contains("form.angle"));
}
