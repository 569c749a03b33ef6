/// Quadrangulation: options, and the call from a mesh to quads.

#ifndef ROUNDEL_DETAIL_QUADS_HPP
#define ROUNDEL_DETAIL_QUADS_HPP

#include <roundel/detail/features.hpp>
#include <roundel/detail/mesh.hpp>
#include <roundel/detail/quad_meshes.hpp>
#include <roundel/detail/solve.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// What quads should be like, and how they are solved for. What is not set is as the program
/// `roundel quad` has it. Where the curvature's fraction or its weight is set, the other is 0 if it
/// is not.
struct QuadOptions {
    /// Edges of two lengths a face instead: along the arm that the field stores there, and across.
    std::vector<double> edge_lengths = {};
    /// Planes about which the quads are symmetric: "x", "y", "z" (through the centre of the
    /// bounding box; the side of larger coordinates is kept), "-x", "-y", "-z" (the other side),
    /// "auto" (the plane is found) or "NX,NY,NZ,D". See Mesh::mirror_plane.
    std::vector<std::string> mirror = {};
    /// How dense quads are at every vertex, as a factor of the number of their edges along a
    /// length.
    std::vector<double> density = {};
    /// The vertices that sizes change near, where `near` is "vertices".
    std::vector<std::int32_t> near_vertices = {};
    /// Edges that become chains of edges of the quads, instead of the boundary alone.
    std::optional<Features> features = std::nullopt;
    // Table of options: members.
    /// The approximate number of quads. In [1, 2147483647]; 1000 by default.
    std::optional<std::int64_t> quads = std::nullopt;
    /// The length of the edges of quads, in units of the mesh, instead of their number. In (0,
    /// inf).
    std::optional<double> edge_length = std::nullopt;
    /// The strategy that decides the integers of the field. One of relax, direct, greedy, adaptive,
    /// multiple, lattice, exact, auto; adaptive by default.
    std::optional<std::string> field_strategy = std::nullopt;
    /// 1: move vertices over the surface to make the quads more like squares of one size. In [0,
    /// 1]; 1 by default.
    std::optional<bool> smooth = std::nullopt;
    /// Exact: a number of quads is met within 1 %, or as nearly as a few maps of other sizes come;
    /// about: one map is made, whose number differs by up to a fifth. One of exact, about; exact by
    /// default.
    std::optional<std::string> count = std::nullopt;
    /// 1: also try fields that follow curvature less than the guidance says, and keep the field
    /// whose map is least distorted. In [0, 1]; 1 by default.
    std::optional<bool> vary_curvature = std::nullopt;
    /// 1: refine the mesh first where edges are longer than three edges of the quads or angles are
    /// below 2 degrees. In [0, 1]; 1 by default.
    std::optional<bool> refine = std::nullopt;
    /// How far quads get smaller where the surface curves: 0: not at all, 1: until edges deviate
    /// from it equally far everywhere. In [0, 1]; 0 by default.
    std::optional<double> adapt = std::nullopt;
    /// How far quads get longer along directions in which the surface curves less: 0: not at all,
    /// 1: until edges of both directions deviate from it equally far, or are four to one. In [0,
    /// 1]; 0 by default.
    std::optional<double> stretch = std::nullopt;
    /// The least length of an edge of quads that is aimed at, in units of the mesh. In (0, inf).
    std::optional<double> min_length = std::nullopt;
    /// The largest length of an edge of quads that is aimed at, in units of the mesh. In (0, inf).
    std::optional<double> max_length = std::nullopt;
    /// The ratio of the lengths of neighbouring edges that is aimed at where sizes vary, at most.
    /// In (1, inf); 1.5 by default.
    std::optional<double> gradation = std::nullopt;
    /// What sizes change near, by distance along the surface. One of nothing, features, boundary,
    /// vertices; nothing by default.
    std::optional<std::string> near = std::nullopt;
    /// The factor of lengths there: below 1 quads are smaller there, above 1 larger. In (0, inf);
    /// 0.5 by default.
    std::optional<double> near_size = std::nullopt;
    /// The distance up to which they change, in units of the mesh; unset: ten edges of quads. In
    /// (0, inf).
    std::optional<double> near_distance = std::nullopt;
    /// 1: untangle the map if its folds keep extraction from making quads. In [0, 1]; 1 by default.
    std::optional<bool> untangle = std::nullopt;
    /// The number of times that untangling first stiffens the surroundings of folded triangles. In
    /// [0, 1000]; 5 by default.
    std::optional<std::int64_t> stiffenings = std::nullopt;
    /// How far a mirror plane may move a vertex from the surface, as a part of the diagonal of the
    /// bounding box. In [0, 1]; 0.05 by default.
    std::optional<double> mirror_tolerance = std::nullopt;
    /// The fraction of the faces that take the direction of least absolute curvature: those where
    /// it is most reliable. In [0, 1]; 0.005 by default.
    std::optional<double> constrain_curvature = std::nullopt;
    /// The weight with which all other faces follow the direction of least absolute curvature, for
    /// an area of 1 and absolute curvatures that differ by 1. In [0, inf); 0.07 by default.
    std::optional<double> curvature_weight = std::nullopt;
    /// Curves of sharp edges that end somewhere are features if they are at least this long, and
    /// patches between sharp edges if their area is at least a sixteenth of its square; unset: 0
    /// for a field or a map, two edges of the quads for quads. In [0, inf).
    std::optional<double> feature_length = std::nullopt;
    /// Details smaller than this length attract no irregular vertices; unset: 0 for a field, an
    /// edge of the quads for a map, a quarter of an edge for quads. In [0, inf).
    std::optional<double> detail = std::nullopt;
    /// Irregular vertices keep this far from features, or lie on them; unset: 0 for a field or a
    /// map, for quads an edge of theirs if there are features inside the surface. In [0, inf).
    std::optional<double> clearance = std::nullopt;
    // End of the table.
    /// How the map is solved, by lattice decoding where no strategy or preset is given; and, but
    /// for the strategy, the field.
    std::optional<Options> solve = std::nullopt;

    // Table of options: setters.
    QuadOptions& set_quads(std::int64_t value) {
        quads = value;
        return *this;
    }
    QuadOptions& set_edge_length(double value) {
        edge_length = value;
        return *this;
    }
    QuadOptions& set_field_strategy(std::string value) {
        field_strategy = std::move(value);
        return *this;
    }
    QuadOptions& set_smooth(bool value) {
        smooth = value;
        return *this;
    }
    QuadOptions& set_count(std::string value) {
        count = std::move(value);
        return *this;
    }
    QuadOptions& set_vary_curvature(bool value) {
        vary_curvature = value;
        return *this;
    }
    QuadOptions& set_refine(bool value) {
        refine = value;
        return *this;
    }
    QuadOptions& set_adapt(double value) {
        adapt = value;
        return *this;
    }
    QuadOptions& set_stretch(double value) {
        stretch = value;
        return *this;
    }
    QuadOptions& set_min_length(double value) {
        min_length = value;
        return *this;
    }
    QuadOptions& set_max_length(double value) {
        max_length = value;
        return *this;
    }
    QuadOptions& set_gradation(double value) {
        gradation = value;
        return *this;
    }
    QuadOptions& set_near(std::string value) {
        near = std::move(value);
        return *this;
    }
    QuadOptions& set_near_size(double value) {
        near_size = value;
        return *this;
    }
    QuadOptions& set_near_distance(double value) {
        near_distance = value;
        return *this;
    }
    QuadOptions& set_untangle(bool value) {
        untangle = value;
        return *this;
    }
    QuadOptions& set_stiffenings(std::int64_t value) {
        stiffenings = value;
        return *this;
    }
    QuadOptions& set_mirror_tolerance(double value) {
        mirror_tolerance = value;
        return *this;
    }
    QuadOptions& set_constrain_curvature(double value) {
        constrain_curvature = value;
        return *this;
    }
    QuadOptions& set_curvature_weight(double value) {
        curvature_weight = value;
        return *this;
    }
    QuadOptions& set_feature_length(double value) {
        feature_length = value;
        return *this;
    }
    QuadOptions& set_detail(double value) {
        detail = value;
        return *this;
    }
    QuadOptions& set_clearance(double value) {
        clearance = value;
        return *this;
    }
    // End of the table.
    QuadOptions& set_edge_lengths(std::vector<double> value) {
        edge_lengths = std::move(value);
        return *this;
    }
    QuadOptions& set_mirror(std::vector<std::string> value) {
        mirror = std::move(value);
        return *this;
    }
    QuadOptions& set_density(std::vector<double> value) {
        density = std::move(value);
        return *this;
    }
    QuadOptions& set_near_vertices(std::vector<std::int32_t> value) {
        near_vertices = std::move(value);
        return *this;
    }
    QuadOptions& set_features(Features value) {
        features = std::move(value);
        return *this;
    }
    QuadOptions& set_solve(Options value) {
        solve = std::move(value);
        return *this;
    }
};

namespace detail {

using QuadOptionsHandle = Handle<roundel_quad_options, roundel_quad_options_free>;

// Table of options: lists.
template <class Tell> bool each_quad_option(const QuadOptions& options, const Tell& tell) {
    if (options.quads && !tell("quads", *options.quads)) {
        return false;
    }
    if (options.edge_length && !tell("edge_length", *options.edge_length)) {
        return false;
    }
    if (options.field_strategy && !tell("field_strategy", *options.field_strategy)) {
        return false;
    }
    if (options.smooth && !tell("smooth", *options.smooth)) {
        return false;
    }
    if (options.count && !tell("count", *options.count)) {
        return false;
    }
    if (options.vary_curvature && !tell("vary_curvature", *options.vary_curvature)) {
        return false;
    }
    if (options.refine && !tell("refine", *options.refine)) {
        return false;
    }
    if (options.adapt && !tell("adapt", *options.adapt)) {
        return false;
    }
    if (options.stretch && !tell("stretch", *options.stretch)) {
        return false;
    }
    if (options.min_length && !tell("min_length", *options.min_length)) {
        return false;
    }
    if (options.max_length && !tell("max_length", *options.max_length)) {
        return false;
    }
    if (options.gradation && !tell("gradation", *options.gradation)) {
        return false;
    }
    if (options.near && !tell("near", *options.near)) {
        return false;
    }
    if (options.near_size && !tell("near_size", *options.near_size)) {
        return false;
    }
    if (options.near_distance && !tell("near_distance", *options.near_distance)) {
        return false;
    }
    if (options.untangle && !tell("untangle", *options.untangle)) {
        return false;
    }
    if (options.stiffenings && !tell("stiffenings", *options.stiffenings)) {
        return false;
    }
    if (options.mirror_tolerance && !tell("mirror_tolerance", *options.mirror_tolerance)) {
        return false;
    }
    return true;
}
template <class Tell> bool each_guidance_option(const QuadOptions& options, const Tell& tell) {
    if (options.constrain_curvature && !tell("constrain_curvature", *options.constrain_curvature)) {
        return false;
    }
    if (options.curvature_weight && !tell("curvature_weight", *options.curvature_weight)) {
        return false;
    }
    if (options.feature_length && !tell("feature_length", *options.feature_length)) {
        return false;
    }
    if (options.detail && !tell("detail", *options.detail)) {
        return false;
    }
    if (options.clearance && !tell("clearance", *options.clearance)) {
        return false;
    }
    return true;
}
// End of the table.

/// What the options say of features and of the guidance; none after a failure.
inline GuidanceHandle guidance_of(const QuadOptions& options, bool curved, Status* status) {
    roundel_guidance* made = nullptr;
    if (!check(roundel_guidance_new_for_quads(&made), status)) {
        return nullptr;
    }
    GuidanceHandle guidance(made);
    const auto set_guidance =
        by_name(roundel_guidance_set_int, roundel_guidance_set_real, roundel_guidance_set_text);
    const auto tell = [&](const char* name, const auto& value) {
        return check(set_guidance(made, name, value), status);
    };
    const bool told = (!options.features || set(made, *options.features, status)) &&
                      (!curved || (tell("constrain_curvature", 0.0) && //
                                   tell("curvature_weight", 0.0))) &&
                      each_guidance_option(options, tell);
    return told ? std::move(guidance) : nullptr;
}

/// The C interface's options for `options`; none after a failure.
inline QuadOptionsHandle handle_for(const QuadOptions& options, Status* status) {
    Options map = options.solve.value_or(Options());
    Options field = map;
    if (!map.strategy && !map.preset) {
        map.strategy = "lattice";
    }
    field.strategy = "adaptive";
    // Whoever says how curvature counts says all of it.
    const bool curved = options.constrain_curvature || options.curvature_weight;
    const auto guidance = guidance_of(options, curved, status);
    const auto by = guidance ? handle_for(map, status) : nullptr;
    const auto field_by = by ? handle_for(field, status) : nullptr;
    roundel_quad_options* made = nullptr;
    if (!field_by || !check(roundel_quad_options_new(&made), status)) {
        return nullptr;
    }
    QuadOptionsHandle handle(made);
    const auto set_option = by_name(roundel_quad_options_set_int, roundel_quad_options_set_real,
                                    roundel_quad_options_set_text);
    const auto tell = [&](const char* name, const auto& value) {
        return check(set_option(made, name, value), status);
    };
    const auto& lengths = options.edge_lengths;
    const bool told =
        check(roundel_quad_options_set_guidance(made, guidance.get()), status) &&
        check(roundel_quad_options_set_map_options(made, by.get()), status) &&
        check(roundel_quad_options_set_field_options(made, field_by.get()), status) &&
        (!curved || tell("vary_curvature", false)) && each_quad_option(options, tell) &&
        (lengths.empty() ||
         check(roundel_quad_options_set_edge_lengths(made, lengths.data(), lengths.size()),
               status)) &&
        check(
            roundel_quad_options_set_density(made, options.density.data(), options.density.size()),
            status) &&
        check(roundel_quad_options_set_near_vertices(made, options.near_vertices.size(),
                                                     options.near_vertices.data()),
              status);
    for (const auto& plane : options.mirror) {
        if (!told || !check(roundel_quad_options_add_mirror(made, plane.c_str()), status)) {
            return nullptr;
        }
    }
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

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_QUADS_HPP
