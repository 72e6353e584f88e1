//! What the paper says, as questions to a pair of histories.

use crate::history::History;

/// The same seed and choices with and without tribofilm.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    pub(crate) with: History,
    pub(crate) without: History,
}

/// A statement of the paper.
pub(crate) struct Statement {
    pub(crate) text: &'static str,
    pub(crate) holds: fn(&Pair) -> bool,
}

/// Relative change that still counts as a plateau.
const PLATEAU: f64 = 0.05;
/// Pressures that count as near 2 GPa.
const NEAR_2_GPA: std::ops::Range<f64> = 1.5e9..2.5e9;
/// Limit of the first contact: nodes stand at it where an elastic contact would exceed it.
const FIRST_LIMIT: f64 = 6e9;

/// All of them; what scatters is the mean over the first or last steps.
pub(crate) const STATEMENTS: [Statement; 17] = [
    Statement { text: "Rq of the ball higher with film", holds: |p| higher_last(p, "rq_ball_m") },
    Statement { text: "composite Rq higher with film", holds: |p| higher_last(p, "rq_composite_m") },
    Statement { text: "h_avg higher with film", holds: |p| higher(p, "h_avg_m") },
    Statement { text: "lambda higher with film", holds: |p| higher(p, "lambda") },
    Statement {
        text: "lambda_OLD lower with film",
        holds: |p| p.with.last("lambda_old") < p.without.last("lambda_old"),
    },
    Statement { text: "lambda_OLD rises in time, with film", holds: |p| rises(&p.with, "lambda_old") },
    Statement { text: "lambda_OLD rises in time, without film", holds: |p| rises(&p.without, "lambda_old") },
    Statement { text: "lambda falls in time, with film", holds: |p| falls(&p.with, "lambda") },
    Statement { text: "lambda falls in time, without film", holds: |p| falls(&p.without, "lambda") },
    Statement {
        text: "wear of the disc lower with film",
        holds: |p| p.with.last("track_wear_disc_m") < p.without.last("track_wear_disc_m"),
    },
    Statement {
        text: "largest pressure first at the 6 GPa that an elastic contact exceeds",
        holds: |p| p.without.first("max_pressure_pa") >= FIRST_LIMIT * (1.0 - 1e-9),
    },
    Statement {
        text: "largest pressure near 2 GPa in the end, with film",
        holds: |p| NEAR_2_GPA.contains(&p.with.end("max_pressure_pa")),
    },
    Statement {
        text: "load ratio reaches a plateau, with and without film",
        holds: |p| [&p.with, &p.without].iter().all(|history| flat(history, "load_ratio")),
    },
    Statement { text: "area ratio falls in time, with film", holds: |p| falls(&p.with, "area_ratio") },
    Statement { text: "area ratio falls in time, without film", holds: |p| falls(&p.without, "area_ratio") },
    Statement { text: "area ratio higher with film", holds: |p| higher(p, "area_ratio") },
    Statement { text: "load ratio higher with film", holds: |p| higher(p, "load_ratio") },
];

fn higher(pair: &Pair, column: &str) -> bool {
    pair.with.end(column) > pair.without.end(column)
}

fn higher_last(pair: &Pair, column: &str) -> bool {
    pair.with.last(column) > pair.without.last(column)
}

fn rises(history: &History, column: &str) -> bool {
    history.end(column) > history.start(column)
}

fn falls(history: &History, column: &str) -> bool {
    history.end(column) < history.start(column)
}

fn flat(history: &History, column: &str) -> bool {
    let (end, before) = (history.end(column), history.before_last_quarter(column));
    (end - before).abs() <= PLATEAU * before.abs()
}
