/// Quad meshes: options, quadrangulation and results.

#ifndef ROUNDEL_DETAIL_QUADS_HPP
#define ROUNDEL_DETAIL_QUADS_HPP

#include <roundel/detail/features.hpp>
#include <roundel/detail/map.hpp>
#include <roundel/detail/mesh.hpp>
#include <roundel/detail/solve.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// Options of quads: their size, the guidance of the field, and how field and map are solved.
/// Options that are not set have the defaults of the program `roundel quad`.
struct QuadOptions {
    /// The approximate number of quads. The default is 1000 if no length is given either.
    std::optional<std::size_t> quads = std::nullopt;
    /// Instead, the edge length, in units of the mesh.
    std::optional<double> edge_length = std::nullopt;
    /// Instead, two edge lengths for each face: along the arm that the field stores there, and
    /// across it.
    std::vector<double> edge_lengths = {};
    /// Edges that become chains of edges of the quads, instead of the boundary alone.
    std::optional<Features> features = std::nullopt;
    /// The fraction of the faces that follow the curvature, as in FieldOptions. If neither this nor
    /// the weight is given, both have values that suit quads, or smaller ones where these give
    /// better quads.
    std::optional<double> constrain_curvature = std::nullopt;
    /// The weight with which all other faces follow the curvature.
    std::optional<double> curvature_weight = std::nullopt;
    /// Details smaller than this length attract no irregular vertices. The default is a quarter of
    /// an edge.
    std::optional<double> detail = std::nullopt;
    /// How the map and, except for the strategy, the field are solved. If no strategy or preset is
    /// given, the map is solved by lattice decoding.
    std::optional<Options> solve = std::nullopt;
    /// The strategy for the integers of the field, instead of adaptive rounding.
    std::optional<std::string> field_strategy = std::nullopt;
    /// Whether to untangle a map whose folds keep extraction from making quads.
    bool untangle = true;
    /// Whether vertices are moved on the surface to make the quads more like squares of one size.
    bool smooth = true;

    QuadOptions& set_quads(std::size_t value) {
        quads = value;
        return *this;
    }
    QuadOptions& set_edge_length(double value) {
        edge_length = value;
        return *this;
    }
    QuadOptions& set_edge_lengths(std::vector<double> value) {
        edge_lengths = std::move(value);
        return *this;
    }
    QuadOptions& set_features(Features value) {
        features = std::move(value);
        return *this;
    }
    QuadOptions& set_constrain_curvature(double fraction) {
        constrain_curvature = fraction;
        return *this;
    }
    QuadOptions& set_curvature_weight(double value) {
        curvature_weight = value;
        return *this;
    }
    QuadOptions& set_detail(double length) {
        detail = length;
        return *this;
    }
    QuadOptions& set_solve(Options value) {
        solve = std::move(value);
        return *this;
    }
    QuadOptions& set_field_strategy(std::string value) {
        field_strategy = std::move(value);
        return *this;
    }
    QuadOptions& set_untangle(bool value) {
        untangle = value;
        return *this;
    }
    QuadOptions& set_smooth(bool value) {
        smooth = value;
        return *this;
    }
};

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

    /// Writes the faces to an OBJ file.
    void write(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_quads_write(get(), file.c_str()), status);
    }

    roundel_quads* get() const noexcept { return handle_.get(); }

  private:
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

using QuadOptionsHandle = Handle<roundel_quad_options, roundel_quad_options_free>;

/// The features, the curvature and the detail of the options; empty after a failure.
inline GuidanceHandle guidance_of(const QuadOptions& options, Status* status) {
    roundel_guidance* made = nullptr;
    if (!check(roundel_guidance_new_for_quads(&made), status)) {
        return nullptr;
    }
    GuidanceHandle guidance(made);
    const bool curved = options.constrain_curvature || options.curvature_weight;
    const bool told =
        (!options.features || set(made, *options.features, status)) &&
        (!curved ||
         check(roundel_guidance_set_curvature(made, options.constrain_curvature.value_or(0.0),
                                              options.curvature_weight.value_or(0.0)),
               status)) &&
        (!options.detail || check(roundel_guidance_set_detail(made, *options.detail), status));
    return told ? std::move(guidance) : nullptr;
}

/// Sets the size in the options.
inline roundel_status resize(roundel_quad_options* made, const QuadOptions& options) {
    if (!options.edge_lengths.empty()) {
        return roundel_quad_options_set_edge_lengths(made, options.edge_lengths.data(),
                                                     options.edge_lengths.size());
    }
    if (options.edge_length) {
        return roundel_quad_options_set_edge_length(made, *options.edge_length);
    }
    return options.quads ? roundel_quad_options_set_quads(made, *options.quads) : ROUNDEL_OK;
}

/// The C interface's options for `options`; empty after a failure.
inline QuadOptionsHandle handle_for(const QuadOptions& options, Status* status) {
    Options map = options.solve.value_or(Options());
    Options field = map;
    if (!map.strategy && !map.preset) {
        map.strategy = "lattice";
    }
    field.strategy = options.field_strategy.value_or("adaptive");
    const auto guidance = guidance_of(options, status);
    const bool curved = options.constrain_curvature || options.curvature_weight;
    const auto by = guidance ? handle_for(map, status) : nullptr;
    const auto field_by = by ? handle_for(field, status) : nullptr;
    roundel_quad_options* made = nullptr;
    if (!field_by || !check(roundel_quad_options_new(&made), status)) {
        return nullptr;
    }
    QuadOptionsHandle handle(made);
    const bool told =
        check(resize(made, options), status) &&
        check(roundel_quad_options_set_guidance(made, guidance.get()), status) &&
        check(roundel_quad_options_set_vary_curvature(made, curved ? 0 : 1), status) &&
        check(roundel_quad_options_set_map_options(made, by.get()), status) &&
        check(roundel_quad_options_set_field_options(made, field_by.get()), status) &&
        check(roundel_quad_options_set_untangle(made, options.untangle ? 1 : 0), status) &&
        check(roundel_quad_options_set_smooth(made, options.smooth ? 1 : 0), status);
    return told ? std::move(handle) : nullptr;
}

} // namespace detail

/// Quadrangulates a mesh: field, map, extraction and smoothing in one call. The callback in the
/// options receives the events of all steps, and the token cancels any of them.
inline Quads quadrangulate(const Mesh& mesh, const QuadOptions& options = {},
                           Status* status = nullptr) {
    const auto how = detail::handle_for(options, status);
    if (!how) {
        return {};
    }
    detail::Handle<roundel_quads, roundel_quads_free> found;
    const auto call = [&](const roundel_options*, const roundel_monitor* monitor) {
        roundel_quads* made = nullptr;
        const auto code = roundel_quads_make(mesh.get(), how.get(), monitor, &made);
        found.reset(made);
        return code;
    };
    const auto& watching = options.solve.value_or(Options());
    return detail::watched(watching, call, 0, status) ? Quads(found.release(), status) : Quads();
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

#endif // ROUNDEL_DETAIL_QUADS_HPP
