"""Fields, maps and quads, from arrays and from the meshes of other packages."""

import numpy as np
import pytest

import roundel


def test_a_field_turns_around_its_irregular_vertices_as_euler_says(cube):
    field = roundel.field(cube)
    assert field.vertex_indices.sum() == cube.euler_characteristic
    assert field.energy == pytest.approx(field.solution.energy, rel=1e-6)
    matched = field.angles[cube.edge_faces[:, 0]] + field.kappa + np.pi / 2 * field.period_jumps
    off = matched - field.angles[cube.edge_faces[:, 1]]
    assert field.energy == pytest.approx((off**2).sum(), rel=1e-6)


def test_directions_are_unit_vectors_in_the_faces(cube):
    directions = roundel.field(cube).directions
    corners = cube.vertices[cube.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.allclose(np.linalg.norm(directions, axis=1), 1.0)
    assert np.allclose((directions * normals).sum(axis=1), 0.0)


def test_a_field_has_the_directions_and_indices_that_it_must_have(cube):
    field = roundel.field(cube, constraints=([3, 10], [0.5, 1.0]))
    assert np.allclose(field.angles[[3, 10]], [0.5, 1.0])
    cones = roundel.field(cube).irregular
    asked = roundel.field(cube, indices=(cones, np.ones(len(cones), int)))
    assert np.array_equal(asked.irregular, cones)


def test_lines_have_half_turns(cube):
    field = roundel.field(cube, symmetry=2)
    assert field.symmetry == 2
    assert np.array_equal(2 * field.vertex_indices, field.vertex_index_steps)


@pytest.mark.parametrize("symmetry", [1, 2, 4, 6])
@pytest.mark.parametrize("name", ["gear", "genus-2", "plate-with-holes"])
def test_indices_are_integers_over_n_that_sum_to_the_euler_characteristic(name, symmetry):
    mesh = roundel.Mesh.shape(name, 600)
    directed = {"align_boundary": False} if symmetry == 1 else {"features": 40}
    field = roundel.field(mesh, symmetry=symmetry, **directed)
    steps, loops = field.vertex_index_steps, field.boundary_index_steps
    assert steps.dtype == loops.dtype == np.int32
    assert np.array_equal(field.vertex_indices, steps / symmetry)
    assert np.array_equal(field.boundary_indices, loops / symmetry)
    assert steps.sum() + loops.sum() == symmetry * mesh.euler_characteristic
    assert np.array_equal(field.irregular, np.flatnonzero(field.vertex_indices))


def test_quarters_of_a_gear_can_be_counted():
    mesh = roundel.Mesh.shape("gear", 3000)
    field = roundel.field(mesh, features=40)
    plus, minus = (np.count_nonzero(field.vertex_indices == index) for index in (0.25, -0.25))
    assert plus == minus and plus + minus == len(field.irregular) == 96


def test_details_attract_no_irregular_vertices(cube):
    push = 1.0 + 0.06 * np.sin(7.0 * np.arange(len(cube.vertices)))
    rough = roundel.Mesh(cube.vertices * push[:, None], cube.faces)
    length = 10.0 * np.linalg.norm(np.ptp(cube.vertices, axis=0)) / np.sqrt(len(cube.faces))
    seen, unseen = roundel.field(rough), roundel.field(rough, detail=length)
    assert len(unseen.irregular) <= len(seen.irregular)
    assert not np.array_equal(unseen.irregular, seen.irregular)
    with pytest.raises(roundel.OptionRangeError):
        roundel.field(rough, detail=-1.0)


def test_a_map_is_seamless_and_its_cones_are_integers(cube):
    field = roundel.field(cube)
    map = roundel.map(field, quads=200)
    assert map.valid and len(map.flipped) == 0
    assert np.array_equal(np.sort(map.cones), field.irregular)
    assert np.array_equal(map.uvs, map.vertex_uvs[map.vertex_corners])
    at_cones = map.uvs[np.isin(cube.faces, map.cones)]
    assert np.allclose(at_cones, np.rint(at_cones), atol=1e-9)
    edges, quarters, shifts = map.transitions
    assert set(np.unique(quarters)) <= {0, 1, 2, 3}
    assert np.allclose(shifts, np.rint(shifts), atol=1e-9)
    assert roundel.map(field, quads=200, stiffenings=0).valid
    map.solve(edge_length=0.5)
    assert map.solution.values.shape == roundel.map(field, edge_length=0.5).solution.values.shape


def test_quads_of_a_map_are_those_of_its_coordinates(cube):
    map = roundel.map(cube, quads=100)
    vertices, quads = map.quads()
    again = roundel.extract(cube.vertices, cube.faces, map.uvs)
    assert len(quads) == len(again) and np.allclose(vertices, again.vertices)


def test_quads_have_the_requested_number_and_are_closed(cube):
    found = roundel.quad(cube.vertices, cube.faces, quads=150)
    vertices, quads = found
    assert found.conforming and found.others == []
    assert 75 < len(quads) < 300
    assert len(vertices) - len(quads) == found.euler_characteristic == 2
    with pytest.raises(TypeError):
        roundel.quad(cube, quads=150, edge_length=1.0)


def test_edges_of_half_the_length_make_four_times_the_quads(cube):
    coarse, fine = (len(roundel.quad(cube, edge_length=length)) for length in (0.4, 0.2))
    assert 3 < fine / coarse < 5
    with pytest.raises(roundel.OptionRangeError):
        roundel.quad(cube, edge_length=0.0)


def test_defaults_are_those_of_the_library(cube):
    silent = roundel.quad(cube, quads=100)
    spoken = roundel.quad(cube, quads=100, align_boundary=True)
    other = roundel.quad(cube, quads=100, curvature=(0.5, 0.0))
    assert np.array_equal(silent.vertices, spoken.vertices)
    named = roundel.quad(cube, quads=100, strategy="lattice", field_strategy="adaptive", threads=1)
    assert np.array_equal(silent.vertices, named.vertices)
    rough = roundel.quad(cube, quads=100, smooth=False)
    assert np.array_equal(silent.faces, rough.faces) and not np.array_equal(silent.vertices, rough.vertices)
    assert not np.array_equal(silent.vertices, other.vertices)


def test_sharp_edges_stay_sharp():
    gear = roundel.Mesh.shape("gear", 1500)
    found = roundel.quad(gear, quads=400, features=40)
    tip = np.linalg.norm(gear.vertices[:, :2], axis=1).max()
    reached = np.linalg.norm(found.vertices[:, :2], axis=1).max()
    assert found.conforming and reached > 0.99 * tip


def test_meshes_and_quads_are_written_and_read(cube, tmp_path):
    cube.write(tmp_path / "cube.off")
    read = roundel.Mesh.read(tmp_path / "cube.off")
    assert np.array_equal(read.vertices, cube.vertices) and np.array_equal(read.faces, cube.faces)
    found = roundel.quad(cube, quads=100)
    found.write(tmp_path / "quads.obj")
    lines = (tmp_path / "quads.obj").read_text().splitlines()
    assert sum(line.startswith("f ") for line in lines) == len(found)


def test_indices_of_any_width_are_one_mesh(cube):
    for kind in (np.int32, np.int64, np.uint16, np.uint32, np.uint64):
        assert np.array_equal(roundel.Mesh(cube.vertices, cube.faces.astype(kind)).faces, cube.faces)


def test_trimesh(cube):
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(cube.vertices, cube.faces, process=False)
    vertices, quads = roundel.quad(mesh, quads=100)
    back = trimesh.Trimesh(vertices, trimesh.geometry.triangulate_quads(quads), process=False)
    assert back.is_watertight and back.volume == pytest.approx(mesh.volume, rel=0.1)


def test_pymeshlab_does_what_its_plugin_does(tmp_path):
    pymeshlab = pytest.importorskip("pymeshlab")
    gear = roundel.Mesh.shape("gear", 1500)
    gear.write(tmp_path / "gear.ply")
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(tmp_path / "gear.ply"))
    found = roundel.quad(meshes, quads=300, features=40)
    same = roundel.quad(meshes.current_mesh(), quads=300, features=40)
    assert np.array_equal(found.vertices, same.vertices) and found.conforming

    # As a layer of polygons, written by MeshLab and read back.
    faces = [list(face) for face in found.faces]
    meshes.add_mesh(pymeshlab.Mesh(found.vertices, face_list_of_indices=faces))
    meshes.save_current_mesh(str(tmp_path / "quads.obj"))
    lines = (tmp_path / "quads.obj").read_text().splitlines()
    corners = [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in lines if line.startswith("f ")]
    assert {frozenset(quad) for quad in corners} == {frozenset(quad) for quad in faces}
    written = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
    assert np.allclose(written, found.vertices, atol=1e-5)


def test_openmesh(cube):
    openmesh = pytest.importorskip("openmesh")
    mesh = openmesh.TriMesh(cube.vertices, cube.faces)
    found = roundel.quad(mesh, quads=100)
    back = openmesh.PolyMesh(found.vertices, found.faces)
    assert back.n_faces() == len(found) and all(back.valence(face) == 4 for face in back.faces())


def test_an_object_that_is_not_a_mesh_is_refused():
    with pytest.raises(TypeError, match="object"):
        roundel.field(object())


def test_labels_and_numbers_come_to_quads():
    plane = roundel.Mesh.shape("plane", 800)
    quads = roundel.quad(plane, quads=100)
    points, corners = quads.vertices, quads.faces
    middle = plane.vertices[:, 0].mean()
    off = np.ptp(plane.vertices[:, 0]) / 10
    labels = np.where(plane.vertices[plane.faces][:, :, 0].mean(axis=1) < middle, 4, -1)
    found = quads.transfer_face_labels(plane, labels)
    x = points[corners][:, :, 0].mean(axis=1) - middle
    assert (found[x < -off] == 4).all() and (found[x > off] == -1).all()
    assert (x < -off).any() and (x > off).any()
    linear = lambda p: np.stack([1 + 2 * p[..., 0], p[..., 1] - p[..., 0]], axis=-1)  # noqa: E731
    both = quads.transfer_vertex_values(plane, linear(plane.vertices))
    assert np.abs(both - linear(points)).max() < 1e-12
    one = quads.transfer_vertex_values(plane, linear(plane.vertices)[:, 0])
    assert np.array_equal(one, both[:, 0])
    uvs = quads.transfer_corner_values(plane, linear(plane.vertices[plane.faces]))
    assert uvs.shape == (len(quads), 4, 2)
    assert np.abs(uvs - linear(points[corners])).max() < 1e-12
    assert quads.transfer_corner_values(plane, np.full(plane.faces.shape, 3.0)).shape == (len(quads), 4)


def test_labels_and_numbers_that_do_not_fit_are_refused():
    plane = roundel.Mesh.shape("plane", 200)
    quads = roundel.quad(plane, quads=50)
    with pytest.raises(roundel.LengthMismatchError):
        quads.transfer_face_labels(plane, [1, 2])
    with pytest.raises(roundel.InvalidArgumentError) as refused:
        quads.transfer_face_labels(plane, [0, -2] + [0] * (len(plane.faces) - 2))
    assert refused.value.index == 1
    with pytest.raises(roundel.ArgumentTypeError):
        quads.transfer_face_labels(plane, np.zeros(len(plane.faces)))
    for shape in [(3,), (len(plane.vertices), 2, 2)]:
        with pytest.raises(roundel.LengthMismatchError):
            quads.transfer_vertex_values(plane, np.zeros(shape))
    with pytest.raises(roundel.LengthMismatchError):
        quads.transfer_corner_values(plane, np.zeros((len(plane.faces), 4)))
    infinite = np.zeros(len(plane.vertices))
    infinite[3] = np.inf
    with pytest.raises(roundel.NotFiniteError) as refused:
        quads.transfer_vertex_values(plane, infinite)
    assert refused.value.index == 3


TWO_SQUARES = """v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 2 0 0 0 0 1
v 0 1 0 1 0 0
v 1 1 0 0 1 0
v 2 1 0 0 0 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl wood
f 1/1 2/2 5/3 4/4
usemtl steel
f 2/1 3/2 6/3 5/4
"""

HOT_TRIANGLE = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float heat
element face 1
property list uchar int vertex_indices
property uchar red
property uchar green
property uchar blue
end_header
0 0 0 1.5
1 0 0 2
0 1 0 3
3 0 1 2 255 0 51
"""


def test_attributes_come_from_the_file_of_a_mesh(tmp_path):
    file = tmp_path / "two.obj"
    file.write_text(TWO_SQUARES)
    repaired = roundel.repair(file)
    found = repaired.attributes(file)
    assert found.materials.names == ["wood", "steel"]
    assert found.materials.labels.tolist() == [0, 0, 1, 1]
    assert found.groups is None and found.face_colors is None and found.scalars == {}
    x = repaired.mesh.vertices[repaired.mesh.faces][:, :, 0] - [[0], [0], [1], [1]]
    assert np.array_equal(found.uv[:, :, 0], x)
    assert np.array_equal(found.vertex_colors[0], [1, 0, 0, 1])
    quads = roundel.quad(repaired.mesh, quads=100)
    labels = quads.transfer_face_labels(repaired.mesh, found.materials.labels)
    assert set(labels.tolist()) == {0, 1}

    ply = tmp_path / "hot.ply"
    ply.write_text(HOT_TRIANGLE)
    mesh = roundel.Mesh.read(ply)
    found = mesh.attributes(ply)
    assert found.scalars["heat"].tolist() == [1.5, 2, 3]
    assert np.array_equal(found.face_colors, [[1, 0, 0.2, 1]])
    assert found.materials is None and found.uv is None and found.vertex_colors is None


def test_attributes_of_other_meshes_and_of_no_file_are_refused(tmp_path):
    file = tmp_path / "hot.ply"
    file.write_text(HOT_TRIANGLE)
    torus = roundel.Mesh.shape("torus", 200)
    with pytest.raises(roundel.LengthMismatchError):
        torus.attributes(file)
    with pytest.raises(roundel.Error, match="none.ply"):
        torus.attributes(tmp_path / "none.ply")


def test_triangles_whose_quads_are_pairs_are_counted():
    sphere = roundel.Mesh.shape("sphere", 80)
    inner = np.arange(len(sphere.vertices)) * 7 % 5 < 2
    spikes = roundel.Mesh(np.where(inner[:, None], 0.1, 1.0) * sphere.vertices, sphere.faces)
    quads = roundel.quad(spikes, quads=100)
    assert quads.paired_face_count == len(spikes.faces) == 2 * len(quads.faces)
    assert quads.conforming
    assert roundel.quad(sphere, quads=100).paired_face_count == 0


def test_irregular_vertices_near_features_are_counted():
    gear = roundel.Mesh.shape("gear", 4000)
    assert roundel.quad(gear, quads=500, features=40).near_feature_count == 0
    assert roundel.quad(gear, quads=500, features=40, clearance=0).near_feature_count == 0
    with pytest.raises(roundel.InvalidArgumentError, match="features"):
        roundel.map(gear, quads=500).quads().near_feature_count
