"""The examples run and print the expected output."""

import importlib.util
from pathlib import Path

import pytest

import roundel

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def load(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_meshes_in_parallel_give_the_same_quads_as_alone(tmp_path):
    pytest.importorskip("dask.bag")
    shapes = ["rounded-cube", "torus", str(tmp_path / "none.obj")]
    made = load("many_meshes").main([*shapes, "--quads", "200", "--out", str(tmp_path / "out")])
    for name, count, wrong in made[:2]:
        alone = roundel.quad(roundel.Mesh.shape(name, 2000), quads=200)
        alone.write(tmp_path / "alone.obj")
        assert wrong is None and count == len(alone)
        assert (tmp_path / "out" / f"{name}.obj").read_text() == (tmp_path / "alone.obj").read_text()
    assert made[2][2].startswith("io: ")


def test_a_cluster_of_processes_returns_solutions():
    distributed = pytest.importorskip("distributed")
    given = {"A": [[1.0, 0.0], [1.0, -1.0]], "integers": [1]}
    with distributed.Client(processes=True, n_workers=1, threads_per_worker=2, dashboard_address=None) as client:
        futures = [client.submit(roundel.solve, b=[0.4 + k, 0.0], **given) for k in range(8)]
        found = [solution.values[1] for solution in client.gather(futures)]
    assert found == list(range(8))
