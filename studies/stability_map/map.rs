//! The map: one panel a solver, one column a speed and roughness, one row a length, pressure and hardness.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::outcome::{Entry, SOLVERS, Verdict};
use crate::scenes::{Case, Group, HARDNESSES, LENGTHS, PRESSURES, ROUGHNESSES, SPEEDS};

/// Sizes in pixels of a cell and of the margins.
const CELL: (i32, i32) = (20, 12);
const LEFT: i32 = 190;
const TOP: i32 = 62;
const PANEL_TOP: i32 = 62;
const PANEL_BOTTOM: i32 = 14;
const GAP: i32 = 8;
const FONT: u32 = 15;

fn colour(verdict: Verdict) -> RGBColor {
    match verdict {
        Verdict::Converged => RGBColor(0, 158, 115),
        Verdict::MeshTooCoarse => RGBColor(86, 180, 233),
        Verdict::Stalled => RGBColor(230, 159, 0),
        Verdict::MaxIterations => RGBColor(240, 228, 66),
        Verdict::Diverged => RGBColor(213, 94, 0),
        Verdict::Refused => RGBColor(150, 150, 150),
        Verdict::Lie => RGBColor(0, 0, 0),
    }
}

/// Draws the battery of every solver that has one.
pub(crate) fn draw(entries: &[Entry], path: &Path) -> Result<(), Box<dyn Error>> {
    let solvers: Vec<_> =
        SOLVERS.into_iter().filter(|solver| entries.iter().any(|e| e.solver == *solver)).collect();
    let columns = (SPEEDS.len() * ROUGHNESSES.len()) as i32;
    let rows = (LENGTHS.len() * PRESSURES.len() * HARDNESSES.len()) as i32;
    let width = LEFT + columns * CELL.0 + (SPEEDS.len() as i32) * GAP + 12;
    let panel = PANEL_TOP + rows * CELL.1 + (LENGTHS.len() * PRESSURES.len()) as i32 * GAP / 2 + PANEL_BOTTOM;
    let height = TOP + panel * solvers.len() as i32;
    {
        let root = SVGBackend::new(path, (width as u32, height as u32)).into_drawing_area();
        root.fill(&WHITE)?;
        let style = |size: u32| ("sans-serif", size).into_font().color(&BLACK);
        root.draw(&Text::new("Scenes at 64 x 64 nodes, tolerance 1e-6", (10, 8), style(FONT + 3)))?;
        for (k, verdict) in Verdict::ALL.into_iter().enumerate() {
            let x = 10 + 98 * k as i32;
            root.draw(&Rectangle::new([(x, 38), (x + 12, 50)], colour(verdict).filled()))?;
            root.draw(&Text::new(verdict.to_string(), (x + 16, 37), style(FONT)))?;
        }
        for (k, solver) in solvers.iter().enumerate() {
            let y0 = TOP + panel * k as i32;
            let battery = || entries.iter().filter(|e| e.solver == *solver && e.case.group == Group::Battery);
            let converged = battery().filter(|e| e.verdict == Verdict::Converged).count();
            let title = format!("{solver}: {converged} of {} converge", battery().count());
            root.draw(&Text::new(title, (10, y0 + 6), style(FONT + 2)))?;
            let right = Pos::new(HPos::Right, VPos::Center);
            for (s, speed) in SPEEDS.iter().enumerate() {
                let x = LEFT + s as i32 * (ROUGHNESSES.len() as i32 * CELL.0 + GAP);
                root.draw(&Text::new(format!("{speed} m/s"), (x, y0 + 28), style(FONT)))?;
                for (r, rq) in ROUGHNESSES.iter().enumerate() {
                    let at = (x + r as i32 * CELL.0 + CELL.0 / 2, y0 + 54);
                    let middle = style(11).pos(Pos::new(HPos::Center, VPos::Center));
                    root.draw(&Text::new(format!("{:.0}", rq * 1e9), at, middle))?;
                }
            }
            root.draw(&Text::new("Rq / nm", (LEFT - 8, y0 + 54), style(12).pos(right)))?;
            for (l, length) in LENGTHS.iter().enumerate() {
                for (p, pressure) in PRESSURES.iter().enumerate() {
                    let group = (l * PRESSURES.len() + p) as i32;
                    let y = y0 + PANEL_TOP + group * (HARDNESSES.len() as i32 * CELL.1 + GAP / 2);
                    let label = format!("{:.0} um, {:.2} GPa", length * 1e6, pressure * 1e-9);
                    let at = (LEFT - 46, y + HARDNESSES.len() as i32 * CELL.1 / 2);
                    root.draw(&Text::new(label, at, style(13).pos(right)))?;
                    for (h, hardness) in HARDNESSES.iter().enumerate() {
                        let row = y + h as i32 * CELL.1;
                        let label = hardness.map_or("none".to_owned(), |h| format!("{:.0} GPa", h * 1e-9));
                        root.draw(&Text::new(label, (LEFT - 4, row + CELL.1 / 2), style(11).pos(right)))?;
                    }
                }
            }
            for entry in battery() {
                for (x, y) in places(&entry.case) {
                    let corner = (LEFT + x, y0 + PANEL_TOP + y);
                    let opposite = (corner.0 + CELL.0 - 1, corner.1 + CELL.1 - 1);
                    root.draw(&Rectangle::new([corner, opposite], colour(entry.verdict).filled()))?;
                }
            }
        }
        root.present()?;
    }
    Ok(())
}

/// Where a case of the battery stands in its panel; smooth ones have no length and stand in all.
fn places(case: &Case) -> Vec<(i32, i32)> {
    let at = |list: &[f64], value: f64| list.iter().position(|v| v.total_cmp(&value).is_eq());
    let hardness = HARDNESSES.iter().position(|h| *h == case.hardness);
    let (Some(speed), Some(rq), Some(pressure), Some(hardness)) =
        (at(&SPEEDS, case.speed), at(&ROUGHNESSES, case.rq), at(&PRESSURES, case.pressure), hardness)
    else {
        return Vec::new();
    };
    let x = speed as i32 * (ROUGHNESSES.len() as i32 * CELL.0 + GAP) + rq as i32 * CELL.0;
    let row = |length: usize| {
        let group = (length * PRESSURES.len() + pressure) as i32;
        (x, group * (HARDNESSES.len() as i32 * CELL.1 + GAP / 2) + hardness as i32 * CELL.1)
    };
    match at(&LENGTHS, case.lengths[0]) {
        _ if case.rq <= 0.0 => (0..LENGTHS.len()).map(row).collect(),
        Some(length) => vec![row(length)],
        None => Vec::new(),
    }
}
