"""Names that type checkers know are those that there are."""

from __future__ import annotations

import subprocess
import sys
import typing
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

import stribeck
from stribeck._numbers import Numbers
from stribeck._typed import Expectation, Oil
from scene_tables import TABLES, explained, read, source


def compared(kind: type, table: Any) -> None:
    """The names of the class are those of the table, its numbers what the class says."""
    hints = {name.removesuffix("_"): hint for name, hint in typing.get_type_hints(kind).items() if not name.startswith("_")}
    slots = {slot for base in kind.__mro__ for slot in getattr(base, "__slots__", ())}
    names = {name for name in hints if name not in slots}
    assert names - {"edges_x", "edges_y"} == set(table) - {"grid", "warnings", "edges_x", "edges_y"}, kind
    for name in names:
        value, hint = table[name], hints[name]
        choices = (hint,) if typing.get_origin(hint) in (None, list) else typing.get_args(hint)
        kinds = tuple(typing.get_origin(part) or part for part in choices)
        inner = next((part for part in kinds if isinstance(part, type) and issubclass(part, Numbers)), None)
        if isinstance(value, Numbers):
            assert inner is not None, name
            if typing.get_type_hints(inner).keys() - Numbers.__annotations__.keys():
                compared(inner, value)
        elif not hasattr(value, "shape") and name not in ("edges_x", "edges_y"):
            assert isinstance(value, kinds), (kind, name, value)


def test_declared_names_are_those_of_results() -> None:
    scene = stribeck.Scene.azam_2019(16, tribofilm=True).replace(solver={"tolerance": 1e-3, "estimate": True})
    dry = stribeck.Scene.azam_2019(16).replace(roughness=None, plastic=None, wear=None, lubricant=None)
    warm = stribeck.Scene.azam_2019(16).replace(**{"lubricant.temperature": 353.15, "lubricant.roelands_s0": 1.1, "lubricant.thermal": {}})
    coated = stribeck.Scene(ROOT / "examples" / "scenes" / "coated.toml").replace(**{"grid.nx": 16, "grid.ny": 16}, stress={"yield_strength": 1e8})
    for case in (scene, dry, warm, coated):
        compared(stribeck.Solution, stribeck.solve(case))
    assert "stress" in coated.to_dict() and stribeck.solve(warm).thermal is not None
    compared(stribeck.Solution, stribeck.sweep(scene, {"load.force": [20.0]})[0])
    simulation = stribeck.Simulation(scene)
    compared(stribeck.Record, simulation.step(10.0))
    compared(stribeck.Body, simulation.bodies[1])
    compared(stribeck.Grid, scene.grid)
    compared(Expectation, scene.expectation())
    compared(Oil, scene.oil())
    grid = stribeck.Grid.box(20, 1, (0.0, 1e-2), (0.0, 1.0))
    film = stribeck.given_film(lambda x, y: 2e-6 - 1e-4 * x, grid, speeds=(0.02, 0.0), eta0=0.01)
    assert {"load", "force", "flow"} <= set(film)


def test_tables_of_scenes_are_those_of_the_crate() -> None:
    assert TABLES.read_text(encoding="utf-8") == source(), "run python/tests/scene_tables.py"


def test_keys_of_tables_are_those_that_are_explained() -> None:
    tables, _ = read()
    known = {f"{table}.{key}" for table, keys in tables.items() for key, kind in keys.items() if not kind[0].isupper()}
    own = set(explained(list(tables)))
    # kinds of roughness, laws of oils and schedules are explained by tables of their own
    apart = {path for path in known if path.startswith("schedule.") or path.endswith((".kind", "viscosity.law"))}
    assert known - apart <= own
    # keys of rigid bearings and flat contacts, which have calls of their own
    assert own - known == {"given_film.load", "given_film.roughness", "load.mean_pressure", "load.mean_gap", "grid.periodic"}


@pytest.mark.parametrize("file", sorted((ROOT / "examples" / "scenes").glob("*.toml")), ids=lambda file: file.stem)
def test_values_of_scenes_are_of_their_types(file: Path) -> None:
    try:
        scene = stribeck.Scene(file)
    except stribeck.SceneError:
        pytest.skip("a rigid bearing or a flat contact")

    def check(kind: type, table: Numbers) -> None:
        hints = {name: hint for name, hint in typing.get_type_hints(kind).items() if not name.startswith("_")}
        for name, value in table.items():
            hint = hints[f"{name}_" if hasattr(dict, name) else name]
            if isinstance(value, Numbers):
                check(hint, value)
            elif hint == list[float]:
                assert all(isinstance(entry, float) for entry in value), name
            else:
                assert isinstance(value, float | int if hint is float else hint), (kind, name, value)

    hints = typing.get_type_hints(stribeck.Scene)
    for name, table in Numbers(scene.to_dict()).items():
        if name != "grid":
            check(hints[name], table)


RIGHT = """
import numpy as np
import stribeck

scene = stribeck.Scene.azam_2019(32).replace(motion={"entrainment_speed": "0.5 m/s"})
faster = scene.replace(**{"motion.entrainment_speed": 2.0})
solution = stribeck.solve(scene)
central: float = solution.film.central
status: str = solution.status
iterations: int = solution.work.iterations
inflow: float = solution.flow.inflow if solution.flow is not None else 0.0
peak = float(solution.fields["pressure"].max())
simulation = stribeck.Simulation(scene)
history = simulation.run(2, "10 s", callback=lambda sim, record: record.contact.load_ratio < 0.01)
wear: float = history[-1].wear.disc_mean
speed: float = simulation.conditions.motion.entrainment_speed
times = history["time"].tolist()
sweep = stribeck.sweep(scene, {"motion.entrainment_speed": np.geomspace(0.1, 1.0, 3)})
over = {"motion.entrainment_speed": np.geomspace(0.1, 1.0, 3), "load.force": ["10 N", "20 N"]}
friction: float = stribeck.sweep(scene, over)[0].friction.coefficient
loads: list[float] = scene.schedule.load.values_
radius: float = scene.form.radius
rq: float = scene.roughness.disc.rq
cells: int = scene.grid.nx
peak_stress: float = solution.stress.von_mises.stress if solution.stress is not None else 0.0
rise: float = history[0].thermal.surface_rise_ball if history[0].thermal is not None else 0.0
hertz: float = stribeck.analytic.hertz_point(9.5e-3, equivalent_modulus=2.3e11, load=50.0).pressure
"""
WRONG = [
    "solution.no_such",
    "solution.film.centrall",
    "history[0].contact.no_such",
    "simulation.conditions.no_such",
    "scene.no_such",
    "scene.motion.no_such",
    "scene.roughness.disc.no_such",
    "scene.lubricant.viscosity.no_such",
    "sweep[0].no_such",
    "sweep[0].film.no_such",
    'solution.fields["film"] = solution.film',
    "scene.hertz().no_such",
    'simulation.load = "20 N"',
]


def test_type_checker_finds_names_that_there_are_not(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    script = tmp_path / "script.py"
    script.write_text(RIGHT + "\n".join(WRONG))
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(script)]
    found = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path).stdout
    first = len(RIGHT.splitlines()) + 1
    lines = [line for line in found.splitlines() if "script.py:" in line and "error" in line]
    assert [int(line.split(":")[1]) for line in lines] == list(range(first, first + len(WRONG))), found
