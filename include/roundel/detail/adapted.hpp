/// What adapters share: a mesh library's elements beside the mesh that was read off them.

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

/// A mesh and the elements of another library that it was read from. Deleted elements are left out,
/// so that number i here may be another than the library's own: `faces[i]` is its handle.
template <class Vertex, class Face, class Halfedge> struct Adapted {
    Mesh mesh{};
    std::vector<Vertex> vertices{};
    std::vector<Face> faces{};
    /// Three half-edges a face, the first edge's first. Angles of the face count from it.
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

    /// The elements that the field's numbers stand for.
    const Elements& elements() const noexcept { return elements_; }

    /// The half-edge of every edge in its first face. Period jumps and kappa go over it, from its
    /// own face to the opposite one.
    std::vector<Halfedge> edge_halfedges(Status* status = nullptr) const {
        const auto face_edges = elements_.mesh.face_edges(status);
        std::vector<Halfedge> first;
        first.reserve(period_jumps().size());
        for (std::size_t side = 0; side < face_edges.size(); ++side) {
            // Edges are numbered by the side that comes first.
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

    /// The elements that the map's numbers stand for.
    const Elements& elements() const noexcept { return elements_; }

    /// Faces that are turned over or collapsed.
    std::vector<Face> flipped() const { return named(Map::flipped(), elements_.faces); }

    /// Irregular vertices, around which coordinates turn.
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

/// The arrays that a mesh is made of.
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

/// Hands u and v of every corner to the half-edge of its face that ends there.
template <class Vertex, class Face, class Halfedge, class At>
void hand_out(const AdaptedMap<Vertex, Face, Halfedge>& map, At at) {
    const auto& sides = map.elements().halfedges;
    const auto uv = map.corner_uvs();
    for (std::size_t side = 0; side < sides.size(); ++side) {
        const std::size_t end = side % 3 == 2 ? side - 2 : side + 1;
        at(sides[side], uv[2 * end], uv[2 * end + 1]);
    }
}

/// Hands every number of a field to the library's own properties. `over` takes a half-edge with
/// its jump and kappa and is called for both of an edge; going back undoes going there.
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
