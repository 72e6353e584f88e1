//! Benchmarks of solvers.

use std::path::PathBuf;

use pyo3::prelude::*;
use stribeck::benchmark::{self, Benchmark, Budget, Case, Cases, Contestant};

use crate::convert::list;
use crate::error::value;
use crate::interrupt::on_signal;
use crate::laws::{Failure, own_solver};
use crate::scene::Scene;

/// A solver by its text, or one in Python: its name, its identity and its function.
#[derive(FromPyObject)]
pub(crate) enum PySolver {
    Named(String),
    Own((String, String, Py<PyAny>)),
}

/// A list by its name or file, or scenes by name.
#[derive(FromPyObject)]
pub(crate) enum PyCases {
    List(String),
    Scenes(Vec<(String, Py<Scene>)>),
}

/// Numbers of a benchmark.
#[derive(FromPyObject)]
pub(crate) struct Plan {
    #[pyo3(item)]
    seed: u64,
    #[pyo3(item)]
    every: usize,
    #[pyo3(item)]
    tag: Option<String>,
    #[pyo3(item)]
    tolerances: Vec<f64>,
    #[pyo3(item)]
    meshes: Vec<usize>,
    #[pyo3(item)]
    seconds: f64,
    #[pyo3(item)]
    convolutions: f64,
    #[pyo3(item)]
    threads: Option<usize>,
    #[pyo3(item)]
    file: Option<PathBuf>,
}

/// The rows of a benchmark.
#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct BenchmarkRows(benchmark::Results);

#[pymethods]
impl BenchmarkRows {
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        list(py, &self.0)
    }

    fn to_csv(&self) -> String {
        self.0.to_csv()
    }

    fn summary(&self) -> String {
        self.0.summary()
    }

    fn stability_map(&self) -> String {
        self.0.stability_map()
    }

    fn work_precision(&self) -> String {
        self.0.work_precision()
    }

    fn performance_profile(&self) -> String {
        self.0.performance_profile()
    }
}

impl PySolver {
    fn contestant(self, py: Python<'_>) -> PyResult<Contestant> {
        match self {
            Self::Named(text) => value(py, Contestant::named(&text)),
            Self::Own((name, identity, call)) => Ok(Contestant::new(name, move |problem| {
                let call = Python::attach(|py| call.clone_ref(py));
                own_solver((identity.clone(), call), problem.grid())
            })),
        }
    }
}

impl PyCases {
    fn cases(self, py: Python<'_>, seed: u64) -> PyResult<Cases> {
        match self {
            Self::List(name) if name.ends_with(".toml") => value(py, Cases::load(name)),
            Self::List(name) => value(py, Cases::named(&name, seed)),
            Self::Scenes(scenes) => {
                let case = |(name, scene): (String, Py<Scene>)| Case::new(name, scene.get().0.clone());
                Ok(scenes.into_iter().map(case).collect::<Vec<_>>().into())
            }
        }
    }
}

/// Solves all cases by all solvers.
#[pyfunction]
pub(crate) fn run_benchmark(
    py: Python<'_>,
    cases: PyCases,
    solvers: Vec<PySolver>,
    plan: Plan,
) -> PyResult<BenchmarkRows> {
    let mut cases = cases.cases(py, plan.seed)?;
    if let Some(tag) = &plan.tag {
        cases = cases.tagged(tag);
    }
    let solvers = solvers.into_iter().map(|solver| solver.contestant(py)).collect::<PyResult<Vec<_>>>()?;
    let budget = Budget::default().with_seconds(plan.seconds).with_convolutions(plan.convolutions);
    let mut benchmark = Benchmark::new(cases.every(plan.every))
        .contestants(solvers)
        .tolerances(plan.tolerances)
        .meshes(plan.meshes)
        .budget(budget);
    if let Some(threads) = plan.threads {
        benchmark = benchmark.threads(threads);
    }
    if let Some(file) = plan.file {
        benchmark = benchmark.file(file);
    }
    // The benchmark stays on this thread, which is the one that sees signals.
    let solved = py.detach(|| benchmark.interrupt(on_signal()).run());
    if let Some(error) = Failure.take() {
        return Err(error);
    }
    value(py, solved).map(BenchmarkRows)
}
