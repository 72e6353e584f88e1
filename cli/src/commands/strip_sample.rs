//! A note that the random surface of a strip is one sample.

use std::path::Path;

use stribeck::sim::scene::{GridSpec, Roughness, Scene};

/// Surfaces of the suggested sweep, and the difference of their seeds as in `curve`.
const SEEDS: [u64; 4] = [0, 1000, 2000, 3000];

/// The note for the strip of the scene at `path` with the command that compares four surfaces; `None` for other contacts
/// and surfaces.
pub(crate) fn note(scene: &Scene, path: &Path) -> Option<String> {
    let bodies = [("ball", &scene.roughness.ball), ("disc", &scene.roughness.disc)];
    let keys = bodies.into_iter().filter_map(|(body, roughness)| match roughness {
        Roughness::Random(surface) if surface.rq > 0.0 => {
            let seeds = SEEDS.map(|more| surface.seed.wrapping_add(more).to_string());
            Some(format!("--over roughness.{body}.seed={}", seeds.join(",")))
        }
        _ => None,
    });
    let keys: Vec<String> = keys.collect();
    if keys.is_empty() || !matches!(scene.grid, GridSpec::Strip { .. }) {
        return None;
    }
    let side_by_side = if keys.len() > 1 { " --zip" } else { "" };
    Some(format!(
        "one random surface: on strips of five correlation lengths the friction of others scatters by 5 % in a full film and by 14 % in mixed \
         contact;\n           `stribeck sweep {} {}{side_by_side} --out seeds` writes those of four",
        shell_word(&path.display().to_string()),
        keys.join(" ")
    ))
}

/// `text` as one word of a shell: in quotes where it has other characters than those of plain paths.
fn shell_word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+".contains(c);
    if text.chars().all(is_plain) { text.to_owned() } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::shell_word;

    #[test]
    fn paths_are_one_word_of_a_shell() {
        assert_eq!(shell_word("scenes/strip-2.toml"), "scenes/strip-2.toml");
        assert_eq!(shell_word("my strip.toml"), "'my strip.toml'");
        assert_eq!(shell_word("it's.toml"), r"'it'\''s.toml'");
    }
}
