//! Numbers, dictionaries and arrays between both languages.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString};
use serde::Serialize;
use stribeck::Grid;
use stribeck::units::Dimension;
use toml::{Table, Value};

use crate::error::{raise, value};

/// A field as an array of shape `(ny, nx)`.
pub(crate) fn field<'py, T: numpy::Element + Copy>(
    py: Python<'py>,
    grid: &Grid,
    values: &[T],
) -> PyResult<Bound<'py, PyArray2<T>>> {
    PyArray1::from_slice(py, values).reshape([grid.ny(), grid.nx()])
}

/// The values of an array that must have the shape `(ny, nx)` of `grid`, where they lie.
pub(crate) fn on_grid<'a, T: numpy::Element>(
    py: Python<'_>,
    name: &str,
    array: &'a PyReadonlyArray2<'_, T>,
    grid: &Grid,
) -> PyResult<&'a [T]> {
    let shape = array.shape();
    let expected = [grid.ny(), grid.nx()];
    if shape != expected {
        let found = (shape[0], shape[1]).into_pyobject(py)?.into_any();
        let message = format!("{name} has the shape {found}, expected ({}, {})", expected[0], expected[1]);
        return Err(raise(py, "ShapeError", &message, Some(name), Some(found)));
    }
    contiguous(py, name, array)
}

/// The values of an array, rows one after the other.
pub(crate) fn contiguous<'a, T: numpy::Element>(
    py: Python<'_>,
    name: &str,
    array: &'a PyReadonlyArray2<'_, T>,
) -> PyResult<&'a [T]> {
    array.as_slice().map_err(|_| {
        raise(py, "InputError", &format!("{name}: it must be contiguous in C order"), Some(name), None)
    })
}

/// Dictionaries and lists within each other that a scene never needs: the bound ends recursive ones.
const MAX_PATH: usize = 16;

/// A dictionary of strings, numbers, truth values, lists and dictionaries as a table; keys whose value is
/// None are left out.
pub(crate) fn table(dict: &Bound<'_, PyDict>, inside: &str) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, entry) in dict {
        let name = key.extract::<String>().map_err(|_| {
            let table = if inside.is_empty() { "scene" } else { inside };
            let message = format!("{table}: the key {} is no text", shown(&key));
            raise(key.py(), "SceneError", &message, Some(table), Some(key.clone()))
        })?;
        let path = if inside.is_empty() { name.clone() } else { format!("{inside}.{name}") };
        if !entry.is_none() {
            table.insert(name, toml_value(&entry, &path)?);
        }
    }
    Ok(table)
}

fn toml_value(entry: &Bound<'_, PyAny>, path: &str) -> PyResult<Value> {
    let py = entry.py();
    if path.matches(['.', '[']).count() > MAX_PATH {
        let (field, _) = path.split_once(['.', '[']).unwrap_or((path, ""));
        let message = format!("{field}: a dictionary or list contains itself");
        return Err(raise(py, "SceneError", &message, Some(field), None));
    }
    if let Ok(dict) = entry.cast::<PyDict>() {
        return Ok(Value::Table(table(dict, path)?));
    }
    if let Ok(text) = entry.cast::<PyString>() {
        return text.extract().map(Value::String).map_err(|_| {
            let message = format!("{path} = {}: the text has lone surrogates", shown(entry));
            raise(py, "SceneError", &message, Some(path), Some(entry.clone()))
        });
    }
    if entry.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(entry.extract()?));
    }
    // Arrays and numbers of NumPy, too.
    if let Ok(list) = entry.call_method0("tolist")
        && !list.get_type().is(entry.get_type())
    {
        return toml_value(&list, path);
    }
    if let Ok(whole) = entry.extract::<u64>() {
        // Integers out of the range of the format are read as text.
        return Ok(i64::try_from(whole).map_or_else(|_| Value::String(whole.to_string()), Value::Integer));
    }
    if let Ok(whole) = entry.extract::<i64>() {
        return Ok(Value::Integer(whole));
    }
    if let Ok(number) = entry.extract::<f64>() {
        return Ok(Value::Float(number));
    }
    if let Ok(text) = entry.call_method0("__fspath__") {
        return Ok(Value::String(text.extract()?));
    }
    if let Ok(items) = entry.try_iter() {
        let items: PyResult<Vec<Value>> =
            items.enumerate().map(|(k, item)| toml_value(&item?, &format!("{path}[{k}]"))).collect();
        return Ok(Value::Array(items?));
    }
    let message = format!("{path}: a value of the type {} has no place in a scene", entry.get_type().name()?);
    Err(raise(py, "SceneError", &message, Some(path), Some(entry.clone())))
}

/// Characters of a value that messages show.
const MOST_SHOWN: usize = 100;

/// A value as Python shows it; its type if that is long.
pub(crate) fn shown(value: &Bound<'_, PyAny>) -> String {
    let shown = value.repr().map_or_else(|_| String::new(), |text| text.to_string_lossy().into_owned());
    let kind = || value.get_type().name().map_or_else(|_| String::new(), |name| name.to_string());
    if shown.chars().count() > MOST_SHOWN { format!("a value of the type {}", kind()) } else { shown }
}

/// The dimensions of the quantities that functions take.
const DIMENSIONS: [Dimension; 9] = [
    Dimension::Length,
    Dimension::Pressure,
    Dimension::InversePressure,
    Dimension::Force,
    Dimension::ForcePerLength,
    Dimension::Speed,
    Dimension::Viscosity,
    Dimension::Time,
    Dimension::Temperature,
];

/// The number that `text` is, with a unit of the dimension whose SI unit is `unit`.
#[pyfunction]
pub(crate) fn quantity(py: Python<'_>, field: &str, text: &str, unit: &str) -> PyResult<f64> {
    let dimension = DIMENSIONS.into_iter().find(|known| known.unit_names().next() == Some(unit));
    let dimension = dimension.ok_or_else(|| PyValueError::new_err(format!("no unit: {unit}")))?;
    value(py, dimension.parse(field, text))
}

/// A table as a dictionary.
pub(crate) fn dict<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (key, value) in table {
        dict.set_item(key, object(py, value)?)?;
    }
    Ok(dict)
}

fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Integer(whole) => whole.into_pyobject(py)?.into_any(),
        Value::Float(number) => number.into_pyobject(py)?.into_any(),
        Value::Boolean(truth) => PyBool::new(py, *truth).to_owned().into_any(),
        Value::Datetime(time) => time.to_string().into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let items: PyResult<Vec<_>> = items.iter().map(|item| object(py, item)).collect();
            PyList::new(py, items?)?.into_any()
        }
        Value::Table(table) => dict(py, table)?.into_any(),
    })
}

/// `numbers` serialized as a dictionary.
pub(crate) fn named<'py>(py: Python<'py>, numbers: &impl Serialize) -> PyResult<Bound<'py, PyDict>> {
    let tree = serde_json::to_value(numbers).map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(json(py, &tree)?.cast_into::<PyDict>()?)
}

/// `items` serialized as a list.
pub(crate) fn list<'py>(py: Python<'py>, items: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    json(py, &serde_json::to_value(items).map_err(|error| PyValueError::new_err(error.to_string()))?)
}

fn json<'py>(py: Python<'py>, tree: &serde_json::Value) -> PyResult<Bound<'py, PyAny>> {
    use serde_json::Value;
    Ok(match tree {
        Value::Null => py.None().into_bound(py),
        Value::Bool(truth) => PyBool::new(py, *truth).to_owned().into_any(),
        Value::Number(number) => match (number.as_u64(), number.as_f64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (None, Some(number)) => number.into_pyobject(py)?.into_any(),
            (None, None) => py.None().into_bound(py),
        },
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let items: PyResult<Vec<_>> = items.iter().map(|item| json(py, item)).collect();
            PyList::new(py, items?)?.into_any()
        }
        Value::Object(parts) => {
            let dict = PyDict::new(py);
            for (key, part) in parts {
                dict.set_item(key, json(py, part)?)?;
            }
            dict.into_any()
        }
    })
}

/// A dictionary of the named values.
macro_rules! dictionary {
    ($py:expr, { $($key:literal : $value:expr),* $(,)? }) => {{
        let dict = pyo3::types::PyDict::new($py);
        $(dict.set_item($key, $value)?;)*
        dict
    }};
}
pub(crate) use dictionary;
