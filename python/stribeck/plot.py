"""Pictures with matplotlib, which is optional: ``pip install matplotlib``. Each function draws into ``ax``, or into new axes, and returns the
artists it has drawn, which know their axes: ``plot.map(solution).axes.set_title("film")``; :func:`surface` takes five axes. A field or a column that is not there is a
:class:`~stribeck.UnknownNameError`.

:func:`map`, :func:`profile` and :func:`animation` take whatever has fields: a :class:`~stribeck.Solution`, a :class:`~stribeck.Simulation` (its last
contact), a :class:`~stribeck.GivenFilm`, an ``xarray.Dataset`` of ``to_xarray()``, a pair ``(grid, fields)``; :func:`map` and
:func:`profile` also a :class:`~stribeck.surface.Surface`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from ._arguments import instance, refused
from ._numbers import Fields, unit
from ._packages import needed
from ._stribeck import bearing_curve
from .errors import unknown
from .film import GivenFilm
from .history import History, Simulation
from .metrics import bearing, radial_spectrum
from .points import Sweep
from .scene import Grid
from .solution import Solution
from .surface import Surface

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from matplotlib.container import BarContainer
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D

__all__ = ["animation", "curve", "history", "map", "profile", "surface"]

Shown: TypeAlias = Any

#: Fields: scale of the unit shown and its name.
_SHOWN = {
    "pressure": (1e-9, "GPa"),
    "fluid_pressure": (1e-9, "GPa"),
    "film": (1e9, "nm"),
    "gap": (1e6, "um"),
    "height": (1e6, "um"),
    "plastic_depth": (1e9, "nm"),
    "theta": (1.0, ""),
    "in_contact": (1.0, ""),
}
_WITH_FIELDS = "a Solution, a Simulation, a GivenFilm, a Dataset of to_xarray(), a Surface or a pair (grid, fields)"
#: Distance between the scales of further units beside a profile [points].
_SCALE_WIDTH = 50
#: Pictures of a surface, and the fewest points along a side of a spectrum.
_PICTURES, _LEAST = 5, 4


class _Maps(NamedTuple):
    """Fields over the positions ``x`` and ``y``, in units of ``length``."""

    fields: Mapping[str, npt.NDArray[Any]]
    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    length: str

    def extent(self) -> tuple[float, float, float, float]:
        """Outer edges of the cells: left, right, low, high."""
        halves = [0.5 * (place[1] - place[0]) if len(place) > 1 else 0.5 for place in (self.x, self.y)]
        (dx, dy), (x, y) = halves, (self.x, self.y)
        return float(x[0] - dx), float(x[-1] + dx), float(y[0] - dy), float(y[-1] + dy)


def _maps(shown: Shown) -> _Maps:
    """The fields of whatever has some."""
    if isinstance(shown, Surface):
        ny, nx = shown.shape
        known = shown.dx is not None and shown.dy is not None
        dx, dy = (1e6 * (shown.dx or 0.0), 1e6 * (shown.dy or 0.0)) if known else (1.0, 1.0)
        x, y = (size * (np.arange(count, dtype=np.float64) + 0.5) for size, count in ((dx, nx), (dy, ny)))
        return _Maps(Fields({"height": shown.to_masked()}), x, y, "um" if known else "points")
    if isinstance(shown, Solution | Simulation | GivenFilm):
        return _on_grid(shown.grid, shown.fields)
    if isinstance(shown, tuple) and len(shown) == 2 and isinstance(shown[0], Grid) and isinstance(shown[1], Mapping):
        return _on_grid(*shown)
    variables = getattr(shown, "data_vars", None)
    if variables is not None and {"x", "y"} <= set(shown.coords):
        fields = {str(name): field.values for name, field in variables.items() if field.dims == ("y", "x")}
        return _Maps(Fields(fields), 1e6 * shown["x"].values, 1e6 * shown["y"].values, "um")
    raise refused("shown", shown, _WITH_FIELDS)


def _on_grid(grid: Grid, fields: Mapping[str, npt.NDArray[Any]]) -> _Maps:
    return _Maps(Fields(fields), 1e6 * grid.x, 1e6 * grid.y, "um")


def _pyplot() -> Any:
    return needed("matplotlib.pyplot", "stribeck.plot")


def _axes(ax: Axes | None) -> Any:
    return _pyplot().subplots(layout="constrained")[1] if ax is None else ax


def _label(name: str, shown: str) -> str:
    words = name.replace("_", " ").replace(".", " ")
    return f"{words}, {shown}" if shown else words


def _chosen(names: str | Sequence[str]) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def _own_name(shown: Shown, name: str | None) -> str:
    """The name of the field, by default that of the film or of the heights."""
    return name or ("height" if isinstance(shown, Surface) else "film")


def map(shown: Shown, name: str | None = None, *, ax: Axes | None = None, **options: Any) -> AxesImage:  # noqa: A001
    """A field over x and y in micrometres, by default the film; ``options`` go to ``imshow``. Undefined points are grey."""
    name = _own_name(shown, name)
    maps = _maps(shown)
    values = maps.fields[name]
    axes = _axes(ax)
    scale, unit_shown = _SHOWN.get(name, (1.0, ""))
    colors = _pyplot().get_cmap(options.pop("cmap", "viridis")).with_extremes(bad="0.67")
    image: AxesImage = axes.imshow(values * scale, origin="lower", extent=maps.extent(), cmap=colors, **options)
    axes.figure.colorbar(image, ax=axes, label=_label(name, unit_shown))
    axes.set(xlabel=f"x, {maps.length}", ylabel=f"y, {maps.length}")
    return image


def profile(
    shown: Shown, names: str | Sequence[str] | None = None, *, along: str = "x", ax: Axes | None = None, **options: Any
) -> list[Line2D]:
    """Fields along the row or column next to the middle of the contact, each unit on a scale of its own; ``options`` go to ``plot``."""
    if along not in ("x", "y"):
        raise unknown("along", along, ("x", "y"))
    chosen = _chosen(_own_name(shown, None) if names is None else names)
    maps = _maps(shown)
    fields = [maps.fields[name] for name in chosen]
    axes = _axes(ax)
    positions, across = (maps.x, maps.y) if along == "x" else (maps.y, maps.x)
    middle = len(across) // 2 if isinstance(shown, Surface) else int(abs(across).argmin())
    scales: dict[str, Any] = {}
    lines: list[Line2D] = []
    for k, (name, field) in enumerate(zip(chosen, fields, strict=True)):
        scale, unit_shown = _SHOWN.get(name, (1.0, ""))
        own = scales.setdefault(unit_shown, axes if not scales else axes.twinx())
        line = field[middle, :] if along == "x" else field[:, middle]
        lines += own.plot(positions, scale * line, **{"color": f"C{k % 10}", "label": _label(name, unit_shown), **options})
    axes.set_xlabel(f"{along}, {maps.length}")
    for k, (unit_shown, own) in enumerate(scales.items()):
        of_unit = [name for name in chosen if _SHOWN.get(name, (1.0, ""))[1] == unit_shown]
        own.set_ylabel(_label(" and ".join(of_unit), unit_shown))
        if k > 1:
            own.spines["right"].set_position(("outward", _SCALE_WIDTH * (k - 1)))
    if len(lines) > 1:
        axes.legend(handles=lines)
    return lines


def history(
    records: History | Simulation, names: str | Sequence[str] = "friction.coefficient", *, ax: Axes | None = None, **options: Any
) -> list[Line2D]:
    """Columns of a history over time in seconds; ``options`` go to ``plot``."""
    if isinstance(records, Simulation):
        records = records.history
    instance("records", records, History, "a History or a Simulation")
    chosen = _chosen(names)
    columns = [records[name] for name in chosen]
    axes = _axes(ax)
    lines: list[Line2D] = []
    for name, column in zip(chosen, columns, strict=True):
        lines += axes.plot(records["time"], column, label=_label(name, unit(name)), **options)
    axes.set_xlabel("time, s")
    _name_values(axes, chosen)
    return lines


def curve(
    sweep: Sweep, names: str | Sequence[str] = "friction.coefficient", *, over: str | None = None, ax: Axes | None = None, **options: Any
) -> list[Line2D]:
    """Numbers of a sweep over one of its inputs, by default the first, a line for each value of the others: a Stribeck curve where that input is
    the speed. Scales are logarithmic where positive values span more than a decade; ``options`` go to ``plot``."""
    instance("sweep", sweep, Sweep, "a Sweep, such as stribeck.sweep(scene, {...})")
    across = next(iter(sweep.axes)) if over is None else over
    if across not in sweep.axes:
        raise unknown("over", across, sweep.axes)
    chosen = _chosen(names)
    places, columns = sweep[across], [sweep[name] for name in chosen]
    for name, column in zip([across, *chosen], [places, *columns], strict=True):
        if column.dtype.kind not in "fiub":
            raise refused("names" if name in chosen else "over", name, "a column of numbers")
    others = [key for key in sweep.axes if key != across]
    groups: dict[tuple[Any, ...], list[int]] = {}
    for k in range(len(sweep)):
        groups.setdefault(tuple(sweep[key][k] for key in others), []).append(k)
    axes = _axes(ax)
    lines: list[Line2D] = []
    for name, column in zip(chosen, columns, strict=True):
        for values, points in groups.items():
            own = [f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}" for key, value in zip(others, values, strict=True)]
            label = ", ".join([*([_label(name, unit(name))] if len(chosen) > 1 or not own else []), *own])
            order = sorted(points, key=lambda k: places[k])
            lines += axes.plot(places[order], column[order], **{"marker": "o", "label": label, **options})
    for set_scale, shown in ((axes.set_xscale, [places]), (axes.set_yscale, columns)):
        if all(np.nanmin(column) > 0.0 and np.nanmax(column) > 10.0 * np.nanmin(column) for column in shown):
            set_scale("log")
    axes.set_xlabel(_label(across, unit(across)))
    _name_values(axes, chosen)
    if others:
        axes.legend()
    return lines


def _name_values(axes: Any, names: Sequence[str]) -> None:
    """The name of the only column beside the scale, or a legend."""
    if len(names) == 1:
        axes.set_ylabel(_label(names[0], unit(names[0])))
    else:
        axes.legend()


def animation(
    frames: Sequence[Shown], name: str = "film", *, interval: float = 100.0, ax: Axes | None = None, **options: Any
) -> FuncAnimation:
    """A field of contacts one after the other, ``interval`` milliseconds each, under one scale of colors: of a history, say, whose ``callback``
    appends ``(simulation.grid, simulation.fields)`` to a list. ``options`` go to ``imshow``; ``.save("film.gif")`` writes it."""
    fields = [_maps(frame).fields[name] * _SHOWN.get(name, (1.0, ""))[0] for frame in frames]
    if not fields:
        raise refused("frames", frames, "at least one contact")
    limits = {"vmin": min(np.nanmin(field) for field in fields), "vmax": max(np.nanmax(field) for field in fields)}
    image = map(frames[0], name, ax=ax, **{**limits, **options})
    figure: Any = image.figure

    def draw(k: int) -> tuple[AxesImage]:
        image.set_data(fields[k])
        return (image,)

    made: FuncAnimation = needed("matplotlib.animation", "stribeck.plot").FuncAnimation(figure, draw, frames=len(fields), interval=interval)
    return made


class SurfacePicture(NamedTuple):
    """The artists of :func:`surface`; ``spectrum`` is empty for too few points or without spacing."""

    map: AxesImage
    profile: list[Line2D]
    heights: BarContainer
    bearing: list[Line2D]
    spectrum: list[Line2D]

    @property
    def figure(self) -> Figure:
        """The figure of the artists."""
        figure: Any = self.map.figure
        return cast("Figure", figure)


def surface(measured: Surface, *, ax: Sequence[Axes] | None = None) -> SurfacePicture:
    """A surface in five pictures: height map with undefined points in grey, middle profile, height distribution, bearing curve with the
    construction of Sk, spectrum. ``ax`` are the axes of these five, by default those of a new figure."""
    instance("measured", measured, Surface, "a Surface")
    axes = _five_axes() if ax is None else list(ax) if isinstance(ax, Iterable) else []
    if len(axes) != _PICTURES:
        raise refused("ax", ax, "five axes: of map, profile, heights, bearing curve and spectrum")
    of_map, of_profile, of_heights, of_bearing, of_spectrum = axes
    ny = measured.shape[0]
    image, lines = map(measured, ax=of_map), profile(measured, ax=of_profile)
    if ny == 1:
        # a line as wide as it is long
        of_map.set_aspect("auto")
    of_profile.set_title(f"row {ny // 2}")
    bars = cast("BarContainer", of_heights.hist((1e6 * measured.to_masked()).compressed(), bins=60, density=True)[2])
    of_heights.set(xlabel="height, um", ylabel="density, 1/um")
    return SurfacePicture(image, lines, bars, _bearing(of_bearing, measured), _spectrum_of(of_spectrum, measured))


def _five_axes() -> list[Any]:
    _, axes = _pyplot().subplots(2, 3, figsize=(15, 8), layout="constrained")
    axes[1, 2].set_axis_off()
    return list(axes.flat)[:_PICTURES]


def _spectrum_of(axes: Axes, measured: Surface) -> list[Line2D]:
    """The spectrum of a map or of a profile."""
    ny, nx = measured.shape
    if measured.dx is not None and measured.dy is not None and min(nx, ny) >= _LEAST:
        return _spectrum(axes, *radial_spectrum(measured, boundary="open"), "radial spectral density, m^4")
    if measured.dx is not None and ny == 1 and nx >= _LEAST:
        return _spectrum(axes, *_profile_spectrum(measured.fill_undefined().heights[0], measured.dx), "spectral density, m^3")
    axes.set_title("no spectrum: too few points or no spacing")
    return []


def _spectrum(axes: Axes, wavenumber: npt.NDArray[Any], density: npt.NDArray[Any], label: str) -> list[Line2D]:
    shown = density > 0.0
    axes.set(xlabel="wavenumber, 1/m", ylabel=label)
    return axes.loglog(wavenumber[shown], density[shown])


def _profile_spectrum(heights: npt.NDArray[Any], dx: float) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Density ``|h(q)|^2 / L`` of a profile under a Hann window of mean square 1 (Jacobs, Junge and Pastewka 2017)."""
    count = len(heights)
    window = np.sqrt(2.0 / 3.0) * (1.0 - np.cos(2.0 * np.pi * (np.arange(count) + 0.5) / count))
    transform = dx * np.fft.rfft(window * (heights - heights.mean()))[1:]
    length = dx * count
    return 2.0 * np.pi / length * np.arange(1, len(transform) + 1), np.abs(transform) ** 2 / length


def _bearing(axes: Axes, measured: Surface) -> list[Line2D]:
    """The bearing curve, the equivalent line of its core and the ratios at which its ends cut the curve."""
    curve, (top, bottom) = bearing_curve(np.ascontiguousarray(measured.heights))
    core = bearing(measured)
    lines = axes.plot((np.arange(len(curve)) + 0.5) / len(curve), 1e6 * curve)
    lines += axes.plot([0.0, 1.0], [1e6 * top, 1e6 * bottom], label=f"Sk {1e6 * core.sk:.4g} um")
    lines += axes.plot([0.0, core.smr1], [1e6 * top] * 2, label=f"Smr1 {100 * core.smr1:.1f} %")
    lines += axes.plot([core.smr2, 1.0], [1e6 * bottom] * 2, label=f"Smr2 {100 * core.smr2:.1f} %")
    axes.set(xlabel="material ratio", ylabel="height about the mean, um")
    axes.legend()
    return lines
