"""Meshes of other packages, files in place of meshes, and pictures."""

import sys
import warnings

import numpy as np
import pytest

import roundel


@pytest.fixture(scope="module")
def quads(cube):
    return roundel.quad(cube, quads=100)


def test_a_path_is_accepted_where_a_mesh_is(cube, tmp_path):
    file = tmp_path / "cube.obj"
    cube.write(file)
    uvs = roundel.map(cube, quads=100).uvs
    for path in (file, str(file)):
        assert np.array_equal(roundel.Mesh(path).vertices, cube.vertices)
        assert np.array_equal(roundel.field(path).angles, roundel.field(cube).angles)
        assert np.array_equal(roundel.map(path, quads=100).uvs, uvs)
        assert np.array_equal(roundel.quad(path, quads=100).faces, roundel.quad(cube, quads=100).faces)
        assert np.array_equal(roundel.extract(path, uvs=uvs).faces, roundel.extract(cube, uvs=uvs).faces)
        assert len(roundel.repair(path).mesh.faces) == len(roundel.Soup(path)) == len(cube.faces)
        assert len(roundel.Mesh.from_soup(path).faces) == len(cube.faces)
        roundel.map(cube, quads=100).quads().smooth(path)
    with pytest.raises(roundel.IoError):
        roundel.quad(tmp_path / "none.obj")


def test_a_file_of_quads_says_how_it_is_read(quads, tmp_path):
    quads.write(tmp_path / "quads.obj")
    with pytest.raises(roundel.NotATriangleError, match="repair=True"):
        roundel.quad(tmp_path / "quads.obj")


def with_seam(trimesh, cube):
    """A cube whose upper half has vertices of its own, as a texture has them."""
    corners = cube.vertices[cube.faces]
    upper = corners[:, :, 2].mean(axis=1) > cube.vertices[:, 2].mean()
    faces = np.where(upper[:, None], cube.faces + len(cube.vertices), cube.faces)
    used, places = np.unique(faces, return_inverse=True)
    vertices = np.tile(cube.vertices, (2, 1))[used]
    mesh = trimesh.Trimesh(vertices, places.reshape(-1, 3), process=False)
    mesh.visual = trimesh.visual.TextureVisuals(uv=vertices[:, :2])
    return mesh


def test_from_trimesh_welds_the_seams_of_textures(cube):
    trimesh = pytest.importorskip("trimesh")
    textured = with_seam(trimesh, cube)
    assert len(textured.vertices) > len(cube.vertices)
    welded = roundel.Mesh.from_trimesh(textured)
    assert (len(welded.vertices), len(welded.faces)) == (len(cube.vertices), len(cube.faces))
    assert welded.boundary_loops == 0 and welded.euler_characteristic == 2
    scene = trimesh.Scene([textured])
    assert roundel.Mesh.from_trimesh(scene).boundary_loops == 0
    nearly = trimesh.Trimesh(textured.vertices + 1e-7 * textured.visual.uv[:, :1], textured.faces, process=False)
    assert roundel.Mesh.from_trimesh(nearly, weld=1e-5).boundary_loops == 0


def test_seams_that_are_not_welded_are_told(cube):
    trimesh = pytest.importorskip("trimesh")
    textured = with_seam(trimesh, cube)
    with pytest.warns(UserWarning, match=r"cut along \d+ edges.*Mesh\.from_trimesh welds") as heard:
        assert roundel.field(textured).mesh.boundary_loops == 2
    assert heard[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        roundel.field(cube.to_trimesh())
        roundel.field(roundel.Mesh.shape("plane", 100).to_trimesh())
    fans = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], [[0, 1, 2], [0, 3, 4]])
    pinched = trimesh.Trimesh(*fans, process=False)
    with pytest.raises(roundel.NonManifoldVertexError, match=r"Mesh\.from_trimesh welds seams") as caught:
        roundel.quad(pinched)
    assert caught.value.vertex == 0
    with pytest.raises(roundel.NonManifoldVertexError, match=r"Mesh\.from_soup welds"):
        roundel.quad(*fans)


def test_meshes_go_to_trimesh_and_back(cube, quads):
    trimesh = pytest.importorskip("trimesh")
    back = roundel.Mesh(cube.to_trimesh())
    assert np.array_equal(back.vertices, cube.vertices) and np.array_equal(back.faces, cube.faces)
    split = quads.to_trimesh()
    assert isinstance(split, trimesh.Trimesh) and split.is_watertight and len(split.faces) == 2 * len(quads)
    assert np.array_equal(split.vertices, quads.vertices)
    assert split.volume == pytest.approx(cube.to_trimesh().volume, rel=0.1)
    map = roundel.map(cube, quads=100)
    cut = map.to_trimesh()
    assert np.array_equal(cut.visual.uv, map.vertex_uvs)
    assert np.array_equal(cut.vertices[cut.faces], cube.vertices[cube.faces])


def test_meshes_go_to_pyvista_and_back(cube, quads):
    pyvista = pytest.importorskip("pyvista")
    back = roundel.Mesh(cube.to_pyvista())
    assert np.array_equal(back.faces, cube.faces)
    made = quads.to_pyvista()
    assert isinstance(made, pyvista.PolyData) and made.n_cells == len(quads)
    assert np.array_equal(made.regular_faces, quads.faces)
    assert np.array_equal(made.cell_data["scaled_jacobian"], quads.scaled_jacobians)
    assert len(roundel.repair(made).mesh.faces) == 2 * len(quads)
    field = roundel.field(cube)
    assert np.array_equal(field.to_pyvista().cell_data["direction"], field.directions)
    assert np.array_equal(field.to_pyvista().point_data["index_steps"], field.vertex_index_steps)
    map = roundel.map(field, quads=100)
    assert np.allclose(map.to_pyvista().active_texture_coordinates, map.vertex_uvs)


def test_meshes_go_to_meshio_and_back(cube, quads, tmp_path):
    meshio = pytest.importorskip("meshio")
    back = roundel.Mesh(cube.to_meshio())
    assert np.array_equal(back.faces, cube.faces)
    quads.to_meshio().write(tmp_path / "quads.vtu")
    read = meshio.read(tmp_path / "quads.vtu")
    assert np.array_equal(read.cells_dict["quad"], quads.faces)
    assert np.allclose(read.cell_data["scaled_jacobian"][0], quads.scaled_jacobians)
    assert len(roundel.repair(read).mesh.faces) == 2 * len(quads)
    field = roundel.field(cube)
    assert np.array_equal(field.to_meshio().cell_data["direction"][0], field.directions)
    map = roundel.map(field, quads=100)
    assert np.array_equal(map.to_meshio().point_data["uv"], map.vertex_uvs)


class Mixed(roundel.Quads):
    """Quads with a triangle and two pentagons beside them."""

    others = [np.array(face) for face in ([0, 1, 2], [0, 1, 2, 3, 4], [5, 6, 7, 8, 9])]


def test_faces_that_are_no_quads_are_taken_along(quads):
    found = Mixed(quads._handle)
    assert "3 other faces" in repr(found)
    count = len(found) + 3
    pytest.importorskip("trimesh")
    assert len(found.to_trimesh().faces) == 2 * len(found) + 1 + 3 + 3
    for name, faces in (("pyvista", lambda m: m.n_cells), ("meshio", lambda m: sum(map(len, m.cells)))):
        pytest.importorskip(name)
        assert faces(getattr(found, f"to_{name}")()) == count


def test_scaled_jacobians_are_those_of_known_quads(tmp_path):
    """A square, and a rhombus of 30 degrees."""
    flat = roundel.Mesh.shape("plane", 200)
    corners = flat.vertices[flat.faces][:, :, :2]
    square = roundel.extract(flat, uvs=4 * (corners - corners.min(axis=(0, 1))))
    assert len(square) > 0 and np.allclose(square.scaled_jacobians, 1.0)
    shear = np.array([[1.0, 0.0, 0.0], [np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0], [0.0, 0.0, 1.0]])
    slanted = roundel.Mesh(flat.vertices @ shear, flat.faces)
    rhombi = roundel.extract(slanted, uvs=4 * (corners - corners.min(axis=(0, 1))))
    assert np.allclose(rhombi.scaled_jacobians, 0.5)


def test_lengths_of_each_face_are_lengths_of_the_edges(cube):
    one = roundel.quad(cube, edge_length=0.4)
    each = roundel.quad(cube, edge_length=np.full(len(cube.faces), 0.4))
    assert np.array_equal(one.faces, each.faces)


@pytest.mark.parametrize("backend", ["matplotlib", "pyvista"])
@pytest.mark.parametrize("what", ["mesh", "field", "map", "quads"])
def test_pictures_show_something(cube, quads, tmp_path, monkeypatch, backend, what):
    pytest.importorskip(backend)
    image = pytest.importorskip("matplotlib.image")
    monkeypatch.setenv("MPLBACKEND", "agg")
    field = roundel.field(cube)
    things = {"mesh": cube, "field": field, "map": roundel.map(field, quads=100), "quads": quads}
    file = tmp_path / "picture.png"
    drawn = things[what].plot(backend=backend, show=False, file=file)
    assert type(drawn).__name__ == {"matplotlib": "Axes3D", "pyvista": "Plotter"}[backend]
    picture = image.imread(file)[:, :, :3]
    background = picture[0, 0]
    inked = np.abs(picture - background).max(axis=2) > 0.1
    assert 0.05 < inked.mean() < 0.95
    dark = (picture.max(axis=2) < 0.5) & (picture[:, :, 2] > picture[:, :, 0] + 0.1)
    assert dark.sum() > 1000, "lines are on the surface, not behind it"
    red = (picture[:, :, 0] > 0.7) & (picture[:, :, 1] < 0.35) & (picture[:, :, 2] < 0.35)
    assert (red.sum() > 20) == (what in ("field", "map")), "irregular vertices are red"


def test_integer_lines_lie_on_integers():
    from roundel.plot import integer_lines

    draw = np.random.default_rng(2)
    uvs = 6 * draw.random((50, 3, 2)) - 3
    uvs[0] = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]
    corners = np.concatenate([uvs, np.zeros((50, 3, 1))], axis=2)
    lines = integer_lines(corners, uvs)
    assert np.isfinite(lines).all() and len(lines) > 100
    along = [np.abs(lines[:, :, k] - np.rint(lines[:, :, k])).max(axis=1) < 1e-9 for k in (0, 1)]
    assert (along[0] | along[1]).all()
    whole = np.abs(lines[:, 0] - lines[:, 1]).max(axis=1)
    assert (whole > 0).all()


def test_a_package_that_is_not_there_is_named(cube, quads, monkeypatch):
    for name in ("trimesh", "pyvista", "meshio"):
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(roundel.MissingPackageError, match=f"pip install {name}") as caught:
            getattr(quads, f"to_{name}")()
        assert isinstance(caught.value, ImportError)
    with pytest.raises(roundel.MissingPackageError, match="pip install pyvista"):
        cube.plot(backend="pyvista")
    with pytest.raises(roundel.OptionRangeError, match="'pyvista', 'matplotlib'"):
        quads.plot(backend="vtk")
