"""Closed-form solutions of contacts; numbers are SI, or text with a unit."""

from __future__ import annotations

from ._arguments import Quantity, number, numbers, optional_number
from ._numbers import Table
from . import _stribeck

__all__ = ["equivalent_modulus", "hertz_line", "hertz_point", "line_films", "point_films", "westergaard"]

#: Units by name.
_POINT = {
    "half_width_x": "m",
    "half_width_y": "m",
    "pressure": "Pa",
    "mean_pressure": "Pa",
    "force": "N",
    "area": "m^2",
    "approach": "m",
}
_LINE = {"half_width": "m", "pressure": "Pa", "force": "N/m"}
_FILMS = dict.fromkeys(
    ("hamrock_dowson_central", "hamrock_dowson_minimum", "dowson_toyoda_central", "dowson_minimum", "moes_central", "film_map.central"), "m"
)
_WAVE = {"full_contact_pressure": "Pa", "contact_half_width": "m"}


def equivalent_modulus(first: tuple[Quantity, float], second: tuple[Quantity, float]) -> float:
    """``E'`` [Pa] of two bodies, each by its Young's modulus [Pa] and Poisson's ratio: ``2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2``."""
    units = ("Pa", "1")
    return _stribeck.equivalent_modulus(numbers("first", first, units), numbers("second", second, units))


def hertz_point(
    radius_x: Quantity,
    radius_y: Quantity | None = None,
    *,
    equivalent_modulus: Quantity,
    load: Quantity | None = None,
    max_pressure: Quantity | None = None,
) -> Table:
    """The contact of radii [m] by its load [N] or its maximum pressure [Pa]: ``half_width_x``, ``half_width_y`` [m], ``pressure``, ``mean_pressure``
    [Pa], ``force`` [N], ``area`` [m^2], ``approach`` [m]."""
    return Table(
        _stribeck.hertz_point(
            number("radius_x", radius_x, "m"),
            number("radius_y", radius_x if radius_y is None else radius_y, "m"),
            number("equivalent_modulus", equivalent_modulus, "Pa"),
            optional_number("load", load, "N"),
            optional_number("max_pressure", max_pressure, "Pa"),
        ),
        units=_POINT,
    )


def hertz_line(
    radius: Quantity, *, equivalent_modulus: Quantity, load: Quantity | None = None, max_pressure: Quantity | None = None
) -> Table:
    """The contact of parallel cylinders by its load [N/m] or its maximum pressure [Pa]: ``half_width`` [m], ``pressure`` [Pa], ``force`` [N/m]."""
    return Table(
        _stribeck.hertz_line(
            number("radius", radius, "m"),
            number("equivalent_modulus", equivalent_modulus, "Pa"),
            optional_number("load", load, "N/m"),
            optional_number("max_pressure", max_pressure, "Pa"),
        ),
        units=_LINE,
    )


def point_films(
    *,
    entrainment_speed: Quantity,
    eta0: Quantity,
    alpha: Quantity,
    equivalent_modulus: Quantity,
    radius: Quantity,
    load: Quantity,
    ellipticity: float = 1.0,
) -> Table:
    """Film formulas of a point contact: ``hamrock_dowson_central``, ``hamrock_dowson_minimum``, ``moes_central``, ``film_map.central`` [m], the
    last by the regime ``film_map.regime``, and ``moes.m``, ``moes.l``. Speed in m/s, viscosity in Pa s, pressure-viscosity coefficient in 1/Pa, radius in m, load in N."""
    speed = number("entrainment_speed", entrainment_speed, "m/s")
    oil, solid = _oil(eta0, alpha), _solid(equivalent_modulus, radius)
    loads = number("load", load, "N"), number("ellipticity", ellipticity, "1")
    return Table(_stribeck.point_films(speed, oil, solid, *loads), units=_FILMS)


def line_films(
    *,
    entrainment_speed: Quantity,
    eta0: Quantity,
    alpha: Quantity,
    equivalent_modulus: Quantity,
    radius: Quantity,
    load: Quantity,
) -> Table:
    """Film formulas of a line contact: ``dowson_toyoda_central``, ``dowson_minimum``, ``moes_central``, ``film_map.central`` [m],
    the last by the regime ``film_map.regime``, and ``moes.m``, ``moes.l``. Load in N/m."""
    speed = number("entrainment_speed", entrainment_speed, "m/s")
    oil, solid = _oil(eta0, alpha), _solid(equivalent_modulus, radius)
    return Table(_stribeck.line_films(speed, oil, solid, number("load", load, "N/m")), units=_FILMS)


def westergaard(*, amplitude: Quantity, wavelength: Quantity, equivalent_modulus: Quantity, mean_pressure: Quantity) -> Table:
    """The dry contact of a wavy surface with a flat: ``full_contact_pressure`` [Pa] and ``contact_half_width`` [m] under ``mean_pressure`` [Pa]."""
    return Table(
        _stribeck.westergaard(
            number("amplitude", amplitude, "m"),
            number("wavelength", wavelength, "m"),
            number("equivalent_modulus", equivalent_modulus, "Pa"),
            number("mean_pressure", mean_pressure, "Pa"),
        ),
        units=_WAVE,
    )


def _oil(eta0: Quantity, alpha: Quantity) -> list[float]:
    return [number("eta0", eta0, "Pa s"), number("alpha", alpha, "1/Pa")]


def _solid(equivalent_modulus: Quantity, radius: Quantity) -> list[float]:
    return [number("equivalent_modulus", equivalent_modulus, "Pa"), number("radius", radius, "m")]
