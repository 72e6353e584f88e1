//! The contacts of a curve, one value after the other.

use std::error::Error;

use stribeck::Status;
use stribeck::sim::scene::{Scene, SolverModel};
use stribeck::sim::{
    Conditions, ContactSolution, FormulaFilm, MixedLubricationSim, SimBuilder, SimError, SingleContact,
};

use super::model::{Plan, resolved_values};
use super::row::{self, Row};
use super::{Curve, Point, surfaces};
use crate::interrupt;
use crate::output::{self, Held};

impl Curve<'_> {
    /// Solves one value after the other for all surfaces; whether all were solved and none interrupted.
    pub(super) fn solve(
        &mut self,
        scenes: &[Scene],
        (mut conditions, values): (Conditions, &[f64]),
        held: &Held,
    ) -> Result<bool, Box<dyn Error>> {
        self.bar.tick();
        let beside = resolved_values(self.options.resolve.unwrap_or(0), values.len());
        for (index, &value) in values.iter().enumerate() {
            let at = (&mut conditions, value);
            let Some(points) = self.points_at(scenes, at, held)? else { return Ok(false) };
            let is_model = points.first().is_some_and(|point| !is_resolved(point));
            self.take(value, points, false)?;
            if is_model && beside.contains(&index) {
                let (at, resolved) = ((&mut conditions, value), SolverModel::Resolved);
                let Some(points) = self.solve_surfaces(scenes, at, resolved, held)? else { return Ok(false) };
                self.take(value, points, true)?;
            }
        }
        Ok(true)
    }

    /// The contacts at one value by the model that holds there; `None` after an interruption.
    fn points_at(
        &mut self,
        scenes: &[Scene],
        (conditions, value): (&mut Conditions, f64),
        held: &Held,
    ) -> Result<Option<Vec<Point>>, Box<dyn Error>> {
        if self.plan == Plan::TryInlets {
            match self.solve_surfaces(scenes, (&mut *conditions, value), self.plan.model(), held) {
                Ok(None) => return Ok(None),
                Ok(Some(points)) => match points.iter().find(|point| !point.solution.is_within_model()) {
                    None if !points.is_empty() => return Ok(Some(points)),
                    outside => {
                        self.plan = outside.map_or(Plan::Resolved, |point| self.plan.after(&point.solution));
                    }
                },
                // Outside of the model, or an error that the resolved solve repeats.
                Err(_) => self.plan = Plan::Resolved,
            }
            self.bar.set_position(self.contacts.len() as u64);
            return self.solve_surfaces(scenes, (conditions, value), SolverModel::Resolved, held);
        }
        self.solve_surfaces(scenes, (conditions, value), self.plan.model(), held)
    }

    /// The contacts of all surfaces at one value by one model, as many at once as there are processors; `None` after an
    /// interruption.
    fn solve_surfaces(
        &mut self,
        scenes: &[Scene],
        (conditions, value): (&mut Conditions, f64),
        model: SolverModel,
        held: &Held,
    ) -> Result<Option<Vec<Point>>, Box<dyn Error>> {
        let mut points = Vec::with_capacity(scenes.len());
        self.by_inlets.resize_with(scenes.len(), || None);
        let mut by_inlets = std::mem::take(&mut self.by_inlets);
        let mut surfaces: Vec<_> = scenes.iter().zip(&mut by_inlets).enumerate().collect();
        for group in surfaces.chunks_mut(surfaces::at_once(scenes.len())) {
            let numbers: Vec<_> = group.iter().map(|(surface, _)| *surface).collect();
            let solves = group.iter_mut().map(|(_, (scene, contact))| {
                let mut scene = (*scene).clone();
                scene.solver.model = model;
                self.columns.over.set(&mut scene, conditions, value);
                let (held, bar, conditions) = (held.clone(), self.bar.clone(), *conditions);
                let builder = MixedLubricationSim::builder(scene).interrupt(move || {
                    held.print(&bar);
                    interrupt::is_requested()
                });
                move || solve((builder, model), contact, &conditions)
            });
            for (surface, solved) in numbers.into_iter().zip(surfaces::together(solves.collect())) {
                match solved {
                    Ok(solution) => points.push(Point { conditions: *conditions, surface, solution }),
                    Err(SimError::Interrupted) => return Ok(None),
                    Err(error @ SimError::BoxTooSmall(_)) => {
                        self.is_complete = false;
                        self.warn(format!("{} is left out of the curve: {error}", self.columns.words(value)));
                    }
                    Err(error) => return Err(output::in_scene(&self.options.scene, &error).into()),
                }
                self.bar.inc(1);
            }
        }
        self.by_inlets = by_inlets;
        Ok(Some(points))
    }

    /// Prints and writes the `points` of one value, those of the curve or resolved ones beside it.
    fn take(&mut self, value: f64, points: Vec<Point>, is_beside: bool) -> Result<(), Box<dyn Error>> {
        for (field, text) in warnings(&self.columns.words(value), &points, &self.said) {
            self.said.extend(field);
            self.warn(text);
        }
        let is_converged = |point: &&Point| point.solution.report.status == Status::Converged;
        let solutions: Vec<_> = points.iter().filter(is_converged).map(|point| &point.solution).collect();
        let warned = warned(&self.scene, &solutions);
        if let Some(mut row) = Row::of(value, &solutions, self.formula(&points, value)) {
            row.warned = warned;
            self.write_line(&row.csv(self.columns))?;
            if !self.options.output.json {
                let is_first = self.rows.is_empty() && self.resolved.is_empty();
                let header = is_first.then(|| row::table_header(self.columns));
                let lines = header.into_iter().chain([row.table_line(self.columns)]).collect::<Vec<_>>();
                self.bar.suspend(|| output::print(&lines.join("\n")))?;
            }
            if is_beside { &mut self.resolved } else { &mut self.rows }.push(row);
        }
        if self.remarks && points.iter().any(|point| surfaces::is_mixed(&point.solution)) {
            self.remarks = false;
            let text = format!(
                "at {} solids and fluid share the load: this is one random surface of many; \
                 --seeds 4 gives the mean of four and their standard deviation",
                self.columns.words(value)
            );
            self.warn(text);
        }
        for point in &points {
            self.contacts.push((point.solution.report.status, point.to_json(self.columns.spread)?));
        }
        Ok(())
    }

    /// Film by formula at `value`, under the conditions of the `points`.
    fn formula(&self, points: &[Point], value: f64) -> Option<FormulaFilm> {
        let (mut scene, mut conditions) = (self.scene.clone(), points.first()?.conditions);
        self.columns.over.set(&mut scene, &mut conditions, value);
        scene.formula_film().ok()?
    }
}

/// Solves the contact of `builder` by `model` under its `conditions`. By asperity inlets, `contact` is built once for all
/// conditions.
fn solve(
    (builder, model): (SimBuilder, SolverModel),
    contact: &mut Option<SingleContact>,
    conditions: &Conditions,
) -> Result<ContactSolution, SimError> {
    match contact {
        _ if model.is_resolved() => builder.solve(),
        Some(contact) => contact.solve_under(conditions),
        None => contact.insert(builder.single_contact()?).solve_under(conditions),
    }
}

/// Fields of the warnings of `solutions` beside those of the `scene`.
fn warned(scene: &Scene, solutions: &[&ContactSolution]) -> Vec<String> {
    let known = scene.warnings();
    let mut fields: Vec<String> = Vec::new();
    for warning in solutions.iter().flat_map(|solution| &solution.warnings) {
        let is_known = known.iter().any(|other| other.field == warning.field);
        if !is_known && !fields.contains(&warning.field) {
            fields.push(warning.field.clone());
        }
    }
    fields
}

/// Whether the contact was solved by the resolved model.
fn is_resolved(point: &Point) -> bool {
    point.solution.model != Some(SolverModel::AsperityInlets)
}

/// The warnings of the `points` of a value about fields that are not among the `said` ones, and about contacts that were
/// not solved, which have no field.
fn warnings(value: &str, points: &[Point], said: &[String]) -> Vec<(Option<String>, String)> {
    let mut new: Vec<(Option<String>, String)> = Vec::new();
    for point in points {
        let status = point.solution.report.status;
        if status != Status::Converged {
            let which =
                if points.len() > 1 { format!(", surface {},", point.surface) } else { String::new() };
            new.push((None, format!("{value}{which} is left out of the curve: {status}")));
        }
        for warning in &point.solution.warnings {
            let field = &warning.field;
            if !said.contains(field) && !new.iter().any(|(known, _)| known.as_ref() == Some(field)) {
                new.push((Some(field.clone()), format!("at {value}: {warning}")));
            }
        }
    }
    new
}
