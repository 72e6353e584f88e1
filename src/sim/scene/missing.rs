//! All keys missing from a scene file; the parser reports only the first one.
//!
//! In a given table, the keys required by its kind or law are checked. A missing table is reported if every scene
//! needs it (`form`, `load`, `grid`), if no materials give the moduli (`elastic`), or if there is a lubricant
//! (`motion`).

use toml::Table;

/// Keys of `law = "doolittle_tait"` that have no default.
const DOOLITTLE_TAIT: [&str; 9] =
    ["viscosity", "temperature", "b", "r0", "epsilon", "k0_slope", "k00", "beta", "expansion"];
/// Keys of `law = "thermal_arrhenius"` that have no default.
const THERMAL_ARRHENIUS: [&str; 3] = ["maximum_thickness", "prefactor", "activation_energy"];
/// Keys of `law = "stress_activated"` that have no default.
const STRESS_ACTIVATED: [&str; 5] =
    ["maximum_thickness", "prefactor", "activation_energy", "activation_volume", "stress"];
/// Keys of `law = "proportional_removal"` that have no default.
const PROPORTIONAL_REMOVAL: [&str; 5] =
    ["maximum_thickness", "growth_rate", "activation_energy", "activation_volume", "removal_rate"];
/// Keys of `law = "improved_yasutomi"` that have no default.
const IMPROVED_YASUTOMI: [&str; 8] =
    ["glass_viscosity", "glass_temperature", "a1", "a2", "b1", "b2", "c1", "c2"];

/// Paths of the required keys missing from the tables of `scene`, in document order.
pub(super) fn keys(scene: &Table) -> Vec<String> {
    let mut search = Search { scene, missing: Vec::new() };
    search.bodies();
    search.conditions();
    search.grid();
    search.surfaces();
    search.missing
}

/// Paths of the required keys missing from the tables of a rigid bearing.
pub(in crate::sim) fn bearing_keys(scene: &Table) -> Vec<String> {
    let mut search = Search { scene, missing: Vec::new() };
    search.rigid_bearing();
    search.missing
}

/// Search for missing keys of a scene.
struct Search<'a> {
    scene: &'a Table,
    /// Paths of missing keys.
    missing: Vec<String>,
}

impl<'a> Search<'a> {
    /// The bearing by its kind, and its oil.
    fn rigid_bearing(&mut self) {
        const TABLE: &str = "given_film";
        let position = ["load", "eccentricity"].into_iter().any(|key| self.has(TABLE, key));
        let shape = ["taper", "pivot"].into_iter().any(|key| self.has(TABLE, key));
        let films: &[&str] = match (self.has(TABLE, "load"), shape) {
            (false, false) => &["inlet_film", "outlet_film"],
            (true, false) => &["taper"],
            (true, true) => &[],
            (false, true) => &["load"],
        };
        match self.text(TABLE, "kind") {
            Some("journal") => {
                self.look(TABLE, &["diameter", "width", "clearance", "speed"]);
                self.look(TABLE, if position { &[] } else { &["load"] });
            }
            Some(kind @ ("pad" | "step")) => {
                self.look(TABLE, &["length", "speed"]);
                self.look(TABLE, films);
                self.look(TABLE, if kind == "step" { &["step"] } else { &[] });
            }
            Some(_) => {}
            None => self.look(TABLE, &["kind"]),
        }
        let rough = ["rq", "asperity_number", "rq_over_radius", "equivalent_modulus", "boundary_friction"];
        self.look("given_film.roughness", &rough);
        if !self.scene.contains_key("lubricant") {
            self.missing.push("lubricant".to_owned());
        }
    }

    /// Form and elastic bodies.
    fn bodies(&mut self) {
        let ellipsoid = self.text("form", "kind") == Some("ellipsoid");
        let sections: &[(&'static str, &str)] = if ellipsoid {
            &[("radius_x", "radii_x"), ("radius_y", "radii_y")]
        } else {
            &[("radius", "radii")]
        };
        let mut keys = vec!["kind"];
        keys.extend(sections.iter().filter(|(_, radii)| !self.has("form", radii)).map(|(radius, _)| *radius));
        self.look("form", &keys);
        // Materials may give the modulus; a layer needs either.
        if !self.scene.contains_key("materials") {
            self.look("elastic", &["equivalent_modulus"]);
        }
        let layer: &[&str] = if self.has("elastic.layer", "material") {
            &["thickness"]
        } else {
            &["thickness", "modulus", "poisson"]
        };
        self.look("elastic.layer", layer);
    }

    /// Load, motion and oil.
    fn conditions(&mut self) {
        let loaded = self.has("load", "hertz_pressure") || self.has("schedule", "load");
        self.look("load", if loaded { &[] } else { &["force"] });
        let speeds = ["ball_speed", "disc_speed"].into_iter().any(|key| self.has("motion", key));
        if self.scene.contains_key("lubricant") && !speeds && !self.has("schedule", "entrainment_speed") {
            self.look("motion", &["entrainment_speed"]);
        }
        let law = self.text("lubricant.viscosity", "law");
        let by_data_sheet = ["grade", "kinematic", "viscosity_index", "density", "base_oil"]
            .into_iter()
            .any(|key| self.has("lubricant", key));
        match (self.table("lubricant.viscosity"), law) {
            (None, _) if by_data_sheet => {}
            (None, _) => self.look("lubricant", &["eta0", "roelands_z"]),
            (_, Some("barus")) => self.look("lubricant.viscosity", &["eta0", "alpha"]),
            (_, Some("doolittle_tait")) => self.look("lubricant.viscosity", &DOOLITTLE_TAIT),
            (_, Some("improved_yasutomi")) => self.look("lubricant.viscosity", &IMPROVED_YASUTOMI),
            (_, Some(_)) => {}
            (_, None) => self.look("lubricant.viscosity", &["law"]),
        }
    }

    /// Cells or their accuracy.
    fn grid(&mut self) {
        let row = self.text("form", "kind") == Some("cylinder");
        let row = row && !self.has("grid", "ny") && !self.has("grid", "y");
        let strip = self.text("grid", "across") == Some("periodic");
        let keys: &[&str] = if self.has("grid", "accuracy") {
            &[]
        } else if strip {
            &["nx", "ny", "x"]
        } else if row {
            &["nx", "x"]
        } else {
            &["nx", "ny", "x", "y"]
        };
        self.look("grid", keys);
    }

    /// Roughness, tribofilm and wear.
    fn surfaces(&mut self) {
        for body in ["roughness.ball", "roughness.disc"] {
            let keys: &[&str] = match self.text(body, "kind") {
                Some("gaussian" | "exponential") => &["rq", "length_x", "length_y"],
                Some("self_affine") => &["rq", "hurst", "roll_off"],
                Some("dimples") => &["radius", "depth", "pitch"],
                Some("grooves") => &["width", "depth", "pitch", "direction"],
                Some("file") => &["path"],
                Some(_) => &[],
                None => &["kind"],
            };
            self.look(body, keys);
        }
        self.look("plastic", &["hardness"]);
        let keys: &[&str] = match self.text("tribofilm", "law") {
            Some("stress_activated") => &STRESS_ACTIVATED,
            Some("thermal_arrhenius") => &THERMAL_ARRHENIUS,
            Some("proportional_removal") => &PROPORTIONAL_REMOVAL,
            _ => &[],
        };
        self.look("tribofilm", keys);
        let energy = self.text("wear", "law") == Some("frictional_energy");
        self.look("wear", if energy { &["exposure", "volume_per_energy"] } else { &["exposure"] });
    }

    /// Records the `keys` missing from the table at `path`, or the table itself if every scene needs it.
    fn look(&mut self, path: &str, keys: &[&str]) {
        match self.table(path) {
            Some(given) => {
                let absent = keys.iter().filter(|key| !given.contains_key(**key));
                let absent: Vec<String> = absent.map(|key| format!("{path}.{key}")).collect();
                self.missing.extend(absent);
            }
            None if ["form", "load", "grid", "elastic", "motion"].contains(&path) => {
                self.missing.push(path.to_owned());
            }
            None => {}
        }
    }

    /// The table at a path of names separated by dots.
    fn table(&self, path: &str) -> Option<&'a Table> {
        let mut parts = path.split('.');
        let first = self.scene.get(parts.next()?)?.as_table();
        parts.try_fold(first?, |table, key| table.get(key)?.as_table())
    }

    fn has(&self, table: &str, key: &str) -> bool {
        self.table(table).is_some_and(|table| table.contains_key(key))
    }

    fn text(&self, table: &str, key: &str) -> Option<&'a str> {
        self.table(table)?.get(key)?.as_str()
    }
}
