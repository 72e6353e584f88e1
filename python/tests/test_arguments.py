"""Arguments that do not fit: each is refused by its name, with what was given; text with a unit does for a number."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import stribeck
from stribeck import Scene, analytic, metrics, plot, surface
from test_refused import refused

FLAT = np.zeros((16, 16))
LONE = "\ud800"


@pytest.fixture()
def dry() -> Scene:
    """A dry contact on few cells."""
    return Scene.azam_2019(16).replace(lubricant=None)


def test_text_with_a_unit_is_a_number(dry: Scene) -> None:
    spoken = analytic.hertz_point("1 cm", equivalent_modulus="229.67 GPa", load="50 N")
    assert spoken == analytic.hertz_point(0.01, equivalent_modulus=229.67e9, load=50.0)
    measured = surface.Surface(FLAT, "1 um", "2 um")
    assert (measured.dx, measured.dy) == (1e-6, 2e-6)
    simulation = stribeck.Simulation(dry)
    history = simulation.run_until("2 min", "1 min")
    assert history["time"].tolist() == [60.0, 120.0]
    assert simulation.solve_under(load="50 N", bulk_temperature="80 degC").hertz.force == pytest.approx(50.0)
    generated = surface.generate(dry.grid, "1 nm", length="60 um")
    np.testing.assert_array_equal(generated, surface.generate(dry.grid, 1e-9, length=60e-6))
    assert stribeck.Grid.box(4, 2, ("-1 mm", "1 mm"), (0.0, "1 mm")).dx == 5e-4


@pytest.mark.parametrize(
    ("field", "value", "call"),
    [
        ("seed", -1, lambda s: surface.generate(s.grid, 1e-8, length=6e-5, seed=-1)),
        ("seed", 2**64, lambda s: surface.dimples(s.grid, radius=1e-5, depth=1e-6, pitch=4e-5, seed=2**64)),
        ("n", -1, lambda s: Scene.azam_2019(-1)),
        ("n", "64", lambda s: Scene.azam_2019("64")),
        ("tribofilm", 1, lambda s: Scene.azam_2019(16, tribofilm=1)),
        ("nx", -1, lambda s: stribeck.Grid.box(-1, 3, (0.0, 1.0), (0.0, 1.0))),
        ("x", 3, lambda s: stribeck.Grid.box(3, 3, 3, (0.0, 1.0))),
        ("degree", -1, lambda s: surface.Surface(FLAT, 1e-6).remove_polynomial(-1)),
        ("first[0]", -1, lambda s: surface.Surface(FLAT, 1e-6).crop((-1, 0), 3, 3)),
        ("grid", (32, 32), lambda s: surface.generate((32, 32), 1e-8, length=6e-5)),
        ("grid", None, lambda s: surface.Surface(FLAT, 1e-6).fit_to_grid(s)),
        ("radius_x", "1 kg", lambda s: analytic.hertz_point("1 kg", equivalent_modulus=2e11, load=50.0)),
        ("radius_x", [1], lambda s: analytic.hertz_point([1], equivalent_modulus=2e11, load=50.0)),
        ("ellipticity", "1", lambda s: analytic.point_films(
            entrainment_speed=1.0, eta0=0.04, alpha=2e-8, equivalent_modulus=2e11, radius=0.01, load=50.0, ellipticity="1"
        )),
        ("exact_rq", "yes", lambda s: surface.generate(s.grid, 1e-8, length=6e-5, exact_rq="yes")),
        ("kurtosis", 10, lambda s: surface.generate(s.grid, 1e-8, length=6e-5, kurtosis=10)),
        ("skewness", -1.0, lambda s: surface.generate(s.grid, 1e-8, length=6e-5, skewness=-1.0)),
        ("hurst", 0.8, lambda s: surface.generate(s.grid, 1e-8, length=6e-5, hurst=0.8)),
        ("roll_off", 1e-4, lambda s: surface.generate(s.grid, 1e-8, kind="exponential", length=6e-5, roll_off="0.1 mm")),
        ("length_x", 6e-5, lambda s: surface.generate(
            s.grid, 1e-8, kind="self_affine", hurst=0.8, roll_off=2e-4, shortest=4e-5, length=6e-5
        )),
        ("kind", "fractal", lambda s: surface.generate(s.grid, 1e-8, kind="fractal", hurst=0.8)),
        ("grid", None, lambda s: stribeck.given_film(FLAT + 1e-6, s, speeds=(1.0, 0.0), eta0=0.01)),
        ("first", -1, lambda s: metrics.composite_rq(-1, 2)),
        ("first", None, lambda s: metrics.composite_rq(float("nan"), 2)),
        ("second", "-2 nm", lambda s: metrics.composite_rq(1e-9, "-2 nm")),
        ("composite_rq", 0, lambda s: metrics.lambda_ratio(1e-8, 0)),
        ("composite_rq", float("inf"), lambda s: metrics.lambda_ratio(1e-8, float("inf"))),
        ("name", "plate", lambda s: stribeck.read_body(s, "fields.npz", "plate")),
        ("form", [1, 2, 3], lambda s: Scene(form=[1, 2, 3])),
        ("form", (1, 2), lambda s: s.replace(form=(1, 2))),
        ("option", "size", lambda s: surface.generate(s.grid, 1e-8, size=6e-5)),
        ("path", None, lambda s: stribeck.Simulation(s).restore(None)),
        ("path", None, lambda s: surface.read(None)),
        ("scene", "", lambda s: stribeck.solve("")),
        ("scene", 1, lambda s: Scene({1: 2})),
        ("load", 1, lambda s: Scene({"load": {1: 2}})),
        ("scene", LONE, lambda s: Scene(LONE)),
        ("scene", "a=" + LONE, lambda s: Scene("a=" + LONE)),
        ("form.kind", LONE, lambda s: Scene({"form": {"kind": LONE}})),
        ("solver", LONE, lambda s: stribeck.solve(s, solver=LONE)),
        ("squeeze", "no", lambda s: stribeck.Simulation(s, squeeze="no")),
        ("start", 3, lambda s: stribeck.Simulation(s, start=3)),
        ("in_contact", None, lambda s: metrics.contact_patches(FLAT + 0.5, dx=1e-6)),
        ("heights", 1, lambda s: stribeck.solve(s, heights={1: FLAT, "x": FLAT})),
        ("load", None, lambda s: stribeck.solve(s, plasticity=lambda film, depth: 1e6)),
        ("name", "nonsense", lambda s: stribeck.Simulation(s).run(1, 1.0)["nonsense"]),
        ("field", "nonsense", lambda s: plot.map(stribeck.solve(s), "nonsense")),
        ("field", "nonsense", lambda s: plot.profile(stribeck.solve(s), ["film", "nonsense"])),
        ("shown", 3, lambda s: plot.map(3)),
        ("along", "z", lambda s: plot.profile(stribeck.solve(s), along="z")),
    ],
)
def test_what_does_not_fit_is_named(dry: Scene, field: str, value: object, call) -> None:
    error = refused(stribeck.InputError, lambda: call(dry), field)
    if field != "path":
        assert error.value is not None
    if value is not None:
        assert error.value == value, error


def test_names_that_are_not_there(dry: Scene) -> None:
    solution = stribeck.solve(dry)
    error = refused(stribeck.UnknownNameError, lambda: solution["filmm"], "name")
    assert isinstance(error, KeyError) and "film" in str(error)
    assert solution.get("filmm") is None and "filmm" not in solution
    simulation = stribeck.Simulation(dry)
    for call, fields in [
        (lambda: plot.map(solution, "filmm"), solution.fields),
        (lambda: solution.fields["filmm"], solution.fields),
        (lambda: pickle.loads(pickle.dumps(solution)).fields["filmm"], solution.fields),
        (lambda: simulation.fields["filmm"], simulation.fields),
    ]:
        error = refused(stribeck.UnknownNameError, call, "field")
        assert error.value == "filmm" and all(name in str(error) for name in fields)
    assert solution.fields.get("filmm") is None and "filmm" not in solution.fields


def test_a_film_needs_a_grid() -> None:
    for call in (
        lambda: surface.generate(None, 1e-8, length=6e-5),
        lambda: stribeck.given_film(FLAT + 1e-6, None, speeds=(1.0, 0.0), eta0=0.01),
    ):
        assert "grid = None: must be a Grid" in str(refused(stribeck.InputError, call, "grid"))


def test_a_list_is_no_table() -> None:
    error = refused(stribeck.SceneError, lambda: Scene(form=[1, 2, 3]), "form")
    assert str(error) == "form = [1, 2, 3]: a list, expected a table"


def test_errors_carry_what_they_are_about(dry: Scene, tmp_path: Path) -> None:
    nowhere = str(tmp_path / "none" / "fields.npz")
    error = refused(stribeck.FileError, lambda: stribeck.solve(dry).save_fields(nowhere), "path")
    assert error.value == nowhere and error.errno == 2
    (tmp_path / "foreign").write_bytes(b"no checkpoint" * 9)
    error = refused(stribeck.CheckpointError, lambda: stribeck.Simulation(dry).restore(tmp_path / "foreign"), "path")
    assert error.value == str(tmp_path / "foreign")
    elsewhere = dry.replace(grid={"nx": 16, "ny": 16, "x": [-2e-4, 2e-4], "y": [-2e-4, 2e-4]})
    start = stribeck.BodyStart(elsewhere, FLAT)
    for call in (stribeck.solve, stribeck.Simulation):
        error = refused(stribeck.InputError, lambda call=call: call(dry, bodies=(start, None)), "ball start")
        assert error.value is start
    soft = refused(stribeck.InputError, lambda: stribeck.solve(dry, plasticity=lambda film, depth: 1e6), "load")
    assert soft.value == pytest.approx(dry.hertz().force)
    refused(stribeck.SurfaceError, lambda: surface.Surface(FLAT).remove_sphere(), "dx")
    holed = surface.Surface(FLAT, 1e-6, defined=np.eye(16) == 0)
    box = stribeck.Grid.box(8, 8, (0.0, 8e-6), (0.0, 8e-6))
    assert refused(stribeck.SurfaceError, lambda: holed.resample(box), "undefined").value == 16


def test_arrays_hold_numbers_and_no_masked_ones(dry: Scene) -> None:
    masked = np.ma.masked_array(FLAT, np.eye(16, dtype=bool))
    error = refused(stribeck.InputError, lambda: stribeck.solve(dry, heights=masked), "disc_heights")
    assert "16 of 256 values are masked" in str(error) and error.value is masked
    whole = stribeck.solve(dry, heights=np.ma.masked_array(FLAT))
    assert whole.to_dict() | {"seconds": 0} == stribeck.solve(dry, heights=FLAT).to_dict() | {"seconds": 0}
    for odd in (FLAT.astype("datetime64[s]"), FLAT.astype("timedelta64[s]"), FLAT.astype(str), FLAT.astype(object), 1j * FLAT):
        error = refused(stribeck.InputError, lambda odd=odd: stribeck.solve(dry, heights=odd), "disc_heights")
        assert str(odd.dtype) in str(error)


@pytest.mark.parametrize("returned", [1, 0, "stop", np.array([True]), 1.0])
def test_callbacks_return_truth_values_or_nothing(dry: Scene, returned: object) -> None:
    simulation = stribeck.Simulation(dry)
    for run in (simulation.run, simulation.run_until):
        error = refused(stribeck.InputError, lambda run=run: run(90, 1.0, callback=lambda sim, record: returned), "callback")
        assert error.value is returned and repr(returned) in str(error)
    assert simulation.steps == 2


def test_truth_values_of_numpy_end_a_run(dry: Scene) -> None:
    simulation = stribeck.Simulation(dry)
    history = simulation.run(4, 60.0, callback=lambda sim, record: sim.bodies[1].wear.max() > 0.0)
    assert history.stopped and len(history) == 1
    history = simulation.run(2, 60.0, callback=lambda sim, record: sim.bodies[1].wear.max() < 0.0)
    assert not history.stopped and len(history) == 2


class Law:
    """A law of several roles, to be given as a class."""

    maximum_thickness = 1e-7

    def rate(self, at, thickness):
        return 0.0

    depth_rate = coefficient = displacement = viscosity = ratio = pressure_limit = offset = solve = rate


ROLES = ("growth", "wear", "friction", "deformation", "viscosity", "density", "plasticity", "motion", "solver")


@pytest.mark.parametrize("role", ROLES)
def test_a_class_is_no_law(role: str) -> None:
    with pytest.raises(stribeck.LawError, match=r"is the class Law: give an instance of it, as Law\(\)") as caught:
        stribeck.Simulation(Scene.azam_2019(16), **{role: Law})
    assert caught.value.value is Law and caught.value.field


def test_laws_return_numbers_and_solvers_a_truth_value(dry: Scene) -> None:
    masked = np.ma.masked_array(FLAT, FLAT == 0.0)
    for returned in ("0.1", FLAT.astype(str), None, masked):
        law = lambda *_, returned=returned: returned  # noqa: E731
        error = refused(stribeck.LawError, lambda law=law: stribeck.solve(dry, friction=law), "boundary friction")
        assert "expected numbers" in str(error)
    for returned in (None, 1, "done"):
        solver = lambda problem, state, returned=returned: returned  # noqa: E731
        error = refused(stribeck.LawError, lambda solver=solver: stribeck.solve(dry, solver=solver), "solver")
        assert "must return True where it has converged" in str(error) and error.value == returned
    assert stribeck.solve(dry, solver=lambda problem, state: np.bool_(False)).status == "stalled"


def test_files_whose_name_looks_like_text(dry: Scene, tmp_path: Path) -> None:
    folder = tmp_path / "load=50"
    folder.mkdir()
    (folder / "scene.toml").write_text(dry.to_toml())
    assert Scene(str(folder / "scene.toml")) == dry
    with pytest.raises(stribeck.SceneError, match="none.toml"):
        Scene(str(folder / "none.toml"))


def test_tables_have_no_lines(dry: Scene) -> None:
    error = refused(stribeck.SceneError, lambda: dry.replace(solver={"max_iterations": [1, 2]}), "solver.max_iterations")
    assert error.value == [1, 2]
    assert str(error).startswith("solver.max_iterations = [1, 2]: a list, expected a whole number")
    assert "line" not in str(error)
    assert "line 2" in str(refused(stribeck.SceneError, lambda: Scene("[load]\nforce = [1]\n"), "load.force"))


def test_what_a_step_has_found_is_said_once() -> None:
    edges = [-6e-5, 6e-5]
    scene = Scene.azam_2019(24).replace(
        lubricant=None, roughness=None, plastic=None, wear=None,
        grid={"nx": 24, "ny": 24, "x": edges, "y": edges}, solver={"edge_contact": True},
    )
    for go in (lambda sim: [sim.step(1.0), sim.step(1.0)], lambda sim: sim.run(2, 1.0), lambda sim: sim.run_until(2.0, 1.0)):
        simulation = stribeck.Simulation(scene)
        with pytest.warns(stribeck.StribeckWarning) as said:
            first, second = go(simulation)
        assert [warning.message.field for warning in said] == ["pressure.max"] and said[0].filename == __file__
        assert [warning.field for warning in first.warnings] == ["pressure.max"] and second.warnings == []
        assert [len(record.warnings) for record in simulation.history] == [1, 0]
    assert "warnings" not in first
    assert [str(warning) for warning in pickle.loads(pickle.dumps(first)).warnings] == [str(first.warnings[0])]


def test_a_simulation_starts_from_a_solution() -> None:
    scene = Scene.azam_2019(32).replace(track={"motion": "at_rest"})
    solution = stribeck.solve(scene)
    cold, warm = stribeck.Simulation(scene).step(60.0), stribeck.Simulation(scene, start=solution).step(60.0)
    assert warm.work.convolutions < 0.5 * cold.work.convolutions
    assert warm.contact.load_ratio == pytest.approx(cold.contact.load_ratio, rel=1e-3)
    other = stribeck.solve(Scene.azam_2019(16))
    refused(stribeck.ShapeError, lambda: stribeck.Simulation(scene, start=other), "start pressure")
    bare = stribeck.Solution(solution.to_dict())
    assert "theta" in str(refused(stribeck.InputError, lambda: stribeck.solve(scene, start=bare), "start"))
    box = scene.to_dict()["grid"]
    wider = scene.replace(grid={**box, "x": [2.0 * edge for edge in box["x"]]})
    for call in (stribeck.solve, stribeck.Simulation):
        assert "box is another" in str(refused(stribeck.InputError, lambda call=call: call(wider, start=solution), "start"))


def test_wear_of_metres_is_said(dry: Scene) -> None:
    # The law wears beside the contact too.
    simulation = stribeck.Simulation(dry.replace(solver={"edge_contact": True}), wear=lambda at, film: 1.0)
    refused(stribeck.InputError, lambda: simulation.step("1 min"), "time_step")
    with pytest.warns(stribeck.StribeckWarning) as said:
        record = simulation.step("50 us")
    worn, step = record.warnings
    assert len(said) == 2 and step.field == "time_step"
    assert worn.field in ("wear.ball_max", "wear.disc_max") and worn.value == max(record.wear.ball_max, record.wear.disc_max) > 2e-5
