"""Many contacts: one scene under all combinations of some of its values."""

from __future__ import annotations

import itertools
import json
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal

import numpy as np

from ._arguments import function, path as _path, refused, whole, writing
from ._executors import LOST, Result, results
from ._identity import identity
from ._numbers import Numbers, flat
from .errors import InputError, StribeckError, unknown
from .points import Point, Sweep
from .scene import Scene, as_scene
from .solution import Solution, _solution

__all__ = ["Point", "Sweep", "sweep"]

#: Format of the files of a folder.
_FORMAT = 1
#: Status of a point whose solve raised.
_REFUSED = "refused"
#: Parts of a result without an error, and their types.
_PARTS: dict[str, Any] = {
    "values": dict,
    "status": str,
    "error": type(None),
    "measured": bool | int | float | str | dict | None,
    "warnings": list,
}
#: Keywords of a solve that a sweep hands on.
_GIVEN = ("heights", "bodies", "friction", "deformation", "viscosity", "density", "plasticity", "solver", "budget")

Measure = Callable[[Solution], Any]


def sweep(
    scene: Scene | Mapping[str, Any] | str | os.PathLike[str],
    over: Mapping[str, Any],
    *,
    how: Literal["product", "zip"] = "product",
    measure: Measure | None = None,
    executor: Any = None,
    folder: str | os.PathLike[str] | None = None,
    shard: tuple[int, int] | None = None,
    progress: bool = True,
    **given: Any,
) -> Sweep:
    """Solves the contact of ``scene`` with other values of the keys ``over``.

    Parameters
    ----------
    scene
        A scene, or any argument of :class:`Scene`.
    over
        Lists or arrays of values by the paths of their keys: ``{"motion.entrainment_speed": [0.1, 0.2], "load.force": ["10 N", "20 N"]}``.
    how
        ``"product"`` for all combinations, the last key fastest, ``"zip"`` for values side by side.
    measure
        ``measure(solution)`` returns a number, text or a dictionary of those, which become columns.
    executor
        An executor of ``concurrent.futures``, such as threads (the default, one a processor), processes or ``mpi4py.futures``, a ``Client`` of
        dask, or a ``joblib.Parallel``. It stays open.
    folder
        Points that are done are kept there, and not solved again by a later call; those with an error are.
    shard
        ``(i, n)`` solves the points i, i + n, ... alone, for arrays of jobs with one folder.
    progress
        A bar, where tqdm is installed and standard error is a terminal.
    **given
        Heights, bodies, laws, solver and the budget of each point as for :func:`solve`.

    Returns
    -------
    Sweep
        All points, with those that were refused or did not converge; of a shard those that are done.

    Raises
    ------
    InputError
        Lists of different lengths to zip, or a folder of another sweep or with other files.
    SceneError
        A key that the scene does not have.

    Examples
    --------
    >>> import stribeck
    >>> scene = stribeck.Scene.azam_2019(16).replace(solver={"tolerance": 1e-3})
    >>> curve = stribeck.sweep(scene, {"motion.entrainment_speed": [0.1, 0.4]})
    >>> curve["status"].tolist()
    ['converged', 'converged']
    """
    for name in given:
        if name not in _GIVEN:
            raise unknown("sweep", name, _GIVEN)
    function("measure", measure)
    base = as_scene(scene)
    axes, scenes = _points(base, over, how)
    keys = list(over)
    inputs = [{key: _value(point.to_dict(), key) for key in keys} for point in scenes]
    place = None if folder is None else _prepared(_path("folder", folder), base, axes, how, measure, given)
    first, step = (0, 1) if shard is None else _shard(shard)
    tasks = [(point, given, measure, _file(place, k)) for k, point in enumerate(scenes) if k % step == first]
    done = {k: result for k in range(len(scenes)) if (result := _kept(_file(place, k))) is not None}
    todo = [(k, task) for k, task in zip(range(first, len(scenes), step), tasks, strict=True) if k not in done]
    for k, result in results(_solved, executor, todo, progress):
        # a point may be in its file though its executor died
        done[k] = (_kept(_file(place, k)) or result) if result["status"] == LOST else result
    points = [Point(inputs[k], done[k]) for k in sorted(done)]
    is_whole = len(points) == len(scenes)
    known = axes if is_whole else {key: [point.inputs[key] for point in points] for key in keys}
    return Sweep(points, _in_si(known, inputs, how) if is_whole else known, how == "product" and is_whole)


def _points(scene: Scene, over: Mapping[str, Any], how: str) -> tuple[dict[str, list[Any]], list[Scene]]:
    """Values by key, and the scenes of all points."""
    if how not in ("product", "zip"):
        raise refused("how", how, "product or zip")
    if not isinstance(over, Mapping) or not over:
        raise refused("over", over, "a dictionary of values by the keys of the scene")
    axes = {}
    for key, values in over.items():
        if not isinstance(key, str):
            raise refused("over", key, "keys of the scene by their paths, such as motion.entrainment_speed")
        if isinstance(values, str | bytes) or not isinstance(values, Iterable):
            raise refused(f"over[{key!r}]", values, "a list of values")
        axes[key] = [value.item() if isinstance(value, np.generic) else value for value in values]
    lengths = {key: len(values) for key, values in axes.items()}
    if how == "zip" and len(set(lengths.values())) > 1:
        raise InputError(f"over: lists of different lengths to zip: {lengths}", field="over", value=lengths)
    combined = itertools.product(*axes.values()) if how == "product" else zip(*axes.values(), strict=True)
    return axes, [scene.replace(**dict(zip(axes, values, strict=True))) for values in combined]


def _in_si(axes: dict[str, list[Any]], inputs: list[dict[str, Any]], how: str) -> dict[str, list[Any]]:
    """Values of the axes as numbers in SI units."""
    if how == "zip":
        return {key: [point[key] for point in inputs] for key in axes}
    found, stride = {}, len(inputs)
    for key, values in axes.items():
        stride //= max(len(values), 1)
        found[key] = [inputs[stride * k][key] for k in range(len(values))] if inputs else []
    return found


def _value(tables: Any, key: str) -> Any:
    for part in key.split("."):
        tables = tables.get(part) if isinstance(tables, dict) else None
    return tables


def _shard(shard: Any) -> tuple[int, int]:
    try:
        place, count = shard
    except (TypeError, ValueError):
        raise refused("shard", shard, "two whole numbers (i, n) with i < n") from None
    first, step = whole("shard[0]", place), whole("shard[1]", count)
    if first >= step:
        raise refused("shard", shard, "two whole numbers (i, n) with i < n")
    return first, step


def _solved(task: tuple[Scene, Mapping[str, Any], Measure | None, str | None]) -> Result:
    """Solves one point, here or in another process, and keeps it in its file."""
    scene, given, measure, file = task
    try:
        solution = _solution(scene, **given)
    except StribeckError as error:
        result: Result = {"values": {}, "status": _REFUSED, "error": f"{type(error).__name__}: {error}", "measured": None, "warnings": []}
    else:
        values = solution.to_dict()
        result = {"values": values, "status": values["status"], "error": None, "measured": None, "warnings": values.pop("warnings")}
        if measure is not None:
            try:
                result["measured"] = _own_names(_plain(measure(solution)), values)
            except (Exception, SystemExit) as error:  # noqa: BLE001
                result["error"] = f"measure: {type(error).__name__}: {error}"
    _keep(file, result)
    return result


def _own_names(measured: Any, values: Mapping[str, Any]) -> Any:
    """The measure, whose names are none of those of a solution."""
    taken = {"status", "error", *flat(Numbers(values))}
    twice = sorted(taken & measured.keys()) if isinstance(measured, dict) else []
    if twice:
        raise ValueError(f"{twice[0]!r} is a number of the solution; take another name")
    return measured


def _plain(measured: Any) -> Any:
    """A returned measure as numbers, text and dictionaries of those."""
    if isinstance(measured, Mapping):
        return {str(key): _plain(value) for key, value in measured.items()}
    if isinstance(measured, np.generic | np.ndarray) and np.ndim(measured) == 0:
        return measured.item()
    if measured is None or isinstance(measured, bool | int | float | str):
        return measured
    raise TypeError(f"it returned a {type(measured).__name__}, expected numbers, text or a dictionary of them")


def _file(place: str | None, k: int) -> str | None:
    return None if place is None else os.path.join(place, f"point_{k:06d}.json")


def _keep(file: str | None, result: Result) -> None:
    """Writes a result as a whole: a process that is killed leaves no half of it."""
    if file is None:
        return
    part = f"{file}.{os.getpid()}.part"
    with writing(file):
        with open(part, "w", encoding="utf-8") as out:
            json.dump(result, out)
        os.replace(part, file)


def _kept(file: str | None) -> Result | None:
    """The result in a file, if it holds one without an error."""
    if file is None or not os.path.exists(file):
        return None
    try:
        with writing(file), open(file, encoding="utf-8") as text:
            result = json.load(text)
    except ValueError:
        return None
    return result if isinstance(result, dict) and result.keys() == _PARTS.keys() and _is_sound(result) else None


def _is_sound(result: Mapping[str, Any]) -> bool:
    """Whether the parts of a result without an error are of their types."""
    has_types = all(isinstance(result[name], kind) for name, kind in _PARTS.items())
    warnings = result["warnings"] if has_types else []
    return has_types and "status" in result["values"] and all(isinstance(warning, dict) for warning in warnings)


def _prepared(
    place: str, scene: Scene, axes: Mapping[str, list[Any]], how: str, measure: Measure | None, given: Mapping[str, Any]
) -> str:
    """Makes the folder of a sweep, or refuses one that another sweep has made."""
    own_values = {name: value for name, value in given.items() if value is not None and name != "budget"}
    laws = {name: value if isinstance(value, str) else identity(value) for name, value in own_values.items()}
    own = {
        "format": _FORMAT,
        "scene": scene.to_toml(),
        "over": {key: [str(value) for value in values] for key, values in axes.items()},
        "how": how,
        "measure": None if measure is None else identity(measure),
        "given": laws,
    }
    file = os.path.join(place, "sweep.json")
    with writing(place):
        os.makedirs(place, exist_ok=True)
    if os.path.exists(file):
        try:
            with writing(file), open(file, encoding="utf-8") as text:
                other = json.load(text)
        except ValueError:
            other = None
        differ = [name for name in own if not isinstance(other, dict) or other.get(name) != own[name]]
        if differ:
            message = f"folder: {place} holds another sweep: it differs in {', '.join(differ)}; take another folder"
            raise InputError(message, field="folder", value=place)
    else:
        others = [name for name in sorted(os.listdir(place)) if not name.startswith(("point_", "sweep.json"))]
        if others:
            raise InputError(f"folder: {place} holds other files ({others[0]}, ...); take a new folder", field="folder", value=place)
        _keep(file, own)
    return place
