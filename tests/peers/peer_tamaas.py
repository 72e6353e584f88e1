"""The work in tamaas: the non-periodic operator, for convolution and elastic contact."""
import tamaas as tm
from common import CONTACT_MODULUS, HALF_BOX, LOAD, attempt, contact_area, gap, hertz_pressure, median_result, median_time, report

tm.set_log_level(tm.LogLevel.error)
SIZE = 2 * HALF_BOX


def model(n):
    made = tm.ModelFactory.createModel(tm.model_type.basic_2d, [SIZE, SIZE], [n, n])
    made.E, made.nu = CONTACT_MODULUS, 0.0
    tm.ModelFactory.registerNonPeriodic(made, "dcfft")
    return made


def convolution(n):
    made = model(n)
    operator = made.operators["dcfft"]
    made.traction[...] = hertz_pressure(n)
    seconds = median_time(lambda: operator(made.traction, made.displacement), 30 if n < 512 else 7)
    report("convolution", n, seconds=seconds, value=made.displacement.max())


def elastic(kind, n, tolerance):
    undeformed = gap(kind, n)

    def solve():
        made = model(n)
        solver = tm.PolonskyKeerRey(made, -undeformed, tolerance)
        solver.setIntegralOperator("dcfft")
        solver.max_iter = 5000
        return solver.solve(LOAD / SIZE**2), made.traction

    seconds, (error, traction) = median_result(solve)
    return seconds, traction, f"error {error:.0e}"


def hertz(n):
    seconds, traction, note = elastic("smooth", n, 1e-12)
    report("hertz", n, seconds=seconds, value=traction.max(), note=note)


def dry(n):
    seconds, traction, note = elastic("elastic", n, 1e-9)
    report("dry", n, seconds=seconds, value=contact_area(traction), note=note)


report("version", 0, note=tm.__version__)
for n in (128, 256, 512, 1024):
    attempt("convolution", n, convolution)
for n in (128, 256):
    attempt("dry", n, dry)
attempt("hertz", 128, hertz)
