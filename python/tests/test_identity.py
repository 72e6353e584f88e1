"""Checkpoints tell laws apart by what they compute with, wherever Python keeps it."""

from __future__ import annotations

import array
import collections
import copy
import enum
import functools
import types
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd  # type: ignore[import-untyped,unused-ignore]
import pytest

from stribeck._identity import identity
from stribeck.laws import Growth


def scaled(at: Any, film: Any, factor: float = 1.0) -> Any:
    return factor * at.pressure


def closed_over(factor: Any) -> Callable[..., Any]:
    return lambda at, film: factor * at.pressure


def with_default(factor: float) -> Callable[..., Any]:
    def law(at: Any, film: Any, factor: float = factor) -> Any:
        return factor * at.pressure

    return law


class Plain:
    def __init__(self, factor: Any) -> None:
        self.factor = factor
        self._calls: list[float] = []

    def rate(self, at: Any, film: Any) -> Any:
        self._calls.append(0.0)
        return self.factor * at.pressure


class Slotted:
    __slots__ = ("factor",)

    def __init__(self, factor: Any) -> None:
        self.factor = factor

    def __call__(self, at: Any, film: Any) -> Any:
        return self.factor * at.pressure


@dataclass(frozen=True, slots=True)
class Data:
    factor: Any


MAKERS = [
    closed_over,
    with_default,
    Plain,
    Slotted,
    Data,
    lambda factor: Plain(factor).rate,
    lambda factor: functools.partial(scaled, factor=factor),
    lambda factor: Growth(closed_over(factor), 1e-7),
    lambda factor: Plain({"table": [factor, 1]}),
    lambda factor: Plain(np.float32(factor)),
    lambda factor: Plain(np.full(1000, factor)),
    lambda factor: Plain(np.array([factor, None], dtype=object)),
    lambda factor: Plain({factor, 0.5}),
    lambda factor: Plain(Data(factor)),
]


@pytest.mark.parametrize("maker", MAKERS)
def test_constants_count(maker: Callable[[float], Any]) -> None:
    assert identity(maker(2.0)) == identity(maker(2.0))
    assert identity(maker(2.0)) != identity(maker(3.0))
    assert len(identity(maker(2.0))) < 250


def test_kinds_and_code_count() -> None:
    assert identity(lambda at, film: 2.0) != identity(lambda at, film: 3.0)
    assert identity(lambda at, film: at.pressure) != identity(lambda at, film: at.temperature)
    assert identity(Slotted(2.0)) != identity(Data(2.0))
    assert identity(Plain(2)) != identity(Plain(2.0))
    assert identity(Plain(np.float32(2.0))) != identity(Plain(np.float64(2.0)))
    assert identity(Plain(np.zeros(3))) != identity(Plain(np.zeros((3, 1))))
    assert identity(Plain(np.tanh)) != identity(Plain(np.sinh))


def test_memory_does_not_count() -> None:
    law = Plain(2.0)
    before = identity(law)
    law._calls.append(1.0)
    assert identity(law) == before


def test_what_holds_itself_ends() -> None:
    law = Plain(2.0)
    law.factor = [law, 1.0]
    deep: list[Any] = []
    for _ in range(50):
        deep = [deep]
    assert identity(law) == identity(law)
    assert len(identity(Plain(deep))) < 250


def pair_of_lambdas(factor: float) -> Callable[..., Any]:
    inner = lambda pressure: factor * pressure  # noqa: E731
    return lambda at, film: inner(at.pressure)


def behind_wraps(factor: float) -> Callable[..., Any]:
    def law(at: Any, film: Any) -> Any:
        return factor * at.pressure

    @functools.wraps(law)
    def counted(*given: Any) -> Any:
        return law(*given)

    return counted


def cached(factor: float) -> Callable[..., Any]:
    @functools.lru_cache
    def scale() -> float:
        return factor

    return lambda at, film: scale() * at.pressure


def doubled(value: Any) -> Any:
    return 2.0 * value


def tripled(value: Any) -> Any:
    return 3.0 * value


class Color(enum.Enum):
    RED = 1
    BLUE = 2


@pytest.mark.parametrize("make", [pair_of_lambdas, behind_wraps, cached])
def test_functions_of_one_name_are_told_apart(make: Callable[[float], Any]) -> None:
    assert identity(make(1.0)) != identity(make(2.0))
    assert identity(make(1.0)) == identity(make(1.0))


@pytest.mark.parametrize(
    "first, second",
    [
        (types.SimpleNamespace(k=1.0), types.SimpleNamespace(k=2.0)),
        (collections.deque([1.0]), collections.deque([2.0])),
        (array.array("d", [1.0]), array.array("d", [2.0])),
        (Color.RED, Color.BLUE),
        (np.vectorize(doubled), np.vectorize(tripled)),
        (functools.partial(map, doubled), functools.partial(map, tripled)),
        ([doubled], [tripled]),
        (pd.Series([1.0]), pd.Series([2.0])),
    ],
)
def test_data_count_wherever_they_are_held(first: Any, second: Any) -> None:
    assert identity(Plain(first)) != identity(Plain(second))
    assert identity(Plain(first)) == identity(Plain(copy.copy(first)))


class Model:
    factor = 1.0

    def __mul__(self, other: Any) -> Any:
        return self.factor * other


def test_code_and_constants_of_a_part_count(monkeypatch: pytest.MonkeyPatch) -> None:
    before = identity(Plain(Model()))
    monkeypatch.setattr(Model, "factor", 2.0)
    changed = identity(Plain(Model()))
    assert changed != before
    monkeypatch.setattr(Model, "__mul__", lambda self, other: other)
    assert identity(Plain(Model())) not in (before, changed)


_CONSTANT = 1.0


def test_private_constants_of_a_module_count(monkeypatch: pytest.MonkeyPatch) -> None:
    def law(at: Any, film: Any) -> Any:
        return _CONSTANT * at.pressure

    before = identity(law)
    monkeypatch.setitem(globals(), "_CONSTANT", 2.0)
    assert identity(law) != before


def test_random_numbers_are_memory() -> None:
    law = Plain(np.random.default_rng(1))
    before = identity(law)
    law.factor.random()
    assert identity(law) == before
