"""The stubs, which editors and type checkers read, are the signatures of the running package."""

import ast
import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest

import roundel

BINDINGS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(BINDINGS))
from build_stubs import STUB, stub  # noqa: E402

TREE = ast.parse(STUB.read_text(encoding="utf-8"))
CLASSES = [node for node in TREE.body if isinstance(node, ast.ClassDef)]
FUNCTIONS = [("", node) for node in TREE.body if isinstance(node, ast.FunctionDef)]
METHODS = [(of.name, node) for of in CLASSES for node in of.body if isinstance(node, ast.FunctionDef)]


def test_the_committed_stubs_are_those_that_would_be_written():
    if os.environ.get("ROUNDEL_BLESS") == "1":
        STUB.write_text(stub(), encoding="utf-8")
    assert STUB.read_text(encoding="utf-8") == stub(), "python bindings/python/build_stubs.py writes them anew"


@pytest.mark.parametrize("of, node", FUNCTIONS + METHODS, ids=lambda part: getattr(part, "name", part))
def test_a_stub_has_the_signature_that_inspect_sees(of, node):
    thing = inspect.getattr_static(getattr(roundel, of), node.name) if of else getattr(roundel, node.name)
    if isinstance(thing, property):
        thing = thing.fget
    seen = inspect.signature(getattr(thing, "__func__", thing)).parameters
    public = {name: parameter for name, parameter in seen.items() if not name.startswith("_")}
    positional, named = node.args.args, node.args.kwonlyargs
    assert [arg.arg for arg in (*positional, *named)] == list(public)
    kinds = {p.name: p.kind is p.KEYWORD_ONLY for p in public.values()}
    assert {arg.arg for arg in named} == {name for name, alone in kinds.items() if alone}
    defaults = dict(zip([arg.arg for arg in positional][::-1], node.args.defaults[::-1]))
    defaults.update((arg.arg, value) for arg, value in zip(named, node.args.kw_defaults) if value)
    assert set(defaults) == {p.name for p in public.values() if p.default is not p.empty}
    for name, value in defaults.items():
        told = ast.literal_eval(value)
        assert told is ... or told == public[name].default, name


def test_everything_public_has_a_stub():
    told = {node.name for node in TREE.body if hasattr(node, "name")} | {"Candidate", "Event", "Option"}
    assert told >= {name for name in roundel.__all__ if not hasattr(roundel.errors, name)} | {"map"}
    for of in CLASSES:
        here = {node.name for node in of.body if isinstance(node, ast.FunctionDef)}
        public = {name for name in vars(getattr(roundel, of.name)) if not name.startswith("_")}
        assert public - here <= {node.target.id for node in of.body if isinstance(node, ast.AnnAssign)} | {
            target.id for node in of.body if isinstance(node, ast.Assign) for target in node.targets
        }, of.name


CLIENT = """
import roundel

quads = roundel.quad("part.stl", quads=2000, features=40.0, strategy="exact")
vertices, faces = quads
fine: int = len(faces) + quads.irregular_count
found: roundel.Solution = roundel.solve([[1.0]], integers=[0], progress=lambda event: event.energy < 3)
field: roundel.Field = roundel.field(vertices, faces, symmetry=6)
try:
    roundel.map(field).solve(edge_length=0.5)
except roundel.NonManifoldEdgeError as error:
    line = error.face
roundel.quad("part.stl", featurs=40.0)  # wrong
roundel.quad("part.stl", strategy="best")  # wrong
roundel.field("part.stl", symmetry=3)  # wrong
roundel.quad("part.stl").irregular  # wrong
"""


def test_a_type_checker_finds_what_is_wrong_and_nothing_else(tmp_path):
    pytest.importorskip("mypy")
    client = tmp_path / "client.py"
    client.write_text(CLIENT)
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", str(tmp_path / "cache")]
    # mypy finds what is installed by itself, and refuses to be told of it.
    place = Path(roundel.__file__).parents[1]
    environment = {**os.environ, "MYPYPATH": "" if place.name == "site-packages" else str(place)}
    done = subprocess.run([*command, str(client)], capture_output=True, text=True, env=environment, cwd=tmp_path)
    found = {int(line.split(":")[1]) for line in done.stdout.splitlines() if "client.py:" in line and "error" in line}
    wrong = {number for number, line in enumerate(CLIENT.splitlines(), 1) if line.endswith("# wrong")}
    assert found == wrong, done.stdout + done.stderr
