"""What `help` and `repr` say."""

import inspect
import pydoc

import pytest

import roundel

TABLES = {
    "quad": (roundel.quad_options, roundel.guidance_options, roundel.options),
    "map": (roundel.guidance_options, roundel.options),
    "field": (roundel.guidance_options, roundel.options),
    "solve": (roundel.options,),
    "repair": (roundel.repair_options,),
}
#: Keywords that are told in other words than those of the table.
REWORDED = {"strategy", "detail", "feature_angle", "edge_length", "quads"}


def told(name):
    return pydoc.plain(pydoc.render_doc(getattr(roundel, name)))


@pytest.mark.parametrize("name", TABLES)
def test_every_option_is_in_the_signature_and_the_help_with_type_default_and_sentence(name):
    parameters = inspect.signature(getattr(roundel, name)).parameters
    text = " ".join(told(name).split())
    for option in (option for table in TABLES[name] for option in table().values()):
        parameter = parameters[option.name]
        assert f" {option.name}: {parameter.annotation} = {parameter.default!r} " in text
        said = option.text.removeprefix("1: ").replace(": 1 if", ": true if")
        assert option.name in REWORDED or said[1:] in text, option.name


@pytest.mark.parametrize("name", TABLES)
def test_a_default_that_is_spoken_changes_nothing(name, cube):
    spoken = {
        p.name: p.default
        for p in inspect.signature(getattr(roundel, name)).parameters.values()
        if p.kind is p.KEYWORD_ONLY and p.name not in ("A", "b")
    }
    given = {"A": [[1.0, 0.5], [1.0, -1.0]], "b": [0.4, 0.0], "integers": [1]}
    first = {} if name == "solve" else {"vertices" if name == "repair" else "V": cube}
    if name == "solve":
        spoken.update(integers=[1])
        first = {"A": given["A"], "b": given["b"]}
        silent = roundel.solve(**first, integers=[1])
    else:
        silent = getattr(roundel, name)(**first)
    loud = getattr(roundel, name)(**first, **spoken)
    assert repr(silent) == repr(loud)


def test_keywords_of_guidance_and_watching_are_told_where_they_are_taken():
    words = ("features", "curvature", "constraints", "guides", "indices", "guide_file", "progress", "cancel")
    for name in ("field", "map", "quad"):
        for word in words:
            assert f"      {word}: " in told(name)


def test_help_shows_types_without_quotes():
    for name in (*roundel.__all__, "map"):
        for line in told(name).splitlines():
            assert ": '" not in line.split(" = ")[0] or "(" not in line, (name, line)


def test_every_argument_that_is_no_keyword_is_named_in_the_text():
    for name in (*TABLES, "extract", "Mesh", "Soup"):
        thing = getattr(roundel, name)
        for parameter in inspect.signature(thing).parameters.values():
            if parameter.kind is not parameter.KEYWORD_ONLY or name == "solve":
                assert parameter.name in thing.__doc__, f"{name}: {parameter.name}"


def test_reprs_tell_counts_and_quality(cube):
    field = roundel.field(cube)
    map = roundel.Map(field)
    assert repr(map).endswith("not solved>")
    map.solve(quads=100)
    quads = roundel.quad(cube, quads=100)
    square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    problem = roundel.Problem(2)
    problem.least_squares_rows([[1.0, 0.5], [1.0, -1.0]], [0.4, 0.0])
    problem.integer([1])
    solver = roundel.Solver(problem)
    token = roundel.CancelToken()
    faces = len(cube.faces)
    least, mean = quads.scaled_jacobians.min(), quads.scaled_jacobians.mean()
    assert 0 < least < mean < 1
    unsolved, solution = repr(solver), solver.solve()
    for thing, words in (
        (cube, f"<Mesh: {len(cube.vertices)} vertices, {faces} triangles, closed, Euler characteristic 2>"),
        (roundel.Mesh.shape("disk", 100), "1 boundary loop,"),
        (field, f"<Field: crosses on {faces} triangles, 8 irregular vertices, energy {field.energy:.6g}>"),
        (map, f"<Map: {faces} triangles, 0 of them folded, 8 cones, energy {map.energy:.6g}>"),
        (quads, f"<Quads: {len(quads)} quads, {len(quads.vertices)} vertices, 8 irregular, conforming, "),
        (quads, f"scaled Jacobian {least:.2f} at least, {mean:.2f} on average>"),
        (roundel.Soup(square, [[0, 1, 2, 3]]), "<Soup: 4 vertices, 1 polygons>"),
        (roundel.repair(square, [[0, 1, 2, 3]]), "<Repair: triangulated 1 polygon; <Mesh: 4 vertices"),
        (problem, "<Problem: 2 variables, 0 constraints>"),
        (unsolved, "not solved yet>"),
        (solution, "<Solution: optimal, energy 0.08, 2 variables, 1 integer>"),
        (solver, "last <Solution: optimal"),
        (token, "<CancelToken: not set>"),
    ):
        assert words in repr(thing)


@pytest.mark.parametrize("kind", (roundel.Solution, roundel.Event, roundel.Option, roundel.EditKind))
def test_every_member_without_a_documentation_of_its_own_is_told_by_its_class(kind):
    names = getattr(kind, "__dataclass_fields__", None) or kind.__members__
    for name in names:
        assert f"\n      {name}" in kind.__doc__, name
