"""Rough lubricated contacts that change as they rub: mixed elastohydrodynamic lubrication, plastic flattening, tribofilm growth and wear,
solved together on one grid.

All numbers are SI. Fields are arrays of the shape ``(ny, nx)``, x along the flow; heights point out of their body.

>>> import stribeck
>>> solution = stribeck.solve(stribeck.Scene.azam_2019(32))
>>> solution.status
'converged'
"""

from . import analytic, elastic, laws, metrics, plot, surface
from ._names import units
from ._stribeck import __version__, set_num_threads as _set_num_threads
from ._arguments import whole as _whole
from .benchmarks import Benchmark, benchmark
from .bodies import BodyStart, read_body
from .cycles import Cycle, cycle
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
from .film import GivenFilm, RigidBearing, given_film, rigid_bearing
from .flat import FlatContact, flat_contact
from .history import Body, History, Record, Simulation
from .scene import Grid, Scene
from .solution import Report, Solution, solve
from .sweeps import Point, Sweep, sweep

__all__ = [
    "Benchmark",
    "Body",
    "BodyStart",
    "BusyError",
    "CheckpointError",
    "Cycle",
    "FileError",
    "FlatContact",
    "GivenFilm",
    "Grid",
    "History",
    "InputError",
    "InterruptedSolve",
    "LawError",
    "NotConvergedError",
    "Point",
    "Record",
    "Report",
    "RigidBearing",
    "Scene",
    "SceneError",
    "ShapeError",
    "Simulation",
    "Solution",
    "SolverError",
    "StribeckError",
    "StribeckWarning",
    "SurfaceError",
    "Sweep",
    "UnknownNameError",
    "__version__",
    "analytic",
    "benchmark",
    "cycle",
    "elastic",
    "flat_contact",
    "given_film",
    "laws",
    "metrics",
    "plot",
    "read_body",
    "rigid_bearing",
    "set_num_threads",
    "solve",
    "surface",
    "sweep",
    "units",
]


def set_num_threads(threads: int) -> None:
    """Sets the number of threads of later work in this process; 0 is the default, which is that of the environment variable
    ``STRIBECK_NUM_THREADS``, else the number of processors. Fields of less than 2^15 nodes take one. Results do not depend on it."""
    _set_num_threads(_whole("threads", threads, most=1024))
