"""Options by name, from the library's own table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Union

from ._handle import Handle
from ._library import ffi, lib, text
from .errors import check


@dataclass(frozen=True)
class Option:
    """One option of the solver."""

    name: str
    #: int, float or str.
    type: type
    default: Union[int, float, str]
    #: The allowed values: an interval, or words separated by bars.
    range: str
    #: Its description.
    text: str


_TYPES = {lib.ROUNDEL_OPTION_INT: int, lib.ROUNDEL_OPTION_REAL: float, lib.ROUNDEL_OPTION_TEXT: str}


def options() -> dict[str, Option]:
    """Every option that `solve` and the other functions take as a keyword, by name.

    >>> import roundel
    >>> roundel.options()["strategy"].default
    'auto'
    """
    found = {}
    info = ffi.new("roundel_option *")
    for index in range(lib.roundel_option_count()):
        check(lib.roundel_option_info(index, info))
        kind = _TYPES[info.value_type]
        name = text(info.name)
        found[name] = Option(name, kind, kind(text(info.default_value)), text(info.range), text(info.text))
    return found


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
            check(_set(handle.pointer, name.encode(), value))
    return handle


def _set(pointer: Any, name: bytes, value: Any) -> int:
    if isinstance(value, str):
        return lib.roundel_options_set_text(pointer, name, value.encode())
    if hasattr(value, "__index__"):
        return lib.roundel_options_set_int(pointer, name, value.__index__())
    return lib.roundel_options_set_real(pointer, name, float(value))
