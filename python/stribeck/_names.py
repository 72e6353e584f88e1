"""All names of numbers, fields and keys, and their units."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from functools import lru_cache
from typing import get_args, get_type_hints

from . import _tables
from ._numbers import COLUMNS, FIELDS, Numbers, unit
from ._typed import Expectation, Hertz, Oil
from .cycles import UNITS as OF_CYCLES
from .errors import UnknownNameError
from .film import GivenFilm, RigidBearing
from .flat import FlatContact
from .points import Point
from .records import Record
from .scene import Grid, Scene
from .solution import Solution

#: Tables whose numbers have units.
_KINDS = (Solution, Record, Point, GivenFilm, RigidBearing, FlatContact, Expectation, Hertz, Oil, Grid)
#: Attributes other than numbers.
_NO_NUMBERS = {"fields", "inputs", "scene", "warnings"}
#: Largest number of names that an error lists, and how close they are at least.
_NEAREST, _CLOSENESS = 5, 0.5


def units(name: str) -> str:
    """The unit of a number, column, field or key of a scene by its full name; empty for ratios, counts and words. Numbers are in SI units.

    Raises
    ------
    UnknownNameError
        For another name, with those closest to it.

    Examples
    --------
    >>> import stribeck
    >>> stribeck.units("film.central"), stribeck.units("motion.entrainment_speed")
    ('m', 'm/s')
    """
    own = name.removeprefix("scene.") if isinstance(name, str) else ""
    if own not in _known():
        near = difflib.get_close_matches(own, sorted(_known()), _NEAREST, _CLOSENESS) or ["film.central", "pressure", "load.force"]
        raise UnknownNameError(f"name = {name!r}: unknown; the nearest names: {', '.join(near)}", field="name", value=name)
    return OF_CYCLES.get(own) or unit(own)


@lru_cache(maxsize=1)
def _known() -> frozenset[str]:
    names = {name for kind in _KINDS for name in _numbers(kind)}
    tables = {**get_type_hints(Scene), "grid": Grid}
    keys = {f"{table}.{name}" for table, kind in tables.items() for name in _numbers(kind)}
    return frozenset({*names, *keys, *_tables.UNITS, *COLUMNS, *FIELDS, *OF_CYCLES})


def _numbers(kind: type, prefix: str = "") -> Iterator[str]:
    """Full names of the numbers of a table by its annotations."""
    for attribute, hint in get_type_hints(kind).items():
        if attribute.startswith("_") or attribute in _NO_NUMBERS:
            continue
        name = f"{prefix}{attribute.removesuffix('_')}"
        inner = next((part for part in (hint, *get_args(hint)) if isinstance(part, type) and issubclass(part, Numbers)), None)
        if inner is Grid:
            continue
        if inner is None or inner is not hint:
            # also a table that may be None
            yield name
        if inner is not None:
            yield from _numbers(inner, f"{name}.")
