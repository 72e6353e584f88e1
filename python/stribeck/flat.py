"""Dry contact of two rough planes, a cell of which repeats along both axes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import path
from ._numbers import Numbers, read_only
from ._stribeck import solve_flat
from .errors import found, say

__all__ = ["FlatContact", "flat_contact"]


class FlatContact(Numbers):
    """A flat contact of a scene file. ``mean_pressure`` [Pa], ``mean_gap`` [m], ``area_share``, ``plastic_share``, ``pressure_max`` [Pa],
    ``stiffness`` [Pa/m] (None for closed gaps), ``mean_plastic_depth`` [m], ``composite_rq`` [m], ``rms_slope``, ``area_over_load``,
    ``energy_error``, ``convolutions``, ``status``; ``pressure`` [Pa] and ``film`` [m], the deformed gap, are read-only arrays of the shape
    ``(ny, nx)``."""

    __slots__ = ("film", "pressure")

    mean_pressure: float
    mean_gap: float
    area_share: float
    plastic_share: float
    pressure_max: float
    stiffness: float | None
    mean_plastic_depth: float
    composite_rq: float
    rms_slope: float
    area_over_load: float
    energy_error: float
    convolutions: float
    status: str
    pressure: npt.NDArray[np.float64]
    film: npt.NDArray[np.float64]

    def __init__(
        self, values: Mapping[str, Any], pressure: npt.NDArray[np.float64], film: npt.NDArray[np.float64]
    ) -> None:
        super().__init__(values)
        object.__setattr__(self, "pressure", read_only(pressure))
        object.__setattr__(self, "film", read_only(film))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(), self.pressure, self.film)


def flat_contact(scene: str | os.PathLike[str]) -> FlatContact:
    """Solves the flat contact of a scene file with ``form.kind = "flat"``; warnings are issued.

    Raises
    ------
    SceneError
        For a scene of another form or with keys that do not fit.
    """
    (numbers, warnings), (pressure, film) = solve_flat(path("scene", scene))
    say(found(warnings), 2)
    return FlatContact(numbers, pressure, film)
