"""Packages that are optional."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def needed(module: str, user: str) -> Any:
    """A module of an optional package; ``user`` is the function that needs it, by its name.

    Raises
    ------
    ImportError
        Without the package, with the command that installs it.
    """
    package = module.partition(".")[0]
    try:
        return import_module(module)
    except ImportError as error:
        raise ImportError(f"{user} needs {package}: pip install {package}") from error
