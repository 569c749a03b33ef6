"""Solves of problems given in matrices and part by part, and repeated solves."""

import itertools
import pickle

import numpy as np
import pytest

import roundel
from roundel.arrays import compressed

scipy_sparse = pytest.importorskip("scipy.sparse")

Q = np.array([[4.0, -2.0], [-2.0, 2.0]])
q = np.array([-0.8, 0.0])


def random_problem(seed=3):
    draw = np.random.default_rng(seed)
    A = draw.standard_normal((9, 6)) * (draw.random((9, 6)) < 0.6) + np.eye(9, 6)
    C = np.array([[1.0, 1.0, 0.0, 0.0, 1.0, 0.0]])
    return {"A": A, "b": 3.0 * draw.standard_normal(9), "C": C, "d": [2.0], "integers": [0, 1, 4]}


def test_the_optimum_of_a_small_problem_agrees_with_enumeration():
    given = random_problem()
    found = roundel.solve(**given)
    tried = []
    for x0, x1 in itertools.product(range(-12, 13), repeat=2):
        fixed = [x0, x1, 2 - x0 - x1]
        left = np.delete(np.arange(6), given["integers"])
        rest = given["b"] - given["A"][:, given["integers"]] @ fixed
        tried.append(np.linalg.lstsq(given["A"][:, left], rest, rcond=None)[1][0])
    assert found.proved and found.gap <= 1e-12
    assert found.energy == pytest.approx(min(tried), rel=1e-9)
    assert found.values[[0, 1, 4]].sum() == 2.0


def test_rows_and_their_normal_equations_are_one_problem():
    given = random_problem()
    A, b = given.pop("A"), given.pop("b")
    by_rows = roundel.solve(A=A, b=b, **given)
    by_matrix = roundel.solve(2 * A.T @ A, -2 * A.T @ b, b @ b, **given)
    assert by_matrix.energy == pytest.approx(by_rows.energy, rel=1e-9)
    assert np.allclose(by_matrix.values, by_rows.values)


@pytest.mark.parametrize("form", ["csr", "csc", "coo", "bsr"])
@pytest.mark.parametrize("width", [np.int32, np.int64])
def test_every_form_of_a_sparse_matrix_gives_the_same_problem(form, width):
    given = random_problem()
    dense = roundel.solve(**given)
    for name in ("A", "C"):
        matrix = scipy_sparse.csr_matrix(given[name]).asformat(form)
        if form in ("csr", "csc"):
            matrix.indices, matrix.indptr = matrix.indices.astype(width), matrix.indptr.astype(width)
        given[name] = matrix
    assert np.array_equal(roundel.solve(**given).values, dense.values)
    sparse_q = scipy_sparse.csc_matrix(Q).asformat(form)
    assert np.array_equal(roundel.solve(sparse_q, q).values, roundel.solve(Q, q).values)


@pytest.mark.parametrize("form", ["csr", "csc"])
@pytest.mark.parametrize("width", [np.int32, np.int64])
def test_compressed_matrices_of_doubles_are_not_copied(form, width):
    matrix = scipy_sparse.random(50, 40, 0.1, format=form, random_state=1)
    matrix.indices, matrix.indptr = matrix.indices.astype(width), matrix.indptr.astype(width)
    taken = compressed(matrix, "C")
    assert np.shares_memory(taken.values, matrix.data)
    assert np.shares_memory(taken.indices, matrix.indices)
    assert np.shares_memory(taken.offsets, matrix.indptr)


def test_one_triangle_of_a_matrix_stands_for_both():
    whole = roundel.solve(Q, q, integers=[1]).values
    assert np.array_equal(roundel.solve(np.triu(Q), q, integers=[1], triangle="upper").values, whole)
    assert np.array_equal(roundel.solve(np.tril(Q), q, integers=[1], triangle="lower").values, whole)


def test_a_problem_built_in_parts_equals_one_given_at_once():
    given = random_problem()
    problem = roundel.Problem(6)
    for row, rhs in zip(given["A"], given["b"]):
        problem.least_squares(np.arange(6), row, rhs)
    assert problem.constrain([0, 1, 4], [1.0, 1.0, 1.0], 2.0) == 0
    problem.integer(np.isin(np.arange(6), given["integers"]))
    assert (problem.variables, problem.constraints) == (6, 1)
    assert np.allclose(roundel.solve(problem).values, roundel.solve(**given).values)
    assert np.allclose(roundel.solve(problem.copy()).values, roundel.solve(**given).values)


def test_pins_hold_and_guesses_determine_free_variables():
    found = roundel.solve(A=[[1.0, 1.0, 0.0]], b=[3.0], pins={0: 0.5}, guess=[9.0, 9.0, 9.0])
    assert np.allclose(found.values, [0.5, 2.5, 9.0])


def test_a_solver_gives_the_same_as_a_new_solve():
    given = random_problem()
    problem = roundel.Problem(6)
    problem.least_squares_rows(given["A"], given["b"])
    problem.constrain_rows(given["C"], given["d"])
    problem.integer(given["integers"])
    solver = roundel.Solver(problem)
    solver.solve()
    for sides, pinned in (([5.0], None), ([2.0], 1.0)):
        solver.set_constraint_right_sides(sides)
        given["d"] = sides
        if pinned is not None:
            solver.pin(0, pinned)
            given["pins"] = {0: pinned}
        again, anew = solver.solve(), roundel.solve(**given)
        assert again.energy == pytest.approx(anew.energy, rel=1e-12)
        assert np.allclose(again.values, anew.values)


def limited(row=((1.0, 2.0),), lower=None, upper=4.0, **more):
    """(x0 - 3)^2 + (x1 - 3)^2 under x0 + 2 x1 <= 4 with x0 an integer: x0 = 2 leaves x1 = 1."""
    given = {"A": np.eye(2), "b": [3.0, 3.0], "inequalities": (row, lower, upper), "integers": [0]}
    return roundel.solve(**given, **more)


@pytest.mark.parametrize("form", ["csr", "csc", "coo"])
@pytest.mark.parametrize("width", [np.int32, np.int64])
def test_inequalities_limit_a_problem_in_every_form_of_their_matrix(form, width):
    matrix = scipy_sparse.csr_matrix([[1.0, 2.0]]).asformat(form)
    if form in ("csr", "csc"):
        matrix.indices, matrix.indptr = matrix.indices.astype(width), matrix.indptr.astype(width)
    found = limited(matrix)
    assert np.allclose(found.values, [2.0, 1.0]) and found.proved
    assert found.energy == pytest.approx(5.0) and found.constraint_violation < 1e-9
    assert (found.counts["inequalities"], found.counts["constraints"]) == (1, 0)


def test_bounds_and_binaries_limit_a_problem():
    assert np.allclose(limited(bounds=(None, [1.0, np.inf])).values, [1.0, 1.5])
    # x1 >= 1.25 leaves x0 <= 1.5.
    assert np.allclose(limited(bounds=([-np.inf, 1.25], None)).values, [1.0, 1.5])
    assert np.allclose(limited(binaries=[0]).values, [1.0, 1.5])
    assert np.allclose(limited(lower=[-1.0], upper=[np.inf]).values, [3.0, 3.0])


def test_a_limited_problem_built_in_parts_equals_one_given_at_once():
    problem = roundel.Problem(2)
    problem.least_squares_rows(np.eye(2), [3.0, 3.0])
    assert problem.inequality([0, 1], [1.0, 2.0], upper=4.0) == 0
    assert problem.inequality_rows([[1.0, 0.0], [0.0, 1.0]], lower=[-9.0, -9.0]) == 1
    problem.bounds([True, False], upper=1.0)
    problem.integer([0])
    assert problem.inequalities == 3
    assert np.array_equal(problem.lower_bounds, [-np.inf, -np.inf])
    assert np.array_equal(problem.upper_bounds, [1.0, np.inf])
    assert np.allclose(roundel.solve(problem).values, [1.0, 1.5])
    problem.binary([1])
    assert np.array_equal(problem.upper_bounds, [1.0, 1.0])
    assert np.allclose(roundel.solve(problem).values, [1.0, 1.0])


def test_a_solver_changes_sides_and_bounds():
    problem = roundel.Problem(2)
    problem.least_squares_rows(np.eye(2), [3.0, 3.0])
    problem.inequality([0, 1], [1.0, 2.0], upper=4.0)
    problem.integer([0])
    solver = roundel.Solver(problem)
    assert np.allclose(solver.solve().values, [2.0, 1.0])
    solver.set_bounds([0], upper=[1.0])
    assert np.allclose(solver.solve().values, [1.0, 1.5])
    solver.set_inequality_sides(upper=3.0)
    assert np.allclose(solver.solve().values, [1.0, 1.0])
    with pytest.raises(roundel.LengthMismatchError):
        solver.set_inequality_sides(upper=[1.0, 2.0])
    solver.set_inequality_sides(lower=9.0)
    solver.set_bounds([1], upper=1.0)
    with pytest.raises(roundel.InfeasibleError, match="no solution"):
        solver.solve()


def test_limits_that_no_number_meets_are_refused():
    with pytest.raises(roundel.InvalidArgumentError, match="entry 1 has the lower limit 2 above") as caught:
        limited(bounds=([0.0, 2.0], 1.0))
    assert caught.value.position == 1
    with pytest.raises(roundel.InvalidArgumentError, match="NaN"):
        limited(upper=np.nan)
    with pytest.raises(roundel.ArgumentTypeError, match="bounds: there must be lower and upper"):
        limited(bounds=1.0)
    with pytest.raises(roundel.ArgumentTypeError, match="inequalities: there must be a matrix"):
        roundel.solve(Q, inequalities=([[1.0, 1.0]], 1.0))
    with pytest.raises(roundel.LengthMismatchError, match="3 columns for 2 variables"):
        limited(np.ones((1, 3)))
    with pytest.raises(roundel.LengthMismatchError, match="upper"):
        limited(upper=[1.0, 2.0])
    with pytest.raises(roundel.ArgumentTypeError, match="a problem stands for all"):
        roundel.solve(roundel.Problem(2), bounds=(0.0, 1.0))


def crowd(n):
    """Integers that want to be 0.4, 0.5, 0.6, ..."""
    problem = roundel.Problem(n)
    problem.least_squares_rows(np.eye(n), 0.4 + 0.1 * np.arange(n))
    problem.integer(range(n))
    return problem


def test_rows_come_during_a_solve():
    n, seen = 6, []

    def apart(candidate, rows):
        seen.append(candidate.is_integer)
        for i in np.flatnonzero(np.diff(candidate.values) < 1 - 1e-9):
            rows.inequality([i, i + 1], [-1.0, 1.0], lower=1.0)

    found = roundel.solve(crowd(n), lazy_rows=apart)
    whole = crowd(n)
    whole.inequality_rows(np.eye(n - 1, n, 1) - np.eye(n - 1, n), lower=1.0)
    assert found.proved and any(seen)
    assert np.isclose(found.energy, roundel.solve(whole).energy)


def test_a_function_of_lazy_rows_may_fail_or_end_the_solve():
    def fails(candidate, rows):
        raise ZeroDivisionError("of the caller")

    with pytest.raises(ZeroDivisionError, match="of the caller"):
        roundel.solve(crowd(4), lazy_rows=fails)
    with pytest.raises(roundel.CancelledError):
        roundel.solve(crowd(4), lazy_rows=lambda candidate, rows: True)
    with pytest.raises(roundel.ArgumentTypeError, match="lazy_rows should be a function"):
        roundel.solve(crowd(4), lazy_rows=3)
    kept = []
    roundel.solve(crowd(4), lazy_rows=lambda candidate, rows: kept.append(rows))
    with pytest.raises(roundel.NullPointerError):
        kept[0].inequality([0], [1.0], upper=1.0)


def test_files_say_whether_they_maximise(tmp_path):
    file = tmp_path / "knapsack.lp"
    file.write_text("Maximize\n obj: 3 x + 2 y\nSubject To\n c: 2 x + y <= 3\nBinaries\n x y\nEnd\n")
    problem = roundel.Problem.read(file)
    assert problem.maximises
    assert roundel.solve(problem).energy == -5.0
    problem.write(tmp_path / "again.lp.gz")
    again = roundel.Problem.read(tmp_path / "again.lp.gz")
    assert not again.maximises and roundel.solve(again).energy == -5.0


def test_files_give_the_problem_back(tmp_path):
    problem = roundel.Problem(2)
    problem.quadratic(Q)
    problem.linear(q)
    problem.integer([1])
    problem.write_mps(tmp_path / "a problem.mps.gz")
    read = roundel.Problem.read_mps(tmp_path / "a problem.mps.gz")
    assert np.array_equal(roundel.solve(read).values, roundel.solve(problem).values)


def test_solutions_can_be_pickled():
    found = roundel.solve(Q, q, integers=[1])
    back = pickle.loads(pickle.dumps(found))
    assert np.array_equal(back.values, found.values) and back.energy == found.energy


def test_options_are_those_of_the_library_and_all_can_be_set():
    for name, option in roundel.options().items():
        assert isinstance(option.default, option.type) and option.text and option.range
        roundel.solve(Q, q, integers=[1], **{name: option.default})
    for preset in roundel.presets():
        roundel.solve(Q, q, integers=[1], preset=preset)


def test_the_strategy_is_obeyed():
    assert roundel.solve(Q, q, integers=[1], strategy="relax").status == "relaxed"
    assert roundel.solve(Q, q, integers=[1], strategy="exact").status == "optimal"
    assert roundel.solve(Q, q, integers=[1], strategy="greedy").status == "feasible"


def test_rows_of_a_matrix_equal_rows_added_one_by_one():
    A = np.array([[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [0.0, 0.0, 2.0]])
    b, weights = [0.3, 0.25, 0.7], [0.5, 2.0, 3.0]
    single = roundel.Problem(3)
    for row, rhs, weight in zip(A, b, weights):
        single.least_squares(np.flatnonzero(row), row[row != 0], rhs, weight)
    single.integer([1])
    wanted = roundel.solve(single).values
    for given in (A, scipy_sparse.csr_matrix(A), scipy_sparse.csc_matrix(A), scipy_sparse.coo_matrix(A)):
        problem = roundel.Problem(3)
        assert problem.least_squares_rows(given, b, weights) == 0
        assert problem.least_squares_rows(given, b, np.zeros(3)) == 3
        problem.integer([1])
        assert np.array_equal(roundel.solve(problem).values, wanted)
    with pytest.raises(roundel.InvalidArgumentError, match="entry 1 is -2") as caught:
        problem.least_squares_rows(A, b, [1.0, -2.0, 1.0])
    assert caught.value.position == 1


def test_a_solution_tells_whether_its_search_is_complete_and_what_stopped_it():
    given = random_problem()
    proved = roundel.solve(**given, strategy="exact")
    assert (proved.status, proved.complete, proved.stopped_by) == ("optimal", True, "none")
    rounded = roundel.solve(Q, q, integers=[1], strategy="greedy")
    assert (rounded.status, rounded.complete, rounded.stopped_by) == ("feasible", False, "none")
    cut = roundel.solve(**given, strategy="exact", nodes=0)
    assert (cut.status, cut.complete, cut.stopped_by) == ("limit", False, "nodes")
    assert cut.gap == (cut.energy - cut.lower_bound) / cut.energy
