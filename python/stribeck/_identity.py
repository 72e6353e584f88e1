"""Identities of laws in checkpoints: their constants and their code, wherever Python keeps them."""

from __future__ import annotations

import enum
import functools
import hashlib
import numbers
import pickle
import platform
import sys
import types
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from .errors import LawError

_PLAIN = bool | int | float | complex | str | bytes | type(None) | type(...) | numbers.Number
#: Longest value that is spelled out; of a longer one the digest stands for its end.
_LONGEST = 80
#: Objects within each other that are described.
_DEPTH = 12
#: Special methods without effect on the numbers of a law.
_UNUSED = {"__init__", "__new__", "__post_init__", "__repr__", "__str__", "__eq__", "__hash__", "__reduce__", "__getstate__", "__setstate__", "__replace__", "__setattr__", "__delattr__"}
#: Modules whose objects change as they are used: generators of random numbers.
_MEMORY = ("random", "numpy.random")
_PYTHON = ".".join(platform.python_version_tuple()[:2])


def identity(law: Any) -> str:
    """The name of the law and, line by line, the data and code that it uses: attributes, slots, defaults, closures, bound and partial arguments, the
    byte code of its functions, and the functions and constants of the user's modules that they reach. An attribute whose name begins with an
    underscore is memory and no constant, and so is a list, set or dictionary with such a name in a module or class. An attribute ``identity`` of the
    law, a text or a method that returns one, stands in place of all this. Arrays, lists and dictionaries are described by their values."""
    own = getattr(law, "identity", None)
    if own is not None and not isinstance(law, type):
        text = own() if callable(own) else own
        if not isinstance(text, str):
            raise LawError(f"identity of the law: {text!r} is no text", field="identity", value=text)
        return text
    if isinstance(law, _PLAIN | np.ndarray | list | tuple | Mapping) or not (callable(law) or _is_own(type(law))):
        return f"{_name(type(law))}\n{_described(law, ())}"
    parts: dict[str, str] = {}
    counts: dict[str, int] = {}
    # parts of one name, two lambdas for example, are told apart by their order
    for name, text in _parts(law, set()):
        counts[name] = counts.get(name, 0) + 1
        parts[name if counts[name] == 1 else f"{name} ({counts[name]})"] = text
    kind = law if isinstance(law, types.FunctionType) else type(law)
    return "\n".join([_name(kind), *(f"{name} = {_short(text)}" for name, text in parts.items())])


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST and "\n" not in text else f"{text[:40]!r}... sha256 {_digest(text.encode())}"


def _name(of: Any) -> str:
    return f"{of.__module__}.{of.__qualname__}"


def _is_own(of: Any) -> bool:
    """Whether a function, class or module is the user's, neither of the standard library nor of an installed package."""
    name = of.__name__ if isinstance(of, types.ModuleType) else getattr(of, "__module__", None)
    root = (name or "").partition(".")[0]
    if not root or root in ("stribeck", "builtins") or root in sys.stdlib_module_names - {"__main__"}:
        return False
    file = getattr(sys.modules.get(name or ""), "__file__", None) or ""
    return "site-packages" not in file and "dist-packages" not in file


def _parts(law: Any, reached: set[int]) -> Iterator[tuple[str, str]]:
    """Names and descriptions of all that the law computes with; ``reached`` are functions and classes that are described."""
    if isinstance(law, functools.partial):
        for place, argument in [*enumerate(law.args), *sorted(law.keywords.items())]:
            yield from _reached(f"argument {place}", argument, reached)
        yield from _parts(law.func, reached)
    elif isinstance(law, types.MethodType):
        yield from _parts(law.__self__, reached)
        if isinstance(law.__func__, types.FunctionType):
            yield from _of_function(law.__func__, reached)
    elif isinstance(law, types.FunctionType):
        yield from _of_function(law, reached)
    elif isinstance(law, type):
        yield from _of_class(law, reached)
    else:
        for name, value in _attributes(law):
            yield from _reached(name, value, reached)
        yield from _of_class(type(law), reached)


def _of_class(kind: type, reached: set[int]) -> Iterator[tuple[str, str]]:
    """Of the functions and constants in the bodies of a class and its bases."""
    for base in kind.__mro__:
        if id(base) in reached or not _is_own(base):
            continue
        reached.add(id(base))
        for name, member in sorted(vars(base).items()):
            if name in _UNUSED or (name.startswith("__") and not callable(member)):
                continue
            if isinstance(member, types.MemberDescriptorType | types.GetSetDescriptorType):
                continue
            functions = [getattr(member, part, None) for part in ("fget", "func", "__func__")] + [member]
            function = next((found for found in functions if isinstance(found, types.FunctionType)), None)
            if function is not None:
                yield from _of_function(function, reached)
            elif not _is_memory(name, member):
                yield from _reached(f"{base.__qualname__}.{name}", member, reached)


def _of_function(function: types.FunctionType, reached: set[int]) -> Iterator[tuple[str, str]]:
    """Of code, defaults and closure of a function, and of the globals that it reaches."""
    if id(function) in reached:
        return
    reached.add(id(function))
    name, code = function.__qualname__, function.__code__
    yield f"code of {name} (Python {_PYTHON})", _of_code(code)
    defaults = [*(function.__defaults__ or ()), *sorted((function.__kwdefaults__ or {}).items())]
    if defaults:
        yield f"defaults of {name}", _described(defaults, ())
    for variable, cell in zip(code.co_freevars, function.__closure__ or (), strict=True):
        yield from _reached(f"{name}: {variable}", _cell(cell), reached)
    names = sorted(_names(code))
    for variable in names:
        if variable not in function.__globals__:
            continue
        value = function.__globals__[variable]
        if not isinstance(value, types.ModuleType):
            yield from _of_global(variable, value, reached)
        elif _is_own(value):
            for attribute in names:
                if hasattr(value, attribute):
                    yield from _of_global(f"{variable}.{attribute}", getattr(value, attribute), reached)


def _of_global(name: str, value: Any, reached: set[int]) -> Iterator[tuple[str, str]]:
    if not _is_memory(name.rpartition(".")[2], value):
        yield from _reached(name, value, reached)


def _is_memory(name: str, value: Any) -> bool:
    """Whether a name of a module or class is one of memory."""
    return name.startswith("_") and isinstance(value, list | set | dict)


def _reached(name: str, value: Any, reached: set[int]) -> Iterator[tuple[str, str]]:
    """Of a value that a law or a function refers to."""
    value = getattr(value, "__wrapped__", value) if callable(value) and not isinstance(value, type) else value
    if isinstance(value, types.FunctionType | type):
        yield name, _name(value)
        if _is_own(value):
            yield from _parts(value, reached)
    elif isinstance(value, types.MethodType | functools.partial):
        yield name, _name(type(value))
        yield from ((f"{name}: {part}", text) for part, text in _parts(value, reached))
    elif not isinstance(value, types.ModuleType):
        yield name, _described(value, ())
        yield from _of_inner(value, reached, 0)


def _of_inner(value: Any, reached: set[int], depth: int) -> Iterator[tuple[str, str]]:
    """Of the classes of the objects in a value."""
    if depth > _DEPTH or isinstance(value, _PLAIN | np.ndarray) or id(value) in reached:
        return
    inner: Iterable[Any] = ()
    if isinstance(value, list | tuple | set | frozenset):
        inner = value
    elif isinstance(value, Mapping):
        inner = value.values()
    elif not callable(value) or _is_own(type(value)):
        reached.add(id(value))
        if _is_own(type(value)):
            yield from _of_class(type(value), reached)
        inner = [part for _, part in _attributes(value)]
    for part in inner:
        yield from _of_inner(part, reached, depth + 1)


def _names(code: types.CodeType) -> set[str]:
    """Names of globals and attributes in the code and the functions within it."""
    found = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            found |= _names(constant)
    return found


def _of_code(code: types.CodeType) -> str:
    names = [code.co_names, code.co_freevars, code.co_varnames]
    return f"{_digest(code.co_code + repr(names).encode())}, {_described(code.co_consts, ())}"


def _described(value: Any, within: tuple[int, ...]) -> str:
    """``value`` in words that are the same for equal values; ``within`` are the objects that are being described."""
    if isinstance(value, np.ndarray | np.generic):
        return _numbers(np.asarray(value), within)
    if isinstance(value, _PLAIN):
        return repr(value)
    if id(value) in within or len(within) > _DEPTH:
        return f"the same {type(value).__qualname__}"
    within = (*within, id(value))
    if isinstance(value, list | tuple | set | frozenset):
        parts = [_described(part, within) for part in value]
        return f"{type(value).__name__}({', '.join(parts if isinstance(value, list | tuple) else sorted(parts))})"
    if isinstance(value, Mapping):
        return f"dict({', '.join(sorted(f'{_described(key, within)}={_described(part, within)}' for key, part in value.items()))})"
    if isinstance(value, types.CodeType):
        return f"code({_of_code(value)})"
    if isinstance(value, types.FunctionType | types.MethodType | functools.partial):
        return _digest(repr(list(_parts(value, set(within) - {id(value)}))).encode())
    if isinstance(value, types.ModuleType | type | types.BuiltinFunctionType | np.ufunc):
        return f"{getattr(value, '__module__', None)}.{getattr(value, '__qualname__', getattr(value, '__name__', None))}"
    kind = type(value)
    if isinstance(value, enum.Enum):
        return f"{_name(kind)}.{value.name}={_described(value.value, within)}"
    if callable(getattr(value, "__wrapped__", None)):
        return f"{_name(kind)}({_described(value.__wrapped__, within)})"
    attributes = list(_attributes(value))
    if not _is_own(kind) and not kind.__module__.startswith(_MEMORY):
        try:
            return f"{_name(kind)} {_digest(pickle.dumps(value, protocol=4))}"
        except Exception:  # noqa: BLE001
            pass  # described by its attributes
    return f"{_name(kind)}({', '.join(f'{name}={_described(part, within)}' for name, part in attributes)})"


def _numbers(array: np.ndarray[Any, Any], within: tuple[int, ...]) -> str:
    if array.dtype.hasobject:
        return f"array({array.shape}, {_described(array.ravel().tolist(), within)})"
    if array.ndim == 0:
        return f"{array.dtype.name}({array.item()!r})"
    return f"array({array.dtype}, {array.shape}, {_digest(np.ascontiguousarray(array).tobytes())})"


def _cell(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:
        return ...


def _attributes(value: Any) -> Iterator[tuple[str, Any]]:
    """Attributes and slots by name, but for those that begin with an underscore."""
    slots = {name for kind in type(value).__mro__ for name in _slots(getattr(kind, "__slots__", ()))}
    for name in sorted(slots | set(getattr(value, "__dict__", ()))):
        if not name.startswith("_") and hasattr(value, name):
            yield name, getattr(value, name)


def _slots(slots: Any) -> tuple[str, ...]:
    return (slots,) if isinstance(slots, str) else tuple(slots)
