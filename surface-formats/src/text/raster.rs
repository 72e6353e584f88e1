//! Rasters that positions in any order lie on.

/// Distance from the raster up to which a position counts as on it, over the spacing.
const TOLERANCE: f64 = 0.02;
/// Positions closer than this, over their range, are one.
const SAME: f64 = 1e-6;
/// Nodes of a raster for each position that occurs, at most.
const SPARSEST: usize = 16;
/// Half of the last printed digit, with room for the rounding of its binary form.
const HALF_DIGIT: f64 = 0.51;
/// Gaps of a raster that may be where points are missing, in number and as a share of its nodes; the more of them fall
/// where rounded positions of equal distance leave them, the less likely that is.
const FEW_GAPS: usize = 2;
const SMALL_SHARE: usize = 4;
/// Largest mean rounding over the last digit; positions that are rounded evenly have a quarter.
const MEAN_ROUNDING: f64 = 0.4;
/// Steps of the search for the raster of least deviation.
const SEARCH_STEPS: usize = 40;

/// Equidistant positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    pub(super) first: f64,
    /// Zero of a single position.
    pub(super) spacing: f64,
    pub(super) count: usize,
    /// Whether the positions lie on a finer raster with gaps, too.
    pub(super) is_rounded: bool,
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
            return Ok(Self::new(first, 0.0, 1));
        }
        let spacing = spacing_of(&places);
        let axis = Self::new(places[0].0, spacing, 1);
        let (by, nodes) = axis.deviation(&places);
        // half of the last digit is rounding
        let digit = 10f64.powi(-decimals.clamp(-300, 300));
        let fits = by <= TOLERANCE * spacing + (HALF_DIGIT * digit).min(0.5 * spacing)
            && nodes < (SPARSEST * places.len()) as f64;
        let nodes = if fits { nodes as usize + 1 } else { 0 };
        let gaps = nodes.saturating_sub(places.len());
        let has_few_gaps = fits && gaps <= FEW_GAPS && SMALL_SHARE * gaps <= nodes;
        if gaps > 0 && !has_few_gaps || !fits {
            let even = Self::equidistant(&places, digit);
            if let Some(even) = even {
                return Ok(Self { is_rounded: fits, ..even });
            }
        }
        if fits {
            // positions of both ends are the best measure of the spacing
            return Ok(Self::new(axis.first, (last - first) / (nodes - 1) as f64, nodes));
        }
        Err(off_raster(positions, axis))
    }

    /// Exact positions.
    pub(super) fn new(first: f64, spacing: f64, count: usize) -> Self {
        Self { first, spacing, count, is_rounded: false }
    }

    /// As many equidistant positions as there are `places`, all of which are at most half of the last printed digit off
    /// them: the line `first + spacing k` between the ends or, where that fails, of least largest deviation, by a search
    /// over the spacing.
    fn equidistant(places: &[(f64, usize)], digit: f64) -> Option<Self> {
        let intervals = (places.len() - 1) as f64;
        let mean = (places[places.len() - 1].0 - places[0].0) / intervals;
        // lowest and highest distance from the line through zero
        let distances = |spacing: f64| {
            let off = places.iter().enumerate().map(|(k, (place, _))| place - spacing * k as f64);
            off.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| (low.min(d), high.max(d)))
        };
        let width = |spacing: f64| distances(spacing).1 - distances(spacing).0;
        // both ends may be half of a digit off
        let (mut low, mut high) = (mean - digit / intervals, mean + digit / intervals);
        if places.len() < 3 || mean <= digit || width(mean) > 4.0 * HALF_DIGIT * digit {
            return None;
        }
        let mut spacing = mean;
        if width(mean) > 2.0 * HALF_DIGIT * digit {
            for _ in 0..SEARCH_STEPS {
                let third = (high - low) / 3.0;
                if width(low + third) < width(high - third) { high -= third } else { low += third }
            }
            spacing = 0.5 * (low + high);
        }
        let (lowest, highest) = distances(spacing);
        let first = 0.5 * (lowest + highest);
        let off = places.iter().enumerate().map(|(k, (place, _))| (place - first - spacing * k as f64).abs());
        let mean_off = off.sum::<f64>() / places.len() as f64;
        let fits = highest - lowest <= 2.0 * HALF_DIGIT * digit && mean_off <= MEAN_ROUNDING * digit;
        fits.then(|| Self::new(first, spacing, places.len()))
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
        if self.count == 1 { 0 } else { ((position - self.first) / self.spacing).round().max(0.0) as usize }
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
