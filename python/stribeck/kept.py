"""Simulations in files, copies and pickles."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

from ._arguments import path as _path, whole
from ._conditions import accepted
from ._held import Held
from ._stribeck import Simulation as _Simulation
from .errors import InputError
from .records import History, Record
from .scene import Scene

_Kind = TypeVar("_Kind", bound="Kept")


class Kept:
    """The part of a simulation that keeps it."""

    __slots__ = ()

    _given: dict[str, Any]
    _held: Held
    _history: History
    _in_folder: bool
    _raw: _Simulation
    _scene: Scene

    def __init__(self, scene: Scene | Mapping[str, Any] | str | os.PathLike[str], **given: Any) -> None:
        raise NotImplementedError

    def _build(self, scene: Scene, given: dict[str, Any]) -> None:
        raise NotImplementedError

    @property
    def history(self) -> History:
        """The records."""
        raise NotImplementedError

    @classmethod
    def open(
        cls: type[_Kind],
        folder: str | os.PathLike[str],
        scene: Scene | Mapping[str, Any] | str | os.PathLike[str] | None = None,
        *,
        every: int = 10,
        accept: Iterable[str] = (),
        **given: Any,
    ) -> _Kind:
        """A simulation that writes itself into ``folder``, the run folder of the command: ``scene.toml``, a line of ``history.csv`` a step, a
        ``checkpoint`` after each ``every`` steps, and ``fields.npz`` at :meth:`close`, which the end of a ``with`` block calls. Of a run that
        the folder holds it goes on, with its history, from its checkpoint; without ``scene`` the one in the folder is taken. ``given`` are
        keywords of the class; ``accept`` names parts that may differ, as in :meth:`restore`. Raises :class:`~stribeck.CheckpointError` for the run
        of another scene or law,
        :class:`~stribeck.InputError` where another run writes into the folder."""
        place = _path("folder", folder)
        if os.path.exists(os.path.join(place, "sweep.json")):
            raise InputError(f"folder: {place} is that of a sweep; take another one", field="folder", value=place)
        simulation = cls(os.path.join(place, "scene.toml") if scene is None else scene, **given)
        simulation._raw.open_folder(place, whole("every", every), accepted(accept))
        object.__setattr__(simulation, "_in_folder", True)
        return simulation

    def close(self) -> None:
        """Writes the last checkpoint and the fields into the run folder, if there is one, and leaves it to other runs."""
        object.__setattr__(self, "_in_folder", False)
        self._raw.close_folder()

    def __enter__(self: _Kind) -> _Kind:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a checkpoint: a simulation of the same scene and laws that restores it goes on as this one, to the last bit."""
        self._raw.save(_path("path", path))

    def restore(self, path: str | os.PathLike[str], *, accept: Iterable[str] = ()) -> list[str]:
        """Takes over a checkpoint. ``accept`` names parts that may differ from those it was written with, laws by their keywords and tables of
        the scene (``["wear", "scene.load"]``): a law whose code is the same under another version of Python, say. Returns those that
        do. Raises :class:`~stribeck.CheckpointError` where it is damaged or of another simulation; its message names the differences."""
        differences = self._raw.restore(_path("path", path), accepted(accept))
        object.__setattr__(self, "_history", History())
        return differences

    def restore_under_other_conditions(self, path: str | os.PathLike[str]) -> list[str]:
        """Takes over a checkpoint of a scene whose load, speeds, oil, friction, temperatures, schedule or solver differ, and returns the names
        of these parts."""
        differences = self._raw.restore_under_other_conditions(_path("path", path))
        object.__setattr__(self, "_history", History())
        return differences

    def fork(self: _Kind) -> _Kind:
        """A simulation of its own that stands where this one does; it writes into no folder."""
        fork = object.__new__(type(self))
        values = {
            "_given": self._given,
            "_held": self._held,
            "_history": self.history[:],
            "_in_folder": False,
            "_raw": self._raw.fork(),
            "_scene": self._scene,
        }
        for name, value in {**getattr(self, "__dict__", {}), **values}.items():
            object.__setattr__(fork, name, value)
        return fork

    def __copy__(self: _Kind) -> _Kind:
        return self.fork()

    def __deepcopy__(self: _Kind, memo: dict[int, Any]) -> _Kind:
        return self.fork()

    def __reduce__(self) -> Any:
        records = list(self.history)
        own = getattr(self, "__dict__", {})
        return _unpickled, (type(self), self._scene, self._given, self._raw.checkpoint(), records, own)


def _unpickled(
    kind: type[_Kind], scene: Scene, given: dict[str, Any], checkpoint: bytes, records: list[Record], own: dict[str, Any]
) -> _Kind:
    """The simulation of a pickle: its laws are found by their names, as pickle does."""
    simulation = object.__new__(kind)
    simulation._build(scene, given)
    simulation._raw.restore_bytes(checkpoint)
    for name, value in {**own, "_history": History(records)}.items():
        object.__setattr__(simulation, name, value)
    return simulation
