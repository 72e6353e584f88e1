"""A contact over a cycle of load, speeds, radius and temperature."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._numbers import frame
from ._stribeck import solve_cycle
from .errors import StribeckWarning, found, say, unknown
from .scene import Scene, as_scene

__all__ = ["Cycle", "cycle"]

#: Units of the numbers of a contact by their names; ratios and counts have none.
UNITS = {
    "time": "s",
    "angle": "rad",
    "load": "N",
    "ball_speed": "m/s",
    "disc_speed": "m/s",
    "radius": "m",
    "bulk_temperature": "K",
    "hertz_pressure": "Pa",
    "formula_film": "m",
    "film_central": "m",
    "film_minimum": "m",
    "film_mean_central": "m",
    "pressure_max": "Pa",
    "friction_power": "W",
    "flash_rise": "K",
}


class Cycle:
    """The contacts of a cycle in the order of time. ``cycle["film_central"]`` is a number of all contacts as an array, NaN where it is
    unknown; the names are those of ``cycle.columns``: ``time`` [s], ``angle`` [rad], ``load`` [N], ``ball_speed`` and ``disc_speed`` [m/s],
    ``radius`` [m], ``bulk_temperature`` [K], ``hertz_pressure`` [Pa], ``formula_film`` [m], ``film_central``, ``film_minimum`` and
    ``film_mean_central`` [m], ``pressure_max`` [Pa], ``contact_load_ratio``, ``friction_coefficient``, ``friction_power`` [W],
    ``flash_rise`` [K], ``squeeze_ratio``, ``wear_ball_volume`` and ``wear_disc_volume`` [m^3], ``residual_load``, ``iterations``; those of a line contact are per metre.

    ``quasi_static`` says whether the contacts are steady ones, ``largest_step`` is the largest way of the entrained film in a step, in
    half-widths, ``closure`` the relative difference of the last central film from that one cycle before, ``ended_early`` the reason for
    an early end, or None. With ``cycle.repeat`` the contacts are those of the last cycle, and ``history`` has an array for each of
    ``cycles`` (up to the end of a solved one), ``film_minimum`` [m], ``pressure_max`` [Pa], ``contact_load_ratio``,
    ``friction_coefficient``, ``wear_ball_volume``, ``wear_disc_volume`` [m^3], ``wear_ball_max``, ``wear_disc_max``,
    ``tribofilm_ball_max`` and ``tribofilm_disc_max`` [m]; it is empty without."""

    __slots__ = ("_columns", "closure", "ended_early", "history", "largest_step", "quasi_static")

    quasi_static: bool
    largest_step: float
    closure: float
    ended_early: str | None
    history: dict[str, npt.NDArray[np.float64]]

    def __init__(self, points: Sequence[Mapping[str, Any]], of_all: Mapping[str, Any]) -> None:
        names = list(points[0]) if points else []
        self._columns = {name: np.array([point[name] for point in points], dtype=float) for name in names}
        self.quasi_static, self.largest_step = of_all["quasi_static"], of_all["largest_step"]
        self.closure, self.ended_early = of_all["closure"], of_all["ended_early"]
        cycles = of_all["cycles"]
        names = list(cycles[0]) if cycles else []
        self.history = {name: np.array([cycle[name] for cycle in cycles], dtype=float) for name in names}

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the numbers of a contact."""
        return tuple(self._columns)

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        if name not in self._columns:
            raise unknown("name", name, self._columns)
        return self._columns[name]

    def __len__(self) -> int:
        return len(self._columns["time"]) if self._columns else 0

    def __repr__(self) -> str:
        return f"<Cycle of {len(self)} contacts>"

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row per contact; ``attrs["units"]`` are the units of its columns."""
        return frame(self._columns, UNITS)


def cycle(scene: Scene | Mapping[str, Any] | str | os.PathLike[str]) -> Cycle:
    """Solves the contacts of a ``scene``, as :func:`~stribeck.solve` takes it, with a table ``cycle``; warnings are issued. A contact that does not converge ends the cycle with
    those before it: a warning, and the reason in ``ended_early``.

    Raises
    ------
    InputError
        For a table with rows that do not fit, with row, field and value.
    """
    points, (of_all, warnings) = solve_cycle(as_scene(scene)._raw)
    say(found(warnings), 2)
    if of_all["ended_early"] is not None:
        say([StribeckWarning("cycle", None, f"ended after {len(points)} contacts: {of_all['ended_early']}", "")], 2)
    return Cycle(points, of_all)
