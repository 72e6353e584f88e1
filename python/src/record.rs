//! Records and reports as dictionaries.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::SolveReport;
use stribeck::sim::{FilmHeatRecord, HertzContact, StepRecord};

use crate::convert::dictionary;

pub(crate) fn residual_dict<'py>(py: Python<'py>, report: &SolveReport) -> PyResult<Bound<'py, PyDict>> {
    Ok(dictionary!(py, {
        "mass": report.residuals.mass,
        "load": report.residuals.load,
        "complementarity": report.residuals.complementarity,
    }))
}

pub(crate) fn work_dict<'py>(py: Python<'py>, report: &SolveReport) -> PyResult<Bound<'py, PyDict>> {
    Ok(dictionary!(py, {
        "convolutions": report.work.convolutions,
        "iterations": report.work.iterations,
        "inner_iterations": report.work.inner_iterations,
    }))
}

pub(crate) fn report_dict<'py>(py: Python<'py>, report: &SolveReport) -> PyResult<Bound<'py, PyDict>> {
    Ok(dictionary!(py, {
        "status": report.status.to_string(),
        "solver": report.solver.to_string(),
        "residual": residual_dict(py, report)?,
        "energy_error": report.energy_error,
        "work": work_dict(py, report)?,
    }))
}

pub(crate) fn hertz_dict<'py>(py: Python<'py>, hertz: &HertzContact) -> PyResult<Bound<'py, PyDict>> {
    Ok(dictionary!(py, {
        "radius": hertz.radius,
        "half_width_x": hertz.a_x,
        "half_width_y": hertz.a_y,
        "pressure": hertz.p_max,
        "force": hertz.load,
    }))
}

/// One row of a history: names of [`StepRecord`], those of pairs with `_ball` and `_disc`.
pub(crate) fn record_dict<'py>(py: Python<'py>, record: &StepRecord) -> PyResult<Bound<'py, PyDict>> {
    let report = &record.report;
    let heat = |number: fn(&FilmHeatRecord) -> f64| record.film_heat.as_ref().map_or(f64::NAN, number);
    Ok(dictionary!(py, {
        "step": record.step,
        "time": record.time,
        "time_step": record.time_step,
        "rq_ball": record.rq[0],
        "rq_disc": record.rq[1],
        "composite_rq": record.composite_rq,
        "average_film": record.average_film,
        "lambda": record.lambda,
        "formula_lambda": record.formula_lambda,
        "area_ratio": record.area_ratio,
        "load_ratio": record.load_ratio,
        "max_pressure": record.max_pressure,
        "mean_pressure": record.mean_pressure,
        "mean_wear_ball": record.mean_wear[0],
        "mean_wear_disc": record.mean_wear[1],
        "max_wear_ball": record.max_wear[0],
        "max_wear_disc": record.max_wear[1],
        "mean_film_ball": record.mean_film[0],
        "mean_film_disc": record.mean_film[1],
        "track_wear_ball": record.track_wear[0],
        "track_wear_disc": record.track_wear[1],
        "track_film_ball": record.track_film[0],
        "track_film_disc": record.track_film[1],
        "plastic_volume": record.plastic_volume,
        "flash_rise": record.flash_rise.unwrap_or(f64::NAN),
        "friction_coefficient": record.friction_coefficient,
        "friction_boundary": record.friction_boundary,
        "friction_fluid": record.friction_fluid,
        "load": record.load,
        "entrainment_speed": record.motion.entrainment_speed,
        "slide_roll_ratio": record.motion.slide_roll_ratio,
        "bulk_temperature": record.bulk_temperature,
        "film_temperature_max": heat(|heat| heat.film_temperature_max),
        "film_temperature_mean_central": heat(|heat| heat.film_temperature_mean_central),
        "surface_rise_ball": heat(|heat| heat.surface_rises[0]),
        "surface_rise_disc": heat(|heat| heat.surface_rises[1]),
        "film_heat": heat(|heat| heat.heat),
        "film_heat_imbalance": heat(|heat| heat.imbalance),
        "film_heat_solves": heat(|heat| heat.solves as f64),
        "film_heat_change": heat(|heat| heat.change),
        "minimum_gap": record.minimum_gap,
        "inflow": record.flow.map_or(f64::NAN, |flow| flow.inflow),
        "outflow": record.flow.map_or(f64::NAN, |flow| flow.outflow),
        "flow_imbalance": record.flow.map_or(f64::NAN, |flow| flow.imbalance),
        "attempts": record.attempts,
        "solver": report.solver.to_string(),
        "status": report.status.to_string(),
        "mass_residual": report.residuals.mass,
        "load_residual": report.residuals.load,
        "complementarity_residual": report.residuals.complementarity,
        "energy_error": report.energy_error.unwrap_or(f64::NAN),
        "convolutions": report.work.convolutions,
        "iterations": report.work.iterations,
        "inner_iterations": report.work.inner_iterations,
    }))
}
