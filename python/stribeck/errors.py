"""Exceptions of the package. Each has ``field``, the name of the invalid input, and ``value``, its value."""

from __future__ import annotations

import difflib
import warnings
from collections.abc import Iterable
from typing import Any

__all__ = [
    "BusyError",
    "CheckpointError",
    "FileError",
    "InputError",
    "InterruptedSolve",
    "LawError",
    "NotConvergedError",
    "SceneError",
    "ShapeError",
    "SolverError",
    "StribeckError",
    "StribeckWarning",
    "SurfaceError",
    "UnknownNameError",
]

#: Most names that an error lists; of more it lists the nearest.
_LISTED = 12


class StribeckError(Exception):
    """Base of all errors of the package. ``field`` names the invalid input, ``value`` is its value; None if there is none."""

    field: str | None
    value: Any

    def __init__(self, message: str, *, field: str | None = None, value: Any = None) -> None:
        super().__init__(message)
        self.field = field
        self.value = value


class InputError(StribeckError, ValueError):
    """A value out of range, a contradiction or a number that is not finite."""


class ShapeError(InputError):
    """An array of the wrong shape; ``value`` is the shape found."""


class SceneError(InputError):
    """A scene that does not fit: an unknown or missing key, a value of the wrong type."""


class SurfaceError(InputError):
    """A measured surface or its file that cannot be used; ``value`` is the path."""


class UnknownNameError(InputError, KeyError):
    """A name that a table of numbers, a history or a solution has not; the message lists those that it has."""

    def __str__(self) -> str:
        return str(self.args[0])


class SolverError(StribeckError):
    """A solver that is not made for the contact, or a contact that reaches the edge of the box."""


class NotConvergedError(StribeckError):
    """A contact that had to be solved and was not; ``value`` is the status, ``report`` the report of the last try."""

    report: dict[str, Any] | None = None


class LawError(StribeckError):
    """A law in Python that raised (see ``__cause__``), or returned values other than finite numbers."""


class CheckpointError(StribeckError):
    """A checkpoint that is damaged or belongs to another simulation; ``field`` is the part that differs."""


class FileError(StribeckError, OSError):
    """A file that cannot be read or written; ``value`` is its path."""


class BusyError(StribeckError, RuntimeError):
    """A simulation that is asked while it takes a step."""


class StribeckWarning(UserWarning):
    """Something that is allowed but unlikely to be meant or to hold: ``field`` is the key of the scene or the number of the solution,
    ``value`` its value in SI units (None where it has none), ``message`` the reason and ``remedy`` the advice."""

    def __init__(self, field: str, value: float | None, message: str, remedy: str) -> None:
        name = field if value is None else f"{field} = {value:.7g}"
        super().__init__(f"{name}: {message}; {remedy}" if remedy else f"{name}: {message}")
        self.field, self.value, self.message, self.remedy = field, value, message, remedy

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.field, self.value, self.message, self.remedy)


class InterruptedSolve(StribeckError):
    """A solve that was ended from outside without an exception."""


def found(items: list[dict[str, Any]]) -> list[StribeckWarning]:
    """Warnings of the compiled module as such."""
    return [StribeckWarning(**item) for item in items]


def say(items: list[StribeckWarning], depth: int) -> None:
    """Says each warning through the ``warnings`` of Python, as of the caller ``depth`` calls up."""
    for item in items:
        warnings.warn(item, stacklevel=depth + 1)


def unknown(field: str, name: Any, known: Iterable[str]) -> UnknownNameError:
    """The error of a ``name`` that is none of those ``known``, of many with the nearest alone."""
    names = list(known)
    words = f"must be one of {', '.join(names)}"
    if len(names) > _LISTED and isinstance(name, str):
        near = difflib.get_close_matches(name, names, 5, 0.5) or names[:5]
        words = f"unknown; the nearest of {len(names)} names: {', '.join(near)}"
    return UnknownNameError(f"{field} = {name!r}: {words}", field=field, value=name)
