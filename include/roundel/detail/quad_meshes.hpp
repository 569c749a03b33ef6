/// Quad meshes: what there is of them, their faults, and meshes of other libraries.

#ifndef ROUNDEL_DETAIL_QUAD_MESHES_HPP
#define ROUNDEL_DETAIL_QUAD_MESHES_HPP

#include <roundel/detail/features.hpp>
#include <roundel/detail/map.hpp>
#include <roundel/detail/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// The elements that keep quads from conforming.
struct QuadFaults {
    /// Faces that are not quads or have a vertex twice. The quads are numbered first, then the
    /// other faces.
    std::vector<std::int32_t> faces{};
    /// Edges, by their vertices, with more than two faces, or with two that run in the same
    /// direction.
    std::vector<std::array<std::int32_t, 2>> edges{};
    /// Vertices whose faces form more than one fan.
    std::vector<std::int32_t> vertices{};
    /// Triangles of the mesh that the map folds, which cause such faults.
    std::vector<std::int32_t> triangles{};
};

/// Quads with shared vertices, and other polygons where the map gives no quads.
class Quads {
  public:
    /// No quads: a call returns this when it reports a failure in a Status.
    Quads() noexcept = default;

    /// Takes ownership of quads of the C interface.
    explicit Quads(roundel_quads* owned, Status* status = nullptr) : handle_(owned) {
        read(status);
    }

    /// Whether there are quads.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// x, y, z of every vertex.
    span<const double> vertices() const& noexcept { return {vertices_.data(), vertices_.size()}; }
    span<const double> vertices() const&& = delete;

    /// The four corners of every quad, counter-clockwise seen from outside.
    span<const std::int32_t> corners() const& noexcept {
        return {corners_.data(), corners_.size()};
    }
    span<const std::int32_t> corners() const&& = delete;

    /// The number of quads.
    std::size_t size() const noexcept { return corners_.size() / 4; }

    /// The corners of every face that is not a quad.
    const std::vector<std::vector<std::int32_t>>& others() const& noexcept { return others_; }
    const std::vector<std::vector<std::int32_t>>& others() const&& = delete;

    /// Whether all faces are quads and the topology is that of the triangle mesh.
    bool conforming(Status* status = nullptr) const {
        std::int32_t value = 0;
        detail::check(roundel_quads_is_conforming(get(), &value), status);
        return value != 0;
    }

    /// The elements at fault if the quads do not conform.
    QuadFaults faults(Status* status = nullptr) const {
        QuadFaults found;
        std::size_t faces = 0, edges = 0, vertices = 0, triangles = 0;
        if (detail::check(roundel_quads_fault_counts(get(), &faces, &edges, &vertices, &triangles),
                          status)) {
            std::vector<std::int32_t> ends(2 * edges);
            found.faces.resize(faces);
            found.vertices.resize(vertices);
            found.triangles.resize(triangles);
            detail::check(roundel_quads_faults(get(), faces, found.faces.data(), edges, ends.data(),
                                               vertices, found.vertices.data(), triangles,
                                               found.triangles.data()),
                          status);
            for (std::size_t i = 0; i < ends.size(); i += 2) {
                found.edges.push_back({ends[i], ends[i + 1]});
            }
        }
        return found;
    }

    /// The number of vertices with other than four edges, or other than three on the boundary.
    std::size_t irregular_count(Status* status = nullptr) const {
        std::size_t value = 0;
        detail::check(roundel_quads_irregular_count(get(), &value), status);
        return value;
    }

    /// The number of irregular vertices of the field that lie nearer to features than an edge of
    /// the quads, or the clearance of the options, but not on them. Only of what quadrangulate
    /// made.
    std::size_t near_feature_count(Status* status = nullptr) const {
        std::size_t value = 0;
        detail::check(roundel_quads_near_feature_count(get(), &value), status);
        return value;
    }

    /// The number of triangles of the mesh whose quads are pairs of them, because no map had quads
    /// that conform and cover the surface there: 0 where all quads are those of a map.
    std::size_t paired_face_count(Status* status = nullptr) const {
        std::size_t value = 0;
        detail::check(roundel_quads_paired_face_count(get(), &value), status);
        return value;
    }

    /// Vertices minus edges plus faces.
    std::int64_t euler_characteristic(Status* status = nullptr) const {
        std::int64_t value = 0;
        detail::check(roundel_quads_euler_characteristic(get(), &value), status);
        return value;
    }

    /// Moves vertices on the mesh of which the quads were made, to make them more like squares of
    /// one size. Vertices on these features stay on them.
    Quads& smooth(const Mesh& mesh, const Features& features = {}, Status* status = nullptr) {
        const auto guidance = detail::guidance_with(features, status);
        if (guidance &&
            detail::check(roundel_quads_smooth(get(), mesh.get(), guidance.get(), nullptr),
                          status)) {
            read(status);
        }
        return *this;
    }

    /// The label of most of the area of `mesh` beneath each face: the quads, then the other faces.
    /// `labels` has a number from 0 on for each face of the mesh, or -1 for none.
    std::vector<std::int32_t> transfer_face_labels(const Mesh& mesh,
                                                   span<const std::int32_t> labels,
                                                   Status* status = nullptr) const {
        std::vector<std::int32_t> found(size() + others_.size());
        if (!detail::check(roundel_quads_transfer_face_labels(get(), mesh.get(), labels.data(),
                                                              labels.size(), nullptr, found.data(),
                                                              found.size()),
                           status)) {
            found.clear();
        }
        return found;
    }

    /// Numbers at every vertex, interpolated at the closest point of `mesh`, which has
    /// `components` of them for each vertex. NaN stands for none.
    std::vector<double> transfer_vertex_values(const Mesh& mesh, std::size_t components,
                                               span<const double> values,
                                               Status* status = nullptr) const {
        return carried(roundel_quads_transfer_vertex_values, mesh, components, values,
                       vertices_.size() / 3, status);
    }

    /// Numbers such as texture coordinates at the corners of all faces: four of each quad, then
    /// those of the other faces. `values` has `components` of them for each of the three corners
    /// of each face of `mesh`. A quad has those of one side of the seams. NaN stands for none.
    std::vector<double> transfer_corner_values(const Mesh& mesh, std::size_t components,
                                               span<const double> values,
                                               Status* status = nullptr) const {
        std::size_t corners = corners_.size();
        for (const auto& face : others_) {
            corners += face.size();
        }
        return carried(roundel_quads_transfer_corner_values, mesh, components, values, corners,
                       status);
    }

    /// Writes the faces as OBJ, OFF, PLY or USD text, by extension; as STL or glTF, triangles.
    void write(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_quads_write(get(), file.c_str()), status);
    }

    roundel_quads* get() const noexcept { return handle_.get(); }

  private:
    template <class Function>
    std::vector<double> carried(Function call, const Mesh& mesh, std::size_t components,
                                span<const double> values, std::size_t elements,
                                Status* status) const {
        // More components than that are refused before anything is written.
        const bool fits = components <= values.size();
        std::vector<double> found(fits ? components * elements : 0);
        if (!detail::check(call(get(), mesh.get(), components, values.data(), values.size(),
                                nullptr, found.data(), found.size()),
                           status)) {
            found.clear();
        }
        return found;
    }

    void read(Status* status) {
        std::size_t vertices = 0, quads = 0, count = 0, corners = 0;
        const auto told = [&](roundel_status code) { return detail::check(code, status); };
        if (!told(roundel_quads_vertex_count(get(), &vertices)) ||
            !told(roundel_quads_count(get(), &quads)) ||
            !told(roundel_quads_other_face_counts(get(), &count, &corners))) {
            return;
        }
        vertices_.resize(3 * vertices);
        corners_.resize(4 * quads);
        std::vector<std::int32_t> sizes(count), all(corners);
        if (!told(roundel_quads_coordinates(get(), vertices_.data(), vertices_.size())) ||
            !told(roundel_quads_corners(get(), corners_.data(), corners_.size())) ||
            !told(roundel_quads_other_faces(get(), count, sizes.data(), corners, all.data()))) {
            return;
        }
        others_.clear();
        auto from = all.begin();
        for (const auto size : sizes) {
            others_.emplace_back(from, from + size);
            from += size;
        }
    }

    detail::Handle<roundel_quads, roundel_quads_free> handle_;
    std::vector<double> vertices_;
    std::vector<std::int32_t> corners_;
    std::vector<std::vector<std::int32_t>> others_;
};

/// The quads of the last solve of a map, not smoothed.
inline Quads quads(const Map& map, Status* status = nullptr) {
    roundel_quads* made = nullptr;
    if (!detail::check(roundel_quads_extract(map.get(), &made), status)) {
        return {};
    }
    return Quads(made, status);
}

/// The quads of any integer-grid map, given by u and v of the three corners of every face.
inline Quads quads(const Mesh& mesh, span<const double> corner_uvs, Status* status = nullptr) {
    roundel_quads* made = nullptr;
    const auto code =
        roundel_quads_extract_from_uvs(mesh.get(), corner_uvs.data(), corner_uvs.size(), &made);
    return detail::check(code, status) ? Quads(made, status) : Quads();
}

namespace detail {

/// Makes a mesh of another library from polygons. Each adapter specialises it for its types with
/// `static M make(std::size_t vertices, Point point, const std::vector<Face>& faces)`, where
/// `point(i)` is the array x, y, z, and a face lists the numbers of its corners.
template <class M, class = void> struct FromPolygons;

/// The corners of every quad, then of every face that is not a quad.
inline std::vector<std::vector<std::int32_t>> polygons(const Quads& quads) {
    std::vector<std::vector<std::int32_t>> faces;
    faces.reserve(quads.size() + quads.others().size());
    const auto corners = quads.corners();
    for (std::size_t i = 0; i < corners.size(); i += 4) {
        faces.push_back({corners[i], corners[i + 1], corners[i + 2], corners[i + 3]});
    }
    faces.insert(faces.end(), quads.others().begin(), quads.others().end());
    return faces;
}

} // namespace detail

/// Converts quads, with the faces that are not quads, to a mesh of another library.
template <class M> M mesh_of(const Quads& quads) {
    const auto at = quads.vertices();
    const auto point = [&](std::size_t i) {
        return std::array<double, 3>{at[3 * i], at[3 * i + 1], at[3 * i + 2]};
    };
    return detail::FromPolygons<M>::make(at.size() / 3, point, detail::polygons(quads));
}

/// The quads of a map as a mesh of another library: `roundel::quads<PolyMesh>(map)`.
template <class M> M quads(const Map& map, Status* status = nullptr) {
    return mesh_of<M>(quads(map, status));
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_QUAD_MESHES_HPP
