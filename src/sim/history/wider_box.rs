//! Growing boxes: a step in which solids, wear or a tribofilm reach the edge is repeated in a box twice as wide, on
//! cells of the same size.
//!
//! The bodies are copied node by node. Along an axis on which the patch of a body is periodic in the history (x if
//! it moves, both if its positions are random) its fields repeat. Elsewhere new nodes are unworn, with heights from
//! the generator of the scene; a band blends them with the periodic continuation of the old heights.

use crate::error::InputError;
use crate::grid::Grid;
use crate::plastic::PlasticDepth;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::{BoxTooSmall, SimError};
use crate::sim::history::body::Body;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::exposure;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::step_control::StepControl;
use crate::sim::scene::{GridSpec, Roughness, Scene};
use crate::surface::PointRevisit;
use crate::tribochem::{FilmGrowthLaw, Tribofilm};
use crate::wear::WearDepth;

/// Most doublings of the box in one step.
const MOST_DOUBLINGS: usize = 4;
/// Width of the blending band, in units of the old width of the box.
const BAND: f64 = 0.125;

/// An axis of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Axis {
    X,
    Y,
}

/// The nodes of a box twice as wide along one axis.
struct Doubling {
    axis: Axis,
    /// The old grid.
    old: Grid,
    /// Old number of cells along the axis.
    count: usize,
    /// Number of new cells below the old ones.
    below: usize,
}

impl SimBuilder {
    /// Rejects components that are defined on one box only.
    pub(in crate::sim) fn require_growable(&self) -> Result<(), InputError> {
        if !self.scene.grid.grows() {
            return Ok(());
        }
        let refuse = |part: &str| {
            let reason = format!("{part} on the cells of one box, a box that grows needs others");
            Err(InputError::Conflict { field: "grid.grows".to_owned(), reason })
        };
        if let Some(part) = self.part_on_one_grid() {
            return refuse(&format!("{part} is known"));
        }
        let bodies = [&self.scene.roughness.ball, &self.scene.roughness.disc];
        if bodies.iter().any(|roughness| matches!(roughness, Roughness::File(_))) {
            return refuse("a measured surface is known");
        }
        if bodies
            .iter()
            .any(|roughness| matches!(roughness, Roughness::Random(surface) if surface.cells.is_some()))
        {
            return refuse("a surface with given cells is drawn");
        }
        Ok(())
    }
}

impl MixedLubricationSim {
    /// Repeats the step that ended with `edge` in a wider box. An error restores the old box.
    pub(in crate::sim) fn step_in_wider_box(
        &mut self,
        control: &StepControl,
        mut edge: BoxTooSmall,
    ) -> Result<StepRecord, SimError> {
        let mut wide = self.widened(&edge)?;
        for _ in 1..MOST_DOUBLINGS {
            match wide.step_in_box(control) {
                Err(SimError::BoxTooSmall(next)) => edge = next,
                Err(error) => return Err(error),
                Ok(record) => {
                    *self = wide;
                    return Ok(record);
                }
            }
            wide = wide.widened(&edge)?;
        }
        Err(edge.into())
    }

    /// The simulation in a box twice as wide along the axis of `edge`.
    fn widened(&self, edge: &BoxTooSmall) -> Result<Self, SimError> {
        let old = self.contact.grid;
        let axis = if edge.field == "grid.x" { Axis::X } else { Axis::Y };
        let count = if axis == Axis::X { old.nx() } else { old.ny() };
        let doubling = Doubling { axis, old, count, below: count / 2 };
        let mut wide = self.rebuilt(doubling.spec(self.scene.grid))?;
        let speeds = self.conditions().motion.surface_speeds();
        let roughness = [&self.scene.roughness.ball, &self.scene.roughness.disc];
        for (index, body) in self.bodies.iter().enumerate() {
            let visits = exposure::visits(self.surface_motion.motion.as_ref(), speeds[index]);
            let repeats = match axis {
                Axis::X => visits != PointRevisit::Permanent,
                Axis::Y => visits == PointRevisit::Patch,
            };
            let fresh = std::mem::take(&mut wide.bodies[index].surface);
            let blends = matches!(roughness[index], Roughness::Random(_));
            let initial = doubling.heights(body.initial(), &fresh, repeats, blends);
            wide.bodies[index] = doubling.body(body, initial, repeats, self.laws.growth.as_deref())?;
        }
        wide.backup.clone_from(&wide.bodies);
        (wide.time, wide.step, wide.draws) = (self.time, self.step, self.draws);
        wide.warnings.clone_from(&self.warnings);
        wide.warnings.push(Warning::new(
            edge.field,
            edge.value,
            format!(
                "{} reached the edge of the box after {} s, which is twice as wide from then on",
                edge.quantity, self.time
            ),
            "means over the patch (wear.ball_mean) are those of the wider box".to_owned(),
        ));
        Ok(wide)
    }

    /// A simulation of the same scene in the box `grid`, at its start.
    pub(in crate::sim) fn rebuilt(&self, grid: GridSpec) -> Result<Self, SimError> {
        let mut builder = SimBuilder::new(Scene { grid, ..self.scene.clone() });
        builder.custom.interrupt.clone_from(&self.interrupt);
        builder.build()
    }
}

impl Doubling {
    /// The wider box, on cells of the same size.
    fn spec(&self, grid: GridSpec) -> GridSpec {
        let GridSpec::Growing { nx, ny, x, y } = grid else { return grid };
        let (below, above) = (self.below as f64, (self.count - self.below) as f64);
        let wider = |[low, high]: [f64; 2], step: f64| [low - below * step, high + above * step];
        match self.axis {
            Axis::X => GridSpec::Growing { nx: 2 * nx, ny, x: wider(x, self.old.dx()), y },
            Axis::Y => GridSpec::Growing { nx, ny: 2 * ny, x, y: wider(y, self.old.dy()) },
        }
    }

    /// Nodes of the wider grid.
    fn nodes(&self) -> usize {
        2 * self.old.len()
    }

    /// The old node for node `k` of the wider grid by periodic continuation, and its distance from the old box in cells
    /// (0 inside).
    fn origin(&self, k: usize) -> (usize, usize) {
        let nx = if self.axis == Axis::X { 2 * self.old.nx() } else { self.old.nx() };
        let (i, j) = (k % nx, k / nx);
        let place = if self.axis == Axis::X { i } else { j };
        let (first, last) = (self.below, self.below + self.count - 1);
        let distance = first.saturating_sub(place).max(place.saturating_sub(last));
        let within = (place + self.count - self.below) % self.count;
        let node = if self.axis == Axis::X { j * self.old.nx() + within } else { within * self.old.nx() + i };
        (node, distance)
    }

    /// Heights of the new body: the `old` ones repeated, or `old` inside the old box and `fresh` outside.
    fn heights(&self, old: &[f64], fresh: &[f64], repeats: bool, blends: bool) -> Vec<f64> {
        let band = if blends { (BAND * self.count as f64).ceil() } else { 0.0 };
        let height = |k: usize| {
            let (node, distance) = self.origin(k);
            let share = distance as f64 / (band + 1.0);
            if repeats || distance == 0 {
                old[node]
            } else if share < 1.0 {
                // the blend of independent heights keeps the mean square
                let angle = std::f64::consts::FRAC_PI_2 * share;
                old[node] * angle.cos() + fresh[k] * angle.sin()
            } else {
                fresh[k]
            }
        };
        (0..self.nodes()).map(height).collect()
    }

    /// The `body` on the wider grid with new heights.
    fn body(
        &self,
        body: &Body,
        initial: Vec<f64>,
        repeats: bool,
        law: Option<&dyn FilmGrowthLaw>,
    ) -> Result<Body, SimError> {
        let carried = |field: &[f64]| -> Vec<f64> {
            let value = |k: usize| match self.origin(k) {
                (_, 1..) if !repeats => 0.0,
                (node, _) => field[node],
            };
            (0..self.nodes()).map(value).collect()
        };
        let mut wide = Body::new(initial, None);
        wide.wear = WearDepth::from_values(carried(body.wear()))?;
        wide.plastic = PlasticDepth::from_values(carried(body.plastic_depth()))?;
        wide.worn_volume = body.worn_volume;
        if let (Some(law), Some(film)) = (law, &body.film) {
            let each = law.n_states().max(1);
            let mut bare = vec![0.0; each];
            law.start(0.0, &mut bare);
            let states = (0..self.nodes()).flat_map(|k| match self.origin(k) {
                (_, 1..) if !repeats => bare.clone(),
                (node, _) => film.states()[node * each..(node + 1) * each].to_vec(),
            });
            let copies = if repeats { 2.0 } else { 1.0 };
            let changes = film.changes().map(|change| copies * change);
            wide.film = Some(Tribofilm::from_states(law, states.collect(), changes)?);
        }
        wide.rebuild()?;
        Ok(wide)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubled_axis_centers_the_old_nodes() -> Result<(), InputError> {
        let old = Grid::from_edges(4, 3, [-2.0, 2.0], [-1.5, 1.5])?;
        let field: Vec<f64> = (0..12_u32).map(f64::from).collect();
        let fresh = vec![-1.0; 24];
        for (axis, count) in [(Axis::X, 4), (Axis::Y, 3)] {
            let doubling = Doubling { axis, old, count, below: count / 2 };
            let spec = GridSpec::Growing { nx: 4, ny: 3, x: [-2.0, 2.0], y: [-1.5, 1.5] };
            let GridSpec::Growing { nx, ny, x, y } = doubling.spec(spec) else { panic!("a box that grows") };
            let wide = Grid::from_edges(nx, ny, x, y)?;
            assert_eq!(wide.len(), 24);
            let repeated = doubling.heights(&field, &fresh, true, false);
            let extended = doubling.heights(&field, &fresh, false, false);
            for (k, (px, py)) in wide.nodes().enumerate() {
                let old_node = old.nodes().position(|(x, y)| (x - px).abs() + (y - py).abs() < 1e-12);
                let expected = old_node.map_or(-1.0, |node| field[node]);
                assert!((extended[k] - expected).abs() < 1e-15, "{axis:?} {k}");
                if let Some(node) = old_node {
                    assert!((repeated[k] - field[node]).abs() < 1e-15, "{axis:?} {k}");
                }
            }
            // Every old node appears twice.
            assert!((repeated.iter().sum::<f64>() - 2.0 * field.iter().sum::<f64>()).abs() < 1e-12);
        }
        Ok(())
    }
}
