"""Objects of the library, and the numbers that its calls give."""

from __future__ import annotations

from typing import Any

from ._library import ffi, lib
from .errors import check


class Handle:
    """An object of the library, freed with this one."""

    def __init__(self, kind: str, pointer: Any) -> None:
        self.pointer = ffi.gc(pointer, getattr(lib, f"{kind}_free"))

    @classmethod
    def made(cls, kind: str, call: Any, *arguments: Any) -> Handle:
        """The object that `call(*arguments, &object)` makes."""
        place = ffi.new(f"{kind} **")
        check(call(*arguments, place))
        return cls(kind, place[0])

    @classmethod
    def lent(cls, pointer: Any) -> Handle:
        """An object that the library frees."""
        handle = cls.__new__(cls)
        handle.pointer = pointer
        return handle


def number(call: Any, *arguments: Any, kind: str = "size_t") -> Any:
    """The number that `call(*arguments, &number)` gives."""
    place = ffi.new(f"{kind} *")
    check(call(*arguments, place))
    return place[0]
