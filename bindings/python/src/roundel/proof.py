"""Proofs of a bound, which code that shares nothing with the search confirms."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Optional

from ._library import ffi, lib, path, text
from ._types import File
from .errors import ArgumentTypeError, check, refusal
from .problem import Problem


@dataclass(frozen=True)
class Proof:
    """What a proof proves: that of `solve` with the keyword `proof`, or one that `check_proof` has accepted.

    Attributes:

      energy: Optional[float]
          The energy of the point, rounded to the next number above, or None if there is no point.
      lower_bound: Optional[float]
          No point within all rows, bounds and integers has less energy. None if it is proved that there is no
          such point.
      violation: float
          The largest violation of a row or bound by the point, relative to the sizes of its terms, which
          `check_proof` computes.
      nodes: int
          The nodes of all trees.
      stopped_by: str
          What stopped the proof, "time", "cancel", "memory", "nodes" or "budget": then there is none. "none" for a
          proof that is written, or accepted.
    """

    energy: Optional[float]
    lower_bound: Optional[float]
    violation: float
    nodes: int
    stopped_by: str


def report_of(place: Any) -> Proof:
    """What the library has written into a report."""
    energy, bound = (value if math.isfinite(value) else None for value in (place.energy, place.lower_bound))
    stopped_by = text(lib.roundel_stopped_by_name(place.stopped_by))
    return Proof(energy, bound, place.violation, place.nodes, stopped_by)


def check_proof(file: File, problem: Optional[Problem] = None) -> Proof:
    """Checks the proof in a file, in exact numbers, by code that shares nothing with the search.

    One that does not hold raises `ProofRefusedError`, whose `line` is at fault.

      file: the proof, written by `solve(..., proof=file)`.
      problem: the problem that the proof must be of; None for any.

    >>> import numpy as np, os, roundel, tempfile
    >>> problem = roundel.Problem(2)
    >>> _ = problem.least_squares_rows(np.eye(2), [2.6, 1.4])
    >>> _ = problem.inequality([0, 1], [1, 1], upper=3)
    >>> problem.integer([0, 1])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = os.path.join(folder, "proof.jsonl")
    ...     solution = roundel.solve(problem, proof=file)
    ...     proof = roundel.check_proof(file, problem)
    >>> abs(proof.lower_bound - solution.energy) < 1e-9
    True
    """
    if problem is not None and not isinstance(problem, Problem):
        raise refusal(ArgumentTypeError, f"problem should be a Problem, and is {problem!r}")
    place = ffi.new("roundel_proof_report *")
    of = ffi.NULL if problem is None else problem._handle.pointer
    check(lib.roundel_proof_check(path(file), of, place))
    return report_of(place)
