// <roundel/vcg.hpp>: fields, maps and quads of VCG meshes, deleted elements, results in components.

#include "../../cpp/check.hpp"

#include <vcg/complex/complex.h>

#include <roundel/vcg.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

class TriVertex;
class TriFace;
struct TriTypes : vcg::UsedTypes<vcg::Use<TriVertex>::AsVertexType, vcg::Use<TriFace>::AsFaceType> {
};
class TriVertex : public vcg::Vertex<TriTypes, vcg::vertex::Coord3d, vcg::vertex::BitFlags> {};
class TriFace : public vcg::Face<TriTypes, vcg::face::VertexRef, vcg::face::WedgeTexCoord2d,
                                 vcg::face::CurvatureDird, vcg::face::BitFlags> {};
class TriMesh : public vcg::tri::TriMesh<std::vector<TriVertex>, std::vector<TriFace>> {};

// A mesh with float coordinates and no optional components.
class BareVertex;
class BareFace;
struct BareTypes
    : vcg::UsedTypes<vcg::Use<BareVertex>::AsVertexType, vcg::Use<BareFace>::AsFaceType> {};
class BareVertex : public vcg::Vertex<BareTypes, vcg::vertex::Coord3f, vcg::vertex::BitFlags> {};
class BareFace : public vcg::Face<BareTypes, vcg::face::VertexRef, vcg::face::BitFlags> {};
class BareMesh : public vcg::tri::TriMesh<std::vector<BareVertex>, std::vector<BareFace>> {};

class PolyVertex;
class PolyFace;
struct PolyTypes
    : vcg::UsedTypes<vcg::Use<PolyVertex>::AsVertexType, vcg::Use<PolyFace>::AsFaceType> {};
class PolyVertex : public vcg::Vertex<PolyTypes, vcg::vertex::Coord3d, vcg::vertex::BitFlags> {};
class PolyFace
    : public vcg::Face<PolyTypes, vcg::face::PolyInfo, vcg::face::PFVAdj, vcg::face::BitFlags> {};
class PolyMesh : public vcg::tri::TriMesh<std::vector<PolyVertex>, std::vector<PolyFace>> {};

constexpr double half_pi = 1.57079632679489661923;

template <class M> void build(const roundel::Mesh& from, M& mesh) {
    const auto xyz = from.coordinates();
    const auto corners = from.corners();
    for (std::size_t v = 0; v < xyz.size(); v += 3) {
        using Scalar = typename M::ScalarType;
        vcg::tri::Allocator<M>::AddVertex(mesh, {static_cast<Scalar>(xyz[v]),
                                                 static_cast<Scalar>(xyz[v + 1]),
                                                 static_cast<Scalar>(xyz[v + 2])});
    }
    const auto vertex = [](std::int32_t corner) { return static_cast<std::size_t>(corner); };
    for (std::size_t f = 0; f < corners.size(); f += 3) {
        vcg::tri::Allocator<M>::AddFace(mesh, vertex(corners[f]), vertex(corners[f + 1]),
                                        vertex(corners[f + 2]));
    }
}

/// The attributes hold the field: the energy computed from them is that of the field.
template <class M> void attributes_hold_the_field(M& mesh, const roundel::vcglib::Field& field) {
    auto p = roundel::store(field, mesh);
    const auto over = roundel::detail::opposites(field.elements());
    double energy = 0.0, sum = 0.0;
    for (const auto side : field.elements().halfedges) {
        const auto k = static_cast<std::size_t>(side.edge);
        const auto back = over[side.face][k];
        const auto l = static_cast<std::size_t>(back.edge);
        CHECK(p.period_jump[side.face][k] == -p.period_jump[back.face][l]);
        const double residual = p.angle[side.face] + p.kappa[side.face][k] +
                                half_pi * p.period_jump[side.face][k] - p.angle[back.face];
        energy += 0.5 * residual * residual;
    }
    CHECK(std::abs(energy - field.energy()) <= 1e-9 * energy);
    for (const auto v : field.elements().vertices) {
        sum += p.index[v];
    }
    for (const double index : field.boundary_indices()) {
        sum += index;
    }
    CHECK(std::abs(sum - static_cast<double>(field.elements().mesh.euler_characteristic())) < 1e-6);
    // A second call finds and uses the same attributes.
    auto again = roundel::store(field, mesh);
    CHECK(&again.angle[0] == &p.angle[0] && &again.index[0] == &p.index[0]);
}

void every_mesh_type_has_fields() {
    const auto shape = roundel::Mesh::shape("genus-2", 900).jittered(1e-3, 1);
    const auto options = roundel::FieldOptions().set_constraints({{5, 0.25}, {400, 1.0}});
    TriMesh full;
    build(shape, full);
    const auto field = roundel::orientation_field(full, options);
    attributes_hold_the_field(full, field);
    BareMesh bare;
    build(shape, bare);
    attributes_hold_the_field(bare, roundel::orientation_field(bare, options));
    const auto own = roundel::orientation_field(shape, options);
    CHECK(std::equal(own.angles().begin(), own.angles().end(), field.angles().begin()));
}

/// PD1 and PD2 are unit vectors in the face at a right angle, and PD1 has the field's angle from
/// edge 0.
void crosses_are_kept_as_directions() {
    TriMesh mesh;
    build(roundel::Mesh::shape("torus", 600).jittered(1e-3, 1), mesh);
    const auto field = roundel::orientation_field(mesh);
    auto p = roundel::store(field, mesh);
    for (const auto& face : mesh.face) {
        const auto x = (face.cP(1) - face.cP(0)).normalized();
        const auto normal = ((face.cP(1) - face.cP(0)) ^ (face.cP(2) - face.cP(0))).normalized();
        const auto first = face.cPD1(), second = face.cPD2();
        CHECK(std::abs(first.Norm() - 1.0) < 1e-12 && std::abs(first * normal) < 1e-12);
        CHECK((second - (normal ^ first)).Norm() < 1e-12);
        const double angle = std::atan2(first * (normal ^ x), first * x);
        CHECK(std::abs(std::remainder(angle - p.angle[face], 4.0 * half_pi)) < 1e-9);
    }
}

/// With deleted elements, the field is that of the mesh without them.
void deleted_elements_are_skipped() {
    TriMesh mesh;
    build(roundel::Mesh::shape("sphere", 500).jittered(1e-3, 1), mesh);
    const auto gone = mesh.face[3].V(0);
    for (auto& face : mesh.face) {
        if (face.V(0) == gone || face.V(1) == gone || face.V(2) == gone) {
            vcg::tri::Allocator<TriMesh>::DeleteFace(mesh, face);
        }
    }
    vcg::tri::Allocator<TriMesh>::DeleteVertex(mesh, *gone);
    const auto options =
        roundel::FieldOptions().set_constraints({{40, 0.5}}).set_features(roundel::no_features());
    const auto field = roundel::orientation_field(mesh, options);
    CHECK(field.elements().mesh.faces() == static_cast<std::size_t>(mesh.FN()));
    CHECK(field.elements().mesh.vertices() == static_cast<std::size_t>(mesh.VN()));
    CHECK(field.boundary_indices().size() == 1);
    auto p = roundel::store(field, mesh);
    const auto fixed = field.elements().faces[40];
    CHECK(fixed > 40 && !mesh.face[fixed].IsD() && p.angle[fixed] == 0.5);
    attributes_hold_the_field(mesh, field);
}

void maps_are_kept_as_wedge_texture_coordinates() {
    TriMesh mesh;
    build(roundel::Mesh::shape("gear", 1500), mesh);
    const auto options = roundel::FieldOptions().set_features(roundel::feature_angle(40));
    const auto field = roundel::orientation_field(mesh, options);
    const auto map = roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(400));
    roundel::store(map, mesh);
    CHECK(map && map.cones().size() == field.irregular_count());
    std::size_t flipped = 0;
    for (std::size_t f = 0; f < mesh.face.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const auto& corner = mesh.face[f].cWT(k);
            const std::size_t at = 6 * f + 2 * static_cast<std::size_t>(k);
            CHECK(corner.U() == map.corner_uvs()[at] && corner.V() == map.corner_uvs()[at + 1]);
        }
        const auto x = mesh.face[f].cWT(1).P() - mesh.face[f].cWT(0).P();
        const auto y = mesh.face[f].cWT(2).P() - mesh.face[f].cWT(0).P();
        flipped += (x ^ y) <= 0.0;
    }
    CHECK(flipped == map.flipped().size());
    roundel::Status status;
    BareMesh bare;
    build(roundel::Mesh::shape("gear", 1500), bare);
    roundel::store(map, bare, &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
}

/// The corners of the polygons of a triangulated mesh, which are bounded by the edges that are not
/// faux.
std::vector<std::vector<std::size_t>> polygons(const TriMesh& mesh) {
    std::vector<std::vector<std::size_t>> found;
    for (const auto& face : mesh.face) {
        const auto number = [&](int k) {
            return static_cast<std::size_t>(face.cV(k) - mesh.vert.data());
        };
        if (face.IsF(0)) {
            CHECK(found.back().front() == number(0) && found.back().back() == number(1));
            found.back().push_back(number(2));
        } else {
            found.push_back({number(0), number(1), number(2)});
        }
    }
    return found;
}

/// Both kinds of mesh receive the quads that the library makes of its own mesh.
void quads_come_back(const roundel::Mesh& from) {
    const auto options = roundel::QuadOptions().set_quads(200);
    TriMesh mesh, faux;
    PolyMesh poly;
    build(from, mesh);
    const auto own = roundel::quadrangulate(from, options);
    const auto made = roundel::quadrangulate(mesh, options);
    CHECK(std::equal(own.vertices().begin(), own.vertices().end(), made.vertices().begin(),
                     made.vertices().end()));
    CHECK(std::equal(own.corners().begin(), own.corners().end(), made.corners().begin(),
                     made.corners().end()));
    CHECK(made.conforming());
    roundel::store(made, poly);
    roundel::store(made, faux);
    const auto joined = polygons(faux);
    CHECK(poly.face.size() == made.size() && joined.size() == made.size());
    CHECK(poly.vert.size() == made.vertices().size() / 3);
    for (std::size_t v = 0; v < poly.vert.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis) {
            const double wanted = made.vertices()[3 * v + static_cast<std::size_t>(axis)];
            CHECK(poly.vert[v].cP()[axis] == wanted && faux.vert[v].cP()[axis] == wanted);
        }
    }
    for (std::size_t f = 0; f < poly.face.size(); ++f) {
        CHECK(poly.face[f].VN() == 4 && joined[f].size() == 4);
        for (int k = 0; k < 4; ++k) {
            const auto wanted =
                static_cast<std::size_t>(made.corners()[4 * f + static_cast<std::size_t>(k)]);
            const auto at = poly.face[f].cV(k) - poly.vert.data();
            CHECK(static_cast<std::size_t>(at) == wanted);
            CHECK(joined[f][static_cast<std::size_t>(k)] == wanted);
        }
    }
}

void polygons_are_refused_by_number() {
    PolyMesh mesh;
    vcg::tri::Allocator<PolyMesh>::AddVertices(mesh, 4);
    vcg::tri::Allocator<PolyMesh>::AddFaces(mesh, 1);
    mesh.face[0].Alloc(4);
    for (int k = 0; k < 4; ++k) {
        mesh.vert[static_cast<std::size_t>(k)].P() = {double(k / 2), double(k % 2), 0.0};
        mesh.face[0].V(k) = &mesh.vert[static_cast<std::size_t>(k)];
    }
    roundel::Status status;
    CHECK(!roundel::quadrangulate(mesh, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_NOT_A_TRIANGLE && status.index == 0);
    CHECK(!roundel::orientation_field(TriMesh(), {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_EMPTY);
}

} // namespace

/// The arguments are mesh files to test besides the shapes.
int main(int count, char** files) {
    every_mesh_type_has_fields();
    crosses_are_kept_as_directions();
    deleted_elements_are_skipped();
    maps_are_kept_as_wedge_texture_coordinates();
    quads_come_back(roundel::Mesh::shape("torus", 600));
    for (int i = 1; i < count; ++i) {
        quads_come_back(roundel::Mesh::read(files[i]));
    }
    polygons_are_refused_by_number();
    return failures != 0;
}
