//! Limits of mixed contacts as cells become small, by two discretisations that agree, and what coarse meshes
//! make of them.

mod figure;
mod limits;
mod plan;
mod run;

use std::error::Error;
use std::path::Path;

use plan::{CELLS, LAWS, Run};
use run::Row;
use stribeck::reynolds::ContactState;

/// Solves what `reference_runs.csv` in `folder` does not hold yet; writes the limits to `reference.csv` and
/// draws `reference.svg`.
pub(crate) fn run(folder: &Path, finest: usize) -> Result<(), Box<dyn Error>> {
    let table = folder.join("reference_runs.csv");
    let known: Vec<String> = if table.exists() {
        std::fs::read_to_string(&table)?.lines().map(str::to_owned).collect()
    } else {
        vec![run::COLUMNS.to_owned()]
    };
    if known.first().map(String::as_str) != Some(run::COLUMNS) {
        return Err(format!("{}: not a table of this example", table.display()).into());
    }
    let plan = plan::all(finest);
    let mut lines = known;
    for (k, run) in plan.iter().enumerate() {
        chain(*run, &mut lines, &table, &format!("{} of {}", k + 1, plan.len()))?;
    }
    // Finer meshes that the table holds count too.
    let all = plan.iter().flat_map(|run| LAWS.map(|law| Run { law, ..*run }));
    let all = all.flat_map(|run| CELLS.map(|cells| Run { cells, ..run }));
    let rows: Vec<Row> = all.filter_map(|run| Row::find(run, &lines)).collect();
    std::fs::write(folder.join("reference.csv"), limits::table(&rows)?)?;
    figure::draw(&rows, &folder.join("reference.svg"))?;
    print!("{}", limits::text(&rows)?);
    println!("tables and figure are in {}", folder.display());
    Ok(())
}

/// Solves a contact from coarse to fine meshes, each from the solution on the one before, other laws from
/// that of the first on the same mesh. Adds what `lines` do not hold.
fn chain(run: Run, lines: &mut Vec<String>, table: &Path, place: &str) -> Result<(), Box<dyn Error>> {
    let on = |cells: usize| {
        LAWS.map(|law| Run { law, cells, ..run }).into_iter().filter(|run| run.cells <= run.finest())
    };
    let is_known = |run: Run, lines: &[String]| Row::find(run, lines).is_some();
    let meshes = || CELLS.into_iter().filter(|cells| *cells <= run.cells);
    if meshes().flat_map(on).all(|run| is_known(run, lines)) {
        return Ok(());
    }
    let mut start: Option<ContactState> = None;
    for cells in meshes() {
        let mut solved = None;
        for (k, run) in on(cells).enumerate() {
            // The first law is what the others, and the next mesh, start from.
            if k > 0 && is_known(run, lines) {
                continue;
            }
            let (row, state) = run::solve(run, if k == 0 { start.take() } else { solved.clone() })?;
            if k == 0 {
                start = Some(run::finer(&state, cells));
                solved = Some(state);
            }
            eprintln!("{place}: {}", row.line());
            if !is_known(run, lines) {
                lines.push(row.line());
                std::fs::write(table, lines.join("\n") + "\n")
                    .map_err(|error| format!("{}: {error}", table.display()))?;
            }
        }
    }
    Ok(())
}
