"""Proofs: what is written is accepted; altered, foreign and missing files are refused."""

import numpy as np
import pytest

import roundel


def bounded(rhs=7.5):
    """(x0 - 3.3)^2 + (x1 - 2.6)^2 with integers and x0 + 2 x1 <= rhs."""
    problem = roundel.Problem(2)
    problem.least_squares_rows(np.eye(2), [3.3, 2.6])
    problem.inequality([0, 1], [1.0, 2.0], upper=rhs)
    problem.integer([0, 1])
    return problem


def test_a_proof_is_written_and_accepted(tmp_path):
    file = tmp_path / "proof.jsonl"
    problem = bounded()
    solution = roundel.solve(problem, proof=file)
    proof = roundel.check_proof(file, problem)
    assert proof.energy == pytest.approx(solution.energy, abs=1e-12)
    assert proof.lower_bound <= proof.energy < proof.lower_bound + 1e-8
    assert proof.violation <= 1e-9 and proof.nodes > 0 and proof.stopped_by == "none"
    assert (solution.proof.energy, solution.proof.lower_bound) == (proof.energy, proof.lower_bound)
    assert roundel.check_proof(str(file)) == proof
    assert roundel.solve(problem).proof is None


def test_what_is_altered_or_of_another_problem_is_refused_with_its_line(tmp_path):
    file, altered = tmp_path / "proof.jsonl", tmp_path / "altered.jsonl"
    roundel.solve(bounded(), proof=file)
    text = file.read_text()
    assert '"values":[' in text
    altered.write_text(text.replace('"values":[', '"values":[1'))
    with pytest.raises(roundel.ProofRefusedError) as caught:
        roundel.check_proof(altered)
    assert caught.value.line == 3 and caught.value.code == "proof_refused"
    altered.write_text(text[: len(text) // 2])
    with pytest.raises(roundel.ProofRefusedError):
        roundel.check_proof(altered)
    with pytest.raises(roundel.ProofRefusedError, match="other_problem"):
        roundel.check_proof(file, bounded(7.75))
    assert roundel.check_proof(file, bounded()).energy is not None


def test_files_and_arguments_that_cannot_be_are_refused(tmp_path):
    problem, file = bounded(), tmp_path / "proof.jsonl"
    with pytest.raises(roundel.IoError, match="none.jsonl"):
        roundel.check_proof(tmp_path / "none.jsonl")
    with pytest.raises(roundel.IoError):
        roundel.solve(problem, proof=tmp_path / "none" / "proof.jsonl")
    with pytest.raises(roundel.InvalidArgumentError, match="greedy"):
        roundel.solve(problem, proof=file, strategy="greedy")
    with pytest.raises(TypeError):
        roundel.check_proof(file, "problem")
    with pytest.raises(TypeError):
        roundel.solve(problem, proof=file, lazy_rows=lambda candidate, rows: None)
    assert not file.exists()
    assert roundel.solve(problem, proof=file).proved


def test_a_problem_without_a_solution_gets_a_proof_of_that(tmp_path):
    file, problem = tmp_path / "proof.jsonl", bounded()
    problem.constrain([0, 1], [2.0, 4.0], 3.0)
    with pytest.raises(roundel.NoIntegerSolutionError):
        roundel.solve(problem, proof=file)
    proof = roundel.check_proof(file, problem)
    assert (proof.energy, proof.lower_bound) == (None, None)


def test_a_cancelled_solve_keeps_its_solution_and_writes_no_proof(tmp_path):
    file = tmp_path / "proof.jsonl"
    solution = roundel.solve(bounded(), proof=file, progress=lambda event: np.isfinite(event.energy))
    assert solution.status in ("cancelled", "optimal")
    assert solution.proof.stopped_by == "cancel" and solution.proof.energy is None
    assert not file.exists()


def test_a_file_that_is_not_convex_is_refused_with_its_line(tmp_path):
    file = tmp_path / "bent.lp"
    file.write_text("min\n f: x + [ x ^ 2\n - y ^ 2 ] / 2\nst\n c: x + y <= 4\nend\n")
    with pytest.raises(roundel.NotConvexError) as caught:
        roundel.Problem.read(file)
    assert (caught.value.line, caught.value.variable) == (3, 1)
