"""Laws written in Python. They are called on whole fields: arrays of the shape ``(ny, nx)`` in, an array of that shape or one number
out. For estimates over the smooth contact they are also called with arrays of one value, so they must not count on a shape.

A law must give finite numbers, and the same ones for the same arguments. An exception, and a return value other than such a field,
ends the step with a :class:`~stribeck.LawError` and leaves the simulation as before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

import numpy as np
import numpy.typing as npt

from ._arguments import text
from ._identity import identity
from ._numbers import Table
from ._stribeck import check_visits

if TYPE_CHECKING:
    from ._stribeck import Problem as _Problem
    from .scene import Grid

__all__ = [
    "ContactProblem",
    "ContactSolver",
    "ContactState",
    "DeformationModel",
    "DensityLaw",
    "FrictionLaw",
    "Growth",
    "GrowthLaw",
    "Hardening",
    "Motion",
    "PlasticityModel",
    "SurfaceStates",
    "ViscosityLaw",
    "WearLaw",
]

Field = npt.NDArray[np.float64]


@dataclass(frozen=True)
class SurfaceStates:
    """State of the nodes of a surface during a step, one value per node."""

    #: Total pressure, fluid and solid [Pa].
    pressure: Field
    #: Pressure of solid contact [Pa].
    solid_pressure: Field
    #: Shear stress on the surface [Pa].
    shear_stress: Field
    #: Surface temperature, bulk plus flash [K].
    temperature: Field
    #: Sliding speed between the surfaces [m/s].
    sliding_speed: Field
    #: Gap between the surfaces [m].
    gap: Field
    #: Whether the node is in solid contact.
    in_contact: npt.NDArray[np.bool_]


class GrowthLaw(Protocol):
    """Growth of a tribofilm: a rate and the thickness that growth alone approaches [m]. The rate is integrated over steps of any
    length, as that of a law in Rust."""

    maximum_thickness: float

    def rate(self, at: SurfaceStates, thickness: Field) -> npt.ArrayLike:
        """Net growth rate [m/s] of films of ``thickness`` [m]; zero where nothing rubs."""


class WearLaw(Protocol):
    """Wear: the rate at which a body loses height. A plain function of the same arguments will do."""

    def depth_rate(self, at: SurfaceStates, film_thickness: Field) -> npt.ArrayLike:
        """Rate of wear [m/s], not negative, under a tribofilm of ``film_thickness`` [m]."""


class FrictionLaw(Protocol):
    """Friction of solid contact. A plain function of the same arguments will do."""

    def coefficient(
        self, solid_pressure: Field, sliding_speed: float, tribofilm_ball: Field, tribofilm_disc: Field
    ) -> npt.ArrayLike:
        """Friction coefficient, not negative; pressure in Pa, speed in m/s, tribofilms in m."""


class DeformationModel(Protocol):
    """Elastic bodies: the displacement of both surfaces together. A plain function ``displacement(pressure)`` will do.

    It is linear in the pressure, symmetric, the same at all nodes (translation invariant) and positive; solvers rely on all four. It is called
    on whole fields, some ten to hundred times a solve. A method ``pressure_estimate(displacement)`` may give the pressure [Pa] that causes a
    displacement, roughly: the better, the fewer iterations; without one each node is taken for itself. A method ``influence(di, dj)`` may give
    the displacement under 1 Pa on a node so many columns and rows away [m/Pa]; without one the model is asked for it."""

    def displacement(self, pressure: Field) -> npt.ArrayLike:
        """Displacement [m], the widening of the gap, under ``pressure`` [Pa]."""


class ViscosityLaw(Protocol):
    """Viscosity of the lubricant by pressure. A plain function ``viscosity(pressure)`` will do; a law with a method
    ``viscosity_at(pressure, temperature)`` in its place follows the bulk temperature [K].

    It is finite, above zero and does not fall with pressure, up to 20 GPa. It is called on rows of pressures when the contact is made, and on
    fields for friction."""

    def viscosity(self, pressure: Field) -> npt.ArrayLike:
        """Viscosity [Pa s] at ``pressure`` [Pa]."""


class DensityLaw(Protocol):
    """Density of the lubricant over that without pressure. A plain function ``ratio(pressure)`` will do; a law with a method
    ``ratio_at(pressure, temperature)`` in its place follows the bulk temperature [K].

    It is 1 without pressure and does not fall with pressure, up to 20 GPa. Its slope is taken by differences."""

    def ratio(self, pressure: Field) -> npt.ArrayLike:
        """Density ratio at ``pressure`` [Pa]."""


class PlasticityModel(Protocol):
    """The largest pressure that a body carries at a node. A plain function of the same arguments will do.

    It is above zero and does not fall with the depth. Where it grows with it, an attribute ``hardens`` that is true makes a step find limit
    and depth together."""

    def pressure_limit(self, film_thickness: Field, plastic_depth: Field) -> npt.ArrayLike:
        """Pressure limit [Pa] under a tribofilm of ``film_thickness`` [m], where ``plastic_depth`` [m] has been flattened away."""


@dataclass(frozen=True)
class Hardening:
    """A plasticity model that hardens, from a function ``pressure_limit(film_thickness, plastic_depth)`` [Pa]."""

    pressure_limit: Callable[[Field, Field], npt.ArrayLike]
    hardens: bool = True


@dataclass(frozen=True)
class Motion:
    """A motion of the roughness from a function ``offset(body, draw, time, speed, grid)``: where the pattern of ``body`` (0 the ball, 1 the
    disc) stands at the ``draw``-th solve, counted from 0, and ``time`` [s], its surface moving at ``speed`` [m/s] along x.

    It returns whole columns that the pattern is shifted by; or columns and rows; or columns, rows and a fraction of a column from 0 to 1. It
    depends on its arguments alone. ``visits`` says which places of its patch a body brings under the contact: ``"stays"``, the same ones all the
    time; ``"passing"``, all along x one after the other; ``"track"``, all along x in any order; ``"patch"``, all along x and y. A body that
    stays keeps its offset, one that moves along x its row."""

    offset: Callable[[int, int, float, float, Grid], int | tuple[int, int] | tuple[int, int, float]]
    visits: Literal["stays", "passing", "track", "patch"] = "track"

    def __post_init__(self) -> None:
        check_visits(text("motion.visits", self.visits))


@dataclass
class ContactState:
    """Start and result of a solver: arrays of the shape ``(ny, nx)``, to be written into or replaced.

    A solver finds ``pressure``, ``fluid_pressure`` [Pa] and ``approach`` [m]. Films, the share ``theta`` of the gap that is filled, plastic depth
    and contact flags follow from them (:meth:`ContactProblem.evaluate`); where the fluid itself is at the pressure limit ``plastic_depth`` is an
    unknown of its own."""

    #: Total pressure, fluid plus solid [Pa]; none anywhere asks for a cold start.
    pressure: Field
    #: Fluid pressure [Pa].
    fluid_pressure: Field
    #: Film thickness [m], of a dry contact the gap.
    film: Field
    #: Plastic depth of this solve [m].
    plastic_depth: Field
    #: Share of the gap that is filled with fluid.
    theta: Field
    #: Whether the node is in solid contact.
    in_contact: npt.NDArray[np.bool_]
    #: Approach of the undeformed bodies [m]; positive is closer.
    approach: float


class ContactProblem(Table):
    """A contact for a solver. Numbers: ``load`` [N] that the pressures in the box carry, ``entrainment_speed`` [m/s], ``spin_radius`` [m] (None without spin), ``contact_film`` [m],
    the film at which solids touch (zero in a dry contact), ``lubricated``, ``supplied_film`` [m], ``tolerance`` and ``max_iterations``, and for
    starts ``half_widths`` [m], ``reference_pressure`` [Pa] and ``reference_film`` [m].
    Film: ``gap - approach + displacement(pressure) + plastic depth``."""

    __slots__ = ("_raw",)

    _raw: _Problem

    def __init__(self, raw: _Problem) -> None:
        super().__init__(raw.numbers())
        object.__setattr__(self, "_raw", raw)

    @property
    def grid(self) -> Grid:
        """The cells."""
        from .scene import Grid

        return Grid._of(self._raw.cells)

    @property
    def gap(self) -> Field:
        """Undeformed gap [m]."""
        return self._raw.gap

    @property
    def pressure_limit(self) -> Field | None:
        """Largest pressure of each node [Pa]; None in an elastic contact."""
        return self._raw.pressure_limit

    def displacement(self, pressure: npt.ArrayLike) -> Field:
        """Displacement of both surfaces [m], the widening of the gap, under ``pressure`` [Pa]."""
        return self._raw.displacement(pressure)

    def viscosity(self, pressure: npt.ArrayLike) -> Field:
        """Viscosity [Pa s] at ``pressure`` [Pa]."""
        return self._raw.viscosity(pressure)

    def density(self, pressure: npt.ArrayLike) -> Field:
        """Density over that without pressure at ``pressure`` [Pa]."""
        return self._raw.density(pressure)

    def evaluate(self, state: ContactState) -> Table:
        """The residuals of the state as the crate computes them, ``mass``, ``load`` and ``complementarity``; overwrites its ``film``,
        ``plastic_depth``, ``theta`` and ``in_contact`` with those that follow from its pressures. A solution has none above
        ``tolerance``."""
        return Table(self._raw.evaluate(state))


class ContactSolver(Protocol):
    """A solver of contacts. A plain function of the same arguments will do.

    The crate evaluates the state that is left: residuals above twice the tolerance are no solution, whatever is returned, and the status is
    ``unverified``. The result depends on problem and state alone."""

    def solve(self, problem: ContactProblem, state: ContactState) -> bool:
        """Leaves the best state found in ``state``; returns True where it has converged and False where it has not. Anything else is a
        :class:`~stribeck.LawError`."""


@dataclass(frozen=True)
class Growth:
    """A growth law from a function ``rate(at, thickness)`` [m/s] and the largest thickness [m]."""

    rate: Callable[[SurfaceStates, Field], npt.ArrayLike]
    maximum_thickness: float


def _callable(law: Any, method: str, field: str) -> Any:
    """The method of the law, or the law itself where it is a function."""
    from .errors import LawError

    if isinstance(law, type):
        kind = law.__name__
        raise LawError(f"the {field} is the class {kind}: give an instance of it, as {kind}()", field=field, value=law)
    call = getattr(law, method, law)
    if not callable(call):
        kind = type(law).__name__
        raise LawError(f"the {field} is a {kind}, neither a function nor with a method {method}", field=field, value=law)
    return call


def _with_method(law: Any, method: str, field: str) -> tuple[str, Any] | None:
    """A law as its identity and its function."""
    return None if law is None else (identity(law), _callable(law, method, field))


def _growth(law: Any) -> tuple[str, Any, float] | None:
    """A growth law with its largest thickness."""
    from .errors import LawError

    if law is None:
        return None
    call = _callable(law, "rate", "growth law")
    largest = getattr(law, "maximum_thickness", None)
    if not isinstance(largest, int | float | np.integer | np.floating) or not 0.0 < largest < float("inf"):
        message = f"growth law: maximum_thickness = {largest!r} [m]: must be finite and > 0"
        raise LawError(message, field="maximum_thickness", value=largest)
    return identity(law), call, float(largest)


def _of_pressure(law: Any, method: str, field: str) -> tuple[str, Any, bool] | None:
    """A law of pressure with whether it takes a temperature too."""
    if law is None:
        return None
    warm = hasattr(law, f"{method}_at")
    return identity(law), _callable(law, f"{method}_at" if warm else method, field), warm


def _motion(law: Any) -> tuple[str, Any, str] | None:
    """A motion with the places that it visits."""
    if law is None:
        return None
    return identity(law), _callable(law, "offset", "motion"), text("motion.visits", getattr(law, "visits", "track"))


def _solver(law: Any) -> tuple[str, Any] | None:
    """A solver with arguments of the classes of this module."""
    if law is None or isinstance(law, str):
        return None
    call = _callable(law, "solve", "solver")
    return identity(law), lambda raw, state: call(ContactProblem(raw), state)


def compiled(laws: dict[str, Any]) -> dict[str, Any]:
    """Laws by keyword as the compiled module takes them; those that are not named stay those of the scene."""
    deformation = _with_method(laws.get("deformation"), "displacement", "deformation model")
    more = [getattr(laws.get("deformation"), name, None) for name in ("pressure_estimate", "influence")]
    plasticity = _with_method(laws.get("plasticity"), "pressure_limit", "plasticity model")
    return {
        "growth": _growth(laws.get("growth")),
        "wear": _with_method(laws.get("wear"), "depth_rate", "wear law"),
        "friction": _with_method(laws.get("friction"), "coefficient", "boundary friction"),
        "deformation": None if deformation is None else (*deformation, more),
        "viscosity": _of_pressure(laws.get("viscosity"), "viscosity", "viscosity law"),
        "density": _of_pressure(laws.get("density"), "ratio", "density law"),
        "plasticity": None if plasticity is None else (*plasticity, bool(getattr(laws["plasticity"], "hardens", False))),
        "motion": _motion(laws.get("motion")),
        "solver": _solver(laws.get("solver")),
    }
