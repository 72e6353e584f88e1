"""Results for pandas and xarray, scenes as values."""

from __future__ import annotations

import pickle
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
    assert stribeck.units("scene.motion.entrainment_speed") == "m/s"


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
