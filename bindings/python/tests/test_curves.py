"""Curves that guide a field, and that become edges of quads."""

import numpy as np
import pytest

import roundel


@pytest.fixture(scope="module")
def plane():
    return roundel.Mesh.shape("plane", 800)


LINE = [[-0.71, -0.52, 0.0], [0.63, 0.48, 0.0]]


def test_a_field_follows_a_line(plane):
    faces, angles, weights = guides = roundel.curve_guides(plane, [LINE])
    assert len(faces) > 20 and np.all(np.diff(faces) > 0) and np.all(weights > 0)
    found = roundel.field(plane, guides=guides, align_boundary=False)
    quarters = (found.angles[faces] - angles) / (np.pi / 2)
    assert np.allclose(quarters, np.round(quarters), atol=1e-3)


def test_a_mesh_is_cut_along_a_line(plane):
    cut = roundel.cut_along(plane, [LINE])
    assert np.array_equal(cut.mesh.vertices[: len(plane.vertices)], plane.vertices)
    ends = cut.mesh.vertices[cut.edges]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    assert length == pytest.approx(np.hypot(1.34, 1.0), rel=1e-3)
    assert len(cut.face_origins) == len(cut.mesh.faces) and cut.face_origins.max() < len(plane.faces)
    roundel.quad(cut.mesh, quads=100, features=cut.edges)


def test_curves_off_the_surface_are_refused(plane):
    with pytest.raises(roundel.InvalidArgumentError, match="off the surface") as told:
        roundel.curve_guides(plane, [LINE, [[0, 0, 0], [0, 0, 9]]])
    assert told.value.index == 1
    with pytest.raises(roundel.InvalidArgumentError, match="two points"):
        roundel.cut_along(plane, [[[0, 0, 0]]])
    with pytest.raises(roundel.InvalidArgumentError, match="weight"):
        roundel.curve_guides(plane, [LINE], weight=-1.0)
