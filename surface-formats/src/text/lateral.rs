//! Lengths along x and y.

use super::header::Header;
use super::raster::Axis;
use crate::error::Error;
use crate::source::Source;
use crate::unit::LengthUnit;

/// Lengths along x and y.
pub(super) struct Lateral {
    /// Distances of the points \[m\].
    pub(super) spacing: [f64; 2],
    /// Whether their unit is not known.
    pub(super) is_unit_missing: bool,
    /// Whether a length has the unit that the header gives for all.
    pub(super) takes_common_unit: bool,
}

impl Lateral {
    /// The lengths that the header gives for a matrix of this size.
    pub(super) fn of_header(
        source: Source<'_>,
        header: &Header,
        size: [usize; 2],
    ) -> Result<Option<Self>, Error> {
        let (spacing, is_unit_missing) = header.spacings(source, size)?;
        let takes_common_unit = header.lengths_take_common_unit();
        Ok(spacing.map(|spacing| Self { spacing, is_unit_missing, takes_common_unit }))
    }
}

/// Spacings of positions along `axes` whose titles give `units`; that of a single row or column is the one of the other
/// axis.
pub(super) fn lateral_of(
    source: Source<'_>,
    header: &Header,
    axes: [Axis; 2],
    units: [Option<LengthUnit>; 2],
) -> Result<Option<Lateral>, Error> {
    let found = [header.position_unit(source, 0, units[0])?, header.position_unit(source, 1, units[1])?];
    let metres = |k: usize| axes[k].spacing.abs() * found[k].map_or(1.0, LengthUnit::metres);
    let several = [0, 1].map(|k| axes[k].count > 1);
    let spacing = match several {
        [true, true] => [metres(0), metres(1)],
        [true, false] => [metres(0), metres(0)],
        [false, true] => [metres(1), metres(1)],
        [false, false] => return Ok(None),
    };
    let any = |is: fn(Option<LengthUnit>) -> bool, of: [Option<LengthUnit>; 2]| {
        (0..2).any(|k| several[k] && is(of[k]))
    };
    let is_unit_missing = any(|unit| unit.is_none(), found);
    let takes_common_unit = any(|unit| unit.is_none(), units) && header.has_no_lateral_unit();
    Ok(Some(Lateral { spacing, is_unit_missing, takes_common_unit }))
}
