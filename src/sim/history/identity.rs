//! Identity of a simulation, to compare a checkpoint with the simulation that restores it.
//!
//! A checkpoint holds the identity of its run. A simulation that resumes compares it part by part and names the
//! parts that differ. Scenes are compared as files with all defaults, custom laws by their `Debug` output,
//! custom elastic bodies by their response and solvers by their name. [`CONDITIONS`] lists the parts that may
//! differ under other conditions.

use toml::{Table, Value};

use crate::sim::scene::{GridSpec, Scene};

/// Parts that a run may change when it continues under other conditions.
pub(in crate::sim) const CONDITIONS: [&str; 11] = [
    "scene.load",
    "scene.motion",
    "scene.lubricant",
    "scene.friction",
    "scene.thermal",
    "scene.schedule",
    "scene.solver",
    "boundary friction",
    "viscosity law",
    "density law",
    "solver",
];
/// Version of this description.
const VERSION: u32 = 1;
/// Largest number of lines of a description in an error.
const MOST_LINES: usize = 4;

/// Description of a run: its scene as a scene file, and the custom components.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(in crate::sim) struct Identity {
    /// Version of this description.
    version: u32,
    /// The scene as a file.
    scene: String,
    /// Other parts that a run depends on: name and description.
    parts: Vec<(String, String)>,
}

impl Identity {
    /// The identity of a `scene` file and of named parts.
    pub(super) fn new(scene: String, parts: Vec<(String, String)>) -> Self {
        Self { version: VERSION, scene, parts }
    }

    /// The grid of the scene.
    pub(in crate::sim) fn grid(&self) -> Option<GridSpec> {
        Scene::from_toml(&self.scene).ok().map(|scene| scene.grid)
    }

    /// Differences of laws: the lines of their descriptions that are not in both.
    pub(in crate::sim) fn details(&self, saved: &Self) -> String {
        let mut details = Vec::new();
        for (name, words) in &self.parts {
            let Some((_, then)) = saved.parts.iter().find(|part| part.0 == *name && part.1 != *words) else {
                continue;
            };
            let lacks = |text: &str, other: &str| -> Vec<String> {
                let lines = text.lines().filter(|line| !other.lines().any(|other| other == *line));
                // the last line closes the bracket behind the name of the law
                let closes = |line: &str| line.matches(')').count() > line.matches('(').count();
                let plain =
                    |line: &str| line.strip_suffix(')').filter(|_| closes(line)).unwrap_or(line).to_owned();
                lines.take(MOST_LINES).map(plain).collect()
            };
            let (here, there) = (lacks(words, then).join(", "), lacks(then, words).join(", "));
            details.push(format!("{name}: here {here}; in the file {there}"));
        }
        details.join("; ")
    }

    /// Names of the parts that differ.
    pub(in crate::sim) fn differences(&self, other: &Self) -> Vec<String> {
        if self.version != other.version {
            return vec!["description".to_owned()];
        }
        let (own, others) = (tables(&self.scene), tables(&other.scene));
        let mut names: Vec<&String> =
            own.keys().chain(others.keys().filter(|key| !own.contains_key(*key))).collect();
        names.retain(|key| own.get(*key) != others.get(*key));
        let of_scene = names.into_iter().map(|key| format!("scene.{key}"));
        let differ = self.parts.iter().filter(|part| !other.parts.contains(part));
        of_scene.chain(differ.map(|(name, _)| name.clone())).collect()
    }
}

/// The tables of a scene file with all defaults of this version, so that keys unknown to an earlier version make
/// no difference; the plain text if this version cannot read the scene.
fn tables(scene: &str) -> Table {
    let full = Scene::from_toml(scene).and_then(|scene| scene.to_toml());
    let text = full.as_deref().unwrap_or(scene);
    text.parse().unwrap_or_else(|_| Table::from_iter([("file".to_owned(), Value::from(text))]))
}

/// Custom components by their `Debug` output.
#[derive(Debug, Default, Clone)]
pub(in crate::sim) struct CustomIdentity(pub(super) Vec<(&'static str, String)>);

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(scene: &str) -> Identity {
        Identity { version: VERSION, scene: scene.to_owned(), parts: Vec::new() }
    }

    #[test]
    fn missing_keys_of_an_older_scene_equal_their_defaults() {
        let full = Scene::azam_2019(32).to_toml().unwrap_or_default();
        let short = full.replace("max_iterations = 20000\n", "");
        assert!(short.len() < full.len());
        assert!(identity(&full).differences(&identity(&short)).is_empty());
        let other = full.replace("max_iterations = 20000\n", "max_iterations = 7\n");
        assert_eq!(identity(&full).differences(&identity(&other)), ["scene.solver"]);
        let later = Identity { version: VERSION + 1, ..identity(&full) };
        assert_eq!(identity(&full).differences(&later), ["description"]);
        // Text that is not a scene is compared as it is.
        assert_eq!(identity("a = 1").differences(&identity("a = 2")), ["scene.a"]);
    }
}
