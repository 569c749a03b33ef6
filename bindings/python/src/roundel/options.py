"""Options by name, from the library's own table."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Any, Callable, Mapping, Optional, TypeVar, Union

import numpy as np

from ._handle import Handle
from ._library import ffi, lib, text
from .errors import check

_Function = TypeVar("_Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class Option:
    """One option of the library."""

    name: str
    #: int, float or str.
    type: type
    #: None where it has none.
    default: Union[int, float, str, None]
    #: The values allowed: an interval, or words with a bar between them.
    range: str
    #: Its description.
    text: str


_TYPES = {lib.ROUNDEL_OPTION_INT: int, lib.ROUNDEL_OPTION_REAL: float, lib.ROUNDEL_OPTION_TEXT: str}


def _listed(kind: str) -> dict[str, Option]:
    found = {}
    info = ffi.new("roundel_option *")
    for index in range(getattr(lib, f"roundel_{kind}_count")()):
        check(getattr(lib, f"roundel_{kind}_info")(index, info))
        of, name, said = _TYPES[info.value_type], text(info.name), text(info.default_value)
        default = None if said == "unset" else of(said)
        found[name] = Option(name, of, default, text(info.range), text(info.text))
    return found


def options() -> dict[str, Option]:
    """Every option of a solve that `solve` and the others take as a keyword, by name.

    >>> import roundel
    >>> roundel.options()["strategy"].default
    'auto'
    """
    return _listed("option")


def guidance_options() -> dict[str, Option]:
    """Every option of the guidance that `field`, `map` and `quad` take as a keyword, by name.

    >>> import roundel
    >>> roundel.guidance_options()["symmetry"].range
    '1|2|4|6'
    """
    return _listed("guidance_option")


def quad_options() -> dict[str, Option]:
    """Every option of its own that `quad` takes as a keyword, by name.

    >>> import roundel
    >>> roundel.quad_options()["quads"].default
    1000
    """
    return _listed("quad_option")


def repair_options() -> dict[str, Option]:
    """Every option that `repair` takes as a keyword, by name.

    >>> import roundel
    >>> roundel.repair_options()["weld"].default
    0.0
    """
    return _listed("repair_option")


def with_options(*tables: Mapping[str, Option]) -> Callable[[_Function], _Function]:
    """Gives a function that takes any keyword the signature and the documentation of these."""

    def told(function: _Function) -> _Function:
        signature = inspect.signature(function)
        kept = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        lines = []
        for option in (option for table in tables for option in table.values()):
            of = Optional[option.type]
            kind = inspect.Parameter.KEYWORD_ONLY
            kept.append(inspect.Parameter(option.name, kind, default=None, annotation=of))
            lines.append(f"    {option.name}: {option.text}; {option.range}")
        function.__signature__ = signature.replace(parameters=kept)  # type: ignore[attr-defined]
        listed = "\n".join(lines)
        function.__doc__ = f"{(function.__doc__ or '').rstrip()}\n\n    Options, with their values:\n\n{listed}\n"
        return function

    return told


def presets() -> dict[str, str]:
    """Every value of the keyword `preset`, with its purpose.

    >>> import roundel
    >>> "parametrization" in roundel.presets()
    True
    """
    found = {}
    info = ffi.new("roundel_preset *")
    for index in range(lib.roundel_preset_count()):
        check(lib.roundel_preset_info(index, info))
        found[text(info.name)] = text(info.text)
    return found


def options_handle(given: Mapping[str, Any]) -> Handle:
    """The library's options for the keywords. A preset is applied before all others."""
    handle = Handle.made("roundel_options", lib.roundel_options_new)
    if "preset" in given:
        check(lib.roundel_options_set_preset(handle.pointer, str(given["preset"]).encode()))
    for name, value in given.items():
        if name != "preset":
            set_option(handle.pointer, "options", name, value)
    return handle


def set_option(pointer: Any, kind: str, name: str, value: Any) -> None:
    """Sets an option of a handle, `roundel_<kind>`, by the type of the value."""
    if isinstance(value, str):
        setter, given = "text", value.encode()
    elif isinstance(value, np.bool_):
        setter, given = "int", int(value)
    elif hasattr(value, "__index__"):
        setter, given = "int", value.__index__()
    else:
        setter, given = "real", float(value)
    check(getattr(lib, f"roundel_{kind}_set_{setter}")(pointer, name.encode(), given))
