//! Headers of text files: pairs of keys and values.

mod both_axes;
mod resolved;

use super::keys::{Key, meaning};
use super::number::is_undefined;
use super::pairs::{pairs, plain_key, quantity, split_unit, unit_in_words};
use super::style::{Line, unquoted};
use super::titles::{Column, column};
use crate::error::Error;
use crate::source::{Source, shortened, without_unit};
use crate::unit::LengthUnit;

/// Relative difference up to which two ways to state one length agree.
const AGREEMENT: f64 = 0.01;

/// A value and the key that gave it.
#[derive(Debug, Clone)]
struct Given<T> {
    value: T,
    key: String,
}

/// A length and its unit where one stands beside it or belongs to its key.
#[derive(Debug, Clone, Copy)]
struct Length {
    value: f64,
    unit: Option<LengthUnit>,
    /// Unit where the file gives none.
    default: Option<LengthUnit>,
}

/// The understood part of a header.
#[derive(Debug, Default)]
pub(super) struct Header {
    counts: [Option<Given<usize>>; 2],
    sizes: [Option<Given<Length>>; 2],
    spacings: [Option<Given<Length>>; 2],
    lateral_units: [Option<Given<LengthUnit>>; 2],
    height_unit: Option<Given<String>>,
    /// Unit of all that has none of its own.
    unit: Option<Given<LengthUnit>>,
    factor: Option<f64>,
    /// Unit of `factor`.
    factor_unit: Option<LengthUnit>,
    scale_data: Option<f64>,
    scale_data_needed: Option<bool>,
    nanometres: Option<f64>,
    /// Stored number of undefined points.
    pub(super) no_data: Option<f64>,
    /// Whether a second matrix marks undefined points with zeros.
    pub(super) has_void_matrix: bool,
    /// Name of the surface.
    pub(super) name: Option<String>,
    /// Whether anything was understood that heights depend on.
    pub(super) is_known: bool,
    /// Keys and lines that were not understood.
    unknown: Vec<String>,
}

/// Unit of the heights and metres per stored number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HeightScale {
    pub(super) unit: Option<LengthUnit>,
    pub(super) metres: f64,
}

/// Stores a value, which must not contradict one that was given before.
fn set<T: Clone>(
    source: Source<'_>,
    slot: &mut Option<Given<T>>,
    key: &str,
    value: T,
    agrees: impl Fn(&T, &T) -> bool,
    show: impl Fn(&T) -> String,
) -> Result<(), Error> {
    if let Some(other) = slot
        && !agrees(&other.value, &value)
    {
        let (first, second) = (show(&other.value), show(&value));
        return Err(source
            .corrupt(format!("{key} = {second} contradicts {} = {first}; leave one of them", other.key)));
    }
    *slot = Some(Given { value, key: key.to_owned() });
    Ok(())
}

/// The length `text` of the key `name`, whose unit is `key_unit` where the text has none.
fn length(
    source: Source<'_>,
    name: &str,
    text: &str,
    key_unit: Option<LengthUnit>,
    default: Option<LengthUnit>,
) -> Result<Length, Error> {
    let (value, unit) = quantity(text)
        .ok_or_else(|| source.corrupt(format!("{name} = {} is not a length", shortened(text))))?;
    // "um/sample"
    let unit = match unit.split_once('/') {
        Some((unit, "sample" | "pixel" | "point")) => unit,
        _ => unit,
    };
    let unit = match unit {
        "" => key_unit,
        unit => Some(source.unit(unit, name)?),
    };
    if value <= 0.0 {
        return Err(source.corrupt(format!("{name} = {text}: it must be finite and > 0")));
    }
    Ok(Length { value, unit, default })
}

/// Units of positions and heights of a profile of SPIP: `X-Axis: nm; Y-Axis: nm`.
fn axes_of_profile(line: &str) -> Option<(&str, &str)> {
    let (x, z) = line.strip_prefix("X-Axis:")?.split_once(';')?;
    Some((x.trim(), z.trim().strip_prefix("Y-Axis:")?.trim()))
}

impl Header {
    /// The header in `lines`.
    pub(super) fn read(source: Source<'_>, lines: &[Line<'_>]) -> Result<Self, Error> {
        let mut header = Self::default();
        for (_, line) in lines {
            header.take(source, line)?;
        }
        Ok(header)
    }

    /// Takes the pairs of a line.
    fn take(&mut self, source: Source<'_>, line: &str) -> Result<(), Error> {
        let line = line.trim().trim_start_matches(['#', '%', ';', '\\', '/', '*']).trim();
        let is_quoted = line.starts_with('"') && line.matches('"').count() == 2;
        let line = if is_quoted { unquoted(line) } else { line };
        if line.is_empty() || line.chars().all(|letter| matches!(letter, '-' | '=' | '_' | '*' | ',' | ';')) {
            return Ok(());
        }
        // a unit alone is that of the heights
        if let Some(unit) = LengthUnit::parse(line.trim_matches(['[', ']', '(', ')'])) {
            return self.set_height_unit(source, "unit", &unit.to_string());
        }
        if let Some((x, z)) = axes_of_profile(line) {
            self.set_lateral_unit(source, "X-Axis", 0, x)?;
            return self.set_height_unit(source, "Y-Axis", z);
        }
        let found = pairs(line);
        if found.is_empty() {
            let (title, unit) = unit_in_words(line).unwrap_or_else(|| split_unit(line));
            let is_height = column(title) == Column::Z;
            if is_height && !unit.is_empty() {
                return self.set_height_unit(source, title, unit);
            }
            let key = plain_key(title);
            let is_known = is_height || meaning(&key).is_some();
            if !is_known {
                self.unknown.push(shortened(line));
            }
            return Ok(());
        }
        for (key, value) in found {
            self.take_pair(source, &key, &value)?;
        }
        Ok(())
    }

    /// Takes one pair.
    fn take_pair(&mut self, source: Source<'_>, key: &str, value: &str) -> Result<(), Error> {
        let (name, key_unit) = split_unit(key);
        let name = plain_key(name);
        let key_unit = LengthUnit::parse(key_unit);
        let known = meaning(&name).filter(|meaning| !value.is_empty() || *meaning == Key::Nothing);
        let Some(meaning) = known else {
            self.unknown.push(shortened(key));
            return Ok(());
        };
        self.is_known |= !matches!(meaning, Key::Nothing | Key::Name);
        let length = |default| length(source, &name, value, key_unit, default);
        match meaning {
            Key::Count(axis) => self.take_count(source, &name, axis, value),
            Key::Counts => self.take_counts(source, &name, value),
            Key::Size(axis) => self.set_length(source, &name, axis, true, length(None)?),
            Key::SizeInNanometres(axis) => {
                let length = length(Some(LengthUnit::Nanometre))?;
                self.set_length(source, &name, axis, true, length)
            }
            Key::Sizes => self.take_sizes(source, &name, value),
            Key::Spacing(axis) => self.set_length(source, &name, axis, false, length(None)?),
            Key::Spacings => {
                let length = length(None)?;
                self.set_length(source, &name, 0, false, length)?;
                self.set_length(source, &name, 1, false, length)
            }
            Key::LateralUnit(axis) => self.set_lateral_unit(source, &name, axis, value),
            Key::LateralUnits => {
                self.set_lateral_unit(source, &name, 0, value)?;
                self.set_lateral_unit(source, &name, 1, value)
            }
            Key::HeightUnit => self.set_height_unit(source, &name, value),
            Key::Unit => {
                let unit = source.unit(value.trim_matches(['[', ']', '(', ')']), &name)?;
                set(source, &mut self.unit, &name, unit, PartialEq::eq, ToString::to_string)
            }
            Key::Nanometres => self.take_number(source, &name, value, |header| &mut header.nanometres),
            Key::ScaleData => self.take_number(source, &name, value, |header| &mut header.scale_data),
            Key::Factor => self.take_factor(source, &name, value),
            Key::FactorNeeded => {
                self.scale_data_needed = Some(matches!(value.to_lowercase().as_str(), "yes" | "true" | "1"));
                Ok(())
            }
            Key::NoData if is_undefined(value) => Ok(()),
            Key::NoData => self.take_number(source, &name, value, |header| &mut header.no_data),
            Key::VoidPixels => {
                self.has_void_matrix = quantity(value).is_some_and(|(count, _)| count > 0.0);
                Ok(())
            }
            Key::Name => {
                self.name = Some(value.to_owned());
                Ok(())
            }
            Key::Nothing => Ok(()),
        }
    }

    /// Takes the number of points along `axis`.
    fn take_count(&mut self, source: Source<'_>, name: &str, axis: usize, value: &str) -> Result<(), Error> {
        let count = value.parse::<usize>().ok().filter(|count| *count > 0);
        let count =
            count.ok_or_else(|| source.corrupt(format!("{name} = {} is not a count", shortened(value))))?;
        set(source, &mut self.counts[axis], name, count, usize::eq, usize::to_string)
    }

    /// Takes heights per stored number, in the unit that the key names.
    fn take_factor(&mut self, source: Source<'_>, name: &str, value: &str) -> Result<(), Error> {
        if let Some((_, unit)) = name.split_once('>') {
            self.factor_unit = Some(source.unit(unit.trim().trim_end_matches(')'), "height")?);
        }
        self.take_number(source, name, value, |header| &mut header.factor)
    }

    /// Takes a finite number.
    fn take_number(
        &mut self,
        source: Source<'_>,
        key: &str,
        value: &str,
        slot: impl Fn(&mut Self) -> &mut Option<f64>,
    ) -> Result<(), Error> {
        let number = quantity(value)
            .ok_or_else(|| source.corrupt(format!("{key} = {} is not a number", shortened(value))))?;
        *slot(self) = Some(number.0);
        Ok(())
    }

    fn set_length(
        &mut self,
        source: Source<'_>,
        key: &str,
        axis: usize,
        is_size: bool,
        length: Length,
    ) -> Result<(), Error> {
        let slot = if is_size { &mut self.sizes[axis] } else { &mut self.spacings[axis] };
        let metres = |length: &Length| length.value * length.unit.map_or(1.0, LengthUnit::metres);
        let agrees = |a: &Length, b: &Length| {
            a.unit.is_some() == b.unit.is_some() && (metres(a) / metres(b) - 1.0).abs() < AGREEMENT
        };
        let show = |length: &Length| {
            let unit = length.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
            format!("{}{unit}", length.value)
        };
        set(source, slot, key, length, agrees, show)
    }

    fn set_lateral_unit(
        &mut self,
        source: Source<'_>,
        key: &str,
        axis: usize,
        name: &str,
    ) -> Result<(), Error> {
        let unit = source.unit(name.trim_matches(['[', ']', '(', ')']), key)?;
        set(source, &mut self.lateral_units[axis], key, unit, PartialEq::eq, ToString::to_string)
    }

    fn set_height_unit(&mut self, source: Source<'_>, key: &str, name: &str) -> Result<(), Error> {
        let name = name.trim_matches(['[', ']', '(', ')']).trim().to_owned();
        let same = |a: &String, b: &String| a == b || LengthUnit::parse(a) == LengthUnit::parse(b);
        self.is_known = true;
        set(source, &mut self.height_unit, key, name, same, Clone::clone)
    }
}
