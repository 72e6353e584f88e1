//! Refusal of options without effect on the scene of a kind.

use super::Options;

/// Options of the oil.
pub(super) const OIL: &str = "an oil (--grade, --eta0, --alpha)";

/// Names of the options that describe a scene, and whether each is given. `--viscosity-index` and
/// `--temperature` come with `--grade`.
fn options_given(options: &Options) -> impl Iterator<Item = &'static str> {
    let contact = [
        ("--radius", options.radius.is_some()),
        ("--load", options.load.is_some()),
        ("--speed", options.speed.is_some()),
        ("--slide-roll-ratio", options.slide_roll_ratio.is_some()),
        (OIL, options.grade.is_some() || options.eta0.is_some() || options.alpha.is_some()),
        ("--roughness", options.roughness.is_some()),
        ("--length", options.length.is_some()),
        ("--finish", options.finish.is_some()),
        ("--surface", options.surface.is_some()),
        ("--cells", options.cells.is_some()),
    ];
    let all = contact.into_iter().chain(options.machine.given());
    all.filter_map(|(option, is_given)| is_given.then_some(option))
}

/// Whether no option that describes a scene is given.
pub(super) fn is_empty(options: &Options) -> bool {
    options_given(options).next().is_none()
}

/// Error for a given option that is not among the `used` ones of the kind of scene `name`.
pub(super) fn require_used(options: &Options, name: &str, used: &[&str]) -> Result<(), String> {
    match options_given(options).find(|option| !used.contains(option)) {
        None => Ok(()),
        Some(option) => Err(without_effect(option, &format!("the scene of {name}"))),
    }
}

/// The error about an `option` without effect on `it`.
pub(super) fn without_effect(option: &str, it: &str) -> String {
    format!(
        "{option} has no effect on {it}; leave it out; keys without an option are changed in the scene file"
    )
}
