//! All keys that a scene file lacks: the parser tells the first alone.

use toml::{Table, Value};

/// Paths of the keys without which the tables of `scene` cannot be read, in the order of the document.
pub(super) fn keys(scene: &Table) -> Vec<String> {
    let mut missing = Vec::new();
    let mut look = |table: &str, keys: &[&str]| match find(scene, table) {
        Some(given) => {
            let absent = keys.iter().filter(|key| !given.contains_key(**key));
            missing.extend(absent.map(|key| format!("{table}.{key}")));
        }
        None if ["form", "load", "grid"].contains(&table) => missing.push(table.to_owned()),
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
    look("elastic", &["equivalent_modulus"]);
    look("load", &[]);
    look("lubricant", &["eta0", "roelands_z"]);
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
                Some("file") => &["path"],
                Some(_) => &[],
                None => &["kind"],
            },
        );
    }
    look("plastic", &["hardness"]);
    missing
}

fn find<'a>(scene: &'a Table, path: &str) -> Option<&'a Table> {
    let mut parts = path.split('.');
    let first = scene.get(parts.next()?)?.as_table();
    parts.try_fold(first?, |table, key| table.get(key)?.as_table())
}
