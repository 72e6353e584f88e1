"""Laws written in Python. They are called on whole fields: arrays of the shape ``(ny, nx)`` in, an array of that shape or one number
out. For estimates over the smooth contact they are also called with arrays of one value, so they must not count on a shape.

A law must give finite numbers, and the same ones for the same arguments. What it raises, and anything it returns that is not such a field,
ends the step with a :class:`~stribeck.LawError` and leaves the simulation as before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

__all__ = ["DeformationModel", "FrictionLaw", "Growth", "GrowthLaw", "RubbingPoints", "WearLaw"]

Field = npt.NDArray[np.float64]


@dataclass(frozen=True)
class RubbingPoints:
    """What the nodes of a surface feel during a step."""

    #: Total pressure, fluid and solid [Pa].
    pressure: Field
    #: Share of it that solid contact carries [Pa].
    solid_pressure: Field
    #: Shear stress on the surface [Pa].
    shear_stress: Field
    #: Surface temperature, bulk plus flash [K].
    temperature: Field
    #: Sliding speed between the surfaces [m/s].
    sliding_speed: Field
    #: Gap between the surfaces [m].
    film_thickness: Field
    #: Whether the node is in solid contact.
    in_contact: npt.NDArray[np.bool_]


class GrowthLaw(Protocol):
    """Growth of a tribofilm: a rate and the thickness that growth alone approaches [m]. The rate is integrated over steps of any
    length, as that of a law in Rust."""

    maximum_thickness: float

    def rate(self, at: RubbingPoints, thickness: Field) -> npt.ArrayLike:
        """Net growth rate [m/s] of films of ``thickness`` [m]; zero where nothing rubs."""


class WearLaw(Protocol):
    """Wear: the rate at which a body loses height. A plain function of the same arguments will do."""

    def depth_rate(self, at: RubbingPoints, film_thickness: Field) -> npt.ArrayLike:
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
    displacement, roughly: the better, the fewer iterations; without one each node is taken for itself."""

    def displacement(self, pressure: Field) -> npt.ArrayLike:
        """Displacement [m], the widening of the gap, under ``pressure`` [Pa]."""


@dataclass(frozen=True)
class Growth:
    """A growth law from a function ``rate(at, thickness)`` [m/s] and the largest thickness [m]."""

    rate: Callable[[RubbingPoints, Field], npt.ArrayLike]
    maximum_thickness: float


def identity(law: Any) -> str:
    """What tells a law from another one in a checkpoint: its name and its constants."""
    if isinstance(law, Growth):
        return f"{identity(law.rate)}(maximum_thickness={law.maximum_thickness!r})"
    if hasattr(law, "__qualname__"):
        return f"{law.__module__}.{law.__qualname__}"
    kind = type(law)
    constants = {k: v for k, v in sorted(getattr(law, "__dict__", {}).items()) if isinstance(v, int | float | str)}
    return f"{kind.__module__}.{kind.__qualname__}({constants})"


def pair(law: Any, method: str, field: str) -> tuple[str, Any] | None:
    """A law as its identity and its function."""
    from .errors import LawError

    if law is None:
        return None
    call = getattr(law, method, law)
    if not callable(call):
        kind = type(law).__name__
        raise LawError(f"the {field} is a {kind}, neither a function nor with a method {method}", field=field, value=law)
    return identity(law), call


def growth_triple(law: Any) -> tuple[str, Any, float] | None:
    """A growth law as its identity, its function and its largest thickness."""
    from .errors import LawError

    if law is None:
        return None
    largest = getattr(law, "maximum_thickness", None)
    try:
        thickness = float(largest)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        thickness = float("nan")
    if not 0.0 < thickness < float("inf"):
        message = f"growth law: maximum_thickness = {largest!r} [m]: must be finite and > 0"
        raise LawError(message, field="maximum_thickness", value=largest)
    named = pair(law, "rate", "growth law")
    assert named is not None
    return (*named, thickness)


def deformation_triple(model: Any) -> tuple[str, Any, Any] | None:
    """A deformation model as its identity, its displacement and its estimate of pressures."""
    named = pair(model, "displacement", "deformation model")
    return None if named is None else (*named, getattr(model, "pressure_estimate", None))
