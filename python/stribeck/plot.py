"""Pictures with matplotlib, which is optional: ``pip install matplotlib``. Each function draws into ``ax`` or axes of its own and
returns them; a field or a column that is not there is a :class:`~stribeck.UnknownNameError`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import instance
from ._numbers import unit
from ._stribeck import bearing_curve
from .errors import unknown
from .history import History
from .metrics import bearing, radial_spectrum
from .solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .surface import Surface

__all__ = ["history", "map", "profile", "surface"]

#: Fields: scale of the unit shown and its name.
_SHOWN = {
    "pressure": (1e-9, "GPa"),
    "fluid_pressure": (1e-9, "GPa"),
    "film": (1e9, "nm"),
    "gap": (1e6, "um"),
    "plastic_depth": (1e9, "nm"),
    "theta": (1.0, ""),
    "in_contact": (1.0, ""),
}


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("stribeck.plot needs matplotlib: pip install matplotlib") from error
    return plt.subplots(layout="constrained")[1]


def _field(solution: Solution, name: str) -> Any:
    instance("solution", solution, Solution, "a Solution, such as stribeck.solve(scene)")
    return solution.fields[name]


def _label(name: str, shown: str) -> str:
    words = name.replace("_", " ").replace(".", " ")
    return f"{words}, {shown}" if shown else words


def map(solution: Solution, name: str = "film", *, ax: Axes | None = None, **options: Any) -> Axes:  # noqa: A001
    """A field of a solution over x and y in micrometres; ``options`` go to ``imshow``."""
    values = _field(solution, name)
    axes = _axes(ax)
    grid = solution.grid
    scale, shown = _SHOWN.get(name, (1.0, ""))
    (left, right), (low, high) = grid.edges_x, grid.edges_y
    extent = 1e6 * left, 1e6 * right, 1e6 * low, 1e6 * high
    image = axes.imshow(values * scale, origin="lower", extent=extent, **options)
    axes.figure.colorbar(image, ax=axes, label=_label(name, shown))
    axes.set_xlabel("x, um")
    axes.set_ylabel("y, um")
    return axes


def profile(
    solution: Solution, names: str | Sequence[str] = "film", *, along: str = "x", ax: Axes | None = None, **options: Any
) -> Axes:
    """Fields along the row or column next to the middle of the contact; ``options`` go to ``plot``."""
    if along not in ("x", "y"):
        raise unknown("along", along, ("x", "y"))
    chosen = [names] if isinstance(names, str) else list(names)
    fields = [_field(solution, name) for name in chosen]
    axes = _axes(ax)
    grid = solution.grid
    positions, across = (grid.x, grid.y) if along == "x" else (grid.y, grid.x)
    middle = int(abs(across).argmin())
    for name, field in zip(chosen, fields, strict=True):
        scale, shown = _SHOWN.get(name, (1.0, ""))
        line = field[middle, :] if along == "x" else field[:, middle]
        axes.plot(1e6 * positions, scale * line, label=_label(name, shown), **options)
    axes.set_xlabel(f"{along}, um")
    if len(chosen) == 1:
        axes.set_ylabel(_label(chosen[0], _SHOWN.get(chosen[0], (1.0, ""))[1]))
    else:
        axes.legend()
    return axes


def history(
    records: History, names: str | Sequence[str] = "friction.coefficient", *, ax: Axes | None = None, **options: Any
) -> Axes:
    """Columns of a history over time in seconds; ``options`` go to ``plot``."""
    instance("records", records, History, "a History, such as simulation.history")
    chosen = [names] if isinstance(names, str) else list(names)
    columns = [records[name] for name in chosen]
    axes = _axes(ax)
    for name, column in zip(chosen, columns, strict=True):
        axes.plot(records["time"], column, label=_label(name, unit(name)), **options)
    axes.set_xlabel("time, s")
    if len(chosen) == 1:
        axes.set_ylabel(_label(chosen[0], unit(chosen[0])))
    else:
        axes.legend()
    return axes


def surface(measured: Surface) -> Figure:
    """A figure of a surface: height map with undefined points in grey, middle profile, height distribution, bearing curve with the
    construction of Sk, spectrum."""
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("stribeck.plot needs matplotlib: pip install matplotlib") from error
    figure, axes = plt.subplots(2, 3, figsize=(15, 8), layout="constrained")
    ny, nx = measured.shape
    known = measured.dx is not None and measured.dy is not None
    dx, dy = (1e6 * (measured.dx or 0.0), 1e6 * (measured.dy or 0.0)) if known else (1.0, 1.0)
    length = "um" if known else "points"
    heights = 1e6 * measured.to_masked()
    grey = plt.get_cmap("viridis").with_extremes(bad="0.67")
    image = axes[0, 0].imshow(heights, origin="lower", extent=(0.0, nx * dx, 0.0, ny * dy), cmap=grey)
    figure.colorbar(image, ax=axes[0, 0], label="height, um")
    axes[0, 0].set(xlabel=f"x, {length}", ylabel=f"y, {length}")
    axes[0, 1].plot(dx * (np.arange(nx) + 0.5), heights[ny // 2].filled(np.nan))
    axes[0, 1].set(xlabel=f"x, {length}", ylabel="height, um", title=f"row {ny // 2}")
    axes[0, 2].hist(heights.compressed(), bins=60, density=True)
    axes[0, 2].set(xlabel="height, um", ylabel="density, 1/um")
    _bearing(axes[1, 0], measured)
    if known and min(nx, ny) >= 4:
        wavenumber, density = radial_spectrum(measured, boundary="open")
        shown = density > 0.0
        axes[1, 1].loglog(wavenumber[shown], density[shown])
    axes[1, 1].set(xlabel="wavenumber, 1/m", ylabel="radial spectral density, m^4")
    axes[1, 2].set_axis_off()
    return figure


def _bearing(axes: Axes, measured: Surface) -> None:
    """The bearing curve, the equivalent line of its core and the ratios at which its ends cut the curve."""
    curve, (top, bottom) = bearing_curve(np.ascontiguousarray(measured.heights))
    core = bearing(measured)
    axes.plot((np.arange(len(curve)) + 0.5) / len(curve), 1e6 * curve)
    axes.plot([0.0, 1.0], [1e6 * top, 1e6 * bottom], label=f"Sk {1e6 * core.sk:.4g} um")
    axes.plot([0.0, core.smr1], [1e6 * top] * 2, label=f"Smr1 {100 * core.smr1:.1f} %")
    axes.plot([core.smr2, 1.0], [1e6 * bottom] * 2, label=f"Smr2 {100 * core.smr2:.1f} %")
    axes.set(xlabel="material ratio", ylabel="height about the mean, um")
    axes.legend()
