"""Converts arrays and matrices for C, without a copy if their types are right."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._library import ffi
from .errors import ArgumentTypeError, CountOverflowError, InvalidArgumentError, LengthMismatchError, refusal


def real(value: Any, what: str) -> float:
    """A number for C."""
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise refusal(ArgumentTypeError, f"{what}: {value!r} is not a number") from error


def whole(value: Any, what: str, least: int = -(2**31), most: int = 2**31 - 1) -> int:
    """A whole number for C, which takes those from `least` to `most`."""
    if not hasattr(value, "__index__"):
        raise refusal(ArgumentTypeError, f"{what}: {value!r} is not a whole number")
    found: int = value.__index__()
    if not least <= found <= most:
        raise refusal(CountOverflowError, f"{what}: {found} is not in {least}..{most}")
    return found


def count(value: Any, what: str) -> int:
    """A number of things for C, from 0 on."""
    found = whole(value, what, -(2**63), 2**63 - 1)
    if found < 0:
        raise refusal(InvalidArgumentError, f"{what}: {found} is negative")
    return found


def reals(values: Any, what: str, shape: tuple[int, ...] = (-1,)) -> np.ndarray:
    """Doubles in C's order; -1 in `shape` takes any length."""
    try:
        found = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise refusal(ArgumentTypeError, f"{what}: {error}") from error
    _fits(found, what, shape)
    return found


def indices(values: Any, what: str, shape: tuple[int, ...] = (-1,)) -> np.ndarray:
    """Indices of 32 or 64 bits in C's order. Fractions and booleans are refused."""
    try:
        found = np.asarray(values)
    except (TypeError, ValueError) as error:
        raise refusal(ArgumentTypeError, f"{what}: {error}") from error
    if found.size == 0:
        found = found.astype(np.int32)
    if found.dtype.kind not in "iu":
        raise refusal(ArgumentTypeError, f"{what}: indices must be whole numbers, not {found.dtype}")
    if found.dtype == np.uint64 and found.max() > np.iinfo(np.int64).max:
        raise refusal(CountOverflowError, f"{what}: an index is beyond 64 bits")
    fits = found.dtype in (np.int32, np.int64)
    wide = found.dtype.itemsize > 4 or found.dtype == np.uint32
    found = np.ascontiguousarray(found, None if fits else np.int64 if wide else np.int32)
    _fits(found, what, shape)
    return found


def indices32(values: Any, what: str, shape: tuple[int, ...] = (-1,)) -> np.ndarray:
    """Indices for a function that has no 64-bit version."""
    found = indices(values, what, shape)
    if found.dtype == np.int64:
        if found.size and (found.max() > 2**31 - 1 or found.min() < -(2**31)):
            raise refusal(CountOverflowError, f"{what}: an index is beyond 32 bits")
        found = found.astype(np.int32)
    return found


def sides(lower: Any, upper: Any, length: int) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper limits: `length` numbers each, or one for all, or None for infinite ones."""
    return _limits(lower, "lower", length, -np.inf), _limits(upper, "upper", length, np.inf)


def _limits(values: Any, what: str, length: int, none: float) -> np.ndarray:
    if values is None or np.ndim(values) == 0:
        return np.full(length, none if values is None else real(values, what))
    return reals(values, what, (length,))


def _fits(found: np.ndarray, what: str, shape: tuple[int, ...]) -> None:
    fits = len(found.shape) == len(shape) and all(
        wanted in (-1, length) for wanted, length in zip(shape, found.shape)
    )
    if not fits:
        wanted = " x ".join("n" if k < 0 else str(k) for k in shape)
        raise refusal(LengthMismatchError, f"{what}: the shape is {found.shape}, and should be {wanted}")


_C_TYPES = {"float64": "double", "int32": "int32_t", "int64": "int64_t", "int8": "int8_t"}


def pointer(array: np.ndarray) -> Any:
    """The address of the numbers, which is valid as long as the array exists."""
    kind = _C_TYPES[array.dtype.name]
    return ffi.cast(f"{kind} *", array.ctypes.data) if array.size else ffi.NULL


@dataclass(frozen=True)
class Compressed:
    """A sparse matrix in compressed rows or columns."""

    #: "csr" or "csc".
    form: str
    shape: tuple[int, int]
    offsets: np.ndarray
    indices: np.ndarray
    values: np.ndarray

    @property
    def twin(self) -> str:
        """The end of the name of the C function that takes these indices."""
        return "_i64" if self.indices.dtype == np.int64 else ""

    def arguments(self) -> tuple[Any, ...]:
        """Offsets, indices and values, as the functions of the C interface take them."""
        return (
            len(self.offsets),
            pointer(self.offsets),
            len(self.indices),
            pointer(self.indices),
            pointer(self.values),
        )


def compressed(matrix: Any, what: str) -> Compressed:
    """The matrix in compressed form. A compressed SciPy matrix is not copied, any other is converted."""
    if isinstance(matrix, Compressed):
        return matrix
    form = getattr(matrix, "format", "")
    if form and form not in ("csr", "csc"):
        matrix = matrix.asformat("csr")
        form = matrix.format
    if not form:
        return _dense(matrix, what)
    values = reals(matrix.data, what)
    offsets, inner = indices(matrix.indptr, what), indices(matrix.indices, what)
    if offsets.dtype != inner.dtype:
        offsets, inner = offsets.astype(np.int64), inner.astype(np.int64)
    return Compressed(form, matrix.shape, offsets, inner, values)


def _dense(matrix: Any, what: str) -> Compressed:
    dense = reals(matrix, what, (-1, -1))
    rows, columns = np.nonzero(dense)
    offsets = np.zeros(dense.shape[0] + 1, dtype=np.int64)
    np.cumsum(np.bincount(rows, minlength=dense.shape[0]), out=offsets[1:])
    return Compressed("csr", dense.shape, offsets, columns.astype(np.int64), dense[rows, columns])
