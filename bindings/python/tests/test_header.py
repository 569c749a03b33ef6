"""A plain FFI parser reads the whole C header."""

import sys
from pathlib import Path

import cffi

BINDINGS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(BINDINGS))
from build_header import declarations  # noqa: E402

SYMBOLS = (BINDINGS.parents[1] / "tests" / "symbols.txt").read_text().split()


def parsed():
    ffi = cffi.FFI()
    ffi.cdef(declarations())
    return ffi


def test_every_exported_symbol_is_declared_and_found_in_the_library():
    import roundel._library

    library = parsed().dlopen(str(next(Path(roundel.__file__).parent.glob("*roundel.*[so|lib|dll]"))))
    for symbol in SYMBOLS:
        assert getattr(library, symbol), symbol


def test_structs_have_the_sizes_that_the_layout_promises():
    ffi = parsed()
    sizes = {"option": 64, "preset": 64, "counts": 128, "seconds": 128, "event": 80, "monitor": 32}
    assert {name: ffi.sizeof(f"roundel_{name}") for name in sizes} == sizes


def test_the_package_was_built_from_this_header():
    from roundel._declarations import ffi

    fresh = parsed()
    enums = ("status", "solve_status", "stopped_by", "event_kind", "phase", "stage", "flow", "edit_kind")
    for name in (f"roundel_{enum}" for enum in enums):
        assert ffi.typeof(f"enum {name}").relements == fresh.typeof(f"enum {name}").relements
