//! Warnings about loads and speeds that change during one transit of the contact.

use super::{Warning, short};
use crate::sim::scene::Scene;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::time_series::TimeSeries;

/// Largest relative change during one transit.
const LARGEST_CHANGE: f64 = 0.1;

/// The fields of these warnings.
pub(in crate::sim) const QUASI_STATIC: [&str; 2] = ["schedule.load", "schedule.entrainment_speed"];

/// Warnings about scheduled loads and speeds that change by more than [`LARGEST_CHANGE`] while the surfaces pass the Hertz
/// contact once.
pub(super) fn fast_changes(scene: &Scene) -> Vec<Warning> {
    let Ok(operating_schedule) = OperatingSchedule::new(scene) else { return Vec::new() };
    if !scene.is_lubricated() {
        return Vec::new();
    }
    let series = operating_schedule.load_and_speed();
    QUASI_STATIC
        .into_iter()
        .zip(series)
        .filter_map(|(field, series)| fast(scene, &operating_schedule, field, series?))
        .collect()
}

/// The warning about the fastest change of a schedule.
fn fast(
    scene: &Scene,
    operating_schedule: &OperatingSchedule,
    field: &str,
    series: &TimeSeries,
) -> Option<Warning> {
    let entries = series.times().windows(2).zip(series.values().windows(2));
    let changes = entries.filter_map(|(times, values)| {
        let (from, to) = (times[0].max(0.0), times[1]);
        let conditions = operating_schedule.at(from);
        let half_width = scene.hertz_under(conditions.load).ok()?.half_extents()[0];
        let contact_exposure = 2.0 * half_width / conditions.motion.entrainment_speed;
        let change = (values[1] - values[0]).abs() / values[0].abs().max(values[1].abs());
        (to > from).then(|| (change * contact_exposure / (to - from), from, contact_exposure, values[1]))
    });
    let (change, from, contact_exposure, value) = changes.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (change > LARGEST_CHANGE && change.is_finite()).then(|| {
        Warning::new(
            field,
            value,
            format!(
                "after {} s it changes by {:.0} % while the surfaces pass the contact once, in {} s: contacts are quasi-static, the film has \
                 no time to follow",
                short(from),
                100.0 * change,
                short((1e12 * contact_exposure).round() * 1e-12)
            ),
            "slower changes, or `SimBuilder::with_squeeze` and steps shorter than the passage".to_owned(),
        )
    })
}
