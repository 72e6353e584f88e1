"""Benchmarks: solvers by name and in Python, and what is refused."""

from __future__ import annotations

import pytest

import stribeck



def half_hearted(problem: stribeck.laws.ContactProblem, state: stribeck.laws.ContactState) -> bool:
    state.pressure[:] = problem.reference_pressure
    return True


def broken(problem: stribeck.laws.ContactProblem, state: stribeck.laws.ContactState) -> bool:
    raise ValueError("no idea")


def test_solvers_in_python_take_part_and_are_verified() -> None:
    found = stribeck.benchmark({"reference": stribeck.Scene.azam_2019(16)}, ["auto", half_hearted, broken])
    rows = {row["contestant"]: row for row in found.rows}
    assert rows["auto"]["verdict"] == "converged"
    assert rows["half_hearted"]["verdict"] == "falsely_converged"
    assert rows["broken"]["verdict"] == "refused" and "no idea" in rows["broken"]["reason"]
    assert found.stability_map().startswith("<svg") and "broken fails in 1 of 1 runs" in found.summary()


def test_table_has_a_row_for_each_result(tmp_path) -> None:
    pytest.importorskip("pandas")
    solvers = {"own": half_hearted, "auto": "auto"}
    found = stribeck.benchmark(tag="smooth", every=15, meshes=[16], solvers=solvers, file=tmp_path / "rows.csv")
    frame = found.to_pandas()
    assert list(frame["verdict"].unique()) == ["falsely_converged", "converged"]
    assert (tmp_path / "rows.csv").read_text() == found.to_csv()
    found.save_pictures(tmp_path / "pictures")
    assert (tmp_path / "pictures" / "performance_profile.svg").exists()


def test_unknown_names_are_refused() -> None:
    with pytest.raises(stribeck.StribeckError, match="no list is called `batteri`"):
        stribeck.benchmark("batteri")
    with pytest.raises(stribeck.StribeckError, match="unknown key `halvings`"):
        stribeck.benchmark(solvers=["auto:halvings=1"])
    with pytest.raises(stribeck.StribeckError, match="seed"):
        stribeck.benchmark(seed=-1)
    with pytest.raises(stribeck.InputError, match="every = 0"):
        stribeck.benchmark(every=0)
    with pytest.raises(stribeck.StribeckError, match="unknown value `autto`"):
        stribeck.benchmark(solvers="autto")


def test_reason_of_a_solver_that_returns_its_state_is_short() -> None:
    found = stribeck.benchmark({"a": stribeck.Scene.azam_2019(16)}, {"states": lambda problem, state: state})
    (row,) = found.rows
    assert row["verdict"] == "refused" and row["reason"].endswith("it returned a value of the type ContactState")
