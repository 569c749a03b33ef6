"""A census on several machines, as the book shows it: parts that are killed lose nothing, and do nothing twice."""

import collections
import json
import os
import pathlib
import re
import signal
import subprocess
import time

import pytest

PROGRAM = os.environ.get("ROUNDEL_PROGRAM")
PAGE = pathlib.Path(__file__).parents[3] / "docs/census.md"
COUNT = 12

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="ROUNDEL_PROGRAM does not name the program")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with meshes, in which `roundel` is a command."""
    (tmp_path / "meshes").mkdir()
    for k in range(COUNT):
        file = tmp_path / f"meshes/torus{k:02}.obj"
        subprocess.run([PROGRAM, "shape", "torus", "--triangles", str(1500 + 100 * k), "-o", file], check=True)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/roundel").symlink_to(PROGRAM)
    monkeypatch.setenv("PATH", str(tmp_path / "bin") + os.pathsep + os.environ.get("PATH", ""))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def rows(folder, files):
    """How often each mesh has a row. A line without an end is not whole."""
    found = collections.Counter()
    for file in folder.glob(files):
        for line in file.read_text().splitlines(keepends=True):
            if not line.endswith("\n"):
                continue
            row = json.loads(line)
            assert row["outcome"] == "quads", row
            found[row["name"]] += 1
    return found


def wait_for(condition):
    started = time.monotonic()
    while not condition():
        assert time.monotonic() - started < 120
        time.sleep(0.02)


def collected(folder):
    """The lines that a census of the whole prints for meshes that it runs itself."""
    told = subprocess.run(["roundel", "census", "meshes", "-o", "census.html"], check=True, capture_output=True, text=True)
    names = {f"torus{k:02}.obj" for k in range(COUNT)}
    assert rows(folder, "census.jsonl") == dict.fromkeys(names, 1)
    assert set(re.findall(r"<td>(torus\d+\.obj)</td>", (folder / "census.html").read_text())) == names
    return [line for line in told.stdout.splitlines() if re.match(r" *\d+/", line)]


def test_a_worker_of_dask_that_dies_loses_nothing(folder):
    distributed = pytest.importorskip("distributed")
    code = re.search(r"```text\n(import subprocess\n.*?)\nif __name__", PAGE.read_text(), re.DOTALL).group(1)
    names = {"__name__": "of_the_book"}
    exec(code, names)
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = list(client.run(os.getpid).values())
        assert len(workers) == 2
        parts = [client.submit(names["part"], k, 4, pure=False) for k in range(1, 5)]
        wait_for(lambda: sum(rows(folder, "census.*-of-4.jsonl").values()) > 0)
        os.kill(workers[0], signal.SIGKILL)
        client.gather(parts)
    assert set(rows(folder, "census.*-of-4.jsonl")) == {f"torus{k:02}.obj" for k in range(COUNT)}
    assert collected(folder) == []


def test_a_task_of_an_array_that_is_killed_is_made_up_for(folder):
    words = ["roundel", "census", "meshes", "-o", "census.html", "--quiet", "--part"]
    tasks = [subprocess.Popen([*words, f"{k}/2"], stdout=subprocess.DEVNULL) for k in (1, 2)]
    wait_for(lambda: len(rows(folder, "census.1-of-2.jsonl")) > 0)
    tasks[0].kill()
    assert tasks[1].wait() == 0
    tasks[0].wait()
    kept = rows(folder, "census.*-of-2.jsonl")
    assert 6 < len(kept) < COUNT and set(kept.values()) == {1}
    assert len(collected(folder)) == COUNT - len(kept)
