//! Choice between matrices and columns for the numbers of a table.

use super::columns::Columns;
use super::edges::{Corner, Edges, cut_edges};
use super::header::Header;
use super::lateral::Lateral;
use super::roles::Roles;
use super::suspicion;
use super::table::Table;
use super::titles::Titles;
use crate::error::Error;
use crate::source::Source;
use crate::surface::Surface;
use crate::unit::LengthUnit;

/// Tables of two or three columns with more rows than this are lists of positions, or refused.
const MOST_ROWS: usize = 8;
/// Rows from which on positions can be told from heights.
const FEWEST_ROWS: usize = 3;

/// A table and all that is known of it.
pub(super) struct Content<'a> {
    pub(super) source: Source<'a>,
    pub(super) header: &'a Header,
    pub(super) titles: Option<&'a Titles>,
    pub(super) table: Table,
    /// Coordinates in the line before the first row, behind a title.
    pub(super) corner: Option<Corner>,
    /// Line before which an empty line divides the rows.
    pub(super) division: Option<usize>,
    /// Choices that were made.
    pub(super) warnings: Vec<String>,
}

impl Content<'_> {
    /// The surface.
    pub(super) fn arrange(mut self) -> Result<Surface, Error> {
        if let Some(marker) = self.header.no_data {
            let marked = self.table.values.iter_mut().filter(|value| value.to_bits() == marker.to_bits());
            marked.for_each(|value| *value = f64::NAN);
        }
        if let Some(titles) = self.titles
            && self.header.counts().iter().all(Option::is_none)
        {
            self.table.require_even(self.source)?;
            return self.titled(titles);
        }
        if let [Some(nx), Some(ny)] = self.header.counts() {
            return self.counted(nx, ny);
        }
        let edges = cut_edges(self.source, self.header, &mut self.table, self.corner.take())?;
        self.table.require_even(self.source)?;
        if edges.is_some() || self.header.describes_matrix() {
            return self.matrix(edges);
        }
        match self.table.columns {
            1 => {
                if let Some(count) = suspicion::count_in_front(&self.table.values) {
                    return Err(self.source.unsupported(format!(
                        "{count}; take them out, and give a line \"dx = 0.5 um\" in their place"
                    )));
                }
                (self.table.columns, self.table.rows) = (self.table.rows, 1);
                self.matrix(None)
            }
            2 => self.two_columns(),
            3 => self.three_columns(),
            _ => self.several_columns(),
        }
    }

    /// Four or more columns without titles: a matrix.
    fn several_columns(mut self) -> Result<Surface, Error> {
        if suspicion::begins_with_positions(&self.table) {
            return Err(self.source.unsupported(format!(
                "{} columns without titles, the first two of which are positions of a map; a line \"x (um), y (um), z (um), ...\" \
                 before them says which one holds the heights",
                self.table.columns
            )));
        }
        self.drop_index();
        self.matrix(None)
    }

    /// A matrix of the size that the header counts, whose rows may be wrapped; or columns of as many points.
    fn counted(mut self, nx: usize, ny: usize) -> Result<Surface, Error> {
        self.take_void_matrix(nx, ny)?;
        let fits = |table: &Table| nx.checked_mul(ny) == Some(table.values.len());
        let mut edges = None;
        if !fits(&self.table) {
            if let Some(titles) = self.titles
                && self.table.ragged.is_none()
                && nx.checked_mul(ny) == Some(self.table.rows)
            {
                return self.titled(titles);
            }
            edges = cut_edges(self.source, self.header, &mut self.table, self.corner.take())?;
        }
        if !fits(&self.table) {
            let found = self.table.values.len();
            return Err(self.source.corrupt(format!("{found} heights, the header says {nx} x {ny}")));
        }
        let (columns, rows) = (self.table.columns, self.table.rows);
        // whole rows to a line or whole lines to a row, in the order of the header
        let is_wrapped =
            columns == 1 || rows == 1 || columns.is_multiple_of(nx) || nx.is_multiple_of(columns);
        let is_turned = [columns, rows] == [ny, nx] && nx != ny && columns > 1 && rows > 1;
        if self.table.ragged.is_none() && (!is_wrapped || is_turned) {
            return Err(self.source.corrupt(format!(
                "{rows} rows of {columns} heights contradict the {nx} x {ny} points (x and y) of the header"
            )));
        }
        (self.table.columns, self.table.rows) = (nx, ny);
        self.matrix(edges)
    }

    /// Applies the matrix behind the heights whose zeros mark undefined points and whose ones mark the others.
    fn take_void_matrix(&mut self, nx: usize, ny: usize) -> Result<(), Error> {
        let count = nx.saturating_mul(ny);
        let is_there = count.checked_mul(2) == Some(self.table.values.len()) && self.table.rows == 2 * ny;
        if !self.header.has_void_matrix {
            return Ok(());
        }
        if !is_there {
            let message = "voidpixels counts undefined points, and no matrix behind the heights marks them";
            let marked = self.table.values.iter().any(|value| value.is_nan());
            self.warnings.extend((!marked).then(|| message.to_owned()));
            return Ok(());
        }
        let marks = self.table.values.split_off(count);
        if let Some(mark) = marks.iter().find(|mark| ![0.0, 1.0].contains(*mark)) {
            let what = format!("{mark} in the matrix of voidpixels, which holds zeros and ones");
            return Err(self.source.corrupt(what));
        }
        let points = self.table.values.iter_mut().zip(marks);
        points.filter(|(_, mark)| *mark == 0.0).for_each(|(value, _)| *value = f64::NAN);
        self.table.rows = ny;
        Ok(())
    }

    /// Rows of heights, with the coordinates that stood at their edges.
    fn matrix(mut self, edges: Option<Edges>) -> Result<Surface, Error> {
        let (columns, rows) = (self.table.columns, self.table.rows);
        let is_counted = self.header.counts().iter().all(Option::is_some);
        if let Some(line) = self.division.filter(|_| !is_counted) {
            return Err(self.source.unsupported(format!(
                "an empty line before line {line} divides the rows; a file holds one surface, or a header before each"
            )));
        }
        if edges.is_none() && !is_counted {
            self.warnings.extend(suspicion::coordinates(&self.table));
        }
        for (what, given, found) in
            [("along x", self.header.counts()[0], columns), ("along y", self.header.counts()[1], rows)]
        {
            if let Some(given) = given.filter(|given| *given != found) {
                let what = format!("{found} heights {what}, the header says {given}");
                return Err(self.source.corrupt(what));
            }
        }
        let mut lateral = Lateral::of_header(self.source, self.header, [columns, rows])?;
        if let Some(edges) = edges {
            self.warnings.extend(edges.warning);
            lateral = lateral.or(edges.lateral);
        }
        let values = std::mem::take(&mut self.table.values);
        // the title of a single column that was laid out in rows
        let title = self.titles.and_then(|titles| match titles.0.as_slice() {
            [only] => only.unit,
            _ => None,
        });
        self.finish([columns, rows], values, title, lateral)
    }

    /// Columns with titles.
    fn titled(mut self, titles: &Titles) -> Result<Surface, Error> {
        let Roles { columns, unit, warnings } = titles.roles(self.source)?;
        self.warnings.extend(warnings);
        self.columns(&columns, unit)
    }

    /// Two columns without titles: positions and heights, or a matrix.
    fn two_columns(mut self) -> Result<Surface, Error> {
        let x = self.table.column(0);
        if x.iter().all(|position| position.is_nan()) {
            let what = "two columns, the first of which holds no number".to_owned();
            return Err(self.source.unsupported(what));
        }
        let rises = x.windows(2).all(|pair| pair[0] < pair[1]) || x.windows(2).all(|pair| pair[0] > pair[1]);
        if rises && self.table.rows >= FEWEST_ROWS {
            self.warnings.push("two columns without titles are read as positions and heights".to_owned());
            return self.columns(&Columns::new(Some(0), None, 1), None);
        }
        if self.table.rows > MOST_ROWS {
            return Err(self.refused("two", "the first does not rise or fall all along"));
        }
        self.matrix(None)
    }

    /// Three columns without titles: positions along x and y and heights, or a matrix.
    fn three_columns(mut self) -> Result<Surface, Error> {
        let columns = Columns::new(Some(0), Some(1), 2);
        let axes = columns.axes(&self.table);
        let points = self.table.rows;
        let is_list = match &axes {
            // a matrix of three columns hardly has positions that repeat in the other two
            Ok([x, y]) => {
                let is_map = x.count > 1 && y.count > 1 && 2 * points >= x.count * y.count;
                points >= FEWEST_ROWS && (is_map || x.count == 1 || y.count == 1)
            }
            Err(_) => false,
        };
        if is_list {
            self.warnings.push("three columns without titles are read as x, y and heights".to_owned());
            return self.columns(&columns, None);
        }
        if points > MOST_ROWS {
            let reason = match axes {
                Err(reason) => reason,
                Ok([x, y]) => format!("{points} points of a raster of {} x {}", x.count, y.count),
            };
            return Err(self.refused("three", &reason));
        }
        self.matrix(None)
    }

    /// The error of columns that are neither positions nor a matrix.
    fn refused(&self, count: &str, reason: &str) -> Error {
        self.source.unsupported(format!(
            "{count} columns without titles that are not positions and heights ({reason}); a line \"x-pixels = {}\" \
             before them says that they are a matrix, one of titles \"x (um), y (um), z (um)\" what they are",
            self.table.columns
        ))
    }

    /// Leaves out a first column that counts the rows while all other numbers have decimals.
    fn drop_index(&mut self) {
        let first = self.table.column(0);
        let counts = |from: f64| {
            first
                .iter()
                .enumerate()
                .all(|(k, value)| (value - from - k as f64).abs() < 0.5 / first.len() as f64)
        };
        let is_whole = |k: usize| self.table.decimals.get(k).is_none_or(|digits| *digits <= 0);
        let others_have_decimals = !(1..self.table.columns).any(is_whole);
        if first.len() >= FEWEST_ROWS && is_whole(0) && others_have_decimals && (counts(0.0) || counts(1.0)) {
            let columns = self.table.columns;
            let mut place = 0;
            self.table.values.retain(|_| {
                place += 1;
                (place - 1) % columns != 0
            });
            self.table.columns -= 1;
            self.warnings.push("the first column counts the rows and is left out".to_owned());
        }
    }

    /// The surface of points in columns.
    fn columns(mut self, columns: &Columns, unit: Option<LengthUnit>) -> Result<Surface, Error> {
        let raster = columns.raster(self.source, self.header, &self.table)?;
        self.table.values = Vec::new();
        self.warnings.extend(raster.warnings);
        self.finish(raster.size, raster.values, unit, raster.lateral)
    }

    /// The surface of `values`, whose column names a unit or not.
    fn finish(
        self,
        [nx, ny]: [usize; 2],
        values: Vec<f64>,
        unit: Option<LengthUnit>,
        lateral: Option<Lateral>,
    ) -> Result<Surface, Error> {
        self.source.require_size(nx, ny, None)?;
        let (is_unit_missing, takes_common_unit) = lateral
            .as_ref()
            .map_or((false, false), |lateral| (lateral.is_unit_missing, lateral.takes_common_unit));
        let scale = self.header.heights(self.source, unit, takes_common_unit)?;
        let heights = self.source.scaled(nx, values, -0.0, scale.metres)?;
        let mut warnings = self.warnings;
        warnings.extend(self.header.warnings(scale.unit, is_unit_missing));
        let surface = Surface { unit: scale.unit, warnings, ..Surface::new(nx, ny, heights) };
        self.source.finish(surface.with_spacing(lateral.map(|lateral| lateral.spacing)))
    }
}
