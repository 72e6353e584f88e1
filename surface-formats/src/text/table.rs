//! The numbers of a block of rows.

use std::cmp::Ordering;

use super::number::{decimals, significant_digits};
use super::style::{Line, Separator, Style};
use crate::error::Error;
use crate::source::{Source, shortened};
use crate::surface::MAX_POINTS;

/// Numbers in rows.
#[derive(Debug)]
pub(super) struct Table {
    /// Row by row, NaN where undefined.
    pub(super) values: Vec<f64>,
    /// Numbers in the first row.
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Line and count of the first row of another length.
    pub(super) ragged: Option<(usize, usize)>,
    /// Most digits after the decimal mark in each column of the first row's length.
    pub(super) decimals: Vec<i32>,
    /// Most significant digits in each column, and the fewest digits after the decimal mark of numbers that have them.
    precision: Vec<(usize, i32)>,
    /// Whether the first field of the first row is empty.
    pub(super) has_empty_corner: bool,
}

impl Table {
    /// The numbers of `lines`, without the first field of each where it is a label.
    pub(super) fn read(
        source: Source<'_>,
        lines: &[Line<'_>],
        style: Style,
        is_labelled: bool,
    ) -> Result<Self, Error> {
        let mut table = Self {
            values: Vec::new(),
            columns: 0,
            rows: 0,
            ragged: None,
            decimals: Vec::new(),
            precision: Vec::new(),
            has_empty_corner: false,
        };
        let skipped = usize::from(is_labelled);
        // a separator that begins every line begins no field
        let leads = style.separator == Separator::Tab && lines.iter().all(|(_, line)| line.starts_with('\t'));
        for (number, line) in lines {
            if line.trim().is_empty() && style.separator != Separator::Tab {
                continue;
            }
            table.take(source, *number, if leads { &line[1..] } else { line }, style, skipped)?;
        }
        Ok(table)
    }

    /// Takes a row.
    fn take(
        &mut self,
        source: Source<'_>,
        number: usize,
        line: &str,
        style: Style,
        skipped: usize,
    ) -> Result<(), Error> {
        let joined;
        // a marker of two words
        let line = match style.separator {
            Separator::Blanks if line.contains("No Data") => {
                joined = line.replace("No Data", "nodata");
                joined.as_str()
            }
            _ => line,
        };
        let fields = style.separator.split(line);
        if self.rows > 0 && line.trim().is_empty() && fields.len() < self.columns {
            return Ok(());
        }
        let before = self.values.len();
        for (column, field) in fields.iter().enumerate().skip(skipped) {
            let at = || format!("line {number}, field {}", column + 1);
            let height = style.decimal.parse(field).ok_or_else(|| {
                source.corrupt(format!("{}: \"{}\" is not a number", at(), shortened(field)))
            })?;
            if self.values.len() == MAX_POINTS {
                return Err(source.corrupt(format!("{}: more than 2^26 (67 million) numbers", at())));
            }
            self.values.push(height);
            if self.rows == 0 {
                self.decimals.push(0);
                self.precision.push((0, 0));
            }
            if !height.is_nan() {
                self.count_digits(column - skipped, field);
            }
        }
        let mut count = self.values.len() - before;
        // a separator at the end of the line stands before an empty field
        if count + 1 == self.columns && style.separator.ends(line) && self.values.len() < MAX_POINTS {
            self.values.push(f64::NAN);
            count += 1;
        }
        if self.rows == 0 {
            self.columns = count;
            self.has_empty_corner = fields.first().is_some_and(|field| field.is_empty());
        } else if count != self.columns && self.ragged.is_none() {
            self.ragged = Some((number, count));
        }
        self.rows += 1;
        Ok(())
    }

    /// Takes the digits of the number `field` of a column.
    fn count_digits(&mut self, column: usize, field: &str) {
        let columns = (self.decimals.get_mut(column), self.precision.get_mut(column));
        let (Some(most), Some(precision)) = columns else { return };
        let (digits, after) = (significant_digits(field), decimals(field));
        *most = (*most).max(after);
        match digits.cmp(&precision.0) {
            Ordering::Greater => *precision = (digits, after),
            Ordering::Equal => precision.1 = precision.1.min(after),
            Ordering::Less => {}
        }
    }

    /// Digits after the decimal mark to which the numbers of a column are printed: those of the longest, which in a format
    /// of significant digits are fewer for larger numbers.
    pub(super) fn printed_decimals(&self, place: usize) -> i32 {
        self.precision.get(place).map_or(0, |(_, after)| *after)
    }

    /// The numbers of a column.
    pub(super) fn column(&self, place: usize) -> Vec<f64> {
        self.values.iter().skip(place).step_by(self.columns).copied().collect()
    }

    /// Columns at the end that hold no number, but at most all but one.
    pub(super) fn undefined_columns_at_end(&self) -> usize {
        let is_undefined =
            |place: &usize| self.values.iter().skip(*place).step_by(self.columns).all(|z| z.is_nan());
        let even = self.ragged.is_none() && self.columns > 1;
        if even { (1..self.columns).rev().take_while(is_undefined).count() } else { 0 }
    }

    /// The error of rows of different length, if they are.
    pub(super) fn require_even(&self, source: Source<'_>) -> Result<(), Error> {
        match self.ragged {
            None => Ok(()),
            Some((number, count)) => {
                let columns = self.columns;
                Err(source.corrupt(format!("line {number}: {count} numbers, {columns} in the first row")))
            }
        }
    }
}
