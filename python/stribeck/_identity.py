"""What tells laws apart in a checkpoint: their names and their constants, wherever Python keeps them."""

from __future__ import annotations

import functools
import hashlib
import types
from collections.abc import Iterator
from typing import Any

import numpy as np

_PLAIN = bool | int | float | complex | str | bytes | type(None) | type(...)
#: Longest description that is spelled out; of a longer one the digest stands for its end.
_LONGEST = 200


def identity(law: Any) -> str:
    """The name of the law and what it computes with: attributes, slots, defaults, closures, bound and partial arguments, and the byte code of
    a function. What a method keeps under a name that begins with an underscore is its memory and no constant."""
    text = _described(law, ())
    if len(text) <= _LONGEST:
        return text
    return f"{text[:_LONGEST]}... sha256 {_digest(text.encode())}"


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]


def _described(value: Any, within: tuple[int, ...]) -> str:
    """``value`` in words that are the same for equal values; ``within`` are the objects that are being described."""
    if isinstance(value, _PLAIN):
        return repr(value)
    if id(value) in within:
        return f"the same {type(value).__qualname__}"
    within = (*within, id(value))
    if isinstance(value, np.ndarray | np.generic):
        return _numbers(np.asarray(value), within)
    if isinstance(value, list | tuple | set | frozenset):
        parts = [_described(part, within) for part in value]
        return f"{type(value).__name__}({', '.join(parts if isinstance(value, list | tuple) else sorted(parts))})"
    if isinstance(value, dict):
        return f"dict({', '.join(sorted(f'{_described(key, within)}={_described(part, within)}' for key, part in value.items()))})"
    if isinstance(value, types.CodeType):
        names = [value.co_names, value.co_freevars]
        return f"code({_digest(value.co_code + repr(names).encode())}, {_described(value.co_consts, within)})"
    return _of_callable(value, within) or f"{_name(type(value))}({_pairs(_attributes(value), within)})"


def _name(of: Any) -> str:
    return f"{of.__module__}.{of.__qualname__}"


def _pairs(items: Any, within: tuple[int, ...]) -> str:
    return ", ".join(f"{name}={_described(part, within)}" for name, part in items)


def _numbers(array: np.ndarray[Any, Any], within: tuple[int, ...]) -> str:
    if array.dtype.hasobject:
        return f"array({array.shape}, {_described(array.ravel().tolist(), within)})"
    if array.ndim == 0:
        return f"{array.dtype.name}({array.item()!r})"
    return f"array({array.dtype}, {array.shape}, {_digest(np.ascontiguousarray(array).tobytes())})"


def _of_callable(value: Any, within: tuple[int, ...]) -> str | None:
    """Of functions, methods, partial functions, classes and modules; None for other objects."""
    if isinstance(value, functools.partial):
        return f"partial({_described((value.func, value.args, value.keywords), within)})"
    if isinstance(value, types.MethodType):
        return f"{_described(value.__self__, within)}.{value.__name__}"
    if isinstance(value, types.FunctionType):
        cells = [_cell(cell) for cell in value.__closure__ or ()]
        parts = {"code": value.__code__, "defaults": value.__defaults__, "keywords": value.__kwdefaults__, "closure": cells}
        return f"{_name(value)}({_pairs(((name, part) for name, part in parts.items() if part), within)})"
    if isinstance(value, types.ModuleType):
        return value.__name__
    name = getattr(value, "__qualname__", getattr(value, "__name__", None))
    return None if name is None else f"{getattr(value, '__module__', None)}.{name}"


def _cell(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:
        return ...


def _attributes(value: Any) -> Iterator[tuple[str, Any]]:
    """Attributes and slots by name, but for those that begin with an underscore."""
    slots = {name for kind in type(value).__mro__ for name in _names(getattr(kind, "__slots__", ()))}
    for name in sorted(slots | set(getattr(value, "__dict__", ()))):
        if not name.startswith("_") and hasattr(value, name):
            yield name, getattr(value, name)


def _names(slots: Any) -> tuple[str, ...]:
    return (slots,) if isinstance(slots, str) else tuple(slots)
