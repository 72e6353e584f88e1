"""Nested numbers with their names as attributes."""

from __future__ import annotations

import html
import keyword
import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._packages import needed
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
    "x": "m",
    "y": "m",
}
#: Units of full names.
_PATHS = {
    **COLUMNS,
    "alpha": "1/Pa",
    "carried_heat": "W",
    "cavitated_shear": "N",
    "correlation_length": "m",
    "edge_flows": "m^3/s",
    "eta0": "Pa s",
    "film.film_rise": "K",
    "film.map.central": "m",
    "bore_widening": "m",
    "groove_flow": "m^3/s",
    "hole_flow": "m^3/s",
    "outlet_temperature": "K",
    "short_roughness": "m",
    "stress": "",
    "supply_temperature": "K",
    "temperature": "K",
    "entrainment_speed": "m/s",
    "spin_radius": "m",
    "force.lower": "N",
    "force.upper": "N",
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
    """The unit of the number, field or key with the name ``path``, empty for ratios and counts."""
    from ._tables import UNITS

    path = path.removeprefix("scene.")
    for known in (FIELDS, _PATHS, UNITS):
        if path in known:
            return known[path]
    return "" if path.startswith("error_estimate.") else _UNITS.get(path.rsplit(".", 1)[-1], "")


def flat(numbers: Numbers, prefix: str = "") -> dict[str, Any]:
    """Numbers and words by their full names; no lists."""
    return {f"{prefix}{name}": value for name, value in numbers.rows() if isinstance(value, bool | int | float | str | None)}


def frame(columns: Mapping[str, Any], units: Mapping[str, str] | None = None) -> Any:
    """A ``pandas.DataFrame`` with the units of its columns in ``attrs``."""
    made = needed("pandas", "to_pandas()").DataFrame(dict(columns))
    made.attrs["units"] = {name: unit(name) if units is None else units.get(name, "") for name in made.columns}
    return made


def dataset(fields: Mapping[str, npt.NDArray[Any]], x: npt.NDArray[Any], y: npt.NDArray[Any], attributes: Mapping[str, Any]) -> Any:
    """An ``xarray.Dataset`` of copies of ``fields`` over ``y`` and ``x`` [m], with units; an attribute that is None is left out."""
    variables = {name: (("y", "x"), field.copy(), {"units": unit(name)}) for name, field in fields.items()}
    places = {"x": ("x", x, {"units": "m"}), "y": ("y", y, {"units": "m"})}
    known = {name: value for name, value in attributes.items() if value is not None}
    return needed("xarray", "to_xarray()").Dataset(variables, coords=places, attrs=known)


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal: tables and lists by their values, arrays by their elements; NaN equals NaN."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(same(value, other[name]) for name, value in one.items())
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        return len(one) == len(other) and all(same(*pair) for pair in zip(one, other, strict=True))
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=np.result_type(one, other).kind == "f")
    return bool(one == other) or (isinstance(one, float) and isinstance(other, float) and math.isnan(one) and math.isnan(other))


class Numbers(Mapping[str, Any]):
    """A read-only table of numbers, nested; ``n.film.central`` is ``n["film"]["central"]`` and ``n["film.central"]``. Of a name that is a word of
    Python, or a method of mappings, the attribute ends with an underscore: ``n.film.lambda_``, ``scene.schedule.load.values_``."""

    __slots__ = ("_path", "_units", "_values")

    _path: str
    _units: Mapping[str, str] | None
    _values: dict[str, Any]

    def __init__(self, values: Mapping[str, Any], path: str = "", units: Mapping[str, str] | None = None) -> None:
        """``path`` is the prefix of the full names, ``film.``; ``units`` are those of full names where the names are not
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

    def __eq__(self, other: object) -> bool:
        """Whether names and values are the same; NaN equals NaN."""
        return same(self, other) if isinstance(other, Mapping) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        names = (f"{name}_" if keyword.iskeyword(name) or hasattr(Mapping, name) else name for name in self._values)
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


class Fields(Mapping[str, npt.NDArray[Any]]):
    """Maps by name."""

    __slots__ = ("_maps",)

    def __init__(self, maps: Mapping[str, npt.NDArray[Any]]) -> None:
        self._maps = dict(maps)

    @classmethod
    def read_only(cls, maps: Mapping[str, npt.NDArray[Any]]) -> Fields:
        """Maps whose values cannot be set."""
        return cls({name: read_only(field) for name, field in maps.items()})

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        if name not in self._maps:
            raise unknown("field", name, self)
        return self._maps[name]

    def __contains__(self, name: object) -> bool:
        return name in self._maps

    def __iter__(self) -> Iterator[str]:
        return iter(self._maps)

    def __len__(self) -> int:
        return len(self._maps)

    def __repr__(self) -> str:
        return f"<Fields {', '.join(self._maps)}>"


def read_only(field: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The same array, whose values cannot be set."""
    view = field.view()
    view.setflags(write=False)
    return view


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
