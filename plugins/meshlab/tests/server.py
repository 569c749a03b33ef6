"""Runs the plugin in Debian's MeshLab: meshlabserver applies filter scripts to real meshes, and the quads
must equal those of `roundel quad` with the same options, corner for corner.

meshlabserver looks for plugins beside its own file. So the test copies the program into a folder, with
links to MeshLab's library, its mesh reader and our plugin. MeshLab stores coordinates in single
precision. So `roundel quad` gets the mesh that MeshLab wrote, and its results are rounded to single
precision before they are compared.
"""

import argparse
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

FILTER = "Remeshing: Mixed-Integer Quadrangulation (Roundel)"

# meshlabserver aborts if a script leaves a parameter to its default. MeshLab writes all parameters, and
# so does this test.
DEFAULTS = {
    "Size": ("RichEnum", 0),
    "Quads": ("RichInt", 1000),
    "GradientSize": ("RichFloat", 30),
    "EdgeLength": ("RichAbsPerc", 1),
    "FeatureAngle": ("RichFloat", 0),
    "Boundary": ("RichBool", "true"),
    "Detail": ("RichFloat", -1),
    "Strategy": ("RichEnum", 0),
    "FieldStrategy": ("RichEnum", 1),
    "Untangle": ("RichBool", "true"),
    "Smooth": ("RichBool", "true"),
    "SolverOptions": ("RichString", ""),
}

# A mesh, parameters of the filter, and the equivalent flags of the program.
CASES = [
    ("rotor.off", {}, []),
    (
        "fandisk.off",
        {"Quads": 800, "FeatureAngle": 40, "Detail": 0.01},
        ["--quads", "800", "--features", "40", "--detail", "0.01"],
    ),
    (
        "three_peaks.off",
        {
            "Size": 2,
            "EdgeLength": 0.8,
            "Boundary": "false",
            "Strategy": 2,
            "FieldStrategy": 0,
            "Smooth": "false",
            "SolverOptions": "threads=1 beam_width=4",
        },
        ["--edge-length", "0.8", "--free-boundary", "--strategy", "greedy", "--field-strategy"]
        + ["lattice", "--no-smooth", "--threads", "1", "--beam-width", "4"],
    ),
]


def main():
    parser = argparse.ArgumentParser()
    for name in ("plugin", "program", "meshes"):
        parser.add_argument("--" + name, type=Path, required=True)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        server = Server(Path(folder), given.plugin.resolve())
        for name, parameters, flags in CASES:
            same_quads(server, given.program, given.meshes / name, parameters, flags)
        a_bad_option_is_a_message(server, given.meshes / "rotor.off")


def same_quads(server, program, mesh, parameters, flags):
    held = server.folder / "held.ply"
    made = server.folder / "made.ply"
    server.run("-i", mesh, "-o", held)
    result = server.filter(mesh, parameters, "-o", made, "-l", "x", "-m", "ff")
    assert result.returncode == 0, result.stdout
    wanted = server.folder / "wanted.obj"
    subprocess.run([program, "quad", held, "-o", wanted, *flags], check=True, capture_output=True)
    vertices, faces = read_obj(wanted)
    singles = [struct.unpack("<3f", struct.pack("<3f", *at)) for at in vertices]
    found, polygons = read_ply(made)
    assert len(faces) > 100, faces
    assert polygons == faces, f"{mesh.name}: other faces"
    assert found == singles, f"{mesh.name}: other vertices"
    print(f"{mesh.name}: {len(faces)} faces, {len(found)} vertices, all equal")


def a_bad_option_is_a_message(server, mesh):
    result = server.filter(mesh, {"SolverOptions": "threads=-1"})
    assert result.returncode != 0
    assert "Roundel: " in result.stdout and "threads" in result.stdout, result.stdout
    print("a bad option is a message")


class Server:
    """meshlabserver with our plugin among its own plugins."""

    def __init__(self, folder, plugin):
        self.folder = folder
        installed = Path(shutil.which("meshlabserver")).resolve()
        [library] = installed.parent.parent.glob("lib/*/meshlab/libmeshlab-common.so")
        self.binary = folder / "bin" / "meshlabserver"
        self.binary.parent.mkdir()
        shutil.copy(installed, self.binary)
        beside = folder / library.parent.relative_to(installed.parent.parent)
        (beside / "plugins").mkdir(parents=True)
        (beside / library.name).symlink_to(library)
        for one in (library.parent / "plugins" / "libio_base.so", plugin):
            (beside / "plugins" / one.name).symlink_to(one)

    def run(self, *words):
        environment = {**os.environ, "HOME": str(self.folder), "XDG_RUNTIME_DIR": str(self.folder)}
        # When the time is up, this ends the display as well.
        command = ["timeout", "120", "xvfb-run", "-a", self.binary, *words]
        return subprocess.run(
            [str(word) for word in command],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def filter(self, mesh, parameters, *words):
        script = self.folder / "script.mlx"
        lines = []
        for name, (kind, default) in DEFAULTS.items():
            value = parameters.get(name, default)
            more = {"RichAbsPerc": ' min="0" max="1000"', "RichEnum": ' enum_cardinality="0"'}
            said = f'type="{kind}" name="{name}" value="{value}"{more.get(kind, "")}'
            lines.append(f"  <Param {said}/>")
        text = "\n".join([f' <filter name="{FILTER}">', *lines, " </filter>"])
        script.write_text(f"<!DOCTYPE FilterScript>\n<FilterScript>\n{text}\n</FilterScript>\n")
        return self.run("-i", mesh, "-s", script, *words)


def read_obj(file):
    """Vertices, and faces as lists of corners."""
    vertices, faces = [], []
    for line in file.read_text().splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append(tuple(map(float, rest)))
        elif word == "f":
            faces.append([int(corner.split("/")[0]) - 1 for corner in rest])
    return vertices, faces


# The bits of VCGlib's face flags for edges that lie inside a polygon.
FAUX = [1 << 18, 1 << 19, 1 << 20]


def read_ply(file):
    """The vertices, and the polygons that the triangles form when faux edges are left out."""
    head, body = file.read_bytes().split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    properties = [line.split()[1:] for line in lines if line.startswith("property")]
    assert properties[:3] == [["float", axis] for axis in "xyz"], properties
    assert properties[3:] == [["list", "uchar", "int", "vertex_indices"], ["int", "flags"]], properties
    vertices = list(struct.iter_unpack("<3f", body[: 12 * counts["vertex"]]))
    polygons = []
    is_open = False
    rest = body[12 * counts["vertex"] :]
    for size, a, b, c, flags in struct.iter_unpack("<B4i", rest[: 17 * counts["face"]]):
        assert size == 3
        first, second, third = (bool(flags & bit) for bit in FAUX)
        assert first == is_open and not second
        if is_open:
            assert [a, b] == [polygons[-1][0], polygons[-1][-1]]
            polygons[-1].append(c)
        else:
            polygons.append([a, b, c])
        is_open = third
    assert not is_open
    return vertices, polygons


if __name__ == "__main__":
    sys.exit(main())
