"""Solutions, copied out of the library, so that they can be pickled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib, text
from .arrays import pointer
from .errors import check
from .proof import Proof


@dataclass(frozen=True, repr=False)
class Solution:
    """The result of a solve.

    >>> import roundel
    >>> s = roundel.solve(A=[[1.0, 0.0], [1.0, -1.0]], b=[0.4, 0.0], integers=[1])
    >>> s.status, s.proved, round(s.energy, 12)
    ('optimal', True, 0.08)

    Attributes:

      values: np.ndarray
          One value for each variable. Integers are exact, except after a relaxation.
      energy: float
          The objective at the values, recomputed from the original problem.
      lower_bound: Optional[float]
          A lower bound on the energy of all integer solutions, or None if there is no bound.
      gap: Optional[float]
          (energy - lower_bound) / abs(energy), or None if there is no bound. It is 0 where they are
          equal, and infinite for an energy of 0 above the bound.
      status: str
          "optimal": proved; "feasible": a better solution may exist; "limit" and "cancelled": the
          same, ended early by a limit that the caller set or by the caller; "relaxed": integers may
          be fractions, as the strategy "relax" leaves them.
      complete: bool
          Whether the search has visited everything that could be better; always True without
          integers.
      stopped_by: str
          Why the search ended before it was complete: "none", "nodes", "time", "memory", "cancel"
          or "budget" (one of the library's own).
      constraint_violation: float
          The largest relative violation of a constraint.
      integrality_violation: float
          The largest distance of an integer variable from an integer.
      counts: dict[str, int]
          Sizes: "variables", "integers", "constraints" and "inequalities" of the problem,
          "reduced_integers" and "reduced_continuous" after the constraints are eliminated, and
          "factor_nonzeros".
      seconds: dict[str, float]
          Wall-clock seconds by phase: eliminate, factor, round, total.
      proof: Optional[Proof]
          What the proof proves that `solve` was asked to write, or what stopped it; None without one.
    """

    values: np.ndarray
    energy: float
    lower_bound: Optional[float]
    gap: Optional[float]
    status: str
    complete: bool
    stopped_by: str
    constraint_violation: float
    integrality_violation: float
    counts: dict[str, int]
    seconds: dict[str, float]
    proof: Optional[Proof] = None

    def __repr__(self) -> str:
        sizes = f"{self.counts['variables']} variables, {self.counts['integers']} integer"
        gap = "" if self.gap is None or self.proved or self.gap >= 1 else f", gap {100 * self.gap:.2f} %"
        return f"<Solution: {self.status}, energy {self.energy:.6g}{gap}, {sizes}>"

    @property
    def proved(self) -> bool:
        """Whether the solution is proved to be optimal."""
        return self.status == "optimal"


def taken(pointer_: Any) -> Solution:
    """Copies a solution of the library. The caller still has to free it."""
    values = np.empty(number(lib.roundel_solution_variable_count, pointer_))
    check(lib.roundel_solution_values(pointer_, pointer(values), len(values)))
    violations = ffi.new("double[2]")
    check(lib.roundel_solution_violations(pointer_, violations, violations + 1))
    status = number(lib.roundel_solution_status, pointer_, kind="roundel_solve_status")
    stopped_by = number(lib.roundel_solution_stopped_by, pointer_, kind="roundel_stopped_by")
    return Solution(
        values=values,
        energy=number(lib.roundel_solution_energy, pointer_, kind="double"),
        lower_bound=_if_known(lib.roundel_solution_lower_bound, pointer_),
        gap=_if_known(lib.roundel_solution_gap, pointer_),
        status=text(lib.roundel_solve_status_name(status)),
        complete=bool(number(lib.roundel_solution_is_complete, pointer_, kind="int32_t")),
        stopped_by=text(lib.roundel_stopped_by_name(stopped_by)),
        constraint_violation=violations[0],
        integrality_violation=violations[1],
        counts=_members("roundel_counts", lib.roundel_solution_counts, pointer_),
        seconds=_members("roundel_seconds", lib.roundel_solution_seconds, pointer_),
    )


def taken_from(place: Any) -> Solution:
    """Copies the solution that a call has put into this place, and frees it."""
    return taken(Handle("roundel_solution", place[0]).pointer)


def _if_known(call: Any, pointer_: Any) -> Optional[float]:
    known, value = ffi.new("int32_t *"), ffi.new("double *")
    check(call(pointer_, known, value))
    return value[0] if known[0] else None


def _members(kind: str, call: Any, pointer_: Any) -> dict[str, Any]:
    place = ffi.new(f"{kind} *")
    check(call(pointer_, place))
    names = [name for name, _ in ffi.typeof(kind).fields if name != "reserved"]
    return {name: getattr(place, name) for name in names}
