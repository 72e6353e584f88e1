"""Surfaces of other packages: xarray, SurfaceTopography and NumPy's masked arrays, taken and given back. None of them is needed."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field, replace
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from ._packages import needed
from .errors import InputError, StribeckWarning, SurfaceError

if TYPE_CHECKING:
    from .surface import Surface

#: Distances of points along x and y [m]; None where they are not known.
Spacing = tuple[float | None, float | None]

#: Largest deviation of coordinates from equidistant ones, over their distance.
_TOLERANCE = 0.02


#: Units of length [m] of SurfaceTopography and xarray; signs for micro and Angstrom are written in ASCII.
_UNITS = {
    "km": 1e3,
    "m": 1.0,
    "dm": 1e-1,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "nm": 1e-9,
    "A": 1e-10,
    "pm": 1e-12,
    "in": 25.4e-3,
    "mil": 25.4e-6,
    "uin": 25.4e-9,
}
_ASCII = {"\u00b5": "u", "\u03bc": "u", "\u00c5": "A", "\u212b": "A", "inch": "in"}
#: Words in the names of channels that hold no heights, though their unit may be a length.
_NO_HEIGHTS = ("phase", "amplitude", "deflection", "friction", "lateral", "current", "potential", "error")
#: Readers of SurfaceTopography for arrays without axes, which programs store row by row.
_ARRAYS = ("mat", "h5", "npz")
#: Readers of SurfaceTopography that take more for heights than is: of text, and of files without a signature.
_LOOSE_READERS = ("asc", "xyz", "hgt")


@dataclass(frozen=True)
class Taken:
    """A surface of any package, lengths in metres."""

    heights: Any
    spacing: Spacing = (None, None)
    #: That of the heights before.
    unit: str | None = None
    #: Units that are not known, a sentence each.
    doubts: list[str] = field(default_factory=list)
    is_periodic: bool = False

    def say(self, name: str, depth: int) -> None:
        """Issues the doubts as warnings about ``name``."""
        for doubt in self.doubts:
            warnings.warn(StribeckWarning(name, None, doubt, ""), stacklevel=depth + 1)


def taken(values: Any, unit: str | None = None, *, has_spacing: bool = False) -> Taken:
    """Heights of the shape ``(ny, nx)`` and spacing of a surface of any package; anything else as it is. ``unit`` is that of lengths for
    which the surface names none; with a spacing given beside it that of the surface does not matter."""
    from .surface import Surface

    if isinstance(values, Surface):
        found = Taken(values.heights, (values.dx, values.dy), values.unit, values.warnings, values.is_periodic)
    elif callable(getattr(values, "heights", None)) and hasattr(values, "physical_sizes"):
        return _of_topography(values, _Units(unit, has_spacing))
    elif hasattr(values, "dims") and hasattr(values, "data_vars"):
        names = ", ".join(map(str, values.data_vars))
        raise InputError(f"heights: a Dataset ({names}), take one of its variables", field="heights", value=values)
    elif hasattr(values, "dims") and hasattr(values, "coords") and hasattr(values, "transpose"):
        return _of_xarray(values, _Units(unit, has_spacing))
    else:
        found = Taken(values)
    if unit is not None:
        raise InputError(f"unit = {unit!r}: the heights of an array or a Surface are in metres", field="unit", value=unit)
    return found


class _Units:
    """Units of a surface, and the doubts about them."""

    def __init__(self, option: str | None, has_spacing: bool) -> None:
        self.option = option
        self.has_spacing = has_spacing
        self.doubts: list[str] = []
        if option is not None:
            _metres("unit", option)

    def of_heights(self, field: str, unit: Any) -> tuple[float, str | None]:
        """Length of the unit of the heights [m], and its name."""
        name = self._named(unit, "the unit of the heights is not known")
        return (1.0, None) if name is None else _metres(field, name)

    def along(self, field: str, unit: Any) -> float:
        """Length of the unit of positions [m]."""
        missing = None if self.has_spacing else "the unit of the lengths along x and y is not known"
        name = self._named(unit, missing)
        return 1.0 if name is None else _metres(field, name)[0]

    def _named(self, unit: Any, missing: str | None) -> str | None:
        name = self.option if unit is None else str(unit)
        doubt = f"{missing}, their numbers are taken as metres; the option unit names it"
        if name is None and missing is not None and doubt not in self.doubts:
            self.doubts.append(doubt)
        return name


def _metres(field: str, unit: str) -> tuple[float, str]:
    """Length of a unit [m], and its name in ASCII."""
    name = unit.strip()
    for sign, plain in _ASCII.items():
        name = name.replace(sign, plain)
    metres = _UNITS.get(name)
    if metres is None:
        raise InputError(f"{field} = {unit!r}: must be a unit of length: {', '.join(_UNITS)}", field=field, value=unit)
    return metres, name


def _of_topography(topography: Any, units: _Units) -> Taken:
    """A topography of SurfaceTopography, whose arrays are ``(nx, ny)``."""
    if not getattr(topography, "is_uniform", True):
        message = "heights: the points of the topography are not equidistant; its to_uniform() makes them so"
        raise InputError(message, field="heights", value=topography)
    # one unit, or those of positions and heights
    lateral, own = topography.unit if isinstance(topography.unit, tuple) else (topography.unit, topography.unit)
    metres, name = units.of_heights("heights.unit", own)
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan) * metres
    heights = heights[:, np.newaxis] if heights.ndim == 1 else heights
    sizes = topography.physical_sizes
    spacing: Spacing = (None, None)
    if sizes is not None:
        along = units.along("heights.unit", lateral)
        steps = [float(size) * along / count for size, count in zip(np.atleast_1d(sizes), heights.shape, strict=False)]
        spacing = (steps[0], steps[-1])
    return Taken(heights.T, spacing, name, units.doubts, bool(getattr(topography, "is_periodic", False)))


def _unit_of(attributes: Any) -> Any:
    return attributes.get("units", attributes.get("unit"))


def _of_xarray(values: Any, units: _Units) -> Taken:
    """A DataArray with the dimensions y and x, in any order, or those of its order."""
    dims = [str(dim) for dim in values.dims]
    if len(dims) == 1:
        values = values.expand_dims("y")
    elif len(dims) == 2 and set(dims) == {"x", "y"}:
        values = values.transpose("y", "x")
    metres, name = units.of_heights("heights.units", _unit_of(values.attrs))
    heights = np.asarray(values.values, dtype=np.float64) * metres
    spacing: list[float | None] = [None, None]
    for axis, dim in enumerate(values.dims):
        if axis > 1 or dim not in values.coords or values.sizes[dim] < 2:
            continue
        coordinate = values.coords[dim]
        step, falls = _step(str(dim), np.asarray(coordinate.values, dtype=np.float64))
        spacing[axis] = step * units.along(f"heights.{dim}.units", _unit_of(coordinate.attrs))
        if falls:
            heights = np.flip(heights, axis)
    dy, dx = spacing
    return Taken(heights, (dx if dx is not None else dy, dy if dy is not None else dx), name, units.doubts)


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
    xr = needed("xarray", "to_xarray()")
    dx, dy = _known_spacing(surface)
    ny, nx = surface.shape
    metre = {"units": "m"}
    coords = {"y": ("y", dy * np.arange(ny), metre), "x": ("x", dx * np.arange(nx), metre)}
    return xr.DataArray(surface.heights, coords=coords, dims=("y", "x"), name="height", attrs=metre)


def to_surface_topography(surface: Surface) -> Any:
    """A topography or line scan in metres."""
    package = needed("SurfaceTopography", "to_surface_topography()")
    dx, dy = _known_spacing(surface)
    ny, nx = surface.shape
    heights = surface.to_masked() if surface.undefined else surface.heights
    if ny == 1:
        return package.UniformLineScan(heights[0], nx * dx, unit="m", periodic=surface.is_periodic)
    return package.Topography(heights.T, (nx * dx, ny * dy), unit="m", periodic=surface.is_periodic)


def _known_spacing(surface: Surface) -> tuple[float, float]:
    if surface.dx is None or surface.dy is None:
        raise SurfaceError("dx: the surface has no lateral spacing; with_spacing(dx, dy) gives it one", field="dx", value=None)
    return surface.dx, surface.dy


def read(place: str, channel: int | None, unit: str | None, refused: SurfaceError) -> Taken:
    """The surface of a file by SurfaceTopography; ``refused`` is the error of a file that this does not know either."""
    if find_spec("SurfaceTopography") is None:
        raise refused
    # warnings of the package itself
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return _read(place, channel, unit, refused)
        except SurfaceError:
            raise
        except InputError as error:
            raise SurfaceError(f"{place}: {error}", field=error.field, value=place) from error


def _read(place: str, channel: int | None, unit: str | None, refused: SurfaceError) -> Taken:
    package, errors = import_module("SurfaceTopography"), import_module("SurfaceTopography.Exceptions")
    try:
        reader = package.open_topography(place)
    except (errors.CannotDetectFileFormat, errors.UnknownFileFormat):
        raise refused from None
    except Exception as error:
        raise SurfaceError(f"{refused}; SurfaceTopography: {error}", field="path", value=place) from error
    if reader.format() in _LOOSE_READERS:
        raise refused
    number = _choose(place, channel, reader.channels) - 1
    # sizes that the file does not give are stood in for by the number of points
    sizes = {} if reader.channels[number].physical_sizes is not None else {"physical_sizes": reader.channels[number].nb_grid_pts}
    try:
        topography = reader.topography(channel_index=number, **sizes)
    except Exception as error:
        raise SurfaceError(f"{place}: SurfaceTopography: {error}", field="path", value=place) from error
    found = _of_topography(topography, _Units(unit, bool(sizes)))
    if reader.format() in _ARRAYS:
        doubt = "the array of the file names no axes, its rows are taken along x"
        dx, dy = found.spacing
        found = replace(found, heights=found.heights.T, spacing=(dy, dx), doubts=[*found.doubts, doubt])
    return replace(found, spacing=(None, None)) if sizes else found


def _choose(place: str, channel: int | None, channels: Any) -> int:
    """The number of the chosen channel, from 1, which must hold heights."""
    count = len(channels)

    def error(message: str) -> SurfaceError:
        return SurfaceError(f"{place}: {message}", field="channel", value=place)

    def listed(chosen: Any) -> str:
        return ", ".join(f"{k} {channels[k - 1].name!r}" for k in chosen)

    if count == 0:
        raise error("no surface that SurfaceTopography knows")
    number = 1 if channel is None and count == 1 else channel
    if number is None or not 1 <= number <= count:
        choice = f"{count} surfaces ({listed(range(1, count + 1))}); choose one by its number, channel = 1 to {count}"
        raise error(choice if count > 1 else "one surface alone; its number is channel = 1")
    if not _holds_heights(channels[number - 1]):
        others = [k for k in range(1, count + 1) if _holds_heights(channels[k - 1])]
        remedy = f"; heights are in channel {listed(others)}" if others else ""
        raise error(f"channel {listed([number])} holds no heights{remedy}")
    return number


def _holds_heights(channel: Any) -> bool:
    """Whether kind, unit and name of a channel are those of heights."""
    kind = getattr(channel, "data_kind", None)
    unit = channel.unit[1] if isinstance(channel.unit, tuple) else channel.unit
    is_length = unit is not None or not isinstance(channel.unit, tuple)
    name = str(channel.name).lower()
    return (kind is None or kind.name == "HEIGHT") and is_length and not any(word in name for word in _NO_HEIGHTS)
