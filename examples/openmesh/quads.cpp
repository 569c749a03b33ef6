/// Reads a triangle mesh with OpenMesh, makes quads of it, and writes a polygonal mesh.
///
///     quads [FLAGS] IN OUT        files of any format that OpenMesh knows
///
///     --quads N            about so many quads; 1000 by default
///     --edge-length L      edges of this length instead
///     --features DEGREES   edges at which the surface turns by so much are edges of quads
///     --adapt A            quads get smaller where the surface curves, from 0 to 1
///     --mirror PLANE       symmetric about x, y, z or auto; may be repeated
///
/// The mesh is repaired first, and what was done is told. The exit status is 1 if a file cannot be
/// read or written or if there is no surface in it, 2 for a wrong command line, and 6 for quads
/// that do not conform.

#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <roundel/openmesh.hpp>

namespace {

using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

struct CommandLine {
    std::vector<std::string> files;
    std::vector<std::string> planes;
    roundel::QuadOptions options;
};

/// A number that is the whole word.
bool read(const char* word, double& value) {
    char* end = nullptr;
    value = std::strtod(word, &end);
    return end != word && *end == '\0';
}

/// Whether the command line could be read.
bool read(int argc, char** argv, CommandLine& line) {
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag.rfind("--", 0) != 0) {
            line.files.push_back(flag);
            continue;
        }
        if (++i == argc) {
            return false;
        }
        double value = 0;
        if (flag == "--mirror") {
            line.planes.emplace_back(argv[i]);
        } else if (!read(argv[i], value)) {
            return false;
        } else if (flag == "--quads" && value >= 1 && value < 1e9) {
            line.options.set_quads(static_cast<std::int64_t>(value));
        } else if (flag == "--edge-length") {
            line.options.set_edge_length(value);
        } else if (flag == "--features") {
            line.options.set_features(roundel::feature_angle(value));
        } else if (flag == "--adapt") {
            line.options.set_adapt(value);
        } else {
            return false;
        }
    }
    line.options.set_mirror(line.planes);
    return line.files.size() == 2;
}

/// The mesh as OpenMesh holds it, as a soup: OpenMesh parts non-manifold edges, and repair joins
/// what belongs together.
roundel::Soup soup_of(const PolyMesh& mesh) {
    std::vector<double> vertices;
    std::vector<std::int32_t> sizes;
    std::vector<std::int64_t> corners;
    for (const auto vertex : mesh.vertices()) {
        const auto& p = mesh.point(vertex);
        vertices.insert(vertices.end(), {p[0], p[1], p[2]});
    }
    for (const auto face : mesh.faces()) {
        sizes.push_back(0);
        for (const auto vertex : mesh.fv_range(face)) {
            corners.push_back(vertex.idx());
            ++sizes.back();
        }
    }
    return roundel::Soup(vertices, sizes, corners);
}

} // namespace

int main(int argc, char** argv) {
    CommandLine line;
    if (!read(argc, argv, line)) {
        std::cerr << "usage: quads [--quads N | --edge-length L] [--features DEGREES] [--adapt A] "
                     "[--mirror PLANE]... IN OUT\n";
        return 2;
    }
    const std::string& in = line.files[0];
    const std::string& out = line.files[1];
    PolyMesh mesh;
    if (!OpenMesh::IO::read_mesh(mesh, in)) {
        std::cerr << in << ": not read\n";
        return 1;
    }
    try {
        const roundel::Repair repaired = roundel::repair(soup_of(mesh));
        if (!repaired.summary().empty()) {
            std::cout << repaired.summary() << '\n';
        }
        const auto quads = roundel::quadrangulate(repaired.mesh(), line.options);
        const auto made = roundel::mesh_of<PolyMesh>(quads);
        if (!OpenMesh::IO::write_mesh(made, out)) {
            std::cerr << out << ": not written\n";
            return 1;
        }
        std::cout << quads.size() << " quads, " << quads.irregular_count() << " irregular, "
                  << (quads.conforming() ? "conforming" : "not conforming") << '\n';
        return quads.conforming() ? 0 : 6;
    } catch (const roundel::Error& error) {
        std::cerr << in << ": " << error.what() << '\n';
        return 1;
    }
}
