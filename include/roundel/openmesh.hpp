/// Roundel for OpenMesh: fields, maps and quads of its meshes, with results in properties.
///
///     auto field = roundel::orientation_field(mesh, {.constrain_curvature = 0.1});
///     auto p = roundel::store(field, mesh);
///     for (auto face : mesh.faces()) std::cout << mesh.property(p.angle, face) << '\n';
///     auto map = roundel::parametrize(mesh, field, {.quads = 2000});
///     auto uv = roundel::store(map, mesh);
///     if (!map.valid()) for (auto face : map.flipped()) mark(face);
///
/// For every mesh type of OpenMesh whose faces are triangles. Elements marked as deleted are
/// skipped, so no garbage collection is needed. The first edge of a face is its halfedge_handle.

#ifndef ROUNDEL_OPENMESH_HPP
#define ROUNDEL_OPENMESH_HPP

#include <roundel/detail/adapted.hpp>
#include <roundel/roundel.hpp>

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

namespace openmesh {

using Elements = Adapted<OpenMesh::VertexHandle, OpenMesh::FaceHandle, OpenMesh::HalfedgeHandle>;
using Field = AdaptedField<OpenMesh::VertexHandle, OpenMesh::FaceHandle, OpenMesh::HalfedgeHandle>;
using Map = AdaptedMap<OpenMesh::VertexHandle, OpenMesh::FaceHandle, OpenMesh::HalfedgeHandle>;

template <class M>
using enable = std::enable_if_t<std::is_base_of_v<OpenMesh::PolyConnectivity, M>, int>;

/// The properties of a field on a mesh, under the names "roundel:angle", "roundel:period_jump",
/// "roundel:kappa" and "roundel:index".
struct Properties {
    /// The angle of one arm of the face's cross, from its halfedge_handle.
    OpenMesh::FPropHandleT<double> angle;
    /// For a half-edge of face f opposite to face g, the arm of g with angle + kappa + pi/2 jump
    /// matches the arm of f. Zero at the boundary.
    OpenMesh::HPropHandleT<std::int32_t> period_jump;
    /// The angle of the frame of the half-edge's face in that of the opposite face.
    OpenMesh::HPropHandleT<double> kappa;
    /// The index in full turns; zero at the boundary.
    OpenMesh::VPropHandleT<double> index;
};

} // namespace openmesh

/// The triangles of an OpenMesh mesh that are not deleted.
template <class M, openmesh::enable<M> = 0>
openmesh::Elements adapt(const M& mesh, Status* status = nullptr) {
    openmesh::Elements elements;
    detail::Soup soup;
    std::vector<std::int64_t> number(mesh.n_vertices(), -1);
    // The skipping iterators leave out deleted elements.
    for (auto it = mesh.vertices_sbegin(); it != mesh.vertices_end(); ++it) {
        const OpenMesh::VertexHandle vertex = *it;
        number[static_cast<std::size_t>(vertex.idx())] =
            static_cast<std::int64_t>(elements.vertices.size());
        elements.vertices.push_back(vertex);
        const auto& point = mesh.point(vertex);
        for (unsigned axis = 0; axis < 3; ++axis) {
            soup.coordinates.push_back(static_cast<double>(point[axis]));
        }
    }
    for (auto it = mesh.faces_sbegin(); it != mesh.faces_end(); ++it) {
        const OpenMesh::FaceHandle face = *it;
        OpenMesh::HalfedgeHandle side = mesh.halfedge_handle(face);
        for (int k = 0; k < 3; ++k) {
            elements.halfedges.push_back(side);
            soup.corners.push_back(
                number[static_cast<std::size_t>(mesh.from_vertex_handle(side).idx())]);
            side = mesh.next_halfedge_handle(side);
        }
        if (side != mesh.halfedge_handle(face)) {
            detail::not_a_triangle(elements.faces.size(), status);
            return {};
        }
        elements.faces.push_back(face);
    }
    elements.mesh = soup.mesh(status);
    return elements;
}

/// Writes the exact distance along the surface from sources to the vertex property
/// "roundel:distance", which is added if it does not exist. Sources number vertices and faces
/// without the deleted ones.
template <class M, openmesh::enable<M> = 0>
OpenMesh::VPropHandleT<double> store_distance(M& mesh, const Sources& sources,
                                              const GeodesicOptions& options = {},
                                              Status* status = nullptr) {
    OpenMesh::VPropHandleT<double> to;
    const auto elements = adapt(mesh, status);
    if (!elements) {
        return to;
    }
    const auto found = geodesic_distance(elements.mesh, sources, options, status);
    if (!found) {
        return to;
    }
    if (!mesh.get_property_handle(to, "roundel:distance")) {
        mesh.add_property(to, "roundel:distance");
    }
    for (std::size_t i = 0; i < elements.vertices.size(); ++i) {
        mesh.property(to, elements.vertices[i]) = found.distances()[i];
    }
    return to;
}

/// The smoothest field of an OpenMesh mesh that satisfies the constraints. Their faces are numbered
/// without the deleted ones.
template <class M, openmesh::enable<M> = 0>
openmesh::Field orientation_field(const M& mesh, const FieldOptions& options = {},
                                  Status* status = nullptr) {
    return detail::field_of(adapt(mesh, status), options, status);
}

/// Writes a field to properties of the mesh that it was computed on. Properties that do not exist
/// are added.
template <class M, openmesh::enable<M> = 0>
openmesh::Properties store(const openmesh::Field& field, M& mesh) {
    openmesh::Properties to;
    const auto find = [&](auto& handle, const char* name) {
        if (!mesh.get_property_handle(handle, name)) {
            mesh.add_property(handle, name);
        }
    };
    find(to.angle, "roundel:angle");
    find(to.period_jump, "roundel:period_jump");
    find(to.kappa, "roundel:kappa");
    find(to.index, "roundel:index");
    detail::hand_out(
        field, [&](OpenMesh::HalfedgeHandle h) { return mesh.opposite_halfedge_handle(h); },
        [&](OpenMesh::FaceHandle f, double angle) { mesh.property(to.angle, f) = angle; },
        [&](OpenMesh::VertexHandle v, double index) { mesh.property(to.index, v) = index; },
        [&](OpenMesh::HalfedgeHandle h, std::int32_t jump, double kappa) {
            mesh.property(to.period_jump, h) = jump;
            mesh.property(to.kappa, h) = kappa;
        });
    return to;
}

/// The seamless map of an OpenMesh mesh that follows a field computed on it.
template <class M, openmesh::enable<M> = 0>
openmesh::Map parametrize(const M& mesh, const openmesh::Field& field,
                          const MapOptions& options = {}, Status* status = nullptr) {
    return detail::map_of(adapt(mesh, status), field, options, status);
}

/// Writes a map to the half-edge property "roundel:uv" of the mesh that it was computed on, which
/// is added if it does not exist. As with OpenMesh's texture coordinates, a half-edge has the
/// coordinates of the vertex that it points to, in its own face.
template <class M, openmesh::enable<M> = 0>
OpenMesh::HPropHandleT<OpenMesh::Vec2d> store(const openmesh::Map& map, M& mesh) {
    OpenMesh::HPropHandleT<OpenMesh::Vec2d> uv;
    if (!mesh.get_property_handle(uv, "roundel:uv")) {
        mesh.add_property(uv, "roundel:uv");
    }
    detail::hand_out(map, [&](OpenMesh::HalfedgeHandle side, double u, double v) {
        mesh.property(uv, side) = OpenMesh::Vec2d(u, v);
    });
    return uv;
}

/// Quadrangulates an OpenMesh mesh. `roundel::mesh_of<PolyMesh>` converts the result to a mesh.
template <class M, openmesh::enable<M> = 0>
Quads quadrangulate(const M& mesh, const QuadOptions& options = {}, Status* status = nullptr) {
    const auto elements = adapt(mesh, status);
    return elements ? quadrangulate(elements.mesh, options, status) : Quads();
}

namespace detail {

template <class M>
struct FromPolygons<M, std::enable_if_t<std::is_base_of_v<OpenMesh::PolyConnectivity, M>>> {
    template <class Point>
    static M make(std::size_t count, Point point,
                  const std::vector<std::vector<std::int32_t>>& faces) {
        static_assert(!M::is_trimesh(), "quads need a polygonal mesh type");
        using Scalar = typename M::Point::value_type;
        M mesh;
        std::vector<OpenMesh::VertexHandle> vertices;
        for (std::size_t i = 0; i < count; ++i) {
            const auto p = point(i);
            vertices.push_back(mesh.add_vertex(
                {static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2])}));
        }
        for (const auto& face : faces) {
            std::vector<OpenMesh::VertexHandle> corners;
            for (const auto corner : face) {
                corners.push_back(vertices[static_cast<std::size_t>(corner)]);
            }
            mesh.add_face(corners);
        }
        return mesh;
    }
};

} // namespace detail

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_OPENMESH_HPP
