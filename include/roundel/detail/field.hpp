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
    /// The fraction of the faces, from 0 to 1, that follow the curvature of the surface: those
    /// where it is most reliable. Faces in `constraints` or beside features keep the direction
    /// given there.
    double constrain_curvature = 0.0;
    /// Edges that the field follows: by default the boundary.
    Features features = {};
    /// Directions that faces should have, each face at most once.
    std::vector<FieldGuide> guides = {};
    /// The weight with which all other faces follow the curvature; 0 for none.
    double curvature_weight = 0.0;
    /// Details smaller than this length attract no irregular vertices. For a map, use the length of
    /// its quads' edges. 0 keeps all details.
    double detail = 0.0;
    /// The index of every irregular vertex. If not set, the energy decides.
    std::optional<std::vector<VertexIndex>> indices = std::nullopt;
    /// N, the number of arms in a face: 1, 2, 4 (crosses) or 6.
    std::int32_t symmetry = 4;
    /// How the problem is solved.
    Options solve = {};

    FieldOptions& set_constraints(std::vector<FieldConstraint> value) {
        constraints = std::move(value);
        return *this;
    }
    FieldOptions& set_constrain_curvature(double fraction) {
        constrain_curvature = fraction;
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
    FieldOptions& set_curvature_weight(double value) {
        curvature_weight = value;
        return *this;
    }
    FieldOptions& set_detail(double length) {
        detail = length;
        return *this;
    }
    FieldOptions& set_indices(std::vector<VertexIndex> value) {
        indices = std::move(value);
        return *this;
    }
    FieldOptions& set_symmetry(std::int32_t arms) {
        symmetry = arms;
        return *this;
    }
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
            copy(roundel_field_vertex_indices, vertex_, mesh.vertices(status), status)) {
            copy(roundel_field_boundary_indices, boundary_, mesh.boundary_loops(status), status);
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

    /// The index of every vertex in full turns, a multiple of 1/N; zero at the boundary.
    span<const double> vertex_indices() const& noexcept { return view(vertex_); }
    span<const double> vertex_indices() const&& = delete;

    /// The index of every boundary loop.
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
};

namespace detail {

/// The guidance of the C interface for `options`; empty after a failure.
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
    const bool all =
        told(roundel_guidance_set_constraints(to, faces.size(), faces.data(), angles.data())) &&
        told(roundel_guidance_set_guides(to, guided.size(), guided.data(), guiding.data(),
                                         weights.data())) &&
        (!options.indices ||
         told(roundel_guidance_set_indices(to, vertices.size(), vertices.data(), steps.data()))) &&
        told(roundel_guidance_set_curvature(to, options.constrain_curvature,
                                            options.curvature_weight)) &&
        told(roundel_guidance_set_detail(to, options.detail)) &&
        told(roundel_guidance_set_symmetry(to, options.symmetry));
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
