"""Surfaces of other packages: xarray, SurfaceTopography and NumPy's masked arrays, taken and given back. None of them is needed."""

from __future__ import annotations

import warnings
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from ._stribeck import quantity
from .errors import InputError, SurfaceError

if TYPE_CHECKING:
    from .surface import Surface

#: Distances of points along x and y [m]; None where they are not known.
Spacing = tuple[float | None, float | None]

#: Largest deviation of coordinates from equidistant ones, over their distance.
_TOLERANCE = 0.02


def taken(values: Any) -> tuple[Any, Spacing]:
    """Heights of the shape ``(ny, nx)`` and spacing of a surface of any package; anything else as it is."""
    from .surface import Surface

    if isinstance(values, Surface):
        return values.heights, (values.dx, values.dy)
    if callable(getattr(values, "heights", None)) and hasattr(values, "physical_sizes"):
        return _of_topography(values)
    if hasattr(values, "dims") and hasattr(values, "coords") and hasattr(values, "transpose"):
        return _of_xarray(values)
    return values, (None, None)


def _metres(field: str, unit: Any) -> float:
    """Length of a unit [m]; None is a metre."""
    if unit is None:
        return 1.0
    # both signs for micro
    name = str(unit).replace("\u00b5", "u").replace("\u03bc", "u")
    return quantity(field, f"1 {name}", "m")


def _of_topography(topography: Any) -> tuple[Any, Spacing]:
    """Heights and spacing of a topography of SurfaceTopography, whose arrays are ``(nx, ny)``."""
    if not getattr(topography, "is_uniform", True):
        message = "heights: the points of the topography are not equidistant; its to_uniform() makes them so"
        raise InputError(message, field="heights", value=topography)
    metres = _metres("heights.unit", topography.unit)
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan) * metres
    heights = heights[:, np.newaxis] if heights.ndim == 1 else heights
    sizes = topography.physical_sizes
    if sizes is None:
        return heights.T, (None, None)
    spacing = [float(size) * metres / count for size, count in zip(np.atleast_1d(sizes), heights.shape, strict=False)]
    return heights.T, (spacing[0], spacing[-1])


def _of_xarray(values: Any) -> tuple[Any, Spacing]:
    """Heights and spacing of a DataArray with the dimensions y and x, in any order, or those of its order."""
    dims = [str(dim) for dim in values.dims]
    if len(dims) == 1:
        values = values.expand_dims("y")
    elif len(dims) == 2 and set(dims) == {"x", "y"}:
        values = values.transpose("y", "x")
    heights = np.asarray(values.values, dtype=np.float64) * _metres("heights.units", values.attrs.get("units"))
    spacing: list[float | None] = [None, None]
    for axis, dim in enumerate(values.dims):
        if dim not in values.coords or values.sizes[dim] < 2:
            continue
        coordinate = values.coords[dim]
        step, falls = _step(str(dim), np.asarray(coordinate.values, dtype=np.float64))
        spacing[axis] = step * _metres(f"heights.{dim}.units", coordinate.attrs.get("units"))
        if falls:
            heights = np.flip(heights, axis)
    dy, dx = spacing
    return heights, (dx if dx is not None else dy, dy if dy is not None else dx)


def _step(name: str, positions: np.ndarray[Any, Any]) -> tuple[float, bool]:
    """Distance of equidistant positions, and whether they fall."""
    step = (positions[-1] - positions[0]) / (len(positions) - 1)
    raster = positions[0] + step * np.arange(len(positions))
    off = float(np.abs(positions - raster).max())
    if not off <= _TOLERANCE * abs(step):
        message = f"heights.{name}: the coordinates are off a raster of spacing {abs(step):.4g} by up to {off:.4g}"
        raise InputError(message, field=f"heights.{name}", value=positions)
    return float(abs(step)), bool(step < 0.0)


def to_xarray(surface: Surface) -> Any:
    """A DataArray with the dimensions y and x, all lengths in metres."""
    import xarray

    dx, dy = _known_spacing(surface)
    ny, nx = surface.shape
    metre = {"units": "m"}
    coords = {"y": ("y", dy * np.arange(ny), metre), "x": ("x", dx * np.arange(nx), metre)}
    return xarray.DataArray(surface.heights, coords=coords, dims=("y", "x"), name="height", attrs=metre)


def to_surface_topography(surface: Surface) -> Any:
    """A topography or line scan in metres."""
    package = import_module("SurfaceTopography")
    dx, dy = _known_spacing(surface)
    ny, nx = surface.shape
    heights = surface.to_masked() if surface.undefined else surface.heights
    if ny == 1:
        return package.UniformLineScan(heights[0], nx * dx, unit="m")
    return package.Topography(heights.T, (nx * dx, ny * dy), unit="m")


def _known_spacing(surface: Surface) -> tuple[float, float]:
    if surface.dx is None or surface.dy is None:
        raise SurfaceError("dx: the surface has no lateral spacing; with_spacing(dx, dy) gives it one", field="dx", value=None)
    return surface.dx, surface.dy


def can_read(place: str) -> bool:
    """Whether the file is binary and the package SurfaceTopography is installed: it takes more text for heights than is."""
    with open(place, "rb") as file:
        is_binary = b"\0" in file.read(4096)
    return is_binary and find_spec("SurfaceTopography") is not None


def read(place: str, channel: int | None, refused: SurfaceError) -> Any:
    """The topography of a file by SurfaceTopography; ``refused`` is the error of the file where that does not know it either."""
    # warnings of the package itself
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return _read(place, channel, refused)


def _read(place: str, channel: int | None, refused: SurfaceError) -> Any:
    package, errors = import_module("SurfaceTopography"), import_module("SurfaceTopography.Exceptions")
    try:
        reader = package.open_topography(place)
    except (errors.CannotDetectFileFormat, errors.UnknownFileFormat):
        raise refused from None
    except Exception as error:
        raise SurfaceError(f"{refused}; SurfaceTopography: {error}", field="path", value=place) from error
    names = [found.name for found in reader.channels]
    if not 1 <= (channel or 1) <= len(names) or (channel is None and len(names) > 1):
        listed = ", ".join(f"{k + 1} {name!r}" for k, name in enumerate(names))
        message = f"{place}: {len(names)} surfaces ({listed}); choose one by its number, channel = 1 to {len(names)}"
        raise SurfaceError(message, field="channel", value=place)
    try:
        return reader.topography(channel_index=(channel or 1) - 1)
    except Exception as error:
        raise SurfaceError(f"{place}: SurfaceTopography: {error}", field="path", value=place) from error
