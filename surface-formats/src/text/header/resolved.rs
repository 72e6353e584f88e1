//! Units, scales and spacings that follow from a header.

use super::{AGREEMENT, Given, Header, HeightScale, Length, LengthUnit, Source, without_unit};
use crate::error::Error;
use crate::source::unknown_keys;

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

    /// Unit of the heights and metres per stored number; `title` is the unit in the title of their column, and lengths
    /// along x or y take the unit that the header gives for all, or do not.
    pub(in crate::text) fn heights(
        &self,
        source: Source<'_>,
        title: Option<LengthUnit>,
        lengths_take_common_unit: bool,
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
        if let (Some(found), Some(unit)) = (title.or(own), &self.unit)
            && unit.value != found
            && !lengths_take_common_unit
        {
            let other = match &self.height_unit {
                Some(given) => format!("{} = {found}", given.key),
                None => format!("the unit {found} of the title"),
            };
            let what = format!("{} = {} contradicts {other}; leave one of them", unit.key, unit.value);
            return Err(source.corrupt(what));
        }
        let unit = title.or(own).or(self.unit.as_ref().map(|given| given.value));
        if let Some(nanometres) = self.nanometres {
            let agrees = |unit: LengthUnit| (nanometres * 1e-9 / unit.metres() - 1.0).abs() < AGREEMENT;
            if let Some(unit) = unit.filter(|unit| !agrees(*unit)) {
                let what = format!(
                    "bit2nm = {nanometres} contradicts the unit {unit} of the heights; leave one of them"
                );
                return Err(source.corrupt(what));
            }
            let unit = unit.or(Some(LengthUnit::Nanometre));
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
            [along_x, _] => {
                let key = if along_x.is_some() { "dy" } else { "dx" };
                let what = format!(
                    "the header gives the size along one axis only; a line \"{key} = 0.5 um\" gives the other"
                );
                Err(source.corrupt(what))
            }
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

    /// Unit of lengths along an axis that have none of their own: that of the axis, of the other one, or of all.
    pub(in crate::text) fn lateral_unit(&self, axis: usize) -> Option<LengthUnit> {
        let given = [&self.lateral_units[axis], &self.lateral_units[1 - axis], &self.unit];
        given.into_iter().flatten().map(|given| given.value).next()
    }

    /// Unit of positions along an axis, `title` in that of their column.
    pub(in crate::text) fn position_unit(
        &self,
        source: Source<'_>,
        axis: usize,
        title: Option<LengthUnit>,
    ) -> Result<Option<LengthUnit>, Error> {
        if let (Some(title), Some(given)) = (title, &self.lateral_units[axis])
            && title != given.value
        {
            let what = format!("{} = {} contradicts the unit {title} of the title", given.key, given.value);
            return Err(source.corrupt(what));
        }
        Ok(title.or(self.lateral_unit(axis)).or(source.options.unit))
    }

    /// Whether the header gives no unit of lengths along x and y.
    pub(in crate::text) fn has_no_lateral_unit(&self) -> bool {
        self.lateral_units.iter().all(Option::is_none)
    }

    /// Whether a length of the header has neither a unit of its own nor one of its axis.
    pub(in crate::text) fn lengths_take_common_unit(&self) -> bool {
        let mut lengths = self.sizes.iter().chain(&self.spacings).flatten();
        self.has_no_lateral_unit() && lengths.any(|given| given.value.unit.is_none())
    }

    /// The axis whose length is in nanometres by its key, were there not the unit of the other axis.
    fn borrowed_unit(&self) -> Option<String> {
        (0..2).find_map(|axis| {
            let length = self.sizes[axis].as_ref().filter(|given| given.value.unit.is_none())?;
            let other = self.lateral_units[1 - axis].as_ref()?;
            let is_borrowed = length.value.default.is_some() && self.lateral_units[axis].is_none();
            is_borrowed.then(|| {
                format!("{} has no unit and is read in that of {}, {}", length.key, other.key, other.value)
            })
        })
    }

    /// The warnings that the header gives rise to.
    pub(in crate::text) fn warnings(
        &self,
        heights: Option<LengthUnit>,
        lateral_unit_missing: bool,
    ) -> Vec<String> {
        let mut warnings = Vec::new();
        warnings.extend(unknown_keys(&self.unknown));
        warnings.extend(self.borrowed_unit());
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
