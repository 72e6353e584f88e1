"""Nested numbers with their names as attributes."""

from __future__ import annotations

import html
import keyword
import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from ._stribeck import columns
from .errors import unknown

#: Units of the columns of a history.
COLUMNS = dict(columns())
#: Units of other names by their last part; names that are not here have none.
_UNITS = {
    "angle": "rad",
    "formula_alpha": "1/Pa",
    "attitude": "rad",
    "approach": "m",
    "area": "m^2",
    "depth": "m",
    "dx": "m",
    "dy": "m",
    "edges_x": "m",
    "edges_y": "m",
    "force": "N",
    "composite_rq": "m",
    "conductivity": "W/(m K)",
    "density_a": "1/Pa",
    "density_b": "1/Pa",
    "diffusivity": "m^2/s",
    "film_cutoff": "m",
    "film_hardness": "Pa",
    "friction_moving": "N",
    "friction_resting": "N",
    "half_width": "m",
    "hardness": "Pa",
    "half_width_x": "m",
    "half_width_y": "m",
    "least_film": "m",
    "length_x": "m",
    "length_y": "m",
    "limiting_shear_stress": "Pa",
    "mean_gap": "m",
    "mean_plastic_depth": "m",
    "mean_pressure": "Pa",
    "power_loss": "W",
    "pressure": "Pa",
    "pressure_max": "Pa",
    "radius": "m",
    "roelands_p0": "Pa",
    "rq": "m",
    "seconds": "s",
    "side_flow": "m^3/s",
    "stiffness": "Pa/m",
    "stress": "Pa",
}
#: Units of full names.
_PATHS = {
    **COLUMNS,
    "entrainment_speed": "m/s",
    "spin_radius": "m",
    "force.lower": "N",
    "force.upper": "N",
    "motion.entrainment_speed": "m/s",
    "load.hertz_pressure": "Pa",
    "thermal.bulk_temperature": "K",
    "lubricant.eta0": "Pa s",
    "lubricant.alpha": "1/Pa",
    "roughness.ball.rq": "m",
    "roughness.disc.rq": "m",
    "elastic.equivalent_modulus": "Pa",
    "plastic.hardness": "Pa",
    "form.radius": "m",
}
#: Units of fields.
FIELDS = {
    "pressure": "Pa",
    "fluid_pressure": "Pa",
    "film": "m",
    "gap": "m",
    "plastic_depth": "m",
    "film_temperature": "K",
}


def unit(path: str) -> str:
    """The unit of the number with the name ``path``, empty for ratios and counts."""
    if path in _PATHS:
        return _PATHS[path]
    return "" if path.startswith("error_estimate.") else _UNITS.get(path.rsplit(".", 1)[-1], "")


def units(name: str) -> str:
    """The unit of a number, column, field or key of a scene by its full name, ``units("film.central")``; empty for ratios, counts and words.
    Numbers are in SI units."""
    if not isinstance(name, str):
        raise unknown("name", name, ["the name of a number, such as film.central"])
    return FIELDS.get(name) or unit(name.removeprefix("scene."))


def flat(numbers: Numbers, prefix: str = "") -> dict[str, Any]:
    """Numbers and words by their full names; no lists."""
    return {f"{prefix}{name}": value for name, value in numbers.rows() if isinstance(value, bool | int | float | str | None)}


def frame(columns: Mapping[str, Any]) -> Any:
    """A ``pandas.DataFrame`` with the units of its columns in ``attrs``."""
    try:
        import pandas as pd  # type: ignore[import-untyped,unused-ignore]
    except ImportError as error:
        raise ImportError("to_pandas() needs pandas: pip install pandas") from error
    made = pd.DataFrame(dict(columns))
    made.attrs["units"] = {name: units(name) for name in made.columns}
    return made


def xarray() -> Any:
    """The package xarray."""
    try:
        import xarray as xr
    except ImportError as error:
        raise ImportError("to_xarray() needs xarray: pip install xarray") from error
    return xr


class Numbers(Mapping[str, Any]):
    """A read-only table of numbers, nested; ``n.film.central`` is ``n["film"]["central"]`` and ``n["film.central"]``. Of a name that is a word of Python the
    attribute ends with an underscore: ``n.film.lambda_``."""

    __slots__ = ("_path", "_units", "_values")

    _path: str
    _units: Mapping[str, str] | None
    _values: dict[str, Any]

    def __init__(self, values: Mapping[str, Any], path: str = "", units: Mapping[str, str] | None = None) -> None:
        """``path`` is what stands before the names in their full ones, ``film.``; ``units`` are those of full names where the names are not
        those of a solution."""
        wrapped = {k: Numbers(v, f"{path}{k}.", units) if isinstance(v, dict) else v for k, v in values.items()}
        object.__setattr__(self, "_path", path)
        object.__setattr__(self, "_units", units)
        object.__setattr__(self, "_values", wrapped)

    def __getitem__(self, key: str) -> Any:
        try:
            return self._values[key]
        except (KeyError, TypeError):
            first, _, rest = key.partition(".") if isinstance(key, str) else ("", "", "")
            inner = self._values.get(first)
            if rest and isinstance(inner, Numbers):
                return inner[rest]
            raise unknown("name", key, self._values) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    if not TYPE_CHECKING:  # names that a table does not have are found by type checkers

        def __getattr__(self, name: str) -> Any:
            if name.startswith("__") or name in Numbers.__slots__:
                raise AttributeError(name)
            try:
                return self._values[name if name in self._values else name.removesuffix("_")]
            except KeyError:
                known = ", ".join(self._values)
                raise AttributeError(f"there is no {name!r} here, but {known}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} cannot be changed")

    def __dir__(self) -> list[str]:
        names = (f"{name}_" if keyword.iskeyword(name) else name for name in self._values)
        return sorted({*super().__dir__(), *names})

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.to_dict(), self._path, self._units)

    def to_dict(self) -> dict[str, Any]:
        """A nested dictionary of plain values."""
        return {k: v.to_dict() if isinstance(v, Numbers) else v for k, v in self._values.items()}

    def rows(self, prefix: str = "") -> Iterator[tuple[str, Any]]:
        """All values with their full names."""
        for key, value in self._values.items():
            if isinstance(value, Numbers):
                yield from value.rows(f"{prefix}{key}.")
            else:
                yield f"{prefix}{key}", value

    def _unit(self, name: str, value: Any) -> str:
        if value is None or isinstance(value, str):
            return ""
        full = f"{self._path}{name}"
        return unit(full) if self._units is None else self._units.get(full, "")

    def __repr__(self) -> str:
        lines = [f"  {name:<30} {_text(value)} {self._unit(name, value)}".rstrip() for name, value in self.rows()]
        return "\n".join([f"<{type(self).__name__}", *lines, ">"])

    def _repr_html_(self) -> str:
        return table((name, _text(value), self._unit(name, value)) for name, value in self.rows())


class Table(Numbers):
    """A table whose names type checkers do not know."""

    __slots__ = ()

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...


class Fields(dict[str, npt.NDArray[Any]]):
    """Maps by name."""

    def __missing__(self, name: str) -> npt.NDArray[Any]:
        raise unknown("field", name, self)


def _text(value: Any) -> str:
    if isinstance(value, float):
        return "nan" if math.isnan(value) else f"{value:.6g}"
    return str(value)


def table(rows: Any, head: Any = ()) -> str:
    """An HTML table of texts."""
    cells = ["".join(f"<td>{html.escape(str(cell))}</td>" for cell in row) for row in rows]
    heads = "".join(f"<th>{html.escape(str(cell))}</th>" for cell in head)
    top = f"<thead><tr>{heads}</tr></thead>" if heads else ""
    body = "".join(f"<tr>{row}</tr>" for row in cells)
    return f"<table>{top}<tbody>{body}</tbody></table>"
