//! Limits of mixed contacts as cells become small, by two discretisations that agree, and what coarse meshes make of them.

mod figure;
mod limits;
mod plan;
mod run;

use std::error::Error;
use std::path::Path;

use plan::Run;
use run::Row;

/// Solves what `reference_runs.csv` in `folder` does not hold yet; writes the limits to `reference.csv` and draws `reference.svg`.
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
        let meshes =
            || plan::CELLS.into_iter().filter(|cells| *cells <= run.cells).map(|cells| Run { cells, ..*run });
        if meshes().all(|run| Row::find(run, &lines).is_some()) {
            continue;
        }
        let mut start = None;
        for run in meshes() {
            let (row, state) = run::solve(run, start.as_ref())?;
            eprintln!("{} of {}: {}", k + 1, plan.len(), row.line());
            if Row::find(run, &lines).is_none() {
                lines.push(row.line());
                std::fs::write(&table, lines.join("\n") + "\n")?;
            }
            start = Some(state);
        }
    }
    // Finer meshes that the table holds count too.
    let all = plan.iter().flat_map(|run| plan::CELLS.map(|cells| Run { cells, ..*run }));
    let rows: Vec<Row> = all.filter_map(|run| Row::find(run, &lines)).collect();
    std::fs::write(folder.join("reference.csv"), limits::table(&rows)?)?;
    figure::draw(&rows, &folder.join("reference.svg"))?;
    print!("{}", limits::text(&rows)?);
    println!("tables and figure are in {}", folder.display());
    Ok(())
}
