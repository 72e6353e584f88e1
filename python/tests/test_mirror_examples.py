"""More examples of the crate in Python: equal numbers to the last bit that they print."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, SCENES, run_example, run_study

import stribeck
from stribeck.elastic import HalfSpace
from stribeck.laws import ContactProblem, ContactState


def test_members_of_an_ensemble_are_simulations(tmp_path: Path) -> None:
    lines = run_example("ensemble", str(tmp_path)).splitlines()
    assert len(lines) == 6
    for line in lines:
        name, told = line.split(maxsplit=1)
        pressure, seed = float(name.split("_")[0]) * 1e9, int(name.rsplit("_", 1)[1])
        scene = stribeck.Scene.azam_2019(32, tribofilm=True).replace(
            load={"hertz_pressure": pressure}, solver={"tolerance": 1e-3}, track={"seed": seed}
        )
        if pressure < 0.0:
            with pytest.raises(stribeck.InputError) as caught:
                stribeck.Simulation(scene)
            assert told == str(caught.value)
            continue
        last = stribeck.Simulation(scene).run(4, 60.0)[-1]
        words = told.replace(",", "").split()
        assert words[0] == "4"
        assert [float(words[3]), float(words[6])] == [last.wear.disc_mean, last.tribofilm.disc_mean]


def test_a_slider_with_a_pocket_is_that_of_its_example() -> None:
    def film(x: float, y: float) -> float:
        pad = 1.05e-6 - 0.05e-6 * x / 10e-3
        return pad + 1e-6 if 2e-3 < x < 5e-3 else pad

    grid = stribeck.Grid.box(200, 1, (0.0, 10e-3), (0.0, 1.0))
    oil = {"eta0": 0.01, "ambient_pressure": "0.1 MPa", "closed_sides": True}
    for speed in (0.02, 0.2):
        expected = json.loads(run_example("pocket_slider", "--speed", str(speed), "--cells", "200", "--json"))
        slider = stribeck.given_film(film, grid, speeds=(speed, 0.0), **oil)
        assert slider.status == "converged" and slider.flow.imbalance <= 1e-10
        found = [slider.pressure_at("2 mm"), slider.pressure_at("5 mm"), slider.load, slider.reformation()]
        assert [*found, slider.flow.inflow, slider.flow.outflow] == [
            expected[name]
            for name in ("pressure_pocket_start", "pressure_pocket_end", "load", "reformation", "inflow", "outflow")
        ]
    assert slider.pressure.shape == slider.theta.shape == (1, 200) and slider.pressure_at(0.0, 1) is None
    flat = stribeck.given_film(np.full((1, 200), 1e-6), grid, speeds=(0.02, 0.0), **oil)
    assert flat.load == pytest.approx(1e3)
    with pytest.raises(stribeck.LawError, match="film"):
        stribeck.given_film(lambda x, y: 1 / 0, grid, speeds=(1.0, 0.0), **oil)
    with pytest.raises(stribeck.InputError, match="film"):
        stribeck.given_film(lambda x, y: -1e-6, grid, speeds=(1.0, 0.0), **oil)


def thermal_scene(speed: float, ratio: float) -> stribeck.Scene:
    """The scene of the study `thermal_film`."""
    bulk = 313.15
    scene = stribeck.Scene.azam_2019(32).replace(roughness=None, plastic=None, load={"hertz_pressure": 0.8e9})
    return scene.replace(
        motion={"entrainment_speed": speed, "slide_roll_ratio": ratio},
        thermal={"bulk_temperature": bulk},
        friction={"eyring_stress": 5e6},
        grid={"nx": 32, "ny": 32, "x": [-0.35e-3, 0.2e-3], "y": [-0.22e-3, 0.22e-3]},
        lubricant={"eta0": 0.04, "alpha": 18e-9, "formula_alpha": None, "temperature": bulk, "roelands_s0": 1.1},
    )


def test_films_with_a_temperature_are_those_of_the_study(tmp_path: Path) -> None:
    run_study("thermal_film", "--quick", "--out", str(tmp_path))
    with (tmp_path / "thermal_film.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 27
    for row in rows:
        scene = thermal_scene(float(row["entrainment_speed_m_s"]), float(row["slide_roll_ratio"]))
        if row["profile"] != "isothermal":
            scene = scene.replace(lubricant={"thermal": {"profile": row["profile"]}})
        solution = stribeck.solve(scene).require_converged()
        assert solution.film.central == float(row["film_central_m"])
        assert solution.friction.coefficient == float(row["friction_coefficient"])
        rise = 0.0 if solution.thermal is None else solution.thermal.film_temperature_max - 313.15
        assert rise == float(row["film_temperature_rise_k"])


def test_running_in_is_that_of_its_example() -> None:
    end = 60.0
    run_example("running_in", "2", str(end))
    simulation = stribeck.Simulation(SCENES / "running_in.toml")

    def sweep(surfaces: str) -> list[list[object]]:
        found = []
        for speed in (1e-3, 1.0):
            solution = simulation.solve_under(load=20.0, entrainment_speed=speed).require_converged()
            friction, contact, film = solution.friction, solution.contact, solution.film
            found.append([surfaces, speed, friction.coefficient, friction.boundary, contact.load_ratio, film.lambda_])
        return found

    rows = sweep("new")
    simulation.run_until(end, 20.0, depth=5e-9)
    rows += sweep("worn")
    with (ROOT / "target" / "running_in" / "stribeck_curves.csv").open() as file:
        lines = list(csv.reader(file))[1:]
    assert [[name, *map(float, numbers)] for name, *numbers in lines] == rows
    with (ROOT / "target" / "running_in" / "history.csv").open() as file:
        assert len(list(csv.reader(file))) == len(simulation.history) + 1


class Coated:
    """The coating of the example `custom_deformation`."""

    def __init__(self, scene: stribeck.Scene, compliance: float) -> None:
        self.substrate = HalfSpace(scene.grid, scene.to_dict()["elastic"]["equivalent_modulus"])
        self.compliance = compliance

    def displacement(self, pressure):
        return self.substrate.displacement(pressure) + self.compliance * pressure

    def influence(self, di: int, dj: int) -> float:
        return self.substrate.influence(di, dj) + (self.compliance if di == dj == 0 else 0.0)


def test_a_coating_in_python_is_that_of_its_example() -> None:
    scene = stribeck.Scene.azam_2019(96).replace(
        roughness=None, plastic=None, wear=None, motion={"entrainment_speed": 5.0}, solver={"tolerance": 1e-4}
    )
    lines = []
    for thickness in (0.0, 1e-6, 4e-6):
        record = stribeck.Simulation(scene, deformation=Coated(scene, thickness / 5e9)).step(1.0)
        peak, film = record.pressure.max * 1e-9, record.film.mean_central * 1e9
        lines.append(f"{thickness * 1e6:11.1f} um {peak!r} GPa {film!r} nm")
    assert lines == run_example("custom_deformation").splitlines()[1:]


def total(values) -> float:
    """The sum from the first value to the last, as a loop has it; that of NumPy is by pairs."""
    return float(np.cumsum(values)[-1])


class SteepestDescent:
    """The solver of the example `custom_solver`, which counts its convolutions."""

    def __init__(self) -> None:
        self.convolutions = 0

    def solve(self, problem: ContactProblem, state: ContactState) -> bool:
        inner = np.zeros(problem.grid.shape, bool)
        inner[1:-1, 1:-1] = True
        cell = problem.grid.dx * problem.grid.dy
        if not (state.pressure > 0.0).any():
            state.pressure[inner] = problem.reference_pressure
        for _ in range(problem.max_iterations + 1):
            state.pressure *= problem.load / (total(state.pressure) * cell)
            residuals = problem.evaluate(state)
            self.convolutions += 2
            if max(residuals.values()) <= problem.tolerance:
                return True
            touching = state.film[state.pressure > 0.0]
            level = total(touching) / touching.size
            step = np.where(inner & ((state.pressure > 0.0) | (state.film < level)), level - state.film, 0.0)
            state.approach += level - problem.contact_film
            length = total(step * step) / total(step * problem.displacement(step))
            state.pressure[:] = np.maximum(state.pressure + length * step, 0.0)
        return False


def test_a_solver_in_python_takes_the_steps_of_that_in_its_example() -> None:
    scene = stribeck.Scene.azam_2019(48).replace(lubricant=None, plastic=None)
    lines = [line.split() for line in run_example("custom_solver").splitlines()]
    (head,) = [k for k, line in enumerate(lines) if line[:1] == ["residual"]]
    for tolerance, own, crate in lines[head + 1 :]:
        solver, wanted = SteepestDescent(), scene.replace(solver={"tolerance": float(tolerance)})
        mine = stribeck.Simulation(wanted, solver=solver).step(10.0)
        usual = stribeck.Simulation(wanted).step(10.0)
        assert mine.contact.area_ratio == pytest.approx(usual.contact.area_ratio, rel=0.05)
        assert solver.convolutions == int(own)
        assert usual.work.convolutions == float(crate)
