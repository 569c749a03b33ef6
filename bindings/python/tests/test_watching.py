"""Progress, cancelling, Ctrl-C and Python's lock during a solve."""

import os
import signal
import sys
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
    shares = [event.share for event in heard]
    assert shares == sorted(shares) and 0.0 <= shares[0] and shares[-1] <= 1.0
    assert {"field", "map", "quads"} <= {event.stage for event in heard}


@pytest.mark.parametrize("with_tqdm", [True, False])
def test_the_line_of_progress_goes_to_stderr(cube, capfd, monkeypatch, with_tqdm):
    if with_tqdm:
        pytest.importorskip("tqdm")
    else:
        monkeypatch.setitem(sys.modules, "tqdm", None)
    roundel.quad(cube, quads=100, progress=True)
    out, err = capfd.readouterr()
    assert out == "" and " %" in err and err.endswith("\n")
    assert err.split("\r")[-1].startswith("done")
    assert ("[00:0" in err) == with_tqdm


def test_progress_tells_energies_and_gaps_that_mean_something():
    from roundel.progress import told

    def at(energy, bound, gap):
        return told(roundel.Event("progress", "round", 0.25, "", 1.0, energy, bound, gap, 0.5, "map"))

    assert at(np.inf, -np.inf, np.inf) == "map   50 %"
    assert at(8.0, 0.0, 1.0) == "map   50 %  energy 8"
    assert at(8.0, 6.0, 0.25) == "map   50 %  energy 8  gap 25.00 %"


def test_what_cannot_watch_is_refused(cube):
    for keywords in ({"progress": "yes"}, {"cancel": True}):
        with pytest.raises(roundel.ArgumentTypeError, match=next(iter(keywords))):
            roundel.field(cube, **keywords)


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


def press_ctrl_c():
    os.kill(os.getpid(), signal.SIGINT)


@pytest.mark.parametrize("silent", [True, False])
def test_ctrl_c_ends_the_solve_soon_and_keeps_the_best_solution(endless, interruptible, silent):
    timer = threading.Timer(0.5, press_ctrl_c)
    timer.start()
    started = time.monotonic()
    progress = None if silent else lambda event: None
    with pytest.raises(KeyboardInterrupt, match="the best so far is <Solution: cancelled") as caught:
        roundel.solve(**endless, strategy="exact", time_limit=60.0, progress=progress)
    timer.join()
    assert time.monotonic() - started < 10.0
    found = caught.value.incumbent
    assert isinstance(caught.value, roundel.Interrupted) and isinstance(found, roundel.Solution)
    assert found.stopped_by == "cancel" and found.integrality_violation == 0.0
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_ctrl_c_before_a_first_solution_has_no_incumbent(interruptible):
    def pressed(event):
        press_ctrl_c()

    with pytest.raises(roundel.Interrupted, match="nothing was found yet") as caught:
        roundel.solve(np.eye(2), progress=pressed)
    assert caught.value.incumbent is None


def test_a_solver_keeps_its_best_solution_too(endless, interruptible):
    problem = roundel.Problem(90)
    problem.least_squares_rows(endless["A"], endless["b"])
    problem.integer(endless["integers"])
    solver = roundel.Solver(problem)

    def pressed(event):
        if event.energy < np.inf:
            press_ctrl_c()

    with pytest.raises(roundel.Interrupted) as caught:
        solver.solve(strategy="exact", nodes=10**13, progress=pressed)
    assert caught.value.incumbent.status == "cancelled"


def test_ctrl_c_in_the_map_keeps_the_field(cube, interruptible):
    """Interrupted when the map's solve begins, which is the second that eliminates."""
    phases = []

    def pressed(event):
        if event.phase and phases[-1:] != [event.phase]:
            phases.append(event.phase)
            if phases.count("eliminate") == 2:
                press_ctrl_c()

    with pytest.raises(roundel.Interrupted) as caught:
        roundel.map(cube, quads=100, progress=pressed)
    found = caught.value.incumbent
    assert isinstance(found, roundel.Field) and roundel.map(found, quads=100).valid


def test_a_handler_of_the_caller_is_left_alone(endless, interruptible):
    def stops(*_):
        raise KeyboardInterrupt("mine")

    signal.signal(signal.SIGINT, stops)
    timer = threading.Timer(0.3, press_ctrl_c)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        roundel.solve(**endless, strategy="exact", time_limit=60.0)
    timer.join()
    assert caught.value.incumbent.status == "cancelled" and str(caught.value.__cause__) == "mine"
    assert signal.getsignal(signal.SIGINT) is stops


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
