"""References to the functions of laws."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Any

from .laws import compiled


class Held:
    """The functions of the laws of a simulation. The compiled module, whose references the garbage collector does not see, refers to them
    weakly, so that a law may refer to its simulation."""

    def __init__(self) -> None:
        self.calls: list[Callable[..., Any]] = []

    def add(self, call: Callable[..., Any]) -> Callable[..., Any]:
        """A function that calls ``call`` as long as this object lives."""
        self.calls.append(call)
        place, held = len(self.calls) - 1, weakref.ref(self)

        def forward(*arguments: Any) -> Any:
            alive = held()
            if alive is None:
                raise ReferenceError("the simulation of the law is gone")
            return alive.calls[place](*arguments)

        return forward


def held(laws: dict[str, Any]) -> tuple[Held, dict[str, Any]]:
    """Laws as :func:`compiled` makes them, and the object that keeps their functions alive."""
    keeper = Held()
    return keeper, {name: _weak(keeper, law) for name, law in compiled(laws).items()}


def _weak(keeper: Held, part: Any) -> Any:
    """A part of a compiled law with functions that ``keeper`` keeps."""
    if isinstance(part, tuple | list):
        return type(part)(_weak(keeper, item) for item in part)
    return keeper.add(part) if callable(part) else part
