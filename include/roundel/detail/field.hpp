/// Orientation fields: options, solve and results.

#ifndef ROUNDEL_DETAIL_FIELD_HPP
#define ROUNDEL_DETAIL_FIELD_HPP

#include <roundel/detail/features.hpp>
#include <roundel/detail/mesh.hpp>
#include <roundel/detail/solve.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A direction that a face should have, given as in FieldConstraint. The square of the deviation
/// costs `weight`, where the squared difference of neighbours costs 1.
struct FieldGuide {
    std::int32_t face;
    double angle;
    double weight;
};

/// The index of an irregular vertex in steps of 1/N of a turn, which are quarters for crosses.
struct VertexIndex {
    std::int32_t vertex;
    std::int32_t steps;
};

/// Options of an orientation field: its guidance, and how it is solved.
struct FieldOptions {
    /// Faces whose direction is given, each at most once.
    std::vector<FieldConstraint> constraints = {};
    /// Edges that the field lies along: by default the boundary.
    Features features = {};
    /// Directions that faces should have, each face at most once.
    std::vector<FieldGuide> guides = {};
    /// All irregular vertices; where nothing is said the energy decides.
    std::optional<std::vector<VertexIndex>> indices = std::nullopt;
    // Table of options: members.
    /// The number of arms of a direction: 4 for crosses, which a map needs. In 1, 2, 4, 6; 4 by
    /// default.
    std::optional<std::int64_t> symmetry = std::nullopt;
    /// The fraction of the faces that take the direction of least absolute curvature: those where
    /// it is most reliable. In [0, 1]; 0 by default.
    std::optional<double> constrain_curvature = std::nullopt;
    /// The weight with which all other faces follow the direction of least absolute curvature, for
    /// an area of 1 and absolute curvatures that differ by 1. In [0, inf); 0 by default.
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
    /// How the problem is solved.
    Options solve = {};

    FieldOptions& set_constraints(std::vector<FieldConstraint> value) {
        constraints = std::move(value);
        return *this;
    }
    FieldOptions& set_features(Features value) {
        features = std::move(value);
        return *this;
    }
    FieldOptions& set_guides(std::vector<FieldGuide> value) {
        guides = std::move(value);
        return *this;
    }
    FieldOptions& set_indices(std::vector<VertexIndex> value) {
        indices = std::move(value);
        return *this;
    }
    // Table of options: setters.
    FieldOptions& set_symmetry(std::int64_t value) {
        symmetry = value;
        return *this;
    }
    FieldOptions& set_constrain_curvature(double value) {
        constrain_curvature = value;
        return *this;
    }
    FieldOptions& set_curvature_weight(double value) {
        curvature_weight = value;
        return *this;
    }
    FieldOptions& set_feature_length(double value) {
        feature_length = value;
        return *this;
    }
    FieldOptions& set_detail(double value) {
        detail = value;
        return *this;
    }
    FieldOptions& set_clearance(double value) {
        clearance = value;
        return *this;
    }
    // End of the table.
    FieldOptions& set_solve(Options value) {
        solve = std::move(value);
        return *this;
    }
};

/// An N-symmetric direction field: N arms in every face (a cross for N = 4), and period jumps that
/// match them over edges. It does not need its mesh after construction.
class Field {
  public:
    /// An empty field, which a call returns when it reports a failure in a Status.
    Field() noexcept = default;

    /// Takes ownership of a field of the C interface that was computed on `mesh`.
    Field(roundel_field* owned, const Mesh& mesh, Status* status = nullptr) : handle_(owned) {
        if (copy(roundel_field_angles, angles_, mesh.faces(status), status) &&
            copy(roundel_field_period_jumps, jumps_, mesh.edges(status), status) &&
            copy(roundel_field_kappa, kappa_, mesh.edges(status), status) &&
            copy(roundel_field_vertex_indices, vertex_, mesh.vertices(status), status) &&
            copy(roundel_field_vertex_index_steps, vertex_steps_, vertex_.size(), status) &&
            copy(roundel_field_boundary_indices, boundary_, mesh.boundary_loops(status), status)) {
            copy(roundel_field_boundary_index_steps, boundary_steps_, boundary_.size(), status);
        }
    }

    /// Whether the field is not empty.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The angle of one arm of each face in radians, counter-clockwise about the normal from the
    /// face's first edge.
    span<const double> angles() const& noexcept { return view(angles_); }
    span<const double> angles() const&& = delete;

    /// One number for each edge, from its first to its second face: the arm of the second face at
    /// angle + kappa + 2 pi/N jump matches the arm of the first.
    span<const std::int32_t> period_jumps() const& noexcept { return view(jumps_); }
    span<const std::int32_t> period_jumps() const&& = delete;

    /// One angle for each edge: that of the frame of its first face in the frame of its second.
    span<const double> kappa() const& noexcept { return view(kappa_); }
    span<const double> kappa() const&& = delete;

    /// The index of every vertex in steps of 1/N of a turn, which are quarters for crosses; zero at
    /// the boundary, whose loops have an index instead.
    span<const std::int32_t> vertex_index_steps() const& noexcept { return view(vertex_steps_); }
    span<const std::int32_t> vertex_index_steps() const&& = delete;

    /// The index of every boundary loop in steps of 1/N of a turn.
    span<const std::int32_t> boundary_index_steps() const& noexcept {
        return view(boundary_steps_);
    }
    span<const std::int32_t> boundary_index_steps() const&& = delete;

    /// The index of every vertex in full turns: its steps over N.
    span<const double> vertex_indices() const& noexcept { return view(vertex_); }
    span<const double> vertex_indices() const&& = delete;

    /// The index of every boundary loop in full turns: its steps over N.
    span<const double> boundary_indices() const& noexcept { return view(boundary_); }
    span<const double> boundary_indices() const&& = delete;

    /// The index of every vertex, computed by following an arm of the cross around it in space.
    std::vector<double> traced_indices(Status* status = nullptr) const {
        std::vector<double> values;
        copy(roundel_field_traced_indices, values, vertex_.size(), status);
        return values;
    }

    /// The energy, recomputed on the mesh from angles and period jumps.
    double energy(Status* status = nullptr) const {
        double value = 0.0;
        detail::check(roundel_field_energy(get(), &value), status);
        return value;
    }

    /// The number of vertices with an index other than zero.
    std::size_t irregular_count(Status* status = nullptr) const {
        std::size_t value = 0;
        detail::check(roundel_field_irregular_count(get(), &value), status);
        return value;
    }

    /// The solution of the field's problem: how the solve ended, its lower bound and its times.
    Solution solution(Status* status = nullptr) const {
        roundel_solution* copy = nullptr;
        if (!detail::check(roundel_field_solution(get(), &copy), status)) {
            return {};
        }
        return Solution(copy, status);
    }

    /// The handle for calls of the C interface.
    const roundel_field* get() const noexcept { return handle_.get(); }

  private:
    template <class T> static span<const T> view(const std::vector<T>& values) noexcept {
        return {values.data(), values.size()};
    }

    template <class Function, class T>
    bool copy(Function function, std::vector<T>& to, std::size_t length, Status* status) const {
        to.resize(length);
        return detail::check(function(get(), to.data(), length), status);
    }

    detail::Handle<roundel_field, roundel_field_free> handle_;
    std::vector<double> angles_;
    std::vector<std::int32_t> jumps_;
    std::vector<double> kappa_;
    std::vector<double> vertex_;
    std::vector<double> boundary_;
    std::vector<std::int32_t> vertex_steps_;
    std::vector<std::int32_t> boundary_steps_;
};

namespace detail {

// Table of options: lists.
template <class Tell> bool each_guidance_option(const FieldOptions& options, const Tell& tell) {
    if (options.symmetry && !tell("symmetry", *options.symmetry)) {
        return false;
    }
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

/// The guidance of the C interface for `options`; none after a failure.
inline GuidanceHandle guidance_of(const FieldOptions& options, Status* status) {
    GuidanceHandle handle = guidance_with(options.features, status);
    if (!handle) {
        return nullptr;
    }
    std::vector<std::int32_t> faces, guided, vertices, steps;
    std::vector<double> angles, guiding, weights;
    for (const auto& given : options.constraints) {
        faces.push_back(given.face);
        angles.push_back(given.angle);
    }
    for (const auto& given : options.guides) {
        guided.push_back(given.face);
        guiding.push_back(given.angle);
        weights.push_back(given.weight);
    }
    if (options.indices) {
        for (const auto& given : *options.indices) {
            vertices.push_back(given.vertex);
            steps.push_back(given.steps);
        }
    }
    roundel_guidance* to = handle.get();
    const auto told = [status](roundel_status code) { return check(code, status); };
    const auto set_guidance =
        by_name(roundel_guidance_set_int, roundel_guidance_set_real, roundel_guidance_set_text);
    const bool all =
        told(roundel_guidance_set_constraints(to, faces.size(), faces.data(), angles.data())) &&
        told(roundel_guidance_set_guides(to, guided.size(), guided.data(), guiding.data(),
                                         weights.data())) &&
        (!options.indices ||
         told(roundel_guidance_set_indices(to, vertices.size(), vertices.data(), steps.data()))) &&
        each_guidance_option(options, [&](const char* name, const auto& value) {
            return told(set_guidance(to, name, value));
        });
    return all ? std::move(handle) : nullptr;
}

} // namespace detail

/// The smoothest field of a mesh that satisfies the options.
inline Field orientation_field(const Mesh& mesh, const FieldOptions& options = {},
                               Status* status = nullptr) {
    const auto guidance = detail::guidance_of(options, status);
    if (!guidance) {
        return {};
    }
    detail::Handle<roundel_field, roundel_field_free> found;
    const auto call = [&](const roundel_options* how, const roundel_monitor* monitor) {
        roundel_field* made = nullptr;
        const auto code = roundel_field_solve(mesh.get(), guidance.get(), how, monitor, &made);
        found.reset(made);
        return code;
    };
    if (!detail::watched(options.solve, call, 0, status)) {
        return {};
    }
    return Field(found.release(), mesh, status);
}

/// The problem of a field as a plain problem, to store or to solve in another way. Variable f is
/// the angle of face f; see roundel_field_make_problem.
inline Problem orientation_problem(const Mesh& mesh, const FieldOptions& options = {},
                                   Status* status = nullptr) {
    roundel_problem* made = nullptr;
    if (const auto guidance = detail::guidance_of(options, status)) {
        detail::check(roundel_field_make_problem(mesh.get(), guidance.get(), &made), status);
    }
    return Problem(made);
}

/// The field that a solution of orientation_problem represents. Mesh and options must be those of
/// the problem.
inline Field orientation_field(const Mesh& mesh, const Solution& solution,
                               const FieldOptions& options, Status* status = nullptr) {
    const auto guidance = detail::guidance_of(options, status);
    roundel_field* found = nullptr;
    if (!guidance || !detail::check(roundel_field_from_solution(mesh.get(), guidance.get(),
                                                                solution.get(), &found),
                                    status)) {
        return {};
    }
    return Field(found, mesh, status);
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_FIELD_HPP
