"""Exceptions: one class for each status of the C interface, with the element at fault."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any, Iterable, Optional

from ._library import ffi, last_message, lib, text

__all__ = [
    "Error",
    "ArgumentTypeError",
    "CancelledError",
    "EmptyError",
    "InconsistentOrientationError",
    "IndexOutOfRangeError",
    "InfeasibleError",
    "InvalidArgumentError",
    "IoError",
    "IsolatedVertexError",
    "LengthMismatchError",
    "MissingPackageError",
    "NoIntegerSolutionError",
    "NonManifoldEdgeError",
    "NonManifoldVertexError",
    "NotATriangleError",
    "NotConvexError",
    "NotFiniteError",
    "NotSupportedError",
    "NullPointerError",
    "OptionRangeError",
    "OptionTypeError",
    "OutOfMemoryError",
    "CountOverflowError",
    "PanicError",
    "ParseError",
    "ProofRefusedError",
    "RepeatedVertexError",
    "SearchLimitError",
    "TimeLimitError",
    "UnboundedError",
    "UnknownOptionError",
    "UnusableError",
    "ZeroAreaError",
]


class Error(Exception):
    """A call of the library failed. This is the base class of all exceptions of the package.

    The elements of a problem or a mesh are counted from 0, lines of a file from 1. If the element at
    fault is known, one of `row`, `position`, `variable`, `face` and `vertex` is set. The subclass says
    which.

    >>> import roundel
    >>> try:
    ...     roundel.solve(A=[[1.0, 0.0]], b=[0.0], C=[[2.0, 4.0]], d=[3.0], integers=[0, 1])
    ... except roundel.NoIntegerSolutionError as error:
    ...     print(error.row, error)
    0 constraint 0: 2 x0 + 4 x1 = 3 has no integer solution
    """

    #: The kind of element that `index` counts: "row", "position", "variable", "face", "vertex", or
    #: "" if only the message tells.
    element: str = ""

    def __init__(
        self,
        message: str,
        code: str = "",
        status: int = 0,
        index: Optional[int] = None,
        line: Optional[int] = None,
        direction: Any = None,
    ) -> None:
        super().__init__(message)
        #: The word for the status, such as "no_integer_solution".
        self.code = code
        #: The number of the status, a `roundel_status` of the C interface.
        self.status = status
        #: The number of the element at fault, of any kind, or None.
        self.index = index
        #: The line of the file at fault, from 1, or None.
        self.line = line
        #: The direction in which the objective decreases without limit or curves downwards, or None.
        self.direction = direction

    def _if(self, element: str) -> Optional[int]:
        return self.index if self.element == element else None

    @property
    def row(self) -> Optional[int]:
        """The constraint at fault."""
        return self._if("row")

    @property
    def position(self) -> Optional[int]:
        """The position at fault in the given array."""
        return self._if("position")

    @property
    def variable(self) -> Optional[int]:
        """A variable that the direction moves."""
        return self._if("variable")

    @property
    def face(self) -> Optional[int]:
        """The face at fault."""
        return self._if("face")

    @property
    def vertex(self) -> Optional[int]:
        """The vertex at fault."""
        return self._if("vertex")


class NullPointerError(Error, ValueError):
    """A pointer was NULL, which is a defect of this package."""


class InvalidArgumentError(Error, ValueError):
    """A value is not allowed."""

    element = "position"


class ArgumentTypeError(InvalidArgumentError, TypeError):
    """An argument has the wrong type, or arguments do not go together."""


class LengthMismatchError(Error, ValueError):
    """Arrays that belong together differ in length."""


class IndexOutOfRangeError(Error, IndexError):
    """An index is negative or too large; `position` is its place in the array."""

    element = "position"


class NotFiniteError(Error, ValueError):
    """NaN or infinity; `index` is its place in the array, or the vertex of a mesh."""

    element = "position"


class EmptyError(Error, ValueError):
    """A problem without variables, a mesh without faces, or a soup of which repair leaves nothing."""


class CountOverflowError(Error, OverflowError):
    """A count or a sum is too large to be represented."""


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory for a large array."""


class UnknownOptionError(Error, TypeError):
    """No option and no keyword has this name."""


class OptionTypeError(Error, TypeError):
    """The option takes another type of value."""


class OptionRangeError(Error, ValueError):
    """The option does not take this value."""


class NotSupportedError(Error):
    """The library does not support this; in a file, `line` names the place."""


class ParseError(Error, ValueError):
    """A file violates its format, at `line` if it is a text."""


class IoError(Error):
    """A file cannot be read or written."""


class ProofRefusedError(Error, ValueError):
    """A proof does not hold, at `line`; the message says what is wrong."""


class InfeasibleError(Error):
    """The constraint, inequality or bound `row` contradicts others; the message says which it is."""

    element = "row"


class NoIntegerSolutionError(Error):
    """The constraint `row` has no solution in integers."""

    element = "row"


class UnboundedError(Error):
    """The objective decreases without limit along `direction`, which moves `variable`."""

    element = "variable"


class NotConvexError(Error):
    """The objective curves downwards along `direction`, which moves `variable`; in a file, `line` shows it."""

    element = "variable"


class NonManifoldEdgeError(Error, ValueError):
    """An edge has more than two faces; `face` is the lowest of them."""

    element = "face"


class NonManifoldVertexError(Error, ValueError):
    """The faces of `vertex` form more than one fan."""

    element = "vertex"


class InconsistentOrientationError(Error, ValueError):
    """`face` and another face run along their common edge in the same direction."""

    element = "face"


class ZeroAreaError(Error, ValueError):
    """`face` has no area."""

    element = "face"


class IsolatedVertexError(Error, ValueError):
    """No face uses `vertex`."""

    element = "vertex"


class NotATriangleError(Error, ValueError):
    """`face` does not have three corners."""

    element = "face"


class RepeatedVertexError(Error, ValueError):
    """`face` visits a vertex twice."""

    element = "face"


class CancelledError(Error):
    """Cancelled before a first solution was found."""


class TimeLimitError(Error):
    """The time limit passed before a first solution was found."""


class SearchLimitError(Error):
    """The option `nodes`, the budget of auto, or the precision of numbers ended the search before a first solution."""


class MissingPackageError(Error, ImportError):
    """A package that the call needs, such as pyvista, is not installed."""


class PanicError(Error):
    """A defect of the library was caught. The object that was used is no longer usable."""


class UnusableError(Error):
    """The object became unusable in an earlier PanicError."""


#: The exception of each status, by its number.
classes: dict[int, type[Error]] = {
    lib.ROUNDEL_ERROR_NULL_POINTER: NullPointerError,
    lib.ROUNDEL_ERROR_INVALID_ARGUMENT: InvalidArgumentError,
    lib.ROUNDEL_ERROR_LENGTH_MISMATCH: LengthMismatchError,
    lib.ROUNDEL_ERROR_INDEX_OUT_OF_RANGE: IndexOutOfRangeError,
    lib.ROUNDEL_ERROR_NOT_FINITE: NotFiniteError,
    lib.ROUNDEL_ERROR_EMPTY: EmptyError,
    lib.ROUNDEL_ERROR_OVERFLOW: CountOverflowError,
    lib.ROUNDEL_ERROR_OUT_OF_MEMORY: OutOfMemoryError,
    lib.ROUNDEL_ERROR_UNKNOWN_OPTION: UnknownOptionError,
    lib.ROUNDEL_ERROR_OPTION_TYPE: OptionTypeError,
    lib.ROUNDEL_ERROR_OPTION_RANGE: OptionRangeError,
    lib.ROUNDEL_ERROR_NOT_SUPPORTED: NotSupportedError,
    lib.ROUNDEL_ERROR_PARSE: ParseError,
    lib.ROUNDEL_ERROR_IO: IoError,
    lib.ROUNDEL_ERROR_PROOF_REFUSED: ProofRefusedError,
    lib.ROUNDEL_ERROR_INFEASIBLE: InfeasibleError,
    lib.ROUNDEL_ERROR_NO_INTEGER_SOLUTION: NoIntegerSolutionError,
    lib.ROUNDEL_ERROR_UNBOUNDED: UnboundedError,
    lib.ROUNDEL_ERROR_NOT_CONVEX: NotConvexError,
    lib.ROUNDEL_ERROR_NON_MANIFOLD_EDGE: NonManifoldEdgeError,
    lib.ROUNDEL_ERROR_NON_MANIFOLD_VERTEX: NonManifoldVertexError,
    lib.ROUNDEL_ERROR_INCONSISTENT_ORIENTATION: InconsistentOrientationError,
    lib.ROUNDEL_ERROR_ZERO_AREA: ZeroAreaError,
    lib.ROUNDEL_ERROR_ISOLATED_VERTEX: IsolatedVertexError,
    lib.ROUNDEL_ERROR_NOT_A_TRIANGLE: NotATriangleError,
    lib.ROUNDEL_ERROR_REPEATED_VERTEX: RepeatedVertexError,
    lib.ROUNDEL_ERROR_CANCELLED: CancelledError,
    lib.ROUNDEL_ERROR_TIME_LIMIT: TimeLimitError,
    lib.ROUNDEL_ERROR_SEARCH_LIMIT: SearchLimitError,
    lib.ROUNDEL_ERROR_PANIC: PanicError,
    lib.ROUNDEL_ERROR_UNUSABLE: UnusableError,
}


def check(status: int, variables: int = 0) -> None:
    """Raises the exception of a failed call. `variables` is the length of its direction, if any."""
    if status == lib.ROUNDEL_OK:
        return
    index, line = lib.roundel_last_error_index(), lib.roundel_last_error_line()
    message = last_message()
    direction = _direction(variables) if classes.get(status, Error).element == "variable" else None
    raise classes.get(status, Error)(
        message,
        text(lib.roundel_status_name(status)),
        status,
        None if index < 0 else index,
        None if line < 0 else line,
        direction,
    )


_STATUSES = {kind: status for status, kind in classes.items()}


def refusal(kind: type[Error], message: str, index: Optional[int] = None) -> Error:
    """The exception of an argument that this package refuses before the library sees it."""
    of = next((of for of in kind.__mro__ if of in _STATUSES), None)
    status = 0 if of is None else _STATUSES[of]
    return kind(message, text(lib.roundel_status_name(status)) if of else "", status, index)


def did_you_mean(word: str, words: Iterable[str]) -> str:
    """A question that names the nearest of the words, or nothing where none is near."""
    known = [other for other in words if other != word]
    near = get_close_matches(word, known, 1) or [other for other in known if other.startswith(word)]
    return f"did you mean {near[0]!r}?" if near else ""


def _direction(variables: int) -> Any:
    import numpy as np

    found = np.empty(variables)
    status = lib.roundel_last_error_direction(ffi.from_buffer("double[]", found), variables)
    return found if status == lib.ROUNDEL_OK else None


