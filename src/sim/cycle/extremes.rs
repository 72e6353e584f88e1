//! The rows of a cycle with the thinnest and with the thickest film by formula, before it is solved.

use std::f64::consts::TAU;

use crate::error::InputError;
use crate::sim::cycle::{set_row, skipped};
use crate::sim::scene::Scene;
use crate::sim::scene::cycle_table::{CycleRow, CycleTable};

/// A row of a cycle as a scene of its own.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CycleRowScene {
    /// The row, counted from 1, or the line of the file.
    pub place: String,
    /// Time \[s\].
    pub time: f64,
    /// Angle \[rad\]; `None` for a table of times.
    pub angle: Option<f64>,
    /// The scene of the contact, without a cycle.
    pub scene: Scene,
}

/// Rows of a cycle, and those with the extreme films.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CycleExtremes {
    /// Rows of the table, with the first row at the end of a period.
    pub rows: usize,
    /// Contacts that are solved in a cycle.
    pub contacts: usize,
    /// Whether each row is a steady contact or a passage; otherwise the cycle is solved in time.
    pub quasi_static: bool,
    /// Rows that entrain no oil: the formula has no film for them.
    pub rows_at_rest: usize,
    /// The row with the thinnest central film of a smooth steady contact by formula.
    pub thinnest: CycleRowScene,
    /// That with the thickest film.
    pub thickest: CycleRowScene,
}

impl Scene {
    /// The rows of [`cycle`](Self::cycle) with the thinnest and the thickest film by formula among those that entrain oil; `None`
    /// without a cycle or a lubricant.
    ///
    /// # Errors
    /// A table that does not fit, with row, field and value.
    ///
    /// ```
    /// use stribeck::sim::{Scene, scene::CycleSpec};
    /// let mut scene = Scene::azam_2019(32);
    /// let mut cycle = CycleSpec::default();
    /// (cycle.time, cycle.ball_speed) = (vec![0.0, 1e-3, 2e-3], vec![1.0, 2.0, 1.0]);
    /// scene.cycle = Some(cycle);
    /// let extremes = scene.cycle_extremes()?.ok_or("no cycle")?;
    /// assert_eq!(extremes.thickest.place, "row 2 of [cycle]");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cycle_extremes(&self) -> Result<Option<CycleExtremes>, InputError> {
        if self.cycle.is_none() || !self.is_lubricated() {
            return Ok(None);
        }
        let table = CycleTable::new(self)?;
        let mut films = Vec::with_capacity(table.rows.len());
        for (index, row) in table.rows.iter().enumerate().filter(|(_, row)| row.entrainment() != 0.0) {
            let film = at_row(self, row).formula_film()?.map_or(0.0, |formula| formula.central);
            films.push((index, film));
        }
        let by_film = |a: &&(usize, f64), b: &&(usize, f64)| a.1.total_cmp(&b.1);
        let named = |&(index, _): &(usize, f64)| {
            let row = table.rows.get(index)?;
            let angle = table.turn.map(|turn| row.time / turn * TAU);
            Some(CycleRowScene {
                place: table.source.row(index),
                time: row.time,
                angle,
                scene: at_row(self, row),
            })
        };
        let thinnest = films.iter().min_by(by_film).and_then(named);
        // The first of equal rows.
        let thickest = films.iter().rev().max_by(by_film).and_then(named);
        let contacts = if table.quasi_static {
            table.distinct_rows().len()
        } else {
            skipped::steps(self, &table)? + usize::from(table.once)
        };
        let (rows, rows_at_rest) = (table.rows.len(), table.rows.len() - films.len());
        Ok(thinnest.zip(thickest).map(|(thinnest, thickest)| CycleExtremes {
            rows,
            contacts,
            quasi_static: table.quasi_static,
            rows_at_rest,
            thinnest,
            thickest,
        }))
    }
}

/// The contact of `scene` at `row`; a flow along -x is one along +x.
fn at_row(scene: &Scene, row: &CycleRow) -> Scene {
    let mut scene = scene.clone();
    scene.cycle = None;
    set_row(&mut scene, row);
    let entrainment = row.entrainment();
    scene.motion.entrainment_speed = entrainment.abs();
    scene.motion.slide_roll_ratio = (row.speeds[0] - row.speeds[1]) / entrainment;
    scene
}
