//! Bodies by the radii of both, named materials and rates of rotation.

use stribeck::sim::Scene;
use stribeck::sim::scene::{Elastic, Motion, NamedMaterial};
use stribeck::surface::Form;

/// A dry contact of these tables.
fn scene(form: &str, more: &str) -> String {
    let grid = if form.contains("cylinder") {
        "nx = 32\nx = [-2e-4, 2e-4]\n"
    } else {
        "nx = 32\nny = 32\nx = [-2e-4, 2e-4]\ny = [-2e-4, 2e-4]\n"
    };
    format!("[form]\n{form}[load]\nhertz_pressure = 1e9\n[grid]\n{grid}{more}")
}

const STEEL: &str =
    "[materials.ball]\nmaterial = \"steel\"\n[materials.disc]\nmaterial = \"bearing steel\"\n";

#[test]
fn radii_of_both_bodies_give_the_equivalent_radius() {
    let read = |form: &str| Scene::from_toml(&scene(form, STEEL)).unwrap().form.reduced();
    // Two equal rollers have half their radius, a roller in a ring of twice its radius has twice its radius.
    let Form::Cylinder { radius } = read("kind = \"cylinder\"\nradii = [\"10 mm\", \"10 mm\"]\n") else {
        panic!()
    };
    assert!((radius - 5e-3).abs() < 1e-17);
    let Form::Cylinder { radius } = read("kind = \"cylinder\"\nradii = [10e-3, -20e-3]\n") else { panic!() };
    assert!((radius - 20e-3).abs() < 1e-17);
    let Form::Sphere { radius } = read("kind = \"sphere\"\nradii = [\"10 mm\", \"30 mm\"]\n") else {
        panic!()
    };
    assert!((radius - 7.5e-3).abs() < 1e-17);
    // A ball of 12.7 mm diameter on the inner ring of a bearing: convex along the motion, a groove across it.
    let ring =
        "kind = \"ellipsoid\"\nradii_x = [\"6.35 mm\", \"30 mm\"]\nradii_y = [\"6.35 mm\", \"-6.6 mm\"]\n";
    let Form::Ellipsoid { radius_x, radius_y, angle } = read(ring) else { panic!() };
    assert!((radius_x - 1.0 / (1.0 / 6.35e-3 + 1.0 / 30e-3)).abs() < 1e-15 && angle == 0.0);
    assert!((radius_y - 1.0 / (1.0 / 6.35e-3 - 1.0 / 6.6e-3)).abs() < 1e-12);
    let kept = Scene::from_toml(&scene(ring, STEEL)).unwrap();
    assert_eq!(Scene::from_toml(&kept.to_toml().unwrap()).unwrap(), kept);
}

/// A ball in a cup of nearly its radius: at the half-width `a` the gap of parabolas differs from that of circles by
/// `3 a^2/(4 r^2)`. The warning is about the bodies, and the reduced radius of metres is plausible.
#[test]
fn conformal_bodies_warn_by_their_own_radii() {
    let [ball, cup] = [14e-3, 14.04e-3_f64];
    let gap = |r: f64, x: f64| r - (r * r - x * x).sqrt();
    let a = 0.3 * ball;
    let of_parabolas = 0.5 * a * a * (1.0 / ball - 1.0 / cup);
    let of_circles = gap(ball, a) - gap(cup, a);
    assert!((of_circles / of_parabolas - 1.0 - 0.07).abs() < 0.01);

    let form = "kind = \"sphere\"\nradii = [\"14 mm\", \"-14.04 mm\"]\n";
    let mut scene = Scene::from_toml(&scene(form, STEEL)).unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    let mut warned_under = |ratio: f64| {
        scene.load = stribeck::sim::scene::Load::force(1500.0);
        let half_width = scene.hertz().unwrap().half_width_x;
        scene.load = stribeck::sim::scene::Load::force(1500.0 * (ratio * ball / half_width).powi(3));
        let fields: Vec<String> = scene.warnings().into_iter().map(|warning| warning.field).collect();
        (
            fields.iter().any(|field| field == "load.force"),
            fields.iter().any(|field| field.starts_with("form.")),
        )
    };
    assert_eq!(warned_under(0.29), (false, false));
    assert_eq!(warned_under(0.31), (true, false));
}

/// A ball deep in the groove of a ring: the remedy is about the osculation, `6.6/12.7`, and not about a bush.
#[test]
fn groove_of_a_ball_is_described_by_its_osculation() {
    let form =
        "kind = \"ellipsoid\"\nradii_x = [\"6.35 mm\", \"20 mm\"]\nradii_y = [\"6.35 mm\", \"-6.6 mm\"]\n";
    let mut scene = Scene::from_toml(&scene(form, STEEL)).unwrap();
    scene.load = stribeck::sim::scene::Load::hertz_pressure(6e9);
    let warnings = scene.warnings();
    let warning = warnings.iter().find(|warning| warning.field == "load.hertz_pressure").unwrap();
    assert!(warning.remedy.contains("osculation") && warning.remedy.contains("0.5197"), "{warning:?}");
    assert!(!warning.remedy.contains("journal"), "{warning:?}");
}

#[test]
fn named_materials_give_the_modulus_of_the_pair() {
    let scene = Scene::from_toml(&scene("kind = \"sphere\"\nradius = 1e-2\n", STEEL)).unwrap();
    let expected = 2.0 / (0.91 / 206e9 + 0.91 / 207e9);
    assert!((scene.equivalent_modulus().unwrap() / expected - 1.0).abs() < 1e-14);
    for (name, modulus, poisson) in [
        ("silicon nitride", 310e9, 0.27),
        ("Tungsten carbide", 630e9, 0.22),
        ("alumina", 416e9, 0.231),
        ("PTFE", 0.5e9, 0.46),
        ("glass", 70e9, 0.22),
        ("tin-bronze", 113e9, 0.3),
        ("Si3N4", 310e9, 0.27),
        ("Al2O3", 416e9, 0.231),
        ("NBR", 5.5e6, 0.499),
        ("Viton", 7.1e6, 0.499),
        ("CoCr", 210e9, 0.3),
        ("DLC", 259e9, 0.17),
    ] {
        let material: NamedMaterial = name.parse().unwrap();
        assert_eq!((material.modulus(), material.poisson()), (modulus, poisson), "{name}");
        assert_eq!(material.to_string().parse::<NamedMaterial>().unwrap(), material);
    }
}

#[test]
fn named_layer_has_the_constants_of_its_material() {
    let layer = "[elastic.layer]\nthickness = \"2 um\"\nmaterial = \"PEEK\"\n";
    let scene =
        Scene::from_toml(&scene("kind = \"sphere\"\nradius = 1e-2\n", &format!("{STEEL}{layer}"))).unwrap();
    let found = scene.elastic.layer.unwrap();
    assert_eq!((found.modulus, found.poisson), (3.7e9, 0.4));
    assert_ne!(scene.elastic, Elastic::default());
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
}

#[test]
fn surface_speeds_give_entrainment_and_slide_roll_ratio() {
    let motion = |table: &str| {
        let text = scene("kind = \"sphere\"\nradius = 1e-2\n", &format!("{STEEL}[motion]\n{table}"));
        Scene::from_toml(&text).map(|scene| scene.motion).map_err(|error| error.to_string())
    };
    // A ball of 19.05 mm at 300 rpm on a track of 42 mm radius at 60 rpm.
    let found = motion("ball_speed = \"300 rpm on 19.05 mm\"\ndisc_speed = \"60rpm on 84 mm\"\n").unwrap();
    let [ball, disc] = [std::f64::consts::PI * 5.0 * 19.05e-3, std::f64::consts::PI * 84e-3];
    let [u1, u2] = found.surface_speeds();
    assert!((u1 - ball).abs() < 1e-15 && (u2 - disc).abs() < 1e-15, "{found:?}");
    assert_eq!(motion("ball_speed = 0.3\ndisc_speed = 0.3\n").unwrap(), Motion::new(0.3, 0.0));
    assert_eq!(motion("ball_speed = 0.4\ndisc_speed = 0.0\n").unwrap(), Motion::new(0.2, 2.0));
    for (table, parts) in [
        ("ball_speed = 0.3\n", ["disc_speed", "missing"]),
        ("ball_speed = 0.3\ndisc_speed = 0.3\nslide_roll_ratio = 0.0\n", ["replace", "slide_roll_ratio"]),
        ("ball_speed = 0.3\ndisc_speed = -0.3\n", ["mean 0", "disc_speed"]),
        ("ball_speed = \"300 rpm\"\ndisc_speed = 0.3\n", ["motion.ball_speed", "1500 rpm on 40 mm"]),
        ("ball_speed = \"300 rpm on 5\"\ndisc_speed = 0.3\n", ["motion.ball_speed", "unit is missing"]),
        ("ball_speed = \"300 rpm on -5 mm\"\ndisc_speed = 0.3\n", ["motion.ball_speed", "> 0"]),
    ] {
        let error = motion(table).unwrap_err();
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
}

#[test]
fn wrong_bodies_are_refused_with_a_remedy() {
    let concave = Scene::from_toml(&scene("kind = \"sphere\"\nradius = \"-10 mm\"\n", STEEL)).unwrap();
    let error = concave.hertz().unwrap_err().to_string();
    assert!(error.contains("form.radius = -0.01") && error.contains("`radii`"), "{error}");
    let sphere = "kind = \"sphere\"\nradius = 1e-2\n";
    for (form, more, parts) in [
        ("kind = \"sphere\"\nradii = [1e-2, -1e-2]\n", STEEL, ["radii", "negative radius that is larger"]),
        ("kind = \"sphere\"\nradii = [2e-2, -1e-2]\n", STEEL, ["radii", "negative radius that is larger"]),
        ("kind = \"sphere\"\nradii = [0.0, 1e-2]\n", STEEL, ["radii", "above 0"]),
        ("kind = \"sphere\"\nradii = [1e-2]\n", STEEL, ["radii", "both bodies"]),
        ("kind = \"sphere\"\nradii = [1e-2, 1e-2]\nradius = 1e-2\n", STEEL, ["radii", "only one"]),
        ("kind = \"sphere\"\nradii = [\"1 kg\", 1e-2]\n", STEEL, ["form.radii[0]", "length"]),
        (
            sphere,
            "[materials.ball]\nmaterial = \"silicon\"\n",
            ["materials.ball.material", "silicon_nitride"],
        ),
        (sphere, "[materials.disc]\nmaterial = \"stell\"\n", ["materials.disc.material", "steel"]),
        (sphere, "[materials.disc]\nmaterial = 3\n", ["materials.disc.material", "text"]),
        ("kind = \"sphere\"\n", STEEL, ["radius", "missing"]),
    ] {
        let error = Scene::from_toml(&scene(form, more)).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
}
