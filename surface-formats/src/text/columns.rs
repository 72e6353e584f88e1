//! Columns of positions and heights.

use super::header::Header;
use super::lateral::{Lateral, lateral_of};
use super::raster::Axis;
use super::table::Table;
use crate::error::Error;
use crate::source::Source;
use crate::unit::LengthUnit;

/// Nodes of a raster for each point that is given, at most.
const SPARSEST: usize = 10;

/// Places of the columns.
pub(super) struct Columns {
    pub(super) x: Option<usize>,
    pub(super) y: Option<usize>,
    pub(super) z: usize,
    /// One for defined points.
    pub(super) valid: Option<usize>,
    /// Units in the titles of x and y.
    pub(super) units: [Option<LengthUnit>; 2],
}

/// Heights on a raster, in the unit of the file.
pub(super) struct Raster {
    pub(super) size: [usize; 2],
    /// NaN where undefined.
    pub(super) values: Vec<f64>,
    pub(super) lateral: Option<Lateral>,
    /// Choices that were made.
    pub(super) warnings: Vec<String>,
}

impl Columns {
    /// Columns without units or validity.
    pub(super) fn new(x: Option<usize>, y: Option<usize>, z: usize) -> Self {
        Self { x, y, z, valid: None, units: [None; 2] }
    }

    /// The rasters of the positions along x and y; one node where there is no such column.
    /// The error says why there is none.
    pub(super) fn axes(&self, table: &Table) -> Result<[Axis; 2], String> {
        let axis = |place: Option<usize>, name: &str| -> Result<Axis, String> {
            let Some(place) = place else { return Ok(Axis::new(0.0, 0.0, 1)) };
            let positions = table.column(place);
            if let Some(row) = positions.iter().position(|position| position.is_nan()) {
                return Err(format!("row {}: {name} is not a number", row + 1));
            }
            let digits = table.printed_decimals(place);
            Axis::of(&positions, digits).map_err(|off| {
                format!(
                    "{name} positions are off a raster of spacing {:.4e} by up to {:.4e} ({:.0} %)",
                    off.spacing,
                    off.by,
                    100.0 * off.by / off.spacing
                )
            })
        };
        Ok([axis(self.x, "x")?, axis(self.y, "y")?])
    }

    /// The heights in the order of their positions; points that are not given are undefined.
    pub(super) fn raster(&self, source: Source<'_>, header: &Header, table: &Table) -> Result<Raster, Error> {
        let mut values = table.column(self.z);
        if let Some(place) = self.valid {
            for (value, valid) in values.iter_mut().zip(table.column(place)) {
                *value = if valid > 0.0 { *value } else { f64::NAN };
            }
        }
        if self.x.is_none() && self.y.is_none() {
            return self.sequence(source, header, values);
        }
        let axes = self.axes(table).map_err(|reason| {
            source.unsupported(format!("{reason}; resample the heights to equidistant positions"))
        })?;
        let [nx, ny] = axes.map(|axis| axis.count);
        if nx.checked_mul(ny).is_none_or(|nodes| nodes > SPARSEST * table.rows) {
            let points = table.rows;
            return Err(source.unsupported(format!("{points} points of a raster of {nx} x {ny}")));
        }
        let mut heights = vec![f64::NAN; nx * ny];
        let mut is_given = vec![false; nx * ny];
        let [x, y] = [self.x, self.y].map(|place| place.map(|place| table.column(place)));
        for (row, value) in values.into_iter().enumerate() {
            let node = |axis: Axis, positions: &Option<Vec<f64>>| {
                positions.as_ref().map_or(0, |p| axis.node(p[row]))
            };
            let k = node(axes[1], &y).min(ny - 1) * nx + node(axes[0], &x).min(nx - 1);
            if std::mem::replace(&mut is_given[k], true) {
                let (column, line) = (k % nx, k / nx);
                return Err(source.corrupt(format!(
                    "row {}: the point ({column}, {line}) of the raster is given twice",
                    row + 1
                )));
            }
            heights[k] = value;
        }
        let lateral = lateral_of(source, header, axes, self.units)?;
        let rounded = ["x", "y"].into_iter().zip(axes).filter(|(_, axis)| axis.is_rounded);
        let warnings = rounded.map(|(name, axis)| {
            let Axis { spacing, count, .. } = axis;
            format!("{name} positions are read as {count} equidistant ones, {spacing:.6e} apart and rounded, not as a finer raster with gaps")
        });
        let warnings = warnings.collect();
        // a profile along y is a row, too
        let size = if nx == 1 { [ny, 1] } else { [nx, ny] };
        Ok(Raster { size, values: heights, lateral, warnings })
    }

    /// Heights without positions: rows of the size that the header counts, else one.
    fn sequence(&self, source: Source<'_>, header: &Header, values: Vec<f64>) -> Result<Raster, Error> {
        let size = match header.counts() {
            [Some(nx), Some(ny)] if nx.checked_mul(ny) == Some(values.len()) => [nx, ny],
            _ => [values.len(), 1],
        };
        Ok(Raster { size, values, lateral: Lateral::of_header(source, header, size)?, warnings: Vec::new() })
    }
}
