"""Writes `roundel/__init__.pyi`: the signatures of everything public, as the running package has them.

    python bindings/python/build_stubs.py

Signatures of functions with options come from the library's tables, which type checkers and editors cannot
read. `tests/test_stubs.py` holds the committed file to the package.
"""

import enum
import inspect
from pathlib import Path

STUB = Path(__file__).resolve().parent / "src" / "roundel" / "__init__.pyi"

HEAD = '''\
# Written by build_stubs.py from the running package: see there.

from enum import IntEnum
from typing import Any, Iterable, Iterator, Literal, Mapping, Optional, Sequence, Union

import numpy as np

from ._types import ArrayLike as ArrayLike, File as File, MatrixLike as MatrixLike, MeshLike as MeshLike
from ._types import Strategy as Strategy
from .errors import *
from .errors import classes as classes
from .events import Event as Event, Progress as Progress
from .lazy_rows import Candidate as Candidate, LazyRows as LazyRows
from .options import Option as Option

__version__: str
'''
#: What the head imports: the bodies of these tell their types themselves.
ELSEWHERE = ("Candidate", "Event", "Option")


def stub():
    """The text of the stub."""
    import roundel

    names = [name for name in (*roundel.__all__, "map") if not hasattr(roundel.errors, name)]
    things = [(name, getattr(roundel, name)) for name in sorted(set(names) - set(ELSEWHERE))]
    parts = [HEAD]
    parts += [_class(name, thing) for name, thing in things if isinstance(thing, type)]
    parts += [_function(name, thing) for name, thing in things if not isinstance(thing, type)]
    listed = "\n".join(f"    {name!r}," for name in sorted(roundel.__all__)).replace("'", '"')
    parts.append(f"__all__ = [\n{listed}\n]\n")
    return "\n".join(parts)


def _class(name, thing):
    if issubclass(thing, enum.Enum):
        members = [f"    {member.name} = {member.value}" for member in thing]
        return "\n".join([f"class {name}(IntEnum):", *members]) + "\n"
    base = "(KeyboardInterrupt)" if issubclass(thing, KeyboardInterrupt) else ""
    lines = [f"class {name}{base}:"]
    lines += [f"    {field}: {_text(of)}" for field, of in thing.__dict__.get("__annotations__", {}).items()]
    lines += [f"    {attribute}: {of}" for attribute, of in _ATTRIBUTES.get(name, {}).items()]
    for member, value in vars(thing).items():
        if member in ("__iter__", "__len__") or not member.startswith("_") or _for_callers(member, value):
            lines += _member(member, value)
    return "\n".join(lines) + "\n"


def _for_callers(member, value):
    """Whether this is a constructor for callers: results are made by functions, from handles."""
    if member != "__init__":
        return False
    shown = [p for p in inspect.signature(value).parameters.values() if not p.name.startswith("_")]
    return all("Handle" not in str(parameter.annotation) for parameter in shown)


#: What `__init__` sets.
_ATTRIBUTES = {
    "Field": {"mesh": "Mesh"},
    "GeodesicDistance": {"mesh": "Mesh"},
    "Map": {"field": "Field"},
    "Interrupted": {"incumbent": "Any"},
}


def _member(name, value):
    if isinstance(value, property):
        given_back = _text(inspect.signature(value.fget).return_annotation)
        return ["    @property", f"    def {name}(self) -> {given_back}: ..."]
    if isinstance(value, classmethod):
        return ["    @classmethod", *_function(name, value.__func__, "    ").splitlines()]
    return _function(name, value, "    ").splitlines() if inspect.isfunction(value) else []


def _function(name, thing, indent=""):
    signature = inspect.signature(thing)
    pieces, star = [], False
    for parameter in signature.parameters.values():
        if parameter.name.startswith("_"):
            continue
        if parameter.kind is parameter.KEYWORD_ONLY and not star:
            star = True
            pieces.append("*")
        pieces.append(_parameter(parameter))
    head = f"{indent}def {name}({', '.join(pieces)}) -> {_text(signature.return_annotation)}: ..."
    if len(head) > 110:
        inner = "".join(f"{indent}    {piece},\n" for piece in pieces)
        head = f"{indent}def {name}(\n{inner}{indent}) -> {_text(signature.return_annotation)}: ..."
    return head + "\n"


def _parameter(parameter):
    if parameter.annotation is parameter.empty:
        return parameter.name
    default = parameter.default
    if default is parameter.empty:
        return f"{parameter.name}: {_text(parameter.annotation)}"
    # A literal as far as there is one: infinity has none.
    shown = "..." if isinstance(default, dict) or default in (float("inf"), -float("inf")) else repr(default).replace("'", '"')
    return f"{parameter.name}: {_text(parameter.annotation)} = {shown}"


def _text(annotation):
    if annotation is inspect.Signature.empty:
        return "None"
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", repr(annotation))
    return str(text).replace("'", '"')


if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
