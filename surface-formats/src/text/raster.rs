//! Rasters that positions in any order lie on.

/// Distance from the raster up to which a position counts as on it, over the spacing.
const TOLERANCE: f64 = 0.02;
/// Positions closer than this, over their range, are one.
const SAME: f64 = 1e-6;
/// Nodes of a raster for each position that occurs, at most.
const SPARSEST: usize = 16;

/// Equidistant positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    pub(super) first: f64,
    /// Zero of a single position.
    pub(super) spacing: f64,
    pub(super) count: usize,
}

/// Positions that are not equidistant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OffRaster {
    /// Largest distance from the raster.
    pub(super) by: f64,
    /// Spacing of the raster.
    pub(super) spacing: f64,
}

impl Axis {
    /// The raster of finite `positions` that are printed with `decimals` digits.
    pub(super) fn of(positions: &[f64], decimals: i32) -> Result<Self, OffRaster> {
        let mut sorted = positions.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let (Some(&first), Some(&last)) = (sorted.first(), sorted.last()) else {
            return Err(OffRaster { by: f64::NAN, spacing: f64::NAN });
        };
        let places = distinct(&sorted, SAME * (last - first));
        if places.len() == 1 {
            return Ok(Self { first, spacing: 0.0, count: 1 });
        }
        let spacing = spacing_of(&places);
        let axis = Self { first: places[0].0, spacing, count: 1 };
        let (by, nodes) = axis.deviation(&places);
        // half of the last digit is rounding
        let rounding = 0.51 * 10f64.powi(-decimals.clamp(-300, 300));
        let fits = by <= TOLERANCE * spacing + rounding.min(0.5 * spacing);
        if fits && nodes < (SPARSEST * places.len()) as f64 {
            // positions of both ends are the best measure of the spacing
            return Ok(Self { count: nodes as usize + 1, spacing: (last - first) / nodes, ..axis });
        }
        Err(off_raster(positions, axis))
    }

    /// Largest distance of the places from the raster, and intervals up to the last of them.
    fn deviation(&self, places: &[(f64, usize)]) -> (f64, f64) {
        let intervals = |place: f64| ((place - self.first) / self.spacing).round();
        let distance = |place: f64| (place - self.first - intervals(place) * self.spacing).abs();
        let by = places.iter().map(|(place, _)| distance(*place)).fold(0.0, f64::max);
        (by, places.last().map_or(0.0, |(place, _)| intervals(*place)))
    }

    /// Number of the node at `position`.
    pub(super) fn node(&self, position: f64) -> usize {
        if self.count == 1 { 0 } else { ((position - self.first) / self.spacing).round() as usize }
    }
}

/// Places that differ by more than `same`, and how often each occurs.
fn distinct(sorted: &[f64], same: f64) -> Vec<(f64, usize)> {
    let mut places: Vec<(f64, usize)> = Vec::new();
    for position in sorted {
        match places.last_mut() {
            Some((place, count)) if position - *place <= same => *count += 1,
            _ => places.push((*position, 1)),
        }
    }
    places
}

/// Spacing of two places or more: the mean of the smallest gaps between those that occur often.
fn spacing_of(places: &[(f64, usize)]) -> f64 {
    let most = places.iter().map(|(_, count)| *count).max().unwrap_or(1);
    let often: Vec<f64> =
        places.iter().filter(|(_, count)| 2 * count >= most).map(|(place, _)| *place).collect();
    let all: Vec<f64> = places.iter().map(|(place, _)| *place).collect();
    let chosen = if often.len() > 1 { often } else { all };
    let gaps = chosen.windows(2).map(|pair| pair[1] - pair[0]);
    let smallest = gaps.clone().fold(f64::INFINITY, f64::min);
    let (sum, count) =
        gaps.filter(|gap| *gap < 1.5 * smallest).fold((0.0, 0.0), |(s, n), gap| (s + gap, n + 1.0));
    let (rough, length) = (sum / count, chosen[chosen.len() - 1] - chosen[0]);
    length / (length / rough).round().max(1.0)
}

/// How far positions in their order are off the raster that most steps between them suggest.
fn off_raster(positions: &[f64], axis: Axis) -> OffRaster {
    let extremes =
        positions.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
    let steps = positions.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let mut steps: Vec<f64> = steps.filter(|step| *step > 1e-3 * (extremes.1 - extremes.0)).collect();
    steps.sort_unstable_by(f64::total_cmp);
    let spacing = steps.get(steps.len() / 2).copied().unwrap_or(axis.spacing);
    let raster = Axis { spacing, ..axis };
    let places: Vec<(f64, usize)> = positions.iter().map(|position| (*position, 1)).collect();
    OffRaster { by: raster.deviation(&places).0, spacing }
}
