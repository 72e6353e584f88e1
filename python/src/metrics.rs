//! Numbers that describe surfaces, films and contacts.

use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::Grid;
use stribeck::metrics::{self, AreaCorrelation, BearingCurve};

use crate::convert::{contiguous, dictionary, on_grid};
use crate::error::value;
use crate::surface::boundary;

type Array<'py> = PyReadonlyArray2<'py, f64>;
/// Values of a curve, and the ends of a line.
type Curve<'py> = (Bound<'py, PyArray1<f64>>, (f64, f64));

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(height_statistics, module)?)?;
    module.add_function(wrap_pyfunction!(bearing, module)?)?;
    module.add_function(wrap_pyfunction!(bearing_curve, module)?)?;
    module.add_function(wrap_pyfunction!(hybrid_parameters, module)?)?;
    module.add_function(wrap_pyfunction!(spatial_parameters, module)?)?;
    module.add_function(wrap_pyfunction!(radial_spectrum, module)?)?;
    module.add_function(wrap_pyfunction!(contact_statistics, module)?)?;
    module.add_function(wrap_pyfunction!(contact_patches, module)?)?;
    module.add_function(wrap_pyfunction!(lambda_ratio, module)?)
}

/// The grid of an array whose points lie `dx` and `dy` \[m\] apart, its centre at 0.
fn grid_of(py: Python<'_>, shape: &[usize], dx: f64, dy: f64) -> PyResult<Grid> {
    value(py, Grid::centred(shape[1], shape[0], dx, dy))
}

/// Finite heights, in their order, and how many are not.
fn defined(heights: &[f64]) -> (Vec<f64>, usize) {
    let finite: Vec<f64> = heights.iter().copied().filter(|height| height.is_finite()).collect();
    let undefined = heights.len() - finite.len();
    (finite, undefined)
}

/// Which heights are finite.
fn mask(heights: &[f64]) -> Vec<bool> {
    heights.iter().map(|height| height.is_finite()).collect()
}

#[pyfunction]
fn height_statistics<'py>(py: Python<'py>, heights: Array<'py>) -> PyResult<Bound<'py, PyDict>> {
    let (heights, undefined) = defined(contiguous(py, "heights", &heights)?);
    let numbers = value(py, metrics::height_statistics(&heights))?;
    Ok(dictionary!(py, {
        "undefined": undefined,
        "mean": numbers.mean,
        "sa": numbers.sa,
        "sq": numbers.sq,
        "ssk": numbers.ssk,
        "sku": numbers.sku,
        "sp": numbers.sp,
        "sv": numbers.sv,
        "sz": numbers.sz,
    }))
}

#[pyfunction]
fn bearing<'py>(
    py: Python<'py>,
    heights: Array<'py>,
    peaks: f64,
    valleys: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let (heights, undefined) = defined(contiguous(py, "heights", &heights)?);
    let curve = value(py, BearingCurve::new(&heights))?;
    let (core, volumes) = (curve.core(), value(py, curve.volumes(peaks, valleys))?);
    Ok(dictionary!(py, {
        "undefined": undefined,
        "sk": core.sk,
        "spk": core.spk,
        "svk": core.svk,
        "smr1": core.smr1,
        "smr2": core.smr2,
        "vmp": volumes.vmp,
        "vmc": volumes.vmc,
        "vvc": volumes.vvc,
        "vvv": volumes.vvv,
    }))
}

#[pyfunction]
fn hybrid_parameters<'py>(
    py: Python<'py>,
    heights: Array<'py>,
    dx: f64,
    dy: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let grid = grid_of(py, heights.shape(), dx, dy)?;
    let heights = contiguous(py, "heights", &heights)?;
    let known = mask(heights);
    let numbers = value(py, metrics::hybrid_parameters(&grid, heights, Some(&known)))?;
    let undefined = known.iter().filter(|known| !**known).count();
    Ok(dictionary!(py, { "undefined": undefined, "sdq": numbers.sdq, "sdr": numbers.sdr }))
}

/// The bearing curve: heights about the mean, highest first, and the ends of the equivalent line of the core.
#[pyfunction]
fn bearing_curve<'py>(py: Python<'py>, heights: Array<'py>) -> PyResult<Curve<'py>> {
    let (heights, _) = defined(contiguous(py, "heights", &heights)?);
    let curve = value(py, BearingCurve::new(&heights))?;
    Ok((PyArray1::from_slice(py, curve.heights()), curve.equivalent_line()))
}

#[pyfunction]
fn spatial_parameters<'py>(
    py: Python<'py>,
    heights: Array<'py>,
    dx: f64,
    dy: f64,
    threshold: f64,
    boundary_name: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let grid = grid_of(py, heights.shape(), dx, dy)?;
    let boundary = boundary(py, boundary_name)?;
    let heights = contiguous(py, "heights", &heights)?;
    let known = mask(heights);
    let correlation = value(py, py.detach(|| AreaCorrelation::new(&grid, heights, Some(&known), boundary)))?;
    let numbers = value(py, correlation.spatial(threshold))?;
    let undefined = known.iter().filter(|known| !**known).count();
    Ok(dictionary!(py, { "undefined": undefined, "sal": numbers.sal, "str": numbers.str }))
}

#[pyfunction]
fn radial_spectrum<'py>(
    py: Python<'py>,
    heights: Array<'py>,
    dx: f64,
    dy: f64,
    boundary_name: &str,
) -> PyResult<[Bound<'py, PyArray1<f64>>; 2]> {
    let grid = grid_of(py, heights.shape(), dx, dy)?;
    let boundary = boundary(py, boundary_name)?;
    let heights = contiguous(py, "heights", &heights)?;
    let (known, undefined) = defined(heights);
    let mean = value(py, metrics::height_statistics(&known))?.mean;
    // undefined points have the mean height, which adds nothing
    let filled: Vec<f64> = heights.iter().map(|z| if z.is_finite() { z - mean } else { 0.0 }).collect();
    let mut spectrum = value(py, py.detach(|| metrics::radial_spectrum(&grid, &filled, boundary)))?;
    let share = known.len() as f64 / (known.len() + undefined) as f64;
    spectrum.density.iter_mut().for_each(|density| *density /= share);
    Ok([spectrum.wavenumber, spectrum.density].map(|values| PyArray1::from_vec(py, values)))
}

#[pyfunction]
fn contact_statistics<'py>(
    py: Python<'py>,
    in_contact: PyReadonlyArray2<'py, bool>,
    solid_pressure: Array<'py>,
    cell: [f64; 2],
    load: f64,
    half_widths: [f64; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let grid = grid_of(py, in_contact.shape(), cell[0], cell[1])?;
    let touching = contiguous(py, "in_contact", &in_contact)?;
    let solid = on_grid(py, "solid_pressure", &solid_pressure, &grid)?;
    let [a_x, a_y] = half_widths;
    let numbers = value(py, metrics::contact_statistics(&grid, touching, solid, load, a_x, a_y))?;
    Ok(dictionary!(py, {
        "area": numbers.area,
        "area_ratio": numbers.area_ratio,
        "corrected_area": numbers.corrected_area,
        "corrected_area_ratio": numbers.corrected_area_ratio,
        "load_ratio": numbers.load_ratio,
    }))
}

#[pyfunction]
fn contact_patches<'py>(
    py: Python<'py>,
    in_contact: PyReadonlyArray2<'py, bool>,
    cell: [f64; 2],
    boundary_name: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let grid = grid_of(py, in_contact.shape(), cell[0], cell[1])?;
    let touching = contiguous(py, "in_contact", &in_contact)?;
    let patches = value(py, metrics::contact_patches(&grid, touching, boundary(py, boundary_name)?))?;
    Ok(dictionary!(py, {
        "areas": PyArray1::from_vec(py, patches.areas),
        "perimeter": patches.perimeter,
        "corrected_area": patches.corrected_area,
    }))
}

#[pyfunction]
fn lambda_ratio(py: Python<'_>, film: f64, composite_rq: f64) -> PyResult<f64> {
    value(py, metrics::lambda_ratio(film, composite_rq))
}
