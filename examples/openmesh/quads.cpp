/// Reads a triangle mesh with OpenMesh, quadrangulates it, and writes a polygonal mesh.
///
///     quads IN OUT [QUADS] [FEATURE_ANGLE]        files of any format that OpenMesh knows
///
/// The exit status is 1 if a file cannot be read or written or if the mesh is refused, with the
/// element at fault, and 2 for a wrong command line.

#include <cstdlib>
#include <iostream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <roundel/openmesh.hpp>

using TriMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

int main(int argc, char** argv) {
    if (argc < 3 || argc > 5) {
        std::cerr << "usage: quads IN OUT [QUADS] [FEATURE_ANGLE]\n";
        return 2;
    }
    TriMesh mesh;
    if (!OpenMesh::IO::read_mesh(mesh, argv[1])) {
        std::cerr << argv[1] << ": not read\n";
        return 1;
    }
    roundel::QuadOptions options;
    if (argc > 3) {
        options.set_quads(std::strtoul(argv[3], nullptr, 10));
    }
    if (argc > 4) {
        options.set_features(roundel::feature_angle(std::strtod(argv[4], nullptr)));
    }
    try {
        const auto quads = roundel::quadrangulate(mesh, options);
        const auto made = roundel::mesh_of<PolyMesh>(quads);
        if (!OpenMesh::IO::write_mesh(made, argv[2])) {
            std::cerr << argv[2] << ": not written\n";
            return 1;
        }
        std::cout << quads.size() << " quads, " << quads.irregular_count() << " irregular, "
                  << (quads.conforming() ? "conforming" : "not conforming") << '\n';
    } catch (const roundel::Error& error) {
        std::cerr << argv[1] << ": " << error.what() << '\n';
        return 1;
    }
    return 0;
}
