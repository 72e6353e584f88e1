"""What is refused, with field and value; laws that fail; signals."""

from __future__ import annotations

import copy
import os
import pickle
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import stribeck
from test_mirror import same


def refused(kind: type[stribeck.StribeckError], call, field: str | None) -> stribeck.StribeckError:
    with pytest.raises(kind) as caught:
        call()
    assert caught.value.field == field, caught.value
    assert str(caught.value)
    return caught.value


@pytest.mark.parametrize(
    ("changes", "kind", "field", "value"),
    [
        ({"load": {"force": -3}}, stribeck.InputError, "load.force", -3.0),
        ({"load": {"force": float("nan")}}, stribeck.InputError, "load.force", None),
        ({"motion": {"entrainment_speed": "fast"}}, stribeck.InputError, "motion.entrainment_speed", "fast"),
        ({"motion": {"entrainment_sped": 0.1}}, stribeck.SceneError, "motion.entrainment_sped", 0.1),
        ({"grid": {"nx": 16}}, stribeck.SceneError, "grid.ny", None),
        ({"frm": {}}, stribeck.SceneError, "frm", {}),
        ({"form": {"kind": "cube"}}, stribeck.SceneError, "form.kind", "cube"),
        ({"wear": {"coefficient": -1e-8}}, stribeck.InputError, "wear.coefficient", -1e-8),
        ({"lubricant": {"eta0": object()}}, stribeck.SceneError, "lubricant.eta0", None),
        ({"solver": {"kind": "oracle"}}, stribeck.SceneError, "solver.kind", "oracle"),
        ({"lubricant": {"eta0": 0.0}}, stribeck.InputError, None, 0.0),
        ({"form": {"kind": "sphere", "radius": "9.5 furlongs"}}, stribeck.InputError, "form.radius", "9.5 furlongs"),
    ],
)
def test_scenes_name_field_and_value(rough: stribeck.Scene, changes: dict, kind: type, field: str | None, value) -> None:
    with pytest.raises(kind) as caught:
        stribeck.solve(rough.replace(**changes))
    if field is not None:
        assert caught.value.field == field, caught.value
    if value is not None:
        assert caught.value.value == value, caught.value
    assert isinstance(caught.value, stribeck.StribeckError)


def test_what_contains_itself_is_refused(rough: stribeck.Scene) -> None:
    table: dict = {}
    table["table"] = table
    items: list = []
    items.append(items)
    refused(stribeck.SceneError, lambda: stribeck.Scene({"form": table}), "scene")
    refused(stribeck.SceneError, lambda: rough.replace(form=table), "scene")
    refused(stribeck.SceneError, lambda: stribeck.Scene({"grid": {"x": items}}), "grid")


def test_files_name_their_path(tmp_path: Path) -> None:
    missing = tmp_path / "no.toml"
    error = refused(stribeck.FileError, lambda: stribeck.solve(missing), "path")
    assert error.value == str(missing) and error.errno == 2 and isinstance(error, OSError)
    foreign = tmp_path / "foreign.x3p"
    foreign.write_bytes(b"\x00nothing")
    error = refused(stribeck.SurfaceError, lambda: stribeck.surface.read(foreign), "path")
    assert error.value == str(foreign)
    evil = tmp_path / "evil.npy"
    evil.write_bytes(pickle.dumps({"a": 1}))
    refused(stribeck.SurfaceError, lambda: stribeck.surface.read(evil), "path")


def test_heights_that_do_not_fit(rough: stribeck.Scene) -> None:
    flat = np.zeros((32, 32))
    holed = flat.copy()
    holed[3, 4] = np.nan
    error = refused(stribeck.ShapeError, lambda: stribeck.solve(rough, heights=np.zeros((32, 31))), "disc_heights")
    assert error.value == (32, 31)
    refused(stribeck.ShapeError, lambda: stribeck.solve(rough, heights=np.zeros(1024)), "disc_heights")
    refused(stribeck.InputError, lambda: stribeck.solve(rough, heights=(holed, None)), "ball_heights[3][4]")
    refused(stribeck.InputError, lambda: stribeck.solve(rough, heights=(flat,)), "heights")
    refused(stribeck.InputError, lambda: stribeck.solve(rough, heights={"plate": flat}), "heights")
    refused(stribeck.InputError, lambda: stribeck.solve(rough, heights="flat"), "disc_heights")
    estimate = rough.replace(solver={"estimate": True})
    refused(stribeck.InputError, lambda: stribeck.solve(estimate, heights=flat), "disc_heights")
    for name in ("wear", "plastic_depth", "tribofilm"):
        for wrong in (-1.0, np.nan, np.inf):
            depth = np.where(np.eye(32) > 0.0, wrong, flat)
            error = refused(stribeck.InputError, lambda part={name: depth}: stribeck.BodyStart(rough, flat, **part), name)
            assert error.value == wrong or wrong != wrong
    measured = stribeck.surface.Surface(flat, 1e-6)
    for call in (stribeck.solve, stribeck.Simulation):
        error = refused(stribeck.InputError, lambda call=call: call(rough, heights=measured), "disc_heights")
        assert "surface.fit_to_grid(scene.grid)" in str(error)


def test_calls_name_their_argument(rough: stribeck.Scene) -> None:
    dry = rough.replace(lubricant=None)
    simulation = stribeck.Simulation(dry)
    flat = np.zeros((32, 32))
    for field, value, call in [
        ("scene", 3, lambda: stribeck.solve(3)),
        ("start", 3, lambda: stribeck.solve(dry, start=3)),
        ("bodies", 3, lambda: stribeck.solve(dry, bodies=3)),
        ("bodies", 1, lambda: stribeck.solve(dry, bodies=(None,))),
        ("bodies (disc)", "new", lambda: stribeck.solve(dry, bodies=(None, "new"))),
        ("disc_heights", None, lambda: stribeck.solve(dry, heights=1j * flat)),
        ("disc_heights", (0, 0), lambda: stribeck.solve(dry, heights=np.zeros((0, 0)))),
        ("solver.kind", "oracle", lambda: stribeck.solve(dry, solver="oracle")),
        ("time_step", "60 kg", lambda: simulation.step("60 kg")),
        ("time_step", None, lambda: simulation.run(2, None)),
        ("time_step", -3.0, lambda: simulation.run(2, -3.0)),
        ("steps", -1, lambda: simulation.run(-1, 60.0)),
        ("steps", "many", lambda: simulation.run("many", 60.0)),
        ("steps", 1.5, lambda: simulation.run(1.5, 60.0)),
        ("steps", True, lambda: simulation.run(True, 60.0)),
        ("callback", 3, lambda: simulation.run(2, 60.0, callback=3)),
        ("callback", "stop", lambda: simulation.run_until(60.0, 60.0, callback="stop")),
        ("end", "soon", lambda: simulation.run_until("soon", 60.0)),
        ("end", float("inf"), lambda: simulation.run_until(float("inf"), 60.0)),
        ("depth", "1 nN", lambda: simulation.step(60.0, depth="1 nN")),
        ("depth", -1.0, lambda: simulation.step(60.0, depth=-1.0)),
        ("load", "50 K", lambda: simulation.solve_under(load="50 K")),
        ("load", -1.0, lambda: simulation.solve_under(load=-1.0)),
        ("roughness.rq", "1 nN", lambda: stribeck.surface.generate(dry.grid, "1 nN", length=6e-5)),
        ("roughness.rq", -1e-9, lambda: stribeck.surface.generate(dry.grid, -1e-9, length=6e-5)),
    ]:
        error = refused(stribeck.InputError, call, field)
        if value is not None:
            assert error.value == value, error
    assert simulation.steps == 0


def test_callbacks_and_laws_that_end_the_program(rough: stribeck.Scene) -> None:
    dry = rough.replace(lubricant=None)
    simulation = stribeck.Simulation(dry)
    with pytest.raises(TypeError):
        simulation.run(2, 60.0, callback=lambda: None)
    assert simulation.steps == 1
    with pytest.raises(SystemExit):
        stribeck.solve(dry, friction=lambda *_: exit(3))
    # What is closed when it is asked for.
    file = open(os.devnull)  # noqa: SIM115
    file.close()
    error = refused(stribeck.LawError, lambda: stribeck.solve(dry, friction=lambda *_: file.read()), "boundary friction")
    assert isinstance(error.__cause__, ValueError) and "closed file" in str(error)
    error = refused(stribeck.LawError, lambda: stribeck.solve(dry, friction=lambda *_: next(iter(()))), "boundary friction")
    assert isinstance(error.__cause__, StopIteration)


def test_large_files_are_refused(tmp_path: Path) -> None:
    with open(tmp_path / "large.toml", "wb") as large:
        large.truncate(20_000_000)
    error = refused(stribeck.FileError, lambda: stribeck.solve(tmp_path / "large.toml"), "path")
    assert "20000000 bytes" in str(error) and error.value.endswith("large.toml")


def test_solves_that_do_not_converge_say_so(rough: stribeck.Scene) -> None:
    short = rough.replace(solver={"max_iterations": 2})
    solution = stribeck.solve(short)
    assert solution.status == "max_iterations" and not solution.converged
    error = refused(stribeck.NotConvergedError, solution.require_converged, "status")
    assert error.value == "max_iterations" and error.report["work"]["iterations"] >= 1
    simulation = stribeck.Simulation(short)
    error = refused(stribeck.NotConvergedError, lambda: simulation.step(60.0), "status")
    assert error.report["status"] == "max_iterations" and simulation.steps == 0
    crowded = rough.replace(lubricant=None, roughness=None, grid={"nx": 16, "ny": 16, "x": [-1e-4, 1e-4], "y": [-1e-4, 1e-4]})
    refused(stribeck.SolverError, lambda: stribeck.solve(crowded), "grid.y")


def test_checkpoints_of_others(rough: stribeck.Scene, tmp_path: Path) -> None:
    simulation = stribeck.Simulation(rough)
    simulation.save(tmp_path / "one")
    other = stribeck.Simulation(rough.replace(motion={"entrainment_speed": 0.2}))
    refused(stribeck.CheckpointError, lambda: other.restore(tmp_path / "one"), "scene.motion")
    assert other.restore_under_other_conditions(tmp_path / "one") == ["scene.motion"]
    (tmp_path / "two").write_bytes(pickle.dumps([1, 2]))
    refused(stribeck.CheckpointError, lambda: simulation.restore(tmp_path / "two"), "path")
    lawful = stribeck.Simulation(rough, wear=lambda at, film: 0.0)
    refused(stribeck.CheckpointError, lambda: lawful.restore(tmp_path / "one"), "wear law")


def fails(at, film):
    raise RuntimeError("out of order")


@pytest.mark.parametrize(
    ("law", "words"),
    [
        (fails, "raised RuntimeError: out of order"),
        (lambda at, film: np.zeros(3), r"shape \(3,\)"),
        (lambda at, film: np.zeros((32, 31)), r"shape \(32, 31\)"),
        (lambda at, film: float("nan"), "every value must be finite"),
        (lambda at, film: np.where(at.in_contact, np.inf, 0.0), "every value must be finite"),
        (lambda at, film: "a lot", "expected numbers"),
        (lambda at, film: None, "finite|expected numbers"),
        (lambda at: 0.0, "raised TypeError"),
        (lambda at, film: at.weight, "raised AttributeError"),
    ],
)
@pytest.mark.parametrize("role", ["wear", "growth", "friction"])
def test_laws_that_fail_leave_the_run_as_before(rough: stribeck.Scene, law, words: str, role: str) -> None:
    broken = False

    def switch(*arguments):
        if not broken:
            return 0.1 if role == "friction" else 0.0
        if role != "friction":
            return law(*arguments)
        # The laws above look at `in_contact` of their first argument.
        pressure = arguments[0]
        at = stribeck.laws.SurfaceStates(*[pressure] * 6, in_contact=pressure > 0.0)
        return law(at, arguments[2])

    given = stribeck.laws.Growth(switch, 1e-7) if role == "growth" else switch
    simulation = stribeck.Simulation(rough, **{role: given})
    simulation.step(60.0)
    before = simulation._raw.checkpoint()
    broken = True
    with pytest.raises(stribeck.LawError, match=words) as caught:
        simulation.step(60.0)
    assert caught.value.field == {"wear": "wear law", "growth": "growth law", "friction": "boundary friction"}[role]
    assert simulation._raw.checkpoint() == before
    broken = False
    assert simulation.step(60.0).step == 1


def test_laws_out_of_range(rough: stribeck.Scene) -> None:
    simulation = stribeck.Simulation(rough, wear=lambda at, film: -1e-12)
    error = refused(stribeck.InputError, lambda: simulation.step(60.0), "wear rate of the law")
    assert error.value == -1e-12 and simulation.steps == 0
    refused(stribeck.InputError, lambda: stribeck.solve(rough, friction=lambda *_: -0.1), "boundary friction of the law")
    for thickness in (0.0, -1e-9, float("nan"), None, "thick"):
        law = stribeck.laws.Growth(lambda at, film: 0.0, thickness)
        refused(stribeck.LawError, lambda law=law: stribeck.Simulation(rough, growth=law), "maximum_thickness")
    refused(stribeck.LawError, lambda: stribeck.Simulation(rough, wear=3), "wear law")


def test_a_law_that_asks_for_its_simulation(rough: stribeck.Scene) -> None:
    found = []

    def nosy(at, film):
        try:
            simulation.step(1.0)
        except stribeck.BusyError as error:
            found.append(error)
        return 0.0

    simulation = stribeck.Simulation(rough, wear=nosy)
    simulation.step(60.0)
    assert found and simulation.steps == 1


def test_what_ends_a_program_goes_through_a_law(rough: stribeck.Scene) -> None:
    def leaves(at, film):
        raise KeyboardInterrupt

    simulation = stribeck.Simulation(rough, wear=leaves)
    with pytest.raises(KeyboardInterrupt):
        simulation.step(60.0)
    assert simulation.steps == 0


def interrupt_after(seconds: float) -> threading.Thread:
    def send() -> None:
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=send)
    thread.start()
    return thread


def test_ctrl_c_ends_a_long_solve() -> None:
    # Sweeps that would go on for minutes.
    scene = stribeck.Scene.azam_2019(96).replace(solver={"contact": "paper", "kind": "semi_system", "tolerance": 1e-12})
    thread = interrupt_after(0.5)
    with pytest.raises(KeyboardInterrupt):
        stribeck.solve(scene)
    thread.join()


def test_ctrl_c_ends_a_run_with_the_state_as_before(rough: stribeck.Scene) -> None:
    whole = stribeck.Simulation(rough)
    simulation = stribeck.Simulation(rough)
    thread = interrupt_after(0.7)
    with pytest.raises(KeyboardInterrupt):
        simulation.run(100_000, 1.0)
    thread.join()
    assert simulation.steps == len(simulation.history) > 0
    history = whole.run(simulation.steps + 1, 1.0)
    assert all(same(a, b) for a, b in zip(simulation.history, history[:-1], strict=True))
    assert same(simulation.step(1.0), history[-1])


@pytest.mark.parametrize(
    ("model", "words"),
    [
        (lambda pressure: pressure[:, :-1], "shape"),
        (lambda pressure: float("nan") * pressure, "nan"),
        (lambda pressure: "soft", "deformation model"),
        (lambda pressure: 1 / 0, "division by zero"),
        (3, "neither a function"),
        (lambda pressure: 1e-16 * pressure + 1e-9, "without pressure"),
        (lambda pressure: 1e-16 * pressure**2, "linear"),
        (lambda pressure: 1e-16 * pressure * np.arange(1, 33), "the same at all nodes"),
    ],
)
def test_deformation_models_that_fail(rough: stribeck.Scene, model, words: str) -> None:
    for call in (stribeck.solve, stribeck.Simulation):
        error = refused(stribeck.LawError, lambda call=call: call(rough, deformation=model), "deformation model")
        assert words in str(error).lower()


def test_half_spaces_are_copied_and_refuse_what_is_no_pressure(rough: stribeck.Scene) -> None:
    body = stribeck.elastic.HalfSpace(rough.grid, "230 GPa")
    pressure = np.ones((32, 32))
    for other in (copy.deepcopy(body), pickle.loads(pickle.dumps(body))):
        np.testing.assert_allclose(other.displacement(pressure), body.displacement(pressure), rtol=1e-12)
    pressure[2, 3] = np.nan
    refused(stribeck.InputError, lambda: body.displacement(pressure), "pressure[2][3]")
    refused(stribeck.ShapeError, lambda: body.displacement(pressure[1:]), "pressure")

    class Wrong:
        def displacement(self, pressure):
            return body.displacement(pressure)

        def influence(self, di, dj):
            return 1.0

    error = refused(stribeck.LawError, lambda: stribeck.solve(rough, deformation=Wrong()), "deformation model")
    assert "influence(0, 0)" in str(error)


def test_a_deformation_model_that_fails_later(rough: stribeck.Scene) -> None:
    broken = False

    def springs(pressure):
        if broken:
            raise ValueError("worn out")
        return 1e-16 * pressure

    simulation = stribeck.Simulation(rough.replace(solver={"kind": "dry"}), deformation=springs)
    broken = True
    assert "worn out" in str(refused(stribeck.LawError, lambda: simulation.step(60.0), "deformation model"))
    assert simulation.steps == 0
    refused(stribeck.InputError, lambda: stribeck.solve(rough, deformation=lambda pressure: -1e-15 * pressure), "deformation")
