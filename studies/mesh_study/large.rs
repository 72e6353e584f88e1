//! The rough reference scene on the same band-limited surface from mesh to mesh, over the film cut-off, for two
//! flow laws, the published contact and the dry one.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use stribeck::benchmark::{Case, HeightsOnGrid, Quantity, Results, Row};
use stribeck::sim::Scene;
use stribeck::sim::scene::InletSpec;
use stribeck::surface::{Autocorrelation, RoughnessSpec};

use crate::figure::{Curve, Panel, Points, draw};
use crate::{QUANTITIES, solve};

const CELLS: [usize; 6] = [32, 64, 128, 256, 512, 1024];
/// Cells of the mesh on which the surfaces are generated.
const SURFACE_CELLS: usize = 64;
/// Mesh on which all contacts are solved over the film cut-off.
const MESH: usize = 128;
/// Film cut-offs \[nm\], that of the study of meshes first.
const CUTOFFS: [f64; 6] = [1.0, 0.3, 0.5, 2.0, 3.0, 5.0];
/// Contacts with their settings. The sweeps of the published contact are slow: it has no grid above 256 cells.
const CONTACTS: [(&str, &str); 4] = [
    ("inlet", "auto:scheme=limited,face_mobility=inlet,cavitation=mass_conserving"),
    ("means", "auto:scheme=first_order,face_mobility=reduced_pressure,cavitation=reynolds"),
    ("dry", "dry"),
    ("paper", "auto:contact=paper,cavitation=reynolds,max_iterations=10000"),
];

/// Solves all contacts on up to `finest` cells; writes `mixed.csv` and `mixed.svg`, and returns tables.
pub(crate) fn run(folder: &Path, finest: usize) -> Result<String, Box<dyn Error>> {
    let up_to = |most: usize| CELLS.into_iter().filter(move |cells| *cells <= most.min(finest));
    // Surfaces of 64 cells do not fit a coarser mesh.
    let surface = SURFACE_CELLS.min(finest);
    let meshes = |most: usize| up_to(most).filter(|cells| *cells >= surface);
    let path = folder.join("mixed.csv");
    let cases = CUTOFFS.map(|cutoff| case(cutoff, surface)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let (first, others) = (cases[..1].to_vec(), cases[1..].to_vec());
    let mut results = solve(first.clone(), &CONTACTS[..3], meshes(1024), path.clone())?;
    results = results.merged(solve(first, &CONTACTS[3..], meshes(256), path.clone())?);
    if finest >= MESH {
        results = results.merged(solve(others.clone(), &CONTACTS[..1], meshes(256), path.clone())?);
        let rest = [CONTACTS[1], CONTACTS[3]];
        results = results.merged(solve(others, &rest, [MESH], path)?);
    }
    picture(&results, &folder.join("mixed.svg"))?;
    Ok(tables(&results)?)
}

/// The reference scene at 0.1 m/s with the surfaces of a coarse mesh by their Fourier series.
fn case(cutoff: f64, surface: usize) -> Result<Case, Box<dyn Error>> {
    let mut scene = Scene::azam_2019(surface);
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    scene.solver.film_cutoff = 1e-9 * cutoff;
    scene.solver.edge_contact = true;
    scene.roughness = Default::default();
    let surfaces = [(20e-9, 1), (130e-9, 2)].map(|(rq, seed)| RoughnessSpec {
        autocorrelation: Autocorrelation::Gaussian,
        rq,
        length_x: 10e-6,
        length_y: 10e-6,
        seed,
    });
    let heights = HeightsOnGrid::by_fourier_series(scene.grid()?, surfaces);
    Ok(Case::new(format!("film cut-off {cutoff} nm"), scene)
        .with_parameters(vec![("film_cutoff".to_owned(), cutoff)])
        .with_heights(Some(heights)))
}

fn found<'a>(results: &'a Results, contact: &str, cutoff: f64, cells: usize) -> Option<&'a Row> {
    let is_it = |row: &&Row| row.contestant == contact && row.cells == cells;
    results.rows().iter().filter(is_it).find(|row| row.parameters[0].1.total_cmp(&cutoff).is_eq())
}

fn tables(results: &Results) -> Result<String, std::fmt::Error> {
    let mut text = String::from("| contact | cells | area ratio | load ratio | mean film, nm | friction |\n");
    text += "|---|---|---|---|---|---|\n";
    for (contact, _) in CONTACTS {
        for row in CELLS.into_iter().filter_map(|cells| found(results, contact, CUTOFFS[0], cells)) {
            let [area, load, film, friction] = QUANTITIES.map(|quantity| row.value(quantity));
            let remark = if row.is_solved() { "" } else { ", not converged" };
            let film = 1e9 * film;
            writeln!(
                text,
                "| {contact} | {}{remark} | {area:.3} | {load:.3} | {film:.1} | {friction:.4} |",
                row.cells
            )?;
        }
    }
    text += "\nLoad ratio, inlet:\n\n| film cut-off, nm | cells: load ratio |\n|---|---|\n";
    let mut cutoffs = CUTOFFS;
    cutoffs.sort_unstable_by(f64::total_cmp);
    for cutoff in cutoffs {
        write!(text, "| {cutoff} |")?;
        for row in CELLS.into_iter().filter_map(|cells| found(results, "inlet", cutoff, cells)) {
            write!(text, " {}: {:.3}", row.cells, row.value(Quantity::LoadRatio))?;
        }
        writeln!(text, " |")?;
    }
    Ok(text)
}

/// A row of panels for each quantity: over the cells on the left, over the film cut-off on the right.
fn picture(results: &Results, path: &Path) -> Result<(), Box<dyn Error>> {
    let axes = [("area ratio", 1.0, 1.05), ("load ratio", 1.0, 1.05), ("mean film / nm", 1e9, 70.0)];
    let axes = axes.into_iter().chain([("friction coefficient", 1.0, 0.14)]);
    let mut panels = Vec::new();
    for (quantity, (y_label, factor, top)) in QUANTITIES.into_iter().zip(axes) {
        let point = |x: f64, row: &Row| {
            let value = factor * row.value(quantity);
            // Films of unconverged states are far below zero: their mark is at the edge of the panel.
            value.is_finite().then(|| (x, value.clamp(0.0, top), row.is_solved()))
        };
        let over_cells = |contact: &str| {
            let rows = CELLS.into_iter().filter_map(|cells| found(results, contact, CUTOFFS[0], cells));
            rows.filter_map(|row| point(row.cells as f64, row)).collect()
        };
        let over_cutoff = |contact: &str| {
            let of = |cutoff: f64| {
                let own = if contact == "dry" { CUTOFFS[0] } else { cutoff };
                point(cutoff, found(results, contact, own, MESH)?)
            };
            let mut points: Vec<_> = CUTOFFS.into_iter().filter_map(of).collect();
            points.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        let curves = |points: &dyn Fn(&str) -> Points| {
            (0..CONTACTS.len()).map(|k| Curve { pen: k, points: points(CONTACTS[k].0) }).collect()
        };
        let (y_label, bands) = (y_label.to_owned(), Vec::new());
        let cells = curves(&over_cells);
        panels.push(Panel {
            y_label: y_label.clone(),
            x_label: "cells along each side",
            top,
            bands,
            curves: cells,
        });
        let (x_label, cutoffs) = ("film cut-off / nm, 128 cells", curves(&over_cutoff));
        panels.push(Panel { y_label, x_label, top, bands: Vec::new(), curves: cutoffs });
    }
    draw(path, 2, &CONTACTS.map(|(name, _)| name.to_owned()), &panels)
}
