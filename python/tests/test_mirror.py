"""The command and the examples of the crate in Python: equal numbers to the last bit."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from conftest import ROOT, SCENES, run_command, run_example

import stribeck


def near(found: object, expected: object) -> bool:
    """Equal up to rounding: the checks build the command at another optimization level than the package, at which powers in
    the response of a layer round differently."""
    if isinstance(expected, dict):
        return isinstance(found, dict) and all(near(found[key], value) for key, value in expected.items())
    if isinstance(expected, float):
        return found == pytest.approx(expected, rel=1e-6, abs=1e-9)
    return found == expected


@pytest.mark.parametrize("name", ["smooth", "rough", "rough_dry", "line", "coated", "ground_disc"])
def test_solve_equals_the_command(name: str, tmp_path) -> None:
    path, fields = SCENES / f"{name}.toml", tmp_path / "fields.npz"
    expected = run_command("solve", str(path), "--fields", str(fields))
    solution = stribeck.solve(path)
    compared = 0
    for key, value in expected.items():
        if key in ("oil", "seconds", "warnings"):
            continue
        found = solution.to_dict()[key]
        if name == "coated":
            assert near(found, value), key
        elif isinstance(value, dict):
            assert {k: found[k] for k in value} == value, key
        else:
            assert found == value, key
        compared += 1
    assert compared > 15
    with np.load(fields) as archive:
        solution.save_fields(tmp_path / "own.npz")
        again = pickle.loads(pickle.dumps(solution))
        with np.load(tmp_path / "own.npz") as own:
            for axis in ("x", "y"):
                np.testing.assert_array_equal(archive[axis], own[axis])
                for grid in (solution.grid, again.grid, pickle.loads(pickle.dumps(solution.grid))):
                    np.testing.assert_array_equal(archive[axis], getattr(grid, axis))
        for field in archive.keys() - {"x", "y"}:
            values = archive[field]
            rounding = 1e-9 * np.abs(values).max() if name == "coated" else 0.0
            np.testing.assert_allclose(solution.fields[field], values, rtol=0.0, atol=rounding, err_msg=field)


@pytest.mark.parametrize(("name", "steps"), [("dry_history", 4), ("rough", 2), ("running_in", 3)])
def test_a_history_equals_the_command(name: str, steps: int, tmp_path) -> None:
    path, csv = SCENES / f"{name}.toml", tmp_path / "history.csv"
    expected = run_command("run", str(path), "--steps", str(steps), "--time-step", "30", "--csv", str(csv))
    simulation = stribeck.Simulation(path)
    history = simulation.run(steps, 30.0)
    last = history[-1]
    assert last.friction.coefficient == expected["friction"]["coefficient"]
    assert last.film.lambda_ == expected["film"]["lambda"]
    assert last.roughness.disc_rq == expected["roughness"]["disc_rq"]
    assert simulation.time == expected["time"]
    assert simulation.bodies[1].worn_profile.tolist() == expected["worn_profile"]["disc"]
    header, *rows = [line.split(",") for line in csv.read_text().splitlines()]
    table = history.to_numpy()
    names = table.dtype.names
    assert header == [heading(name) for name in names]
    for row, record in zip(rows, table, strict=True):
        for name, cell in zip(names, row, strict=True):
            found = record[name]
            if isinstance(found, str):
                assert cell == found
            elif cell == "":
                assert math.isnan(found)
            else:
                assert float(cell) == found, name


def heading(name: str) -> str:
    """What a history file calls a column: its name with the unit behind it."""
    unit = stribeck.History.columns[name].replace("/", "_").replace("^", "").lower()
    return name.replace(".", "_") + (f"_{unit}" if unit else "")


class PowerDriven:
    """The law of the example `custom_growth_law`."""

    maximum_thickness = 150e-9

    def rate(self, at, thickness):
        left = 1.0 - thickness / self.maximum_thickness
        return 4e-16 * at.shear_stress * at.sliding_speed * left * left


def test_a_growth_law_in_python_is_that_in_rust() -> None:
    simulation = stribeck.Simulation(stribeck.Scene.azam_2019(32), growth=PowerDriven())
    history = simulation.run(6, 600.0)
    lines = [f"{r.time:5.0f} s  mean film on the disc {r.tribofilm.disc_mean * 1e9:6.2f} nm" for r in history]
    assert lines == run_example("custom_growth_law").splitlines()
    assert history[-1].tribofilm.disc_mean > 20e-9


def test_laws_in_python_are_those_of_the_crate_to_the_last_bit() -> None:
    scene = stribeck.Scene.azam_2019(32)
    rate, coefficient = (5.45e-8 / 6e9), 0.115
    own = stribeck.Simulation(
        scene,
        wear=lambda at, film: rate * np.maximum(at.pressure, 0.0) * np.abs(at.sliding_speed),
        friction=lambda pressure, speed, ball, disc: coefficient,
    )
    crate = stribeck.Simulation(scene)
    for _ in range(3):
        assert same(own.step(60.0), crate.step(60.0))


def same(one: stribeck.Record, other: stribeck.Record) -> bool:
    """Whether all numbers are equal; what is not modelled is so in both."""
    return all(a == b or (a != a and b != b) for a, b in zip(one.values(), other.values(), strict=True))


def test_smooth_films_are_those_of_the_example_smooth_ehl() -> None:
    rows = [line.split() for line in run_example("smooth_ehl").splitlines()[2:]]
    scene = stribeck.Scene.azam_2019(64).replace(
        roughness=None, plastic=None, load={"hertz_pressure": 0.5e9}, lubricant={"eta0": 0.04, "roelands_z": 0.6}
    )
    a = scene.hertz().half_width_x
    grid = {"nx": 96, "ny": 64, "x": [-4.0 * a, 2.0 * a], "y": [-2.5 * a, 2.5 * a]}
    for speed, central, _, minimum, _ in rows:
        solution = stribeck.solve(scene.replace(grid=grid, motion={"entrainment_speed": float(speed)}))
        solution.require_converged()
        assert f"{solution.film.central * 1e9:.1f}" == central
        assert f"{solution.film.minimum * 1e9:.1f}" == minimum


def test_a_measured_surface_runs_as_in_its_example() -> None:
    surface = stribeck.surface.read(ROOT / "tests/data/surfaces/cut.x3p")
    scene = stribeck.Scene.azam_2019(64, tribofilm=True).replace(
        form={"kind": "sphere", "radius": 1e-3}, load={"hertz_pressure": 0.8e9}, solver={"tolerance": 1e-3}
    )
    a = scene.hertz().half_width_x
    edges = [-2.0 * a, 2.0 * a]
    scene = scene.replace(grid={"nx": 64, "ny": 64, "x": edges, "y": edges})
    heights = surface.fit_to_grid(scene.grid)
    sq = stribeck.metrics.height_statistics(heights).sq
    simulation = stribeck.Simulation(scene, heights=heights * (50e-9 / sq))
    lines = [
        f"{r.time:8.0f} {r.film.lambda_:9.3f} {r.contact.load_ratio:11.3f} {1e9 * r.roughness.disc_rq:13.2f} {1e9 * r.tribofilm.disc_mean:10.2f}"
        for r in simulation.run(6, 60.0)
    ]
    assert lines == run_example("measured_surface").splitlines()[3:]
    assert simulation.ledger_residual < 1e-20


def test_dry_contacts_are_those_of_the_example_dry_contact() -> None:
    rows = [line.split() for line in run_example("dry_contact").splitlines()[2:]]
    scene = stribeck.Scene.azam_2019(96).replace(lubricant=None)
    for load, area, share, pressure, kind in rows:
        plastic = None if kind == "elastic" else scene.to_dict()["plastic"]
        solution = stribeck.solve(scene.replace(load={"force": float(load)}, plastic=plastic))
        hertz_area = math.pi * solution.hertz.half_width_x * solution.hertz.half_width_y
        assert f"{solution.contact.area * 1e12:.1f}" == area
        assert f"{solution.contact.area / hertz_area:.3f}" == share
        assert f"{solution.pressure.max * 1e-9:.2f}" == pressure
