"""Rigid surfaces with a film that is given: textured bearings and sliders, without a contact."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, array, cells, number, numbers, path, truth, whole
from ._numbers import Fields, Numbers, dataset, flat, frame, read_only
from ._solved import Solved
from ._stribeck import solve_bearing, solve_film
from ._typed import Flow, Forces
from .errors import StribeckWarning, found, say
from .scene import Grid

__all__ = ["GivenFilm", "RigidBearing", "given_film", "rigid_bearing"]


class RigidBearing(Numbers):
    """A journal bearing or a pad of a scene file. ``load`` [N], with edge pressures above ambient ``load_above_edges`` [N], ``least_film`` [m], ``pressure_max`` [Pa], ``friction_moving`` and
    ``friction_resting`` [N], ``friction_coefficient``, ``cavitated_shear`` [N], ``side_flow`` and ``edge_flows`` [m^3/s], ``power_loss`` [W], ``eta0`` [Pa s],
    ``alpha`` [1/Pa], ``viscosity_ratio``, ``temperature`` [K], with a heat balance ``supply_temperature``, ``outlet_temperature`` [K] and ``carried_heat`` [W], with grooves ``groove_flow``, with holes ``hole_flow`` [m^3/s],
    with an elastic bore ``bore_widening`` [m],
    with roughness ``contact_share``, ``contact_area`` [m^2], ``contact_friction`` [N] and ``film_over_rq``,
    ``status``; of a journal ``eccentricity``, ``attitude`` [rad], ``sommerfeld`` and ``force`` [N], towards the widest gap and across."""

    __slots__ = ()

    load: float
    load_above_edges: float | None
    force: list[float] | None
    attitude: float | None
    eccentricity: float | None
    sommerfeld: float | None
    least_film: float
    pressure_max: float
    friction_moving: float
    friction_resting: float
    friction_coefficient: float
    cavitated_shear: float
    contact_share: float | None
    contact_area: float | None
    contact_friction: float | None
    film_over_rq: float | None
    side_flow: float
    edge_flows: list[float]
    groove_flow: float | None
    hole_flow: float | None
    bore_widening: float | None
    power_loss: float
    eta0: float
    alpha: float
    viscosity_ratio: float
    temperature: float
    supply_temperature: float | None
    outlet_temperature: float | None
    carried_heat: float | None
    status: str


def rigid_bearing(scene: str | os.PathLike[str]) -> RigidBearing:
    """Solves the rigid bearing of a scene file with the table ``[given_film]``; warnings are issued.

    Raises
    ------
    SceneError
        For a scene without this table or with keys that do not fit.
    """
    numbers, warnings = solve_bearing(path("scene", scene))
    say(found(warnings), 2)
    return RigidBearing(numbers)


class GivenFilm(Solved):
    """A film between rigid surfaces. ``load`` [N], ``force.lower`` and ``force.upper`` [N], the shear forces along +x on both
    surfaces, ``side_flow`` [m^3/s] through the edges across y, ``edge_flows`` [m^3/s] out through the edges of the smallest and largest x and y,
    ``cavitated_shear`` [N], the part of the shear force by cavitated fluid, ``power_loss`` [W] by friction, ``flow.inflow``, ``flow.outflow`` [m^3/s], ``flow.imbalance``, ``status``, ``residual.mass``, ``work``; ``film`` [m], ``pressure`` [Pa]
    and ``theta``, the share of the gap that is filled, are read-only arrays of the shape ``(ny, nx)``; ``warnings`` lists implausible input."""

    __slots__ = ("_rows", "film", "grid", "pressure", "theta", "warnings")

    load: float
    force: Forces
    side_flow: float
    edge_flows: list[float]
    cavitated_shear: float
    power_loss: float
    flow: Flow
    #: The cells of the fields.
    grid: Grid
    film: npt.NDArray[np.float64]
    pressure: npt.NDArray[np.float64]
    theta: npt.NDArray[np.float64]
    _rows: list[tuple[npt.NDArray[np.float64], float | None]]
    warnings: list[StribeckWarning]

    def __init__(
        self,
        values: Mapping[str, Any],
        fields: Mapping[str, npt.NDArray[np.float64]],
        rows: list[tuple[npt.NDArray[np.float64], float | None]],
        warnings: list[StribeckWarning],
        grid: Grid,
    ) -> None:
        super().__init__(values)
        own = {name: read_only(field) for name, field in fields.items()}
        for name, value in {"_rows": rows, "warnings": warnings, "grid": grid, **own}.items():
            object.__setattr__(self, name, value)

    @classmethod
    def _of(cls, solved: Any, grid: Grid) -> GivenFilm:
        fields = {"film": solved.film(), "pressure": solved.pressure(), "theta": solved.theta()}
        return cls(solved.numbers(), fields, solved.rows(), found(solved.warnings()), grid)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(), self.fields, self._rows, self.warnings, self.grid)

    @property
    def fields(self) -> Mapping[str, npt.NDArray[np.float64]]:
        """``film``, ``pressure`` and ``theta`` by name."""
        return Fields({"film": self.film, "pressure": self.pressure, "theta": self.theta})

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of one row with the numbers; ``attrs["units"]`` are the units of its columns."""
        return frame({name: [value] for name, value in flat(self).items()})

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` of the fields over ``y`` and ``x`` [m], with units; its attributes are the numbers by their full names."""
        return dataset(self.fields, self.grid.x, self.grid.y, flat(self))

    def _ended(self) -> str:
        return f"the film ended as {self['status']} with an imbalance of {self['residual']['mass']:.3g}"

    def pressure_at(self, x: Quantity, row: int = 0) -> float | None:
        """Pressure [Pa] at ``x`` [m] in a row of the grid; None for a row beyond the grid and for an ``x`` that is NaN."""
        place, at = number("x", x, "m"), whole("row", row)
        if at >= len(self._rows) or np.isnan(place):
            return None
        profile, _ = self._rows[at]
        after = min(int(np.searchsorted(profile[:, 0], place)), len(profile) - 1)
        (x0, p0), (x1, p1) = profile[max(after - 1, 0)], profile[after]
        share = min(max((place - x0) / (x1 - x0), 0.0), 1.0) if x1 > x0 else 0.0
        return float(p0 + share * (p1 - p0))

    def reformation(self, row: int = 0) -> float | None:
        """Where [m] the film reforms first along the flow in a row, within its cell; None where it does not."""
        at = whole("row", row)
        return self._rows[at][1] if at < len(self._rows) else None


def given_film(
    film: npt.ArrayLike | Callable[[float, float], float],
    grid: Grid,
    *,
    speeds: tuple[Quantity, Quantity],
    eta0: Quantity,
    alpha: Quantity = 0.0,
    density_a: Quantity = 0.0,
    density_b: Quantity = 0.0,
    ambient_pressure: Quantity = 0.0,
    edge_pressures: Sequence[Quantity] | None = None,
    cavitation_pressure: Quantity = 0.0,
    closed_sides: bool = False,
    periodic: bool = False,
) -> GivenFilm:
    """Pressure and content between two rigid surfaces, mass conserved where the film ruptures and reforms.

    ``film`` [m] is an array of the shape ``(ny, nx)``, constant in each cell, or a function of ``x`` and ``y`` [m], which is asked point
    by point and may jump anywhere between two nodes. ``grid`` is a ``Grid.box(...)``; one of a single row is a film that is wide along y.
    ``speeds`` [m/s] are those of the lower and the upper surface along x, ``eta0`` [Pa s] and ``alpha`` [1/Pa] the viscosity
    ``eta0 exp(alpha p)``, ``density_a`` and ``density_b`` [1/Pa] those of the density ``1 + a p/(1 + b p)`` over that without pressure (0.6e-9 and
    1.7e-9 for mineral oils; incompressible by default). Pressure is ``ambient_pressure`` [Pa] at the edges, or
    ``edge_pressures`` at those of the smallest and largest x and y, and nowhere below ``cavitation_pressure`` [Pa]; with
    ``closed_sides`` nothing flows through the edges across y. A ``periodic`` film repeats along x, as around a ring: what leaves at
    one end enters at the other.

    Not converging is a status, see :meth:`GivenFilm.require_converged`. Implausible input is issued as a
    :class:`~stribeck.StribeckWarning`.
    """
    on = cells(grid)
    lower, upper = numbers("speeds", speeds, ("m/s", "m/s"))
    density = [number("density_a", density_a, "1/Pa"), number("density_b", density_b, "1/Pa")]
    oil = number("eta0", eta0, "Pa s"), number("alpha", alpha, "1/Pa"), density
    ambient, cavitation = number("ambient_pressure", ambient_pressure, "Pa"), number("cavitation_pressure", cavitation_pressure, "Pa")
    given = film if callable(film) else array("film", film)
    given_edges = (ambient,) * 4 if edge_pressures is None else tuple(edge_pressures)
    edges = list(numbers("edge_pressures", given_edges, ("Pa",) * 4)), cavitation, [truth("closed_sides", closed_sides), truth("periodic", periodic)]
    solved = GivenFilm._of(solve_film(on, given, [lower, upper], oil, edges), grid)
    say(solved.warnings, 2)
    return solved
