"""Conditions that change during a run, and parts of a run by their names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ._arguments import number, refused
from .errors import InputError, unknown
from .scene import Scene

#: Names that are conditions and no attributes of a simulation.
CONDITIONS = {"load", "motion", "entrainment_speed", "slide_roll_ratio", "bulk_temperature", "lubricant", "friction", "thermal", "schedule"}
#: Names of laws in checkpoints by their keywords.
PARTS = {
    "growth": "growth law",
    "wear": "wear law",
    "friction": "boundary friction",
    "deformation": "deformation model",
    "viscosity": "viscosity law",
    "density": "density law",
    "plasticity": "plasticity model",
    "motion": "motion",
    "solver": "solver",
    "squeeze": "squeeze",
}
#: Tables that may change during a run.
_TABLES = ("load", "motion", "lubricant", "friction", "thermal", "solver", "schedule")


def accepted(names: Iterable[str]) -> list[str]:
    """Names of parts as checkpoints have them."""
    if isinstance(names, str):
        raise refused("accept", names, f"a list of names, such as [{names!r}]")
    found = []
    for name in names:
        if name not in PARTS and not (isinstance(name, str) and name.startswith("scene.")):
            raise unknown("accept", name, [*PARTS, "scene.TABLE"])
        found.append(PARTS.get(name, name))
    return found


def changed(scene: Scene, tables: Mapping[str, Any], now: float) -> Scene:
    """The scene under the conditions of ``tables`` from the time ``now`` [s] on."""
    replaced: dict[str, Any] = {}
    for path, value in tables.items():
        name, _, key = path.partition(".")
        if name not in _TABLES:
            raise InputError(f"{path}: cannot change during a run; {', '.join(_TABLES)} can", field=path, value=value)
        replaced[name] = {**(replaced.get(name) or {}), key: value} if key else value
        if name != "load" and not isinstance(replaced[name], Mapping | None):
            raise refused(name, value, f"a table, such as {name}={{...}}, or a key by its path")
    if "load" in replaced and not isinstance(replaced["load"], Mapping):
        replaced["load"] = {"force": replaced["load"]}
    schedule = dict(scene.to_dict().get("schedule", {}))
    if "load" in replaced:
        schedule.pop("load", None)
    for table, keys in (("motion", ("entrainment_speed", "slide_roll_ratio")), ("thermal", ("bulk_temperature",))):
        for key in keys:
            if key in (replaced.get(table) or {}):
                schedule.pop(key, None)
    for key, series in (replaced.pop("schedule", None) or {}).items():
        schedule[key] = _later(key, series, now)
    # a table that is left out stays, so that keys which end are taken out of it
    without = {key: None for key in scene.to_dict().get("schedule", {}) if key not in schedule}
    return scene.replace(**replaced, schedule={**without, **schedule})


def _later(key: str, series: Any, now: float) -> Any:
    """A schedule whose times count from ``now``."""
    if isinstance(series, Mapping) and series.get("kind") == "constant":
        return series
    if not isinstance(series, Mapping) or not {"times", "values"} <= series.keys():
        raise refused(f"schedule.{key}", series, "a table with times and values, or a constant")
    times = [number(f"schedule.{key}.times[{k}]", time, "s") + now for k, time in enumerate(series["times"])]
    values = list(series["values"])
    if times and values and times[0] > 0.0:
        # schedules begin at the start of the run
        times, values = [0.0, *times], [values[0], *values]
    return {**series, "times": times, "values": values}
