/// Roundel for CGAL: fields, maps and quads for every model of FaceGraph, with results in property
/// maps.
///
///     CGAL::Surface_mesh<Kernel::Point_3> mesh = ...;
///     auto field = roundel::orientation_field(mesh, {.constrain_curvature = 0.1});
///     auto p = roundel::store(field, mesh);
///     for (auto face : faces(mesh)) std::cout << p.angle[face] << '\n';
///     auto map = roundel::parametrize(mesh, field, {.quads = 2000});
///     auto uv = roundel::store(map, mesh);
///
/// Faces must be triangles. Elements marked as removed are skipped. The first edge of a face is its
/// halfedge(face, mesh).

#ifndef ROUNDEL_CGAL_HPP
#define ROUNDEL_CGAL_HPP

#include <roundel/detail/adapted.hpp>
#include <roundel/roundel.hpp>

#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace OpenMesh {
class PolyConnectivity;
}
namespace CGAL {
template <typename P> class Surface_mesh;
}

ROUNDEL_NAMESPACE_BEGIN

namespace cgal {

template <class G> using Vertex = typename boost::graph_traits<G>::vertex_descriptor;
template <class G> using Face = typename boost::graph_traits<G>::face_descriptor;
template <class G> using Halfedge = typename boost::graph_traits<G>::halfedge_descriptor;

template <class G> using Elements = Adapted<Vertex<G>, Face<G>, Halfedge<G>>;
template <class G> using Field = AdaptedField<Vertex<G>, Face<G>, Halfedge<G>>;
template <class G> using Map = AdaptedMap<Vertex<G>, Face<G>, Halfedge<G>>;

// A FaceGraph has faces(graph). boost::graph_traits does not compile for a type that is no graph.
// CGAL also makes FaceGraphs of OpenMesh's types, but those belong to openmesh.hpp.
template <class G>
using enable = std::enable_if_t<!std::is_base_of_v<OpenMesh::PolyConnectivity, G> &&
                                    sizeof(faces(std::declval<const G&>())) != 0,
                                int>;

/// The property maps of a field on a CGAL::Surface_mesh, under the names "f:roundel_angle",
/// "h:roundel_period_jump", "h:roundel_kappa" and "v:roundel_index".
template <class M> struct Properties {
    /// The angle of one arm of the face's cross, from its halfedge.
    typename M::template Property_map<Face<M>, double> angle;
    /// For a half-edge of face f opposite to face g, the arm of g with angle + kappa + pi/2 jump
    /// matches the arm of f. Zero at the boundary.
    typename M::template Property_map<Halfedge<M>, std::int32_t> period_jump;
    /// The angle of the frame of the half-edge's face in that of the opposite face.
    typename M::template Property_map<Halfedge<M>, double> kappa;
    /// The index in full turns; zero at the boundary.
    typename M::template Property_map<Vertex<M>, double> index;
};

} // namespace cgal

/// The triangles of a FaceGraph, with positions from `points`.
template <class G, class Points, cgal::enable<G> = 0>
cgal::Elements<G> adapt(const G& graph, const Points& points, Status* status) {
    cgal::Elements<G> elements;
    detail::Soup soup;
    std::unordered_map<cgal::Vertex<G>, std::int64_t> number;
    for (const auto vertex : vertices(graph)) {
        number.emplace(vertex, static_cast<std::int64_t>(elements.vertices.size()));
        elements.vertices.push_back(vertex);
        const auto& point = get(points, vertex);
        soup.coordinates.push_back(CGAL::to_double(point.x()));
        soup.coordinates.push_back(CGAL::to_double(point.y()));
        soup.coordinates.push_back(CGAL::to_double(point.z()));
    }
    for (const auto face : faces(graph)) {
        auto side = halfedge(face, graph);
        for (int k = 0; k < 3; ++k) {
            elements.halfedges.push_back(side);
            soup.corners.push_back(number.at(source(side, graph)));
            side = next(side, graph);
        }
        if (side != halfedge(face, graph)) {
            detail::not_a_triangle(elements.faces.size(), status);
            return {};
        }
        elements.faces.push_back(face);
    }
    elements.mesh = soup.mesh(status);
    return elements;
}

/// The triangles of a FaceGraph that stores its own positions.
template <class G, cgal::enable<G> = 0>
cgal::Elements<G> adapt(const G& graph, Status* status = nullptr) {
    return adapt(graph, get(CGAL::vertex_point, graph), status);
}

/// Writes the exact distance along the surface from sources to a writable property map of vertices.
/// Sources number vertices and faces in the order of vertices(graph) and faces(graph). Returns
/// whether it succeeded.
template <class G, class Distance, cgal::enable<G> = 0>
bool store_distance(const G& graph, const Sources& sources, Distance distance,
                    const GeodesicOptions& options = {}, Status* status = nullptr) {
    const auto elements = adapt(graph, status);
    if (!elements) {
        return false;
    }
    const auto found = geodesic_distance(elements.mesh, sources, options, status);
    if (!found) {
        return false;
    }
    for (std::size_t i = 0; i < elements.vertices.size(); ++i) {
        put(distance, elements.vertices[i], found.distances()[i]);
    }
    return true;
}

/// The smoothest field of a FaceGraph that satisfies the constraints. Their faces are numbered in
/// the order of faces(graph).
template <class G, cgal::enable<G> = 0>
cgal::Field<G> orientation_field(const G& graph, const FieldOptions& options = {},
                                 Status* status = nullptr) {
    return detail::field_of(adapt(graph, status), options, status);
}

/// Writes a field to writable property maps: one of faces, two of half-edges, one of vertices.
template <class G, class Angle, class Jump, class Kappa, class Index, cgal::enable<G> = 0>
void store(const cgal::Field<G>& field, const G& graph, Angle angle, Jump period_jump, Kappa kappa,
           Index index) {
    detail::hand_out(
        field, [&](const cgal::Halfedge<G>& h) { return opposite(h, graph); },
        [&](const cgal::Face<G>& f, double value) { put(angle, f, value); },
        [&](const cgal::Vertex<G>& v, double value) { put(index, v, value); },
        [&](const cgal::Halfedge<G>& h, std::int32_t jump, double turn) {
            put(period_jump, h, jump);
            put(kappa, h, turn);
        });
}

/// Writes a field to property maps of the CGAL::Surface_mesh that it was computed on. Property maps
/// that do not exist are added.
template <class P>
cgal::Properties<CGAL::Surface_mesh<P>> store(const cgal::Field<CGAL::Surface_mesh<P>>& field,
                                              CGAL::Surface_mesh<P>& mesh) {
    using M = CGAL::Surface_mesh<P>;
    cgal::Properties<M> to;
    to.angle = mesh.template add_property_map<cgal::Face<M>, double>("f:roundel_angle").first;
    to.period_jump =
        mesh.template add_property_map<cgal::Halfedge<M>, std::int32_t>("h:roundel_period_jump")
            .first;
    to.kappa = mesh.template add_property_map<cgal::Halfedge<M>, double>("h:roundel_kappa").first;
    to.index = mesh.template add_property_map<cgal::Vertex<M>, double>("v:roundel_index").first;
    store(field, mesh, to.angle, to.period_jump, to.kappa, to.index);
    return to;
}

/// The seamless map of a FaceGraph that follows a field computed on it.
template <class G, cgal::enable<G> = 0>
cgal::Map<G> parametrize(const G& graph, const cgal::Field<G>& field,
                         const MapOptions& options = {}, Status* status = nullptr) {
    return detail::map_of(adapt(graph, status), field, options, status);
}

/// Writes a map to a writable property map of half-edges. Its values are arrays of u and v: the
/// coordinates of the half-edge's target in the half-edge's face.
template <class G, class Uv, cgal::enable<G> = 0>
void store(const cgal::Map<G>& map, const G&, Uv uv) {
    detail::hand_out(map, [&](const cgal::Halfedge<G>& side, double u, double v) {
        put(uv, side, std::array<double, 2>{u, v});
    });
}

/// Writes a map to the property map "h:roundel_uv" of the CGAL::Surface_mesh that it was computed
/// on. The property map is added if it does not exist.
template <class P>
typename CGAL::Surface_mesh<P>::template Property_map<cgal::Halfedge<CGAL::Surface_mesh<P>>,
                                                      std::array<double, 2>>
store(const cgal::Map<CGAL::Surface_mesh<P>>& map, CGAL::Surface_mesh<P>& mesh) {
    using M = CGAL::Surface_mesh<P>;
    const auto uv =
        mesh.template add_property_map<cgal::Halfedge<M>, std::array<double, 2>>("h:roundel_uv")
            .first;
    store(map, mesh, uv);
    return uv;
}

/// Quadrangulates a FaceGraph. `roundel::mesh_of<CGAL::Surface_mesh<Point>>` converts the result to
/// a mesh.
template <class G, cgal::enable<G> = 0>
Quads quadrangulate(const G& graph, const QuadOptions& options = {}, Status* status = nullptr) {
    const auto elements = adapt(graph, status);
    return elements ? quadrangulate(elements.mesh, options, status) : Quads();
}

namespace detail {

template <class P> struct FromPolygons<CGAL::Surface_mesh<P>> {
    template <class Point>
    static CGAL::Surface_mesh<P> make(std::size_t count, Point point,
                                      const std::vector<std::vector<std::int32_t>>& faces) {
        using M = CGAL::Surface_mesh<P>;
        M mesh;
        std::vector<cgal::Vertex<M>> vertices;
        for (std::size_t i = 0; i < count; ++i) {
            const auto p = point(i);
            vertices.push_back(mesh.add_vertex(P(p[0], p[1], p[2])));
        }
        for (const auto& face : faces) {
            std::vector<cgal::Vertex<M>> corners;
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

#endif // ROUNDEL_CGAL_HPP
