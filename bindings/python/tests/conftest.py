"""Fixtures: a problem whose proof takes long, and a mesh."""

import numpy as np
import pytest

import roundel


@pytest.fixture(scope="session")
def endless():
    """A closest-vector problem whose optimum no machine proves in a minute."""
    draw = np.random.default_rng(1)
    count = 90
    basis = draw.integers(-9, 10, (count, count)) + 40.0 * np.eye(count)
    given = {"A": basis, "b": 1000.0 * draw.random(count), "integers": np.arange(count)}
    return {**given, "nodes": 10**13}


@pytest.fixture(scope="session")
def cube():
    """A rounded cube of about 600 triangles."""
    return roundel.Mesh.shape("rounded-cube", 600)
