"""Work that an executor does, of the standard library, mpi4py, dask or joblib."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from typing import Any

from ._arguments import refused

Result = dict[str, Any]
#: Status of a point whose executor failed.
LOST = "lost"


def results(
    solve: Callable[[Any], Result], executor: Any, todo: list[tuple[int, Any]], progress: bool
) -> Iterator[tuple[int, Result]]:
    """The results of the tasks as they come."""
    bar = _bar(len(todo), progress)
    if executor is None:
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            yield from _futures(solve, threads, todo, bar)
    elif hasattr(executor, "submit"):
        # a client of dask has futures of its own kind
        yield from _futures(solve, executor.get_executor() if hasattr(executor, "get_executor") else executor, todo, bar)
    elif callable(executor):
        yield from _called(solve, executor, todo)
    else:
        raise refused("executor", executor, "an executor of concurrent.futures, a client of dask or a joblib.Parallel")
    if bar is not None:
        bar.close()


def _futures(
    solve: Callable[[Any], Result], executor: Executor, todo: list[tuple[int, Any]], bar: Any
) -> Iterator[tuple[int, Result]]:
    waiting: dict[Future[Result], int] = {}
    try:
        for k, task in todo:
            try:
                waiting[executor.submit(solve, task)] = k
            except Exception as refusal:  # noqa: BLE001
                yield k, _lost(refusal)
        while waiting:
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                k, error = waiting.pop(future), future.exception()
                if error is not None and not isinstance(error, Exception):
                    raise error
                if bar is not None:
                    bar.update()
                yield k, future.result() if error is None else _lost(error)
    finally:
        for future in waiting:
            future.cancel()


def _called(
    solve: Callable[[Any], Result], executor: Callable[[Any], Any], todo: list[tuple[int, Any]]
) -> Iterator[tuple[int, Result]]:
    """The results of a ``joblib.Parallel``, in any order; those that a worker's death has taken are lost."""
    left = {k for k, _ in todo}
    try:
        for k, result in executor((_numbered, (solve, k, task), {}) for k, task in todo):
            left.discard(k)
            yield k, result
    except Exception as error:  # noqa: BLE001
        yield from ((k, _lost(error)) for k in sorted(left))


def _numbered(solve: Callable[[Any], Result], k: int, task: Any) -> tuple[int, Result]:
    return k, solve(task)


def _lost(error: BaseException) -> Result:
    """A point whose executor failed; a later call with the same folder solves it."""
    return {"values": {}, "status": LOST, "error": f"{type(error).__name__}: {error}", "measured": None, "warnings": []}


def _bar(total: int, progress: bool) -> Any:
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]
    except ImportError:
        return None
    return tqdm(total=total, unit="point", disable=None) if progress else None
