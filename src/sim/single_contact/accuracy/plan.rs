//! Box and first mesh of a smooth contact for a target error, from the scale of its film.

use crate::error::InputError;
use crate::sim::contact::far_field::{Contact, InletScale};
use crate::sim::contact::formula::formula_film;
use crate::sim::contact::oil;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{GridSpec, InletSpec, Scene};

/// Cells on either side of the origin are a multiple of this, so that the origin is a face on every mesh.
const MULTIPLE: usize = 4;
/// Fraction of the target error aimed at by the first mesh.
const AIM: f64 = 0.3;
/// Fraction of the target error allowed to the box.
pub(super) const BOX_SHARE: f64 = 0.5;
/// Candidate upstream ends of the box, in half-widths.
const INLETS: [f64; 6] = [2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
/// Most nodes of the first finest mesh: the cells are those of the minimum film, and where they are many the estimate of the central film
/// tells whether it needs them.
const FIRST_NODES: f64 = (1 << 18) as f64;
/// Cells of the central film over those of the minimum film: its error is a sixth or less of the minimum film's between M = 20 and
/// M = 3000.
const CENTRAL_CELLS: f64 = 2.0;
/// Downstream end of the box, in half-widths.
const OUTLET: f64 = 1.5;
/// Largest number of nodes.
const MAX_NODES: usize = 1 << 22;

/// Box and cell size in Hertz units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    /// Upstream end of the box, in half-widths from the center.
    pub(super) inlet: f64,
    /// Downstream end of the box.
    pub(super) outlet: f64,
    /// Lateral end of the box.
    pub(super) side: f64,
    /// Cell size of the finest mesh, in half-widths.
    pub(super) cell: f64,
}

impl Plan {
    /// A box whose error is the fraction [`BOX_SHARE`] of the accuracy, and cells whose second-order error `C h^2`
    /// of the film `h R/a^2` is the fraction [`AIM`].
    pub(super) fn of(scene: &Scene, hertz: &HertzContact, accuracy: f64) -> Result<Self, InputError> {
        let conditions = scene.conditions(0.0)?;
        let viscosity = oil::viscosity(scene, conditions.bulk_temperature)?;
        let speed = conditions.motion.entrainment_speed;
        let formulas = formula_film(scene, hertz, speed, viscosity.as_deref(), None)?;
        let (Some(viscosity), Some(formulas)) = (viscosity.as_deref(), formulas) else {
            let (side, cell) = (1.5, 0.25 * accuracy.sqrt());
            return Ok(Self { inlet: side, outlet: side, side, cell });
        };
        if scene.lubricant.is_some_and(|oil| oil.inlet == InletSpec::BoxEdge) {
            return Err(box_edge());
        }
        let scale =
            InletScale::new(&Contact { scene, hertz, viscosity, entrainment_speed: speed, formulas })?;
        let film = scale.film() * scene.form.radii().0 / hertz.half_width_x.powi(2);
        let constant = 1.5 * (formulas.moes.m / 20.0).max(1.0).powf(0.2);
        let [half_x, half_y] = hertz.half_extents();
        let side = |inlet: f64| (inlet / 1.5).max(1.75);
        let error = |inlet: f64| scale.box_error(inlet * half_x, side(inlet) * half_y).of_solve();
        let fits = |inlet: &f64| error(*inlet) <= BOX_SHARE * accuracy;
        let inlet = INLETS.into_iter().find(fits).unwrap_or(INLETS[INLETS.len() - 1]);
        Ok(Self {
            inlet,
            outlet: OUTLET,
            side: side(inlet),
            cell: (AIM * accuracy * film / constant).sqrt().min(0.1),
        })
    }

    /// The plan of the first meshes of a smooth film.
    ///
    /// # Errors
    /// An accuracy out of reach.
    pub(super) fn first(self, scene: &Scene, hertz: &HertzContact) -> Result<Self, InputError> {
        if scene.form.is_line() || !scene.is_lubricated() {
            return Ok(self);
        }
        Self { cell: CENTRAL_CELLS * self.cell, ..self }.cells(hertz, 0, false)?;
        let least = ((self.inlet + self.outlet) * 2.0 * self.side / FIRST_NODES).sqrt();
        Ok(Self { cell: self.cell.max(least), ..self })
    }

    /// The plan for a layer on the disc. The half-width is between that of the substrate and that of the layer
    /// material: the box fits the wider contact, the cells the narrower one.
    pub(super) fn with_layer(self, scene: &Scene) -> Result<Self, InputError> {
        let Some(layer) = scene.layer()? else { return Ok(self) };
        let [own, substrate] = layer.compliances();
        let compliance = 1.0 + (own - substrate) * 0.5 * scene.equivalent_modulus()?;
        let width = if scene.form.is_line() { compliance.sqrt() } else { compliance.cbrt() };
        let (wide, narrow) = (width.max(1.0), width.min(1.0));
        let [inlet, outlet, side] = [self.inlet, self.outlet, self.side].map(|length| wide * length);
        Ok(Self { inlet, outlet, side, cell: narrow * self.cell })
    }

    /// The cells of the mesh `level` times coarser than the finest.
    pub(super) fn cells(
        &self,
        hertz: &HertzContact,
        level: u32,
        is_line: bool,
    ) -> Result<GridSpec, InputError> {
        let count =
            |length: f64| MULTIPLE * (length / (MULTIPLE as f64 * self.cell)).ceil().max(1.0) as usize;
        let coarser = |n: usize| n >> level;
        let edge = |cells: usize, axis: f64| cells as f64 * self.cell * axis;
        let [half_x, half_y] = hertz.half_extents();
        let [inlet, outlet, side] = [self.inlet, self.outlet, self.side].map(count);
        let x = [-edge(inlet, half_x), edge(outlet, half_x)];
        let y = edge(side, half_y);
        let rows = if is_line { 1 } else { 2 * side };
        let nodes = (inlet + outlet) as f64 * rows as f64;
        if nodes > MAX_NODES as f64 {
            return Err(InputError::Conflict {
                field: "grid.accuracy".to_owned(),
                reason: format!(
                    "the film needs {nodes:.2e} nodes for it, more than {MAX_NODES}: allow an error {} times as large, or give nx, ny, x and y",
                    // The error is of second order in the width of the cells.
                    (nodes / MAX_NODES as f64).powf(if is_line { 2.0 } else { 1.0 }).ceil()
                ),
            });
        }
        let nx = coarser(inlet + outlet);
        Ok(if is_line {
            GridSpec::Row { nx, x }
        } else {
            GridSpec::Cells { nx, ny: coarser(rows), x, y: [-y, y] }
        })
    }
}

/// The error for an oil supply at the edge of a box that is not given.
fn box_edge() -> InputError {
    InputError::Conflict {
        field: "lubricant.inlet = \"box_edge\"".to_owned(),
        reason: "grid.accuracy picks the box, at whose edge no oil can begin: give nx, ny, x and y, or leave the inlet \
                 flooded"
            .to_owned(),
    }
}
