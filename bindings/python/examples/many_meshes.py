"""Quadrangulates many meshes in parallel, with Dask.

    python many_meshes.py --quads 1000 --out quads *.obj

Each mesh has a thread. The library releases Python's lock while it works, so threads suffice and
nothing is copied between processes. Without files the program uses a few procedural shapes.
"""

import argparse
from pathlib import Path

import dask.bag
import roundel

SHAPES = ("rounded-cube", "sphere", "torus", "genus-2", "gear", "plane")


def quadrangulate(name, quads, out):
    """Quadrangulates one mesh. Returns its name, and the number of quads or the error."""
    try:
        mesh = roundel.Mesh.shape(name, 2000) if name in SHAPES else roundel.Mesh.read(name)
        found = roundel.quad(mesh, quads=quads)
        if out is not None:
            found.write(Path(out) / f"{Path(name).stem}.obj")
        return name, len(found), None
    except roundel.Error as error:
        return name, 0, f"{error.code}: {error}"


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*", default=SHAPES)
    parser.add_argument("--quads", type=int, default=1000)
    parser.add_argument("--out", type=Path, help="folder for the quads, as OBJ")
    given = parser.parse_args(arguments)
    if given.out is not None:
        given.out.mkdir(parents=True, exist_ok=True)
    meshes = dask.bag.from_sequence(given.meshes, partition_size=1)
    made = meshes.map(quadrangulate, given.quads, given.out).compute(scheduler="threads")
    for name, count, wrong in made:
        print(f"{name:20} {count} quads" if wrong is None else f"{name:20} {wrong}")
    return made


if __name__ == "__main__":
    main()
