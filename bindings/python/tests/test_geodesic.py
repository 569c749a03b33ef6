"""Exact geodesic distances: closed forms, points, paths, bad input, and a peer if it is installed."""

import numpy as np
import pytest

import roundel


@pytest.fixture(scope="module")
def plane():
    return roundel.Mesh.shape("plane", 800)


def test_in_a_convex_plane_distances_are_those_of_space(plane):
    found = roundel.geodesic_distance(plane, vertices=[3, 200])
    apart = np.linalg.norm(plane.vertices[:, None] - plane.vertices[[3, 200]], axis=2)
    assert np.allclose(found.distances, apart.min(axis=1), rtol=1e-13)
    nearest = apart[np.arange(len(apart)), found.nearest_sources]
    assert np.allclose(nearest, apart.min(axis=1), rtol=1e-13)


def test_points_have_distances_gradients_and_paths(plane):
    found = roundel.geodesic_distance(plane, vertices=[0], everywhere=True)
    faces, weights = [5, 400, 700], np.array([[0.2, 0.3, 0.5], [0.6, 0.2, 0.2], [1 / 3, 1 / 3, 1 / 3]])
    places = np.einsum("ij,ijk->ik", weights, plane.vertices[plane.faces[faces]])
    ways = places - plane.vertices[0]
    lengths = np.linalg.norm(ways, axis=1)
    assert np.allclose(found.at(faces, weights), lengths, rtol=1e-13)
    assert np.allclose(found.gradients(faces, weights), ways / lengths[:, None], atol=1e-12)
    path, along = found.path(700, weights[2])
    again = roundel.geodesic_distance(plane, polylines=[(path, along)], everywhere=True)
    assert np.allclose(again.at([700], weights[2:]), 0.0, atol=1e-15)
    steps = np.diff(found.path_from_vertex(300), axis=0)
    assert np.isclose(np.linalg.norm(steps, axis=1).sum(), found.distances[300])


def test_all_kinds_of_sources_are_numbered_in_order(plane):
    corner = ([10], [[0.5, 0.25, 0.25]])
    line = ([300, 300], [[0.2, 0.3, 0.5], [0.5, 0.3, 0.2]])
    found = roundel.geodesic_distance(
        plane, vertices=[420], points=corner, polylines=[line, (*line, True)], edges=[[7], [500, 501]], boundary=True
    )
    assert set(found.nearest_sources) <= set(range(7)) and found.nearest_sources[420] == 0
    assert found.nearest_sources[0] == 6 and found.distances.min() == 0.0
    near = roundel.geodesic_distance(plane, vertices=[0], limit=0.5)
    assert np.isinf(near.distances).any() and (near.nearest_sources[np.isinf(near.distances)] == -1).all()


def test_sources_off_the_mesh_are_errors_that_name_them(plane):
    for keywords, kind, index in [
        ({"vertices": [0, 10**6]}, roundel.IndexOutOfRangeError, 1),
        ({"vertices": [0], "points": ([1], [[2.0, -1.0, 0.0]])}, roundel.InvalidArgumentError, 1),
        ({"polylines": [([0, 700], [[1.0, 0, 0], [1.0, 0, 0]])]}, roundel.InvalidArgumentError, 0),
        ({"points": ([1], [[np.nan, 0.5, 0.5]])}, roundel.NotFiniteError, 0),
        ({}, roundel.InvalidArgumentError, None),
    ]:
        with pytest.raises(kind) as failure:
            roundel.geodesic_distance(plane, **keywords)
        assert failure.value.index == index
    with pytest.raises(roundel.LengthMismatchError):
        roundel.geodesic_distance(plane, points=([1, 2], [[1.0, 0, 0]]))
    with pytest.raises(roundel.InvalidArgumentError, match="everywhere"):
        roundel.geodesic_distance(plane, vertices=[0]).at([1], [[0.2, 0.3, 0.5]])


@pytest.mark.parametrize("name", ["sphere", "torus", "genus-2", "gear", "rounded-cube"])
def test_pygeodesic_finds_the_same_distances(name):
    peer = pytest.importorskip("pygeodesic.geodesic")
    mesh = roundel.Mesh.shape(name, 2000)
    theirs, _ = peer.PyGeodesicAlgorithmExact(mesh.vertices, mesh.faces).geodesicDistances(np.array([7]), None)
    found = roundel.geodesic_distance(mesh, vertices=[7]).distances
    assert np.allclose(found, theirs, rtol=1e-6, atol=1e-6 * found.max())
