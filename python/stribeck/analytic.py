"""Closed-form solutions of contacts; all SI."""

from __future__ import annotations

from ._numbers import Numbers
from . import _stribeck

__all__ = ["equivalent_modulus", "hertz_line", "hertz_point", "line_films", "point_films", "westergaard"]


def equivalent_modulus(first: tuple[float, float], second: tuple[float, float]) -> float:
    """``E'`` [Pa] of two bodies, each by its Young's modulus [Pa] and Poisson's ratio: ``2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2``."""
    return _stribeck.equivalent_modulus(list(first), list(second))


def hertz_point(
    radius_x: float,
    radius_y: float | None = None,
    *,
    equivalent_modulus: float,
    load: float | None = None,
    max_pressure: float | None = None,
) -> Numbers:
    """The contact of radii [m] by its load [N] or its maximum pressure [Pa]: ``half_width_x``, ``half_width_y`` [m], ``pressure``, ``mean_pressure``
    [Pa], ``force`` [N], ``area`` [m^2], ``approach`` [m]."""
    second = radius_x if radius_y is None else radius_y
    return Numbers(_stribeck.hertz_point(radius_x, second, equivalent_modulus, load, max_pressure))


def hertz_line(
    radius: float, *, equivalent_modulus: float, load: float | None = None, max_pressure: float | None = None
) -> Numbers:
    """The contact of parallel cylinders by its load [N/m] or its maximum pressure [Pa]: ``half_width`` [m], ``pressure`` [Pa], ``force`` [N/m]."""
    return Numbers(_stribeck.hertz_line(radius, equivalent_modulus, load, max_pressure))


def point_films(
    *,
    entrainment_speed: float,
    viscosity: float,
    pressure_viscosity: float,
    equivalent_modulus: float,
    radius: float,
    load: float,
    ellipticity: float = 1.0,
) -> Numbers:
    """Film formulas of a point contact: ``hamrock_dowson_central``, ``hamrock_dowson_minimum``, ``moes_central`` [m] and ``moes.m``, ``moes.l``.
    Speed in m/s, viscosity in Pa s, pressure-viscosity coefficient in 1/Pa, radius in m, load in N."""
    oil = [viscosity, pressure_viscosity]
    return Numbers(_stribeck.point_films(entrainment_speed, oil, [equivalent_modulus, radius], load, ellipticity))


def line_films(
    *,
    entrainment_speed: float,
    viscosity: float,
    pressure_viscosity: float,
    equivalent_modulus: float,
    radius: float,
    load: float,
) -> Numbers:
    """Film formulas of a line contact: ``dowson_toyoda_central``, ``dowson_minimum``, ``moes_central`` [m] and ``moes.m``, ``moes.l``. Load in N/m."""
    oil = [viscosity, pressure_viscosity]
    return Numbers(_stribeck.line_films(entrainment_speed, oil, [equivalent_modulus, radius], load))


def westergaard(*, amplitude: float, wavelength: float, equivalent_modulus: float, mean_pressure: float) -> Numbers:
    """The dry contact of a wavy surface with a flat: ``full_contact_pressure`` [Pa] and ``contact_half_width`` [m] under ``mean_pressure`` [Pa]."""
    return Numbers(_stribeck.westergaard(amplitude, wavelength, equivalent_modulus, mean_pressure))
