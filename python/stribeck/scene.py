"""Scenes: everything that defines a contact."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, instance, number, numbers, path, text, truth, whole
from . import _tables
from ._numbers import Numbers
from ._stribeck import Cells, Scene as _Scene
from ._typed import Conditions, Expectation, Hertz, Oil
from .errors import SceneError, StribeckWarning, found, say

__all__ = ["Grid", "Scene"]


#: Positions of columns and rows [m].
Nodes = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]

#: A table, or the value of a key that is given by its path.
Value = Mapping[str, Any] | Sequence[Any] | float | str | None

#: Tables within each other that a scene never needs.
_MAX_DEPTH = 16


class Grid(Numbers):
    """Cells of a contact: counts ``nx``, ``ny``, sizes ``dx``, ``dy``, outer edges ``edges_x``, ``edges_y`` and positions of the nodes
    ``x``, ``y`` [m]. Fields have the shape ``(ny, nx)``; x is along the flow."""

    __slots__ = ("_exact", "_nodes")

    nx: int
    ny: int
    dx: float
    dy: float
    edges_x: tuple[float, float]
    edges_y: tuple[float, float]
    _exact: Cells | None
    _nodes: Nodes | None

    def __init__(self, values: Mapping[str, Any], nodes: Nodes | None = None) -> None:
        super().__init__(values)
        object.__setattr__(self, "_exact", None)
        object.__setattr__(self, "_nodes", nodes)

    @classmethod
    def _of(cls, exact: Cells) -> Grid:
        """The cells to the last bit: edges come back rounded."""
        grid = cls(exact.to_dict(), exact.nodes())
        object.__setattr__(grid, "_exact", exact)
        return grid

    @classmethod
    def box(cls, nx: int, ny: int, x: tuple[Quantity, Quantity], y: tuple[Quantity, Quantity]) -> Grid:
        """``nx`` x ``ny`` cells that fill the box between the edges ``x`` and ``y`` [m]."""
        edges = numbers("x", x, ("m", "m")), numbers("y", y, ("m", "m"))
        return cls._of(Cells((whole("ny", ny), whole("nx", nx)), *edges))

    @property
    def shape(self) -> tuple[int, int]:
        """``(ny, nx)``."""
        return self["ny"], self["nx"]

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """Positions of the columns, shape ``(nx,)`` [m]."""
        return self._positions()[0].copy()

    @property
    def y(self) -> npt.NDArray[np.float64]:
        """Positions of the rows, shape ``(ny,)`` [m]."""
        return self._positions()[1].copy()

    def _positions(self) -> Nodes:
        return self._cells.nodes() if self._nodes is None else self._nodes

    @property
    def _cells(self) -> Cells:
        return self._exact or Cells(self.shape, list(self["edges_x"]), list(self["edges_y"]))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(), self._nodes)


class Scene:
    """A contact in tables and keys as in a scene file (``docs/scene.md``), all SI.

    ``Scene(source)`` takes a dictionary, the text of a scene file, a path to one or another scene; ``Scene(form={...}, load={...},
    grid={...})`` takes tables by name. A string with a line break is text, and so is one with ``=`` unless it names a file. Both may
    be combined: tables by name come on top (see :meth:`replace`). Paths in a scene file are relative to its folder, in a dictionary
    or text to the working directory.

    A table and its values are attributes, ``scene.motion.entrainment_speed``; a table that the scene has not is an ``AttributeError``.

    Raises :class:`~stribeck.SceneError` naming the key that does not fit, :class:`~stribeck.FileError` for a file that cannot be read.
    Values out of range are found when the scene is used.
    """

    __slots__ = ("_raw",)

    form: _tables.Form
    load: _tables.Load
    motion: _tables.Motion
    elastic: _tables.Elastic
    materials: _tables.Materials
    roughness: _tables.Roughness
    lubricant: _tables.Lubricant
    plastic: _tables.Plastic
    friction: _tables.Friction
    thermal: _tables.Thermal
    tribofilm: _tables.Tribofilm
    wear: _tables.Wear
    track: _tables.Track
    schedule: _tables.Schedule
    cycle: _tables.Cycle
    stress: _tables.Stress
    bearing: _tables.Bearing
    solver: _tables.Solver

    def __init__(
        self,
        source: Scene | Mapping[str, Any] | str | os.PathLike[str] | None = None,
        /,
        **tables: Value,
    ) -> None:
        if source is None:
            self._raw = _of_tables(tables)
            return
        if isinstance(source, Scene):
            self._raw = source._raw
        elif isinstance(source, Mapping):
            self._raw = _of_tables(source)
        elif _is_text(source):
            self._raw = _Scene.from_toml(text("scene", source))
        else:
            instance("scene", source, (str, os.PathLike), "a path, a text, a dictionary or a scene")
            self._raw = _Scene.load(path("scene", source))
        if tables:
            self._raw = self.replace(**tables)._raw

    @classmethod
    def azam_2019(cls, n: int = 128, *, tribofilm: bool = False) -> Scene:
        """The scene of Azam et al. (2019): a steel ball on a rough disc in base oil at 80 C, on ``n`` x ``n`` cells."""
        return cls._of(_Scene.azam_2019(whole("n", n), truth("tribofilm", tribofilm)))

    @classmethod
    def _of(cls, raw: _Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._raw = raw
        return scene

    def replace(self, **tables: Value) -> Scene:
        """The same scene with other values: ``scene.replace(motion={"entrainment_speed": 0.2}, wear=None)``.

        Keys within a table are replaced one by one, and left out where the value is None. ``load``, ``grid``, a table with a ``kind`` and one
        with another ``law`` are replaced as a whole. A key may be given by its path: ``scene.replace(**{"motion.entrainment_speed": 0.2})``; one of
        ``grid`` then leaves the others as they are, one of ``load`` stands in place of the others.
        """
        merged = self.to_dict()
        for name, value in tables.items():
            whole_tables = ("load",) if "." in name else ("load", "grid")
            merged = _merged(merged, _nested(name, value), whole_tables)
        return type(self)(merged)

    def to_dict(self) -> dict[str, Any]:
        """The scene as tables and keys, defaults included."""
        return self._raw.to_dict()

    def to_toml(self) -> str:
        """The scene as the text of a scene file."""
        return self._raw.to_toml()

    @property
    def grid(self) -> Grid:
        """The cells of the contact."""
        return Grid._of(self._raw.grid())

    def hertz(self) -> Hertz:
        """The smooth dry contact: ``radius``, ``half_width_x``, ``half_width_y`` [m], ``pressure`` [Pa], ``force`` [N]."""
        return cast(Hertz, Numbers(self._raw.hertz()))

    def expectation(self) -> Expectation:
        """Estimates by formula, without solving: ``film.map.regime``, ``film.central`` [m] (smooth and flooded), ``film.lambda_``,
        ``film.load_ratio`` and ``film.load_ratio_range`` (share of the load on solids), ``film.friction`` (of solids and of the isothermal fluid),
        ``film.film_rise`` and ``flash_rise`` [K], ``roughness.composite_rq`` [m]. ``film`` is None for a dry contact; where no formula holds a number is None.
        Warnings about physics that the scene leaves out are issued.

        Raises
        ------
        SceneError
            For a scene that cannot be built.

        Examples
        --------
        >>> import stribeck
        >>> expected = stribeck.Scene.azam_2019(64).expectation()
        >>> expected.film and expected.film.map.regime
        'piezoviscous-elastic'
        """
        numbers, warnings = self._raw.expectation()
        say(found(warnings), 2)
        return cast(Expectation, Numbers(numbers))

    def oil(self) -> Oil | None:
        """The oil at the bulk temperature: ``eta0`` [Pa s] and ``alpha`` [1/Pa] with ``eta0_source`` and ``alpha_source``, the relative
        ``alpha_uncertainty`` of a correlated coefficient and the ``film_uncertainty`` by it. None for a dry contact.

        Examples
        --------
        >>> import stribeck
        >>> sheet = {"eta0": None, "roelands_z": None, "grade": "ISO VG 46", "viscosity_index": 95}
        >>> oil = stribeck.Scene.azam_2019(32).replace(lubricant=sheet, thermal={"bulk_temperature": "40 degC"}).oil()
        >>> oil and oil.alpha_source
        'So and Klaus 1980 for mineral oil'
        """
        oil = self._raw.oil()
        return None if oil is None else cast(Oil, Numbers(oil))

    def conditions(self, time: Quantity = 0.0) -> Conditions:
        """``load`` [N], ``motion.entrainment_speed`` [m/s], ``motion.slide_roll_ratio`` and ``bulk_temperature`` [K] at ``time`` [s]."""
        return cast(Conditions, Numbers(self._raw.conditions(number("time", time, "s"))))

    @property
    def warnings(self) -> list[StribeckWarning]:
        """Warnings that are known without solving."""
        return found(self._raw.warnings())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self._raw == other._raw

    def __hash__(self) -> int:
        return hash(self.to_toml())

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """A table of the scene by its name, ``scene.motion.entrainment_speed``."""
            if name.startswith("_"):
                raise AttributeError(name)
            return getattr(Numbers(self.to_dict()), name)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.to_dict()})

    def __repr__(self) -> str:
        return f"Scene({self.to_dict()!r})"

    def _repr_html_(self) -> str:
        return Numbers(self.to_dict())._repr_html_()

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(),)


def as_scene(source: Scene | Mapping[str, Any] | str | os.PathLike[str]) -> Scene:
    """The scene itself, or a new one from any argument of :class:`Scene`."""
    return source if isinstance(source, Scene) else Scene(source)


def _is_text(source: Any) -> bool:
    """Whether a string is the text of a scene file and not the path of one."""
    return isinstance(source, str) and ("\n" in source or ("=" in source and not os.path.exists(source)))


def _of_tables(tables: Mapping[str, Any]) -> _Scene:
    plain = _plain(tables)
    for key, table in plain.items():
        if isinstance(table, list | tuple | np.ndarray):
            raise SceneError(f"{key} = {table!r}: a list, expected a table", field=str(key), value=table)
    try:
        return _Scene.from_dict(plain)
    except SceneError as error:
        if error.value is None and error.field is not None:
            error.value = _at(plain, error.field)
            if error.value is not None:
                error.args = (f"{error.field} = {error.value!r}: {error}",)
        raise


def _at(tables: Any, key: str) -> Any:
    for part in key.split("."):
        if not isinstance(tables, dict):
            return None
        tables = tables.get(part)
    return tables


def _plain(tables: Mapping[str, Any], depth: int = 0) -> dict[str, Any]:
    if depth > _MAX_DEPTH:
        raise SceneError("scene: a dictionary contains itself", field="scene")
    return {k: _plain(v, depth + 1) if isinstance(v, Mapping) else v for k, v in tables.items()}


def _nested(path: str, value: Any) -> dict[str, Any]:
    """Tables that hold the value of the key with this path."""
    for part in reversed(path.split(".")):
        value = {part: value}
    nested: dict[str, Any] = value
    return nested


def _merged(base: dict[str, Any], changes: Mapping[str, Any], whole_tables: tuple[str, ...]) -> dict[str, Any]:
    merged = dict(base)
    for key, new in changes.items():
        old = merged.get(key)
        if not isinstance(new, Mapping):
            merged[key] = new
        elif not isinstance(old, dict) or "kind" in new or ("law" in new and new["law"] != old.get("law")) or key in whole_tables:
            merged[key] = _plain(new)
        else:
            merged[key] = _merged(old, new, ())
    return merged
