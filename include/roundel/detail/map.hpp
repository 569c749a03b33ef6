/// Seamless maps: options, solve and results.

#ifndef ROUNDEL_DETAIL_MAP_HPP
#define ROUNDEL_DETAIL_MAP_HPP

#include <roundel/detail/features.hpp>
#include <roundel/detail/field.hpp>
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

/// Options of a seamless map: the size of its quads, its features, and how it is solved.
struct MapOptions {
    /// The approximate number of quads. The default is 1000 if no length is given either.
    std::optional<std::size_t> quads = std::nullopt;
    /// Instead, the edge length of the quads, in units of the mesh.
    std::optional<double> edge_length = std::nullopt;
    /// Instead, two edge lengths for each face: along the arm that the field stores there (its
    /// angle), and across it.
    std::vector<double> edge_lengths = {};
    /// Edges that become isolines. By default, those that the field follows.
    std::optional<Features> features = std::nullopt;
    /// Whether to make the map fold-free, as `roundel parametrize` does: integers that collapse
    /// cones are decided anew, flipped faces are turned back, and the map is refined if some
    /// remain. Every solve then starts from scratch.
    bool untangle = true;
    /// How often the surroundings of folded triangles are stiffened before these are untangled.
    std::size_t stiffenings = 5;
    /// How the problem is solved.
    Options solve = {};

    MapOptions& set_quads(std::size_t value) {
        quads = value;
        return *this;
    }
    MapOptions& set_edge_length(double value) {
        edge_length = value;
        return *this;
    }
    MapOptions& set_edge_lengths(std::vector<double> value) {
        edge_lengths = std::move(value);
        return *this;
    }
    MapOptions& set_features(Features value) {
        features = std::move(value);
        return *this;
    }
    MapOptions& set_untangle(bool value) {
        untangle = value;
        return *this;
    }
    MapOptions& set_stiffenings(std::size_t value) {
        stiffenings = value;
        return *this;
    }
    MapOptions& set_solve(Options value) {
        solve = std::move(value);
        return *this;
    }
};

/// How coordinates change over a cut edge, from its first to its second face: by 0 to 3 quarter
/// turns counter-clockwise, then by an integer translation.
struct Transition {
    std::int32_t edge;
    std::int32_t quarters;
    std::array<double, 2> translation;
};

/// A seamless map of a mesh: coordinates (u, v) on the cut surface whose gradients follow a cross
/// field. It does not need its mesh and field after construction.
class Map {
  public:
    /// An empty map, which a call returns when it reports a failure in a Status.
    Map() noexcept = default;

    /// Takes ownership of a map of the C interface that has been solved.
    explicit Map(roundel_map* owned, std::size_t faces, Status* status = nullptr)
        : handle_(owned), faces_(faces) {
        read(status);
    }

    /// Whether the map is not empty.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// Solves again for another size. Without untangling, this reuses the work of the first solve.
    /// Features stay those of the first solve. A failure leaves the map unchanged, except for the
    /// size that the next solve uses.
    Map& solve(const MapOptions& options, Status* status = nullptr) {
        if (decide(get(), options, status)) {
            read(status);
        }
        return *this;
    }

    /// u and v of the three corners of every face.
    span<const double> corner_uvs() const& noexcept { return view(corner_uvs_); }
    span<const double> corner_uvs() const&& = delete;

    /// u and v of every vertex of the cut surface.
    span<const double> vertex_uvs() const& noexcept { return view(vertex_uvs_); }
    span<const double> vertex_uvs() const&& = delete;

    /// The three corners of every face as vertices of the cut surface.
    span<const std::int32_t> vertex_corners() const& noexcept { return view(vertex_corners_); }
    span<const std::int32_t> vertex_corners() const&& = delete;

    /// The cones of the map, which are the irregular vertices of the field.
    span<const std::int32_t> cones() const& noexcept { return view(cones_); }
    span<const std::int32_t> cones() const&& = delete;

    /// Faces that are flipped or collapsed.
    span<const std::int32_t> flipped() const& noexcept { return view(flipped_); }
    span<const std::int32_t> flipped() const&& = delete;

    /// Vertices with a winding defect: the coordinates turn around them another number of times
    /// than the field does. An example is a ring of faces that goes around its vertex twice without
    /// a fold.
    span<const std::int32_t> winding_defects() const& noexcept { return view(winding_defects_); }
    span<const std::int32_t> winding_defects() const&& = delete;

    /// How often untangling made the quads smaller than requested, each time by a factor of the
    /// square root of two in length.
    std::size_t refinements(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_map_refinement_count(get(), &count), status);
        return count;
    }

    /// How often untangling decided integers anew at the final size.
    std::size_t rounds(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_map_round_count(get(), &count), status);
        return count;
    }

    /// Whether no face is flipped or collapsed.
    bool valid() const noexcept { return handle_ != nullptr && flipped_.empty(); }

    /// The cut edges in increasing order, with their transitions.
    std::vector<Transition> transitions(Status* status = nullptr) const {
        std::size_t count = 0;
        if (!detail::check(roundel_map_cut_count(get(), &count), status)) {
            return {};
        }
        std::vector<std::int32_t> edges(count), quarters(count);
        std::vector<double> translations(2 * count);
        std::vector<Transition> all;
        if (detail::check(roundel_map_transitions(get(), count, edges.data(), quarters.data(),
                                                  translations.data()),
                          status)) {
            for (std::size_t i = 0; i < count; ++i) {
                all.push_back(
                    {edges[i], quarters[i], {translations[2 * i], translations[2 * i + 1]}});
            }
        }
        return all;
    }

    /// The energy, recomputed on the mesh: area times the squared distance of the gradients from
    /// the scaled arms of the field, summed over all triangles.
    double energy(Status* status = nullptr) const {
        double value = 0.0;
        detail::check(roundel_map_energy(get(), &value), status);
        return value;
    }

    /// The solution of the map's problem: how the solve ended, its lower bound and its times.
    Solution solution(Status* status = nullptr) const {
        roundel_solution* copy = nullptr;
        if (!detail::check(roundel_map_solution(get(), &copy), status)) {
            return {};
        }
        return Solution(copy, status);
    }

    /// Writes the mesh with the coordinates of its corners to an OBJ file.
    void write(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_map_write(get(), file.c_str()), status);
    }

    /// The handle for calls of the C interface.
    roundel_map* get() const noexcept { return handle_.get(); }

    /// Solves a map of the C interface for the size in the options.
    static bool decide(roundel_map* map, const MapOptions& options, Status* status) {
        const auto call = [&](const roundel_options* how, const roundel_monitor* monitor) {
            return options.untangle ? roundel_map_solve_fold_free(map, how, monitor)
                                    : roundel_map_solve(map, how, monitor);
        };
        return resize(map, options, status) &&
               detail::check(roundel_map_set_stiffening_count(map, options.stiffenings), status) &&
               detail::watched(options.solve, call, 0, status);
    }

  private:
    /// Sets the size of quads of a map of the C interface.
    static bool resize(roundel_map* map, const MapOptions& options, Status* status) {
        const auto told = [&](roundel_status code) { return detail::check(code, status); };
        return (!options.quads || told(roundel_map_set_quads(map, *options.quads))) &&
               (!options.edge_length ||
                told(roundel_map_set_edge_length(map, *options.edge_length))) &&
               (options.edge_lengths.empty() ||
                told(roundel_map_set_edge_lengths(map, options.edge_lengths.data(),
                                                  options.edge_lengths.size())));
    }

    template <class T> static span<const T> view(const std::vector<T>& values) noexcept {
        return {values.data(), values.size()};
    }

    template <class Count, class Function>
    bool listed(Count count, Function copy, std::vector<std::int32_t>& to, Status* status) {
        std::size_t length = 0;
        if (!detail::check(count(get(), &length), status)) {
            return false;
        }
        to.resize(length);
        return detail::check(copy(get(), to.data(), length), status);
    }

    void read(Status* status) {
        std::size_t vertices = 0;
        if (!detail::check(roundel_map_vertex_count(get(), &vertices), status)) {
            return;
        }
        corner_uvs_.resize(6 * faces_);
        vertex_uvs_.resize(2 * vertices);
        vertex_corners_.resize(3 * faces_);
        const auto told = [&](roundel_status code) { return detail::check(code, status); };
        if (told(roundel_map_corner_uvs(get(), corner_uvs_.data(), corner_uvs_.size())) &&
            told(roundel_map_vertex_uvs(get(), vertex_uvs_.data(), vertex_uvs_.size())) &&
            told(roundel_map_vertex_corners(get(), vertex_corners_.data(),
                                            vertex_corners_.size())) &&
            listed(roundel_map_cone_count, roundel_map_cones, cones_, status) &&
            listed(roundel_map_winding_defect_count, roundel_map_winding_defects, winding_defects_,
                   status)) {
            listed(roundel_map_flipped_face_count, roundel_map_flipped_faces, flipped_, status);
        }
    }

    detail::Handle<roundel_map, roundel_map_free> handle_;
    std::size_t faces_ = 0;
    std::vector<double> corner_uvs_;
    std::vector<double> vertex_uvs_;
    std::vector<std::int32_t> vertex_corners_;
    std::vector<std::int32_t> cones_;
    std::vector<std::int32_t> winding_defects_;
    std::vector<std::int32_t> flipped_;
};

/// The seamless map of a mesh that follows a field on it.
inline Map parametrize(const Mesh& mesh, const Field& field, const MapOptions& options = {},
                       Status* status = nullptr) {
    detail::GuidanceHandle guidance;
    if (options.features) {
        guidance = detail::guidance_with(*options.features, status);
        if (!guidance) {
            return {};
        }
    }
    roundel_map* made = nullptr;
    if (!detail::check(roundel_map_new(mesh.get(), field.get(), guidance.get(), &made), status)) {
        return {};
    }
    detail::Handle<roundel_map, roundel_map_free> map(made);
    if (!Map::decide(map.get(), options, status)) {
        return {};
    }
    return Map(map.release(), mesh.faces(status), status);
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_MAP_HPP
