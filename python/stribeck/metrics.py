"""Numbers that describe surfaces, films and contacts. Arrays have the shape ``(ny, nx)``; numbers are SI, or text with a unit.

``heights`` may be an array, a masked array, a :class:`~stribeck.surface.Surface` or any argument of its constructor. Points that are undefined, masked,
NaN or infinite are left out; ``undefined`` says how many."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, array, mask, number, refused, surface_array, text
from ._exchange import taken
from ._numbers import Table
from . import _stribeck
from .surface import Boundary, Surface

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


#: Units by name.
_HEIGHTS = dict.fromkeys(("mean", "sa", "sq", "sp", "sv", "sz"), "m")
_BEARING = dict.fromkeys(("sk", "spk", "svk"), "m") | dict.fromkeys(("vmp", "vmc", "vvc", "vvv"), "m^3/m^2")
_SPATIAL = {"sal": "m"}
_CONTACT = {"area": "m^2", "corrected_area": "m^2"}
_PATCHES = {"areas": "m^2", "perimeter": "m", "corrected_area": "m^2"}


#: Heights of any kind.
Heights = Any


def _cell(dx: Quantity, dy: Quantity | None) -> tuple[float, float]:
    return number("dx", dx, "m"), number("dy", dx if dy is None else dy, "m")


def _heights(heights: Heights) -> npt.NDArray[np.float64]:
    found = taken(heights)
    if not isinstance(heights, Surface):
        found.say("heights", 3)
    return surface_array("heights", found.heights)


def _surface(heights: Heights, dx: Quantity | None, dy: Quantity | None) -> tuple[npt.NDArray[np.float64], float, float]:
    """Heights and spacing; without ``dx`` that of the surface."""
    found = taken(heights, has_spacing=dx is not None)
    if not isinstance(heights, Surface):
        found.say("heights", 3)
    own_dx, own_dy = found.spacing
    if dx is None and own_dx is None:
        raise refused("dx", dx, "given: the heights have no spacing of their own")
    spacing = (own_dx, own_dy) if dx is None else _cell(dx, dy)
    return surface_array("heights", found.heights), float(spacing[0] or 0.0), float(spacing[1] or 0.0)


def height_statistics(heights: Heights) -> Table:
    """``mean``, ``sa``, ``sq``, ``sp``, ``sv``, ``sz`` [m], ``ssk`` and ``sku`` (ISO 25178-2), and ``undefined``."""
    return Table(_stribeck.height_statistics(_heights(heights)), units=_HEIGHTS)


def bearing(heights: Heights, *, peaks: float = 0.1, valleys: float = 0.8) -> Table:
    """Core and volume parameters ``sk``, ``spk``, ``svk`` [m], ``smr1``, ``smr2``, ``vmp``, ``vmc``, ``vvc``, ``vvv`` [m^3/m^2] (ISO 25178-2),
    and ``undefined``."""
    shares = number("peaks", peaks, "1"), number("valleys", valleys, "1")
    return Table(_stribeck.bearing(_heights(heights), *shares), units=_BEARING)


def hybrid_parameters(heights: Heights, dx: Quantity | None = None, dy: Quantity | None = None) -> Table:
    """Root mean square gradient ``sdq`` and developed area ``sdr`` (ISO 25178-2), points ``dx`` and ``dy`` [m] apart (those of a ``Surface``
    unless given), and ``undefined``."""
    return Table(_stribeck.hybrid_parameters(*_surface(heights, dx, dy)))


def spatial_parameters(
    heights: Heights, dx: Quantity | None = None, dy: Quantity | None = None, *, threshold: float = 0.2, boundary: Boundary = "periodic"
) -> Table:
    """Correlation length ``sal`` [m] and texture aspect ``str`` (ISO 25178-2); None where the surface is too small to tell; and
    ``undefined``."""
    chosen = number("threshold", threshold, "1"), text("boundary", boundary)
    return Table(_stribeck.spatial_parameters(*_surface(heights, dx, dy), *chosen), units=_SPATIAL)


def radial_spectrum(
    heights: Heights, dx: Quantity | None = None, dy: Quantity | None = None, *, boundary: Boundary = "periodic"
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Wavenumbers and the radially averaged power spectral density at them, two arrays of one length. Undefined points enter with the mean
    height, and the density is divided by the share of the defined ones."""
    wavenumber, density = _stribeck.radial_spectrum(*_surface(heights, dx, dy), text("boundary", boundary))
    return wavenumber, density


def contact_statistics(
    in_contact: npt.ArrayLike,
    solid_pressure: npt.ArrayLike,
    *,
    dx: Quantity,
    dy: Quantity | None = None,
    load: Quantity,
    half_width_x: Quantity,
    half_width_y: Quantity | None = None,
) -> Table:
    """``area``, ``corrected_area`` [m^2], ``area_ratio``, ``corrected_area_ratio`` (of the Hertz ellipse) and ``load_ratio`` of solid contact."""
    fields = mask("in_contact", in_contact), array("solid_pressure", solid_pressure)
    other = half_width_x if half_width_y is None else half_width_y
    widths = [number("half_width_x", half_width_x, "m"), number("half_width_y", other, "m")]
    return Table(_stribeck.contact_statistics(*fields, _cell(dx, dy), number("load", load, "N"), widths), units=_CONTACT)


def contact_patches(
    in_contact: npt.ArrayLike, *, dx: Quantity, dy: Quantity | None = None, boundary: Boundary = "open"
) -> Table:
    """Connected patches of contact: their ``areas`` [m^2], ``perimeter`` [m] and ``corrected_area`` [m^2]."""
    patches = _stribeck.contact_patches(mask("in_contact", in_contact), _cell(dx, dy), text("boundary", boundary))
    return Table(patches, units=_PATCHES)


def composite_rq(first: Quantity, second: Quantity) -> float:
    """``sqrt(first^2 + second^2)`` [m]."""
    return float(np.hypot(_rq("first", first), _rq("second", second)))


def _rq(field: str, value: Quantity) -> float:
    found = number(field, value, "m")
    if not 0.0 <= found < np.inf:
        raise refused(field, value, "finite and at least 0")
    return found


def lambda_ratio(film: Quantity, composite_rq: Quantity) -> float:
    """Film over composite roughness, both in m."""
    rq = _rq("composite_rq", composite_rq)
    if rq == 0.0:
        raise refused("composite_rq", composite_rq, "above 0")
    return _stribeck.lambda_ratio(number("film", film, "m"), rq)
