"""Options by name, from the library's own table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Union

import numpy as np

from ._handle import Handle
from ._library import ffi, lib, text
from .errors import OptionRangeError, OptionTypeError, UnknownOptionError, check, did_you_mean, refusal


@dataclass(frozen=True)
class Option:
    """One option of the library.

    >>> import roundel
    >>> roundel.options()["gap"].type
    <class 'float'>

    Attributes:

      name: str
          Its name, which is that of the keyword.
      type: type
          int, float or str.
      default: Union[int, float, str, None]
          None where it has none.
      range: str
          The values allowed: an interval, or words with a bar between them.
      text: str
          Its description.
    """

    name: str
    type: type
    default: Union[int, float, str, None]
    range: str
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
    preset = given.get("preset")
    if preset is not None:
        try:
            check(lib.roundel_options_set_preset(handle.pointer, str(preset).encode()))
        except OptionRangeError as error:
            raise _nearer(error, str(preset), presets()) from None
    for name, value in given.items():
        if name != "preset" and value is not None:
            set_option(handle.pointer, "options", name, value)
    return handle


#: The tables of the handles' options.
_TABLES = {
    "options": options(),
    "guidance": guidance_options(),
    "quad_options": quad_options(),
    "repair_options": repair_options(),
}


def set_option(pointer: Any, kind: str, name: str, value: Any) -> None:
    """Sets an option of a handle, `roundel_<kind>`, by the type of the value."""
    given: Any
    try:
        if isinstance(value, str):
            setter, given = "text", value.encode()
        elif isinstance(value, np.bool_):
            setter, given = "int", int(value)
        elif hasattr(value, "__index__"):
            setter, given = "int", value.__index__()
        else:
            setter, given = "real", float(value)
    except (TypeError, ValueError) as error:
        raise refusal(OptionTypeError, f"option {name}: {value!r} is not a number") from error
    try:
        check(getattr(lib, f"roundel_{kind}_set_{setter}")(pointer, name.encode(), given))
    except OverflowError as error:
        raise refusal(OptionRangeError, f"option {name}: {value!r} is beyond 64 bits") from error
    except UnknownOptionError as error:
        raise _nearer(error, name, _TABLES[kind]) from None
    except OptionRangeError as error:
        words = _TABLES[kind][name].range.split("|")
        raise _nearer(error, str(value), words if len(words) > 1 else ()) from None


def _nearer(error: Any, word: str, words: Any) -> Any:
    """The same error; if one of the words is near the word, the message asks whether it was meant."""
    question = did_you_mean(word, words)
    if question:
        error.args = (f"{error}; {question}",)
    return error
