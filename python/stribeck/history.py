"""Histories: contacts that change as they rub."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import (
    Quantity,
    array,
    depths,
    function,
    instance,
    named,
    number,
    optional_number,
    path as _path,
    refused,
    truth,
    whole,
)
from ._numbers import Fields, Numbers
from ._stribeck import BodyStart as _BodyStart, Simulation as _Simulation
from .errors import StribeckWarning, found, say
from .records import Body, History, Record
from .scene import Grid, Scene, as_scene
from .solution import Heights, Solution, first_state, parts, with_solver

__all__ = ["Body", "BodyStart", "History", "Record", "Simulation", "read_body"]


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
    instance("scene", scene, Scene, "a Scene")
    return _BodyStart(
        scene._raw,
        array("heights", heights),
        depths("wear", wear),
        depths("plastic_depth", plastic_depth),
        depths("tribofilm", tribofilm),
    )


def read_body(scene: Scene, path: str | os.PathLike[str], name: str) -> _BodyStart:
    """The body ``name``, ``ball`` or ``disc``, of the ``fields.npz`` of a run on the grid of ``scene``: arrays ``ball_initial``,
    ``ball_wear``, ``ball_plastic_depth`` and ``ball_tribofilm``, of which all but the first may be missing."""
    instance("scene", scene, Scene, "a Scene")
    if name not in ("ball", "disc"):
        raise refused("name", name, "ball or disc")
    return _BodyStart.read_npz(scene._raw, _path("path", path), name)


class Simulation:
    """A contact whose surfaces flatten, grow a tribofilm and wear as they rub.

    ``heights``, ``bodies``, ``friction``, ``deformation``, ``viscosity``, ``density``, ``plasticity`` and ``solver`` are as in
    :func:`stribeck.solve`, and so is ``start``, a first guess of the first contact. ``growth``, ``wear`` and ``motion``, that of
    the roughness from step to step, are laws in Python in place of those of the scene (:mod:`stribeck.laws`). ``squeeze`` makes
    the history transient: it is for roughness that moves by less than a cell a step.

    What is unlikely to be meant is said once as a :class:`~stribeck.StribeckWarning`, that of scene and surfaces at once, that of
    the contact after the first step.

    A step that fails leaves the simulation as before. Ctrl-C ends a step, within its solve too, and leaves the simulation as
    before the step.
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
        start: Solution | None = None,
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
        given, first = parts(heights, bodies, laws), first_state(start, self._scene)
        with named(given):
            self._raw = _Simulation(self._scene._raw, given, truth("squeeze", squeeze), first)
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
        return History([Record._of(raw) for raw in self._raw.records(0)])

    @property
    def grid(self) -> Grid:
        """The cells of the contact and of both bodies."""
        return Grid._of(self._raw.grid())

    @property
    def conditions(self) -> Numbers:
        """What acts on the contact now: ``load`` [N], ``motion.entrainment_speed`` [m/s], ``motion.slide_roll_ratio``, ``bulk_temperature`` [K]."""
        return Numbers(self._raw.about()["conditions"])

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
    def fields(self) -> dict[str, npt.NDArray[Any]]:
        """Maps of the last contact by name, of the shape ``(ny, nx)``, as copies: ``pressure``, ``fluid_pressure`` [Pa], ``film``,
        ``plastic_depth`` [m], ``theta`` (filled share of the gap) and ``in_contact``."""
        return Fields(self._raw.fields())

    def starts(self) -> tuple[_BodyStart, _BodyStart]:
        """Ball and disc as they stand, as ``bodies`` of another run or solve."""
        ball, disc = self._raw.starts()
        return ball, disc

    def step(self, time_step: Quantity, *, depth: Quantity = math.inf) -> Record:
        """Takes one step of ``time_step`` [s], shorter where a node would wear or grow by more than ``depth`` [m]."""
        return self._step(time_step, depth)

    def _step(self, time_step: Quantity, depth: Quantity) -> Record:
        """The step of the caller of the caller."""
        record = Record._of(self._raw.step(number("time_step", time_step, "s"), number("depth", depth, "m")))
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
        while (raw := self._raw.step_towards(end, time_step, depth)) is not None:
            record = Record._of(raw)
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

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a checkpoint: a simulation of the same scene and laws that restores it goes on as this one, to the last bit."""
        self._raw.save(_path("path", path))

    def restore(self, path: str | os.PathLike[str]) -> None:
        """Takes over a checkpoint. Raises :class:`~stribeck.CheckpointError` where it is damaged or of another simulation."""
        self._raw.restore(_path("path", path))

    def restore_under_other_conditions(self, path: str | os.PathLike[str]) -> list[str]:
        """Takes over a checkpoint of a scene whose load, speeds, oil, friction, temperatures, schedule or solver differ, and returns what
        does."""
        return self._raw.restore_under_other_conditions(_path("path", path))

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
