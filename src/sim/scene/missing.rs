//! All keys that a scene file lacks: the parser tells the first alone.
//!
//! A table that is given is looked through for the keys that its kind or law cannot do without; a table that
//! is not given is missing only where every scene has it (`form`, `load`, `grid`), `elastic` where no materials
//! give the moduli, `motion` where there is an oil.

use toml::{Table, Value};

use super::tribofilm::{PROPORTIONAL_REMOVAL, STRESS_ACTIVATED, THERMAL_ARRHENIUS};

/// Keys of `law = "doolittle_tait"` that have no default.
const DOOLITTLE_TAIT: [&str; 9] =
    ["viscosity", "temperature", "b", "r0", "epsilon", "k0_slope", "k00", "beta", "expansion"];
/// Keys of `law = "improved_yasutomi"` that have no default.
const IMPROVED_YASUTOMI: [&str; 8] =
    ["glass_viscosity", "glass_temperature", "a1", "a2", "b1", "b2", "c1", "c2"];

/// Paths of the keys without which the tables of `scene` cannot be read, in the order of the document.
pub(super) fn keys(scene: &Table) -> Vec<String> {
    let mut missing = Vec::new();
    let mut look = |table: &str, keys: &[&str]| match find(scene, table) {
        Some(given) => {
            let absent = keys.iter().filter(|key| !given.contains_key(**key));
            missing.extend(absent.map(|key| format!("{table}.{key}")));
        }
        None if ["form", "load", "grid", "elastic", "motion"].contains(&table) => {
            missing.push(table.to_owned());
        }
        None => {}
    };
    let kind = |table: &str| find(scene, table).and_then(|given| given.get("kind")).and_then(Value::as_str);
    look(
        "form",
        if kind("form") == Some("ellipsoid") {
            &["kind", "radius_x", "radius_y"]
        } else {
            &["kind", "radius"]
        },
    );
    // Materials give the modulus, and a layer stands on either.
    if !scene.contains_key("materials") {
        look("elastic", &["equivalent_modulus"]);
    }
    look("elastic.layer", &["thickness", "modulus", "poisson"]);
    let scheduled = |key: &str| find(scene, "schedule").is_some_and(|schedule| schedule.contains_key(key));
    let loaded = find(scene, "load").is_some_and(|load| load.contains_key("hertz_pressure"));
    look("load", if loaded || scheduled("load") { &[] } else { &["force"] });
    if scene.contains_key("lubricant") && !scheduled("entrainment_speed") {
        look("motion", &["entrainment_speed"]);
    }
    match find(scene, "lubricant.viscosity") {
        None => look("lubricant", &["eta0", "roelands_z"]),
        Some(viscosity) => look(
            "lubricant.viscosity",
            match viscosity.get("law").and_then(Value::as_str) {
                Some("barus") => &["eta0", "alpha"],
                Some("doolittle_tait") => &DOOLITTLE_TAIT,
                Some("improved_yasutomi") => &IMPROVED_YASUTOMI,
                Some(_) => &[],
                None => &["law"],
            },
        ),
    }
    let given = |key: &str| find(scene, "grid").is_some_and(|grid| grid.contains_key(key));
    let row = kind("form") == Some("cylinder") && !given("ny") && !given("y");
    look(
        "grid",
        if given("accuracy") {
            &[]
        } else if row {
            &["nx", "x"]
        } else {
            &["nx", "ny", "x", "y"]
        },
    );
    for body in ["roughness.ball", "roughness.disc"] {
        look(
            body,
            match kind(body) {
                Some("gaussian" | "exponential") => &["rq", "length_x", "length_y"],
                Some("self_affine") => &["rq", "hurst", "roll_off"],
                Some("dimples") => &["radius", "depth", "pitch"],
                Some("grooves") => &["width", "depth", "pitch", "direction"],
                Some("file") => &["path"],
                Some(_) => &[],
                None => &["kind"],
            },
        );
    }
    look("plastic", &["hardness"]);
    let law = |table: &str| find(scene, table).and_then(|given| given.get("law")).and_then(Value::as_str);
    look(
        "tribofilm",
        match law("tribofilm") {
            Some("stress_activated") => &STRESS_ACTIVATED,
            Some("thermal_arrhenius") => &THERMAL_ARRHENIUS,
            Some("proportional_removal") => &PROPORTIONAL_REMOVAL,
            _ => &[],
        },
    );
    look("wear", if law("wear") == Some("frictional_energy") { &["volume_per_energy"] } else { &[] });
    missing
}

/// The table at the path of names with dots between them.
fn find<'a>(scene: &'a Table, path: &str) -> Option<&'a Table> {
    let mut parts = path.split('.');
    let first = scene.get(parts.next()?)?.as_table();
    parts.try_fold(first?, |table, key| table.get(key)?.as_table())
}
