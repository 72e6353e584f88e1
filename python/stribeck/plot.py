"""Pictures with matplotlib, which is optional: ``pip install matplotlib``. Each function draws into ``ax`` or axes of its own and
returns them; a field or a column that is not there is a :class:`~stribeck.UnknownNameError`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ._arguments import instance
from ._numbers import unit
from .errors import unknown
from .history import History
from .solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["history", "map", "profile"]

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
    extent = tuple(1e6 * edge for edge in (*grid.edges_x, *grid.edges_y))
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
