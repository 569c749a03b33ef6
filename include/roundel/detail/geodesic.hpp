/// Exact geodesic distances: sources, distances, gradients and paths.

#ifndef ROUNDEL_DETAIL_GEODESIC_HPP
#define ROUNDEL_DETAIL_GEODESIC_HPP

#include <roundel/detail/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A point of a mesh: a face and the weights of its three corners, which add up to 1.
struct SurfacePoint {
    std::int32_t face;
    std::array<double, 3> barycentric;
};

namespace detail {

/// Points of a surface as the arrays of the C interface.
struct PointArrays {
    std::vector<std::int32_t> faces{};
    std::vector<double> barycentric{};

    explicit PointArrays(span<const SurfacePoint> points) {
        for (const auto& point : points) {
            faces.push_back(point.face);
            barycentric.insert(barycentric.end(), point.barycentric.begin(),
                               point.barycentric.end());
        }
    }
};

} // namespace detail

/// Sources of geodesic distances, numbered from 0 as they are added. They are checked when they are
/// used with a mesh.
class Sources {
  public:
    explicit Sources(Status* status = nullptr) {
        roundel_sources* made = nullptr;
        detail::check(roundel_sources_new(&made), status);
        handle_.reset(made);
    }

    /// Adds vertices, each a source.
    Sources& add_vertices(span<const std::int32_t> vertices, Status* status = nullptr) {
        detail::check(roundel_sources_add_vertices(handle_.get(), vertices.size(), vertices.data()),
                      status);
        return *this;
    }

    /// Adds a vertex.
    Sources& add_vertex(std::int32_t vertex, Status* status = nullptr) {
        return add_vertices(span<const std::int32_t>(&vertex, 1), status);
    }

    /// Adds points of the surface, each a source.
    Sources& add_points(span<const SurfacePoint> points, Status* status = nullptr) {
        const detail::PointArrays arrays(points);
        detail::check(roundel_sources_add_points(handle_.get(), points.size(), arrays.faces.data(),
                                                 arrays.barycentric.data()),
                      status);
        return *this;
    }

    /// Adds a polyline: one source. Points that follow each other lie on a common face.
    Sources& add_polyline(span<const SurfacePoint> points, bool closed = false,
                          Status* status = nullptr) {
        const detail::PointArrays arrays(points);
        detail::check(roundel_sources_add_polyline(handle_.get(), points.size(),
                                                   arrays.faces.data(), arrays.barycentric.data(),
                                                   closed ? 1 : 0),
                      status);
        return *this;
    }

    /// Adds a set of edges: one source.
    Sources& add_edges(span<const std::int32_t> edges, Status* status = nullptr) {
        detail::check(roundel_sources_add_edges(handle_.get(), edges.size(), edges.data()), status);
        return *this;
    }

    /// Adds the boundary of a mesh, each loop a source.
    Sources& add_boundary(const Mesh& mesh, Status* status = nullptr) {
        detail::check(roundel_sources_add_boundary(handle_.get(), mesh.get()), status);
        return *this;
    }

    /// The number of sources.
    std::size_t size(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_sources_count(handle_.get(), &count), status);
        return count;
    }

    /// The handle for calls of the C interface.
    const roundel_sources* get() const noexcept { return handle_.get(); }

  private:
    detail::Handle<roundel_sources, roundel_sources_free> handle_;
};

/// Options of geodesic distances.
struct GeodesicOptions {
    /// Distances above this are infinite.
    double limit = std::numeric_limits<double>::infinity();
    /// Whether distances, gradients and paths are wanted at other points than vertices, which takes
    /// more memory.
    bool everywhere = false;

    GeodesicOptions& set_limit(double value) {
        limit = value;
        return *this;
    }
    GeodesicOptions& set_everywhere(bool value) {
        everywhere = value;
        return *this;
    }
};

/// The exact distance along the surface of every vertex from the nearest source. Methods that ask
/// about points take the mesh that it was computed on.
class GeodesicDistance {
  public:
    /// No distances, which a call returns when it reports a failure in a Status.
    GeodesicDistance() noexcept = default;

    /// Takes ownership of distances of the C interface that were computed on `mesh`.
    GeodesicDistance(roundel_geodesic* owned, const Mesh& mesh, Status* status = nullptr)
        : handle_(owned) {
        distances_.resize(mesh.vertices(status));
        sources_.resize(distances_.size());
        if (detail::check(roundel_geodesic_distances(owned, distances_.data(), distances_.size()),
                          status)) {
            detail::check(roundel_geodesic_nearest_sources(owned, sources_.data(), sources_.size()),
                          status);
        }
    }

    /// Whether there are distances.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The distance of every vertex; infinite beyond the limit and where no source can be reached.
    span<const double> distances() const noexcept {
        return span<const double>(distances_.data(), distances_.size());
    }

    /// The number of the nearest source of every vertex; -1 where the distance is infinite.
    span<const std::int32_t> nearest_sources() const noexcept {
        return span<const std::int32_t>(sources_.data(), sources_.size());
    }

    /// The distances of points.
    std::vector<double> at(const Mesh& mesh, span<const SurfacePoint> points,
                           Status* status = nullptr) const {
        const detail::PointArrays arrays(points);
        std::vector<double> found(points.size());
        detail::check(roundel_geodesic_distances_at(get(), mesh.get(), points.size(),
                                                    arrays.faces.data(), arrays.barycentric.data(),
                                                    found.data()),
                      status);
        return found;
    }

    /// The gradients at points: unit vectors, x, y, z in turn; null on the sources and where the
    /// distance is infinite.
    std::vector<double> gradients(const Mesh& mesh, span<const SurfacePoint> points,
                                  Status* status = nullptr) const {
        const detail::PointArrays arrays(points);
        std::vector<double> found(3 * points.size());
        detail::check(roundel_geodesic_gradients_at(get(), mesh.get(), points.size(),
                                                    arrays.faces.data(), arrays.barycentric.data(),
                                                    found.data()),
                      status);
        return found;
    }

    /// A shortest path from a point to the nearest source; empty where the distance is infinite.
    std::vector<SurfacePoint> path(const Mesh& mesh, const SurfacePoint& from,
                                   Status* status = nullptr) const {
        std::size_t count = 0;
        if (!detail::check(roundel_geodesic_path(get(), mesh.get(), from.face,
                                                 from.barycentric.data(), 0, nullptr, nullptr,
                                                 &count),
                           status) ||
            count == 0) {
            return {};
        }
        std::vector<std::int32_t> faces(count);
        std::vector<double> weights(3 * count);
        if (!detail::check(roundel_geodesic_path(get(), mesh.get(), from.face,
                                                 from.barycentric.data(), count, faces.data(),
                                                 weights.data(), &count),
                           status)) {
            return {};
        }
        std::vector<SurfacePoint> points(count);
        for (std::size_t i = 0; i < count; ++i) {
            points[i] = {faces[i], {weights[3 * i], weights[3 * i + 1], weights[3 * i + 2]}};
        }
        return points;
    }

    /// The handle for calls of the C interface.
    const roundel_geodesic* get() const noexcept { return handle_.get(); }

  private:
    detail::Handle<roundel_geodesic, roundel_geodesic_free> handle_;
    std::vector<double> distances_{};
    std::vector<std::int32_t> sources_{};
};

/// The exact distance along a mesh from the nearest of some sources. Sources that are not on the
/// mesh are failures, whose index is the number of the source.
inline GeodesicDistance geodesic_distance(const Mesh& mesh, const Sources& sources,
                                          const GeodesicOptions& options = {},
                                          Status* status = nullptr) {
    roundel_geodesic* made = nullptr;
    const bool found =
        detail::check(roundel_geodesic_new(mesh.get(), sources.get(), options.limit,
                                           options.everywhere ? 1 : 0, nullptr, &made),
                      status);
    return found ? GeodesicDistance(made, mesh, status) : GeodesicDistance();
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_GEODESIC_HPP
