"""Progress, cancelling, Ctrl-C and Python's lock during a solve."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import roundel


def test_events_report_progress_and_better_solutions(cube):
    heard = []
    roundel.quad(cube, quads=100, progress=heard.append)
    assert {"progress", "improved"} <= {event.kind for event in heard}
    assert {"eliminate", "factor", "quads"} <= {event.phase for event in heard}
    assert all(0.0 <= event.fraction <= 1.0 and event.seconds >= 0.0 for event in heard)


def test_the_line_of_progress_goes_to_stderr(cube, capfd):
    roundel.field(cube, progress=True)
    out, err = capfd.readouterr()
    assert out == "" and "%" in err and err.endswith("\n")


def test_a_callback_ends_the_solve_and_the_best_solution_is_kept(endless):
    found = roundel.solve(**endless, strategy="exact", progress=lambda event: event.energy < np.inf)
    assert found.status == "cancelled" and found.integrality_violation == 0.0
    assert found.stopped_by == "cancel" and not found.complete


def test_an_exception_of_a_callback_leaves_the_solve(endless):
    def fails(event):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        roundel.solve(**endless, strategy="exact", progress=fails)


def test_a_token_cancels_from_another_thread(endless):
    token = roundel.CancelToken()
    timer = threading.Timer(0.3, token.cancel)
    timer.start()
    found = roundel.solve(**endless, strategy="exact", time_limit=60.0, cancel=token)
    assert found.status == "cancelled"
    timer.join()


def test_a_token_set_before_the_solve_leaves_no_solution():
    token = roundel.CancelToken()
    token.cancel()
    with pytest.raises(roundel.CancelledError):
        roundel.solve(np.eye(2), cancel=token)
    token.reset()
    assert roundel.solve(np.eye(2), cancel=token).energy == 0.0


@pytest.fixture
def interruptible():
    """Restores Python's own SIGINT handler, because shells ignore SIGINT for background jobs."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("silent", [True, False])
def test_ctrl_c_ends_the_solve_soon(endless, interruptible, silent):
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    started = time.monotonic()
    progress = None if silent else lambda event: None
    with pytest.raises(KeyboardInterrupt):
        roundel.solve(**endless, strategy="exact", time_limit=60.0, progress=progress)
    timer.join()
    assert time.monotonic() - started < 10.0


def test_other_threads_run_while_one_solves(endless):
    """The solve releases Python's lock. If it held the lock, the other thread could not count."""
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    roundel.solve(**endless, strategy="exact", time_limit=1.0)
    during = counted[0] - before
    done.set()
    thread.join()
    assert during > 100_000


def test_two_threads_solve_at_once(endless):
    found = {}

    def solve(k):
        found[k] = roundel.solve(**endless, strategy="lattice").energy

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found[0] == found[1]
