"""Overhead of Python: the time of a solve outside of the solver, and that of a growth law in Python within a step.

    python python/benches/overhead.py [CELLS]
"""

from __future__ import annotations

import sys
import time
import warnings
from statistics import median
from typing import Any

import stribeck

ROUNDS = 7


def overhead_of_a_solve(cells: int) -> None:
    """Everything but the solve itself: arguments, numbers and fields."""
    scene = stribeck.Scene.azam_2019(cells)
    walls, shares = [], []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        solution = stribeck.solve(scene)
        walls.append(time.perf_counter() - began)
        shares.append(1.0 - solution.seconds / walls[-1])
    print(f"solve of {cells} x {cells}: {median(walls) * 1e3:.1f} ms, of it in Python {median(shares):.3%}")


class PowerDriven:
    """The law of the example `custom_growth_law`, with the times of its first and its last call."""

    maximum_thickness = 150e-9

    def __init__(self) -> None:
        self.calls = 0
        self.first = self.last = 0.0

    def rate(self, at: Any, thickness: Any) -> Any:
        if self.calls == 0:
            self.first = time.perf_counter()
        left = 1.0 - thickness / self.maximum_thickness
        rate = 4e-16 * at.shear_stress * at.sliding_speed * left * left
        self.calls += 1
        self.last = time.perf_counter()
        return rate


def growth_law_in_a_step(cells: int) -> None:
    """From the first call of the law in a step to the last: both bodies, the integration, the conversions and, in between, the wear."""
    law = PowerDriven()
    simulation = stribeck.Simulation(stribeck.Scene.azam_2019(cells), growth=law)
    walls, shares = [], []
    for _ in range(ROUNDS):
        law.calls = 0
        began = time.perf_counter()
        simulation.step(60.0)
        walls.append(time.perf_counter() - began)
        shares.append((law.last - law.first) / walls[-1])
    print(
        f"step of {cells} x {cells}: {median(walls) * 1e3:.1f} ms, of it {median(shares):.2%} in {law.calls} calls of a growth law "
        "in Python and between them"
    )


if __name__ == "__main__":
    warnings.simplefilter("ignore", stribeck.StribeckWarning)
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 128
    overhead_of_a_solve(count)
    growth_law_in_a_step(count)
