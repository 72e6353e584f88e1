"""What the package does for its users."""

from __future__ import annotations

import copy
import gc
import math
import pickle
import threading
import tracemalloc
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT, SCENES

import stribeck
from test_mirror import same


def test_scenes_come_from_anything_that_says_them(tmp_path: Path) -> None:
    path = SCENES / "rough.toml"
    text = path.read_text()
    scene = stribeck.Scene(path)
    tables = scene.to_dict()
    assert scene == stribeck.Scene(text) == stribeck.Scene(tables) == stribeck.Scene(**tables) == stribeck.Scene(str(path))
    assert stribeck.Scene(scene.to_toml()) == scene == pickle.loads(pickle.dumps(scene))
    assert stribeck.Scene(scene, wear=None).to_dict().get("wear") is None
    numpy = scene.replace(motion={"entrainment_speed": np.float64(0.3)}, solver={"max_iterations": np.int64(7)})
    assert numpy.to_dict()["motion"]["entrainment_speed"] == 0.3
    assert numpy.to_dict()["solver"]["max_iterations"] == 7
    assert numpy.to_dict()["motion"]["slide_roll_ratio"] == tables["motion"]["slide_roll_ratio"]
    box = scene.replace(grid={"nx": 32, "ny": 48, "x": np.array([-2e-4, 2e-4]), "y": (-3e-4, 3e-4)}).grid
    assert box.shape == (48, 32)
    assert box.x[0] == pytest.approx(-2e-4 + 0.5 * box.dx)
    seed = {"kind": "gaussian", "rq": 1e-8, "length_x": 1e-5, "length_y": 1e-5, "seed": 2**64 - 1}
    assert stribeck.Scene(scene.replace(roughness={"ball": seed}).to_dict()).to_toml().count(str(2**64 - 1)) == 1


def test_numbers_are_attributes_items_and_pictures(rough: stribeck.Scene) -> None:
    solution = stribeck.solve(rough)
    assert solution.converged and solution.status == "converged"
    assert solution.film.central == solution["film"]["central"] == solution.to_dict()["film"]["central"] > 0
    assert solution.film.lambda_ == solution.film["lambda"] == solution.film.mean_central / solution.roughness.composite_rq
    assert solution.friction.coefficient == pytest.approx(solution.friction.boundary + solution.friction.fluid)
    assert solution.report.residual.mass < 1e-6
    assert "film.central" in repr(solution) and "<table>" in solution._repr_html_()
    with pytest.raises(AttributeError, match="centrall.*central"):
        _ = solution.film.centrall
    with pytest.raises(AttributeError):
        solution.film.central = 1.0
    again = pickle.loads(pickle.dumps(solution))
    assert again.to_dict() == solution.to_dict()
    np.testing.assert_array_equal(again.fields["film"], solution.fields["film"])


def shown(numbers: stribeck._numbers.Numbers) -> dict[str, str]:
    """Names and units of a table as it is printed."""
    rows = [line.split() for line in repr(numbers).splitlines()[1:-1]]
    return {row[0]: row[2] if len(row) > 2 else "" for row in rows}


def test_tables_within_others_have_the_same_units(rough: stribeck.Scene) -> None:
    solution = stribeck.solve(rough)
    assert set(shown(solution.residual).values()) == {""}
    assert shown(solution.film)["central"] == shown(solution)["film.central"] == "m"
    assert shown(solution.film)["lambda"] == "" and shown(solution.flow)["inflow"] == "m^3/s"
    assert shown(pickle.loads(pickle.dumps(solution.film))) == shown(copy.deepcopy(solution.film)) == shown(solution.film)
    assert "<td>m</td>" in solution.film._repr_html_() and "<td>N</td>" not in solution.residual._repr_html_()
    assert shown(stribeck.Simulation(rough).conditions.motion) == {"entrainment_speed": "m/s", "slide_roll_ratio": ""}
    np.testing.assert_array_equal(rough.grid.x, solution.grid.x)
    assert shown(solution.grid)["dx"] == "m" and repr(rough.grid).startswith("<Grid")
    line = stribeck.analytic.hertz_line(10e-3, equivalent_modulus=2e11, load=1e5)
    assert shown(line) == {"half_width": "m", "pressure": "Pa", "force": "N/m"}
    assert shown(stribeck.metrics.height_statistics(np.eye(8)))["sq"] == "m"
    grid = stribeck.Grid.box(20, 1, (0.0, 1e-2), (0.0, 1.0))
    slider = stribeck.given_film(np.linspace(2e-6, 1e-6, 20)[None, :], grid, speeds=(0.02, 0.0), eta0=0.01)
    assert shown(slider.force) == {"lower": "N", "upper": "N"} and shown(slider)["force.lower"] == "N"
    assert slider.force.lower < 0.0 < slider.force.upper


def test_bodies_of_a_run_are_read(rough: stribeck.Scene, tmp_path: Path) -> None:
    simulation = stribeck.Simulation(rough)
    simulation.run(1, 60.0)
    bodies = dict(zip(("ball", "disc"), simulation.bodies, strict=True))
    parts = ("initial", "wear", "plastic_depth", "tribofilm")
    path = tmp_path / "fields.npz"
    np.savez(path, **{f"{name}_{part}": body[part] for name, body in bodies.items() for part in parts})
    other = stribeck.Simulation(rough, bodies=tuple(stribeck.read_body(rough, path, name) for name in bodies))
    for one, two in zip(simulation.bodies, other.bodies, strict=True):
        np.testing.assert_array_equal(one.surface, two.surface)
    with pytest.raises(stribeck.FileError, match="none.npz"):
        stribeck.read_body(rough, tmp_path / "none.npz", "ball")


def test_given_films_warn_and_are_required_to_converge() -> None:
    grid = stribeck.Grid.box(20, 1, (0.0, "1 mm"), (0.0, "1 m"))
    film = np.linspace(2e-6, 1e-6, 20)[None, :]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solved = stribeck.given_film(film, grid, speeds=(0.02, 0.0), eta0="10 mPa s", alpha="15 1/GPa")
    assert solved.require_converged() is solved and solved.warnings == []
    np.testing.assert_array_equal(solved.film, film)
    for changed, field in [({"alpha": 15.0}, "alpha"), ({"eta0": 50.0}, "eta0"), ({"film": 1e4 * film}, "film")]:
        arguments = {"film": film, "grid": grid, "speeds": (0.02, 0.0), "eta0": 0.01, **changed}
        with pytest.warns(stribeck.StribeckWarning, match=f"{field} = "):
            assert stribeck.given_film(**arguments).warnings[0].field == field
    with pytest.warns(stribeck.StribeckWarning):
        lost = stribeck.given_film(film, grid, speeds=(0.02, 0.0), eta0=1e300)
    with pytest.raises(stribeck.NotConvergedError, match="the film ended as diverged"):
        lost.require_converged()
    assert solved.pressure_at(np.nan) is None


def test_surfaces_and_bodies_are_copied(rough: stribeck.Scene) -> None:
    heights = np.random.default_rng(1).standard_normal((32, 32)) * 1e-8
    surface = stribeck.surface.Surface(heights, 1e-6, defined=heights > -1e-8)
    for again in (copy.copy(surface), copy.deepcopy(surface), pickle.loads(pickle.dumps(surface))):
        np.testing.assert_array_equal(again.heights, surface.heights)
        np.testing.assert_array_equal(again.defined, surface.defined)
        assert (again.dx, again.dy) == (1e-6, 1e-6)
    body = stribeck.BodyStart(rough, heights)
    assert copy.copy(body) is body and copy.deepcopy([body])[0] is body
    scene = rough.replace(tribofilm={})
    simulation = stribeck.Simulation(scene)
    simulation.step(60.0)
    for start in simulation.starts():
        again = pickle.loads(pickle.dumps(start))
        for (name, field), other in zip(start._raw.fields()[0].items(), again._raw.fields()[0].values(), strict=True):
            np.testing.assert_array_equal(field, other, name)
        np.testing.assert_array_equal(start._raw.fields()[1], again._raw.fields()[1])
    stribeck.Simulation(scene, bodies=tuple(pickle.loads(pickle.dumps(simulation.starts()))))


def test_fields_are_maps_that_belong_to_python(rough: stribeck.Scene, tmp_path: Path) -> None:
    solution = stribeck.solve(rough.replace(grid={"nx": 32, "ny": 40, "x": [-2.5e-4, 2.5e-4], "y": [-2.5e-4, 2.5e-4]}))
    for name, field in solution.fields.items():
        assert field.shape == (40, 32) and field.flags.c_contiguous, name
    load = solution.fields["pressure"].sum() * solution.grid.dx * solution.grid.dy
    assert load == pytest.approx(solution.hertz.force, rel=1e-5)
    assert solution.fields["in_contact"].dtype == bool
    solution.save_fields(tmp_path / "fields.npz")
    with np.load(tmp_path / "fields.npz") as archive:
        np.testing.assert_array_equal(archive["film"], solution.fields["film"])
        assert archive["x"].shape == (32,) and archive["y"].shape == (40,)
        np.testing.assert_array_equal(archive["x"], solution.grid.x)
        assert archive["x"][-1] == pytest.approx(2.5e-4 - 0.5 * solution.grid.dx)


def test_heights_in_memory(rough: stribeck.Scene) -> None:
    simulation = stribeck.Simulation(rough)
    ball, disc = (body.initial for body in simulation.bodies)
    named = stribeck.solve(rough)
    bare = rough.replace(roughness=None)
    for heights in [(ball, disc), {"ball": ball, "disc": disc}, (ball.astype(np.float64, order="F"), disc.tolist())]:
        given = stribeck.solve(bare, heights=heights)
        assert given.film == named.film and given.friction == named.friction
    half = rough.to_dict()
    half["roughness"].pop("disc")
    assert stribeck.solve(half, heights=disc).contact == named.contact
    worn = stribeck.BodyStart(rough, disc, wear=disc - disc.min())
    assert stribeck.solve(rough, bodies=(None, worn)).roughness.composite_rq < 0.5 * named.roughness.composite_rq


def test_a_start_is_a_first_guess(rough: stribeck.Scene) -> None:
    first = stribeck.solve(rough)
    again = stribeck.solve(rough, start=first)
    assert again.work.iterations < first.work.iterations
    assert again.film.central == pytest.approx(first.film.central, rel=1e-3)


@pytest.mark.parametrize(("solver", "speed"), [("auto", 5.0), ("newton_krylov", 5.0), ("multigrid", 5.0), ("dry", 5.0)])
def test_solvers_by_name(smooth: stribeck.Scene, solver: str, speed: float) -> None:
    # Multigrid has ambient pressure at the edge of the box.
    scene = smooth.replace(lubricant={"inlet": "box_edge"})
    solution = stribeck.solve(scene, solver=solver)
    assert solution.converged
    if solver not in ("auto", "dry"):
        assert solution.solver == solver
    if solver == "dry":
        assert solution.moes is None and solution.film.mean_central < 1e-9


def test_histories_run_stop_and_go_on(rough: stribeck.Scene, tmp_path: Path) -> None:
    scene = rough.replace(tribofilm={})
    whole = stribeck.Simulation(scene).run(4, 60.0)
    simulation = stribeck.Simulation(scene)
    seen = []

    def second(sim: stribeck.Simulation, record: stribeck.Record) -> bool:
        seen.append((sim.steps, record.step))
        return record.step == 1

    first = simulation.run(4, 60.0, callback=second)
    assert first.stopped and len(first) == 2 and seen == [(1, 0), (2, 1)]
    simulation.save(tmp_path / "checkpoint")
    forks = [simulation.fork(), copy.copy(simulation), copy.deepcopy(simulation), stribeck.Simulation(scene)]
    forks[-1].restore(tmp_path / "checkpoint")
    for fork in [*forks, simulation]:
        assert (fork.steps, fork.time) == (2, 120.0)
        rest = fork.run(2, 60.0)
        assert all(same(a, b) for a, b in zip(rest, whole[2:], strict=True))
    again = pickle.loads(pickle.dumps(simulation))
    assert (again.steps, len(again.history)) == (4, 4) and same(again.history[3], whole[3])
    assert same(again.step(60.0), simulation.fork().step(60.0))

    def raising(sim: stribeck.Simulation, record: stribeck.Record) -> None:
        raise StopIteration

    assert simulation.run(3, 60.0, callback=raising).stopped and simulation.steps == 5
    with pytest.raises(ZeroDivisionError):
        simulation.run(3, 60.0, callback=lambda sim, record: 1 / 0)
    assert simulation.steps == 6 and len(simulation.history) == 6


def test_schedules_and_bounds_of_steps(rough: stribeck.Scene) -> None:
    schedule = {"entrainment_speed": {"kind": "steps", "times": [0.0, 90.0], "values": [0.1, 0.2]}}
    simulation = stribeck.Simulation(rough.replace(schedule=schedule))
    history = simulation.run_until(150.0, 60.0)
    assert history["time"].tolist() == [60.0, 90.0, 150.0]
    assert history["motion.entrainment_speed"].tolist() == [0.1, 0.1, 0.2]
    assert simulation.conditions.motion.entrainment_speed == 0.2
    short = stribeck.Simulation(rough).step(1e4, depth=1e-9)
    assert short.time_step < 1e4 and max(short.wear.ball_max, short.wear.disc_max) <= 1e-9
    faster = simulation.solve_under(entrainment_speed=2.0)
    assert faster.contact.load_ratio < simulation.solve_under().contact.load_ratio
    assert simulation.steps == 3


def test_records_are_a_structured_array(rough: stribeck.Scene) -> None:
    history = stribeck.Simulation(rough).run(2, 60.0)
    table = history.to_numpy()
    assert table.shape == (2,) and table["contact.load_ratio"][1] == history[1].contact.load_ratio == history["contact.load_ratio"][1]
    assert table["status"].tolist() == ["converged"] * 2
    assert list(history.to_dict()) == list(table.dtype.names) and math.isnan(table["thermal.heat"][0])
    assert "contact.load_ratio" in history._repr_html_() and "120 s" in repr(history)
    assert history[0].to_dict()["step"] == 0
    assert stribeck.History().to_numpy().size == 0
    np.testing.assert_array_equal(np.asarray(history)["time"], history["time"])
    assert "film.central" in history and "film" not in history and history[0] in history


def test_the_account_of_the_bodies(rough: stribeck.Scene) -> None:
    simulation = stribeck.Simulation(rough.replace(tribofilm={}))
    simulation.run(2, 60.0)
    for body in simulation.bodies:
        account = body.initial - body.wear - body.plastic_depth + body.tribofilm
        np.testing.assert_allclose(body.surface, account, atol=1e-20)
    assert simulation.bodies[1].wear.max() > 0 and simulation.fields["pressure"].max() > 1e9
    # Arrays are copies: what is written to them stays in Python.
    simulation.bodies[1].wear[:] = 0.0
    simulation.fields["pressure"][:] = 0.0
    assert simulation.bodies[1].wear.max() > 0 and simulation.fields["pressure"].max() > 1e9
    assert simulation.mean_on_track(np.full((32, 32), 3.0)) == pytest.approx(3.0)
    second = stribeck.Simulation(rough.replace(tribofilm={}, motion={"entrainment_speed": 0.2}), bodies=simulation.starts())
    np.testing.assert_array_equal(second.bodies[1].surface, simulation.bodies[1].surface)


def test_units_and_warnings() -> None:
    scene = stribeck.Scene.azam_2019(256)
    assert scene.warnings == []
    spoken = scene.replace(form={"kind": "sphere", "radius": "9.525 mm"}, lubricant={"eta0": "4 mPa s"})
    assert spoken == scene
    odd = scene.replace(lubricant=None, form={"kind": "sphere", "radius": 9.525}, load={"hertz_pressure": 1e8}, roughness=None,
                        grid={"nx": 16, "ny": 16, "x": [-0.02, 0.02], "y": [-0.02, 0.02]}, wear=None, tribofilm=None)
    assert odd.warnings[0].field == "form.radius" and odd.warnings[0].value == 9.525
    with pytest.warns(stribeck.StribeckWarning, match="form.radius = 9.525"):
        solution = stribeck.solve(odd)
    assert "form.radius" in [warning.field for warning in solution.warnings]
    with pytest.warns(stribeck.StribeckWarning, match="form.radius"):
        simulation = stribeck.Simulation(odd.replace(motion={"entrainment_speed": 0.1, "slide_roll_ratio": 0.5}))
    assert simulation.warnings[0].remedy
    again = pickle.loads(pickle.dumps(solution.warnings[0]))
    assert (again.field, again.value, str(again)) == ("form.radius", 9.525, str(solution.warnings[0]))


def test_threads_solve_side_by_side(rough: stribeck.Scene) -> None:
    expected = stribeck.solve(rough).to_dict()
    found: list[dict] = []
    threads = [threading.Thread(target=lambda: found.append(stribeck.solve(rough).to_dict())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4
    for numbers in found:
        assert {**numbers, "seconds": 0.0} == {**expected, "seconds": 0.0}


def test_the_interpreter_is_free_while_rust_works() -> None:
    scene, counted, done = stribeck.Scene.azam_2019(64), 0, threading.Event()

    def work() -> None:
        stribeck.solve(scene)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
        done.wait(1e-3)
    thread.join()
    assert counted > 20


def test_solves_leave_nothing_behind() -> None:
    scene = stribeck.Scene.azam_2019(16).replace(lubricant=None, wear=None, solver={"tolerance": 1e-2})

    def solves(count: int) -> int:
        for _ in range(count):
            stribeck.solve(scene, friction=lambda pressure, speed, ball, disc: 0.1)
        # empties the free lists of Python, which hold up to 2000 tuples
        gc.collect()
        return resident()

    solves(100)
    tracemalloc.start()
    before = solves(50)
    python_before = tracemalloc.take_snapshot()
    after = solves(1000)
    grown = sum(line.size_diff for line in tracemalloc.take_snapshot().compare_to(python_before, "filename"))
    tracemalloc.stop()
    # A lost field of 256 nodes a solve would be 2 MB, a lost Python object some 100 kB.
    assert after - before < 1_000_000
    assert grown < 50_000


def resident() -> int:
    """Memory of this process in use, in bytes."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


def test_surfaces_are_read_prepared_and_written(tmp_path: Path) -> None:
    surface = stribeck.surface.read(ROOT / "tests/data/surfaces/cut.x3p")
    assert surface.heights.shape == surface.shape == surface.defined.shape
    level = surface.fill_undefined().remove_plane()
    assert level.undefined == 0
    assert abs(stribeck.metrics.height_statistics(level.heights).mean) < 1e-12
    cutoff = 4.0 * surface.dx
    fine, coarse = level.l_filter(cutoff).heights, level.s_filter(cutoff).heights
    np.testing.assert_allclose(fine + coarse, level.heights, atol=1e-9 * np.ptp(level.heights))
    assert stribeck.metrics.height_statistics(level.set_rq(1e-7).heights).sq == pytest.approx(1e-7)
    level.write(tmp_path / "level.x3p")
    np.testing.assert_array_equal(stribeck.surface.read(tmp_path / "level.x3p").heights, level.heights)
    assert level.rotated_90().shape == level.shape[::-1]
    assert level.crop((1, 2), 5, 4).heights.tolist() == level.heights[2:6, 1:6].tolist()
    tilted = stribeck.surface.Surface(np.add.outer(np.zeros(20), np.arange(30.0)), 1e-6)
    assert np.abs(tilted.remove_plane().heights).max() < 1e-12


def test_surfaces_are_generated(rough: stribeck.Scene) -> None:
    grid = rough.grid
    heights = stribeck.surface.generate(grid, 20e-9, length=60e-6, seed=1)
    assert heights.shape == grid.shape
    assert stribeck.metrics.height_statistics(heights).sq == pytest.approx(20e-9)
    named = {"kind": "gaussian", "rq": 20e-9, "length_x": 60e-6, "length_y": 60e-6, "seed": 1}
    ball = stribeck.Simulation(rough.replace(roughness={"ball": named})).bodies[0].initial
    np.testing.assert_array_equal(heights, ball)
    fractal = stribeck.surface.generate(grid, 1e-8, kind="self_affine", hurst=0.8, roll_off=2e-4, shortest=4e-5, seed=2)
    assert stribeck.metrics.height_statistics(fractal).sq == pytest.approx(1e-8)
    grooved = stribeck.surface.grooves(grid, width=60e-6, depth=1e-6, pitch=125e-6)
    assert grooved.min() < -0.5e-6 and np.ptp(grooved, axis=0).max() == 0.0
    assert stribeck.surface.dimples(grid, radius=60e-6, depth=1e-6, pitch=250e-6, seed=3).min() < 0.0


def test_formulas_and_metrics() -> None:
    modulus = stribeck.analytic.equivalent_modulus((210e9, 0.3), (210e9, 0.3))
    assert modulus == pytest.approx(210e9 / 0.91)
    ball = stribeck.analytic.hertz_point(10e-3, equivalent_modulus=modulus, load=50.0)
    again = stribeck.analytic.hertz_point(10e-3, equivalent_modulus=modulus, max_pressure=ball.pressure)
    assert again.force == pytest.approx(50.0) and ball.half_width_x == pytest.approx((1.5 * 50 * 10e-3 / modulus) ** (1 / 3))
    line = stribeck.analytic.hertz_line(10e-3, equivalent_modulus=modulus, load=1e5)
    assert line.pressure == pytest.approx((1e5 * modulus / (2 * np.pi * 10e-3)) ** 0.5)
    oil = {"entrainment_speed": 1.0, "eta0": 0.04, "alpha": 2e-8, "equivalent_modulus": modulus, "radius": 10e-3}
    point = stribeck.analytic.point_films(load=50.0, **oil)
    assert 0.4 < point.hamrock_dowson_minimum / point.hamrock_dowson_central < 0.7
    assert point.film_map.regime == "piezoviscous-elastic" and 0.8 < point.film_map.central / point.hamrock_dowson_central < 1.2
    assert stribeck.analytic.line_films(load=1e5, **oil).dowson_toyoda_central > 1e-8
    wave = stribeck.analytic.westergaard(amplitude=1e-7, wavelength=1e-4, equivalent_modulus=modulus, mean_pressure=1e6)
    assert 0 < wave.contact_half_width < 0.5e-4
    heights = np.random.default_rng(1).normal(size=(64, 48)) * 1e-7
    numbers = stribeck.metrics.height_statistics(heights)
    assert numbers.sq == pytest.approx(heights.std()) and numbers.mean == pytest.approx(heights.mean())
    assert stribeck.metrics.bearing(heights).sk == pytest.approx(2.56e-7, rel=0.1)
    assert stribeck.metrics.hybrid_parameters(heights, 1e-6).sdq > 0.1
    assert stribeck.metrics.spatial_parameters(heights, 1e-6).sal < 3e-6
    wavenumber, density = stribeck.metrics.radial_spectrum(heights, 1e-6)
    assert wavenumber.shape == density.shape and (density > 0).all()
    contact = np.zeros((10, 10), dtype=bool)
    contact[2:4, 2:4] = contact[7, 7] = True
    patches = stribeck.metrics.contact_patches(contact, dx=1e-6)
    assert sorted(patches.areas.tolist()) == pytest.approx([1e-12, 4e-12])
    shares = stribeck.metrics.contact_statistics(contact, 1e9 * contact, dx=1e-6, load=0.01, half_width_x=4e-6)
    assert shares.area == pytest.approx(5e-12) and shares.load_ratio == pytest.approx(0.5)
    assert stribeck.metrics.lambda_ratio(3e-8, stribeck.metrics.composite_rq(3e-8, 4e-8)) == pytest.approx(0.6)


def test_pictures(rough: stribeck.Scene) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from stribeck import plot

    solution = stribeck.solve(rough)
    image = plot.map(solution, "pressure")
    np.testing.assert_array_equal(image.get_array(), solution.fields["pressure"] * 1e-9)
    assert image.axes.get_xlabel() == "x, um"
    first, second = plot.profile(solution, ["film", "gap"], along="y")
    assert [line.get_label() for line in (first, second)] == ["film, nm", "gap, um"]
    assert first.axes is not second.axes and first.axes.bbox.bounds == second.axes.bbox.bounds
    history = stribeck.Simulation(rough).run(2, 60.0)
    (line,) = plot.history(history, "wear.disc_max")
    assert line.axes.get_ylabel() == "wear disc max, m" and line.get_xdata().tolist() == [60.0, 120.0]
    plt.close("all")


def test_pictures_of_whatever_has_fields(rough: stribeck.Scene, tmp_path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from stribeck import plot

    solution, simulation = stribeck.solve(rough), stribeck.Simulation(rough)
    frames = []
    simulation.run(3, 60.0, callback=lambda s, _: frames.append((s.grid, s.fields)))
    box = stribeck.Grid.box(8, 4, (0.0, 1e-3), (0.0, 1e-3))
    pad = stribeck.given_film(np.full((4, 8), 1e-6), box, speeds=(1.0, 0.0), eta0=0.01)
    measured = stribeck.surface.Surface(np.arange(12.0).reshape(3, 4) * 1e-9, 1e-6)
    wanted = [(solution, solution.fields["film"]), (simulation, simulation.fields["film"]), (frames[0], frames[0][1]["film"]), (pad, pad.film)]
    for shown, film in wanted:
        np.testing.assert_array_equal(plot.map(shown).get_array(), film * 1e9)
    assert plot.map(measured).get_extent() == pytest.approx([0.0, 4.0, 0.0, 3.0])
    assert np.asarray(plot.profile(measured)[0].get_ydata()) == pytest.approx([0.004, 0.005, 0.006, 0.007])
    pytest.importorskip("xarray")
    np.testing.assert_array_equal(plot.map(solution.to_xarray()).get_array(), solution.fields["film"] * 1e9)
    moving = plot.animation(frames, "film")
    moving.save(tmp_path / "film.gif", writer="pillow")
    assert (tmp_path / "film.gif").read_bytes()[:3] == b"GIF"
    for wrong in (3, (box, 3), {}):
        with pytest.raises(stribeck.InputError, match="shown"):
            plot.map(wrong)
    with pytest.raises(stribeck.InputError, match="frames"):
        plot.animation([])
    plt.close("all")


def test_curves_of_a_sweep_are_lines_over_its_first_input(rough: stribeck.Scene) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from stribeck import plot

    over = {"motion.entrainment_speed": [0.01, 0.1, 1.0], "load.force": [5.0, 10.0]}
    sweep = stribeck.sweep(rough.replace(load={"force": 5.0}), over)
    lines = plot.curve(sweep, "film.mean_central")
    assert [line.get_label() for line in lines] == ["load.force = 5", "load.force = 10"]
    assert lines[0].get_xdata().tolist() == [0.01, 0.1, 1.0] and lines[0].axes.get_xscale() == "log"
    np.testing.assert_array_equal(lines[1].get_ydata(), sweep["film.mean_central"].reshape(3, 2)[:, 1])
    assert len(plot.curve(sweep, over="load.force")) == 3
    with pytest.raises(stribeck.UnknownNameError, match="film.centrall"):
        plot.curve(sweep, "film.centrall")
    with pytest.raises(stribeck.InputError, match="sweep"):
        plot.curve(rough)
    plt.close("all")


class HalfSpaceByNumpy:
    """The half-space of the scene by Love's coefficients and NumPy's transform."""

    def __init__(self, scene: stribeck.Scene, modulus: float) -> None:
        grid = scene.grid
        nx, ny, dx, dy = grid.nx, grid.ny, grid.dx, grid.dy
        self.modulus = modulus
        x = (np.arange(2 * nx) - nx)[None, :] * dx
        y = (np.arange(2 * ny) - ny)[:, None] * dy

        def corner(x, y):
            r = np.hypot(x, y)
            return x * np.log(y + r) + y * np.log(x + r)

        a, b = dx / 2, dy / 2
        kernel = corner(x + a, y + b) + corner(x - a, y - b) - corner(x + a, y - b) - corner(x - a, y + b)
        self._spectrum = np.fft.rfft2(np.fft.ifftshift(2.0 / (np.pi * modulus) * kernel))

    def displacement(self, pressure):
        ny, nx = pressure.shape
        padded = np.zeros((2 * ny, 2 * nx))
        padded[:ny, :nx] = pressure
        return np.fft.irfft2(np.fft.rfft2(padded) * self._spectrum, s=padded.shape)[:ny, :nx]


@pytest.mark.parametrize("dry", [True, False])
def test_deformation_in_python(rough: stribeck.Scene, dry: bool) -> None:
    scene = rough.replace(solver={"kind": "dry"}) if dry else rough
    model = HalfSpaceByNumpy(scene, 229.67e9)
    own, usual = stribeck.solve(scene, deformation=model), stribeck.solve(scene)
    assert own.status == usual.status == "converged"
    assert own.pressure.max == pytest.approx(usual.pressure.max, rel=1e-4)
    assert own.film.mean_central == pytest.approx(usual.film.mean_central, rel=1e-4, abs=1e-12)
    simulation = stribeck.Simulation(scene, deformation=model)
    record = simulation.step(60.0)
    assert record.contact.load_ratio == pytest.approx(stribeck.Simulation(scene).step(60.0).contact.load_ratio, rel=1e-3)
    fork = simulation.fork()
    assert same(fork.step(60.0), simulation.step(60.0))


def test_forks_fail_alone(rough: stribeck.Scene) -> None:
    bad = threading.local()

    def wear(at, film):
        if getattr(bad, "now", False):
            raise ValueError("only here")
        return 1e-15

    first = stribeck.Simulation(rough, wear=wear)
    first.step(60.0)
    forks = [first.fork(), first.fork()]
    raised: list[BaseException | None] = [None, None]

    def steps(index: int) -> None:
        bad.now = index == 1
        for _ in range(3):
            try:
                forks[index].step(60.0)
            except stribeck.LawError as error:
                raised[index] = error

    threads = [threading.Thread(target=steps, args=(index,)) for index in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert raised[0] is None and "only here" in str(raised[1])
    assert [fork.steps for fork in forks] == [4, 1]


def test_own_laws_and_heights_are_looked_at(rough: stribeck.Scene) -> None:
    def said(field: str, **parts: Any) -> None:
        with pytest.warns(stribeck.StribeckWarning):
            solution = stribeck.solve(rough, **parts)
        assert field in [item.field for item in solution.warnings]

    said("friction.coefficient", friction=lambda *_: 1150.0)
    said("viscosity", viscosity=lambda pressure: 10.0 * np.exp(1.8e-8 * np.minimum(pressure, 1e9)))
    heights = np.random.default_rng(1).standard_normal((32, 32)) * 1e-7
    said("roughness.disc_rq", heights=1e-6 * heights)
    said("roughness.disc", heights=heights + 1.0)
    with pytest.warns(stribeck.StribeckWarning, match="growth = 150"):
        stribeck.Simulation(rough, growth=stribeck.laws.Growth(lambda *_: 0.0, 150.0))


def test_tables_of_another_law_are_replaced_whole(rough: stribeck.Scene) -> None:
    worn = rough.replace(wear={"law": "archard", "exposure": "contact_clock", "coefficient": 1e-8, "hardness": 6e9})
    other = worn.replace(wear={"law": "frictional_energy", "exposure": "contact_clock", "volume_per_energy": 1e-16})
    assert "coefficient" not in other.to_dict()["wear"]
    assert worn.replace(wear={"law": "archard", "coefficient": 2e-8}).to_dict()["wear"]["hardness"] == 6e9


def test_a_run_does_not_end_before_it_begins(rough: stribeck.Scene) -> None:
    with pytest.raises(stribeck.InputError, match="end = -5"):
        stribeck.Simulation(rough).run_until(-5.0, 1.0)
