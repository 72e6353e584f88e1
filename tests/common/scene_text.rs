//! Scenes as text, and the errors of invalid ones.

use stribeck::sim::{Scene, SimError, solve_contact};

/// A dry scene on a small grid, with one line per key and `extra` at the end.
pub(crate) fn dry(extra: &str) -> String {
    let head = "[form]\nkind = \"sphere\"\nradius = 9.525e-3\n[elastic]\nequivalent_modulus = 229.67e9\n\
                [load]\nhertz_pressure = 1.15e9\n[grid]\nnx = 16\nny = 16\n\
                x = [-0.25e-3, 0.25e-3]\ny = [-0.25e-3, 0.25e-3]\n";
    format!("{head}{extra}")
}

pub(crate) fn error_of(text: &str) -> String {
    let error = Scene::from_toml(text).and_then(|scene| solve_contact(&scene)).unwrap_err();
    assert!(!matches!(error, SimError::Reynolds(_)), "{error}");
    error.to_string()
}

pub(crate) fn assert_names(text: &str, parts: &[&str]) {
    let message = error_of(text);
    assert!(!message.contains('\n'), "{message}");
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in `{message}`");
    }
}
