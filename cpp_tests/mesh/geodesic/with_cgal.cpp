// Exact geodesic distances against CGAL's shortest paths, with exact predicates, on files of
// meshes.
//
// Usage: geodesic_with_cgal FOLDER NAME...

#include "../../cpp/check.hpp"
#include "../surface_mesh.hpp"

#include <roundel/cgal.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;
using Paths = CGAL::Surface_mesh_shortest_path<Traits>;

double seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The largest relative difference of distances from one vertex.
void compare(const std::string& name, const roundel::Mesh& from) {
    Mesh mesh = surface_mesh<Kernel>(from);
    const auto source = static_cast<std::int32_t>(from.vertices() / 3);
    const auto map = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance").first;
    roundel::Sources sources;
    sources.add_vertex(source);
    const double start = seconds();
    CHECK(roundel::store_distance(mesh, sources, map));
    const double middle = seconds();
    Paths paths(mesh);
    paths.add_source_point(Mesh::Vertex_index(static_cast<Mesh::size_type>(source)));
    paths.build_sequence_tree();
    double worst = 0.0;
    std::size_t unreached = 0;
    for (const auto vertex : mesh.vertices()) {
        const double peer = paths.shortest_distance_to_source_points(vertex).first;
        const double own = map[vertex];
        if (peer < 0.0 || std::isinf(own)) {
            CHECK(peer < 0.0 && std::isinf(own));
            ++unreached;
        } else if (peer > 0.0) {
            worst = std::fmax(worst, std::fabs(own - peer) / peer);
        }
    }
    const double end = seconds();
    std::printf("%-26s %7zu faces  difference %8.1e  unreached %zu  seconds %.3f and %.3f\n",
                name.c_str(), from.faces(), worst, unreached, middle - start, end - middle);
    CHECK(worst < 1e-9);
}

} // namespace

int main(int count, char** arguments) {
    for (int i = 2; i < count; ++i) {
        const std::string name = arguments[i];
        const auto colon = name.find(':');
        if (colon != std::string::npos) {
            compare(name, roundel::Mesh::shape(name.substr(0, colon),
                                               std::stoul(name.substr(colon + 1))));
        } else {
            compare(name, roundel::Mesh::read(std::string(arguments[1]) + "/" + name + ".off"));
        }
    }
    return failures != 0;
}
