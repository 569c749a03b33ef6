"""The quads that are made when nothing is said are those of the program, to the byte.

Rust is held against the program by `cli/tests/program/same_quads.rs`, C and C++ by `cpp_tests`, on
the same meshes. ROUNDEL_PROGRAM names the program; `scripts/test-python` builds it.
"""

import os
import subprocess

import pytest

import roundel

PROGRAM = os.environ.get("ROUNDEL_PROGRAM")


@pytest.mark.skipif(PROGRAM is None, reason="ROUNDEL_PROGRAM does not name the program")
@pytest.mark.parametrize(
    "shape, triangles", [("gear", 4000), ("rounded-cube", 2000), ("plate-with-holes", 1200)]
)
def test_quads_of_a_mesh_are_the_same_from_the_program_and_from_python(tmp_path, shape, triangles):
    mesh, reference, ours = (tmp_path / name for name in ("mesh.obj", "quads.obj", "ours.obj"))
    subprocess.run([PROGRAM, "shape", shape, "--triangles", str(triangles), "-o", mesh], check=True)
    subprocess.run([PROGRAM, "quad", mesh, "-o", reference], check=True)
    read = roundel.Mesh.read(mesh)
    for made in (roundel.quad(read), roundel.quad(read.vertices, read.faces)):
        assert made.conforming
        made.write(ours)
        assert ours.read_bytes() == reference.read_bytes()
