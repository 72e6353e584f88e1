"""Numbers that describe surfaces, films and contacts. Arrays have the shape ``(ny, nx)``; all SI."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._numbers import Numbers
from . import _stribeck
from .surface import Boundary

__all__ = [
    "bearing",
    "composite_rq",
    "contact_patches",
    "contact_statistics",
    "height_statistics",
    "hybrid_parameters",
    "lambda_ratio",
    "radial_spectrum",
    "spatial_parameters",
]


def _heights(values: npt.ArrayLike) -> Any:
    from .solution import _array

    return _array("heights", values)


def height_statistics(heights: npt.ArrayLike) -> Numbers:
    """``mean``, ``sa``, ``sq``, ``sp``, ``sv``, ``sz`` [m], ``ssk`` and ``sku`` (ISO 25178-2)."""
    return Numbers(_stribeck.height_statistics(_heights(heights)))


def bearing(heights: npt.ArrayLike, *, peaks: float = 0.1, valleys: float = 0.8) -> Numbers:
    """Core and volume parameters ``sk``, ``spk``, ``svk`` [m], ``smr1``, ``smr2``, ``vmp``, ``vmc``, ``vvc``, ``vvv`` [m^3/m^2] (ISO 25178-2)."""
    return Numbers(_stribeck.bearing(_heights(heights), peaks, valleys))


def hybrid_parameters(heights: npt.ArrayLike, dx: float, dy: float | None = None) -> Numbers:
    """Root mean square gradient ``sdq`` and developed area ``sdr`` (ISO 25178-2), points ``dx`` and ``dy`` [m] apart."""
    return Numbers(_stribeck.hybrid_parameters(_heights(heights), dx, dx if dy is None else dy))


def spatial_parameters(
    heights: npt.ArrayLike, dx: float, dy: float | None = None, *, threshold: float = 0.2, boundary: Boundary = "periodic"
) -> Numbers:
    """Correlation length ``sal`` [m] and texture aspect ``str`` (ISO 25178-2); None where the surface is too small to tell."""
    return Numbers(_stribeck.spatial_parameters(_heights(heights), dx, dx if dy is None else dy, threshold, boundary))


def radial_spectrum(
    heights: npt.ArrayLike, dx: float, dy: float | None = None, *, boundary: Boundary = "periodic"
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Wavenumbers and the radially averaged power spectral density at them, two arrays of one length."""
    wavenumber, density = _stribeck.radial_spectrum(_heights(heights), dx, dx if dy is None else dy, boundary)
    return wavenumber, density


def contact_statistics(
    in_contact: npt.ArrayLike,
    solid_pressure: npt.ArrayLike,
    *,
    dx: float,
    dy: float | None = None,
    load: float,
    half_width_x: float,
    half_width_y: float | None = None,
) -> Numbers:
    """``area``, ``corrected_area`` [m^2], ``area_ratio``, ``corrected_area_ratio`` (of the Hertz ellipse) and ``load_ratio`` of solid contact."""
    from .solution import _array

    mask = np.ascontiguousarray(in_contact, dtype=bool)
    cell = [dx, dx if dy is None else dy]
    widths = [half_width_x, half_width_x if half_width_y is None else half_width_y]
    return Numbers(_stribeck.contact_statistics(mask, _array("solid_pressure", solid_pressure), cell, load, widths))


def contact_patches(
    in_contact: npt.ArrayLike, *, dx: float, dy: float | None = None, boundary: Boundary = "open"
) -> Numbers:
    """Connected patches of contact: their ``areas`` [m^2], ``perimeter`` [m] and ``corrected_area`` [m^2]."""
    cell = [dx, dx if dy is None else dy]
    return Numbers(_stribeck.contact_patches(np.ascontiguousarray(in_contact, dtype=bool), cell, boundary))


def composite_rq(first: float, second: float) -> float:
    """``sqrt(first^2 + second^2)`` [m]."""
    return float(np.hypot(first, second))


def lambda_ratio(film: float, composite_rq: float) -> float:
    """Film over composite roughness, both in m."""
    return _stribeck.lambda_ratio(film, composite_rq)
