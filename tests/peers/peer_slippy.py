"""The work in slippy: convolution, dry contact, and the lubricated contact of its own example."""
import importlib.metadata
import time

import numpy as np
import slippy

slippy.CUDA = False
import slippy.contact as contact  # noqa: E402, the flag must be set first
import slippy.surface as surface  # noqa: E402
from common import CAP, CONTACT_MODULUS, HALF_BOX, LOAD, attempt, contact_area, gap, hertz_pressure, median_result, median_time, report  # noqa: E402

SIZE = 2 * HALF_BOX
SHEAR_MODULUS = CONTACT_MODULUS / 2  # of one elastic body with Poisson's ratio 0, the other rigid


def influence(n):
    return contact.elastic_influence_matrix_spatial("zz", (2 * n, 2 * n), (SIZE / n,) * 2, SHEAR_MODULUS, 0.0)


def convolution(n):
    pressure = np.array(hertz_pressure(n))
    product = contact.plan_convolve(pressure, influence(n), None, circular=False, fft_im=False)
    seconds = median_time(lambda: product(pressure), 30 if n < 512 else 7)
    report("convolution", n, seconds=seconds, value=np.max(product(pressure)))


def dry(kind, n, cap):
    ball = surface.Surface(profile=-gap(kind, n), grid_spacing=SIZE / n)
    flat = surface.FlatSurface(shift=(0, 0))
    ball.material = contact.Elastic(f"{kind}_{n}", {"E": CONTACT_MODULUS, "v": 0.0}, max_load=cap)
    flat.material = contact.rigid

    def solve():
        model = contact.ContactModel(f"{kind}_{n}", ball, flat)
        step = contact.StaticStep("contact", normal_load=LOAD, tolerance=1e-9, tolerance_outer=1e-9, max_it=3000)
        model.add_step(step)
        return model.solve()

    seconds, state = median_result(solve)
    return seconds, np.asarray(state["loads_z"])


def hertz(n):
    seconds, pressure = dry("smooth", n, np.inf)
    report("hertz", n, seconds=seconds, value=pressure.max())


def capped(n):
    seconds, pressure = dry("rough", n, CAP)
    carried = pressure.sum() * (SIZE / n) ** 2 / LOAD
    report("capped", n, seconds=seconds, value=contact_area(pressure), note=f"load {carried:.4f}, highest {pressure.max():.3e}")


def elastic(n):
    seconds, pressure = dry("elastic", n, np.inf)
    report("dry", n, seconds=seconds, value=contact_area(pressure))


def film(n):
    """The ball of its example: 19.05 mm, 800 N, 4 m/s, steel, on a box of four Hertz radii."""
    radius, load, speed, modulus, ratio, viscosity = 0.01905, 800.0, 4.0, 200e9, 0.3, 0.096
    hertz_result = contact.hertz_full([radius, radius], [np.inf, np.inf], [modulus] * 2, [ratio] * 2, load)
    p_max, half_width = hertz_result["max_pressure"], hertz_result["contact_radii"][0]
    ball = surface.RoundSurface((radius,) * 3, shape=(n, n), extent=(4 * half_width,) * 2, generate=True)
    flat = surface.FlatSurface()
    ball.material = flat.material = contact.Elastic(f"steel_{n}", {"E": modulus, "v": ratio})
    oil = contact.Lubricant(f"oil_{n}")
    models = contact.lubricant_models
    oil.add_sub_model("nd_viscosity", models.nd_roelands(viscosity, 1 / 5.1e-9, p_max, 0.68))
    oil.add_sub_model("nd_density", models.nd_dowson_higginson(p_max))
    start = time.perf_counter()
    model = contact.ContactModel(f"film_{n}", ball, flat, oil)
    reynolds = contact.UnifiedReynoldsSolver(
        time_step=0,
        grid_spacing=ball.grid_spacing,
        hertzian_pressure=p_max,
        radius_in_rolling_direction=radius,
        hertzian_half_width=half_width,
        dimentional_viscosity=viscosity,
        dimentional_density=872,
    )
    x, y = ball.get_points_from_extent()
    guess = p_max * np.sqrt(np.maximum(0, 1 - ((x - x.mean()) ** 2 + (y - y.mean()) ** 2) / half_width**2))
    approach = hertz_result["total_deflection"]
    step = contact.IterSemiSystem(
        "film",
        reynolds,
        speed,
        1,
        no_time=True,
        normal_load=load,
        initial_guess=[approach, guess],
        relaxation_factor=0.05,
        max_it_interference=3000,
    )
    model.add_step(step)
    state = model.solve()
    gap_field, converged = np.asarray(state["gap"]), state.get("converged", "unknown")
    report(
        "film",
        n,
        seconds=time.perf_counter() - start,
        value=gap_field[n // 2 - 1 : n // 2 + 1, n // 2 - 1 : n // 2 + 1].mean(),
        note=f"converged: {converged}",
    )


report("version", 0, note=importlib.metadata.version("slippy"))
for n in (128, 256, 512, 1024):
    attempt("convolution", n, convolution)
for n in (128, 256):
    attempt("hertz", n, hertz)
    attempt("capped", n, capped)
    attempt("dry", n, elastic)
for n in (64, 128):
    attempt("film", n, film)
