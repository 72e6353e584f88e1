"""Runs that are kept, copied, changed and forked."""

from __future__ import annotations

import copy
import gc
import inspect
import os
import pickle
import subprocess
import sys
import time
import types
import warnings
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stribeck
from stribeck import errors
from stribeck._identity import identity
from test_mirror import same

#: Specific wear rate of the law below [1/Pa].
RATE = 1e-17


class Archard:
    """A wear law of this module, which pickles by its name."""

    def __init__(self, rate: float = 1e-17) -> None:
        self.rate = rate

    def depth_rate(self, at: Any, film: Any) -> Any:
        return self.rate * at.solid_pressure * at.sliding_speed


def by_global(at: Any, film: Any) -> Any:
    return RATE * at.solid_pressure * at.sliding_speed


def saved(scene: stribeck.Scene, law: Any, path: Path) -> Path:
    simulation = stribeck.Simulation(scene, wear=law)
    simulation.step(10.0)
    simulation.save(path)
    return path


def of_method(rate: float) -> type:
    """A class whose method has the rate in its code."""
    text = f"class Law:\n    def depth_rate(self, at, film):\n        return {rate!r} * at.solid_pressure * at.sliding_speed\n"
    return in_module(text, "Law")


def in_module(text: str, name: str) -> Any:
    """An object of a module of its own."""
    module = types.ModuleType("user_laws")
    exec(compile(text, "user_laws.py", "exec"), module.__dict__)  # noqa: S102
    return getattr(module, name)


def of_helper(rate: float) -> Any:
    text = "def helper(p):\n    return RATE * p\ndef law(at, film):\n    return helper(at.solid_pressure) * at.sliding_speed\n"
    return in_module(f"RATE = {rate!r}\n{text}", "law")


@pytest.mark.parametrize("maker", [lambda rate: of_method(rate)(), of_helper, Archard], ids=["method", "helper", "attribute"])
def test_checkpoint_of_another_wear_rate_is_refused_and_accepted_on_request(
    maker: Callable[[float], Any], rough: stribeck.Scene, tmp_path: Path
) -> None:
    assert identity(maker(1e-17)) == identity(maker(1e-17))
    path = saved(rough, maker(1e-17), tmp_path / "checkpoint")
    stribeck.Simulation(rough, wear=maker(1e-17)).restore(path)
    other = stribeck.Simulation(rough, wear=maker(1e-12))
    with pytest.raises(stribeck.CheckpointError, match="1e-12.*1e-17") as refused:
        other.restore(path)
    assert refused.value.field == "wear law" and other.steps == 0
    with pytest.raises(stribeck.UnknownNameError, match="growth, wear, friction"):
        other.restore(path, accept=["law"])
    assert other.restore(path, accept=["wear"]) == ["wear law"] and other.steps == 1


def test_global_constant_of_a_law_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    before = identity(by_global)
    monkeypatch.setitem(globals(), "RATE", 1e-12)
    assert identity(by_global) != before
    assert "RATE = 1e-12" in identity(by_global)


def test_identity_of_the_law_itself_stands_in_place_of_its_code(rough: stribeck.Scene, tmp_path: Path) -> None:
    def named(rate: float) -> Any:
        law = of_method(rate)()
        law.identity = "archard 1"
        return law

    path = saved(rough, named(1e-17), tmp_path / "checkpoint")
    assert stribeck.Simulation(rough, wear=named(1e-12)).restore(path) == []
    law = of_method(1e-17)()
    law.identity = 3
    with pytest.raises(stribeck.LawError, match="identity"):
        stribeck.Simulation(rough, wear=law)


def test_attributes_of_a_simulation_cannot_be_set(rough: stribeck.Scene) -> None:
    class Own(stribeck.Simulation):
        pass

    for kind in (stribeck.Simulation, Own):
        simulation = kind(rough)
        for name in ("load", "motion", "entrainment_speed", "time", "scene", "history"):
            with pytest.raises(AttributeError, match=f"{name} .*change"):
                setattr(simulation, name, "20 N")
    with pytest.raises(AttributeError, match="remark"):
        stribeck.Simulation(rough).remark = "no"  # type: ignore[attr-defined]
    own = Own(rough)
    own.remark = "kept"  # type: ignore[attr-defined]
    assert pickle.loads(pickle.dumps(own.fork().remark)) == "kept"  # type: ignore[attr-defined]


def test_change_is_a_run_under_other_conditions_from_now_on(rough: stribeck.Scene, tmp_path: Path) -> None:
    simulation = stribeck.Simulation(rough, wear=Archard())
    simulation.step(10.0)
    simulation.save(tmp_path / "checkpoint")
    force = rough.hertz().force
    simulation.change(load=f"{0.5 * force} N", motion={"entrainment_speed": "0.2 m/s"})
    assert (simulation.time, simulation.steps, len(simulation.history)) == (10.0, 1, 1)
    assert simulation.conditions.load == pytest.approx(0.5 * force)
    scene = rough.replace(load={"force": f"{0.5 * force} N"}, motion={"entrainment_speed": 0.2})
    other = stribeck.Simulation(scene, wear=Archard())
    other.restore_under_other_conditions(tmp_path / "checkpoint")
    assert same(simulation.step(10.0), other.step(10.0)) and simulation.scene == scene
    speeds = {"kind": "steps", "times": ["0 s", "30 s"], "values": [0.3, 0.1]}
    simulation.change(schedule={"entrainment_speed": speeds})
    found = [simulation.scene.conditions(t).motion.entrainment_speed for t in (20.0, 49.0, 51.0)]
    assert found == [0.3, 0.3, 0.1]
    simulation.change(motion={"entrainment_speed": 0.4})
    assert simulation.conditions.motion.entrainment_speed == 0.4
    with pytest.raises(stribeck.InputError, match="grid: cannot change"):
        simulation.change(grid={"nx": 8})
    with pytest.raises(stribeck.InputError):
        simulation.change(load="20 s")
    assert simulation.steps == 2 and simulation.conditions.motion.entrainment_speed == 0.4


def test_every_error_and_warning_prints_and_pickles() -> None:
    kinds = [kind for kind in vars(errors).values() if inspect.isclass(kind) and issubclass(kind, errors.StribeckError)]
    assert len(kinds) >= 13
    for kind in kinds:
        for field, value in ((None, None), ("load.force", 3.0), ("x", "text")):
            error = kind("load.force = 3: is out of range", field=field, value=value)
            again = pickle.loads(pickle.dumps(error))
            assert (type(again), str(again), again.field, again.value) == (kind, str(error), field, value)
            assert repr(error) and copy.copy(error).field == field
    for value in (None, 3.0, float("nan"), float("inf")):
        for remedy in ("", "take less"):
            warning = stribeck.StribeckWarning("film", value, "is odd", remedy)
            assert str(pickle.loads(pickle.dumps(warning))) == str(warning) and repr(warning)


def test_surface_file_without_unit_is_one_warning_of_a_solve(rough: stribeck.Scene, tmp_path: Path) -> None:
    (tmp_path / "disc.txt").write_text("\n".join([" ".join(["1e-9"] * 32)] * 32))
    scene = rough.replace(roughness={"disc": {"kind": "file", "path": tmp_path / "disc.txt"}})
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        solution = stribeck.solve(scene)
    told = [warning for warning in solution.warnings if warning.field == "roughness.disc.path"]
    assert len(told) == 1 and told[0].value is None and "no unit" in told[0].message
    assert sum("roughness.disc.path" in str(warning.message) for warning in said) == 1


FORKED = """
import multiprocessing, stribeck, warnings
warnings.simplefilter("ignore")
cells = {cells}
scene = stribeck.Scene.azam_2019(cells).replace(roughness=None, plastic=None, wear=None, motion={{"entrainment_speed": 5.0}})

def load(_):
    return stribeck.solve(scene).film.central

before = load(0)
{run}
assert found == [before, before], (found, before)
print("done")
"""
RUNS = {
    "multiprocessing": "with multiprocessing.get_context('fork').Pool(2) as pool:\n    found = pool.map(load, range(2))",
    "concurrent": "from concurrent.futures import ProcessPoolExecutor\n"
    "with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context('fork')) as pool:\n    found = list(pool.map(load, range(2)))",
    "joblib": "import joblib\nfound = joblib.Parallel(2, backend='multiprocessing')(joblib.delayed(load)(k) for k in range(2))",
    "dask": "import dask\nwith dask.config.set({'multiprocessing.context': 'fork'}):\n"
    "    found = list(dask.compute(*[dask.delayed(load)(k) for k in range(2)], scheduler='processes', num_workers=2))",
}


@pytest.mark.parametrize("cells", [32, 256])
@pytest.mark.parametrize("library", RUNS)
def test_forked_processes_solve_after_a_solve(library: str, cells: int, tmp_path: Path) -> None:
    if library in ("joblib", "dask"):
        pytest.importorskip(library)
    script = tmp_path / "forked.py"
    script.write_text(FORKED.format(cells=cells, run=RUNS[library]))
    # two threads wherever the tests run, so that there is a pool to lose
    environment = {**os.environ, "STRIBECK_NUM_THREADS": "2"}
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120, env=environment, check=False)
    assert done.stdout.strip().endswith("done"), done.stderr


def test_number_of_threads_changes_no_bit() -> None:
    scene = stribeck.Scene.azam_2019(256).replace(roughness=None, plastic=None, wear=None, motion={"entrainment_speed": 5.0})
    films = []
    for threads in (1, 2, 0):
        stribeck.set_num_threads(threads)
        films.append(stribeck.solve(scene).fields["film"])
    np.testing.assert_array_equal(films[0], films[1])
    np.testing.assert_array_equal(films[0], films[2])
    with pytest.raises(stribeck.InputError, match="threads"):
        stribeck.set_num_threads(-1)


def test_laws_that_refer_to_their_simulation_are_collected(rough: stribeck.Scene) -> None:
    class Watching:
        simulation: stribeck.Simulation

        def depth_rate(self, at: Any, film: Any) -> Any:
            return 1e-17 * at.solid_pressure * at.sliding_speed

    alive = []
    for _ in range(5):
        law = Watching()
        law.simulation = stribeck.Simulation(rough, wear=law)
        law.simulation.step(10.0)
        alive.append(weakref.ref(law.simulation))
        del law
    gc.collect()
    assert [ref() for ref in alive] == [None] * 5


def test_run_folder_goes_on_with_its_history(rough: stribeck.Scene, tmp_path: Path) -> None:
    whole = stribeck.Simulation(rough).run(4, 60.0)
    folder = tmp_path / "run"
    with stribeck.Simulation.open(folder, rough, every=1) as simulation:
        simulation.run(2, 60.0)
        with pytest.raises(stribeck.InputError, match="another run writes"):
            stribeck.Simulation.open(folder)
        with pytest.raises(stribeck.InputError, match=r"close\(\)"):
            simulation.change(load=10.0)
        with pytest.raises(stribeck.StribeckError, match=r"close\(\)"):
            simulation.restore(folder / "checkpoint")
    assert {path.name for path in folder.iterdir()} >= {"scene.toml", "history.csv", "checkpoint", "fields.npz", "run.toml"}
    with stribeck.Simulation.open(folder) as again:
        assert (again.steps, len(again.history)) == (2, 2) and again.history[1].time == 120.0
        again.run(2, 60.0)
        assert len(again.history) == 4
    np.testing.assert_array_equal(again.history["film.mean_central"], whole["film.mean_central"])
    with np.load(folder / "fields.npz") as fields:
        np.testing.assert_array_equal(fields["disc_wear"], again.bodies[1].wear)
    with pytest.raises(stribeck.CheckpointError, match="scene.load"):
        stribeck.Simulation.open(folder, rough.replace(load={"force": 10.0}))
    with stribeck.Simulation.open(folder, rough.replace(load={"force": 10.0}), accept=["scene.load"]) as lighter:
        assert lighter.steps == 4
    with pytest.raises(stribeck.FileError):
        stribeck.Simulation.open(tmp_path / "none")


def test_simulations_and_films_pickle_with_laws_by_name(rough: stribeck.Scene) -> None:
    simulation = stribeck.Simulation(rough, wear=Archard(2e-17), heights=np.full((32, 32), 1e-9))
    simulation.run(2, 10.0)
    for again in (pickle.loads(pickle.dumps(simulation)), copy.copy(simulation)):
        assert (again.time, len(again.history)) == (20.0, 2)
        assert same(again.step(10.0), simulation.fork().step(10.0)) and len(again.history) == 3
    assert len(simulation.history) == 2
    with pytest.raises((pickle.PicklingError, AttributeError)):
        pickle.dumps(stribeck.Simulation(rough, wear=lambda at, film: 0.0))
    grid = stribeck.Grid.box(100, 1, (0.0, 1e-2), (0.0, 1.0))
    film = stribeck.given_film(lambda x, y: 2e-6 if 2e-3 < x < 5e-3 else 1e-6, grid, speeds=(0.02, 0.0), eta0=0.01)
    again = pickle.loads(pickle.dumps(film))
    assert again.to_dict() == film.to_dict() and again.pressure_at(3e-3) == film.pressure_at(3e-3)
    np.testing.assert_array_equal(again.pressure, film.pressure)


def test_history_is_a_view_that_grows(rough: stribeck.Scene) -> None:
    simulation = stribeck.Simulation(rough)
    history = simulation.history
    simulation.run(3, 10.0)
    assert simulation.history is history and len(history) == 3
    first = history["time"]
    assert first.tolist() == [10.0, 20.0, 30.0]
    first[0] = 7.0
    simulation.step(10.0)
    assert history["time"].tolist() == [10.0, 20.0, 30.0, 40.0] and history["status"][0] == "converged"


def test_columns_of_long_histories_are_read_once(rough: stribeck.Scene) -> None:
    record = stribeck.Simulation(rough).step(10.0)
    history = stribeck.History([record] * 4000)
    history["film.mean_central"]
    began = time.perf_counter()
    for _ in range(1000):
        history.append(record)
        history["film.mean_central"]
    # a column that is looked up anew takes some 10 ms each time
    assert time.perf_counter() - began < 2.0


def test_budget_ends_a_solve_and_a_refined_grid(rough: stribeck.Scene) -> None:
    fine = stribeck.Scene.azam_2019(256)
    for scene in (fine, stribeck.Scene.azam_2019(32).replace(grid={"accuracy": 1e-3})):
        with pytest.raises(stribeck.InterruptedSolve, match="budget of 0.05 s") as caught:
            stribeck.solve(scene, budget="50 ms")
        assert caught.value.field == "budget" and caught.value.value == "50 ms"
    assert stribeck.solve(rough, budget=3600) == stribeck.solve(rough)
    for wrong in (0.0, -1.0, float("nan")):
        with pytest.raises(stribeck.InputError, match="budget"):
            stribeck.solve(rough, budget=wrong)
    sweep = stribeck.sweep(fine, {"motion.entrainment_speed": [0.1]}, budget=0.05)
    assert sweep[0]["status"] == "refused" and "budget" in sweep[0].error


def test_logger_says_each_solve_and_each_step(rough: stribeck.Scene, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level("INFO", logger="stribeck"):
        stribeck.solve(rough)
        stribeck.Simulation(rough).run(2, 10.0)
    assert [record.getMessage().split(":")[0] for record in caplog.records] == ["contact converged", "step 0 at 10 s", "step 1 at 20 s"]
