"""Bad arguments raise exceptions that name the element at fault."""

import builtins

import numpy as np
import pytest

import roundel
from roundel import errors
from roundel._library import ffi

EYE = np.eye(3)


def test_every_status_of_the_interface_has_its_exception():
    numbers = ffi.typeof("enum roundel_status").relements
    failures = {name: number for name, number in numbers.items() if name != "ROUNDEL_OK"}
    assert set(errors.classes) == set(failures.values())
    assert len(set(errors.classes.values())) == len(failures)
    for raised in errors.classes.values():
        assert issubclass(raised, roundel.Error) and getattr(roundel, raised.__name__) is raised


def test_no_public_name_hides_one_of_python():
    assert not set(roundel.__all__) & set(dir(builtins))


def test_contradicting_constraints_name_the_row():
    with pytest.raises(roundel.InfeasibleError) as caught:
        C = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]
        roundel.solve(A=EYE, b=np.zeros(3), C=C, d=[1.0, 1.0, 3.0])
    assert caught.value.row in (0, 1, 2) and caught.value.row == caught.value.index
    assert caught.value.code == "infeasible" and caught.value.position is None


def test_too_large_an_index_names_its_position_and_is_an_index_error():
    with pytest.raises(IndexError) as caught:
        roundel.solve(A=EYE, b=np.zeros(3), integers=[0, 7])
    assert isinstance(caught.value, roundel.IndexOutOfRangeError) and caught.value.position == 1


def test_a_refused_row_is_not_added():
    problem = roundel.Problem(3)
    with pytest.raises(roundel.NotFiniteError, match="row 1") as caught:
        problem.least_squares_rows([[1.0, 2.0, 0.0], [3.0, 0.0, np.inf]], np.zeros(2))
    assert caught.value.position == 3
    problem.linear(np.zeros(3))
    assert problem.least_squares([0], [1.0], 0.0) == 0


def test_not_a_number_names_its_position():
    with pytest.raises(roundel.NotFiniteError) as caught:
        roundel.solve(EYE, [0.0, np.nan, 0.0])
    assert caught.value.position == 1


@pytest.mark.parametrize("curved, kind", [(0.0, "UnboundedError"), (-1.0, "NotConvexError")])
def test_a_problem_without_a_minimum_reports_a_direction(curved, kind):
    with pytest.raises(getattr(roundel, kind)) as caught:
        roundel.solve(np.diag([1.0, curved, 1.0]), [0.0, 1.0, 0.0])
    assert caught.value.variable == 1
    assert np.allclose(np.abs(caught.value.direction), [0.0, 1.0, 0.0])


def test_the_three_errors_of_options_differ():
    for keywords, kind in (
        ({"stratgy": "auto"}, roundel.UnknownOptionError),
        ({"nodes": "many"}, roundel.OptionTypeError),
        ({"strategy": "best"}, roundel.OptionRangeError),
        ({"preset": "none such"}, roundel.OptionRangeError),
    ):
        with pytest.raises(kind, match=next(iter(keywords.values() if "preset" in keywords else keywords))):
            roundel.solve(EYE, **keywords)


MESH = roundel.Mesh.shape("sphere", 100)


@pytest.mark.parametrize(
    "call, keyword, nearest",
    [
        (lambda **given: roundel.quad(MESH, **given), "feature", "features"),
        (lambda **given: roundel.quad(MESH, **given), "quad", "quads"),
        (lambda **given: roundel.quad(MESH, **given), "progres", "progress"),
        (lambda **given: roundel.field(MESH, **given), "simmetry", "symmetry"),
        (lambda **given: roundel.map(MESH, **given), "edgelength", "edge_length"),
        (lambda **given: roundel.map(MESH).solve(**given), "untangled", "untangle"),
        (lambda **given: roundel.map(MESH).quads().smooth(MESH, **given), "feature_angel", "feature_angle"),
        (lambda **given: roundel.solve(EYE, **given), "integer", "integers"),
        (lambda **given: roundel.Solver(roundel.Problem(1)).solve(**given), "time", "time_limit"),
        (lambda **given: roundel.repair(MESH, **given), "fill_hole", "fill_holes"),
        (lambda **given: roundel.Mesh.from_soup(MESH, **given), "welds", "weld"),
    ],
)
def test_an_unknown_keyword_names_the_nearest(call, keyword, nearest):
    with pytest.raises(roundel.UnknownOptionError, match=f"{keyword}'.*did you mean '{nearest}'") as caught:
        call(**{keyword: 1})
    assert isinstance(caught.value, TypeError) and caught.value.code == "unknown_option"


def test_an_unknown_word_names_the_nearest(tmp_path):
    for keywords, nearest in (({"strategy": "exat"}, "exact"), ({"preset": "parametrisation"}, "parametrization")):
        with pytest.raises(roundel.OptionRangeError, match=f"did you mean '{nearest}'"):
            roundel.solve(EYE, **keywords)
    with pytest.raises(roundel.UnknownOptionError, match="did you mean 'strategy'"):
        roundel.Problem(1).save_replay(tmp_path / "replay", {"strategie": "exact"})
    with pytest.raises(roundel.UnknownOptionError) as caught:
        roundel.quad(MESH, xyzzy=1)
    assert "did you mean" not in str(caught.value)


@pytest.mark.parametrize("value", [-5, 0, 1.5, float("nan"), float("inf"), 10**30, -(10**30), "many", [1], 1j, {}])
@pytest.mark.parametrize(
    "call",
    [
        lambda value: roundel.quad(MESH, quads=value),
        lambda value: roundel.map(MESH, quads=value),
        lambda value: roundel.Mesh.shape("gear", value),
        lambda value: roundel.field(MESH, symmetry=value),
        lambda value: roundel.quad(MESH, beam_width=value),
    ],
)
def test_wrong_numbers_are_errors_of_the_package(call, value):
    with pytest.raises(roundel.Error) as caught:
        call(value)
    assert str(caught.value) and caught.value.code


@pytest.mark.parametrize(
    "call",
    [
        lambda: roundel.map(MESH, edge_length=-1.0),
        lambda: roundel.map(MESH, edge_length=[0.1, 0.2]),
        lambda: roundel.map(MESH, edge_length="short"),
        lambda: roundel.map(MESH, stiffenings=-1),
        lambda: roundel.quad(MESH, edge_length=[0.1, 0.2]),
        lambda: roundel.quad(MESH, density=[1.0, 2.0]),
        lambda: roundel.quad(MESH, near="vertices", near_vertices=[1 << 20]),
        lambda: roundel.quad(MESH, adapt=2.0),
        lambda: roundel.quad(MESH, min_length=2.0, max_length=1.0),
        lambda: roundel.quad(MESH, edge_length=np.full(100, np.nan)),
        lambda: roundel.quad(MESH, features="sharp"),
        lambda: roundel.quad(MESH, features=[[0, 1, 2]]),
        lambda: roundel.quad(MESH, curvature=0.5),
        lambda: roundel.quad(MESH, constraints=([0, 1], [0.5])),
        lambda: roundel.quad(MESH, constraints=([0.5], [0.5])),
        lambda: roundel.quad(MESH, guides=([0], [0.5])),
        lambda: roundel.field(MESH, indices=([0, 10**12], [1, 1])),
        lambda: roundel.repair(MESH, weld=float("nan")),
        lambda: roundel.repair(MESH, fill_holes=10**30),
        lambda: roundel.Mesh([[0, 0, 0]], [[0, 1]]),
        lambda: roundel.Mesh([["a", 0, 0]], [[0, 1, 2]]),
        lambda: roundel.Mesh([[0, 0, 0], [1, 0]], [[0, 1, 2]]),
        lambda: roundel.Mesh(np.zeros((3, 3))),
        lambda: roundel.Soup([[0, 0, 0]], [[0.5]]),
        lambda: roundel.extract(MESH),
        lambda: roundel.Problem(-1),
        lambda: roundel.Problem(1.5),
        lambda: roundel.Problem(2).pin(10**12, 0.0),
        lambda: roundel.Problem(2).pin(0, "one"),
        lambda: roundel.Problem(2).unpin(-1),
        lambda: roundel.Problem(2).constant("one"),
        lambda: roundel.Problem(2).least_squares([0], [1.0], "one"),
        lambda: roundel.Problem(2).constrain([0], [1.0], [1.0, 2.0]),
        lambda: roundel.Problem(2).linear("no"),
        lambda: roundel.Solver(roundel.Problem(2)).pin(0.5, 1.0),
        lambda: roundel.solve(q=5.0),
        lambda: roundel.solve(EYE, pins={7: 1.0}),
        lambda: roundel.solve(EYE, time_limit="soon"),
    ],
)
def test_wrong_arguments_are_errors_of_the_package(call):
    with pytest.raises(roundel.Error) as caught:
        call()
    assert str(caught.value) and caught.value.code


def test_a_file_names_its_line(tmp_path):
    (tmp_path / "bad.mps").write_text("NAME bad\nROWS\n N obj\n Z row\n")
    with pytest.raises(roundel.ParseError) as caught:
        roundel.Problem.read_mps(tmp_path / "bad.mps")
    assert caught.value.line == 4
    with pytest.raises(roundel.IoError):
        roundel.Problem.read_mps(tmp_path / "none.mps")


def test_meshes_name_the_face_or_the_vertex():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    for vertices, faces, kind, element in (
        (points[:3], [[0, 1, 1]], roundel.RepeatedVertexError, ("face", 0)),
        (points, [[0, 1, 2]], roundel.IsolatedVertexError, ("vertex", 3)),
        (points[:3], [[0, 1, 2], [0, 1, 5]], roundel.IndexOutOfRangeError, ("position", 5)),
    ):
        with pytest.raises(kind) as caught:
            roundel.Mesh(vertices, faces)
        assert getattr(caught.value, element[0]) == element[1]


@pytest.mark.parametrize(
    "keywords, kind",
    [
        ({"A": EYE}, TypeError),
        ({"A": EYE, "b": [0.0]}, ValueError),
        ({"A": EYE, "b": np.zeros(3), "C": EYE}, TypeError),
        ({"A": EYE, "b": np.zeros(3), "C": np.eye(2), "d": np.zeros(2)}, ValueError),
        ({"Q": EYE[:2]}, ValueError),
        ({"Q": EYE, "triangle": "left"}, ValueError),
        ({"Q": EYE, "integers": [0.5]}, TypeError),
        ({"Q": EYE, "integers": [True, False]}, ValueError),
        ({"Q": EYE, "integers": [2**40]}, OverflowError),
        ({"Q": EYE, "guess": np.zeros((3, 1))}, ValueError),
        ({}, TypeError),
    ],
)
def test_mismatched_arguments_are_refused_before_they_reach_c(keywords, kind):
    with pytest.raises(kind):
        roundel.solve(**keywords)
