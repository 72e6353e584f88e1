//! Values of a header that hold for both axes.

use super::{Header, Length, Source, set};
use crate::error::Error;
use crate::source::shortened;
use crate::text::number::parse_height;

impl Header {
    /// Takes the numbers of points along x and y: `1024 768`, `1024 x 768`; others are not understood.
    pub(super) fn take_counts(&mut self, source: Source<'_>, key: &str, value: &str) -> Result<(), Error> {
        let digits = value.split(|letter: char| !letter.is_ascii_digit()).filter(|part| !part.is_empty());
        let counts: Vec<usize> = digits.map_while(|part| part.parse().ok()).collect();
        if counts.len() != 2 {
            self.unknown.push(shortened(key));
            return Ok(());
        }
        for (slot, count) in self.counts.iter_mut().zip(counts) {
            set(source, slot, key, count, usize::eq, usize::to_string)?;
        }
        Ok(())
    }

    /// Takes the lengths along x and y in one unit: `1000 500 nm`, or one for both.
    pub(super) fn take_sizes(&mut self, source: Source<'_>, key: &str, value: &str) -> Result<(), Error> {
        let wrong = || source.corrupt(format!("{key} = {} is not a length", shortened(value)));
        let words: Vec<&str> = value.split_whitespace().collect();
        let numbers: Vec<f64> = words.iter().map_while(|word| parse_height(word)).collect();
        let unit = match words.get(numbers.len()) {
            Some(name) => Some(source.unit(name, key)?),
            None => None,
        };
        let sizes = match *numbers.as_slice() {
            [size] => [size, size],
            [x, y] => [x, y],
            _ => return Err(wrong()),
        };
        for (axis, value) in sizes.into_iter().enumerate() {
            if value.is_nan() || value <= 0.0 {
                return Err(wrong());
            }
            self.set_length(source, key, axis, true, Length { value, unit, default: None })?;
        }
        Ok(())
    }
}
