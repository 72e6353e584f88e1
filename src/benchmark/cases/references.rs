//! Rough contacts with known limits: the reference scene cut down to an eighth, with the limits of fine meshes
//! by two discretizations (`docs/mixed.md`).

use crate::benchmark::case::{Case, HeightsOnGrid};
use crate::benchmark::limits::{Limits, Quantity};
use crate::grid::Grid;
use crate::reynolds::{Cavitation, FaceMobility, Scheme};
use crate::sim::scene::{GridSpec, InletSpec};
use crate::sim::{Scene, SimError};
use crate::surface::{Autocorrelation, Form, RoughnessSpec};

/// Limits, a line for each surface of each scene.
const LIMITS: &str = include_str!("../../../docs/reference.csv");
/// Cells along each side of the mesh on which surfaces are generated. They are brought to others by their Fourier
/// series.
const SURFACE_CELLS: usize = 8;
/// Cells along each side.
const CELLS: usize = 64;

/// All cases.
pub(super) fn cases() -> Result<Vec<Case>, SimError> {
    LIMITS.lines().skip(1).map(case).collect()
}

/// The case of a line.
fn case(line: &str) -> Result<Case, SimError> {
    let damaged = || SimError::Scene { reason: format!("docs/reference.csv: cannot read `{line}`") };
    let fields: Vec<&str> = line.split(',').collect();
    let text = |k: usize| fields.get(k).copied().ok_or_else(damaged);
    let number = |k: usize| text(k)?.parse::<f64>().map_err(|_| damaged());
    let (name, cavitation) = (text(0)?, text(8)?);
    let seed: u64 = text(9)?.parse().map_err(|_| damaged())?;
    let (half, speed) = (0.5 * number(2)?, number(7)?);
    let mut scene = Scene::azam_2019(CELLS);
    scene.form = Form::Sphere { radius: number(1)? };
    scene.grid = GridSpec::Cells { nx: CELLS, ny: CELLS, x: [-half, half], y: [-half, half] };
    scene.roughness = Default::default();
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    scene.motion.entrainment_speed = speed;
    scene.solver.film_cutoff = number(6)?;
    // A few asperities touch at the edge of some boxes.
    scene.solver.edge_contact = true;
    scene.solver.scheme = Some(Scheme::Limited);
    scene.solver.face_mobility = Some(FaceMobility::Inlet);
    scene.solver.cavitation = Some(match cavitation {
        "reynolds" => Cavitation::Reynolds,
        _ => Cavitation::MassConserving,
    });
    let mut limits = Limits::of(&scene)?;
    let quantities =
        [Quantity::AreaRatio, Quantity::LoadRatio, Quantity::MeanFilm, Quantity::Friction].into_iter();
    for (quantity, column) in quantities.zip((11..).step_by(2)) {
        limits = limits.with(quantity, number(column)?, number(column + 1)?);
    }
    let (rq, length) = ([number(3)?, number(4)?], number(5)?);
    let coarse = Grid::from_edges(SURFACE_CELLS, SURFACE_CELLS, [-half, half], [-half, half])?;
    let surfaces = [0, 1].map(|body| RoughnessSpec {
        autocorrelation: Autocorrelation::Gaussian,
        rq: rq[body],
        length_x: length,
        length_y: length,
        seed: 2 * seed - 1 + body as u64,
    });
    Ok(Case::new(format!("{name}: u {speed} m/s, {cavitation}, surface {seed}"), scene)
        .with_tags(["reference", "rough", name, cavitation])
        .with_reference(Some(limits))
        .with_heights(Some(HeightsOnGrid::by_fourier_series(coarse, surfaces))))
}
