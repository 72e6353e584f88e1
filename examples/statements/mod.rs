//! Statements of Azam et al. (2019), as tests of a pair of histories at each tenth of the run. Shared by the
//! examples.

use std::collections::BTreeMap;
use std::ops::{Range, RangeInclusive};

use stribeck::InputError;
use stribeck::metrics::BearingCurve;
use stribeck::sim::{MixedLubricationSim, StepRecord};

/// Parts of a run at whose ends the paper is asked.
pub(crate) const PARTS: usize = 10;
/// Intervals of a bearing curve.
pub(crate) const BEARING_INTERVALS: usize = 200;

/// Results of a history.
#[derive(Debug, Clone, Default)]
pub(crate) struct History {
    pub(crate) records: Vec<StepRecord>,
    /// Film over y at x = 0 in the last step, inside the Hertz contact \[m\].
    pub(crate) profile: Vec<(f64, f64)>,
    /// Heights of the disc's track at even shares of its area \[m\]: by the part of the run at whose end they
    /// were taken, 0 for its start. Parts may be missing.
    pub(crate) bearing: BTreeMap<usize, Vec<f64>>,
}

impl History {
    /// Mean of a number over part `part`, from 1 to [`PARTS`].
    pub(crate) fn mean(&self, part: usize, value: Value) -> f64 {
        let end = |part: usize| part * self.records.len() / PARTS;
        let records = self.records.get(end(part - 1)..end(part)).unwrap_or_default();
        records.iter().map(value).sum::<f64>() / records.len() as f64
    }

    /// A number at the end of part `part`.
    pub(crate) fn at(&self, part: usize, value: Value) -> f64 {
        let last = (part * self.records.len() / PARTS).checked_sub(1);
        last.and_then(|step| self.records.get(step)).map_or(f64::NAN, value)
    }

    /// Positions of the roughness that were passed over because the contact was not solved there.
    pub(crate) fn passed_over(&self) -> u32 {
        self.records.iter().map(|record| record.attempts - 1).sum()
    }
}

/// Heights of a bearing curve of the track \[m\].
///
/// # Errors
/// Heights of another grid, or that are not finite.
pub(crate) fn bearing_heights(sim: &MixedLubricationSim, heights: &[f64]) -> Result<Vec<f64>, InputError> {
    let curve = BearingCurve::new(&sim.track_roughness(heights)?)?;
    Ok((0..=BEARING_INTERVALS).map(|k| curve.height_at(k as f64 / BEARING_INTERVALS as f64)).collect())
}

/// `film` along y through x = 0, inside the Hertz contact.
pub(crate) fn film_profile(sim: &MixedLubricationSim, film: &[f64]) -> Vec<(f64, f64)> {
    let (grid, radius) = (sim.grid(), sim.hertz().half_width_y);
    let inside = (0..grid.ny()).map(|j| grid.y(j)).filter(|y| y.abs() <= radius);
    inside.map(|y| (y, grid.interpolate(film, 0.0, y).unwrap_or(f64::NAN))).collect()
}

/// The same scene and seed with and without tribofilm.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    pub(crate) with: History,
    pub(crate) without: History,
}

/// Share of the pairs and tenths whose answer is yes; none where nothing could be asked.
pub(crate) fn share(statement: &Statement, pairs: &[Pair]) -> Option<f64> {
    let asked = |pair| (1..=PARTS).filter_map(move |part| statement.answer(pair, part));
    let answers: Vec<bool> = pairs.iter().flat_map(asked).collect();
    let yes = answers.iter().filter(|answer| **answer).count();
    (!answers.is_empty()).then(|| yes as f64 / answers.len() as f64)
}

/// A number of a step.
pub(crate) type Value = fn(&StepRecord) -> f64;

/// A statement of the paper: its value at the end of a tenth of the run, from 1 to 10, and of which
/// tenths.
pub(crate) struct Statement {
    pub(crate) text: &'static str,
    parts: RangeInclusive<usize>,
    /// Whether the bearing curves of that tenth are needed.
    curves: bool,
    holds: fn(&Pair, usize) -> bool,
}

impl Statement {
    /// The answer at tenth `part`; none where the statement is not one of it, or its curves are missing.
    pub(crate) fn answer(&self, pair: &Pair, part: usize) -> Option<bool> {
        let known = |history: &History| !self.curves || history.bearing.contains_key(&part);
        let asked = self.parts.contains(&part) && known(&pair.with) && known(&pair.without);
        asked.then(|| (self.holds)(pair, part))
    }
}

/// Relative change from one tenth to the next that counts as none.
const PLATEAU: f64 = 0.05;
/// Pressures that count as near 2 GPa.
const NEAR_2_GPA: Range<f64> = 1.5e9..2.5e9;
/// Hardness of the steel: nodes of the first contact stand at it where an elastic one would exceed it.
const HARDNESS: f64 = 6e9;
/// Share of the initial height within which the peaks of two bearing curves count as the same.
const SAME_PEAKS: f64 = 0.1;

const LAMBDA: Value = |r| r.film.lambda.unwrap_or(f64::NAN);
const LAMBDA_OLD: Value = |r| r.film.formula_lambda.unwrap_or(f64::NAN);
const AREA: Value = |r| r.contact.area_ratio;
const LOAD: Value = |r| r.contact.load_ratio;
const PRESSURE: Value = |r| r.pressure.max;
const WEAR: Value = |r| r.wear.disc_in_contact;

/// A statement of every tenth.
const fn always(text: &'static str, holds: fn(&Pair, usize) -> bool) -> Statement {
    Statement { text, parts: 1..=PARTS, curves: false, holds }
}

/// A statement of the bearing curves of every tenth.
const fn curves(text: &'static str, holds: fn(&Pair, usize) -> bool) -> Statement {
    Statement { text, parts: 1..=PARTS, curves: true, holds }
}

/// A statement about a change from the tenth before, or from the first.
const fn change(text: &'static str, holds: fn(&Pair, usize) -> bool) -> Statement {
    Statement { text, parts: 2..=PARTS, curves: false, holds }
}

/// A statement of the end.
const fn end(text: &'static str, holds: fn(&Pair, usize) -> bool) -> Statement {
    Statement { text, parts: PARTS..=PARTS, curves: false, holds }
}

/// All of them, in the order of the paper's figures.
pub(crate) const STATEMENTS: [Statement; 27] = [
    always("Rq of the ball higher with ZDDP", |p, k| higher(p, k, |r| r.roughness.ball_rq)),
    always("Rq of the disc higher with ZDDP", |p, k| higher(p, k, |r| r.roughness.disc_rq)),
    always("lambda_OLD lower with ZDDP", |p, k| p.with.mean(k, LAMBDA_OLD) < p.without.mean(k, LAMBDA_OLD)),
    change("lambda_OLD keeps rising, with ZDDP", |p, k| rises(&p.with, k, LAMBDA_OLD)),
    change("lambda_OLD keeps rising, without ZDDP", |p, k| rises(&p.without, k, LAMBDA_OLD)),
    always("h_avg higher with ZDDP", |p, k| higher(p, k, |r| r.film.mean_central)),
    always("lambda higher with ZDDP", |p, k| higher(p, k, LAMBDA)),
    change("lambda below its first tenth, with ZDDP", |p, k| below_first(&p.with, k, LAMBDA)),
    change("lambda below its first tenth, without ZDDP", |p, k| below_first(&p.without, k, LAMBDA)),
    change("lambda falls less with ZDDP", |p, k| kept(&p.with, k, LAMBDA) > kept(&p.without, k, LAMBDA)),
    end("the fall of lambda slows down, with ZDDP", |p, _| slows_down(&p.with, LAMBDA)),
    always("area ratio higher with ZDDP", |p, k| higher(p, k, AREA)),
    always("load ratio higher with ZDDP", |p, k| higher(p, k, LOAD)),
    change("area ratio keeps falling, with ZDDP", |p, k| falls(&p.with, k, AREA)),
    change("area ratio keeps falling, without ZDDP", |p, k| falls(&p.without, k, AREA)),
    change("load ratio below its first tenth, with ZDDP", |p, k| below_first(&p.with, k, LOAD)),
    change("load ratio below its first tenth, without ZDDP", |p, k| below_first(&p.without, k, LOAD)),
    end("load ratio at a limit in the end, with ZDDP", |p, k| stands(&p.with, k, LOAD)),
    end("load ratio at a limit in the end, without ZDDP", |p, k| stands(&p.without, k, LOAD)),
    always("wear of the disc lower with ZDDP", |p, k| p.with.at(k, WEAR) < p.without.at(k, WEAR)),
    change("wear of the disc slows down, with ZDDP", |p, k| {
        wear_rate(&p.with, k) < wear_rate(&p.with, k - 1)
    }),
    Statement {
        text: "nodes of the first contact at 6 GPa",
        parts: 1..=1,
        curves: false,
        holds: |p, _| p.without.records.first().is_some_and(|r| r.pressure.max >= HARDNESS * (1.0 - 1e-9)),
    },
    change("largest pressure below its first tenth, with ZDDP", |p, k| below_first(&p.with, k, PRESSURE)),
    end("largest pressure near 2 GPa in the end, with ZDDP", |p, k| {
        NEAR_2_GPA.contains(&p.with.mean(k, PRESSURE))
    }),
    end("film along y thicker with ZDDP", |p, _| profile_mean(&p.with) > profile_mean(&p.without)),
    curves("peaks of the disc's bearing curve the same", same_peaks),
    curves("valleys of the disc's bearing curve hold more with ZDDP", |p, k| {
        valleys(&p.with, k) > valleys(&p.without, k)
    }),
];

fn higher(pair: &Pair, part: usize, value: Value) -> bool {
    pair.with.mean(part, value) > pair.without.mean(part, value)
}

fn rises(history: &History, part: usize, value: Value) -> bool {
    history.mean(part, value) > history.mean(part - 1, value)
}

fn falls(history: &History, part: usize, value: Value) -> bool {
    history.mean(part, value) < history.mean(part - 1, value)
}

fn below_first(history: &History, part: usize, value: Value) -> bool {
    history.mean(part, value) < history.mean(1, value)
}

/// Share of the first tenth that is left.
fn kept(history: &History, part: usize, value: Value) -> f64 {
    history.mean(part, value) / history.mean(1, value)
}

/// Whether it falls, and by less in the second half.
fn slows_down(history: &History, value: Value) -> bool {
    let fall = |from: usize, to: usize| history.mean(from, value) - history.mean(to, value);
    fall(1, PARTS) > 0.0 && fall(PARTS / 2, PARTS) < fall(1, PARTS / 2)
}

fn stands(history: &History, part: usize, value: Value) -> bool {
    let (now, before) = (history.mean(part, value), history.mean(part - 1, value));
    (now - before).abs() <= PLATEAU * before
}

/// Wear of the disc in one tenth.
fn wear_rate(history: &History, part: usize) -> f64 {
    let before = if part > 1 { history.at(part - 1, WEAR) } else { 0.0 };
    history.at(part, WEAR) - before
}

fn profile_mean(history: &History) -> f64 {
    history.profile.iter().map(|point| point.1).sum::<f64>() / history.profile.len() as f64
}

/// Heights that a tenth of the area exceeds differ by little.
fn same_peaks(pair: &Pair, part: usize) -> bool {
    let height = |history: &History, part: usize| {
        history.bearing.get(&part).map_or(f64::NAN, |heights| heights[BEARING_INTERVALS / 10])
    };
    (height(&pair.with, part) - height(&pair.without, part)).abs() <= SAME_PEAKS * height(&pair.without, 0)
}

/// Volume below the mean plane per area.
fn valleys(history: &History, part: usize) -> f64 {
    let heights = history.bearing.get(&part).map(Vec::as_slice).unwrap_or_default();
    heights.iter().map(|height| (-height).max(0.0)).sum::<f64>() / heights.len() as f64
}
