# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on in Blender without a window: `python -m pytest plugins/blender/tests`, with bpy and roundel installed."""

import io
import os
import pathlib
import sys
import tarfile
import time

import numpy as np
import pytest

bpy = pytest.importorskip("bpy", reason="Blender as a Python module, bpy, is not installed")
sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

import roundel_quads  # noqa: E402
from roundel_quads import making, operator, surface  # noqa: E402


@pytest.fixture(autouse=True)
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    roundel_quads.register()
    yield bpy.context.scene
    roundel_quads.unregister()


def quads_of(subject, **settings):
    """Runs the operator on an object, and gives the object with the quads."""
    bpy.context.view_layer.objects.active = subject
    subject.select_set(True)
    for name, value in settings.items():
        setattr(subject.data.roundel, name, value)
    assert bpy.ops.object.roundel_quads() == {"FINISHED"}
    return bpy.context.object


def suzanne():
    bpy.ops.mesh.primitive_monkey_add()
    return bpy.context.object


def cube():
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object


def positions(mesh):
    return np.array([vertex.co for vertex in mesh.vertices])


def edge_faces(mesh):
    """How many faces each edge has."""
    counts = {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            counts[key] = counts.get(key, 0) + 1
    return counts


def is_all_quads(mesh):
    return all(len(polygon.vertices) == 4 for polygon in mesh.polygons) and max(edge_faces(mesh).values()) <= 2


def test_a_bevelled_cube_with_its_modifier_becomes_quads_beside_it():
    subject = cube()
    bevel = subject.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments = 0.3, 3
    made = quads_of(subject, count=400)
    assert made is not subject and made.name == "Cube Quads"
    assert subject.hide_get() and len(subject.data.polygons) == 6
    mesh = made.data
    assert is_all_quads(mesh) and set(edge_faces(mesh).values()) == {2}
    assert 380 <= len(mesh.polygons) <= 420
    # The corners are cut off: nothing is as far as a corner of the cube.
    assert np.linalg.norm(positions(mesh), axis=1).max() < 3**0.5 - 0.1
    plain = quads_of(subject, count=400, features={"ANGLE"}, use_modifiers=False)
    assert np.linalg.norm(positions(plain.data), axis=1).max() == pytest.approx(3**0.5)


def test_quads_adapt_to_curvature():
    def share_of_tips(adapt):
        """The area of a quad at the tips of a long ellipsoid over that in its middle."""
        bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=32)
        subject = bpy.context.object
        for vertex in subject.data.vertices:
            vertex.co[2] *= 4
        mesh = quads_of(subject, count=800, adapt=adapt).data
        areas = np.array([polygon.area for polygon in mesh.polygons])
        height = np.abs([polygon.center[2] for polygon in mesh.polygons])
        return np.median(areas[height > 3.7]) / np.median(areas[height < 1])

    assert share_of_tips(1.0) < 0.6 * share_of_tips(0.0)


def test_suzanne_becomes_quads_and_eyes_stay():
    subject = suzanne()
    made = quads_of(subject, count=2000, result="INSTEAD")
    assert made is subject and made.name == "Suzanne"
    assert is_all_quads(made.data)
    assert 1500 <= len(made.data.polygons) <= 2600
    size = positions(made.data)
    assert np.allclose(size.max(axis=0) - size.min(axis=0), [2.73, 1.70, 1.97], atol=0.1)


def test_a_scan_becomes_quads():
    """Homer of Debian's package libcgal-demo, the archive of which ROUNDEL_CGAL_DATA names."""
    archive = os.environ.get("ROUNDEL_CGAL_DATA")
    if archive is None:
        pytest.skip("ROUNDEL_CGAL_DATA does not name the archive of libcgal-demo")
    with tarfile.open(archive) as meshes:
        text = io.TextIOWrapper(meshes.extractfile("data/meshes/homer.off")).read()
    words = text.split()
    vertices, triangles = int(words[1]), int(words[2])
    points = np.array(words[4 : 4 + 3 * vertices], dtype=float).reshape(-1, 3)
    corners = np.array(words[4 + 3 * vertices :][: 4 * triangles], dtype=int).reshape(-1, 4)[:, 1:]
    # A hole, a triangle twice, and a loose vertex, as scans have them.
    corners = np.concatenate([corners[40:], corners[-1:]])
    mesh = bpy.data.meshes.new("homer")
    mesh.from_pydata([*points.tolist(), [0, 0, 0]], [], corners.tolist())
    subject = bpy.data.objects.new("homer", mesh)
    bpy.context.scene.collection.objects.link(subject)
    made = quads_of(subject, count=1500).data
    assert is_all_quads(made)
    # Where quads are made again with other options, their number is not met.
    assert 1200 <= len(made.polygons) <= 2600
    # No vertex is far from the scan.
    found = positions(made)
    nearest = [np.linalg.norm(points - p, axis=1).min() for p in found[::20]]
    assert max(nearest) < 0.03 * np.linalg.norm(points.max(axis=0) - points.min(axis=0))


def test_a_symmetric_mesh_has_as_many_vertices_on_both_sides():
    bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=16)
    made = quads_of(bpy.context.object, count=500, mirror={"x", "z"})
    points = positions(made.data)
    known = {tuple(p) for p in points.round(5) + 0.0}
    for axis in (0, 2):
        turned = points.copy()
        turned[:, axis] *= -1
        assert {tuple(p) for p in turned.round(5) + 0.0} == known


def test_attributes_are_carried_over():
    subject = cube()
    mesh = subject.data
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=4)
    bpy.ops.object.mode_set(mode="OBJECT")
    for name in ("left", "right"):
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index = int(polygon.center[0] > 0.0)
    # A layer that is added later moves those that are there.
    group = subject.vertex_groups.new(name="height")
    for vertex in mesh.vertices:
        group.add([vertex.index], 0.5 * vertex.co[2] + 0.5, "REPLACE")
    color = mesh.color_attributes.new(name="place", type="FLOAT_COLOR", domain="POINT")
    for vertex in mesh.vertices:
        color.data[vertex.index].color = [*(0.5 * c + 0.5 for c in vertex.co), 1.0]
    uv = mesh.uv_layers.new(name="top")
    for loop in mesh.loops:
        uv.uv[loop.index].vector = mesh.vertices[loop.vertex_index].co[:2]
    made = quads_of(subject, count=600, features={"ANGLE", "MATERIAL"}).data
    points = positions(made)
    centers = np.array([polygon.center for polygon in made.polygons])
    indices = np.array([polygon.material_index for polygon in made.polygons])
    assert [material.name for material in made.materials] == ["left", "right"]
    is_clear = np.abs(centers[:, 0]) > 0.15
    assert (indices == (centers[:, 0] > 0))[is_clear].all()
    values = np.array([one.color[:] for one in made.color_attributes["place"].data])
    assert np.allclose(values[:, :3], 0.5 * points + 0.5, atol=0.02)
    ends = np.array([loop.vertex_index for loop in made.loops])
    found = np.array([one.vector[:] for one in made.uv_layers["top"].uv])
    assert np.allclose(found, points[ends][:, :2], atol=0.02)
    height = bpy.context.object.vertex_groups["height"]
    top = int(points[:, 2].argmax())
    assert height.weight(top) == pytest.approx(1.0, abs=0.02)
    bare = quads_of(subject, keep_attributes=False)
    assert not bare.vertex_groups and not bare.data.uv_layers and not bare.data.color_attributes


def test_marked_edges_become_edges_of_quads():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16)
    subject = bpy.context.object
    # The equator.
    for edge in subject.data.edges:
        edge.use_edge_sharp = all(abs(subject.data.vertices[v].co[2]) < 1e-5 for v in edge.vertices)
    mesh = quads_of(subject, count=400).data
    points = positions(mesh)
    on_circle = [abs(points[list(edge.vertices), 2]).max() < 1e-3 for edge in mesh.edges]
    length = sum(np.linalg.norm(np.subtract(*points[list(e.vertices)])) for e, on in zip(mesh.edges, on_circle) if on)
    assert length == pytest.approx(2 * np.pi, rel=0.02)


@pytest.mark.parametrize("by", ["GROUP", "COLOR"])
def test_weights_and_colors_make_quads_denser(by):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=30, y_subdivisions=30)
    subject = bpy.context.object
    mesh = subject.data
    right = [vertex.index for vertex in mesh.vertices if vertex.co[0] > 0]
    if by == "GROUP":
        subject.vertex_groups.new(name="dense").add(right, 1.0, "REPLACE")
    else:
        color = mesh.color_attributes.new(name="dense", type="FLOAT_COLOR", domain="POINT")
        for vertex in mesh.vertices:
            color.data[vertex.index].color = (1, 0, 0, 1) if vertex.index in right else (0, 1, 1, 1)
    made = quads_of(subject, count=800, density=by, density_name="dense").data
    centers = np.array([polygon.center for polygon in made.polygons])
    assert (centers[:, 0] > 0).sum() > 3 * (centers[:, 0] < 0).sum()


def test_edges_of_quads_run_along_a_guide_curve():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24)
    subject = bpy.context.object
    # A tilted circle, as an object that is turned: the curve is brought into the space of the mesh.
    tilt = np.radians(35)
    bpy.ops.curve.primitive_nurbs_circle_add(rotation=(tilt, 0, 0))
    mesh = quads_of(subject, count=600, guides=bpy.context.object).data
    normal = np.array([0, -np.sin(tilt), np.cos(tilt)])
    points = positions(mesh)
    angles = []
    for edge in mesh.edges:
        ends = points[list(edge.vertices)]
        middle = ends.mean(axis=0)
        if abs(middle @ normal) < 0.06:
            along, way = np.cross(normal, middle), ends[1] - ends[0]
            cosine = along @ way / np.linalg.norm(along) / np.linalg.norm(way)
            angles.append(np.degrees(np.arccos(np.clip(abs(cosine), 0, 1))))
    off = np.minimum(angles, 90 - np.array(angles))
    assert len(off) > 40 and np.median(off) < 8


def test_what_cannot_be_done_is_told():
    mesh = bpy.data.meshes.new("empty")
    subject = bpy.data.objects.new("empty", mesh)
    bpy.context.scene.collection.objects.link(subject)
    bpy.context.view_layer.objects.active = subject
    with pytest.raises(RuntimeError, match="no faces"):
        bpy.ops.object.roundel_quads()
    subject = cube()
    subject.data.roundel.density = "GROUP"
    subject.data.roundel.density_name = "nothing"
    with pytest.raises(RuntimeError, match="no vertex group 'nothing'"):
        bpy.ops.object.roundel_quads()
    assert len(bpy.data.objects) == 2


def test_a_job_tells_its_progress_and_ends_with_the_best_so_far():
    bpy.ops.mesh.primitive_torus_add(major_segments=96, minor_segments=32)
    given = surface.of_object(bpy.context.object, bpy.context.evaluated_depsgraph_get())
    request = making.Request(3000, 0.0, [])
    job = operator.Job(given, request)
    hear, stages = job._hear, []

    def listen(stage, share):
        stages.append(stage)
        if stage == "map":
            job.end()
        hear(stage, share)

    job._hear = listen
    job.start()
    while not job.is_done:
        time.sleep(0.01)
    assert {"field", "map"} <= set(stages)
    assert (job.stage, job.share) != ("", 0.0)
    if job.error is not None:
        assert isinstance(job.error, KeyboardInterrupt)
    else:
        assert len(job.made.faces) > 100
        assert "the best so far" in job.made.words


def test_settings_are_saved_with_the_mesh():
    subject = cube()
    made = quads_of(subject, count=321, mirror={"y"})
    assert made.data.roundel.count == 321 and made.data.roundel.mirror == {"y"}


def test_the_manifest_names_what_is_there():
    import tomllib

    folder = pathlib.Path(roundel_quads.__file__).parent
    manifest = tomllib.loads((folder / "blender_manifest.toml").read_text())
    assert manifest["type"] == "add-on" and manifest["id"] == folder.name
    cargo = tomllib.loads((folder.parents[2] / "Cargo.toml").read_text())
    assert manifest["version"] == cargo["workspace"]["package"]["version"]
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"]
    assert all(file.read_text().startswith("# SPDX-License-Identifier: GPL-3.0-or-later") for file in folder.glob("*.py"))


def test_edges_are_joined_to_chains():
    open_chain = surface.chains([(3, 1), (0, 1), (3, 2)])
    assert open_chain in ([[0, 1, 3, 2]], [[2, 3, 1, 0]])
    (closed,) = surface.chains([(0, 1), (1, 2), (2, 0)])
    assert closed[0] == closed[-1] and sorted(closed[:-1]) == [0, 1, 2]
    assert sorted(map(sorted, surface.chains([(0, 1), (0, 2), (0, 3)]))) == [[0, 1], [0, 2], [0, 3]]
