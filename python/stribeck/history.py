"""Histories: contacts that change as they rub."""

from __future__ import annotations

import logging
import math
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, array, function, named, number, optional_number, refused, truth, whole
from ._conditions import CONDITIONS, changed
from ._held import held
from ._numbers import Fields, Numbers
from ._stribeck import Simulation as _Simulation
from ._typed import Conditions
from .bodies import BodyStart
from .errors import InputError, StribeckWarning, found, say
from .kept import Kept
from .records import Body, History, Record
from .scene import Grid, Scene, as_scene
from .solution import Heights, Solution, first_state, named_parts, parts, with_solver

__all__ = ["Body", "History", "Record", "Simulation"]

_log = logging.getLogger("stribeck")


class Simulation(Kept):
    """A contact whose surfaces flatten, grow a tribofilm and wear as they rub.

    ``heights``, ``bodies``, ``friction``, ``deformation``, ``viscosity``, ``density``, ``plasticity`` and ``solver`` are as in
    :func:`stribeck.solve`, and so is ``start``, a first guess of the first contact. ``growth``, ``wear`` and ``motion``, that of
    the roughness from step to step, are laws in Python in place of those of the scene (:mod:`stribeck.laws`). ``squeeze`` makes
    the history transient: it is for roughness that moves by less than a cell a step.

    Implausible input is issued once as a :class:`~stribeck.StribeckWarning`: warnings of scene and surfaces at once, those of
    the contact after the first step.

    A step that fails leaves the simulation as before. Ctrl-C ends a step, within its solve too, and leaves the simulation as
    before the step.
    """

    __slots__ = ("__weakref__", "_given", "_held", "_history", "_in_folder", "_raw", "_scene")

    def __init__(
        self,
        scene: Scene | Mapping[str, Any] | str | os.PathLike[str],
        *,
        heights: Heights = None,
        bodies: tuple[BodyStart | None, BodyStart | None] | None = None,
        growth: Any = None,
        wear: Any = None,
        friction: Any = None,
        deformation: Any = None,
        viscosity: Any = None,
        density: Any = None,
        plasticity: Any = None,
        motion: Any = None,
        solver: Any = None,
        start: Solution | None = None,
        squeeze: bool = False,
    ) -> None:
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
        given = {"heights": heights, "bodies": bodies, "laws": laws, "squeeze": truth("squeeze", squeeze)}
        self._build(with_solver(as_scene(scene), solver), given, start)
        say(self.warnings, 2)

    def _build(self, scene: Scene, given: dict[str, Any], start: Solution | None = None) -> None:
        """Begins at the start of ``scene``, with the ``given`` objects in place of its parts."""
        keeper, called = held(given["laws"])
        built = parts(given["heights"], given["bodies"], called)
        own = (built["ball_heights"], built["disc_heights"])
        # the arrays of the caller may change
        kept = None if all(part is None for part in own) else tuple(None if part is None else part.copy() for part in own)
        with named(named_parts(built, given["bodies"])):
            raw = _Simulation(scene._raw, built, given["squeeze"], first_state(start, scene))
        for name, value in {
            "_given": {**given, "heights": kept},
            "_held": keeper,
            "_history": History(),
            "_in_folder": False,
            "_raw": raw,
            "_scene": scene,
        }.items():
            object.__setattr__(self, name, value)

    if not TYPE_CHECKING:  # attributes that cannot be set are found by type checkers

        def __setattr__(self, name: str, value: Any) -> None:
            is_condition = name in CONDITIONS or hasattr(Simulation, name)
            if type(self) is Simulation or is_condition:
                words = "change(load=..., motion=...) sets conditions from now on" if is_condition else "it has no such attribute"
                raise AttributeError(f"{name} of a simulation cannot be set; {words}")
            object.__setattr__(self, name, value)

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
        """Warnings of the scene, its surfaces and, after the first step, its contact."""
        return found(self._raw.warnings())

    @property
    def history(self) -> History:
        """The records of all steps since the start, or since the checkpoint that was restored; of a run folder those of all its steps. It
        grows with the simulation."""
        for raw in self._raw.take_records():
            record = Record._of(raw)
            self._history.append(record)
            _log.info("step %d at %g s: friction %s", record["step"], record["time"], record["friction.coefficient"])
        return self._history

    @property
    def grid(self) -> Grid:
        """The cells of the contact and of both bodies."""
        return Grid._of(self._raw.grid())

    @property
    def conditions(self) -> Conditions:
        """Present operating conditions: ``load`` [N], ``motion.entrainment_speed`` [m/s], ``motion.slide_roll_ratio``, ``bulk_temperature`` [K]."""
        return cast(Conditions, Numbers(self._raw.about()["conditions"]))

    @property
    def roughness_motion(self) -> str:
        """How the roughness moves from step to step, in words."""
        return str(self._raw.about()["roughness_motion"])

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
    def fields(self) -> Mapping[str, npt.NDArray[Any]]:
        """Maps of the last contact by name, of the shape ``(ny, nx)``, as copies: ``pressure``, ``fluid_pressure`` [Pa], ``film``,
        ``plastic_depth`` [m], ``theta`` (filled share of the gap) and ``in_contact``."""
        return Fields(self._raw.fields())

    def starts(self) -> tuple[BodyStart, BodyStart]:
        """Ball and disc as they stand, as ``bodies`` of another run or solve."""
        scene = Scene._of(self._raw.scene())
        ball, disc = self._raw.starts()
        return BodyStart._of(scene, ball), BodyStart._of(scene, disc)

    def step(self, time_step: Quantity, *, depth: Quantity = math.inf) -> Record:
        """Takes one step of ``time_step`` [s], shorter where a node would wear or grow by more than ``depth`` [m]."""
        return self._step(time_step, depth)

    def _step(self, time_step: Quantity, depth: Quantity) -> Record:
        """The step of the caller of the caller."""
        self._raw.step(number("time_step", time_step, "s"), number("depth", depth, "m"))
        record = self.history[-1]
        say(record.warnings, 3)
        return record

    def run(
        self,
        steps: int,
        time_step: Quantity,
        *,
        depth: Quantity = math.inf,
        callback: Callable[[Simulation, Record], bool | np.bool_ | None] | None = None,
    ) -> History:
        """Takes ``steps`` steps. ``callback(simulation, record)`` sees each and ends the run by returning True or raising
        StopIteration; False and None let it go on, all else is refused."""
        count = whole("steps", steps)
        function("callback", callback)
        history = History()
        for _ in range(count):
            if self._seen(history, self._step(time_step, depth), callback):
                break
        return history

    def run_until(
        self,
        end: Quantity,
        time_step: Quantity,
        *,
        depth: Quantity = math.inf,
        callback: Callable[[Simulation, Record], bool | np.bool_ | None] | None = None,
    ) -> History:
        """Steps until the time ``end`` [s], none longer than ``time_step`` or across an entry of the scene's schedule; ``callback``
        is as in :meth:`run`."""
        function("callback", callback)
        end, time_step, depth = number("end", end, "s"), number("time_step", time_step, "s"), number("depth", depth, "m")
        history = History()
        while self._raw.step_towards(end, time_step, depth):
            record = self.history[-1]
            say(record.warnings, 2)
            if self._seen(history, record, callback):
                break
        return history

    def _seen(self, history: History, record: Record, callback: Any) -> bool:
        history.append(record)
        if callback is not None:
            try:
                returned = callback(self, record)
            except StopIteration:
                returned = True
            if not isinstance(returned, bool | np.bool_ | None):
                raise refused("callback", returned, "a function that returns True, False or None")
            history.stopped = bool(returned)
        return history.stopped

    def solve_under(
        self,
        *,
        load: Quantity | None = None,
        entrainment_speed: Quantity | None = None,
        slide_roll_ratio: float | None = None,
        bulk_temperature: Quantity | None = None,
    ) -> Solution:
        """Solves the contact of the bodies as they stand under other conditions; nothing is changed by it."""
        given = {
            "load": (load, "N"),
            "entrainment_speed": (entrainment_speed, "m/s"),
            "slide_roll_ratio": (slide_roll_ratio, "1"),
            "bulk_temperature": (bulk_temperature, "K"),
        }
        numbers = [optional_number(name, value, unit) for name, (value, unit) in given.items()]
        return Solution(*self._raw.solve_under(*numbers))

    def mean_on_track(self, field: npt.ArrayLike) -> float:
        """Mean of a field of a body over the width of the track."""
        return self._raw.mean_on_track(array("field", field))

    def change(self, **tables: Any) -> None:
        """Other conditions from now on: tables of the scene as for :meth:`Scene.replace`, ``load``, ``motion``, ``lubricant``, ``friction``,
        ``thermal``, ``solver`` and ``schedule``, whose times count from now. ``load="20 N"`` is ``load={"force": "20 N"}``. A quantity that
        is given ends its schedule. Bodies, time and history stay; :attr:`scene` is the new one."""
        if self._in_folder:
            message = "change: the simulation writes into a run folder, which holds one scene; close() it first"
            raise InputError(message, field="change")
        history, bytes_now, before = self.history, self._raw.checkpoint(), self.warnings
        other = object.__new__(type(self))
        other._build(changed(self._scene, tables, self.time), self._given)
        other._raw.restore_bytes(bytes_now)
        for name in ("_scene", "_raw", "_held", "_given"):
            object.__setattr__(self, name, getattr(other, name))
        object.__setattr__(self, "_history", history)
        known = [str(warning) for warning in before]
        say([warning for warning in self.warnings if str(warning) not in known], 2)

    def __repr__(self) -> str:
        return f"<Simulation after {self.steps} steps, {self.time:g} s>"
