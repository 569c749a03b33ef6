// Soups, and the meshes that repair makes of them.

#include "wrapper.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

/// The corners of a cube, each once a face: 24 vertices, six squares.
struct Box {
    std::vector<double> coordinates{};
    std::vector<std::int32_t> sizes = std::vector<std::int32_t>(6, 4);
    std::vector<std::int32_t> corners{};
};

Box box() {
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    Box made;
    for (const auto& face : faces) {
        for (const int corner : face) {
            made.corners.push_back(static_cast<std::int32_t>(made.corners.size()));
            for (int axis = 0; axis < 3; ++axis) {
                made.coordinates.push_back((corner >> axis) & 1);
            }
        }
    }
    return made;
}

} // namespace

void soups_become_meshes_and_say_how() {
    const auto given = box();
    const roundel::Soup soup(given.coordinates, given.sizes, given.corners);
    CHECK(soup && soup.vertices() == 24 && soup.polygons() == 6);
    CHECK(soup.coordinates() == given.coordinates && soup.sizes() == given.sizes);
    CHECK(soup.corners() == std::vector<std::int64_t>(given.corners.begin(), given.corners.end()));

    const auto repair = roundel::repair(soup);
    const auto mesh = repair.mesh();
    CHECK(mesh.vertices() == 8 && mesh.faces() == 12 && mesh.euler_characteristic() == 2);
    CHECK(repair.count(ROUNDEL_EDIT_VERTEX_WELDED) == 16);
    CHECK(repair.count(ROUNDEL_EDIT_POLYGON_TRIANGULATED) == 6);
    CHECK(repair.summary() == "welded 16 vertices, triangulated 6 polygons");
    const auto edits = repair.edits();
    CHECK(edits.size() == 22 && edits.front().name() == "vertex_welded");
    const auto welded = repair.welded_to();
    for (const auto& edit : edits) {
        if (edit.kind == ROUNDEL_EDIT_VERTEX_WELDED) {
            CHECK(welded[static_cast<std::size_t>(edit.element)] == edit.other);
        }
    }
    CHECK(repair.vertex_origins().size() == 8 && repair.vertex_origins()[0] == 0);
    CHECK(repair.face_origins().size() == 12 && repair.face_origins()[11] == 5);

    // What comes out is taken as it is.
    const std::vector<std::int32_t> threes(mesh.faces(), 3);
    const auto again = roundel::repair(roundel::Soup(mesh.coordinates(), threes, mesh.corners()));
    CHECK(again.edits().empty() && again.summary().empty());
    CHECK(again.mesh().corners() == mesh.corners());
}

void repair_follows_its_options() {
    auto given = box();
    // Without its last square the box has a hole of four edges. A vertex is off by a little, and so
    // the edges at it and a vertex of the hole are open as well.
    given.sizes.pop_back();
    given.corners.resize(20);
    given.coordinates.resize(60);
    given.coordinates[0] += 1e-6;
    const roundel::Soup open(given.coordinates, given.sizes, given.corners);
    const auto plain = roundel::repair(open);
    CHECK(plain.mesh().boundary_loops() == 1 && plain.mesh().vertices() == 10);
    const auto options = roundel::RepairOptions().set_weld(1e-5).set_fill_holes(4);
    const auto closed = roundel::repair(open, options);
    CHECK(closed.mesh().boundary_loops() == 0 && closed.mesh().vertices() == 8);
    CHECK(closed.count(ROUNDEL_EDIT_HOLE_FILLED) == 1);
    CHECK(closed.face_origins().back() == -1);
    const auto all = roundel::repair(open, roundel::RepairOptions().set_drop_components(1.0));
    CHECK(all.mesh().faces() == plain.mesh().faces());

    roundel::Status status;
    CHECK(!roundel::repair(open, roundel::RepairOptions().set_weld(-1.0), &status));
    CHECK(status.code == ROUNDEL_ERROR_OPTION_RANGE);
    CHECK(!roundel::repair(roundel::Soup(), {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_NULL_POINTER);
    const roundel::Soup lied({given.coordinates.data(), 4}, given.sizes, given.corners, &status);
    CHECK(!lied && status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    const roundel::Soup short_of(given.coordinates, {given.sizes.data(), 1}, given.corners,
                                 &status);
    CHECK(!short_of && status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
}

void files_of_polygons_become_meshes() {
    const std::string file = "wrapper_soup.obj";
    std::FILE* out = std::fopen(file.c_str(), "w");
    CHECK(out != nullptr);
    std::fputs("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", out);
    std::fclose(out);
    roundel::Status status;
    CHECK(!roundel::Mesh::read(file, &status) && status.code == ROUNDEL_ERROR_NOT_A_TRIANGLE);
    CHECK(roundel::Mesh::repaired(file).faces() == 2);
    CHECK(roundel::Soup::read(file).polygons() == 1);
    CHECK(roundel::Soup::read_as(file, "obj").polygons() == 1);
    CHECK(!roundel::Soup::read_as(file, "glb", &status) && status.code == ROUNDEL_ERROR_PARSE);
    CHECK(!roundel::Mesh::repaired("never.stl", &status) && status.code == ROUNDEL_ERROR_IO);
    CHECK(std::remove(file.c_str()) == 0);
}

void edges_between_materials_are_told() {
    const std::string file = "wrapper_materials.obj";
    std::FILE* out = std::fopen(file.c_str(), "w");
    CHECK(out != nullptr);
    std::fputs("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n", out);
    std::fclose(out);
    const auto repair = roundel::repair(roundel::Soup::read(file));
    const auto edges = repair.attribute_edges(file, "materials");
    CHECK(edges.size() == 1);
    const auto marks = roundel::mark_features(
        repair.mesh(), roundel::Features().set_edges(edges).set_boundary(false));
    CHECK(marks[static_cast<std::size_t>(edges[0])] == 1);
    roundel::Status status;
    CHECK(repair.attribute_edges(file, "seams", &status).empty());
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    CHECK(status.message.find("it has materials") != std::string::npos);
    CHECK(repair.attribute_edges(file, "colour", &status).empty());
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    CHECK(roundel::Repair().attribute_edges(file, "seams", &status).empty());
    CHECK(status.code == ROUNDEL_ERROR_NULL_POINTER);
    CHECK(std::remove(file.c_str()) == 0);
}

void attributes_come_from_the_file_of_a_mesh() {
    const std::string obj = "wrapper_attributes.obj";
    if (std::FILE* file = std::fopen(obj.c_str(), "w")) {
        // Two squares side by side, of two materials.
        std::fputs("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 2 0 0 0 0 1\nv 0 1 0 1 0 0\nv 1 1 0 0 1 0\n"
                   "v 2 1 0 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                   "usemtl wood\nf 1/1 2/2 5/3 4/4\nusemtl steel\nf 2/1 3/2 6/3 5/4\n",
                   file);
        std::fclose(file);
    }
    const auto repair = roundel::repair(roundel::Soup::read(obj));
    const auto mesh = repair.mesh();
    const auto found = roundel::attributes(repair, obj);
    CHECK((found.materials.names == std::vector<std::string>{"wood", "steel"}));
    CHECK((found.materials.labels == std::vector<std::int32_t>{0, 0, 1, 1}));
    CHECK(found.groups.names.empty() && found.groups.labels.empty() && found.scalars.empty());
    CHECK(found.face_colors.empty() && found.uv.size() == 24);
    CHECK(found.vertex_colors.size() == 24 && found.vertex_colors[0] == 1.0);
    CHECK(found.vertex_colors[11] == 1.0 && found.vertex_colors[10] == 1.0);

    // The mesh of the same file with triangles alone.
    const std::string ply = "wrapper_attributes.ply";
    if (std::FILE* file = std::fopen(ply.c_str(), "w")) {
        std::fputs("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nproperty float heat\nelement face 1\n"
                   "property list uchar int vertex_indices\nproperty uchar red\n"
                   "property uchar green\nproperty uchar blue\nend_header\n"
                   "0 0 0 1.5\n1 0 0 2\n0 1 0 3\n3 0 1 2 255 0 51\n",
                   file);
        std::fclose(file);
    }
    const auto triangle = roundel::Mesh::read(ply);
    const auto of_triangle = roundel::attributes(triangle, ply);
    CHECK(of_triangle.scalars.size() == 1 && of_triangle.scalars[0].name == "heat");
    CHECK((of_triangle.scalars[0].values == std::vector<double>{1.5, 2.0, 3.0}));
    CHECK((of_triangle.face_colors == std::vector<double>{1.0, 0.0, 0.2, 1.0}));
    roundel::Status status;
    CHECK(roundel::attributes(triangle, obj, &status).materials.names.empty());
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(roundel::attributes(mesh, "none.obj", &status).uv.empty());
    CHECK(status.code == ROUNDEL_ERROR_IO);
    std::remove(obj.c_str());
    std::remove(ply.c_str());
}
