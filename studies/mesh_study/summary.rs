//! What the table says, in tables to read.

use std::fmt::{Error, Write as _};

use crate::contact::Row;
use crate::plan::{CONTACTS, CUTOFF, CUTOFFS, Contact, FULLER, MESH, REFERENCE, SEEDS, SLOW, SPEED};

/// Which rows a table is of.
#[derive(Clone, Copy)]
pub(crate) struct Choice {
    pub(crate) contact: Contact,
    pub(crate) cells: usize,
    pub(crate) cutoff: f64,
    pub(crate) speed: f64,
    pub(crate) rq: [f64; 2],
}

impl Choice {
    /// The reference scene on a mesh.
    pub(crate) fn reference(contact: Contact, cells: usize) -> Self {
        Self { contact, cells, cutoff: CUTOFF, speed: SPEED, rq: REFERENCE }
    }

    fn fits(&self, row: &Row) -> bool {
        let job = &row.job;
        let same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        job.contact == self.contact
            && job.cells == self.cells
            && same(job.cutoff, self.cutoff)
            && same(job.speed, self.speed)
            && same(job.rq[1], self.rq[1])
    }
}

/// Mean over the surfaces of those solves that converged, of all where none did.
pub(crate) struct Mean {
    pub(crate) converged: usize,
    count: usize,
    pub(crate) values: [f64; 4],
    /// The largest mass residual and the smallest gap of what the mean is of.
    mass: f64,
    gap: f64,
}

/// The mean of the chosen rows; none without any.
pub(crate) fn mean(rows: &[Row], choice: Choice) -> Option<Mean> {
    let chosen: Vec<&Row> = rows.iter().filter(|row| choice.fits(row)).collect();
    let converged = chosen.iter().filter(|row| row.converged()).count();
    let of: Vec<&&Row> = chosen.iter().filter(|row| row.converged() || converged == 0).collect();
    if of.is_empty() {
        return None;
    }
    let value = |k: usize| of.iter().map(|row| row.values[k]).sum::<f64>() / of.len() as f64;
    Some(Mean {
        converged,
        count: chosen.len(),
        values: [value(0), value(1), value(2), value(3)],
        mass: of.iter().fold(0.0, |most, row| row.residuals[0].max(most)),
        gap: of.iter().fold(f64::INFINITY, |least, row| row.gap.min(least)),
    })
}

impl Mean {
    fn cells(&self) -> String {
        let [area, share, film, friction] = self.values;
        format!(
            "{} of {} | {area:.3} | {share:.3} | {:.1} | {friction:.4} | {:.0e} | {:.1}",
            self.converged,
            self.count,
            1e9 * film,
            self.mass,
            1e9 * self.gap
        )
    }
}

const HEAD: &str =
    "converged | area ratio | load ratio | mean film, nm | friction | mass residual | least gap, nm |";

pub(crate) fn text(rows: &[Row]) -> Result<String, Error> {
    let mut text = String::new();
    mesh(&mut text, rows)?;
    scatter(&mut text, rows)?;
    powers(&mut text, rows)?;
    cutoffs(&mut text, rows)?;
    speeds(&mut text, rows)?;
    fuller(&mut text, rows)?;
    Ok(text)
}

/// Numbers of cells in the table, upwards.
pub(crate) fn cells(rows: &[Row]) -> Vec<usize> {
    let mut cells: Vec<usize> = rows.iter().map(|row| row.job.cells).collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

fn mesh(text: &mut String, rows: &[Row]) -> Result<(), Error> {
    writeln!(text, "\nFirst surface, contact film 1 nm:\n\n| contact | cells | {HEAD}")?;
    writeln!(text, "|---|---|---|---|---|---|---|---|---|")?;
    let first = first(rows);
    for contact in CONTACTS {
        for cells in cells(rows) {
            if let Some(mean) = mean(&first, Choice::reference(contact, cells)) {
                writeln!(text, "| {contact} | {cells} | {} |", mean.cells())?;
            }
        }
    }
    Ok(())
}

/// Least and largest value of the surfaces where there are several, in per cent from their mean.
fn scatter(text: &mut String, rows: &[Row]) -> Result<(), Error> {
    writeln!(text, "\nContact film 1 nm, mean over surfaces and largest distance from it in per cent:\n")?;
    writeln!(text, "| contact | cells | converged | area ratio | load ratio | mean film, nm | friction |")?;
    writeln!(text, "|---|---|---|---|---|---|---|")?;
    for contact in CONTACTS {
        for cells in cells(rows) {
            let choice = Choice::reference(contact, cells);
            let Some(mean) = mean(rows, choice).filter(|mean| mean.count > 1) else { continue };
            write!(text, "| {contact} | {cells} | {} of {} |", mean.converged, mean.count)?;
            for (k, factor) in [1.0, 1.0, 1e9, 1.0].into_iter().enumerate() {
                let of = rows.iter().filter(|row| choice.fits(row) && row.converged());
                let far = of.fold(0.0_f64, |far, row| far.max((row.values[k] / mean.values[k] - 1.0).abs()));
                write!(text, " {:.4} ({:.1} %) |", factor * mean.values[k], 100.0 * far)?;
            }
            writeln!(text)?;
        }
    }
    Ok(())
}

/// Of the first surface: the power of the cell size that a quantity falls or grows with from one mesh to the
/// next, and from the third mesh on the order of its changes.
fn powers(text: &mut String, rows: &[Row]) -> Result<(), Error> {
    writeln!(text, "\nFirst surface alone, power of the cell size (order of the changes):\n")?;
    writeln!(text, "| contact | cells | area ratio | load ratio | mean film | friction |")?;
    writeln!(text, "|---|---|---|---|---|---|")?;
    for contact in CONTACTS {
        let found = |cells: usize| {
            let choice = Choice::reference(contact, cells);
            rows.iter().find(|row| choice.fits(row) && row.job.seed == SEEDS[0] && row.converged())
        };
        for cells in cells(rows) {
            let (Some(coarse), Some(fine)) = (found(cells), found(2 * cells)) else { continue };
            write!(text, "| {contact} | {cells} to {} |", 2 * cells)?;
            for k in 0..4 {
                write!(text, " {:+.2}", (coarse.values[k] / fine.values[k]).log2())?;
                if let Some(coarser) = found(cells / 2) {
                    let (before, now) =
                        (coarse.values[k] - coarser.values[k], fine.values[k] - coarse.values[k]);
                    // A load ratio that is 1 on every mesh changes by rounding.
                    if before.abs().min(now.abs()) > 1e-6 * coarse.values[k].abs() {
                        write!(text, " ({:.1})", (before / now).abs().log2())?;
                    }
                }
                write!(text, " |")?;
            }
            writeln!(text)?;
        }
    }
    Ok(())
}

fn cutoffs(text: &mut String, rows: &[Row]) -> Result<(), Error> {
    writeln!(
        text,
        "\nContact film at {MESH} cells, mean over surfaces:\n\n| contact | contact film, nm | {HEAD}"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|---|")?;
    for contact in CONTACTS.into_iter().filter(|contact| *contact != Contact::Dry) {
        for cutoff in CUTOFFS {
            let choice = Choice { cutoff, ..Choice::reference(contact, MESH) };
            if let Some(mean) = mean(rows, choice) {
                writeln!(text, "| {contact} | {:.1} | {} |", 1e9 * cutoff, mean.cells())?;
            }
        }
    }
    let first = first(rows);
    for (k, name) in [(0, "area ratio"), (1, "load ratio")] {
        writeln!(text, "\nFirst surface alone, {name} over cells and contact film (none: not solved):\n")?;
        write!(text, "| contact | contact film, nm |")?;
        for cells in cells(rows) {
            write!(text, " {cells} |")?;
        }
        writeln!(text, "\n|---|---|{}", "---|".repeat(cells(rows).len()))?;
        for contact in [Contact::Inlet, Contact::Means] {
            for cutoff in CUTOFFS {
                write!(text, "| {contact} | {:.1} |", 1e9 * cutoff)?;
                for cells in cells(rows) {
                    match mean(&first, Choice { cutoff, ..Choice::reference(contact, cells) }) {
                        Some(mean) if mean.converged > 0 => write!(text, " {:.3} |", mean.values[k])?,
                        Some(_) => write!(text, " not converged |")?,
                        None => write!(text, " |")?,
                    }
                }
                writeln!(text)?;
            }
        }
    }
    Ok(())
}

/// The rows of the first surface.
pub(crate) fn first(rows: &[Row]) -> Vec<Row> {
    rows.iter().filter(|row| row.job.seed == SEEDS[0]).cloned().collect()
}

/// Speeds of the first surface, the dry contact last.
fn speeds(text: &mut String, rows: &[Row]) -> Result<(), Error> {
    writeln!(text, "\nFirst surface at {MESH} cells over the speed:\n\n| speed, m/s | {HEAD}")?;
    writeln!(text, "|---|---|---|---|---|---|---|---|")?;
    let first = first(rows);
    for speed in std::iter::once(SPEED).chain(SLOW) {
        if let Some(mean) = mean(&first, Choice { speed, ..Choice::reference(Contact::Inlet, MESH) }) {
            writeln!(text, "| {speed:e} | {} |", mean.cells())?;
        }
    }
    if let Some(mean) = mean(&first, Choice::reference(Contact::Dry, MESH)) {
        writeln!(text, "| dry | {} |", mean.cells())?;
    }
    Ok(())
}

fn fuller(text: &mut String, rows: &[Row]) -> Result<(), Error> {
    let (speed, rq) = FULLER;
    writeln!(text, "\n{speed} m/s, Rq {:.0} and {:.0} nm:\n", 1e9 * rq[0], 1e9 * rq[1])?;
    writeln!(text, "| contact | cells | {HEAD}\n|---|---|---|---|---|---|---|---|---|")?;
    for contact in CONTACTS {
        for cells in cells(rows) {
            let choice = Choice { speed, rq, ..Choice::reference(contact, cells) };
            if let Some(mean) = mean(rows, choice) {
                writeln!(text, "| {contact} | {cells} | {} |", mean.cells())?;
            }
        }
    }
    Ok(())
}
