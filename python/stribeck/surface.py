"""Surfaces: measured ones and their preparation, generated ones. Heights are in metres and point out of the body; arrays have the shape
``(ny, nx)``, x along the flow. Lengths are numbers in metres, or text with a unit."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _exchange
from ._arguments import Quantity, cells, mask, number, optional_number, path as _path, surface_array, text, truth, whole, wholes
from ._stribeck import Surface as _Surface, generate as _generate
from .errors import InputError, StribeckWarning, SurfaceError, unknown
from .scene import Grid

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .plot import SurfacePicture

__all__ = ["Surface", "dimples", "generate", "grooves", "read"]

Boundary = Literal["periodic", "open"]
Field = npt.NDArray[np.float64]


class Surface:
    """A measured surface. Every step of a preparation gives a new one, so that steps can be chained:
    ``read(path).fill_undefined().remove_plane().s_filter(2e-6)``."""

    __slots__ = ("_is_periodic", "_raw")

    def __init__(
        self,
        heights: npt.ArrayLike,
        dx: Quantity | None = None,
        dy: Quantity | None = None,
        defined: npt.ArrayLike | None = None,
        *,
        unit: str | None = None,
    ) -> None:
        """Heights [m] of the shape ``(ny, nx)``, spacing [m] and which points are defined; ``dy`` is ``dx`` unless given.

        Points whose height is masked, NaN or infinite are undefined. ``heights`` may also be an xarray ``DataArray`` with equidistant
        coordinates, a topography of the package SurfaceTopography, whose arrays are ``(nx, ny)``, or another ``Surface``: spacing and
        unit are then theirs. ``unit`` is that of lengths for which a ``DataArray`` or a topography names none; without it they are taken as
        metres, with a :class:`~stribeck.StribeckWarning`.
        """
        given = optional_number("dx", dx, "m"), optional_number("dy", dy, "m")
        named = None if unit is None else text("unit", unit)
        found = _exchange.taken(heights, named, has_spacing=given[0] is not None)
        known = None if defined is None else mask("defined", defined)
        spacing = given if given[0] is not None else found.spacing
        self._raw = _Surface(surface_array("heights", found.heights), *spacing, known, found.unit, found.doubts)
        self._is_periodic = found.is_periodic
        if not isinstance(heights, Surface):
            found.say("heights", 2)

    @classmethod
    def _of(cls, raw: Any, is_periodic: bool = False) -> Surface:
        surface = cls.__new__(cls)
        surface._raw, surface._is_periodic = raw, is_periodic
        return surface

    def __reduce__(self) -> tuple[Any, ...]:
        parts = (self.heights, self.dx, self.dy, self._raw.defined, self.unit, self.warnings)
        return _restored, (parts, self._is_periodic)

    @property
    def heights(self) -> Field:
        """Heights [m], shape ``(ny, nx)``, a copy; NaN where undefined."""
        return self._raw.heights

    @property
    def defined(self) -> npt.NDArray[np.bool_]:
        """Which points are defined."""
        mask = self._raw.defined
        return np.ones(self.shape, dtype=bool) if mask is None else mask

    @property
    def shape(self) -> tuple[int, int]:
        """``(ny, nx)``."""
        return self._raw.ny, self._raw.nx

    @property
    def dx(self) -> float | None:
        """Distance of the points along x [m]; None where the file does not say."""
        return self._raw.dx

    @property
    def dy(self) -> float | None:
        """Distance of the points along y [m]."""
        return self._raw.dy

    @property
    def undefined(self) -> int:
        """Number of undefined points."""
        return self._raw.undefined

    @property
    def unit(self) -> str | None:
        """Unit of the heights in the file they were read from; None where it names none and its numbers are taken as metres."""
        return self._raw.unit

    @property
    def warnings(self) -> list[str]:
        """Doubts of the reader of the file or of the object: missing units, keys that are not understood, layouts chosen among several."""
        return self._raw.warnings

    @property
    def is_periodic(self) -> bool:
        """Whether the topography that the surface was made of repeats; steps of a preparation do not keep that."""
        return self._is_periodic

    def with_spacing(self, dx: Quantity, dy: Quantity | None = None) -> Surface:
        """The same heights with other distances of the points [m]."""
        return self._of(self._raw.with_spacing(number("dx", dx, "m"), number("dy", dx if dy is None else dy, "m")))

    def fill_undefined(self) -> Surface:
        """Undefined points filled from their neighbours."""
        return self._of(self._raw.fill_undefined())

    def remove_plane(self) -> Surface:
        """Without the plane of least squares."""
        return self._of(self._raw.remove_plane())

    def remove_polynomial(self, degree: int) -> Surface:
        """Without the polynomial of least squares."""
        return self._of(self._raw.remove_polynomial(whole("degree", degree)))

    def remove_sphere(self) -> tuple[Surface, float]:
        """Without the sphere of least squares, and its radius [m]."""
        raw, radius = self._raw.remove_sphere()
        return self._of(raw), radius

    def remove_cylinder(self) -> tuple[Surface, float]:
        """Without the cylinder of least squares, and its radius [m]."""
        raw, radius = self._raw.remove_cylinder()
        return self._of(raw), radius

    def s_filter(self, cutoff: Quantity, boundary: Boundary = "open") -> Surface:
        """Without waves shorter than about ``cutoff`` [m] (Gaussian filter)."""
        return self._of(self._raw.s_filter(number("cutoff", cutoff, "m"), text("boundary", boundary)))

    def l_filter(self, cutoff: Quantity, boundary: Boundary = "open") -> Surface:
        """Without waves longer than about ``cutoff`` [m] (Gaussian filter)."""
        return self._of(self._raw.l_filter(number("cutoff", cutoff, "m"), text("boundary", boundary)))

    def set_rq(self, rq: Quantity) -> Surface:
        """Scaled to the root mean square height ``rq`` [m]."""
        return self._of(self._raw.set_rq(number("rq", rq, "m")))

    def taper(self, width: Quantity) -> Surface:
        """With edges that fade to the mean over ``width`` [m]."""
        return self._of(self._raw.taper(number("width", width, "m")))

    def crop(self, first: tuple[int, int], nx: int, ny: int) -> Surface:
        """``nx`` x ``ny`` points from the column and row ``first`` on."""
        return self._of(self._raw.crop(wholes("first", first, 2), whole("nx", nx), whole("ny", ny)))

    def rotated_90(self) -> Surface:
        """Turned by a quarter."""
        return self._of(self._raw.rotated_90())

    def fit_to_grid(self, grid: Grid) -> Field:
        """Levelled, filled, mirrored until it covers ``grid``, and resampled: heights [m] of the shape ``(ny, nx)``."""
        return self._raw.fit_to_grid(cells(grid))

    def resample(self, grid: Grid) -> Field:
        """Resampled to ``grid``, which it must cover: heights [m] of the shape ``(ny, nx)``."""
        return self._raw.resample(cells(grid))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the surface; the format is that of the name: ``.x3p``, ``.npy``, ``.txt`` or ``.csv``."""
        self._raw.write(_path("path", path))

    def to_masked(self) -> np.ma.MaskedArray[Any, Any]:
        """The heights [m] as a masked array of the shape ``(ny, nx)``, masked where undefined."""
        return np.ma.masked_invalid(self.heights)

    def to_xarray(self) -> Any:
        """The heights [m] as an xarray ``DataArray`` with the dimensions ``y`` and ``x`` and their coordinates [m]."""
        return _exchange.to_xarray(self)

    def to_surface_topography(self) -> Any:
        """The surface as a topography of the package SurfaceTopography, in metres; of a single row a line scan."""
        return _exchange.to_surface_topography(self)

    def plot(self, *, ax: Sequence[Axes] | None = None) -> SurfacePicture:
        """The height map with undefined points in grey, the middle profile, the height distribution, the bearing curve with the construction
        of Sk, and the spectrum, as :func:`stribeck.plot.surface`: ``surface.plot().figure.savefig("disc.png")``. Needs matplotlib."""
        from .plot import surface

        return surface(self, ax=ax)

    def __repr__(self) -> str:
        spacing = "unknown spacing" if self.dx is None or self.dy is None else f"{self.dx * 1e6:g} x {self.dy * 1e6:g} um apart"
        return f"<Surface of {self.shape[1]} x {self.shape[0]} points, {spacing}, {self.undefined} undefined>"


def _restored(parts: tuple[Any, ...], is_periodic: bool) -> Surface:
    return Surface._of(_Surface(*parts), is_periodic)


def read(path: str | os.PathLike[str], *, channel: int | None = None, unit: str | None = None) -> Surface:
    """Reads a file of an instrument: x3p, sur, sdf, prf, plu, al3d, npy or text; other formats by the package SurfaceTopography, where it is
    installed (``pip install "stribeck[formats]"``).

    ``channel`` chooses a surface of a file that holds several, counted from 1. ``unit`` is that of heights and lengths for which the
    file names none; without it they are taken as metres. This and other doubts are :class:`~stribeck.StribeckWarning`, and in
    :attr:`Surface.warnings`. Raises :class:`~stribeck.SurfaceError` or :class:`~stribeck.FileError`, whose ``value`` is the path.
    """
    place = _path("path", path)
    chosen = None if channel is None else whole("channel", channel)
    named = None if unit is None else text("unit", unit)
    try:
        surface = Surface._of(_Surface.read(place, chosen, named))
    except SurfaceError as error:
        if error.field != "format":
            raise
        refused = SurfaceError(str(error), field="path", value=place)
        surface = _of_other(_exchange.read(place, chosen, named, refused))
    for doubt in surface.warnings:
        warnings.warn(StribeckWarning(str(place), None, doubt, ""), stacklevel=2)
    return surface


def _of_other(found: _exchange.Taken) -> Surface:
    """The surface of a file that another package has read."""
    raw = _Surface(surface_array("heights", found.heights), *found.spacing, None, found.unit, found.doubts)
    return Surface._of(raw, found.is_periodic)


#: Lengths and numbers that describe a random surface, with their units.
_OPTIONS = {
    "length_x": "m",
    "length_y": "m",
    "hurst": "1",
    "roll_off": "m",
    "shortest": "m",
    "longest": "m",
    "skewness": "1",
    "kurtosis": "1",
}
_CORRELATED = ("length_x", "length_y")
#: Those of one kind alone.
_OF_KIND = {
    "gaussian": _CORRELATED,
    "exponential": _CORRELATED,
    "self_affine": ("hurst", "roll_off", "shortest", "longest", "synthesis"),
}
#: Options that are words.
_WORDS = ("synthesis", "height", "boundary")
_MOMENTS = ("skewness", "kurtosis")
_CELLS = "cells"
_LARGEST_SEED = 2**64 - 1


def generate(
    grid: Grid,
    rq: Quantity,
    *,
    kind: Literal["gaussian", "exponential", "self_affine"] = "gaussian",
    seed: int = 0,
    **options: Any,
) -> Field:
    """A random surface [m] on ``grid`` with the root mean square height ``rq`` [m].

    The options are the keys of a roughness table in a scene, and give its surface to the last bit. Of ``gaussian`` and ``exponential``:
    ``length_x``, ``length_y``, where the autocorrelation is 10 % [m] (``length`` for both). Of ``self_affine``: ``hurst``,
    ``roll_off``, ``shortest`` and ``longest`` [m], ``synthesis`` ("filtered_noise" or "random_phase"). Of all: ``skewness`` and
    ``kurtosis``, both or none, ``boundary`` ("periodic" or "open") and ``height`` ("exact": this very surface has ``rq``; "ensemble": the
    mean over seeds), or ``exact_rq`` (True or False) in its place, and ``cells``, the numbers along x and y on which the heights are drawn, so that all
    grids of one box have one surface.

    Raises :class:`~stribeck.InputError` with the option in ``field``.
    """
    length = options.pop("length", None)
    if length is not None:
        options = {"length_x": length, "length_y": length, **options}
    taken: dict[str, Any] = {}
    if None not in (options.get("exact_rq"), options.get("height")):
        value = options["exact_rq"]
        raise InputError(f"exact_rq = {value!r}: stands in place of height, give one of them", field="exact_rq", value=value)
    for name, value in options.items():
        if name in _OPTIONS:
            taken[name] = optional_number(f"roughness.{name}", value, _OPTIONS[name])
        elif name == "exact_rq":
            taken["height"] = "exact" if truth(name, value) else "ensemble"
        elif name in _WORDS:
            taken[name] = text(name, value)
        elif name == _CELLS:
            taken[name] = None if value is None else wholes(f"roughness.{name}", value, 2)
        else:
            raise unknown("option", name, [*_OPTIONS, *_WORDS, _CELLS, "length", "exact_rq"])
    taken = {name: value for name, value in taken.items() if value is not None}
    _belonging(text("kind", kind), taken)
    keys = {"kind": kind, "rq": number("roughness.rq", rq, "m"), "seed": _seed(seed), **taken}
    return _generate(cells(grid), keys)


def _seed(seed: int) -> int | str:
    """A seed as tables hold it: numbers beyond the integers of TOML are text."""
    found = whole("seed", seed, most=_LARGEST_SEED)
    return found if found < 2**63 else str(found)


def _belonging(kind: str, options: dict[str, Any]) -> None:
    """Refuses an option of another kind, and one of two moments without the other."""
    own = _OF_KIND.get(kind)
    if own is None:
        raise InputError(f"kind = {kind!r}: must be {', '.join(_OF_KIND)}", field="kind", value=kind)
    for name, value in options.items():
        if name not in own and any(name in other for other in _OF_KIND.values()):
            message = f"{name} = {value!r}: a {kind} surface has no such option, but {', '.join(own)}"
            raise InputError(message, field=name, value=value)
    for name, other in (_MOMENTS, _MOMENTS[::-1]):
        if name in options and other not in options:
            raise InputError(f"{name} = {options[name]!r}: only together with {other}", field=name, value=options[name])


def dimples(grid: Grid, *, radius: Quantity, depth: Quantity, pitch: Quantity, seed: int | None = None) -> Field:
    """Round dimples [m]: on a square lattice, or with a ``seed`` at random within its squares."""
    layout = {"layout": "square"} if seed is None else {"layout": "random", "seed": _seed(seed)}
    return _generate(cells(grid), {"kind": "dimples", **_sizes(radius=radius, depth=depth, pitch=pitch), **layout})


def grooves(
    grid: Grid, *, width: Quantity, depth: Quantity, pitch: Quantity, direction: Literal["x", "y", "crossed"] = "y"
) -> Field:
    """Straight grooves [m] along x, along y or both."""
    if text("direction", direction) not in ("x", "y", "crossed"):
        raise InputError(f"direction = {direction!r}: must be x, y or crossed", field="direction", value=direction)
    along = direction if direction == "crossed" else f"along_{direction}"
    return _generate(cells(grid), {"kind": "grooves", **_sizes(width=width, depth=depth, pitch=pitch), "direction": along})


def _sizes(**sizes: Quantity) -> dict[str, float]:
    return {name: number(name, size, "m") for name, size in sizes.items()}
