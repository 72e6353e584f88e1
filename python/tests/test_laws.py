"""Laws of fluid, plasticity and motion in Python, and solvers of one's own."""

from __future__ import annotations

import copy

import numpy as np
import pytest

import stribeck
from stribeck.laws import ContactProblem, ContactState, Hardening, Motion
from test_mirror import same
from test_refused import refused

ALPHA, MODULUS = 20e-9, 229.67e9


def barus(pressure):
    return 0.01 * np.exp(ALPHA * pressure)


def dowson_higginson(pressure):
    return 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure)


@pytest.fixture()
def barus_scene(rough: stribeck.Scene) -> stribeck.Scene:
    """The rough scene with an oil that the laws above are those of."""
    return rough.replace(lubricant=None).replace(
        lubricant={"viscosity": {"law": "barus", "eta0": 0.01, "alpha": ALPHA}, "density_a": 0.6e-9, "density_b": 1.7e-9}
    )


def test_the_oil_in_python_is_that_of_the_crate(barus_scene: stribeck.Scene) -> None:
    usual = stribeck.solve(barus_scene)
    own = stribeck.solve(barus_scene, viscosity=barus, density=dowson_higginson)
    assert own.converged and usual.converged
    assert own.film.mean_central == pytest.approx(usual.film.mean_central, rel=1e-5)
    assert own.friction.coefficient == pytest.approx(usual.friction.coefficient, rel=1e-5)
    assert own.moes.l == pytest.approx(usual.moes.l, rel=1e-3)
    simulation = stribeck.Simulation(barus_scene, viscosity=barus, density=dowson_higginson)
    record = simulation.step(60.0)
    assert record.contact.load_ratio == pytest.approx(stribeck.Simulation(barus_scene).step(60.0).contact.load_ratio, rel=1e-4)
    fork = simulation.fork()
    assert same(fork.step(60.0), simulation.step(60.0))


class Thinning:
    """An oil that thins with temperature."""

    def viscosity_at(self, pressure, temperature):
        return barus(pressure) * np.exp(-0.03 * (temperature - 353.15))

    def ratio_at(self, pressure, temperature):
        return dowson_higginson(pressure)


def test_laws_follow_the_bulk_temperature(barus_scene: stribeck.Scene) -> None:
    smooth = barus_scene.replace(roughness=None, plastic=None, wear=None, motion={"entrainment_speed": 2.0})
    warm = smooth.replace(thermal={"bulk_temperature": 373.15})
    cool = stribeck.solve(smooth, viscosity=Thinning(), density=Thinning())
    thin = stribeck.solve(warm, viscosity=Thinning(), density=Thinning())
    assert cool.film.central == pytest.approx(stribeck.solve(smooth).film.central, rel=1e-4)
    # The central film goes with the viscosity to the power of about 0.67.
    assert thin.film.central / cool.film.central == pytest.approx(np.exp(-0.6 * 0.67), rel=0.05)
    schedule = {"bulk_temperature": {"kind": "steps", "times": [0.0, 60.0], "values": [353.15, 373.15]}}
    simulation = stribeck.Simulation(smooth.replace(schedule=schedule), viscosity=Thinning())
    films = [simulation.step(60.0).film.mean_central for _ in range(2)]
    assert films[1] < 0.8 * films[0]


def test_plasticity_in_python(rough: stribeck.Scene) -> None:
    soft = rough.replace(lubricant=None, plastic={"hardness": 2e9})
    elastic = rough.replace(lubricant=None, plastic=None)
    usual, own = stribeck.solve(soft), stribeck.solve(elastic, plasticity=lambda film, depth: 2e9)
    assert own.pressure.max == pytest.approx(usual.pressure.max, rel=1e-9) and own.pressure.max <= 2e9 * (1 + 1e-9)
    hardening = soft.replace(plastic={"hardness": 2e9, "hardening_modulus": 1e16})
    expected = stribeck.Simulation(hardening).run(2, 60.0)
    law = Hardening(lambda film, depth: 2e9 + 1e16 * np.maximum(depth, 0.0))
    simulation = stribeck.Simulation(elastic, plasticity=law)
    found = simulation.run(2, 60.0)
    assert found["plastic.volume"] == pytest.approx(expected["plastic.volume"], rel=1e-6)
    assert simulation.bodies[1].plastic_depth.max() > 0.0


def test_motion_in_python(rough: stribeck.Scene) -> None:
    asked = []

    def offset(body: int, draw: int, time: float, speed: float, grid: stribeck.Grid) -> tuple[int, int]:
        asked.append((body, draw, time, speed, grid.shape))
        return (-5 * draw, 0) if body else (0, 0)

    dry = rough.replace(lubricant=None)
    simulation = stribeck.Simulation(dry, motion=Motion(offset))
    simulation.run(3, 60.0)
    assert {(body, draw) for body, draw, *_ in asked} >= {(0, 0), (1, 0), (0, 2), (1, 2)}
    body, draw, time, speed, shape = asked[-1]
    assert time == 120.0 and speed == pytest.approx(0.1 * (0.975 if body else 1.025)) and shape == (32, 32)
    assert "offset" in simulation.roughness_motion
    still = stribeck.Simulation(dry, motion=Motion(lambda *_: 0, visits="stays"))
    rest = stribeck.Simulation(dry.replace(track={"motion": "at_rest"}))
    assert same(still.run(2, 60.0)[1], rest.run(2, 60.0)[1])
    between = stribeck.Simulation(dry, motion=Motion(lambda *_: (3, 0, 0.5)))
    assert between.step(60.0).contact.load_ratio > 0.0


@pytest.mark.parametrize(
    ("role", "law", "field", "words"),
    [
        ("viscosity", lambda p: -0.01 + 0.0 * p, "viscosity of the law", "above 0"),
        ("viscosity", lambda p: 0.01 * np.exp(-1e-9 * p), "viscosity of the law", "not falling"),
        ("viscosity", lambda p: np.full(3, 0.01), "viscosity law", "shape"),
        ("viscosity", lambda p: np.where(p > 1e9, np.inf, 0.01), "viscosity law", "finite"),
        ("viscosity", lambda p: 1 / 0, "viscosity law", "ZeroDivisionError"),
        ("viscosity", 0.01, "viscosity law", "neither a function"),
        ("density", lambda p: 2.0, "density ratio of the law", "1 without pressure"),
        ("density", lambda p: 1.0 - 1e-11 * p, "density ratio of the law", "not falling"),
        ("density", lambda p: "thick", "density law", "expected numbers"),
        ("plasticity", lambda film, depth: -1e9, "pressure limit of the law", "above 0"),
        ("plasticity", lambda film: 1e9, "plasticity model", "TypeError"),
        ("plasticity", lambda film, depth: np.nan, "plasticity model", "finite"),
        ("plasticity", "hard", "plasticity model", "neither a function"),
        ("solver", 7, "solver", "neither a function"),
        ("solver", lambda problem, state: state.missing, "solver", "AttributeError"),
        ("solver", lambda problem, state: setattr(state, "pressure", np.zeros(4)), "solver", "state.pressure"),
        ("solver", lambda problem, state: setattr(state, "approach", np.nan), "solver", "state.approach"),
        ("solver", lambda problem, state: problem.displacement(np.zeros((3, 3))), "solver", "shape"),
    ],
)
def test_what_a_law_must_keep_is_named(rough: stribeck.Scene, role: str, law, field: str, words: str) -> None:
    for call in (stribeck.solve, lambda scene, **laws: stribeck.Simulation(scene, **laws).step(1.0)):
        error = refused(stribeck.StribeckError, lambda call=call: call(rough, **{role: law}), field)
        assert words in str(error)
        assert isinstance(error, (stribeck.InputError, stribeck.LawError))


@pytest.mark.parametrize(
    ("law", "field", "words"),
    [
        (Motion(lambda *_: "far"), "motion", "whole columns"),
        (Motion(lambda *_: (0, 0, 2.0)), "motion", "from 0 to 1"),
        (Motion(lambda *_: 1 / 0), "motion", "ZeroDivisionError"),
    ],
)
def test_motions_that_fail_are_named(rough: stribeck.Scene, law: Motion, field: str, words: str) -> None:
    error = refused(stribeck.LawError, lambda: stribeck.Simulation(rough, motion=law).step(1.0), field)
    assert words in str(error)


def test_motions_visit_places_that_there_are() -> None:
    for odd in ("everything", 3):
        refused(stribeck.StribeckError, lambda odd=odd: Motion(lambda *_: 0, visits=odd), "motion.visits")


def test_laws_need_what_they_are_laws_of(rough: stribeck.Scene) -> None:
    dry = rough.replace(lubricant=None)
    refused(stribeck.InputError, lambda: stribeck.solve(dry, viscosity=barus), "viscosity")
    refused(stribeck.InputError, lambda: stribeck.solve(dry, density=dowson_higginson), "density")
    estimate = rough.replace(solver={"estimate": True})
    refused(stribeck.InputError, lambda: stribeck.solve(estimate, viscosity=barus), "viscosity")
    refused(stribeck.InputError, lambda: stribeck.solve(estimate, solver=lambda problem, state: True), "solver")


class ConjugateGradients:
    """A dry contact by conjugate gradients on the nodes that touch (Polonsky and Keer 1999)."""

    def solve(self, problem: ContactProblem, state: ContactState) -> bool:
        cell = problem.grid.dx * problem.grid.dy
        pressure = state.pressure if state.pressure.any() else np.full(problem.grid.shape, problem.load / cell / problem.gap.size)
        direction, before, turned = np.zeros_like(pressure), 1.0, 0.0
        for _ in range(problem.max_iterations):
            gap = problem.gap + problem.displacement(pressure)
            touching = pressure > 0.0
            state.approach = gap[touching].mean()
            gap -= state.approach
            state.pressure[:] = pressure
            residuals = problem.evaluate(state)
            if max(residuals.load, residuals.complementarity) <= problem.tolerance:
                return True
            square = (gap[touching] ** 2).sum()
            direction = np.where(touching, gap + turned * square / before * direction, 0.0)
            before = square
            answer = problem.displacement(direction)
            answer -= answer[touching].mean()
            step = (gap[touching] * direction[touching]).sum() / (answer[touching] * direction[touching]).sum()
            pressure = np.maximum(np.where(touching, pressure - step * direction, pressure), 0.0)
            overlaps = (pressure == 0.0) & (gap < 0.0)
            pressure[overlaps] -= step * gap[overlaps]
            turned = 0.0 if overlaps.any() else 1.0
            pressure *= problem.load / (pressure.sum() * cell)
        return False


def test_a_solver_in_python(rough: stribeck.Scene) -> None:
    dry = rough.replace(lubricant=None, plastic=None)
    usual, own = stribeck.solve(dry), stribeck.solve(dry, solver=ConjugateGradients())
    assert own.converged and own.solver == "python"
    assert max(own.residual.load, own.residual.complementarity) <= 2e-6
    np.testing.assert_allclose(own.fields["pressure"], usual.fields["pressure"], atol=1e-3 * usual.pressure.max)
    assert own.contact.area_ratio == pytest.approx(usual.contact.area_ratio, rel=1e-2)
    simulation = stribeck.Simulation(dry, solver=ConjugateGradients())
    assert simulation.step(60.0).status == "converged"
    assert same(copy.copy(simulation).step(60.0), simulation.step(60.0))
    short = stribeck.solve(dry.replace(solver={"max_iterations": 2}), solver=ConjugateGradients())
    assert short.status == "stalled" and short.residual.complementarity > 1e-6


def test_false_convergence_is_detected(rough: stribeck.Scene) -> None:
    seen = []

    def lies(problem: ContactProblem, state: ContactState) -> bool:
        seen.append((problem.lubricated, problem.contact_film, problem.grid.shape, problem.gap.shape))
        assert problem.viscosity(state.pressure).min() == pytest.approx(0.004, rel=1e-9)
        assert problem.density(1e9).max() > 1.1
        assert problem.pressure_limit is not None and problem.pressure_limit.min() > 0.0
        return True

    solution = stribeck.solve(rough, solver=lies)
    assert solution.status == "unverified" and solution.residual.load == pytest.approx(1.0)
    assert seen == [(True, 1e-9, (32, 32), (32, 32))]
    simulation = stribeck.Simulation(rough, solver=lies)
    refused(stribeck.NotConvergedError, lambda: simulation.step(60.0), "status")
    assert simulation.steps == 0


def test_a_solver_knows_spin(rough: stribeck.Scene) -> None:
    seen = []

    def gives_up(problem: ContactProblem, state: ContactState) -> bool:
        seen.append(problem.spin_radius)
        return False

    stribeck.solve(rough.replace(motion={"spin_radius": "1 mm"}), solver=gives_up)
    stribeck.solve(rough, solver=gives_up)
    assert seen == [1e-3, None]


def test_a_solver_with_a_model_in_python(rough: stribeck.Scene) -> None:
    from test_use import HalfSpaceByNumpy

    dry = rough.replace(lubricant=None, plastic=None)
    own = stribeck.solve(dry, solver=ConjugateGradients(), deformation=HalfSpaceByNumpy(dry, MODULUS))
    assert own.converged
    assert own.pressure.max == pytest.approx(stribeck.solve(dry).pressure.max, rel=1e-3)
