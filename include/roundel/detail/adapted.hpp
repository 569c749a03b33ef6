/// Code that the adapters share: elements of another mesh library and the mesh that was made of
/// them.

#ifndef ROUNDEL_DETAIL_ADAPTED_HPP
#define ROUNDEL_DETAIL_ADAPTED_HPP

#include <roundel/detail/field.hpp>
#include <roundel/detail/map.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A mesh and the elements of another library that it was made of. Deleted elements are skipped, so
/// face i here may have another number in the library: `faces[i]` is its handle.
template <class Vertex, class Face, class Halfedge> struct Adapted {
    Mesh mesh{};
    std::vector<Vertex> vertices{};
    std::vector<Face> faces{};
    /// Three half-edges for each face, starting with its first edge, from which its angles are
    /// measured.
    std::vector<Halfedge> halfedges{};

    explicit operator bool() const noexcept { return static_cast<bool>(mesh); }
};

/// A field on a mesh of another library.
template <class Vertex, class Face, class Halfedge> class AdaptedField : public Field {
  public:
    using Elements = Adapted<Vertex, Face, Halfedge>;

    AdaptedField() = default;
    AdaptedField(Field field, Elements elements)
        : Field(std::move(field)), elements_(std::move(elements)) {}

    /// The elements to which the field's numbers refer.
    const Elements& elements() const noexcept { return elements_; }

    /// For every edge the half-edge in its first face. Period jumps and kappa go from the face of
    /// that half-edge to the opposite face.
    std::vector<Halfedge> edge_halfedges(Status* status = nullptr) const {
        const auto face_edges = elements_.mesh.face_edges(status);
        std::vector<Halfedge> first;
        first.reserve(period_jumps().size());
        for (std::size_t side = 0; side < face_edges.size(); ++side) {
            // Edges are numbered in the order of their first sides.
            if (static_cast<std::size_t>(face_edges[side]) == first.size()) {
                first.push_back(elements_.halfedges[side]);
            }
        }
        return first;
    }

  private:
    Elements elements_;
};

/// A map of a mesh of another library.
template <class Vertex, class Face, class Halfedge> class AdaptedMap : public Map {
  public:
    using Elements = Adapted<Vertex, Face, Halfedge>;

    AdaptedMap() = default;
    AdaptedMap(Map map, Elements elements) : Map(std::move(map)), elements_(std::move(elements)) {}

    /// The elements to which the map's numbers refer.
    const Elements& elements() const noexcept { return elements_; }

    /// Faces that are flipped or collapsed.
    std::vector<Face> flipped() const { return named(Map::flipped(), elements_.faces); }

    /// The cones of the map, which are the irregular vertices of the field.
    std::vector<Vertex> cones() const { return named(Map::cones(), elements_.vertices); }

  private:
    template <class T>
    static std::vector<T> named(span<const std::int32_t> numbers, const std::vector<T>& elements) {
        std::vector<T> found;
        found.reserve(numbers.size());
        for (const auto number : numbers) {
            found.push_back(elements[static_cast<std::size_t>(number)]);
        }
        return found;
    }

    Elements elements_;
};

namespace detail {

/// The arrays from which a mesh is made.
struct Soup {
    std::vector<double> coordinates{};
    std::vector<std::int64_t> corners{};

    Mesh mesh(Status* status) const {
        return Mesh(span<const double>(coordinates.data(), coordinates.size()),
                    span<const std::int64_t>(corners.data(), corners.size()), status);
    }
};

inline void not_a_triangle(std::size_t face, Status* status) {
    Status failure;
    failure.code = ROUNDEL_ERROR_NOT_A_TRIANGLE;
    failure.message = "face " + std::to_string(face) + " is not a triangle";
    failure.index = static_cast<std::int64_t>(face);
    fail(std::move(failure), status);
}

template <class Vertex, class Face, class Halfedge>
AdaptedField<Vertex, Face, Halfedge> field_of(Adapted<Vertex, Face, Halfedge> elements,
                                              const FieldOptions& options, Status* status) {
    if (!elements) {
        return {};
    }
    Field field = orientation_field(elements.mesh, options, status);
    return {std::move(field), std::move(elements)};
}

template <class Vertex, class Face, class Halfedge>
AdaptedMap<Vertex, Face, Halfedge> map_of(Adapted<Vertex, Face, Halfedge> elements,
                                          const Field& field, const MapOptions& options,
                                          Status* status) {
    if (!elements) {
        return {};
    }
    Map map = parametrize(elements.mesh, field, options, status);
    return {std::move(map), std::move(elements)};
}

/// Passes u and v of every corner to the half-edge of its face that ends there.
template <class Vertex, class Face, class Halfedge, class At>
void hand_out(const AdaptedMap<Vertex, Face, Halfedge>& map, At at) {
    const auto& sides = map.elements().halfedges;
    const auto uv = map.corner_uvs();
    for (std::size_t side = 0; side < sides.size(); ++side) {
        const std::size_t end = side % 3 == 2 ? side - 2 : side + 1;
        at(sides[side], uv[2 * end], uv[2 * end + 1]);
    }
}

/// Passes every number of a field to the library's own properties. `over` receives a half-edge with
/// its jump and kappa, and is called for both half-edges of an edge, with opposite signs.
template <class Vertex, class Face, class Halfedge, class Opposite, class AtFace, class AtVertex,
          class Over>
void hand_out(const AdaptedField<Vertex, Face, Halfedge>& field, Opposite opposite, AtFace at_face,
              AtVertex at_vertex, Over over) {
    const auto& elements = field.elements();
    const auto angles = field.angles();
    for (std::size_t f = 0; f < angles.size(); ++f) {
        at_face(elements.faces[f], angles[f]);
    }
    const auto indices = field.vertex_indices();
    for (std::size_t v = 0; v < indices.size(); ++v) {
        at_vertex(elements.vertices[v], indices[v]);
    }
    const auto first = field.edge_halfedges();
    const auto jumps = field.period_jumps();
    const auto kappa = field.kappa();
    for (std::size_t e = 0; e < first.size(); ++e) {
        over(first[e], jumps[e], kappa[e]);
        over(opposite(first[e]), -jumps[e], -kappa[e]);
    }
}

} // namespace detail

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_ADAPTED_HPP
