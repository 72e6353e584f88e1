//! The limits of fine meshes, and how far from them coarse meshes are.

use std::error::Error;
use std::fmt::Write as _;

use super::plan::{CELLS, Case, LAWS, Law, Miniature, Run, SEEDS, cases};
use super::run::Row;

pub(crate) const COLUMNS: &str = "scene,radius_m,box_m,rq_ball_m,rq_disc_m,length_m,film_cutoff_m,entrainment_speed_m_per_s,cavitation,\
     seed,cells,area_ratio,area_ratio_spread,load_ratio,load_ratio_spread,mean_film_m,mean_film_spread_m,\
     friction_coefficient,friction_coefficient_spread";

impl Case {
    /// Area ratio, load ratio, mean film and friction of a surface on a mesh, where its solve converged.
    fn values(&self, rows: &[Row], law: Law, seed: u64, cells: usize) -> Option<[f64; 4]> {
        let Self { miniature, speed, cavitation } = *self;
        let run = Run { miniature, speed, cavitation, law, seed, cells };
        rows.iter().find(|row| row.run == run && row.converged()).map(|row| row.values)
    }
}

/// Numbers of one surface as cells become small, with their spreads: area ratio, load ratio, mean film \[m\]
/// and friction.
#[derive(Debug)]
pub(crate) struct OfSurface {
    seed: u64,
    /// Cells of the finest mesh.
    cells: usize,
    values: [f64; 4],
    spreads: [f64; 4],
}

/// Those of a case: means over its surfaces.
#[derive(Debug)]
pub(crate) struct Limit {
    surfaces: Vec<OfSurface>,
    pub(crate) values: [f64; 4],
    pub(crate) spreads: [f64; 4],
}

impl Limit {
    /// Cells of the coarsest of the meshes that the limit is of.
    fn cells(&self) -> usize {
        self.surfaces.iter().map(|surface| surface.cells).min().unwrap_or(0)
    }
}

/// The limit of one surface, from the finest mesh that both laws with limited entrainment converge on: the
/// value of the first law; the spread is what the second differs by, or what the first changed by from the
/// mesh before where that is more.
fn of_surface(case: &Case, rows: &[Row], seed: u64) -> Option<OfSurface> {
    let on = |law, cells| case.values(rows, law, seed, cells);
    CELLS.into_iter().rev().find_map(|cells| {
        let (before, values) = (on(Law::Inlet, cells / 2)?, on(Law::Inlet, cells)?);
        let other = on(Law::Wedge, cells)?;
        let spreads =
            std::array::from_fn(|k| (values[k] - other[k]).abs().max((values[k] - before[k]).abs()));
        Some(OfSurface { seed, cells, values, spreads })
    })
}

/// The limit of a case; none where no surface has one.
pub(crate) fn limit(case: &Case, rows: &[Row]) -> Option<Limit> {
    let surfaces: Vec<OfSurface> =
        SEEDS.into_iter().filter_map(|seed| of_surface(case, rows, seed)).collect();
    if surfaces.is_empty() {
        return None;
    }
    let mean = |of: &dyn Fn(&OfSurface) -> f64| surfaces.iter().map(of).sum::<f64>() / surfaces.len() as f64;
    Some(Limit {
        values: std::array::from_fn(|k| mean(&|surface| surface.values[k])),
        spreads: std::array::from_fn(|k| mean(&|surface| surface.spreads[k])),
        surfaces,
    })
}

/// The limits, a line for each surface of each case.
pub(crate) fn table(rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let mut text = format!("{COLUMNS}\n");
    for case in cases() {
        let Some(limit) = limit(&case, rows) else { continue };
        let Case { miniature, speed, cavitation } = case;
        let Miniature { name, rq, length, film_cutoff, .. } = miniature;
        for OfSurface { seed, cells, values, spreads } in limit.surfaces {
            let scene = Run { miniature, speed, cavitation, law: Law::Inlet, seed, cells }.scene();
            let (grid, radius) = (scene.grid()?, scene.form.radii().0);
            write!(
                text,
                "{name},{radius:e},{:e},{:e},{:e},{length:e},{film_cutoff:e},{speed},{},{seed},{cells}",
                grid.size_x(),
                rq[0],
                rq[1],
                cavitation.1
            )?;
            for (value, spread) in values.into_iter().zip(spreads) {
                write!(text, ",{value:.5e},{spread:.1e}")?;
            }
            writeln!(text)?;
        }
    }
    Ok(text)
}

/// The mean over the surfaces of a limit.
pub(crate) fn mean(case: &Case, limit: &Limit, rows: &[Row], law: Law, cells: usize) -> Option<[f64; 4]> {
    let on = |surface: &OfSurface| case.values(rows, law, surface.seed, cells);
    let found: Vec<[f64; 4]> = limit.surfaces.iter().map(on).collect::<Option<_>>()?;
    Some(std::array::from_fn(|k| found.iter().map(|values| values[k]).sum::<f64>() / found.len() as f64))
}

/// Tables to read: limits, the meshes on the way there, and errors of each law.
pub(crate) fn text(rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    writeln!(
        text,
        "| scene | speed, m/s | cavitation | cells | area ratio | load ratio | mean film, nm | friction |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|")?;
    for case in cases() {
        let Some(limit) = limit(&case, rows) else { continue };
        let (name, [area, load, film, friction], spread) = (case.miniature.name, limit.values, limit.spreads);
        writeln!(
            text,
            "| {name} | {} | {} | {} | {area:.3} ± {:.3} | {load:.3} ± {:.3} | {:.2} ± {:.2} | {friction:.4} ± {:.4} |",
            case.speed,
            case.cavitation.1,
            limit.cells(),
            spread[0],
            spread[1],
            1e9 * film,
            1e9 * spread[2],
            spread[3]
        )?;
    }
    for (k, name) in ["area ratio", "load ratio", "mean film, nm", "friction"].into_iter().enumerate() {
        writeln!(text, "\nMean over surfaces, {name} on cells of\n")?;
        head(&mut text)?;
        for (case, law) in cases().into_iter().flat_map(|case| LAWS.map(|law| (case, law))) {
            let Some(limit) = limit(&case, rows) else { continue };
            write!(
                text,
                "| {} | {} | {} | {} |",
                case.miniature.name,
                case.speed,
                case.cavitation.1,
                law.name()
            )?;
            for cells in CELLS {
                match mean(&case, &limit, rows, law, cells) {
                    Some(values) => write!(text, " {:.3} |", values[k] * if k == 2 { 1e9 } else { 1.0 })?,
                    None => write!(text, " |")?,
                }
            }
            writeln!(text)?;
        }
    }
    errors(&mut text, rows)?;
    Ok(text)
}

/// Size of cells \[um\].
pub(crate) fn size(cells: usize) -> f64 {
    62.5 / cells as f64
}

fn head(text: &mut String) -> std::fmt::Result {
    let names: Vec<String> = CELLS.iter().map(|cells| format!("{:.2} um", size(*cells))).collect();
    writeln!(text, "| scene | speed, m/s | cavitation | faces | {} |", names.join(" | "))?;
    writeln!(text, "|---|---|---|---{}|", "|---".repeat(CELLS.len()))
}

/// Distances of single contacts from their limits on meshes coarser than those of the limits, of films and
/// friction relative: mean and largest, by the load ratio of the limit.
fn errors(text: &mut String, rows: &[Row]) -> std::fmt::Result {
    let limits: Vec<(Case, Limit)> =
        cases().into_iter().filter_map(|case| limit(&case, rows).map(|limit| (case, limit))).collect();
    writeln!(text, "\nDistance of single contacts from their limits, mean (largest):\n")?;
    writeln!(
        text,
        "| load ratio | faces | cells | contacts | area ratio | load ratio | mean film | friction |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|")?;
    for (name, range) in [("below 0.1", 0.0..0.1), ("0.1 to 0.9", 0.1..0.9), ("above 0.9", 0.9..1.1)] {
        for (law, cells) in LAWS.into_iter().flat_map(|law| CELLS.map(|cells| (law, cells))) {
            let surfaces = limits
                .iter()
                .flat_map(|(case, limit)| limit.surfaces.iter().map(move |surface| (case, surface)))
                .filter(|(_, surface)| cells < surface.cells && range.contains(&surface.values[1]));
            let found: Vec<[f64; 4]> = surfaces
                .filter_map(|(case, surface)| {
                    let (values, limit) = (case.values(rows, law, surface.seed, cells)?, surface.values);
                    let scale = [1.0, 1.0, limit[2], limit[3]];
                    Some(std::array::from_fn(|k| (values[k] - limit[k]).abs() / scale[k]))
                })
                .collect();
            if found.is_empty() {
                continue;
            }
            write!(text, "| {name} | {} | {:.2} um | {} |", law.name(), size(cells), found.len())?;
            for k in 0..4 {
                let mean = found.iter().map(|d| d[k]).sum::<f64>() / found.len() as f64;
                let largest = found.iter().fold(0.0_f64, |most, d| most.max(d[k]));
                write!(text, " {mean:.3} ({largest:.3}) |")?;
            }
            writeln!(text)?;
        }
    }
    Ok(())
}
