"""The notebooks of the gallery run, and are committed without outputs."""

import json
import os
from pathlib import Path

import pytest

import roundel

GALLERY = Path(__file__).resolve().parents[1] / "gallery"
NOTEBOOKS = sorted(GALLERY.glob("*.ipynb"))
#: What a notebook needs beside a kernel.
NEEDS = {"batch": ("dask.bag",)}


def test_the_gallery_has_its_five_notebooks():
    assert {path.stem for path in NOTEBOOKS} == {"field", "map", "quads", "solver", "batch"}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_and_has_no_outputs(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    assert path.stat().st_size < 10_000
    for cell in cells:
        assert not cell.get("outputs") and cell.get("execution_count") is None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, monkeypatch):
    for package in ("ipykernel", "matplotlib", *NEEDS.get(path.stem, ())):
        pytest.importorskip(package, reason=f"the notebooks need {package}")
    nbclient = pytest.importorskip("nbclient", reason="the notebooks are run by nbclient")
    nbformat = pytest.importorskip("nbformat", reason="the notebooks are read by nbformat")
    # The kernel is a process of its own, and takes the package that is tested here.
    ways = (str(Path(roundel.__file__).parents[1]), os.environ.get("PYTHONPATH"))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(way for way in ways if way))
    book = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(book, timeout=300, resources={"metadata": {"path": str(GALLERY)}})
    client.execute()
    kinds = [output.output_type for cell in book.cells for output in cell.get("outputs", ())]
    assert kinds and "error" not in kinds
    pictures = sum("image/png" in output.get("data", {}) for cell in book.cells for output in cell.get("outputs", ()))
    assert pictures == sum(".plot(" in cell.source for cell in book.cells if cell.cell_type == "code")
