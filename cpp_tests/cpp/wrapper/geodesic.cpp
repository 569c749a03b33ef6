// Exact geodesic distances.

#include "wrapper.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

double apart(const std::vector<double>& xyz, std::size_t one, std::size_t other) {
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = xyz[3 * one + axis] - xyz[3 * other + axis];
        square += d * d;
    }
    return std::sqrt(square);
}

} // namespace

void distances_follow_the_surface() {
    const auto plane = roundel::Mesh::shape("plane", 200);
    const auto xyz = plane.coordinates();
    roundel::Sources sources;
    sources.add_vertex(3).add_vertex(40);
    CHECK(sources.size() == 2);
    const auto found =
        roundel::geodesic_distance(plane, sources, roundel::GeodesicOptions().set_everywhere(true));
    CHECK(found.distances().size() == plane.vertices());
    for (std::size_t v = 0; v < plane.vertices(); ++v) {
        const double exact = std::fmin(apart(xyz, v, 3), apart(xyz, v, 40));
        CHECK(std::fabs(found.distances()[v] - exact) < 1e-14);
        const auto source = static_cast<std::size_t>(found.nearest_sources()[v]);
        CHECK(std::fabs(apart(xyz, v, source == 0 ? 3 : 40) - exact) < 1e-14);
    }
    const roundel::SurfacePoint point{150, {0.5, 0.25, 0.25}};
    const auto distance = found.at(plane, {&point, 1});
    const auto gradient = found.gradients(plane, {&point, 1});
    const auto path = found.path(plane, point);
    CHECK(distance[0] > 0.0 && path.size() > 2 && path.front().face == 150);
    CHECK(std::fabs(std::hypot(gradient[0], gradient[1], gradient[2]) - 1.0) < 1e-12);
    // The path is a source at distance 0 of its points.
    roundel::Sources line;
    line.add_polyline(path);
    roundel::GeodesicOptions everywhere;
    everywhere.everywhere = true;
    const auto from_line = roundel::geodesic_distance(plane, line, everywhere);
    CHECK(from_line.at(plane, {&point, 1})[0] < 1e-15);
}

void the_boundary_points_and_edges_are_sources() {
    const auto plane = roundel::Mesh::shape("plane", 200);
    roundel::Sources boundary;
    boundary.add_boundary(plane);
    const auto found = roundel::geodesic_distance(plane, boundary);
    double largest = 0.0;
    for (const double d : found.distances()) {
        largest = std::fmax(largest, d);
    }
    CHECK(boundary.size() == 1 && std::fabs(largest - 1.0) < 1e-14);
    const roundel::SurfacePoint point{7, {0.0, 0.5, 0.5}};
    const std::vector<std::int32_t> edges{5, 6};
    roundel::Sources both;
    both.add_points({&point, 1}).add_edges(edges);
    const auto near =
        roundel::geodesic_distance(plane, both, roundel::GeodesicOptions().set_limit(0.5));
    CHECK(std::isinf(near.distances()[plane.vertices() - 1]));
    roundel::Status status;
    both.add_vertex(1000000);
    CHECK(!roundel::geodesic_distance(plane, both, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_INDEX_OUT_OF_RANGE && status.index == 2);
}
