//! Grooves and holes of the bush of a journal bearing.

use std::f64::consts::{PI, TAU};

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::given_film::{Feed, require_resolved_holes};

/// Cosine of an angle below which it is a right angle up to rounding.
const ROUNDING: f64 = 1e-9;

/// Axial grooves in the middle of the width of the bush.
///
/// In the lands between a groove and the sides its pressure falls linearly to that of the sides. The film begins and ends full, with the pressure of the groove; the groove itself has no friction. The first angle of the list
/// is where the film begins.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Grooves<'a> {
    /// Angles of their middles from the load \[rad\], in the direction of rotation.
    pub angles: &'a [f64],
    /// Width along the circumference \[m\].
    pub width: f64,
    /// Length along the axis \[m\], less than the width of the bearing under a pressure: the flow from a corner of groove
    /// and side is infinite.
    pub length: f64,
    /// Pressure above ambient \[Pa\].
    pub pressure: f64,
}

impl<'a> Grooves<'a> {
    /// Grooves of the `[width, length]` \[m\] and the `pressure` \[Pa\] above ambient at `angles` from the load \[rad\].
    pub const fn new(angles: &'a [f64], [width, length]: [f64; 2], pressure: f64) -> Self {
        Self { angles, width, length, pressure }
    }
}

/// Round holes in the middle of the width of the bush.
///
/// Without [`Grooves`] the film begins and ends full at the axial line through the first hole. Between hole and sides the pressure of this line is
/// that of a film of uniform thickness.
///
/// ```
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{Holes, JournalBearing};
/// let oil = Lubricant::new(Barus::new(0.02, 0.0)?, Incompressible);
/// let bearing = JournalBearing::new([25e-3, 25e-3, 25e-6], 300.0, &oil).with_cells([120, 20]);
/// let hole = Holes::new(&[std::f64::consts::PI], 5e-3, 2e5); // opposite the load
/// let fed = bearing.with_holes(Some(hole)).solve(0.6)?;
/// assert!((fed.hole_flow / fed.film.side_flow - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Holes<'a> {
    /// Angles of their middles from the load \[rad\], in the direction of rotation.
    pub angles: &'a [f64],
    /// Diameter \[m\].
    pub diameter: f64,
    /// Pressure above ambient \[Pa\].
    pub pressure: f64,
}

impl<'a> Holes<'a> {
    /// Holes of a `diameter` \[m\] and the `pressure` \[Pa\] above ambient at `angles` from the load \[rad\].
    pub const fn new(angles: &'a [f64], diameter: f64, pressure: f64) -> Self {
        Self { angles, diameter, pressure }
    }
}

/// Feeds of a film at one attitude angle.
pub(super) struct Supply {
    /// Ends of the film along the circumference \[m\].
    pub(super) ends: [f64; 2],
    /// Holes, and grooves but for the first one. Without grooves the first hole is there twice, at both ends.
    pub(super) feeds: Vec<Feed>,
    /// Number of feeds that are holes; they are first in the list.
    holes: usize,
    /// Diameter of the hole where the film begins \[m\]; 0 where it does not begin at a hole.
    pub(super) end_hole: f64,
    /// Middle and width of the groove where the film begins \[m\].
    pub(super) first_groove: Option<[f64; 2]>,
    /// Distance of grooves from the sides \[m\].
    pub(super) land: f64,
    /// Pressure above ambient where the film begins \[Pa\].
    pub(super) end_pressure: f64,
}

impl Supply {
    /// Sums of the `flows` of feeds: of holes, and of grooves.
    pub(super) fn flows(&self, flows: &[f64]) -> [f64; 2] {
        let holes: f64 = flows.iter().take(self.holes).sum();
        [holes, flows.iter().skip(self.holes).sum()]
    }
}

/// The bush of a journal bearing.
pub(super) struct Bush<'a> {
    pub(super) radius: f64,
    pub(super) width: f64,
    /// Sign of the rotation.
    pub(super) turn: f64,
    pub(super) grooves: Option<Grooves<'a>>,
    pub(super) holes: Option<Holes<'a>>,
}

impl Bush<'_> {
    /// Feeds at the `attitude` angle of the load, which points to the angle `pi - attitude` from the widest gap.
    pub(super) fn supply(&self, attitude: f64) -> Supply {
        let circumference = TAU * self.radius;
        let place = |angle: &f64| self.radius * (PI + self.turn * (angle - attitude));
        let middles: Vec<f64> =
            self.grooves.map_or_else(Vec::new, |grooves| grooves.angles.iter().map(place).collect());
        let width = self.grooves.map_or(0.0, |grooves| grooves.width);
        let land = self.grooves.map_or(0.0, |grooves| 0.5 * (self.width - grooves.length));
        let along = [land, self.width - land];
        let holes: Vec<f64> =
            self.holes.map_or_else(Vec::new, |holes| holes.angles.iter().map(place).collect());
        let first_hole = holes.first().filter(|_| middles.is_empty());
        let start = middles.first().map(|middle| middle + 0.5 * width).or(first_hole.copied()).unwrap_or(0.0);
        let after_start = |middle: f64| start + (middle - start).rem_euclid(circumference);
        let mut feeds = Vec::new();
        if let Some(spec) = self.holes {
            let hole = |x: f64| Feed::hole([x, 0.5 * self.width], spec.diameter, spec.pressure);
            feeds.extend(first_hole.iter().flat_map(|x| [hole(**x), hole(**x + circumference)]));
            let others = holes.iter().skip(usize::from(first_hole.is_some()));
            feeds.extend(others.map(|x| hole(after_start(*x))));
        }
        let count = feeds.len();
        let groove_pressure = self.grooves.map_or(0.0, |grooves| grooves.pressure);
        let at_hole = self.holes.filter(|_| first_hole.is_some());
        feeds.extend(
            middles.iter().skip(1).map(|middle| after_start(*middle)).map(|middle| {
                Feed::new([middle - 0.5 * width, middle + 0.5 * width], along, groove_pressure)
            }),
        );
        Supply {
            ends: [start, start + circumference - width],
            feeds,
            holes: count,
            first_groove: middles.first().map(|middle| [*middle, width]),
            land,
            end_hole: at_hole.map_or(0.0, |holes| holes.diameter),
            end_pressure: at_hole.map_or(groove_pressure, |holes| holes.pressure),
        }
    }

    /// Force of the pressure in the first groove \[N\], over its length and half of that over both lands beside it.
    pub(super) fn force_in_groove(&self, supply: &Supply) -> [f64; 2] {
        let Some([middle, width]) = supply.first_groove else { return [0.0; 2] };
        let length = self.width - supply.land;
        let force = 2.0 * supply.end_pressure * self.radius * length * (0.5 * width / self.radius).sin();
        let (sine, cosine) = (middle / self.radius).sin_cos();
        [force * cosine, force * sine]
    }

    /// The grooves and holes within a right angle of the load, in words; `None` without one.
    pub(super) fn feeds_under_load(&self) -> Option<String> {
        let under = |kind: &str, angles: &[f64]| {
            let angles = angles.iter().filter(|angle| angle.cos() > ROUNDING);
            let degrees = angles.map(|angle| format!("{:.0} deg", angle.to_degrees())).collect::<Vec<_>>();
            (!degrees.is_empty()).then(|| format!("the {kind} at {}", degrees.join(", ")))
        };
        let grooves = self.grooves.and_then(|grooves| under("groove", grooves.angles));
        let holes = self.holes.and_then(|holes| under("hole", holes.angles));
        let found = [grooves, holes].into_iter().flatten().collect::<Vec<_>>();
        (!found.is_empty()).then(|| found.join(" and "))
    }

    /// Error for grooves that are out of range or overlap.
    pub(super) fn validate_grooves(&self) -> Result<(), InputError> {
        let Some(grooves) = self.grooves else { return Ok(()) };
        InputError::require_positive("groove_width", grooves.width)?;
        InputError::require_positive("groove_length", grooves.length)?;
        let fits =
            if grooves.pressure > 0.0 { grooves.length < self.width } else { grooves.length <= self.width };
        InputError::require(
            fits,
            "groove_length",
            grooves.length,
            "below the width of the bearing; without supply_pressure at most that width",
        )?;
        require_pressure(grooves.pressure)?;
        require_angles("groove_angles", grooves.angles)?;
        let mut sorted: Vec<f64> = grooves.angles.iter().map(|angle| angle.rem_euclid(TAU)).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.extend(sorted.first().map(|first| first + TAU));
        if sorted.windows(2).any(|pair| (pair[1] - pair[0]) * self.radius <= 2.0 * grooves.width) {
            return Err(of_angles(
                "groove_angles",
                grooves.angles,
                "the grooves must be apart by more than their width; narrower grooves, or other angles",
            ));
        }
        Ok(())
    }

    /// Error for holes that are out of range, or where the film begins or ends.
    pub(super) fn validate_holes(&self, supply: &Supply, grid: Grid) -> Result<(), InputError> {
        let Some(holes) = self.holes else { return Ok(()) };
        InputError::require(
            holes.diameter > 0.0 && holes.diameter < self.width,
            "hole_diameter",
            holes.diameter,
            "above 0 and below the width of the bearing",
        )?;
        require_pressure(holes.pressure)?;
        require_angles("hole_angles", holes.angles)?;
        let [start, end] = supply.ends;
        let at_ends = if supply.end_hole > 0.0 { 2 } else { 0 };
        let room = if supply.end_hole > 0.0 { 0.5 * holes.diameter } else { 0.0 };
        let mut own = supply.feeds.iter().take(supply.holes).skip(at_ends);
        if own.any(|hole| hole.x[0] <= start + room || hole.x[1] >= end - room) {
            let reason =
                "a hole lies in the first groove or in the first hole; leave it out, or another angle";
            return Err(of_angles("hole_angles", holes.angles, reason));
        }
        require_resolved_holes(supply.feeds.get(..supply.holes).unwrap_or(&[]), holes.diameter, grid)
    }
}

/// Error for a supply pressure below ambient.
fn require_pressure(pressure: f64) -> Result<(), InputError> {
    InputError::require(
        pressure.is_finite() && pressure >= 0.0,
        "supply_pressure",
        pressure,
        "finite and at least 0: it is above ambient",
    )
}

/// Error for angles that are absent or not finite.
fn require_angles(field: &str, angles: &[f64]) -> Result<(), InputError> {
    if angles.is_empty() || !angles.iter().all(|angle| angle.is_finite()) {
        let reason = "must be one or more finite angles from the load, in the direction of rotation";
        return Err(of_angles(field, angles, reason));
    }
    Ok(())
}

fn of_angles(field: &str, angles: &[f64], reason: &str) -> InputError {
    InputError::Conflict { field: format!("{field} = {angles:?} rad"), reason: reason.to_owned() }
}
