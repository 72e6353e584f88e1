//! Limits of small mixed contacts as cells become small, by two discretizations that agree, and the errors of
//! coarse meshes. The contacts are the list `references` of the benchmark.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use stribeck::benchmark::{Case, Cases, Quantity, Results};

use crate::figure::{Curve, Panel, draw};
use crate::{QUANTITIES, solve};

/// Scenes of the list, a line each, with the limits that this study renews.
const KNOWN: &str = include_str!("../../docs/reference.csv");
/// Columns of it that describe the scene.
const SCENE_COLUMNS: usize = 10;
/// Cells along each side, 3.9 um to 0.12 um.
const CELLS: [usize; 6] = [16, 32, 64, 128, 256, 512];
/// Finest mesh of contacts outside the mixed regime, and of the means of cubes.
const FINEST_OF_OTHERS: usize = 256;
const FINEST_OF_MEANS: usize = 128;
/// Flow laws; the first one has the limit, the second one bounds its error.
const LAWS: [(&str, &str); 3] = [
    ("inlet", "newton_krylov:face_mobility=inlet,max_iterations=100"),
    ("wedge", "newton_krylov:face_mobility=wedge,max_iterations=100"),
    ("means", "newton_krylov:scheme=first_order,face_mobility=reduced_pressure,max_iterations=100"),
];

/// Limit of one surface: values and uncertainties of the quantities, and cells of its mesh.
struct Limit {
    case: String,
    cells: usize,
    values: [f64; 4],
    spreads: [f64; 4],
}

/// Scene, speed and cavitation of a case, without the surface.
fn scene(case: &str) -> &str {
    case.rsplit_once(", surface").map_or(case, |(scene, _)| scene)
}

/// Solves all contacts on up to `finest` cells; writes `reference_runs.csv`, `reference.csv` and `reference.svg`,
/// and returns tables.
pub(crate) fn run(folder: &Path, finest: usize) -> Result<String, Box<dyn Error>> {
    let path = folder.join("reference_runs.csv");
    let all = Cases::named("references", 1)?.cases;
    // The middle speeds, which are in the mixed regime by the mean over the surfaces.
    let ratio = |case: &Case| Some(case.reference.as_ref()?.get(Quantity::LoadRatio)?.0);
    let is_mixed = |case: &&Case| {
        let same = all.iter().filter(|other| scene(&other.name) == scene(&case.name));
        let ratios: Vec<f64> = same.filter_map(ratio).collect();
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        case.has_tag("mass_conserving") && (0.1..0.9).contains(&mean)
    };
    let up_to = |most: usize| CELLS.into_iter().filter(move |cells| *cells <= most.min(finest));
    let mut results = solve(all.clone(), &LAWS[..2], up_to(FINEST_OF_OTHERS), path.clone())?;
    if finest > FINEST_OF_OTHERS {
        let mixed: Vec<Case> = all.iter().filter(is_mixed).cloned().collect();
        results = results.merged(solve(mixed, &LAWS[..2], [finest], path.clone())?);
    }
    results = results.merged(solve(all.clone(), &LAWS[2..], up_to(FINEST_OF_MEANS), path)?);
    let limits: Vec<Limit> = all.iter().filter_map(|case| limit(&case.name, &results)).collect();
    std::fs::write(folder.join("reference.csv"), table(&all, &limits))?;
    picture(&results, &limits, &folder.join("reference.svg"))?;
    Ok(means(&limits)? + &errors(&results, &limits)?)
}

/// Values of a solved contact.
fn values(results: &Results, law: &str, case: &str, cells: usize) -> Option<[f64; 4]> {
    let mut rows = results.of(law).filter(|row| row.is_solved() && row.case == case);
    rows.find(|row| row.cells == cells).map(|row| QUANTITIES.map(|quantity| row.value(quantity)))
}

/// The limit of one surface: the first law on the finest mesh on which both laws converge. Its uncertainty is the
/// difference of the laws, or the last change of the first one if that is larger.
fn limit(case: &str, results: &Results) -> Option<Limit> {
    let of = |law: usize, cells| values(results, LAWS[law].0, case, cells);
    CELLS.into_iter().rev().find_map(|cells| {
        let (before, values, other) = (of(0, cells / 2)?, of(0, cells)?, of(1, cells)?);
        let spread = |k: usize| (values[k] - other[k]).abs().max((values[k] - before[k]).abs());
        Some(Limit { case: case.to_owned(), cells, values, spreads: std::array::from_fn(spread) })
    })
}

/// The lines of [`KNOWN`] with these limits.
fn table(cases: &[Case], limits: &[Limit]) -> String {
    let mut lines = KNOWN.lines();
    let mut text = lines.next().map(|head| format!("{head}\n")).unwrap_or_default();
    for (case, line) in cases.iter().zip(lines) {
        let Some(limit) = limits.iter().find(|limit| limit.case == case.name) else { continue };
        let scene: Vec<&str> = line.split(',').take(SCENE_COLUMNS).collect();
        text += &format!("{},{}", scene.join(","), limit.cells);
        let pairs = limit.values.iter().zip(limit.spreads);
        text.extend(pairs.map(|(value, spread)| format!(",{value:.5e},{spread:.1e}")));
        text.push('\n');
    }
    text
}

fn mean(of: &[&Limit], value: impl Fn(&Limit) -> f64) -> f64 {
    of.iter().map(|limit| value(limit)).sum::<f64>() / of.len() as f64
}

/// Limits by scene, in the order of their first surface.
fn by_scene(limits: &[Limit]) -> Vec<Vec<&Limit>> {
    let mut scenes: Vec<Vec<&Limit>> = Vec::new();
    for limit in limits {
        match scenes.iter_mut().find(|of| scene(&of[0].case) == scene(&limit.case)) {
            Some(of) => of.push(limit),
            None => scenes.push(vec![limit]),
        }
    }
    scenes
}

fn means(limits: &[Limit]) -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "Means over the surfaces:\n\n| scene | cells | area ratio | load ratio | mean film, nm | friction |\n",
    );
    text += "|---|---|---|---|---|---|\n";
    for of in by_scene(limits) {
        let cells = of.iter().map(|limit| limit.cells).min().unwrap_or(0);
        write!(text, "| {} | {cells} |", scene(&of[0].case))?;
        for (k, (factor, decimals)) in [(1.0, 3), (1.0, 3), (1e9, 2), (1.0, 4)].into_iter().enumerate() {
            let (value, spread) = (mean(&of, |limit| limit.values[k]), mean(&of, |limit| limit.spreads[k]));
            write!(text, " {:.decimals$} ± {:.decimals$} |", factor * value, factor * spread)?;
        }
        writeln!(text)?;
    }
    Ok(text)
}

/// Errors of single contacts on meshes coarser than those of their limits: mean and largest, by the load ratio of
/// the limit; of films and friction relative.
fn errors(results: &Results, limits: &[Limit]) -> Result<String, std::fmt::Error> {
    let mut groups: BTreeMap<(usize, usize, usize), Vec<[f64; 4]>> = BTreeMap::new();
    let ranges = [("below 0.1", 0.0..0.1), ("0.1 to 0.9", 0.1..0.9), ("above 0.9", 0.9..1.1)];
    for limit in limits {
        let Some(range) = ranges.iter().position(|(_, range)| range.contains(&limit.values[1])) else {
            continue;
        };
        for cells in CELLS.into_iter().filter(|cells| *cells < limit.cells) {
            for (law, (name, _)) in LAWS.iter().enumerate() {
                let Some(values) = values(results, name, &limit.case, cells) else { continue };
                let scale = [1.0, 1.0, limit.values[2], limit.values[3]];
                let error = std::array::from_fn(|k| (values[k] - limit.values[k]).abs() / scale[k]);
                groups.entry((range, law, cells)).or_default().push(error);
            }
        }
    }
    let mut text = String::from("\nErrors of single contacts, mean (largest):\n\n");
    text += "| load ratio | faces | cells | contacts | area ratio | load ratio | mean film | friction |\n";
    text += "|---|---|---|---|---|---|---|---|\n";
    for ((range, law, cells), errors) in groups {
        let (name, law) = (ranges[range].0, LAWS[law].0);
        write!(text, "| {name} | {law} | {:.2} um | {} |", size(cells), errors.len())?;
        for k in 0..4 {
            let mean = errors.iter().map(|error| error[k]).sum::<f64>() / errors.len() as f64;
            let largest = errors.iter().fold(0.0_f64, |most, error| most.max(error[k]));
            write!(text, " {mean:.3} ({largest:.3}) |")?;
        }
        writeln!(text)?;
    }
    Ok(text)
}

/// Size of cells \[um\].
fn size(cells: usize) -> f64 {
    62.5 / cells as f64
}

/// Three quantities of the first surfaces with mass conservation: a column for each scene, over the size of cells.
fn picture(results: &Results, limits: &[Limit], path: &Path) -> Result<(), Box<dyn Error>> {
    let mut panels = Vec::new();
    for (k, name, top) in [(1, "load ratio", 1.05), (0, "area ratio", 0.62), (3, "friction", 0.13)] {
        for scene in ["reference", "rougher", "smoother"] {
            let of = |limit: &&Limit| {
                let is_first = limit.case.ends_with("mass_conserving, surface 1");
                is_first && limit.case.starts_with(&format!("{scene}:"))
            };
            let limits: Vec<&Limit> = limits.iter().filter(of).collect();
            let band = |limit: &&Limit| {
                let (value, spread) = (limit.values[k], limit.spreads[k].max(0.004 * top));
                (value - spread, value + spread)
            };
            let curve = |limit: &Limit, pen: usize| {
                let at =
                    |cells| Some((size(cells), values(results, LAWS[pen].0, &limit.case, cells)?[k], true));
                Curve { pen, points: CELLS.into_iter().filter_map(at).collect() }
            };
            let curves =
                limits.iter().flat_map(|limit| (0..LAWS.len()).map(|pen| curve(limit, pen))).collect();
            let bands = limits.iter().map(band).collect();
            let y_label = format!("{name}, {scene}");
            panels.push(Panel { y_label, x_label: "cells / um", top, bands, curves });
        }
    }
    draw(path, 3, &LAWS.map(|(name, _)| name.to_owned()), &panels)
}
