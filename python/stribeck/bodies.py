"""Bodies with a past."""

from __future__ import annotations

import os
from typing import Any

import numpy.typing as npt

from ._arguments import array, depths, instance, path as _path, refused
from ._numbers import same
from ._stribeck import BodyStart as _BodyStart
from .scene import Scene

__all__ = ["BodyStart", "read_body"]


class BodyStart:
    """A body with a past on the grid of ``scene``: heights of the new body, worn and plastic depth and tribofilm, each of the shape
    ``(ny, nx)`` [m]. It never changes."""

    __slots__ = ("_raw", "_scene")

    def __init__(
        self,
        scene: Scene,
        heights: npt.ArrayLike,
        *,
        wear: npt.ArrayLike | None = None,
        plastic_depth: npt.ArrayLike | None = None,
        tribofilm: npt.ArrayLike | None = None,
    ) -> None:
        instance("scene", scene, Scene, "a Scene")
        self._scene = scene
        self._raw = _BodyStart(
            scene._raw,
            array("heights", heights),
            depths("wear", wear),
            depths("plastic_depth", plastic_depth),
            depths("tribofilm", tribofilm),
        )

    @classmethod
    def _of(cls, scene: Scene, raw: _BodyStart) -> BodyStart:
        start = cls.__new__(cls)
        start._scene, start._raw = scene, raw
        return start

    def __eq__(self, other: object) -> bool:
        """Whether both are on the same scene with the same depths."""
        if not isinstance(other, BodyStart):
            return NotImplemented
        return self._scene == other._scene and same(self._raw.fields(), other._raw.fields())

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> BodyStart:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> BodyStart:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self._scene, *self._raw.fields())


def _restored(kind: type[BodyStart], scene: Scene, fields: dict[str, Any], states: Any) -> BodyStart:
    return kind._of(scene, _BodyStart.from_fields(scene._raw, **fields, states=states))


def read_body(scene: Scene, path: str | os.PathLike[str], name: str) -> BodyStart:
    """The body ``name``, ``ball`` or ``disc``, of the ``fields.npz`` of a run on the grid of ``scene``: arrays ``ball_initial``,
    ``ball_wear``, ``ball_plastic_depth`` and ``ball_tribofilm``, of which all but the first may be missing."""
    instance("scene", scene, Scene, "a Scene")
    if name not in ("ball", "disc"):
        raise refused("name", name, "ball or disc")
    return BodyStart._of(scene, _BodyStart.read_npz(scene._raw, _path("path", path), name))
