"""The work in ContactMechanics: free (non-periodic) half-space, constrained conjugate gradients with hardness."""
import importlib.metadata

import numpy as np
from common import CAP, CONTACT_MODULUS, HALF_BOX, LOAD, attempt, contact_area, gap, hertz_pressure, median_result, median_time, report
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Optimization import constrained_conjugate_gradients
from SurfaceTopography import Topography

SIZE = 2 * HALF_BOX


def convolution(n):
    body = FreeFFTElasticHalfSpace((n, n), CONTACT_MODULUS, (SIZE, SIZE))
    force = np.zeros((2 * n, 2 * n))
    force[:n, :n] = -hertz_pressure(n) * (SIZE / n) ** 2
    seconds = median_time(lambda: body.evaluate_disp(force), 30 if n < 512 else 7)
    report("convolution", n, seconds=seconds, value=body.evaluate_disp(force)[:n, :n].max())


def solve(kind, n, hardness, tolerance):
    surface = Topography(-gap(kind, n), (SIZE, SIZE))
    seconds, result = median_result(
        lambda: constrained_conjugate_gradients(
            FreeFFTElasticHalfSpace((n, n), CONTACT_MODULUS, (SIZE, SIZE)),
            surface,
            hardness=hardness,
            external_force=LOAD,
            pentol=tolerance,
            forcetol=1e-9,
            maxiter=3000,
        )
    )
    pressure = np.abs(np.asarray(result.jac)[:n, :n]) / (SIZE / n) ** 2
    return seconds, pressure, f"{'converged' if result.success else 'not converged'}, {result.nit} steps"


def hertz(n):
    seconds, pressure, note = solve("smooth", n, None, 1e-13)
    report("hertz", n, seconds=seconds, value=pressure.max(), note=note)


def capped(n):
    seconds, pressure, note = solve("rough", n, CAP, 1e-13)
    carried = pressure.sum() * (SIZE / n) ** 2 / LOAD
    note = f"{note}, load {carried:.4f}, highest {pressure.max():.3e}"
    report("capped", n, seconds=seconds, value=contact_area(pressure), note=note)


def dry(n):
    seconds, pressure, note = solve("elastic", n, None, 1e-13)
    report("dry", n, seconds=seconds, value=contact_area(pressure), note=note)


report("version", 0, note=importlib.metadata.version("ContactMechanics"))
for n in (128, 256, 512, 1024):
    attempt("convolution", n, convolution)
for n in (128, 256):
    attempt("hertz", n, hertz)
    attempt("capped", n, capped)
    attempt("dry", n, dry)
