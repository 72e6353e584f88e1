"""The work in aspher: exact convolution, conjugate gradients on nested grids with its own defaults."""
import importlib.metadata

import aspher
from common import CONTACT_MODULUS, HALF_BOX, LOAD, attempt, gap, hertz_pressure, median_result, median_time, report

SIZE = 2 * HALF_BOX


def convolution(n):
    body = aspher.ContactSolver(grid_size=n, domain_size=SIZE, E_star=CONTACT_MODULUS, backend="fft")
    pressure = hertz_pressure(n).ravel()
    seconds = median_time(lambda: body.matvec(pressure), 30 if n < 512 else 7)
    report("convolution", n, seconds=seconds, value=body.matvec(pressure).max())


def solve(kind, n):
    undeformed = gap(kind, n).ravel()
    seconds, result = median_result(
        lambda: aspher.solve_nested(
            grid_size=n,
            gap=undeformed,
            p_nominal=LOAD / SIZE**2,
            domain_size=SIZE,
            E_star=CONTACT_MODULUS,
            backend="fft",
            tol=1e-8,
        )
    )
    return seconds, result, f"{result.status}, {result.iterations} steps"


def hertz(n):
    seconds, result, note = solve("smooth", n)
    report("hertz", n, seconds=seconds, value=result.pressure.max(), note=note)


def dry(n):
    seconds, result, note = solve("elastic", n)
    report("dry", n, seconds=seconds, value=result.contact_area * SIZE**2, note=note)


report("version", 0, note=importlib.metadata.version("aspher"))
for n in (128, 256, 512, 1024):
    attempt("convolution", n, convolution)
for n in (128, 256):
    attempt("hertz", n, hertz)
for n in (128, 256, 512, 1024):
    attempt("dry", n, dry)
