//! Units, scales and spacings that follow from a header.

use super::{AGREEMENT, Given, Header, HeightScale, Length, LengthUnit, MOST_KEYS, Source, without_unit};
use crate::error::Error;

impl Header {
    /// Number of points along x and y, where given.
    pub(in crate::text) fn counts(&self) -> [Option<usize>; 2] {
        [0, 1].map(|axis| self.counts[axis].as_ref().map(|given| given.value))
    }

    /// Whether the header states lengths or counts of a matrix.
    pub(in crate::text) fn describes_matrix(&self) -> bool {
        self.counts.iter().any(Option::is_some)
            || self.sizes.iter().any(Option::is_some)
            || self.spacings.iter().any(Option::is_some)
    }

    /// Unit of the heights and metres per stored number; `title` is the unit in the title of their column.
    pub(in crate::text) fn heights(
        &self,
        source: Source<'_>,
        title: Option<LengthUnit>,
    ) -> Result<HeightScale, Error> {
        let scale_data = self.scale_data.filter(|_| self.scale_data_needed != Some(false)).unwrap_or(1.0);
        let factor = scale_data * self.factor.unwrap_or(1.0);
        if let Some(unit) = self.factor_unit {
            let metres = factor * unit.metres();
            return Ok(HeightScale { unit: Some(LengthUnit::of_length(metres).unwrap_or(unit)), metres });
        }
        let own = match &self.height_unit {
            Some(given) => Some(source.unit(&given.value, "height")?),
            None => None,
        };
        if let (Some(title), Some(own), Some(given)) = (title, own, &self.height_unit)
            && title != own
        {
            let what = format!("{} = {own} contradicts the unit {title} of the title", given.key);
            return Err(source.corrupt(what));
        }
        if let (Some(own), Some(given), Some(unit)) = (own, &self.height_unit, &self.unit)
            && unit.value != own
            && self.describes_matrix()
            && !self.lengths_take_common_unit()
        {
            let (first, second) = (&given.key, &unit.key);
            let what = format!("{second} = {} contradicts {first} = {own}; leave one of them", unit.value);
            return Err(source.corrupt(what));
        }
        let unit = title.or(own).or(self.unit.as_ref().map(|given| given.value));
        if let (None, Some(nanometres)) = (unit, self.nanometres) {
            let unit = Some(LengthUnit::Nanometre);
            return Ok(HeightScale { unit, metres: factor * nanometres * 1e-9 });
        }
        let unit = unit.or(source.options.unit);
        Ok(HeightScale { unit, metres: factor * unit.map_or(1.0, LengthUnit::metres) })
    }

    /// Spacings \[m\] of `counts` points along x and y where they are given, and whether a unit is missing.
    pub(in crate::text) fn spacings(
        &self,
        source: Source<'_>,
        counts: [usize; 2],
    ) -> Result<(Option<[f64; 2]>, bool), Error> {
        let found = [self.spacing(source, 0, counts[0])?, self.spacing(source, 1, counts[1])?];
        match found {
            [Some((dx, a)), Some((dy, b))] => Ok((Some([dx, dy]), a || b)),
            [None, None] => Ok((None, false)),
            // of a profile the one across does not matter
            [Some((dx, missing)), None] if counts[1] == 1 => Ok((Some([dx, dx]), missing)),
            _ => Err(source.corrupt("the header gives the size along one axis only".to_owned())),
        }
    }

    /// Spacing \[m\] of `points` along an axis, and whether its unit is missing.
    fn spacing(&self, source: Source<'_>, axis: usize, points: usize) -> Result<Option<(f64, bool)>, Error> {
        let size = self.metres(source, axis, self.sizes[axis].as_ref())?;
        let spacing = self.metres(source, axis, self.spacings[axis].as_ref())?;
        if let (Some((size, _)), Some((spacing, _))) = (size, spacing) {
            // some programs count the length from the first point to the last
            let fits = [points, points.saturating_sub(1)]
                .into_iter()
                .any(|shares| (spacing * shares as f64 / size - 1.0).abs() < AGREEMENT);
            if let (false, Some(first), Some(second)) = (fits, &self.sizes[axis], &self.spacings[axis]) {
                return Err(source.corrupt(format!(
                    "{} = {size:.6e} m contradicts {} = {spacing:.6e} m with {points} points; leave one of them",
                    first.key, second.key
                )));
            }
        }
        Ok(spacing.or(size.map(|(size, missing)| (size / points as f64, missing))))
    }

    /// A length in metres, and whether its unit is missing.
    fn metres(
        &self,
        source: Source<'_>,
        axis: usize,
        length: Option<&Given<Length>>,
    ) -> Result<Option<(f64, bool)>, Error> {
        let Some(Given { value: Length { value, unit, default }, key }) = length else { return Ok(None) };
        let axis_unit = self.lateral_units[axis].as_ref();
        if let (Some(unit), Some(other)) = (unit, axis_unit)
            && *unit != other.value
        {
            return Err(source.corrupt(format!(
                "{key} = {value} {unit} contradicts {} = {}; leave one of the units",
                other.key, other.value
            )));
        }
        let unit = unit.or(self.lateral_unit(axis)).or(*default).or(source.options.unit);
        Ok(Some((value * unit.map_or(1.0, LengthUnit::metres), unit.is_none())))
    }

    /// Unit of positions along an axis that have none of their own.
    pub(in crate::text) fn lateral_unit(&self, axis: usize) -> Option<LengthUnit> {
        [&self.lateral_units[axis], &self.unit].into_iter().flatten().map(|given| given.value).next()
    }

    /// Whether a length of the header has neither a unit of its own nor one of its axis.
    fn lengths_take_common_unit(&self) -> bool {
        let is_bare = |axis: usize| {
            let lengths = [&self.sizes[axis], &self.spacings[axis]];
            lengths.into_iter().flatten().any(|given| given.value.unit.is_none())
        };
        (0..2).any(|axis| self.lateral_units[axis].is_none() && is_bare(axis))
    }

    /// The warnings that the header gives rise to.
    pub(in crate::text) fn warnings(
        &self,
        heights: Option<LengthUnit>,
        lateral_unit_missing: bool,
    ) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.unknown.is_empty() {
            let listed: Vec<String> =
                self.unknown.iter().take(MOST_KEYS).map(|key| format!("\"{key}\"")).collect();
            let more = self.unknown.len().saturating_sub(MOST_KEYS);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            warnings.push(format!("keys of the header are not understood: {}{more}", listed.join(", ")));
        }
        if heights.is_none() {
            let remedy = "a line \"unit: um\" before the heights names it, or the option unit";
            warnings.push(without_unit(remedy));
        }
        if lateral_unit_missing {
            warnings.push(
                "the unit of the lengths along x and y is not known, their numbers are taken as metres; a line \
                 \"lateral units: um\" before the heights names it, or the option unit"
                    .to_owned(),
            );
        }
        warnings
    }
}
