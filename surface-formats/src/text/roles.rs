//! Columns of positions and heights by their titles.

use super::columns::Columns;
use super::titles::{Column, Titles, quoted};
use crate::error::Error;
use crate::source::Source;
use crate::unit::LengthUnit;

/// Columns that are used.
pub(super) struct Roles {
    pub(super) columns: Columns,
    /// Unit of the heights in their title.
    pub(super) unit: Option<LengthUnit>,
    /// Columns that are left out or were chosen by their place.
    pub(super) warnings: Vec<String>,
}

/// Places of the columns of each kind.
#[derive(Default)]
struct Places {
    x: Vec<usize>,
    y: Vec<usize>,
    z: Vec<usize>,
    /// Whether positions are known by their place alone.
    is_assumed: bool,
}

impl Titles {
    /// The columns of positions and of the heights that were chosen.
    ///
    /// Known words come first. A unit of length makes a column with any other title a position or a height: of columns
    /// without a known word the last is the height, beside a known height those before it are positions, and beside
    /// known positions all others are heights.
    pub(super) fn roles(&self, source: Source<'_>) -> Result<Roles, Error> {
        if self.0.iter().any(|title| title.column == Column::Parameter) {
            let what = format!("columns {}: roughness parameters instead of heights", self.names());
            return Err(source.unsupported(what));
        }
        let Some(places) = self.places() else { return Err(self.refused(source)) };
        let name = |place: &usize| self.0[*place].name.clone();
        let z = places.z[source.choose(places.z.iter().map(name).collect())?];
        // of several positions the one that stands before the height is its own
        let own = |of: &[usize]| {
            let before = of.iter().rev().find(|place| **place < z);
            before.or(of.first()).copied().filter(|place| *place != z)
        };
        let (x, y) = (own(&places.x), own(&places.y));
        let valid = self.of(Column::Valid).first().copied();
        let unit = |place: Option<usize>| place.and_then(|place| self.0[place].unit);
        let mut warnings = Vec::new();
        if places.is_assumed {
            let used: Vec<&str> =
                [x, y, Some(z)].into_iter().flatten().map(|k| self.0[k].name.as_str()).collect();
            let order = if used.len() > 2 { "x, y and heights" } else { "positions and heights" };
            warnings.push(format!("columns {} are read as {order}", quoted(used.into_iter())));
        }
        let is_left_out = |place: usize| {
            let title = &self.0[place];
            let is_used = [x, y, Some(z)].contains(&Some(place));
            let is_other = title.column == Column::Other || title.is_foreign && title.column != Column::Valid;
            is_other && !title.name.is_empty() && !is_used && !places.z.contains(&place)
        };
        let left: Vec<usize> = (0..self.0.len()).filter(|place| is_left_out(*place)).collect();
        if !left.is_empty() {
            let names = quoted(left.iter().map(|place| self.0[*place].name.as_str()));
            warnings.push(format!("columns {names} are left out"));
        }
        let columns = Columns { x, y, z, valid, units: [unit(x), unit(y)] };
        Ok(Roles { columns, unit: unit(Some(z)), warnings })
    }

    /// Places of the columns of this kind.
    fn of(&self, column: Column) -> Vec<usize> {
        let fits = |place: &usize| self.0[*place].column == column && !self.0[*place].is_foreign;
        (0..self.0.len()).filter(fits).collect()
    }

    /// Positions and heights, of which there is one at least; `None` where the titles leave them open.
    fn places(&self) -> Option<Places> {
        let [x, y, z, others] = [Column::X, Column::Y, Column::Z, Column::Other].map(|kind| self.of(kind));
        let (measured, plain): (Vec<usize>, Vec<usize>) =
            others.into_iter().partition(|place| self.0[*place].unit.is_some());
        let found = Places { x, y, z, is_assumed: false };
        if !found.z.is_empty() {
            return Some(found.beside_height(measured));
        }
        if found.x.is_empty() {
            let mut open = [measured, found.y].concat();
            open.sort_unstable();
            return Places::in_order(&open);
        }
        let has_unit = self.0.iter().any(|title| title.unit.is_some());
        let z = match (measured.is_empty(), plain.is_empty()) {
            (false, _) => measured,
            // x and y of a profile
            (true, true) => {
                return Some(Places { z: found.y, y: Vec::new(), ..found }).filter(|p| !p.z.is_empty());
            }
            (true, false) if has_unit => return None,
            (true, false) => plain,
        };
        Some(Places { z, ..found })
    }

    /// The error of titles that do not tell positions from heights.
    fn refused(&self, source: Source<'_>) -> Error {
        let names = self.names();
        let columns = self.0.len();
        source.unsupported(format!(
            "columns {names}, none of which is called z or height with a unit of length; titles such as \"x (um), y (um), \
             z (um)\" say what they are, a line \"x-pixels = {columns}\" before the titles that they are a matrix"
        ))
    }
}

impl Places {
    /// Other lengths beside a known height.
    fn beside_height(mut self, measured: Vec<usize>) -> Self {
        if !self.x.is_empty() || !self.y.is_empty() {
            self.z.extend(measured);
            self.z.sort_unstable();
            return self;
        }
        let (before, after): (Vec<usize>, Vec<usize>) =
            measured.into_iter().partition(|place| *place < self.z[0]);
        let positions = if before.is_empty() {
            after
        } else {
            self.z.extend(after);
            before
        };
        self.is_assumed = !positions.is_empty();
        self.x = positions.first().copied().into_iter().collect();
        self.y = positions.get(1).copied().into_iter().collect();
        self
    }

    /// Lengths without a known word in the order x, y, height.
    fn in_order(places: &[usize]) -> Option<Self> {
        let (x, y, z) = match *places {
            [z] => (Vec::new(), Vec::new(), z),
            [x, z] => (vec![x], Vec::new(), z),
            [x, y, z] => (vec![x], vec![y], z),
            _ => return None,
        };
        Some(Self { is_assumed: !x.is_empty(), x, y, z: vec![z] })
    }
}
