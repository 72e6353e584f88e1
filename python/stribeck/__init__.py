"""Rough lubricated contacts that change as they rub: mixed elastohydrodynamic lubrication, plastic flattening, tribofilm growth and wear,
solved together on one grid.

All numbers are SI. Fields are arrays of the shape ``(ny, nx)``, x along the flow; heights point out of their body.

>>> import stribeck
>>> solution = stribeck.solve(stribeck.Scene.azam_2019(32))
>>> solution.status
'converged'
"""

from . import analytic, elastic, laws, metrics, surface
from ._stribeck import __version__
from .errors import (
    BusyError,
    CheckpointError,
    FileError,
    InputError,
    InterruptedSolve,
    LawError,
    NotConvergedError,
    SceneError,
    ShapeError,
    SolverError,
    StribeckError,
    StribeckWarning,
    SurfaceError,
    UnknownNameError,
)
from .film import GivenFilm, given_film
from .history import Body, BodyStart, History, Record, Simulation, read_body
from .scene import Grid, Scene
from .solution import Report, Solution, solve

__all__ = [
    "Body",
    "BodyStart",
    "BusyError",
    "CheckpointError",
    "FileError",
    "GivenFilm",
    "Grid",
    "History",
    "InputError",
    "InterruptedSolve",
    "LawError",
    "NotConvergedError",
    "Record",
    "Report",
    "Scene",
    "SceneError",
    "ShapeError",
    "Simulation",
    "Solution",
    "SolverError",
    "StribeckError",
    "StribeckWarning",
    "SurfaceError",
    "UnknownNameError",
    "__version__",
    "analytic",
    "elastic",
    "given_film",
    "laws",
    "metrics",
    "read_body",
    "solve",
    "surface",
]
