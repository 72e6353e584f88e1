"""Elastic bodies, for deformation models that are built from them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, array, cells, number, whole
from . import _stribeck
from .scene import Grid

__all__ = ["HalfSpace"]


class HalfSpace:
    """Two elastic half-spaces in contact on the cells of ``grid``, with the equivalent modulus ``E'`` [Pa]: the displacement under one
    pressure a cell, by Love's coefficients and a discrete convolution. As a deformation model it takes more iterations than the half-space
    that a scene has by itself."""

    def __init__(self, grid: Grid, equivalent_modulus: Quantity) -> None:
        self.equivalent_modulus = number("equivalent_modulus", equivalent_modulus, "Pa")
        self.grid = grid
        self._raw = _stribeck.HalfSpace(cells(grid), self.equivalent_modulus)

    def __reduce__(self) -> Any:
        return type(self), (self.grid, self.equivalent_modulus)

    def displacement(self, pressure: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Displacement of both surfaces together, the widening of the gap [m], under ``pressure`` [Pa]."""
        return self._raw.displacement(array("pressure", pressure))

    def influence(self, di: int, dj: int) -> float:
        """Displacement under 1 Pa on a cell ``di`` columns and ``dj`` rows away, zero from 6 on [m/Pa]."""
        return self._raw.influence(whole("di", di), whole("dj", dj))
