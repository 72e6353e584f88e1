"""Conversion of solutions, common to all solves."""

from __future__ import annotations

from typing import TypeVar

from . import _typed
from .errors import NotConvergedError

_Solved = TypeVar("_Solved", bound="Solved")


class Report(_typed.Solved):
    """How a solve ended: ``status``, ``solver``, ``residual`` (mass, load, complementarity), ``energy_error``, ``work``."""

    __slots__ = ()


class Solved(_typed.Solved):
    """The numbers of a solve with those of its report."""

    __slots__ = ()

    @property
    def report(self) -> Report:
        """How the solve ended."""
        names = ("status", "solver", "residual", "energy_error", "work")
        values = self.to_dict()
        return Report({name: values[name] for name in names})

    @property
    def converged(self) -> bool:
        """Whether all residuals are at or below the tolerance."""
        return bool(self["status"] == "converged")

    def require_converged(self: _Solved) -> _Solved:
        """The solution itself; raises :class:`~stribeck.NotConvergedError` where it is none."""
        if self.converged:
            return self
        error = NotConvergedError(self._ended(), field="status", value=self["status"])
        error.report = self.report.to_dict()
        raise error

    def _ended(self) -> str:
        """How a solve that has not converged ended, in words."""
        return f"{self['solver']} ended as {self['status']} with the residuals {self['residual'].to_dict()}"
