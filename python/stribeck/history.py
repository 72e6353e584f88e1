"""Histories: contacts that change as they rub."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from ._numbers import Numbers, table
from ._stribeck import BodyStart as _BodyStart, Simulation as _Simulation
from .errors import InputError, StribeckWarning, found, function, number, say
from .scene import Grid, Scene, _SceneGrid, as_scene
from .solution import Heights, Solution, _array, _optional, parts, with_solver

__all__ = ["Body", "BodyStart", "History", "Record", "Simulation"]

_TEXTS = {"solver": "U32", "status": "U16"}
_WHOLES = {"step", "attempts", "iterations", "inner_iterations"}
_SHOWN = ("step", "time", "lambda", "area_ratio", "load_ratio", "friction_coefficient", "mean_wear_disc", "mean_film_disc")


class Record(Numbers):
    """The numbers of one step, all SI: ``time``, ``load_ratio``, ``lambda_``, ``friction_coefficient``, ``mean_wear_disc`` and so on, as in
    the columns of a history file. What is not modelled is NaN."""

    __slots__ = ()


class Body(Numbers):
    """One body: ``initial``, ``surface``, ``wear``, ``plastic_depth`` and ``tribofilm`` of the shape ``(ny, nx)`` and ``worn_profile``, the worn
    depth across the track, of the shape ``(ny,)`` [m]. At every node ``surface = initial - wear - plastic_depth + tribofilm``."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"<Body of {self['surface'].shape[1]} x {self['surface'].shape[0]} nodes: {', '.join(self)}>"


class History(Sequence[Record]):
    """The records of a run. ``history["load_ratio"]`` is a column, ``history[-1]`` the last record, ``history.to_numpy()`` a structured array."""

    def __init__(self, records: Sequence[Record] = (), stopped: bool = False) -> None:
        self._records = list(records)
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
            return np.array([record[key] for record in self._records])
        if isinstance(key, slice):
            return History(self._records[key], self.stopped)
        return self._records[key]

    def __iter__(self) -> Iterator[Record]:
        return iter(self._records)

    def append(self, record: Record) -> None:
        """Adds a record."""
        self._records.append(record)

    def to_numpy(self) -> npt.NDArray[np.void]:
        """A structured array, a field for each name of a record, of the shape ``(steps,)``; ``pandas.DataFrame`` takes it."""
        if not self._records:
            return np.empty(0, dtype=[("step", np.int64)])
        names = list(self._records[0])
        kinds = [(name, _TEXTS.get(name, np.int64 if name in _WHOLES else np.float64)) for name in names]
        return np.array([tuple(record[name] for name in names) for record in self._records], dtype=kinds)

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Columns by name."""
        rows = self.to_numpy()
        return {name: rows[name] for name in rows.dtype.names or ()}

    def __repr__(self) -> str:
        if not self._records:
            return "<History without steps>"
        last = self._records[-1]
        return f"<History of {len(self)} steps until {last['time']:g} s, load ratio {last['load_ratio']:.4g}>"

    def _repr_html_(self) -> str:
        rows = self._records if len(self) <= 20 else [*self._records[:10], *self._records[-10:]]
        return table(([f"{record[name]:.5g}" for name in _SHOWN] for record in rows), _SHOWN)


def BodyStart(  # noqa: N802
    scene: Scene,
    heights: npt.ArrayLike,
    *,
    wear: npt.ArrayLike | None = None,
    plastic_depth: npt.ArrayLike | None = None,
    tribofilm: npt.ArrayLike | None = None,
) -> _BodyStart:
    """A body with a past on the grid of ``scene``: heights of the new body, worn and plastic depth and tribofilm, each of the shape
    ``(ny, nx)`` [m]."""
    return _BodyStart(
        scene._raw,
        _array("heights", heights),
        _optional("wear", wear),
        _optional("plastic_depth", plastic_depth),
        _optional("tribofilm", tribofilm),
    )


class Simulation:
    """A contact whose surfaces flatten, grow a tribofilm and wear as they rub.

    ``heights``, ``bodies``, ``friction``, ``deformation``, ``viscosity``, ``density``, ``plasticity`` and ``solver`` are as in :func:`stribeck.solve`. ``growth``, ``wear`` and
    ``motion``, that of the roughness from step to step, are laws in Python in place of those of the scene (:mod:`stribeck.laws`). ``squeeze`` makes the history transient: it is for roughness that moves by less than a cell a step.

    A step that fails leaves the simulation as before. Ctrl-C ends a step, within its solve too, and leaves the simulation as before the step.
    """

    def __init__(
        self,
        scene: Scene | Mapping[str, Any] | str | os.PathLike[str],
        *,
        heights: Heights = None,
        bodies: tuple[_BodyStart | None, _BodyStart | None] | None = None,
        growth: Any = None,
        wear: Any = None,
        friction: Any = None,
        deformation: Any = None,
        viscosity: Any = None,
        density: Any = None,
        plasticity: Any = None,
        motion: Any = None,
        solver: Any = None,
        squeeze: bool = False,
    ) -> None:
        self._scene = with_solver(as_scene(scene), solver)
        laws = {
            "growth": growth,
            "wear": wear,
            "friction": friction,
            "deformation": deformation,
            "viscosity": viscosity,
            "density": density,
            "plasticity": plasticity,
            "motion": motion,
            "solver": solver,
        }
        self._raw = _Simulation(self._scene._raw, parts(heights, bodies, laws), squeeze)
        say(self.warnings, 2)

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self._scene

    @property
    def time(self) -> float:
        """Time that has passed [s]."""
        return self._raw.time

    @property
    def steps(self) -> int:
        """Steps that were taken, those before a checkpoint included."""
        return self._raw.steps

    @property
    def warnings(self) -> list[StribeckWarning]:
        """What is unlikely to be meant or to hold, of the scene, its surfaces and, after the first step, its contact."""
        return found(self._raw.warnings())

    @property
    def history(self) -> History:
        """The records of all steps since the start, or since the checkpoint that was restored."""
        return History([Record(numbers) for numbers in self._raw.records(0)])

    @property
    def grid(self) -> Grid:
        """The cells of the contact and of both bodies."""
        return _SceneGrid(self._raw.grid())

    @property
    def conditions(self) -> Numbers:
        """What acts on the contact now: ``load`` [N], ``entrainment_speed`` [m/s], ``slide_roll_ratio``, ``bulk_temperature`` [K]."""
        return Numbers(self._raw.about()["conditions"])

    @property
    def motion(self) -> str:
        """How the roughness moves from step to step, in words."""
        return str(self._raw.about()["motion"])

    @property
    def ledger_residual(self) -> float:
        """Largest difference between a surface and ``initial - wear - plastic_depth + tribofilm`` [m]."""
        return float(self._raw.about()["ledger_residual"])

    @property
    def bodies(self) -> tuple[Body, Body]:
        """Ball and disc, as copies."""
        ball, disc = self._raw.bodies()
        return Body(ball), Body(disc)

    @property
    def fields(self) -> dict[str, npt.NDArray[Any]]:
        """Maps of the last contact by name, of the shape ``(ny, nx)``, as copies: see :class:`stribeck.Solution`."""
        return self._raw.fields()

    def starts(self) -> tuple[_BodyStart, _BodyStart]:
        """Ball and disc as they stand, as ``bodies`` of another run or solve."""
        ball, disc = self._raw.starts()
        return ball, disc

    def step(self, time_step: float, *, depth: float = math.inf) -> Record:
        """Takes one step of ``time_step`` [s], shorter where a node would wear or grow by more than ``depth`` [m]."""
        return Record(self._raw.step(number("time_step", time_step, "s"), number("step.depth", depth, "m")))

    def run(
        self,
        steps: int,
        time_step: float,
        *,
        depth: float = math.inf,
        callback: Callable[[Simulation, Record], object] | None = None,
    ) -> History:
        """Takes ``steps`` steps. ``callback(simulation, record)`` sees each and ends the run by returning True or raising StopIteration."""
        if isinstance(steps, bool) or not hasattr(steps, "__index__") or operator.index(steps) < 0:
            raise InputError(f"steps = {steps!r}: must be a whole number from 0", field="steps", value=steps)
        function("callback", callback)
        history = History()
        for _ in range(operator.index(steps)):
            if self._seen(history, self.step(time_step, depth=depth), callback):
                break
        return history

    def run_until(
        self,
        end: float,
        time_step: float,
        *,
        depth: float = math.inf,
        callback: Callable[[Simulation, Record], object] | None = None,
    ) -> History:
        """Steps until the time ``end`` [s], none longer than ``time_step`` or across an entry of the scene's schedule."""
        function("callback", callback)
        end, time_step, depth = number("end", end, "s"), number("time_step", time_step, "s"), number("step.depth", depth, "m")
        history = History()
        while (numbers := self._raw.step_towards(end, time_step, depth)) is not None:
            if self._seen(history, Record(numbers), callback):
                break
        return history

    def _seen(self, history: History, record: Record, callback: Any) -> bool:
        history.append(record)
        if callback is not None:
            try:
                history.stopped = callback(self, record) is True
            except StopIteration:
                history.stopped = True
        return history.stopped

    def solve_under(
        self,
        *,
        load: float | None = None,
        entrainment_speed: float | None = None,
        slide_roll_ratio: float | None = None,
        bulk_temperature: float | None = None,
    ) -> Solution:
        """Solves the contact of the bodies as they stand under other conditions; nothing is changed by it."""
        given = {
            "load": (load, "N"),
            "entrainment_speed": (entrainment_speed, "m/s"),
            "slide_roll_ratio": (slide_roll_ratio, "1"),
            "bulk_temperature": (bulk_temperature, "K"),
        }
        numbers = [None if value is None else number(name, value, unit) for name, (value, unit) in given.items()]
        return Solution(*self._raw.solve_under(*numbers))

    def mean_on_track(self, field: npt.NDArray[np.float64]) -> float:
        """Mean of a field of a body over the width of the track."""
        return self._raw.mean_on_track(np.ascontiguousarray(field, dtype=np.float64))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a checkpoint: a simulation of the same scene and laws that restores it goes on as this one, to the last bit."""
        self._raw.save(os.fspath(path))

    def restore(self, path: str | os.PathLike[str]) -> None:
        """Takes over a checkpoint. Raises :class:`~stribeck.CheckpointError` where it is damaged or of another simulation."""
        self._raw.restore(os.fspath(path))

    def restore_under_other_conditions(self, path: str | os.PathLike[str]) -> list[str]:
        """Takes over a checkpoint of a scene whose load, speeds, oil, friction, temperatures, schedule or solver differ, and returns what
        does."""
        return self._raw.restore_under_other_conditions(os.fspath(path))

    def fork(self) -> Simulation:
        """A simulation of its own that stands where this one does."""
        fork = object.__new__(type(self))
        fork._scene, fork._raw = self._scene, self._raw.fork()
        return fork

    def __copy__(self) -> Simulation:
        return self.fork()

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulation:
        return self.fork()

    def __reduce__(self) -> Any:
        raise TypeError("a simulation cannot be pickled: save() writes a checkpoint, which runs no code when it is read")

    def __repr__(self) -> str:
        return f"<Simulation after {self.steps} steps, {self.time:g} s>"
