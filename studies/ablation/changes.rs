//! The settings that are switched off, halved or doubled.

use stribeck::reynolds::NewtonSettings;

/// A change of the settings with its name.
pub(crate) struct Change {
    pub(crate) name: &'static str,
    pub(crate) apply: fn(&mut NewtonSettings),
}

const fn change(name: &'static str, apply: fn(&mut NewtonSettings)) -> Change {
    Change { name, apply }
}

pub(crate) const CHANGES: &[Change] = &[
    change("no continuation", |s| s.least_film_ratio = f64::INFINITY),
    change("first_contact_film: 1 (no film homotopy)", |s| s.first_contact_film = 1.0),
    change("first_contact_film x 2", |s| s.first_contact_film *= 2.0),
    change("warm_start_threshold x 0.1", |s| s.warm_start_threshold *= 0.1),
    change("warm_start_threshold x 10", |s| s.warm_start_threshold *= 10.0),
    change("step_bound x 0.5", |s| s.step_bound *= 0.5),
    change("step_bound x 3", |s| s.step_bound *= 3.0),
    change("pseudo_transient off", |s| s.pseudo_transient = (0.0, 0.0)),
    change("pseudo_transient x 2", |s| s.pseudo_transient.0 *= 2.0),
    change("krylov_tolerance: 0.03", |s| s.krylov_tolerance = 0.03),
    change("krylov_tolerance: 0.01", |s| s.krylov_tolerance = 0.01),
    change("krylov_tolerance: 0.3", |s| s.krylov_tolerance = 0.3),
    change("stall_window x 0.5", |s| s.stall_window /= 2),
    change("stall_window x 2", |s| s.stall_window *= 2),
];
