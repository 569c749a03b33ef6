// Base layouts, and quads that follow them.

#include "wrapper.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

void quads_follow_a_layout() {
    const std::vector<double> corners{-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                      -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
    const std::vector<std::int32_t> sizes(6, 4);
    const std::vector<std::int32_t> sides{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                          2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    roundel::BaseLayout cube(corners, sizes, sides);
    const auto arcs = cube.arcs();
    CHECK(arcs.size() == 12 && arcs[0][0] == 0 && arcs[0][1] == 2);
    const auto sphere = roundel::Mesh::shape("sphere", 600);
    cube.fix_arc(0, 4).draw_arc(0, std::vector<double>{-1, -1, -1, -0.7, 0, -0.7, -1, 1, -1});
    const auto found = roundel::quads_of_layout(sphere, cube, 150);
    CHECK(found.quads.conforming() && found.quads.irregular_count() == 8);
    CHECK(found.subdivisions.size() == 12 && found.subdivisions[0] == 4);
    CHECK(roundel::quads_of_layout(sphere, cube.hold_arcs(), 150).quads.conforming());
    const auto layout = roundel::BaseLayout::of_quads(cube.soup());
    layout.write("wrapper_layout.obj");
    CHECK(roundel::BaseLayout::read("wrapper_layout.obj").arcs().size() == 12);
    CHECK(std::remove("wrapper_layout.obj") == 0);
    roundel::Status status;
    CHECK(!roundel::BaseLayout::of_quads(cube.soup(), -1.0, &status).get());
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    cube.fix_arc(12, 4, &status);
    CHECK(status.code == ROUNDEL_ERROR_INDEX_OUT_OF_RANGE);
    const std::vector<std::int32_t> one(1, 2);
    CHECK(!roundel::BaseLayout(corners, one, std::vector<std::int32_t>{0, 1}, &status).get());
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT && status.index == 0);
    CHECK(!roundel::BaseLayout::read("no/such.obj", &status).get());
    CHECK(status.code == ROUNDEL_ERROR_IO);
}
