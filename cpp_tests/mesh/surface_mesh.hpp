// A mesh as CGAL's Surface_mesh, with the same numbers.

#ifndef SURFACE_MESH_HPP
#define SURFACE_MESH_HPP

#include <roundel/roundel.hpp>

#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <cstdint>

template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> surface_mesh(const roundel::Mesh& from) {
    using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
    Mesh mesh;
    const auto xyz = from.coordinates();
    const auto corners = from.corners();
    const auto vertex = [](std::int32_t v) {
        return typename Mesh::Vertex_index(static_cast<typename Mesh::size_type>(v));
    };
    for (std::size_t v = 0; v < xyz.size(); v += 3) {
        mesh.add_vertex(typename Kernel::Point_3(xyz[v], xyz[v + 1], xyz[v + 2]));
    }
    for (std::size_t f = 0; f < corners.size(); f += 3) {
        mesh.add_face(vertex(corners[f]), vertex(corners[f + 1]), vertex(corners[f + 2]));
    }
    return mesh;
}

#endif
