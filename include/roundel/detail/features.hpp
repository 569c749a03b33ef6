/// Feature edges, which fields follow and maps place on isolines.

#ifndef ROUNDEL_DETAIL_FEATURES_HPP
#define ROUNDEL_DETAIL_FEATURES_HPP

#include <roundel/detail/error.hpp>
#include <roundel/detail/mesh.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// Feature edges: fields follow them, and in a map they lie on integer isolines, so they become
/// chains of edges of the quads. By default, only the boundary.
struct Features {
    /// Edges at which the normals of the two faces differ by this many radians or more; 0 for none.
    double angle = 0.0;
    /// Edges given by their numbers.
    std::vector<std::int32_t> edges = {};
    /// Edges given by their two vertices.
    std::vector<std::array<std::int32_t, 2>> lines = {};
    /// Whether boundary edges are features too.
    bool boundary = true;

    Features& set_angle(double radians) {
        angle = radians;
        return *this;
    }
    Features& set_edges(std::vector<std::int32_t> value) {
        edges = std::move(value);
        return *this;
    }
    Features& set_lines(std::vector<std::array<std::int32_t, 2>> value) {
        lines = std::move(value);
        return *this;
    }
    Features& set_boundary(bool value) {
        boundary = value;
        return *this;
    }
};

/// The boundary, and the edges at which the normals differ by this many degrees or more.
inline Features feature_angle(double degrees) {
    return Features().set_angle(degrees * (3.14159265358979323846 / 180.0));
}

/// No edges, not even the boundary.
inline Features no_features() {
    return Features().set_boundary(false);
}

namespace detail {

using GuidanceHandle = Handle<roundel_guidance, roundel_guidance_free>;

/// Sets these features in a guidance of the C interface.
inline bool set(roundel_guidance* guidance, const Features& features, Status* status) {
    std::vector<std::int32_t> ends;
    ends.reserve(2 * features.lines.size());
    for (const auto& line : features.lines) {
        ends.insert(ends.end(), line.begin(), line.end());
    }
    return check(roundel_guidance_set_real(guidance, "feature_angle", features.angle), status) &&
           check(roundel_guidance_set_feature_edges(guidance, features.edges.size(),
                                                    features.edges.data()),
                 status) &&
           check(roundel_guidance_set_feature_lines(guidance, features.lines.size(), ends.data()),
                 status) &&
           check(roundel_guidance_set_int(guidance, "align_boundary", features.boundary ? 1 : 0),
                 status);
}

/// A guidance of the C interface with these features and nothing else; empty after a failure.
inline GuidanceHandle guidance_with(const Features& features, Status* status) {
    roundel_guidance* made = nullptr;
    if (!check(roundel_guidance_new(&made), status)) {
        return nullptr;
    }
    GuidanceHandle handle(made);
    return set(made, features, status) ? std::move(handle) : nullptr;
}

} // namespace detail

/// For every edge of a mesh 1 if it is a feature, otherwise 0.
inline std::vector<std::int32_t> mark_features(const Mesh& mesh, const Features& features,
                                               Status* status = nullptr) {
    std::vector<std::int32_t> marks;
    if (const auto guidance = detail::guidance_with(features, status)) {
        marks.resize(mesh.edges(status));
        detail::check(
            roundel_mesh_mark_features(mesh.get(), guidance.get(), marks.data(), marks.size()),
            status);
    }
    return marks;
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_FEATURES_HPP
