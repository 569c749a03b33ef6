"""Soups, and the meshes that repair makes of them."""

import inspect
from itertools import product

import numpy as np
import pytest

import roundel
from roundel._library import ffi

#: A box whose six squares share no vertex.
CORNERS = np.array(list(product((0.0, 1.0), repeat=3)))
SQUARES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
BOX = (CORNERS[SQUARES].reshape(-1, 3), np.arange(24).reshape(6, 4))


def test_kinds_of_edits_are_those_of_the_library():
    numbers = ffi.typeof("enum roundel_edit_kind").relements
    assert {f"ROUNDEL_EDIT_{kind.name}": kind.value for kind in roundel.EditKind} == numbers
    done = roundel.repair(*BOX)
    with pytest.raises(roundel.InvalidArgumentError):
        roundel.errors.check(roundel._lib.roundel_repair_count_of(done._handle.pointer, 99, ffi.new("size_t *")))


def test_a_box_of_squares_becomes_a_closed_mesh_and_every_edit_is_told():
    done = roundel.repair(*BOX)
    assert (len(done.mesh.vertices), len(done.mesh.faces), done.mesh.euler_characteristic) == (8, 12, 2)
    assert done.mesh is done.mesh
    assert done.counts == {"vertex_welded": 16, "polygon_triangulated": 6}
    assert done.summary == "welded 16 vertices, triangulated 6 polygons"
    welded = done.edits[done.edits["kind"] == roundel.EditKind.VERTEX_WELDED]
    assert np.array_equal(done.welded_to[welded["element"]], welded["other"])
    assert np.array_equal(done.mesh.vertices, BOX[0][done.vertex_origins])
    assert np.array_equal(done.face_origins, np.repeat(np.arange(6), 2))


def test_a_mesh_comes_back_as_it_is(cube):
    done = roundel.repair(cube)
    assert len(done.edits) == 0 and done.counts == {} and done.summary == ""
    assert np.array_equal(done.mesh.faces, cube.faces)
    assert np.array_equal(done.mesh.vertices, cube.vertices)
    assert np.array_equal(roundel.Mesh.from_soup(cube.vertices, cube.faces).faces, cube.faces)


def test_options_are_keywords():
    points, squares = BOX
    points = points + 1e-6 * (np.arange(24) == 0)[:, None]
    open_box = roundel.Soup(points, squares[:5])
    assert roundel.repair(open_box).mesh.boundary_loops == 1
    closed = roundel.repair(open_box, weld=1e-5, fill_holes=4, drop_components=None)
    assert closed.mesh.boundary_loops == 0 and len(closed.mesh.vertices) == 8
    assert closed.counts["hole_filled"] == 1 and closed.face_origins[-1] == -1
    assert set(inspect.signature(roundel.repair).parameters) >= set(roundel.repair_options())
    for keywords, kind in (
        ({"fill_hole": 1}, roundel.UnknownOptionError),
        ({"fill_holes": 0.5}, roundel.OptionTypeError),
        ({"weld": -1.0}, roundel.OptionRangeError),
    ):
        with pytest.raises(kind):
            roundel.repair(open_box, **keywords)


def test_a_soup_keeps_what_it_is_given():
    points = [[0.0, 0.0, 0.0], [1.0, 0.0, np.inf], [0.0, 1.0, 0.0]]
    soup = roundel.Soup(points, [[0, 1, 2], [], [0, -7, 2**40, 1]])
    assert [polygon.tolist() for polygon in soup.polygons] == [[0, 1, 2], [], [0, -7, 2**40, 1]]
    assert np.array_equal(soup.vertices, points) and len(soup) == 3
    assert roundel.Soup(points, []).polygons == []
    for wrong, kind in (([[0.5, 1.0, 2.0]], TypeError), ([[[0, 1, 2]]], ValueError)):
        with pytest.raises(kind):
            roundel.Soup(points, wrong)


def test_a_soup_without_a_surface_is_an_error():
    with pytest.raises(roundel.EmptyError, match="no polygon"):
        roundel.repair([[0.0, 0.0, 0.0]], [])
    with pytest.raises(roundel.EmptyError, match="not finite"):
        roundel.Mesh.from_soup([[np.nan, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


def test_files_of_any_polygons_are_read(tmp_path):
    file = tmp_path / "square.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    with pytest.raises(roundel.NotATriangleError):
        roundel.Mesh.read(file)
    assert len(roundel.Mesh.read(file, repair=True).faces) == 2
    unnamed = file.rename(tmp_path / "square")
    with pytest.raises(roundel.NotSupportedError):
        roundel.Soup.read(unnamed)
    assert len(roundel.Soup.read(unnamed, "obj")) == 1
    with pytest.raises(roundel.NotSupportedError):
        roundel.Soup.read(unnamed, format="3mf")
    with pytest.raises(roundel.ParseError):
        roundel.Soup.read(unnamed, format="glb")
    with pytest.raises(roundel.IoError):
        roundel.Soup.read(tmp_path / "none.stl")


def test_stl_becomes_the_mesh_that_was_written(tmp_path, cube):
    cube.write(tmp_path / "cube.stl")
    done = roundel.repair(roundel.Soup.read(tmp_path / "cube.stl"))
    assert set(done.counts) == {"vertex_welded"}
    assert len(done.mesh.vertices) == len(cube.vertices)
    assert done.mesh.euler_characteristic == 2


def test_edges_between_materials_are_features(tmp_path):
    file = tmp_path / "two.obj"
    corners = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 1 0 0\nv 1 1 0\n"
    file.write_text(corners + "usemtl a\nf 1 2 5 4\nusemtl b\nf 7 3 6 8\n")
    done = roundel.repair(file)
    edges = done.attribute_edges(file, "materials")
    assert sorted(edges[0].tolist()) == [1, 4] and len(edges) == 1
    roundel.field(done.mesh, features=edges)
    with pytest.raises(roundel.InvalidArgumentError, match="no seams; it has materials"):
        done.attribute_edges(file, "seams")
    with pytest.raises(roundel.InvalidArgumentError, match="no attribute"):
        done.attribute_edges(file, "uv")
    other = tmp_path / "other.obj"
    other.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n")
    with pytest.raises(roundel.LengthMismatchError):
        done.attribute_edges(other, "materials")
