"""Surfaces: measured ones and their preparation, generated ones. Heights are in metres and point out of the body; arrays have the shape
``(ny, nx)``, x along the flow. Lengths are numbers in metres, or text with a unit."""

from __future__ import annotations

import os
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, array, cells, heights as as_heights, mask, number, optional_number, path as _path, text, truth, whole, wholes
from ._stribeck import Surface as _Surface, generate as _generate, texture as _texture
from .errors import InputError, unknown
from .scene import Grid

__all__ = ["Surface", "dimples", "generate", "grooves", "read"]

Boundary = Literal["periodic", "open"]
Field = npt.NDArray[np.float64]


class Surface:
    """A measured surface. Every step of a preparation gives a new one, so that steps can be chained:
    ``read(path).fill_undefined().remove_plane().s_filter(2e-6)``."""

    __slots__ = ("_raw",)

    def __init__(
        self,
        heights: npt.ArrayLike,
        dx: Quantity | None = None,
        dy: Quantity | None = None,
        defined: npt.ArrayLike | None = None,
    ) -> None:
        """Heights [m] of the shape ``(ny, nx)``, spacing [m] and which points are defined; ``dy`` is ``dx`` unless given."""
        known = None if defined is None else mask("defined", defined)
        spacing = optional_number("dx", dx, "m"), optional_number("dy", dy, "m")
        points = as_heights("heights", heights) if known is None else array("heights", heights)
        self._raw = _Surface(points, *spacing, known)

    @classmethod
    def _of(cls, raw: Any) -> Surface:
        surface = cls.__new__(cls)
        surface._raw = raw
        return surface

    def __reduce__(self) -> tuple[Any, ...]:
        return Surface, (self.heights, self.dx, self.dy, self._raw.defined)

    @property
    def heights(self) -> Field:
        """Heights [m], shape ``(ny, nx)``, a copy; zero where undefined."""
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

    def __repr__(self) -> str:
        spacing = "unknown spacing" if self.dx is None or self.dy is None else f"{self.dx * 1e6:g} x {self.dy * 1e6:g} um apart"
        return f"<Surface of {self.shape[1]} x {self.shape[0]} points, {spacing}, {self.undefined} undefined>"


def read(path: str | os.PathLike[str]) -> Surface:
    """Reads a file of an instrument: x3p, sur, sdf, plu, al3d, npy or text. Raises :class:`~stribeck.SurfaceError` or
    :class:`~stribeck.FileError`, whose ``value`` is the path."""
    return Surface._of(_Surface.read(_path("path", path)))


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
    "self_affine": ("hurst", "roll_off", "shortest", "longest"),
}
_MOMENTS = ("skewness", "kurtosis")
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

    Options of ``gaussian`` and ``exponential``: ``length_x``, ``length_y``, where the autocorrelation is 10 % [m] (``length`` for both). Of
    ``self_affine``: ``hurst``, ``roll_off``, ``shortest`` and ``longest`` [m]. Of all: ``skewness`` and ``kurtosis``, both or none,
    ``boundary`` ("periodic" or "open") and ``exact_rq`` (True: this very surface has ``rq``; False: the mean over seeds).

    Raises :class:`~stribeck.InputError` with the option in ``field``.
    """
    length = options.pop("length", None)
    if length is not None:
        options = {"length_x": length, "length_y": length, **options}
    taken: dict[str, Any] = {}
    for name, value in options.items():
        if name in _OPTIONS:
            taken[name] = optional_number(f"roughness.{name}", value, _OPTIONS[name])
        elif name == "exact_rq":
            taken[name] = truth(name, value)
        elif name == "boundary":
            taken[name] = text(name, value)
        else:
            raise unknown("option", name, [*_OPTIONS, "length", "boundary", "exact_rq"])
    _belonging(text("kind", kind), {name: value for name, value in taken.items() if value is not None})
    heights = number("roughness.rq", rq, "m")
    return _generate(cells(grid), kind, heights, whole("seed", seed, most=_LARGEST_SEED), taken)


def _belonging(kind: str, options: dict[str, Any]) -> None:
    """Refuses an option of another kind, and one of two moments without the other."""
    own = _OF_KIND.get(kind)
    if own is None:
        return
    for name, value in options.items():
        if name not in own and any(name in other for other in _OF_KIND.values()):
            message = f"{name} = {value!r}: a {kind} surface has no such option, but {', '.join(own)}"
            raise InputError(message, field=name, value=value)
    for name, other in (_MOMENTS, _MOMENTS[::-1]):
        if name in options and other not in options:
            raise InputError(f"{name} = {options[name]!r}: only together with {other}", field=name, value=options[name])


def dimples(grid: Grid, *, radius: Quantity, depth: Quantity, pitch: Quantity, seed: int | None = None) -> Field:
    """Round dimples [m]: on a square lattice, or with a ``seed`` at random within its squares."""
    layout = "square" if seed is None else "random"
    start = 0 if seed is None else whole("seed", seed, most=_LARGEST_SEED)
    return _texture(cells(grid), "dimples", _sizes(radius=radius, depth=depth, pitch=pitch), layout, start)


def grooves(
    grid: Grid, *, width: Quantity, depth: Quantity, pitch: Quantity, direction: Literal["x", "y", "crossed"] = "y"
) -> Field:
    """Straight grooves [m] along x, along y or both."""
    sizes = _sizes(width=width, depth=depth, pitch=pitch)
    return _texture(cells(grid), "grooves", sizes, text("direction", direction), 0)


def _sizes(**sizes: Quantity) -> list[float]:
    return [number(name, size, "m") for name, size in sizes.items()]
