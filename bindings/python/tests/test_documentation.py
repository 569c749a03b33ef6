"""Runs every example in the documentation."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import roundel

ROOT = Path(__file__).resolve().parents[3]
FOUND = (module.name for module in pkgutil.iter_modules(roundel.__path__))
MODULES = sorted(name for name in FOUND if "lib" not in name and name != "_declarations")


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_the_documentation(name):
    assert doctest.testmod(importlib.import_module(f"roundel.{name}")).failed == 0


def test_every_public_function_has_an_example():
    functions = "solve Problem Solver field map quad extract Soup repair options presets"
    for name in functions.split():
        assert ">>>" in getattr(roundel, name).__doc__, name


def test_everything_public_is_documented():
    for name in roundel.__all__:
        thing = getattr(roundel, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"


PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), ROOT / "bindings/python/README.md"]
#: A block of Python, and what the page says that it prints.
BLOCK = re.compile(r"^```python\n(.*?)^```$(?:\n\nprints\n\n```text\n(.*?)^```$)?", re.DOTALL | re.MULTILINE)
BLOCKS = [
    pytest.param(*found.groups(), id=f"{page.stem}-{number}")
    for page in PAGES
    for number, found in enumerate(BLOCK.finditer(page.read_text(encoding="utf-8")))
]


@pytest.mark.parametrize("code, prints", BLOCKS)
def test_the_examples_of_the_book(code, prints, tmp_path, monkeypatch, capsys):
    if "import pymeshlab" in code:
        pytest.importorskip("pymeshlab")
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "<example>", "exec"), {})
    printed = capsys.readouterr().out
    assert prints is None or printed == prints


def test_the_book_has_examples():
    assert len(BLOCKS) > 8


def test_the_package_is_marked_as_typed():
    assert (Path(roundel.__file__).parent / "py.typed").exists()
