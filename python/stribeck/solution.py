"""Single contacts."""

from __future__ import annotations

import logging
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import Quantity, instance, named, number, optional_heights, path as _path, refused, text, writing
from ._held import held
from ._numbers import Fields, Numbers, dataset, flat, frame
from ._solved import Report, Solved
from ._stribeck import solve as _solve
from ._typed import SolvedContact
from .bodies import BodyStart
from .errors import InputError, InterruptedSolve, StribeckWarning, found, say
from .laws import ContactSolver, DeformationModel, DensityLaw, FrictionLaw, PlasticityModel, ViscosityLaw
from .scene import Grid, Nodes, Scene, as_scene

__all__ = ["Report", "Solution", "solve"]

Heights = npt.ArrayLike | tuple[npt.ArrayLike | None, npt.ArrayLike | None] | Mapping[str, npt.ArrayLike | None] | None


_log = logging.getLogger("stribeck")

#: Fields that a solve can start from.
_STARTS = {"pressure", "fluid_pressure", "film", "theta", "plastic_depth", "in_contact"}


class Solution(Solved, SolvedContact):
    """A solved contact. Numbers have the names of the command's JSON, all SI: ``film.central``, ``film.lambda_``,
    ``contact.load_ratio``, ``friction.coefficient``, ``residual.mass``, ``status``, ``warnings`` and so on.

    ``fields`` holds maps of the shape ``(ny, nx)`` by name: ``pressure``, ``fluid_pressure`` [Pa], ``film``, ``gap``, ``plastic_depth`` [m],
    ``theta`` (filled share of the gap) and ``in_contact``; with ``lubricant.thermal`` also ``film_temperature`` [K]. They are read-only;
    ``fields["film"].copy()`` can be changed.
    """

    __slots__ = ("_nodes", "fields", "scene")

    fields: Mapping[str, npt.NDArray[Any]]
    _nodes: Nodes | None
    #: The scene that was solved; None for a contact of bodies within a history.
    scene: Scene | None

    def __init__(
        self,
        values: Mapping[str, Any],
        fields: Mapping[str, npt.NDArray[Any]] | None = None,
        nodes: Nodes | None = None,
        scene: Scene | None = None,
    ) -> None:
        super().__init__(values)
        object.__setattr__(self, "scene", scene)
        object.__setattr__(self, "fields", Fields.read_only(fields or {}))
        object.__setattr__(self, "_nodes", nodes)

    @property
    def grid(self) -> Grid:
        """The cells of the fields."""
        return Grid(self["grid"].to_dict(), self._nodes)

    @property
    def warnings(self) -> list[StribeckWarning]:
        """Warnings of the scene, its surfaces and the solution."""
        return found(self["warnings"])

    def save_fields(self, path: str | os.PathLike[str]) -> None:
        """Writes the fields as a NumPy archive (npz) of this very name, with the positions ``x`` and ``y`` of the nodes [m]."""
        grid = self.grid
        arrays: dict[str, Any] = {"x": grid.x, "y": grid.y, **self.fields}
        place = _path("path", path)
        with writing(place), open(place, "wb") as file:
            np.savez_compressed(file, **arrays)

    def __eq__(self, other: object) -> bool:
        """Whether both are the same contact with the same fields, whatever seconds it took."""
        if not isinstance(other, Solution):
            return NotImplemented
        same = self.fields.keys() == other.fields.keys() and self.scene == other.scene and self["status"] == other["status"]
        return same and all(np.array_equal(field, other.fields[name]) for name, field in self.fields.items())

    __hash__ = None  # type: ignore[assignment]

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of one row: the values of the scene, ``scene.load.force``, beside the numbers, ``film.central``;
        ``attrs["units"]`` are the units of its columns."""
        inputs = {} if self.scene is None else flat(Numbers(self.scene.to_dict()), "scene.")
        return frame({name: [value] for name, value in {**inputs, **flat(self)}.items()})

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` of the fields over ``y`` and ``x`` [m], with units; its attributes are the numbers by their full names and the
        scene as the text of a file. ``to_netcdf`` and ``to_zarr`` write it as it is."""
        scene = None if self.scene is None else self.scene.to_toml()
        return dataset(self.fields, self.grid.x, self.grid.y, {**flat(self), "scene": scene})

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(), self.fields, self._nodes, self.scene)


def solve(
    scene: Scene | Mapping[str, Any] | str | os.PathLike[str],
    *,
    heights: Heights = None,
    bodies: tuple[BodyStart | None, BodyStart | None] | None = None,
    friction: FrictionLaw | Any = None,
    deformation: DeformationModel | Any = None,
    viscosity: ViscosityLaw | Any = None,
    density: DensityLaw | Any = None,
    plasticity: PlasticityModel | Any = None,
    solver: str | ContactSolver | Any = None,
    start: Solution | None = None,
    budget: Quantity | None = None,
) -> Solution:
    """Solves the single contact of ``scene``, surfaces as they are.

    ``heights`` [m], positive out of the body, shape ``(ny, nx)`` of the scene's grid: an array for the disc, a pair for ball and disc, or a
    dictionary with the keys ``ball`` and ``disc``. ``bodies`` are ball and disc of an earlier run. ``friction`` is a law of solid contact,
    ``deformation`` a model of the elastic bodies, ``viscosity`` and ``density`` are laws of the lubricant, ``plasticity`` is the largest pressure of the
    bodies (:mod:`stribeck.laws`). ``solver`` is the name of a solver in place of that of the scene, or one in Python, ``start`` a solution on the same
    grid whose pressures are a first guess. After ``budget`` [s] the solve ends with :class:`~stribeck.InterruptedSolve`, at its next iteration or
    between two parts of its preparation, refined grids included. Other threads run meanwhile; Ctrl-C ends the solve. The logger ``stribeck`` logs status and work of each solve at the level ``INFO``. Implausible input is issued as a
    :class:`~stribeck.StribeckWarning` and listed in ``warnings`` of the solution.

    Not converging is a status, see :meth:`Solution.require_converged`. Raises :class:`~stribeck.InputError` with ``field`` and ``value``
    for a scene that cannot be solved.
    """
    given = {"friction": friction, "deformation": deformation, "viscosity": viscosity, "density": density, "plasticity": plasticity}
    solution = _solution(scene, heights=heights, bodies=bodies, solver=solver, start=start, budget=budget, **given)
    say(solution.warnings, 2)
    return solution


def _solution(
    scene: Any,
    *,
    heights: Any = None,
    bodies: Any = None,
    solver: Any = None,
    start: Any = None,
    budget: Any = None,
    **laws: Any,
) -> Solution:
    """The solution of :func:`solve`, whose warnings are not said."""
    seconds = _budget(budget)
    chosen = with_solver(as_scene(scene), solver)
    keeper, called = held({**laws, "solver": solver})
    given = parts(heights, bodies, called)
    with named(named_parts(given, bodies)):
        try:
            solution = Solution(*_solve(chosen._raw, given, first_state(start, chosen), seconds), scene=chosen)
        except InterruptedSolve as error:
            raise InterruptedSolve(f"{error}: its budget of {seconds:g} s is spent", field="budget", value=budget) from None
    del keeper
    _log.info(
        "contact %s: %s with %d iterations, %.0f convolutions, %.3g s",
        solution["status"],
        solution["solver"],
        solution["work"]["iterations"],
        solution["work"]["convolutions"],
        solution["seconds"],
    )
    return solution


def _budget(budget: Any) -> float | None:
    """Seconds that a solve may take, more than none."""
    if budget is None:
        return None
    seconds = number("budget", budget, "s")
    if not seconds > 0.0:
        raise refused("budget", budget, "seconds, more than 0")
    return seconds


def first_state(start: Any, scene: Scene) -> dict[str, Any] | None:
    """Fields and approach of the solution that the contact of ``scene`` starts from."""
    if start is None:
        return None
    instance("start", start, Solution, "a solution on the same grid")
    if not _STARTS <= start.fields.keys():
        raise refused("start", start, f"a solution with the fields {', '.join(sorted(_STARTS))}")
    if "accuracy" not in scene.to_dict().get("grid", {}) and not _same_box(start.grid, scene.grid):
        raise refused("start", start, "a solution on the grid of the scene, its own box is another")
    return {**start.fields, "approach": start["approach"]}


def _same_box(grid: Grid, other: Grid) -> bool:
    """Whether edges are the same but for rounding; numbers of cells are compared with the fields."""
    ours, theirs = (np.array([*cells["edges_x"], *cells["edges_y"]]) for cells in (grid, other))
    return bool(np.all(np.abs(ours - theirs) <= 1e-6 * grid["dx"]))


def with_solver(scene: Scene, solver: Any) -> Scene:
    """The scene with the solver of this name, if it is one."""
    return scene.replace(solver={"kind": text("solver", solver)}) if isinstance(solver, str) else scene


def parts(
    heights: Heights,
    bodies: tuple[BodyStart | None, BodyStart | None] | None,
    laws: dict[str, Any],
) -> dict[str, Any]:
    """Replacements of parts of a scene, converted for the compiled module."""
    ball, disc = _both(heights)
    ball_start, disc_start = _two("bodies", bodies) if bodies is not None else (None, None)
    for name, body in (("ball", ball_start), ("disc", disc_start)):
        if body is not None:
            instance(f"bodies ({name})", body, BodyStart, "a BodyStart, as of Simulation.starts()")
    return {
        "ball_heights": optional_heights("ball_heights", ball),
        "disc_heights": optional_heights("disc_heights", disc),
        "ball_start": ball_start and ball_start._raw,
        "disc_start": disc_start and disc_start._raw,
        "laws": laws,
    }


def named_parts(given: dict[str, Any], bodies: Any) -> dict[str, Any]:
    """The parts of :func:`parts` as they were given, by the names that errors have for them."""
    ball, disc = bodies or (None, None)
    return {**given, "ball_start": ball, "disc_start": disc}


def _both(heights: Heights) -> tuple[Any, Any]:
    if heights is None:
        return None, None
    if isinstance(heights, Mapping):
        for name in heights:
            if name not in ("ball", "disc"):
                raise InputError(f"heights: unknown body {name!r}, expected ball and disc", field="heights", value=name)
        return heights.get("ball"), heights.get("disc")
    return _two("heights", heights) if isinstance(heights, tuple) else (None, heights)


def _two(name: str, bodies: Any) -> tuple[Any, Any]:
    """Something of ball and disc."""
    if not isinstance(bodies, tuple | list):
        raise InputError(f"{name} = {bodies!r}: must be a pair, that of the ball and that of the disc", field=name, value=bodies)
    if len(bodies) != 2:
        raise InputError(f"{name}: {len(bodies)} bodies, expected ball and disc", field=name, value=len(bodies))
    ball, disc = bodies
    return ball, disc
