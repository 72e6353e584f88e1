//! Closed-form solutions.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::InputError;
use stribeck::analytic::{self, FilmConditions, HertzLine, HertzPoint, LineFilmConditions, Westergaard};

use crate::convert::{dictionary, named};
use crate::error::{ForPython, value};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(equivalent_modulus, module)?)?;
    module.add_function(wrap_pyfunction!(hertz_point, module)?)?;
    module.add_function(wrap_pyfunction!(hertz_line, module)?)?;
    module.add_function(wrap_pyfunction!(point_films, module)?)?;
    module.add_function(wrap_pyfunction!(line_films, module)?)?;
    module.add_function(wrap_pyfunction!(westergaard, module)?)
}

#[pyfunction]
fn equivalent_modulus(py: Python<'_>, first: [f64; 2], second: [f64; 2]) -> PyResult<f64> {
    value(py, analytic::equivalent_modulus(first, second))
}

/// The contact by its load or its maximum pressure, of which one must be given.
fn by<T>(
    py: Python<'_>,
    load: Option<f64>,
    max_pressure: Option<f64>,
    by_load: impl FnOnce(f64) -> Result<T, InputError>,
    by_pressure: impl FnOnce(f64) -> Result<T, InputError>,
) -> PyResult<T> {
    match (load, max_pressure) {
        (Some(load), None) => value(py, by_load(load)),
        (None, Some(pressure)) => value(py, by_pressure(pressure)),
        _ => Err(InputError::Conflict {
            field: "load".to_owned(),
            reason: "give load or max_pressure, one of them".to_owned(),
        }
        .for_python(py)),
    }
}

#[pyfunction]
#[pyo3(signature = (radius_x, radius_y, equivalent_modulus, load=None, max_pressure=None))]
fn hertz_point<'py>(
    py: Python<'py>,
    radius_x: f64,
    radius_y: f64,
    equivalent_modulus: f64,
    load: Option<f64>,
    max_pressure: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let contact = by(
        py,
        load,
        max_pressure,
        |load| HertzPoint::from_load(radius_x, radius_y, equivalent_modulus, load),
        |pressure| HertzPoint::from_max_pressure(radius_x, radius_y, equivalent_modulus, pressure),
    )?;
    Ok(dictionary!(py, {
        "half_width_x": contact.half_width_x,
        "half_width_y": contact.half_width_y,
        "pressure": contact.pressure,
        "mean_pressure": contact.mean_pressure(),
        "force": contact.force,
        "area": contact.area(),
        "approach": contact.approach,
    }))
}

#[pyfunction]
#[pyo3(signature = (radius, equivalent_modulus, load=None, max_pressure=None))]
fn hertz_line<'py>(
    py: Python<'py>,
    radius: f64,
    equivalent_modulus: f64,
    load: Option<f64>,
    max_pressure: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let contact = by(
        py,
        load,
        max_pressure,
        |load| HertzLine::from_load(radius, equivalent_modulus, load),
        |pressure| HertzLine::from_max_pressure(radius, equivalent_modulus, pressure),
    )?;
    Ok(dictionary!(py, {
        "half_width": contact.half_width,
        "pressure": contact.pressure,
        "force": contact.force,
    }))
}

#[pyfunction]
fn point_films<'py>(
    py: Python<'py>,
    speed: f64,
    oil: [f64; 2],
    solid: [f64; 2],
    load: f64,
    ellipticity: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let ([eta0, alpha], [equivalent_modulus, radius]) = (oil, solid);
    let films = FilmConditions {
        entrainment_speed: speed,
        eta0,
        alpha,
        equivalent_modulus,
        radius,
        load,
        ellipticity,
    };
    value(py, films.validate())?;
    Ok(dictionary!(py, {
        "hamrock_dowson_central": value(py, films.hamrock_dowson_central())?,
        "hamrock_dowson_minimum": value(py, films.hamrock_dowson_minimum())?,
        "moes_central": films.moes_central().ok(),
        "film_map": named(py, &value(py, films.film_map())?)?,
        "moes": dictionary!(py, { "m": films.moes_load(), "l": films.moes_lubricant() }),
    }))
}

#[pyfunction]
fn line_films<'py>(
    py: Python<'py>,
    speed: f64,
    oil: [f64; 2],
    solid: [f64; 2],
    load: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let ([eta0, alpha], [equivalent_modulus, radius]) = (oil, solid);
    let films =
        LineFilmConditions { entrainment_speed: speed, eta0, alpha, equivalent_modulus, radius, load };
    value(py, films.validate())?;
    Ok(dictionary!(py, {
        "dowson_toyoda_central": value(py, films.dowson_toyoda_central())?,
        "dowson_minimum": value(py, films.dowson_minimum())?,
        "moes_central": films.moes_central().ok(),
        "film_map": named(py, &value(py, films.film_map())?)?,
        "moes": dictionary!(py, { "m": films.moes_load(), "l": films.moes_lubricant() }),
    }))
}

#[pyfunction]
fn westergaard<'py>(
    py: Python<'py>,
    amplitude: f64,
    wavelength: f64,
    equivalent_modulus: f64,
    mean_pressure: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let wave = Westergaard { amplitude, wavelength, equivalent_modulus };
    Ok(dictionary!(py, {
        "full_contact_pressure": value(py, wave.full_contact_pressure())?,
        "contact_half_width": value(py, wave.contact_half_width(mean_pressure))?,
    }))
}
