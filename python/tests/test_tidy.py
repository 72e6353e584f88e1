"""Results for pandas and xarray, scenes as values."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import stribeck


def test_full_names_reach_numbers_of_a_solution(rough: stribeck.Scene) -> None:
    solution = stribeck.solve(rough)
    assert solution["film.central"] == solution.film.central and solution["contact.load_ratio"] == solution.contact.load_ratio
    with pytest.raises(stribeck.UnknownNameError, match="centrall"):
        solution["film.centrall"]
    assert "lambda_" in dir(solution.film) and "lambda" not in dir(solution.film)
    assert stribeck.units("film.central") == stribeck.units("film") == "m" and stribeck.units("friction.coefficient") == ""
    assert stribeck.units("scene.motion.entrainment_speed") == "m/s" and stribeck.units("form.radii") == "m"
    assert stribeck.units("thermal.surface_rise_ball") == "K" and stribeck.units("film_central") == "m"


@pytest.mark.parametrize(
    ("name", "near"),
    [("film.centrall", "film.central"), ("motion.entrainment_sped", "motion.entrainment_speed"), ("", "film.central"), (3, "film.central")],
)
def test_units_of_an_unknown_name_are_an_error_with_the_nearest_names(name: str, near: str) -> None:
    with pytest.raises(stribeck.UnknownNameError, match=near) as caught:
        stribeck.units(name)
    assert caught.value.field == "name" and caught.value.value == name


def test_every_name_of_a_table_has_a_unit(rough: stribeck.Scene) -> None:
    pytest.importorskip("pandas")
    solution = stribeck.solve(rough)
    sweep = stribeck.sweep(rough, {"load.force": [20.0]}, measure=lambda solution: {"peak": 1.0})
    for table in (solution.to_pandas(), sweep.to_pandas(), stribeck.Simulation(rough).run(1, 10.0).to_pandas()):
        assert all(unit == stribeck.units(name) for name, unit in table.attrs["units"].items() if name != "peak")
    assert stribeck.units("stress") == "" and stribeck.units("stress.von_mises.stress") == "Pa"


def test_fields_of_solutions_are_read_only(rough: stribeck.Scene) -> None:
    pytest.importorskip("xarray")
    solution = stribeck.solve(rough)
    for one in (solution, pickle.loads(pickle.dumps(solution))):
        with pytest.raises(ValueError, match="read-only"):
            one.fields["film"][0, 0] = 0.0
        with pytest.raises(TypeError, match="assignment"):
            one.fields["film"] = one.fields["gap"]
    own = solution.fields["film"].copy()
    own[0, 0] = 0.0
    solution.to_xarray()["film"][0, 0] = 0.0
    assert solution == stribeck.solve(rough) and stribeck.solve(rough, start=solution).converged


def test_results_are_equal_to_their_pickles(rough: stribeck.Scene) -> None:
    def again(value: object) -> object:
        return pickle.loads(pickle.dumps(value))

    scene = rough.replace(tribofilm={})
    simulation = stribeck.Simulation(scene)
    history = simulation.run(2, 10.0)
    assert history == again(history) == history[:] and history != history[:1] and simulation.history == history
    ball, disc = simulation.starts()
    assert (ball, disc) == again((ball, disc)) and ball != disc and disc != stribeck.Simulation(scene).starts()[1]
    body = simulation.bodies[0]
    assert body == again(body) and body != simulation.bodies[1]
    over = {"load.force": [10.0, 20.0]}
    sweep = stribeck.sweep(rough, over, measure=lambda solution: float("nan"))
    # whatever seconds it took
    assert sweep == again(sweep) == stribeck.sweep(rough, over, measure=lambda solution: float("nan"))
    assert sweep[0] == again(sweep[0]) and sweep[0] != sweep[1] and sweep != stribeck.sweep(rough, over)


def test_given_film_becomes_a_row_and_a_dataset(tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    grid = stribeck.Grid.box(12, 6, (0.0, "20 mm"), (0.0, "10 mm"))
    film = stribeck.given_film(lambda x, y: 2e-5 - 5e-4 * x, grid, speeds=(1.0, 0.0), eta0=0.01)
    row = film.to_pandas()
    assert len(row) == 1 and row["force.lower"][0] == film.force.lower and row.attrs["units"]["force.lower"] == "N"
    data = film.to_xarray()
    np.testing.assert_array_equal(data["pressure"].values, film.pressure)
    np.testing.assert_array_equal(data.x.values, grid.x)
    assert data["film"].attrs["units"] == "m" and data["theta"].attrs["units"] == "" and data.attrs["load"] == film.load
    with pytest.raises(ValueError, match="read-only"):
        film.pressure[0, 0] = 0.0


def test_missing_packages_are_named(rough: stribeck.Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    from stribeck import plot

    solution = stribeck.solve(rough)
    surface = stribeck.surface.Surface(np.eye(4), 1e-6)
    users = {
        "pandas": [solution.to_pandas],
        "xarray": [solution.to_xarray, surface.to_xarray],
        "matplotlib": [lambda: plot.map(solution), surface.plot],
        "SurfaceTopography": [surface.to_surface_topography],
    }
    for package, calls in users.items():
        for module in [name for name in sys.modules if name == package or name.startswith(f"{package}.")]:
            monkeypatch.delitem(sys.modules, module)
        monkeypatch.setitem(sys.modules, package, None)
        for call in calls:
            with pytest.raises(ImportError, match=f"pip install {package}"):
                call()


def test_solutions_are_equal_by_scene_and_fields(rough: stribeck.Scene) -> None:
    one, two = stribeck.solve(rough), stribeck.solve(rough)
    assert one == two == pickle.loads(pickle.dumps(one)) and one.scene == rough
    assert one != stribeck.solve(rough.replace(load={"force": 10.0}))


def test_solution_becomes_a_row_and_a_dataset(rough: stribeck.Scene, tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    solution = stribeck.solve(rough)
    row = solution.to_pandas()
    assert len(row) == 1 and row["film.central"][0] == solution.film.central
    assert row["scene.motion.entrainment_speed"][0] == rough.motion.entrainment_speed
    data = solution.to_xarray()
    np.testing.assert_array_equal(data["pressure"].values, solution.fields["pressure"])
    np.testing.assert_array_equal(data.x.values, solution.grid.x)
    assert data["film"].attrs["units"] == "m" and data.attrs["film.central"] == solution.film.central
    assert stribeck.Scene(data.attrs["scene"]) == rough
    pytest.importorskip("netCDF4")
    data.to_netcdf(tmp_path / "solution.nc")
    with xarray.open_dataset(tmp_path / "solution.nc") as again:
        np.testing.assert_array_equal(again["in_contact"].values, solution.fields["in_contact"])
        assert again.attrs["film.central"] == solution.film.central


def test_history_becomes_a_table_and_a_dataset(rough: stribeck.Scene) -> None:
    pytest.importorskip("pandas")
    history = stribeck.Simulation(rough).run(3, 10.0)
    table = history.to_pandas()
    assert table["time"].tolist() == [10.0, 20.0, 30.0] and table.attrs["units"]["time"] == "s"
    data = history.to_xarray()
    assert data["film.mean_central"].dims == ("step",) and data.time.values.tolist() == [10.0, 20.0, 30.0]


def test_scenes_are_values_with_attributes(rough: stribeck.Scene) -> None:
    assert hash(rough) == hash(stribeck.Scene(rough.to_toml())) and len({rough, stribeck.Scene(rough)}) == 1
    assert rough.motion.entrainment_speed == rough.to_dict()["motion"]["entrainment_speed"]
    assert "motion" in dir(rough) and rough.grid.shape == (32, 32)
    with pytest.raises(AttributeError, match="motoin"):
        _ = rough.motoin
    changed = rough.replace(**{"motion.entrainment_speed": "2 m/s", "wear": None})
    assert changed == rough.replace(motion={"entrainment_speed": 2.0}, wear=None)


def test_pictures_are_at_hand_without_matplotlib() -> None:
    code = "import sys, stribeck; assert callable(stribeck.plot.map) and 'matplotlib' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_unknown_name_among_many_is_refused_with_the_nearest(rough: stribeck.Scene) -> None:
    simulation = stribeck.Simulation(rough)
    simulation.step("1 s")
    with pytest.raises(stribeck.UnknownNameError, match="nearest of .* names: friction.coefficient") as caught:
        simulation.history["frictoin.coefficient"]
    assert len(str(caught.value)) < 300
