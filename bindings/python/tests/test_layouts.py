"""Quads that follow a base layout."""

import numpy as np
import pytest
import roundel

CORNERS = [[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
SIDES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def test_quads_follow_a_layout(tmp_path):
    file = tmp_path / "cube.obj"
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
    file.write_text(vertices + "".join("f " + " ".join(str(v + 1) for v in side) + "\n" for side in SIDES))
    sphere = roundel.Mesh.shape("sphere", 600)
    for cube in (roundel.BaseLayout(CORNERS, SIDES), roundel.BaseLayout.read(file)):
        assert cube.arcs.shape == (12, 2)
        cube.fix_arc(0, 4)
        quads, numbers = cube.quads(sphere, 150)
        assert quads.conforming and quads.irregular_count == 8
        assert numbers[0] == 4 and numbers.min() > 0
        cube.fix_arc(0, 0)
        cube.draw_arc(0, [[-1, -1, -1], [-0.7, 0, -0.7], [-1, 1, -1]])
        for held in (False, True):
            cube.hold_arcs(held)
            fewest, numbers = cube.quads(sphere, 0)
            assert len(fewest) == 6 and np.all(numbers == 1)


def test_quads_have_a_layout_that_leads_back_to_quads(tmp_path):
    sphere = roundel.Mesh.shape("sphere", 1000)
    made = roundel.quad(sphere, quads=300)
    whole = roundel.BaseLayout.of_quads(*made)
    fewer = roundel.BaseLayout.of_quads(roundel.Soup(*made), deviation=float("inf"))
    assert 6 <= len(fewer.soup) <= len(whole.soup)
    fewer.write(tmp_path / "layout.obj")
    for layout in (fewer, roundel.BaseLayout.read(tmp_path / "layout.obj")):
        quads, numbers = layout.quads(sphere, 600)
        assert quads.conforming and quads.irregular_count == 8 and numbers.min() > 0
    with pytest.raises(roundel.Error) as caught:
        roundel.BaseLayout.of_quads(CORNERS, [[0, 2, 3, 1], [0, 1, 5]])
    assert caught.value.index == 1


def test_what_is_wrong_names_the_element():
    cube = roundel.BaseLayout(CORNERS, SIDES)
    for call, index in [
        (lambda: roundel.BaseLayout(CORNERS, [[0, 1]]), 0),
        (lambda: roundel.BaseLayout(CORNERS, [[0, 1, 8]]), 0),
        (lambda: roundel.BaseLayout([[0, 0, float("nan")]] * 3, [[0, 1, 2]]), 0),
        (lambda: cube.fix_arc(1, -1), 1),
    ]:
        with pytest.raises(roundel.Error) as caught:
            call()
        assert caught.value.index == index
    with pytest.raises(roundel.Error):
        cube.quads(roundel.Mesh.shape("torus", 300), 100)
