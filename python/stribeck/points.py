"""The points of a sweep."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from ._numbers import flat, frame, same, unit
from ._packages import needed
from ._typed import SolvedContact
from .errors import StribeckWarning, found, unknown

__all__ = ["Point", "Sweep"]


class Point(SolvedContact):
    """One point of a sweep: the numbers of its solution by their names, empty where it was refused. ``inputs`` are its values in SI units by
    their keys, ``status`` that of the solve (``"refused"`` for one that raised, ``"lost"`` where the executor failed), ``error`` the exception,
    ``warnings`` those of the solution and ``measured`` the values of the measure."""

    __slots__ = ("error", "inputs", "measured", "warnings")

    error: str | None
    inputs: dict[str, Any]
    measured: Any
    warnings: list[StribeckWarning]

    def __init__(self, inputs: Mapping[str, Any], result: Mapping[str, Any]) -> None:
        super().__init__({**result["values"], "status": result["status"]})
        parts = {"inputs": dict(inputs), "error": result["error"], "measured": result["measured"]}
        for name, value in {**parts, "warnings": found(result["warnings"])}.items():
            object.__setattr__(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        warnings = [
            {"field": w.field, "value": w.value, "message": w.message, "remedy": w.remedy} for w in self.warnings
        ]
        result = {"values": self.to_dict(), "status": self["status"], "error": self.error, "measured": self.measured}
        return type(self), (self.inputs, {**result, "warnings": warnings})

    def __eq__(self, other: object) -> bool:
        """Whether both are the same contact with the same numbers, whatever seconds it took."""
        if not isinstance(other, Point):
            return NotImplemented
        ours, theirs = ({name: value for name, value in point.items() if name != "seconds"} for point in (self, other))
        own = ("inputs", "error", "measured")
        return same(ours, theirs) and all(same(getattr(self, name), getattr(other, name)) for name in own)

    __hash__ = None  # type: ignore[assignment]

    def columns(self) -> dict[str, Any]:
        """Inputs, status, numbers and measured values by their full names."""
        measured = self.measured if isinstance(self.measured, dict) else {"measured": self.measured}
        outputs = {**flat(self), **{name: value for name, value in measured.items() if value is not None}}
        return {**outputs, "error": self.error, **{input_name(key): value for key, value in self.inputs.items()}}


def input_name(key: str) -> str:
    """The name of an input beside those of the outputs, which have a ``friction.coefficient`` too."""
    return f"scene.{key}" if key == "friction.coefficient" else key


class Sweep(Sequence[Point]):
    """The points of a sweep, in the order of their values. ``sweep["film.central"]`` is a number of all points, NaN where it is missing,
    ``sweep["motion.entrainment_speed"]`` one of the inputs."""

    def __init__(self, points: Sequence[Point], axes: Mapping[str, Sequence[Any]], is_product: bool) -> None:
        self._points, self._is_product = list(points), is_product
        #: Values of the inputs in SI units by their keys.
        self.axes: dict[str, list[Any]] = {input_name(key): list(values) for key, values in axes.items()}

    def __len__(self) -> int:
        return len(self._points)

    @overload
    def __getitem__(self, key: int) -> Point: ...
    @overload
    def __getitem__(self, key: slice) -> list[Point]: ...
    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]: ...
    def __getitem__(self, key: int | slice | str) -> Any:
        if not isinstance(key, str):
            return self._points[key]
        columns = self.to_dict()
        if key not in columns:
            raise unknown("name", key, columns)
        return columns[key]

    def __iter__(self) -> Iterator[Point]:
        return iter(self._points)

    def __eq__(self, other: object) -> bool:
        """Whether both have the same points over the same values."""
        if not isinstance(other, Sweep):
            return NotImplemented
        return self._is_product == other._is_product and same(self.axes, other.axes) and self._points == other._points

    __hash__ = None  # type: ignore[assignment]

    @property
    def failed(self) -> list[Point]:
        """The points without a converged solution or with an error."""
        return [point for point in self._points if point["status"] != "converged" or point.error is not None]

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Columns by name, the inputs first."""
        rows = [point.columns() for point in self._points]
        names = dict.fromkeys([*self.axes, "status", *(name for row in rows for name in row)])
        return {name: _column([row.get(name) for row in rows]) for name in names}

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``, a row a point; ``attrs["units"]`` are the units of its columns."""
        return frame(self.to_dict())

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset``: a dimension an input of a product, ``point`` for zipped ones, with units as attributes."""
        columns = self.to_dict()
        shape = tuple(len(values) for values in self.axes.values()) if self._is_product else (len(self),)
        dimensions = list(self.axes) if self._is_product else ["point"]
        variables = {
            name: (dimensions, values.reshape(shape), {"units": unit(name)})
            for name, values in columns.items()
            if name not in self.axes
        }
        across = {key: ([key] if self._is_product else ["point"], values, {"units": unit(key)}) for key, values in self.axes.items()}
        return needed("xarray", "to_xarray()").Dataset(variables, coords=across)

    def __repr__(self) -> str:
        return f"<Sweep of {len(self)} points over {', '.join(self.axes)}, {len(self.failed)} failed>"


def _column(values: list[Any]) -> npt.NDArray[Any]:
    if any(isinstance(value, str) for value in values):
        return np.array(["" if value is None else str(value) for value in values])
    if all(value is None or isinstance(value, bool | int | float) for value in values):
        return np.array([math.nan if value is None else value for value in values], dtype=np.float64)
    return np.array(values, dtype=object)
