// Quads: extracted from maps and from plain coordinates, and made in one call.

#include "wrapper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

/// Whether two quad meshes are equal to the last bit.
bool same(const roundel::Quads& one, const roundel::Quads& other) {
    const auto a = one.vertices(), b = other.vertices();
    const auto c = one.corners(), d = other.corners();
    return std::equal(a.begin(), a.end(), b.begin(), b.end()) &&
           std::equal(c.begin(), c.end(), d.begin(), d.end());
}

/// The share of a run never falls and comes to 1, and a run is finished with its first integers.
void runs_are_followed_and_finished(const roundel::Mesh& mesh) {
    double share = 0.0;
    auto stage = roundel::Stage::solve;
    const auto follow = roundel::Options().set_on_event([&](const roundel::Event& event) {
        CHECK(share <= event.share && event.share <= 1.0);
        share = event.share;
        stage = event.stage;
        return roundel::go_on;
    });
    CHECK(roundel::quadrangulate(mesh, roundel::QuadOptions().set_solve(follow)));
    CHECK(share == 1.0 && roundel::name(stage) == "smooth");

    const auto hurry = roundel::Options().set_on_event([](const roundel::Event& event) {
        return event.kind == roundel::EventKind::improved ? roundel::finish : roundel::go_on;
    });
    CHECK(roundel::quadrangulate(mesh, roundel::QuadOptions().set_solve(hurry)).size() > 0);

    // A token does the same from the first integers on. Before them there is nothing to finish.
    const roundel::CancelToken token;
    const auto by_token = roundel::Options().set_cancel(token).set_on_event([&](const auto& event) {
        if (event.kind == roundel::EventKind::improved) {
            token.finish();
        }
        return roundel::go_on;
    });
    const auto given = roundel::QuadOptions().set_solve(by_token);
    CHECK(roundel::quadrangulate(mesh, given).size() > 0 && !token.is_cancelled());
    roundel::Status status;
    CHECK(!roundel::quadrangulate(mesh, given, &status));
    CHECK(status.code == ROUNDEL_ERROR_CANCELLED);
}

} // namespace

void unset_quad_options_have_the_librarys_defaults() {
    using roundel::QuadOptions;
    const auto mesh = roundel::Mesh::shape("rounded-cube", 800);
    const auto silent = roundel::quadrangulate(mesh, QuadOptions().set_quads(150));
    const auto lattice = roundel::Options().set_strategy("lattice");
    const auto spoken =
        QuadOptions().set_quads(150).set_features({}).set_solve(lattice).set_field_strategy(
            "adaptive");
    CHECK(same(silent, roundel::quadrangulate(mesh, spoken)));
    // A callback changes nothing.
    int events = 0;
    const auto watched = roundel::Options().set_on_event([&](const roundel::Event&) {
        ++events;
        return roundel::go_on;
    });
    const auto seen = QuadOptions().set_quads(150).set_solve(watched);
    CHECK(same(silent, roundel::quadrangulate(mesh, seen)) && events > 10);
    runs_are_followed_and_finished(mesh);

    // Every option has an effect.
    std::vector<double> rising(mesh.vertices());
    for (std::size_t v = 0; v < rising.size(); ++v) {
        rising[v] = 1.0 + static_cast<double>(v) / static_cast<double>(rising.size());
    }
    const std::vector<QuadOptions> others = {
        QuadOptions().set_quads(150).set_constrain_curvature(0.5),
        QuadOptions().set_quads(150).set_detail(0.7),
        QuadOptions().set_quads(150).set_smooth(false),
        QuadOptions().set_edge_length(0.1),
        QuadOptions().set_edge_lengths(std::vector<double>(2 * mesh.faces(), 0.3)),
        QuadOptions().set_quads(150).set_adapt(1.0),
        QuadOptions().set_quads(150).set_near("vertices").set_near_vertices({0}),
        QuadOptions().set_quads(150).set_density(rising),
    };
    for (const auto& other : others) {
        const auto made = roundel::quadrangulate(mesh, other);
        CHECK(made.conforming() && !same(silent, made));
    }
    roundel::Status status;
    const auto unknown = QuadOptions().set_field_strategy("luck");
    CHECK(!roundel::quadrangulate(mesh, unknown, &status) && !status);
}

/// Quads are symmetric to the last bit, and a plane that cuts nothing is refused.
void quads_are_mirrored() {
    const auto torus = roundel::Mesh::shape("torus", 600);
    const auto plane = torus.mirror_plane("-1,0,0,0");
    CHECK(plane.normal[0] == -1.0 && plane.offset == 0.0 && plane.deviation < 0.05);
    const auto options = roundel::QuadOptions().set_quads(200).set_mirror({"-1,0,0,0"});
    const auto made = roundel::quadrangulate(torus, options);
    CHECK(made.conforming());
    const auto points = made.vertices();
    std::size_t images = 0;
    for (std::size_t v = 0; v < points.size(); v += 3) {
        for (std::size_t w = 0; w < points.size(); w += 3) {
            const bool is_image = points[w] == -points[v] && points[w + 1] == points[v + 1] &&
                                  points[w + 2] == points[v + 2];
            images += is_image ? 1 : 0;
        }
    }
    CHECK(3 * images == points.size());
    roundel::Status status;
    const auto beside = roundel::QuadOptions().set_mirror({"1,0,0,9"}).set_mirror_tolerance(1.0);
    CHECK(!roundel::quadrangulate(torus, beside, &status));
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    CHECK(!roundel::quadrangulate(torus, roundel::QuadOptions().set_mirror({"w"}), &status));
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    torus.mirror_plane("w", &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
}

void labels_and_numbers_come_to_quads() {
    const auto plane = roundel::Mesh::shape("plane", 800);
    const auto points = plane.coordinates();
    const auto triangles = plane.corners();
    const auto quads = roundel::quadrangulate(plane, roundel::QuadOptions().set_quads(100));
    CHECK(quads.conforming());
    const auto center = [](const auto& at, const auto& corners, std::size_t from, std::size_t n) {
        double x = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            x += at[3 * static_cast<std::size_t>(corners[from + k])];
        }
        return x / static_cast<double>(n);
    };
    std::vector<double> linear, corners;
    const auto value = [&](std::size_t v) { return 2.0 * points[3 * v] - points[3 * v + 1]; };
    for (std::size_t v = 0; v < points.size() / 3; ++v) {
        linear.push_back(value(v));
        linear.push_back(7.0);
    }
    for (const auto v : triangles) {
        corners.push_back(value(static_cast<std::size_t>(v)));
    }
    // The middle of the plane, and a distance within which a quad may be of both sides.
    double middle = 0.0, width = 0.0;
    for (std::size_t v = 0; v < points.size(); v += 3) {
        middle = std::max(middle, points[v]);
        width = std::min(width, points[v]);
    }
    width = middle - width;
    middle -= 0.5 * width;
    std::vector<std::int32_t> labels;
    for (std::size_t f = 0; f < triangles.size(); f += 3) {
        labels.push_back(center(points, triangles, f, 3) < middle ? 4 : -1);
    }
    const auto found = quads.transfer_face_labels(plane, {labels.data(), labels.size()});
    CHECK(found.size() == quads.size());
    std::size_t sides = 0;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const double x = center(quads.vertices(), quads.corners(), 4 * q, 4) - middle;
        if (std::abs(x) > 0.1 * width) {
            CHECK(found[q] == (x < 0.0 ? 4 : -1));
            ++sides;
        }
    }
    CHECK(sides > 50);
    const auto close = [](double a, double b) { return std::abs(a - b) < 1e-12; };
    const auto expected = [&](std::size_t v) {
        return 2.0 * quads.vertices()[3 * v] - quads.vertices()[3 * v + 1];
    };
    const auto of_vertices = quads.transfer_vertex_values(plane, 2, {linear.data(), linear.size()});
    CHECK(3 * of_vertices.size() == 2 * quads.vertices().size());
    for (std::size_t v = 0; 2 * v < of_vertices.size(); ++v) {
        CHECK(close(of_vertices[2 * v], expected(v)) && of_vertices[2 * v + 1] == 7.0);
    }
    const auto of_corners =
        quads.transfer_corner_values(plane, 1, {corners.data(), corners.size()});
    CHECK(of_corners.size() == quads.corners().size());
    for (std::size_t k = 0; k < of_corners.size(); ++k) {
        CHECK(close(of_corners[k], expected(static_cast<std::size_t>(quads.corners()[k]))));
    }
    roundel::Status status;
    CHECK(quads.transfer_face_labels(plane, {}, &status).empty());
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(quads.transfer_vertex_values(plane, 3, {linear.data(), linear.size()}, &status).empty());
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(quads.transfer_corner_values(plane, 0, {}, &status).empty());
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
}

void meshes_become_quads_of_their_topology() {
    const auto mesh = roundel::Mesh::shape("torus", 800);
    const auto made = roundel::quadrangulate(mesh, roundel::QuadOptions().set_quads(300));
    CHECK(made && made.conforming() && made.others().empty());
    CHECK(made.euler_characteristic() == 0 && made.size() > 200 && made.size() < 400);
    CHECK(made.near_feature_count() == 0 && made.paired_face_count() == 0);
    // On a closed torus there are as many vertices as quads.
    CHECK(made.vertices().size() == 3 * made.size());

    // The C function gives the same quads.
    roundel_quad_options* options = nullptr;
    roundel_quads* plain = nullptr;
    CHECK(roundel_quad_options_new(&options) == ROUNDEL_OK);
    CHECK(roundel_quad_options_set_int(options, "quads", 300) == ROUNDEL_OK);
    CHECK(roundel_quads_make(mesh.get(), options, nullptr, &plain) == ROUNDEL_OK);
    CHECK(roundel_quad_options_free(options) == ROUNDEL_OK);
    const roundel::Quads same(plain);
    CHECK(same.corners().size() == made.corners().size());
    for (std::size_t i = 0; i < same.vertices().size(); ++i) {
        CHECK(same.vertices()[i] == made.vertices()[i]);
    }

    const auto none_at_fault = made.faults();
    CHECK(none_at_fault.faces.empty() && none_at_fault.edges.empty());

    // Extraction alone, from a map and from its coordinates.
    const auto field = roundel::orientation_field(mesh);
    const auto map = roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(200));
    auto quads = roundel::quads(map);
    const auto again = roundel::quads(mesh, map.corner_uvs());
    CHECK(quads.conforming() && quads.size() == again.size());
    const std::vector<double> before(quads.vertices().begin(), quads.vertices().end());
    quads.smooth(mesh);
    CHECK(quads.vertices().size() == before.size() && quads.vertices()[0] != before[0]);

    // A collapsed map has no quads. The error names a triangle by its number.
    const std::vector<double> collapsed(6 * mesh.faces(), 0.5);
    const auto nothing = roundel::quads(mesh, {collapsed.data(), collapsed.size()});
    CHECK(nothing && !nothing.conforming() && nothing.size() == 0);
    const auto faults = nothing.faults();
    CHECK(faults.faces.empty() && faults.triangles.size() == mesh.faces());
    CHECK(faults.triangles.front() == 0);
    CHECK(roundel_quads_faults(nothing.get(), 1, nullptr, 0, nullptr, 0, nullptr, 0, nullptr) ==
          ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(roundel_quads_fault_counts(nothing.get(), nullptr, nullptr, nullptr, nullptr) ==
          ROUNDEL_ERROR_NULL_POINTER);

    roundel::Status status;
    CHECK(!roundel::quadrangulate(mesh, roundel::QuadOptions().set_quads(0), &status));
    CHECK(status.code == ROUNDEL_ERROR_OPTION_RANGE);
    std::vector<double> short_of(6);
    CHECK(!roundel::quads(mesh, {short_of.data(), short_of.size()}, &status));
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(!roundel::quads(mesh, {short_of.data(), 5}, &status));
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    roundel_quads* none = nullptr;
    CHECK(roundel_quads_extract(nullptr, &none) == ROUNDEL_ERROR_NULL_POINTER);
    CHECK(roundel_quads_make(mesh.get(), nullptr, nullptr, nullptr) == ROUNDEL_ERROR_NULL_POINTER);
    CHECK(roundel_quads_free(nullptr) == ROUNDEL_OK && none == nullptr);
}
