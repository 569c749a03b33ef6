"""Loads the shared library beside this file, and helps to call its functions."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

from . import _declarations  # type: ignore[attr-defined]

ffi: Any = _declarations.ffi
_NAMES = {"darwin": "libroundel.dylib", "win32": "roundel.dll"}
lib: Any = ffi.dlopen(str(Path(__file__).parent / _NAMES.get(sys.platform, "libroundel.so")))

if lib.roundel_abi_version() != lib.ROUNDEL_ABI_VERSION:
    raise ImportError(
        f"the library has ABI {lib.roundel_abi_version()}, the package {lib.ROUNDEL_ABI_VERSION}"
    )


def text(pointer: Any) -> str:
    """A text that the library owns."""
    return ffi.string(pointer).decode()


def path(file: Any) -> bytes:
    """The name of a file in the encoding that C expects."""
    return os.fsencode(file)


def last_message() -> str:
    """The message of the last call that failed on this thread."""
    length = lib.roundel_last_error_message(ffi.NULL, 0)
    buffer = ffi.new("char[]", length + 1)
    lib.roundel_last_error_message(buffer, length + 1)
    return ffi.string(buffer).decode(errors="replace")
