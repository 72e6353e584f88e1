//! The compiled part of the Python package `stribeck`: scenes, solves, histories, surfaces and formulas as
//! plain functions of numbers, dictionaries and arrays. Classes for people are written in Python around it
//! (`python/stribeck`).

mod analytic;
mod benchmark;
mod convert;
mod cycle;
mod elastic;
mod error;
mod flat_contact;
mod given_film;
mod interrupt;
mod laws;
mod metrics;
mod record;
mod run;
mod scene;
mod simulation;
mod solution;
mod start;
mod surface;

use pyo3::prelude::*;

/// Sets the number of threads of later work; 0 for the default.
#[pyfunction]
fn set_num_threads(threads: usize) {
    stribeck::set_num_threads(threads);
}

/// Runs the command with `arguments` behind its name; its exit status.
#[pyfunction]
fn run_command(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
    py.detach(|| stribeck_cli::run(std::iter::once("stribeck".into()).chain(arguments)))
}

#[pymodule]
fn _stribeck(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scene::Cells>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<elastic::HalfSpace>()?;
    module.add_class::<laws::Problem>()?;
    module.add_class::<simulation::Simulation>()?;
    module.add_class::<benchmark::BenchmarkRows>()?;
    module.add_class::<start::BodyStart>()?;
    module.add_class::<surface::Surface>()?;
    module.add_class::<given_film::SolvedFilm>()?;
    module.add_function(wrap_pyfunction!(run_command, module)?)?;
    module.add_function(wrap_pyfunction!(set_num_threads, module)?)?;
    module.add_function(wrap_pyfunction!(convert::quantity, module)?)?;
    module.add_function(wrap_pyfunction!(record::columns, module)?)?;
    module.add_function(wrap_pyfunction!(solution::solve, module)?)?;
    module.add_function(wrap_pyfunction!(benchmark::run_benchmark, module)?)?;
    module.add_function(wrap_pyfunction!(given_film::solve_film, module)?)?;
    module.add_function(wrap_pyfunction!(cycle::solve_cycle, module)?)?;
    module.add_function(wrap_pyfunction!(flat_contact::solve_flat, module)?)?;
    module.add_function(wrap_pyfunction!(given_film::solve_bearing, module)?)?;
    module.add_function(wrap_pyfunction!(laws::check_visits, module)?)?;
    module.add_function(wrap_pyfunction!(surface::generate, module)?)?;
    analytic::register(module)?;
    metrics::register(module)
}
