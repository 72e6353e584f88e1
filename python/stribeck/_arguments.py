"""Arguments of public calls, converted for the compiled module. Every public call converts its arguments here; an invalid one raises a
:class:`~stribeck.StribeckError` with its name and value."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._stribeck import quantity
from .errors import FileError, InputError, ShapeError, StribeckError

if TYPE_CHECKING:
    from ._stribeck import Cells
    from .scene import Grid

#: A number in SI units, or text with a unit.
Quantity = float | str

#: Characters of a value that messages quote.
_LONGEST = 80
#: Whole numbers that the compiled module takes.
_LARGEST = 2**63 - 1
#: Kinds of arrays whose values are numbers: truth values, whole numbers with and without sign, floats.
_NUMBERS = "biuf"
#: Kinds of arrays whose values are truth values, or whole numbers in their place.
_TRUTHS = "biu"


def refused(field: str, value: Any, words: str) -> InputError:
    """The error of an argument that does not meet the requirement ``words``."""
    shown = repr(value)
    if len(shown) > _LONGEST:
        shown = f"{shown[:_LONGEST]}..."
    return InputError(f"{field} = {shown}: must be {words}", field=field, value=value)


def number(field: str, value: Any, unit: str) -> float:
    """A number in ``unit``, or text with a unit as in scenes; ``"1"`` is the unit of dimensionless numbers."""
    if isinstance(value, str) and unit != "1":
        return quantity(field, text(field, value), unit)
    words = "a number" if unit == "1" else f"a number in {unit}, or text with a unit"
    try:
        if isinstance(value, str | bytes):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise refused(field, value, words) from None


def optional_number(field: str, value: Any, unit: str) -> float | None:
    """The same; None stays None."""
    return None if value is None else number(field, value, unit)


def numbers(field: str, values: Any, units: tuple[str, ...]) -> list[float]:
    """As many numbers as there are ``units``."""
    items = _items(field, values, len(units))
    return [number(f"{field}[{k}]", item, unit) for k, (item, unit) in enumerate(zip(items, units, strict=True))]


def whole(field: str, value: Any, *, most: int = _LARGEST) -> int:
    """A whole number from 0 to ``most``."""
    if not isinstance(value, bool | np.bool_) and hasattr(value, "__index__"):
        found = int(value.__index__())
        if 0 <= found <= most:
            return found
    raise refused(field, value, "a whole number from 0" if most == _LARGEST else f"a whole number from 0 to {most}")


def wholes(field: str, values: Any, count: int) -> list[int]:
    """That many whole numbers from 0."""
    return [whole(f"{field}[{k}]", item) for k, item in enumerate(_items(field, values, count))]


def _items(field: str, values: Any, count: int) -> list[Any]:
    if isinstance(values, Iterable) and not isinstance(values, str | bytes):
        items = list(values)
        if len(items) == count:
            return items
    raise refused(field, values, f"{count} numbers")


def truth(field: str, value: Any) -> bool:
    """A truth value, of Python or NumPy."""
    if isinstance(value, bool | np.bool_):
        return bool(value)
    raise refused(field, value, "True or False")


def text(field: str, value: Any) -> str:
    """Text that can be written as UTF-8."""
    if isinstance(value, str) and not any("\ud800" <= letter <= "\udfff" for letter in value):
        return value
    raise refused(field, value, "text without lone surrogates" if isinstance(value, str) else "text")


def path(field: str, value: Any) -> str:
    """The path of a file as text."""
    try:
        found = os.fsdecode(value)
        os.fsencode(found)
    except (TypeError, ValueError):
        raise refused(field, value, "the path of a file") from None
    if not found:
        raise refused(field, value, "the path of a file, it is empty")
    return found


@contextmanager
def writing(place: str) -> Iterator[None]:
    """Raises a :class:`~stribeck.FileError` in place of the operating system's error about the file at ``place``."""
    try:
        yield
    except OSError as error:
        failed = FileError(f"{place}: {error.strerror}", field="path", value=place)
        failed.errno = error.errno
        raise failed from None


def instance(field: str, value: Any, kind: type | tuple[type, ...], words: str) -> None:
    """Refuses a value that is not of ``kind``; ``words`` name it."""
    if not isinstance(value, kind):
        raise refused(field, value, words)


def function(field: str, value: Any) -> None:
    """Refuses a value that is not callable."""
    if value is not None and not callable(value):
        raise refused(field, value, "a function")


@contextmanager
def named(parts: Mapping[str, Any]) -> Iterator[None]:
    """An error from within that names one of the ``parts``, ``ball start`` for ``ball_start``, has it as its value."""
    try:
        yield
    except StribeckError as error:
        if error.value is None and error.field is not None:
            error.value = parts.get(error.field.replace(" ", "_"))
        raise


def cells(grid: Grid) -> Cells:
    """The cells of a grid."""
    from .scene import Grid

    instance("grid", grid, Grid, "a Grid, such as scene.grid or Grid.box(nx, ny, x, y)")
    return grid._cells


def floats(values: Any) -> npt.NDArray[np.float64]:
    """Numbers of any shape; raises TypeError or ValueError for other values, and for masked arrays."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.getmaskarray(values).any():
        raise ValueError(f"{np.ma.getmaskarray(values).sum()} of {values.size} values are masked")
    array = np.asarray(values)
    if array.dtype.kind not in _NUMBERS:
        raise TypeError(f"values of the type {array.dtype}")
    return np.asarray(array, dtype=np.float64)


def array(field: str, values: Any) -> npt.NDArray[np.float64]:
    """Numbers of the shape ``(ny, nx)``; of an xarray array by its dimensions ``y`` and ``x``."""
    if hasattr(values, "dims") and hasattr(values, "transpose"):
        if set(values.dims) != {"y", "x"}:
            raise InputError(f"{field}: dimensions {tuple(values.dims)}, expected y and x", field=field, value=values.dims)
        values = values.transpose("y", "x")
    try:
        found = floats(values)
    except (TypeError, ValueError) as error:
        remedy = "; fill_undefined() of a Surface fills them" if "masked" in str(error) else ""
        if hasattr(values, "fit_to_grid"):
            remedy = "; surface.fit_to_grid(scene.grid) gives the heights of a Surface on a grid, surface.heights its own"
        raise InputError(f"{field}: not an array of numbers ({error}){remedy}", field=field, value=values) from None
    return np.ascontiguousarray(_two_axes(field, found))


def optional_array(field: str, values: Any) -> npt.NDArray[np.float64] | None:
    """The same; None stays None."""
    return None if values is None else array(field, values)


def heights(field: str, values: Any) -> npt.NDArray[np.float64]:
    """Finite numbers of the shape ``(ny, nx)``."""
    found = array(field, values)
    wrong = np.argwhere(~np.isfinite(found))
    if wrong.size:
        row, column = (int(index) for index in wrong[0])
        value = float(found[row, column])
        remedy = "Surface(heights, dx).fill_undefined() fills such points"
        place = f"{field}[{row}][{column}]"
        raise InputError(f"{place} = {value}: must be finite; {remedy}", field=place, value=value)
    return found


def surface_array(field: str, values: Any) -> npt.NDArray[np.float64]:
    """Numbers of the shape ``(ny, nx)``, NaN where they are masked."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan) if values.dtype.kind in _NUMBERS else values.data
    return array(field, values)


def optional_heights(field: str, values: Any) -> npt.NDArray[np.float64] | None:
    """The same; None stays None."""
    return None if values is None else heights(field, values)


def depths(field: str, values: Any) -> npt.NDArray[np.float64] | None:
    """Finite numbers from 0 of the shape ``(ny, nx)``; None stays None."""
    found = optional_array(field, values)
    if found is not None:
        wrong = found[~(np.isfinite(found) & (found >= 0.0))]
        if wrong.size:
            raise refused(field, float(wrong[0]), "finite and at least 0 at every node")
    return found


def mask(field: str, values: Any) -> npt.NDArray[np.bool_]:
    """Truth values of the shape ``(ny, nx)``."""
    try:
        found = np.asarray(values)
    except (TypeError, ValueError) as error:
        raise InputError(f"{field}: not an array of truth values ({error})", field=field, value=values) from None
    if found.dtype.kind not in _TRUTHS:
        message = f"{field}: not an array of truth values (values of the type {found.dtype})"
        raise InputError(message, field=field, value=values)
    return np.ascontiguousarray(_two_axes(field, found), dtype=bool)


def _two_axes(field: str, found: npt.NDArray[Any]) -> npt.NDArray[Any]:
    if found.ndim != 2:
        raise ShapeError(f"{field} has {found.ndim} axes, expected (ny, nx)", field=field, value=found.shape)
    return found
