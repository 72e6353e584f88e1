"""Sweeps: the same points and bits for any executor, kept and resumed."""

from __future__ import annotations


import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stribeck

SPEEDS = [0.05, 0.1, 0.2, 0.4, 0.8]
LOADS = ["10 N", "20 N"]
OVER = {"motion.entrainment_speed": SPEEDS, "load.force": LOADS}


@pytest.fixture
def coarse() -> stribeck.Scene:
    return stribeck.Scene.azam_2019(16).replace(solver={"tolerance": 1e-4})


def peak(solution: stribeck.Solution) -> dict[str, Any]:
    return {"peak": solution.fields["pressure"].max(), "rows": solution.grid.ny}


def last_first(calls: Iterable[Any]) -> Iterable[Any]:
    """A ``joblib.Parallel`` that returns results in another order than that of its calls."""
    return (function(*arguments, **keywords) for function, arguments, keywords in reversed(list(calls)))


def dies_at_one(solution: stribeck.Solution) -> float:
    if solution.hertz.force > 15.0:
        os.kill(os.getpid(), signal.SIGKILL)
    return 1.0


def leaves_at_one(solution: stribeck.Solution) -> float:
    if solution.hertz.force > 15.0:
        sys.exit("no licence left")
    return 1.0


def fails_at_one(solution: stribeck.Solution) -> float:
    if solution.hertz.force > 15.0:
        raise ZeroDivisionError("no such value")
    return 1.0


def columns(sweep: stribeck.Sweep) -> dict[str, Any]:
    return {name: values for name, values in sweep.to_dict().items() if name != "seconds"}


def test_points_are_those_of_single_solves(coarse: stribeck.Scene) -> None:
    sweep = stribeck.sweep(coarse, OVER, measure=peak)
    assert len(sweep) == 10 and not sweep.failed
    point = sweep[3]
    assert point.inputs == {"motion.entrainment_speed": 0.1, "load.force": 20.0}
    solution = stribeck.solve(coarse.replace(load={"force": 20.0}, motion={"entrainment_speed": 0.1}))
    assert point.film.central == solution.film.central and point.measured["peak"] == solution.fields["pressure"].max()
    assert sweep["film.central"][3] == solution.film.central and sweep["peak"][3] == point.measured["peak"]
    assert sweep["load.force"].tolist() == [10.0, 20.0] * 5
    again = pickle.loads(pickle.dumps(sweep))
    assert again[3].to_dict() == point.to_dict() and again[3].inputs == point.inputs


def test_any_executor_returns_the_same_bits(coarse: stribeck.Scene) -> None:
    joblib, distributed = pytest.importorskip("joblib"), pytest.importorskip("distributed")
    expected = columns(stribeck.sweep(coarse, OVER, measure=peak))
    with ThreadPoolExecutor(3) as executor:
        found = [stribeck.sweep(coarse, OVER, measure=peak, executor=executor)]
    for method in ("fork", "spawn"):
        with ProcessPoolExecutor(2, mp_context=get_context(method)) as executor:
            found.append(stribeck.sweep(coarse, OVER, measure=peak, executor=executor))
    found.append(stribeck.sweep(coarse, OVER, measure=peak, executor=joblib.Parallel(2)))
    found.append(stribeck.sweep(coarse, OVER, measure=peak, executor=last_first))
    with distributed.Client(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None) as client:
        found.append(stribeck.sweep(coarse, OVER, measure=peak, executor=client))
    for sweep in found:
        for name, values in columns(sweep).items():
            np.testing.assert_array_equal(values, expected[name], name)


def test_points_that_fail_are_kept_and_named(coarse: stribeck.Scene) -> None:
    sweep = stribeck.sweep(coarse, {"load.force": [10.0, -3.0, 20.0]}, measure=lambda solution: {"force": solution.hertz.force})
    assert sweep["status"].tolist() == ["converged", "refused", "converged"]
    (failed,) = sweep.failed
    assert failed.inputs == {"load.force": -3.0} and "load.force" in (failed.error or "")
    assert np.isnan(sweep["film.central"][1]) and sweep["force"][2] == pytest.approx(20.0, rel=1e-12)
    sweep = stribeck.sweep(coarse, OVER, measure=fails_at_one)
    assert [point.inputs["load.force"] for point in sweep.failed] == [20.0] * 5
    assert all("ZeroDivisionError: no such value" in (point.error or "") for point in sweep.failed)
    odd = stribeck.sweep(coarse, {"load.force": [10.0]}, measure=lambda solution: solution.fields)
    assert "ndarray" in (odd[0].error or "") and odd[0].status == "converged"


def test_zip_goes_side_by_side(coarse: stribeck.Scene) -> None:
    sweep = stribeck.sweep(coarse, {"motion.entrainment_speed": [0.1, 0.2], "load.force": [10, 20]}, how="zip")
    assert [point.inputs["load.force"] for point in sweep] == [10.0, 20.0]
    assert sweep.to_xarray()["film.central"].dims == ("point",)


def test_what_does_not_fit_is_refused(coarse: stribeck.Scene, tmp_path: Path) -> None:
    with pytest.raises(stribeck.SceneError, match="entrainment_sped"):
        stribeck.sweep(coarse, {"motion.entrainment_sped": [1.0]})
    with pytest.raises(stribeck.InputError, match="different lengths"):
        stribeck.sweep(coarse, {"motion.entrainment_speed": [1.0], "load.force": [1.0, 2.0]}, how="zip")
    for over in ({}, {"load.force": 3.0}, {"load.force": "3 N"}):
        with pytest.raises(stribeck.InputError, match="over"):
            stribeck.sweep(coarse, over)  # type: ignore[arg-type]
    for keywords in ({"how": "both"}, {"executor": 3}, {"shard": (2, 2)}, {"shard": 1}, {"law": 1}, {"measure": 1}):
        with pytest.raises(stribeck.InputError):
            stribeck.sweep(coarse, {"load.force": [1.0]}, **keywords)  # type: ignore[arg-type]
    stribeck.sweep(coarse, {"load.force": [10.0]}, folder=tmp_path)
    with pytest.raises(stribeck.InputError, match="another sweep: it differs in over"):
        stribeck.sweep(coarse, {"load.force": [11.0]}, folder=tmp_path)
    with pytest.raises(stribeck.InputError, match="differs in scene"):
        stribeck.sweep(coarse.replace(wear=None), {"load.force": [10.0]}, folder=tmp_path)


class Dying(Executor):
    """Does two tasks and fails."""

    def __init__(self) -> None:
        self.left = 2

    def submit(self, function: Any, /, *arguments: Any, **keywords: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.left -= 1
        if self.left >= 0:
            future.set_result(function(*arguments, **keywords))
        else:
            future.set_exception(RuntimeError("the node is gone"))
        return future


def test_points_of_an_executor_that_dies_are_solved_later(coarse: stribeck.Scene, tmp_path: Path) -> None:
    sweep = stribeck.sweep(coarse, OVER, folder=tmp_path, executor=Dying())
    assert sweep["status"].tolist().count("lost") == 8 and "the node is gone" in (sweep.failed[0].error or "")
    before = {path.name: path.stat().st_mtime_ns for path in tmp_path.glob("point_*.json")}
    assert len(before) == 2
    whole = stribeck.sweep(coarse, OVER, folder=tmp_path)
    assert not whole.failed
    assert {path.name: path.stat().st_mtime_ns for path in tmp_path.glob("point_*.json")}.items() >= before.items()


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_points_of_a_joblib_worker_that_dies_are_lost_and_the_others_kept(coarse: stribeck.Scene, tmp_path: Path) -> None:
    joblib = pytest.importorskip("joblib")
    over = {"load.force": [10.0, 11.0, 20.0, 12.0]}
    sweep = stribeck.sweep(coarse, over, measure=dies_at_one, executor=joblib.Parallel(2), folder=tmp_path)
    assert sweep["status"][2] == "lost" and "Terminated" in (sweep[2].error or "")
    # a point whose file was written before the death is there
    kept = {path.name for path in tmp_path.glob("point_*.json")}
    assert {f"point_{k:06d}.json" for k, point in enumerate(sweep) if point["status"] == "converged"} <= kept
    assert set(sweep["status"]) <= {"converged", "lost"}


def test_measure_that_exits_is_a_failed_point(coarse: stribeck.Scene) -> None:
    sweep = stribeck.sweep(coarse, {"load.force": [10.0, 20.0]}, measure=leaves_at_one)
    assert [point.error for point in sweep] == [None, "measure: SystemExit: no licence left"]


def test_damaged_files_of_points_are_solved_again(coarse: stribeck.Scene, tmp_path: Path) -> None:
    over = {"load.force": [10.0, 20.0]}
    whole = stribeck.sweep(coarse, over, folder=tmp_path)
    sound = (tmp_path / "point_000001.json").read_text()
    for damaged in (sound[:50], "[]", '{"values": [1], "status": "converged", "error": null, "measured": null, "warnings": [{}]}',
                    '{"values": {}, "status": "converged", "error": null, "measured": null, "warnings": []}'):
        (tmp_path / "point_000001.json").write_text(damaged)
        assert stribeck.sweep(coarse, over, folder=tmp_path) == whole, damaged


def test_shards_fill_one_folder(coarse: stribeck.Scene, tmp_path: Path) -> None:
    assert len(stribeck.sweep(coarse, OVER, folder=tmp_path, shard=(0, 3))) == 4
    assert len(stribeck.sweep(coarse, OVER, folder=tmp_path, shard=(2, 3))) == 7
    stribeck.sweep(coarse, OVER, folder=tmp_path, shard=(1, 3))
    whole = stribeck.sweep(coarse, OVER, folder=tmp_path, executor=Dying())
    assert len(whole) == 10 and not whole.failed


KILLED = """
import stribeck, sys
scene = stribeck.Scene.azam_2019(64)
stribeck.sweep(scene, {"motion.entrainment_speed": [0.05 * k for k in range(1, 60)]}, folder=sys.argv[1])
"""


def test_sweep_survives_a_kill(tmp_path: Path) -> None:
    process = subprocess.Popen([sys.executable, "-W", "ignore", "-c", KILLED, str(tmp_path)])
    end = time.monotonic() + 60.0
    while len(list(tmp_path.glob("point_*.json"))) < 3 and time.monotonic() < end:
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    done = sorted(tmp_path.glob("point_*.json"))
    assert 3 <= len(done) < 59
    scene = stribeck.Scene.azam_2019(64)
    speeds = [0.05 * k for k in range(1, 60)]
    sweep = stribeck.sweep(scene, {"motion.entrainment_speed": speeds}, folder=tmp_path, shard=(int(done[0].stem[-6:]), 59))
    assert len(sweep) == len(done)
    one = sweep[0]
    assert one.film.central == stribeck.solve(scene.replace(**{"motion.entrainment_speed": one.inputs["motion.entrainment_speed"]})).film.central


def test_results_are_tidy(coarse: stribeck.Scene, tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    sweep = stribeck.sweep(coarse, OVER)
    frame = sweep.to_pandas()
    assert list(frame.columns[:3]) == ["motion.entrainment_speed", "load.force", "status"] and len(frame) == 10
    assert frame.attrs["units"]["film.central"] == "m" and frame["load.force"].tolist() == [10.0, 20.0] * 5
    cube = sweep.to_xarray()
    same = stribeck.sweep(coarse, {"motion.entrainment_speed": ["1 m/s", "1000 mm/s"], "load.force": [10, 20]})
    assert same.to_xarray().sizes == {"motion.entrainment_speed": 2, "load.force": 2} and same.axes["motion.entrainment_speed"] == [1.0, 1.0]
    assert cube["film.central"].sel({"load.force": 20.0}).shape == (5,) and cube["film.central"].attrs["units"] == "m"
    assert float(cube["film.central"].sel({"load.force": 20.0, "motion.entrainment_speed": 0.1})) == sweep[3].film.central


def test_folder_tells_heights_apart(coarse: stribeck.Scene, tmp_path: Path) -> None:
    over = {"load.force": [10.0]}
    rough = 2e-8 * np.random.default_rng(0).normal(size=(16, 16))
    stribeck.sweep(coarse, over, heights=np.zeros((16, 16)), folder=tmp_path)
    with pytest.raises(stribeck.InputError, match="differs in given"):
        stribeck.sweep(coarse, over, heights=rough, folder=tmp_path)


def test_points_with_an_error_are_solved_again(coarse: stribeck.Scene, tmp_path: Path) -> None:
    missing = tmp_path / "calibration"

    def measure(solution: stribeck.Solution) -> float:
        return float(missing.read_text())

    def call() -> stribeck.Sweep:
        return stribeck.sweep(coarse, {"load.force": [10.0, 20.0]}, measure=measure, folder=tmp_path / "points", budget="1 min")

    assert len(call().failed) == 2
    missing.write_text("3.0")
    assert not call().failed


def test_folders_and_names_of_others_are_refused(coarse: stribeck.Scene, tmp_path: Path) -> None:
    over = {"load.force": [10.0]}
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(stribeck.InputError, match="other files"):
        stribeck.sweep(coarse, over, folder=tmp_path / "mine")
    stribeck.sweep(coarse, over, folder=tmp_path / "points")
    with pytest.raises(stribeck.InputError, match="that of a sweep"):
        stribeck.Simulation.open(tmp_path / "points", coarse)
    taken = stribeck.sweep(coarse, over, measure=lambda solution: {"film.central": 1.0})
    assert "is a number of the solution" in str(taken[0].error)
    with pytest.raises(stribeck.InputError, match="keys of the scene"):
        stribeck.sweep(coarse, {3: [1]})  # type: ignore[dict-item]


def test_meshes_are_swept_by_their_keys(coarse: stribeck.Scene) -> None:
    sweep = stribeck.sweep(coarse, {"grid.nx": [16, 24], "grid.ny": [16, 24]}, how="zip")
    assert [point["status"] for point in sweep] == ["converged", "converged"]
    assert coarse.replace(**{"grid.nx": 24}).grid.shape == (16, 24)


def test_heights_of_xarray_follow_their_dimensions(coarse: stribeck.Scene) -> None:
    xr = pytest.importorskip("xarray")
    heights = 2e-8 * np.random.default_rng(0).normal(size=(16, 16))
    film = stribeck.solve(coarse, heights=heights).film.central
    across = xr.DataArray(heights, dims=("y", "x")).transpose("x", "y")
    assert stribeck.solve(coarse, heights=across).film.central == film
    with pytest.raises(stribeck.InputError, match="expected y and x"):
        stribeck.solve(coarse, heights=xr.DataArray(heights, dims=("foo", "bar")))
