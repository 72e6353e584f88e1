//! What is switched off, halved or doubled.

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
    change("krylov_steps x 0.5", |s| s.krylov_steps /= 2),
    change("krylov_steps x 2", |s| s.krylov_steps *= 2),
    change("largest_change off", |s| s.largest_change = 1e9),
    change("largest_change x 0.5", |s| s.largest_change *= 0.5),
    change("first_contact_film: 1 (no film homotopy)", |s| {
        s.attempt.first_contact_film = 1.0;
    }),
    change("first_contact_film x 2", |s| {
        s.attempt.first_contact_film *= 2.0;
    }),
    change("near_below x 0.1", |s| s.near_below *= 0.1),
    change("near_below x 10", |s| s.near_below *= 10.0),
    change("growth off (no step shortened)", |s| s.attempt.growth = f64::INFINITY),
    change("growth: 1", |s| s.attempt.growth = 1.0),
    change("growth: 4", |s| s.attempt.growth = 4.0),
    change("halvings: 1", |s| s.halvings = 1),
    change("halvings x 2", |s| s.halvings *= 2),
    change("patience x 2", |s| s.patience *= 2),
    change("patience off", |s| s.patience = u64::MAX),
    change("trust x 0.5", |s| s.attempt.trust *= 0.5),
    change("trust x 3", |s| s.attempt.trust *= 3.0),
    change("pseudo_transient off", |s| {
        s.attempt.pseudo_transient = (0.0, 0.0);
    }),
    change("pseudo_transient x 2", |s| {
        s.attempt.pseudo_transient.0 *= 2.0;
    }),
    change("unforeseen x 0.5", |s| s.attempt.unforeseen *= 0.5),
    change("unforeseen off", |s| s.attempt.unforeseen = 1e9),
    change("start_tolerance x 3", |s| {
        s.attempt.start_tolerance *= 3.0;
    }),
    change("start_tolerance x 0.1", |s| {
        s.attempt.start_tolerance *= 0.1;
    }),
    change("krylov_tolerance: 0.03", |s| {
        s.attempt.krylov_tolerance = 0.03;
    }),
    change("krylov_tolerance: 0.01", |s| {
        s.attempt.krylov_tolerance = 0.01;
    }),
    change("krylov_tolerance: 0.3", |s| {
        s.attempt.krylov_tolerance = 0.3;
    }),
    change("pockets off", |s| s.pockets.steps = 0),
    change("pockets.steps x 0.5", |s| s.pockets.steps /= 2),
    change("pockets.steps x 2", |s| s.pockets.steps *= 2),
    change("pockets.side x 0.5", |s| s.pockets.side /= 2),
    change("pockets.side x 2", |s| s.pockets.side *= 2),
    change("pockets.share: 0.8", |s| s.pockets.share = 0.8),
    change("pockets.share: 0.95", |s| s.pockets.share = 0.95),
    change("pockets.most_nodes x 0.5", |s| s.pockets.most_nodes *= 0.5),
    change("pockets.most_nodes x 2", |s| s.pockets.most_nodes *= 2.0),
];
