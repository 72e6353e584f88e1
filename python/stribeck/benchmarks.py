"""Solvers compared over lists of cases: verified results, a table and three pictures."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from typing import Any

from . import _stribeck
from ._arguments import refused, whole
from .laws import _solver
from .scene import Scene, as_scene

__all__ = ["Benchmark", "benchmark"]


class Benchmark:
    """The rows of a benchmark. ``stability_map()``, ``work_precision()`` and ``performance_profile()`` return pictures as SVG text."""

    __slots__ = ("_rows",)

    def __init__(self, rows: _stribeck.BenchmarkRows) -> None:
        self._rows = rows

    @property
    def rows(self) -> list[dict[str, Any]]:
        """A dictionary for each row. Numbers that are unknown are None."""
        return self._rows.rows()

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``, a row for each result, with the columns of :meth:`to_csv`."""
        import io

        import pandas as pd  # type: ignore[import-untyped,unused-ignore]

        return pd.read_csv(io.StringIO(self.to_csv()))

    def to_csv(self) -> str:
        """The rows as CSV in SI units."""
        return self._rows.to_csv()

    def summary(self) -> str:
        """Counts of verdicts, work, the order of the solvers, and the runs that failed, with their reasons."""
        return self._rows.summary()

    def stability_map(self) -> str:
        """The verdict of every case."""
        return self._rows.stability_map()

    def work_precision(self) -> str:
        """Errors over seconds and convolutions."""
        return self._rows.work_precision()

    def performance_profile(self) -> str:
        """Share of the runs that a solver solves within a factor of the best one (Dolan and More 2002)."""
        return self._rows.performance_profile()

    def save_pictures(self, folder: str | os.PathLike[str]) -> None:
        """Writes the three pictures to ``folder`` as SVG."""
        os.makedirs(folder, exist_ok=True)
        for name in ("stability_map", "work_precision", "performance_profile"):
            with open(os.path.join(folder, f"{name}.svg"), "w", encoding="utf-8") as file:
                file.write(getattr(self, name)())

    def __repr__(self) -> str:
        return f"<Benchmark of {len(self.rows)} rows>"


def benchmark(
    cases: str | Mapping[str, Scene | Mapping[str, Any] | str | os.PathLike[str]] = "battery",
    solvers: str | Iterable[Any] | Mapping[str, Any] = ("auto",),
    *,
    seed: int = 1,
    tag: str | None = None,
    every: int = 1,
    tolerances: Iterable[float] = (1e-6,),
    meshes: Iterable[int] = (),
    seconds: float = 600.0,
    convolutions: float = math.inf,
    threads: int | None = None,
    file: str | os.PathLike[str] | None = None,
) -> Benchmark:
    """Solves all ``cases`` by all ``solvers``. Every converged state is verified by its residuals. A solver that fails, raises, hangs or lies is a row
    with the reason.

    Parameters
    ----------
    cases
        A list, ``"battery"``, ``"corners"``, ``"map"``, ``"lines"``, ``"thermal"`` or ``"references"``; a TOML file of cases; or scenes by name.
    solvers
        Names with settings, ``"newton_krylov:halvings=1"``, and solvers in Python (:class:`stribeck.laws.ContactSolver`); or a dictionary of these by
        name.
    seed
        Seed of the roughness of the lists.
    tag, every
        Only cases with this tag, only every n-th of them.
    tolerances, meshes
        Tolerances of the residuals, and cells along x in place of those of the cases.
    seconds, convolutions
        Limits for one case.
    threads
        Cases that are solved at the same time; the number of processors by default.
    file
        CSV file to which rows are appended. Rows that it has are not solved again.

    >>> import stribeck
    >>> found = stribeck.benchmark("battery", ["auto", "newton_krylov:halvings=1"], tag="smooth", every=15, meshes=[16])
    >>> sorted({row["verdict"] for row in found.rows})
    ['converged']
    """
    if isinstance(solvers, str):
        solvers = [solvers]
    if whole("every", every) == 0:
        raise refused("every", every, "a whole number from 1")
    named = solvers.items() if isinstance(solvers, Mapping) else ((None, solver) for solver in solvers)
    scenes = cases if isinstance(cases, str) else [(str(name), as_scene(scene)._raw) for name, scene in cases.items()]
    plan = {
        "seed": whole("seed", seed),
        "every": whole("every", every),
        "tag": tag,
        "tolerances": [float(tolerance) for tolerance in tolerances],
        "meshes": [whole("meshes", mesh) for mesh in meshes],
        "seconds": float(seconds),
        "convolutions": float(convolutions),
        "threads": None if threads is None else whole("threads", threads, most=1024),
        "file": None if file is None else os.fspath(file),
    }
    return Benchmark(_stribeck.run_benchmark(scenes, [_contestant(name, solver) for name, solver in named], plan))


def _contestant(name: str | None, solver: Any) -> str | tuple[str, str, Any]:
    if isinstance(solver, str):
        return solver
    law = _solver(solver)
    assert law is not None
    own = str(name or getattr(solver, "__name__", type(solver).__name__))
    return (own, *law)
