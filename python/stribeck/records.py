"""Records of the steps of a history, and its bodies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar, overload

import numpy as np
import numpy.typing as npt

from ._numbers import COLUMNS, Numbers, frame, table, unit
from ._packages import needed
from ._typed import Contact, Errors, Film, Flow, Friction, Motion, Plastic, Pressure, Residual, Roughness, Thermal, Tribofilm, Wear, Work
from .errors import StribeckWarning, found, unknown

__all__ = ["Body", "History", "Record"]

_TEXTS = {"solver": "U32", "status": "U16"}
_WHOLES = {"step", "attempts", "work.iterations", "work.inner_iterations"}
_SHOWN = (
    "step",
    "time",
    "film.lambda",
    "contact.area_ratio",
    "contact.load_ratio",
    "friction.coefficient",
    "wear.disc_mean",
    "tribofilm.disc_mean",
)


class Record(Numbers):
    """The numbers of one step, all SI, under the names of a solution: ``time``, ``contact.load_ratio``, ``film.lambda_``,
    ``friction.coefficient``, ``wear.disc_mean`` and so on. Values that are not modelled are None. ``warnings`` lists
    the warnings that this step has raised; no later step repeats them."""

    __slots__ = ("warnings",)

    step: int
    time: float
    time_step: float
    load: float
    motion: Motion
    bulk_temperature: float
    roughness: Roughness
    film: Film
    pressure: Pressure
    contact: Contact
    friction: Friction
    flow: Flow | None
    thermal: Thermal | None
    flash_rise: float | None
    wear: Wear
    tribofilm: Tribofilm
    plastic: Plastic
    attempts: int
    solver: str
    status: str
    residual: Residual
    energy_error: float | None
    work: Work
    strategy: str | None
    error_estimate: Errors | None
    warnings: list[StribeckWarning]

    def __init__(self, values: Mapping[str, Any], warnings: Sequence[StribeckWarning] = ()) -> None:
        super().__init__(values)
        object.__setattr__(self, "warnings", list(warnings))

    @classmethod
    def _of(cls, raw: tuple[dict[str, Any], list[dict[str, Any]]]) -> Record:
        numbers, warnings = raw
        return cls(numbers, found(warnings))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(), self.warnings)

    def column(self, name: str) -> Any:
        """The value of the column ``name``, as ``"film.mean_central"``; NaN where it is not modelled."""
        if name not in COLUMNS:
            raise unknown("name", name, COLUMNS)
        value: Any = self
        for part in name.split("."):
            value = None if value is None else value[part]
        return math.nan if value is None else value


class Body(Numbers):
    """One body: ``initial``, ``surface``, ``wear``, ``plastic_depth`` and ``tribofilm`` of the shape ``(ny, nx)`` and
    ``worn_profile``, the worn depth across the track, of the shape ``(ny,)`` [m]. At every node ``surface = initial - wear - plastic_depth + tribofilm``."""

    __slots__ = ()

    initial: npt.NDArray[np.float64]
    surface: npt.NDArray[np.float64]
    wear: npt.NDArray[np.float64]
    plastic_depth: npt.NDArray[np.float64]
    tribofilm: npt.NDArray[np.float64]
    worn_profile: npt.NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<Body of {self['surface'].shape[1]} x {self['surface'].shape[0]} nodes: {', '.join(self)}>"


class History(Sequence[Record]):
    """The records of a run. ``history["contact.load_ratio"]`` is a column, ``history[-1]`` the last record, ``history.to_numpy()``
    a structured array."""

    #: Names of the columns and their units, empty for ratios, counts and words.
    columns: ClassVar[dict[str, str]] = COLUMNS

    def __init__(self, records: Sequence[Record] = (), stopped: bool = False) -> None:
        self._records = list(records)
        self._columns: dict[str, tuple[npt.NDArray[Any], int]] = {}
        #: Whether the callback ended the run.
        self.stopped = stopped

    def __len__(self) -> int:
        return len(self._records)

    @overload
    def __getitem__(self, key: int) -> Record: ...
    @overload
    def __getitem__(self, key: slice) -> History: ...
    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]: ...
    def __getitem__(self, key: int | slice | str) -> Any:
        if isinstance(key, str):
            return self._column(key)
        if isinstance(key, slice):
            return History(self._records[key], self.stopped)
        return self._records[key]

    def _column(self, name: str) -> npt.NDArray[Any]:
        """The values of a column, of which only those of new records are looked up."""
        if name not in COLUMNS:
            raise unknown("name", name, COLUMNS)
        kind = _TEXTS.get(name, np.int64 if name in _WHOLES else np.float64)
        values, known = self._columns.get(name, (np.empty(0, kind), 0))
        count = len(self._records)
        if count > len(values):
            values = np.concatenate([values[:known], np.empty(max(count, 2 * known) - known, kind)])
        for place in range(known, count):
            values[place] = self._records[place].column(name)
        self._columns[name] = values, count
        return values[:count].copy()

    def __iter__(self) -> Iterator[Record]:
        return iter(self._records)

    def __contains__(self, item: object) -> bool:
        """Whether ``item`` is the name of a column, or one of the records."""
        return item in COLUMNS if isinstance(item, str) else item in self._records

    def __eq__(self, other: object) -> bool:
        """Whether both have the same records and ended alike."""
        if not isinstance(other, History):
            return NotImplemented
        return self._records == other._records and self.stopped == other.stopped

    __hash__ = None  # type: ignore[assignment]

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return np.asarray(self.to_numpy(), dtype=dtype)

    def append(self, record: Record) -> None:
        """Adds a record."""
        self._records.append(record)

    def to_numpy(self) -> npt.NDArray[np.void]:
        """A structured array of the shape ``(steps,)``, a field for each column: ``array["film.mean_central"]``; values that are not
        modelled are NaN. ``pandas.DataFrame`` takes it."""
        kinds = [(name, _TEXTS.get(name, np.int64 if name in _WHOLES else np.float64)) for name in COLUMNS]
        return np.array([tuple(record.column(name) for name in COLUMNS) for record in self._records], dtype=kinds)

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Columns by name."""
        rows = self.to_numpy()
        return {name: rows[name] for name in rows.dtype.names or ()}

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``, a row a step; ``attrs["units"]`` are the units of its columns."""
        return frame(self.to_dict())

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over the steps, with ``time`` [s] as a coordinate and units as attributes."""
        columns = {name: ("step", values, {"units": unit(name)}) for name, values in self.to_dict().items()}
        return needed("xarray", "to_xarray()").Dataset(columns).set_coords(["step", "time"])

    def __repr__(self) -> str:
        if not self._records:
            return "<History without steps>"
        last = self._records[-1]
        return f"<History of {len(self)} steps until {last['time']:g} s, load ratio {last['contact']['load_ratio']:.4g}>"

    def _repr_html_(self) -> str:
        rows = self._records if len(self) <= 20 else [*self._records[:10], *self._records[-10:]]
        return table(([f"{record.column(name):.5g}" for name in _SHOWN] for record in rows), _SHOWN)
