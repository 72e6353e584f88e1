//! Errors of the crate as exceptions of `stribeck.errors`, with field and value.

use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::reynolds::ReynoldsError;
use stribeck::sim::{CheckpointError, SimError};
use stribeck::surface::{FileError, SurfaceError};
use stribeck::{InputError, NotConverged};

use crate::convert::named;

/// An exception of the class `kind` of `stribeck.errors`.
pub(crate) fn raise(
    py: Python<'_>,
    kind: &str,
    message: &str,
    field: Option<&str>,
    value: Option<Bound<'_, PyAny>>,
) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("stribeck.errors")?.getattr(kind)?;
        let named = PyDict::new(py);
        named.set_item("field", field)?;
        named.set_item("value", value)?;
        Ok(PyErr::from_value(class.call((message,), Some(&named))?))
    };
    made().unwrap_or_else(|error| error)
}

/// The result of a fallible function of the crate, for Python.
pub(crate) trait ForPython {
    fn for_python(self, py: Python<'_>) -> PyErr;
}

impl ForPython for InputError {
    fn for_python(self, py: Python<'_>) -> PyErr {
        input(py, "InputError", &self)
    }
}

fn input(py: Python<'_>, kind: &str, error: &InputError) -> PyErr {
    let message = error.to_string();
    let number = |value: f64| value.into_bound_py_any(py).ok();
    match error {
        InputError::Value { field, value, .. } => raise(py, kind, &message, Some(field), number(*value)),
        InputError::Shape { field, found, .. } => {
            let found = found.into_bound_py_any(py).ok();
            raise(py, kind, &message, Some(field), found)
        }
        InputError::NotFinite { field, index, value } => {
            raise(py, kind, &message, Some(&format!("{field}[{index}]")), number(*value))
        }
        // Some fields bring their value along, `load.force = 5`, and some reasons begin with it: `load: 5 N is
        // more than`.
        InputError::Conflict { field, reason } => match field.split_once(" = ") {
            Some((field, value)) => {
                let value = value.trim_matches('"');
                let number = value.parse().ok().and_then(number);
                let text = || value.into_bound_py_any(py).ok();
                raise(py, kind, &message, Some(field), number.or_else(text))
            }
            None => {
                let first = reason.split(' ').next().and_then(|word| word.parse().ok());
                raise(py, kind, &message, Some(field), first.and_then(number))
            }
        },
        _ => raise(py, kind, &message, None, None),
    }
}

impl ForPython for SurfaceError {
    fn for_python(self, py: Python<'_>) -> PyErr {
        let message = self.to_string();
        match &self {
            Self::Input(error) => input(py, "InputError", error),
            Self::File { error } => file(py, error, &message),
            // the missing property of the surface has that name
            Self::NoSpacing => raise(py, "SurfaceError", &message, Some("dx"), None),
            Self::AllUndefined { points } | Self::Undefined { points } => {
                let points = points.into_bound_py_any(py).ok();
                raise(py, "SurfaceError", &message, Some("undefined"), points)
            }
            _ => raise(py, "SurfaceError", &message, Some("heights"), None),
        }
    }
}

/// The exception of a surface file; of one whose format has no reader the field is `format`.
fn file(py: Python<'_>, error: &FileError, message: &str) -> PyErr {
    let (field, path) = match error {
        FileError::Io { path, source } => return io(py, &path.display().to_string(), message, source),
        FileError::UnknownFormat { path } | FileError::Foreign { path, .. } => ("format", path),
        FileError::Several { path, .. } => ("channel", path),
        FileError::Corrupt { path, .. } | FileError::Unsupported { path, .. } => ("path", path),
        _ => return raise(py, "SurfaceError", message, Some("dx"), None),
    };
    let path = path.display().to_string().into_bound_py_any(py).ok();
    raise(py, "SurfaceError", message, Some(field), path)
}

fn io(py: Python<'_>, path: &str, message: &str, source: &std::io::Error) -> PyErr {
    let error = raise(py, "FileError", message, Some("path"), path.into_bound_py_any(py).ok());
    if let Some(number) = source.raw_os_error() {
        let _ = error.value(py).setattr("errno", number);
    }
    error
}

impl ForPython for CheckpointError {
    fn for_python(self, py: Python<'_>) -> PyErr {
        let message = self.to_string();
        let (field, path) = match &self {
            Self::Io { path, source } => return io(py, &path.display().to_string(), &message, source),
            Self::Other { path, part, .. } => (part.as_str(), path),
            Self::Foreign { path } | Self::Newer { path, .. } | Self::Damaged { path, .. } => ("path", path),
            _ => return raise(py, "CheckpointError", &message, Some("path"), None),
        };
        let value = path.display().to_string().into_bound_py_any(py).ok();
        raise(py, "CheckpointError", &message, Some(field), value)
    }
}

impl ForPython for NotConverged {
    fn for_python(self, py: Python<'_>) -> PyErr {
        not_converged(py, &self.to_string(), &self)
    }
}

fn not_converged(py: Python<'_>, message: &str, source: &NotConverged) -> PyErr {
    let status = source.report.status.to_string();
    let error = raise(py, "NotConvergedError", message, Some("status"), status.into_bound_py_any(py).ok());
    if let Ok(report) = named(py, &source.report) {
        let _ = error.value(py).setattr("report", report);
    }
    error
}

impl ForPython for SimError {
    fn for_python(self, py: Python<'_>) -> PyErr {
        let message = self.to_string();
        match self {
            Self::Input(error) => error.for_python(py),
            Self::Surface(error) => error.for_python(py),
            Self::Checkpoint(error) => error.for_python(py),
            Self::NotConverged { source, .. } => not_converged(py, &message, &source),
            Self::Reynolds(ReynoldsError::Input(error)) => error.for_python(py),
            Self::Reynolds(error) => {
                let (field, value) = match &error {
                    ReynoldsError::WrongSolver { solver, .. } => {
                        (Some("solver.kind"), solver.to_string().into_bound_py_any(py).ok())
                    }
                    ReynoldsError::EdgeContact { x, y } => {
                        (Some("grid"), (*x, *y).into_bound_py_any(py).ok())
                    }
                    _ => (Some("grid"), None),
                };
                raise(py, "SolverError", &message, field, value)
            }
            Self::BoxTooSmall(edge) => {
                let value = edge.value.into_bound_py_any(py).ok();
                raise(py, "SolverError", &message, Some(edge.field), value)
            }
            Self::Scene { reason } => scene(py, &reason),
            Self::Io { path, source } => io(py, &path.display().to_string(), &message, &source),
            Self::Interrupted => raise(py, "InterruptedSolve", &message, None, None),
            _ => raise(py, "StribeckError", &message, None, None),
        }
    }
}

/// The error of a scene that does not fit: the parser names the table or the key last, after `in`, and a key
/// that is missing or stray first.
fn scene(py: Python<'_>, reason: &str) -> PyErr {
    let escape = |words: &str| words.split('`').nth(1).map(str::to_owned);
    let place = reason.rsplit_once(" in `").and_then(|(_, end)| end.strip_suffix('`'));
    let key = ["unknown key ", "missing key ", "missing keys: "]
        .iter()
        .find_map(|words| reason.split_once(words))
        .and_then(|(_, rest)| escape(&format!(" {rest}")));
    let field = match (place, key) {
        (Some(table), Some(key)) => Some(format!("{table}.{key}")),
        (place, key) => key.or(place.map(str::to_owned)),
    };
    raise(py, "SceneError", reason, field.as_deref(), None)
}

/// The value, or the error as an exception.
pub(crate) fn value<T, E: ForPython>(py: Python<'_>, result: Result<T, E>) -> PyResult<T> {
    result.map_err(|error| error.for_python(py))
}
