"""What the workers share: the scenes, the timer, the way results are handed back."""
import json
import pathlib
import statistics
import sys
import time

import numpy as np

RADIUS = 9.525e-3  # m
CONTACT_MODULUS = 229.67e9 / 2  # Pa, E* = E'/2
HALF_BOX = 0.25e-3  # m
LOAD = 54.0741  # N
HERTZ_PRESSURE = 1.15e9  # Pa
CAP = 6e9  # Pa
FOLDER = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(".")


def coordinates(n):
    x = (np.arange(n) + 0.5) * 2 * HALF_BOX / n - HALF_BOX
    return np.meshgrid(x, x, indexing="ij")


def hertz_pressure(n):
    x, y = coordinates(n)
    a = np.pi * RADIUS * HERTZ_PRESSURE / (2 * CONTACT_MODULUS)
    return HERTZ_PRESSURE * np.sqrt(np.maximum(0, 1 - (x**2 + y**2) / a**2))


def gap(kind, n):
    """The undeformed gap that ours was solved with."""
    return np.load(FOLDER / f"{kind}_{n}.npz")["gap"]


def contact_area(pressure):
    return np.count_nonzero(pressure > 0) * (2 * HALF_BOX / len(pressure)) ** 2


def median_time(call, repeats):
    call()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def median_result(call):
    """Median time of three calls, and what the last one returns."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        result = call()
        times.append(time.perf_counter() - start)
    return statistics.median(times), result


def report(task, n, **numbers):
    plain = {key: (value if isinstance(value, (str, int)) else float(value)) for key, value in numbers.items()}
    print("RESULT " + json.dumps({"task": task, "n": n, **plain}), flush=True)


def attempt(task, n, call):
    """Runs one piece of work; what goes wrong becomes a row of its own."""
    try:
        call(n)
    except Exception as error:  # noqa: BLE001, every failure is a result here
        report(task, n, failed=f"{type(error).__name__}: {str(error).splitlines()[0][:100] if str(error) else ''}")
