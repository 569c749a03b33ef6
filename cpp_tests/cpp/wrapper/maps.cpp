// Guided fields and seamless maps.

#include "wrapper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

void fields_follow_their_options() {
    const auto mesh = roundel::Mesh::shape("disk", 600);
    const auto free = roundel::FieldOptions().set_features(roundel::no_features());
    for (const std::int32_t arms : {1, 2, 4, 6}) {
        auto options = roundel::FieldOptions().set_symmetry(arms);
        if (arms == 1) {
            options.set_features(roundel::no_features());
        }
        const auto field = roundel::orientation_field(mesh, options);
        const auto turns = field.vertex_indices();
        const auto steps = field.vertex_index_steps();
        CHECK(steps.size() == turns.size() && steps.size() == mesh.vertices());
        const std::int32_t loop = field.boundary_index_steps()[0];
        CHECK(field.boundary_indices()[0] == static_cast<double>(loop) / arms);
        std::int32_t sum = loop;
        std::size_t irregular = 0;
        for (std::size_t v = 0; v < steps.size(); ++v) {
            CHECK(turns[v] == static_cast<double>(steps[v]) / arms);
            sum += steps[v];
            irregular += steps[v] != 0;
        }
        CHECK(sum == arms && irregular == field.irregular_count());
    }
    // Crosses at the boundary follow it, which costs energy.
    CHECK(roundel::orientation_field(mesh).energy() >
          roundel::orientation_field(mesh, free).energy());
    const auto marks = roundel::mark_features(mesh, {});
    CHECK(std::count(marks.begin(), marks.end(), 1) > 20);
    const auto none = roundel::mark_features(mesh, roundel::no_features());
    CHECK(std::count(none.begin(), none.end(), 1) == 0);

    const auto sphere = roundel::Mesh::shape("sphere", 600);
    const auto two =
        roundel::orientation_field(sphere, roundel::FieldOptions().set_indices({{3, 7}, {200, 1}}));
    CHECK(two.irregular_count() == 2);
    CHECK(two.vertex_indices()[3] == 1.75 && two.vertex_index_steps()[3] == 7);
    CHECK(two.vertex_indices()[200] == 0.25 && two.boundary_index_steps().size() == 0);
    roundel::Status status;
    CHECK(!roundel::orientation_field(sphere, roundel::FieldOptions().set_indices({{3, 7}}),
                                      &status));
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);

    // The field follows a guide of large weight and keeps the constraint.
    auto guided = roundel::FieldOptions().set_constraints({{0, 0.5}});
    guided.set_guides({{100, 0.25, 1e6}}).set_curvature_weight(0.1).set_features({});
    const auto pulled = roundel::orientation_field(sphere, guided);
    CHECK(pulled.angles()[0] == 0.5 && std::abs(pulled.angles()[100] - 0.25) < 1e-3);
    const auto problem = roundel::orientation_problem(sphere, guided);
    const auto again = roundel::orientation_field(sphere, roundel::solve(problem), guided);
    CHECK(again.energy() == pulled.energy());
    CHECK(!roundel::orientation_field(sphere, guided.set_symmetry(3), &status));
    CHECK(status.message.find("symmetry") != std::string::npos);
}

void maps_are_solved_again_at_another_size() {
    const auto mesh = roundel::Mesh::shape("gear", 2000);
    const auto features = roundel::feature_angle(40);
    const auto field =
        roundel::orientation_field(mesh, roundel::FieldOptions().set_features(features));
    auto map = roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(500));
    CHECK(map && map.corner_uvs().size() == 6 * mesh.faces());
    CHECK(map.cones().size() == field.irregular_count());
    CHECK(map.valid() == map.flipped().empty());
    const auto same = [](const roundel::Map& a, const roundel::Map& b) {
        return std::equal(a.corner_uvs().begin(), a.corner_uvs().end(), b.corner_uvs().begin());
    };
    const auto finer = roundel::MapOptions().set_edge_length(0.08);
    const auto fresh = roundel::parametrize(mesh, field, finer);
    CHECK(!same(map, fresh));
    CHECK(same(map.solve(finer), fresh) && map.energy() == fresh.energy());
    // Without features of its own, a map takes those of its field.
    const auto given = roundel::MapOptions().set_edge_length(0.08).set_features(features);
    CHECK(same(roundel::parametrize(mesh, field, given), fresh));
    const std::vector<double> lengths(2 * mesh.faces(), 0.08);
    CHECK(same(map.solve(roundel::MapOptions().set_edge_lengths(lengths)), fresh));

    for (const auto& t : map.transitions()) {
        CHECK(t.quarters >= 0 && t.quarters < 4);
        CHECK(t.translation[0] == std::round(t.translation[0]));
    }
    const auto rounded =
        roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(80).set_untangle(false));
    CHECK(rounded.solution().energy() >= rounded.energy());
    const auto untangled = roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(80));
    CHECK(untangled.flipped().size() <= rounded.flipped().size());
    CHECK(untangled.valid() && untangled.winding_defects().empty());
    CHECK(rounded.valid() || untangled.rounds() + untangled.refinements() > 0);
    const auto soft =
        roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(80).set_stiffenings(0));
    CHECK(soft.valid());
    CHECK(rounded.rounds() == 0 && rounded.refinements() == 0);
    auto relaxed = roundel::MapOptions().set_quads(80);
    relaxed.solve.set_strategy("relax");
    CHECK(roundel::parametrize(mesh, field, relaxed).energy() <= rounded.energy());

    roundel::Status status;
    map.solve(roundel::MapOptions().set_edge_length(-1.0), &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT && same(map, fresh));
    auto watched = roundel::MapOptions().set_quads(700);
    watched.solve.set_on_event([](const roundel::Event&) { return roundel::stop; });
    map.solve(watched, &status);
    CHECK(status.code == ROUNDEL_ERROR_CANCELLED && same(map, fresh));
}
