// <roundel/openmesh.hpp>: fields of OpenMesh meshes, deleted elements, results in properties.

#include "../../cpp/check.hpp"

#include <roundel/openmesh.hpp>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
// A mesh with float coordinates whose faces may be polygons.
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

constexpr double half_pi = 1.57079632679489661923;

template <class M> M build(const roundel::Mesh& from) {
    M mesh;
    const auto xyz = from.coordinates();
    const auto corners = from.corners();
    for (std::size_t v = 0; v < xyz.size(); v += 3) {
        typename M::Point point;
        for (unsigned axis = 0; axis < 3; ++axis) {
            point[axis] = static_cast<typename M::Scalar>(xyz[v + axis]);
        }
        mesh.add_vertex(point);
    }
    for (std::size_t f = 0; f < corners.size(); f += 3) {
        mesh.add_face(OpenMesh::VertexHandle(corners[f]), OpenMesh::VertexHandle(corners[f + 1]),
                      OpenMesh::VertexHandle(corners[f + 2]));
    }
    return mesh;
}

/// The properties hold the field: the energy computed from them is that of the field.
template <class M> void properties_hold_the_field(M& mesh, const roundel::openmesh::Field& field) {
    const auto p = roundel::store(field, mesh);
    double energy = 0.0, sum = 0.0;
    for (const auto h : mesh.halfedges()) {
        const auto back = mesh.opposite_halfedge_handle(h);
        CHECK(mesh.property(p.period_jump, h) == -mesh.property(p.period_jump, back));
        if (mesh.is_boundary(mesh.edge_handle(h))) {
            CHECK(mesh.property(p.period_jump, h) == 0);
            continue;
        }
        const double residual = mesh.property(p.angle, mesh.face_handle(h)) +
                                mesh.property(p.kappa, h) +
                                half_pi * mesh.property(p.period_jump, h) -
                                mesh.property(p.angle, mesh.face_handle(back));
        energy += 0.5 * residual * residual;
    }
    CHECK(std::abs(energy - field.energy()) <= 1e-9 * energy);
    for (const auto v : mesh.vertices()) {
        const double index = mesh.property(p.index, v);
        CHECK(std::abs(4.0 * index - std::round(4.0 * index)) < 1e-8);
        sum += index;
    }
    for (const double index : field.boundary_indices()) {
        sum += index;
    }
    CHECK(std::abs(sum - static_cast<double>(field.elements().mesh.euler_characteristic())) < 1e-6);
    // A second call finds and uses the same properties.
    const auto again = roundel::store(field, mesh);
    CHECK(again.angle.idx() == p.angle.idx() && again.kappa.idx() == p.kappa.idx());
}

void every_mesh_type_has_fields() {
    const auto shape = roundel::Mesh::shape("genus-2", 900).jittered(1e-3, 1);
    const auto options = roundel::FieldOptions().set_constraints({{5, 0.25}, {400, 1.0}});
    auto triangles = build<TriMesh>(shape);
    properties_hold_the_field(triangles, roundel::orientation_field(triangles, options));
    auto polygons = build<PolyMesh>(shape);
    properties_hold_the_field(polygons, roundel::orientation_field(polygons, options));
}

void curvature_is_followed_as_on_the_librarys_own_mesh() {
    const auto mesh = build<TriMesh>(roundel::Mesh::shape("torus", 600).jittered(1e-3, 1));
    const auto options = roundel::FieldOptions().set_constrain_curvature(0.1);
    const auto field = roundel::orientation_field(mesh, options);
    const auto own = roundel::orientation_field(field.elements().mesh, options);
    CHECK(std::equal(field.angles().begin(), field.angles().end(), own.angles().begin()));
    for (const auto& c : field.elements().mesh.curvature_constraints(0.1)) {
        CHECK(field.angles()[static_cast<std::size_t>(c.face)] == c.angle);
    }
}

/// With deleted elements, the field is that of the mesh without them.
void deleted_elements_are_skipped() {
    auto mesh = build<TriMesh>(roundel::Mesh::shape("sphere", 500).jittered(1e-3, 1));
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    mesh.request_halfedge_status();
    mesh.delete_vertex(OpenMesh::VertexHandle(17));
    mesh.delete_vertex(OpenMesh::VertexHandle(100));
    mesh.delete_face(OpenMesh::FaceHandle(3));
    const roundel::FieldOptions options =
        roundel::FieldOptions().set_constraints({{40, 0.5}}).set_features(roundel::no_features());
    const auto field = roundel::orientation_field(mesh, options);
    CHECK(field.elements().mesh.faces() < mesh.n_faces());
    CHECK(field.elements().mesh.vertices() == mesh.n_vertices() - 2);
    CHECK(field.boundary_indices().size() == 3);
    for (const auto face : field.elements().faces) {
        CHECK(!mesh.status(face).deleted());
    }
    const auto p = roundel::store(field, mesh);
    const auto fixed = field.elements().faces[40];
    CHECK(fixed.idx() > 40 && mesh.property(p.angle, fixed) == 0.5);

    mesh.garbage_collection();
    // The garbage collection keeps the properties at their elements.
    double energy = 0.0;
    for (const auto e : mesh.edges()) {
        if (mesh.is_boundary(e)) {
            continue;
        }
        const auto h = mesh.halfedge_handle(e, 0);
        const double residual = mesh.property(p.angle, mesh.face_handle(h)) +
                                mesh.property(p.kappa, h) +
                                half_pi * mesh.property(p.period_jump, h) -
                                mesh.property(p.angle, mesh.opposite_face_handle(h));
        energy += residual * residual;
    }
    CHECK(std::abs(energy - field.energy()) <= 1e-9 * energy);
}

/// Every half-edge has the coordinates of its end. They form a map, the same as the library's own.
void maps_are_kept_on_half_edges() {
    auto mesh = build<TriMesh>(roundel::Mesh::shape("gear", 1500));
    const auto options = roundel::FieldOptions().set_features(roundel::feature_angle(40));
    const auto field = roundel::orientation_field(mesh, options);
    const auto map = roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(400));
    const auto uv = roundel::store(map, mesh);
    CHECK(map && map.cones().size() == field.irregular_count());
    CHECK(roundel::store(map, mesh).idx() == uv.idx());
    const auto marks = roundel::mark_features(field.elements().mesh, options.features);
    const auto edges = field.elements().mesh.face_edges();
    std::size_t features = 0, flipped = 0;
    for (std::size_t f = 0; f < map.elements().faces.size(); ++f) {
        std::vector<OpenMesh::Vec2d> ends;
        for (std::size_t k = 0; k < 3; ++k) {
            // A side begins where the half-edge before it ends.
            const auto side = map.elements().halfedges[3 * f + k];
            const auto a = mesh.property(uv, mesh.prev_halfedge_handle(side));
            const auto b = mesh.property(uv, side);
            ends.push_back(b);
            CHECK(a[0] == map.corner_uvs()[6 * f + 2 * k]);
            CHECK(a[1] == map.corner_uvs()[6 * f + 2 * k + 1]);
            if (marks[static_cast<std::size_t>(edges[3 * f + k])]) {
                CHECK((a[0] == b[0] && a[0] == std::round(a[0])) ||
                      (a[1] == b[1] && a[1] == std::round(a[1])));
                ++features;
            }
        }
        const auto x = ends[1] - ends[0], y = ends[2] - ends[0];
        flipped += x[0] * y[1] - x[1] * y[0] <= 0.0;
    }
    CHECK(features > 100 && flipped == map.flipped().size() && map.valid() == (flipped == 0));
    roundel::Status status;
    auto other = build<TriMesh>(roundel::Mesh::shape("torus", 300));
    CHECK(!roundel::parametrize(other, field, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
}

void quads_come_back_as_a_mesh_of_polygons() {
    const auto mesh = build<TriMesh>(roundel::Mesh::shape("torus", 600));
    const auto quads = roundel::quadrangulate(mesh, roundel::QuadOptions().set_quads(200));
    const auto poly = roundel::mesh_of<PolyMesh>(quads);
    CHECK(quads.conforming() && poly.n_faces() == quads.size() && poly.n_faces() > 100);
    for (const auto face : poly.faces()) {
        CHECK(poly.valence(face) == 4);
    }
    for (const auto edge : poly.edges()) {
        CHECK(!poly.is_boundary(edge));
    }
}

void distances_are_kept_on_vertices() {
    TriMesh mesh;
    std::vector<TriMesh::VertexHandle> v;
    for (const float x : {0.0f, 3.0f}) {
        v.push_back(mesh.add_vertex({x, 0.0f, 0.0f}));
        v.push_back(mesh.add_vertex({x, 4.0f, 0.0f}));
    }
    mesh.add_face(v[0], v[2], v[3]);
    mesh.add_face(v[0], v[3], v[1]);
    roundel::Sources sources;
    sources.add_vertex(1);
    const auto to = roundel::store_distance(mesh, sources);
    const double expected[] = {4.0, 0.0, 5.0, 3.0};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(std::fabs(mesh.property(to, v[i]) - expected[i]) < 1e-15);
    }
}

void polygons_are_refused_by_number() {
    PolyMesh mesh;
    std::vector<OpenMesh::VertexHandle> v;
    for (float x : {0.0f, 1.0f, 2.0f}) {
        v.push_back(mesh.add_vertex({x, 0.0f, 0.0f}));
        v.push_back(mesh.add_vertex({x, 1.0f, 0.0f}));
    }
    mesh.add_face(v[0], v[2], v[3]);
    mesh.add_face(v[0], v[3], v[1]);
    mesh.add_face(v[2], v[4], v[5], v[3]);
    roundel::Status status;
    const auto field = roundel::orientation_field(mesh, {}, &status);
    CHECK(!field && status.code == ROUNDEL_ERROR_NOT_A_TRIANGLE && status.index == 2);
    PolyMesh empty;
    const auto none = roundel::orientation_field(empty, {}, &status);
    CHECK(!none && status.code == ROUNDEL_ERROR_EMPTY);
}

} // namespace

int main() {
    every_mesh_type_has_fields();
    curvature_is_followed_as_on_the_librarys_own_mesh();
    deleted_elements_are_skipped();
    maps_are_kept_on_half_edges();
    quads_come_back_as_a_mesh_of_polygons();
    distances_are_kept_on_vertices();
    polygons_are_refused_by_number();
    return failures != 0;
}
