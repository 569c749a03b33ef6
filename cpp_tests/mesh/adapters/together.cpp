// All adapters in one unit, with CGAL's graphs of OpenMesh types: every call finds its own
// overload. The calls are written as the interface was designed to be used.

#include "../../cpp/check.hpp"

#include <roundel/cgal.hpp>
#include <roundel/eigen.hpp>
#include <roundel/openmesh.hpp>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cmath>
#include <type_traits>

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using SurfaceMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

bool has_the_indices_of_a_sphere(const roundel::Field& field) {
    double sum = 0.0;
    for (const double index : field.vertex_indices()) {
        sum += index;
    }
    return field && field.irregular_count() >= 8 && sum == 2.0;
}

} // namespace

int main() {
    const auto mesh = roundel::Mesh::shape("rounded-cube", 1200).jittered(1e-3, 1);
    const auto xyz = mesh.coordinates();
    const auto corners = mesh.corners();
    TriMesh open;
    SurfaceMesh surface;
    Eigen::MatrixXd V(mesh.vertices(), 3);
    Eigen::MatrixXi F(mesh.faces(), 3);
    for (std::size_t v = 0; v < mesh.vertices(); ++v) {
        const double* p = xyz.data() + 3 * v;
        open.add_vertex({p[0], p[1], p[2]});
        surface.add_vertex({p[0], p[1], p[2]});
        V.row(static_cast<Eigen::Index>(v)) << p[0], p[1], p[2];
    }
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::int32_t* c = corners.data() + 3 * f;
        using Size = SurfaceMesh::size_type;
        const auto vertex = [](std::int32_t v) { return SurfaceMesh::Vertex_index(Size(v)); };
        open.add_face(OpenMesh::VertexHandle(c[0]), OpenMesh::VertexHandle(c[1]),
                      OpenMesh::VertexHandle(c[2]));
        surface.add_face(vertex(c[0]), vertex(c[1]), vertex(c[2]));
        F.row(static_cast<Eigen::Index>(f)) << c[0], c[1], c[2];
    }

    const auto own = roundel::orientation_field(mesh, {.constrain_curvature = 0.1});
    const auto one = roundel::orientation_field(open, {.constrain_curvature = 0.1});
    const auto two = roundel::orientation_field(surface, {.constrain_curvature = 0.1});
    const auto three = roundel::orientation_field(V, F, {.constrain_curvature = 0.1});
    static_assert(std::is_same_v<decltype(one), const roundel::openmesh::Field>);
    static_assert(std::is_same_v<decltype(two), const roundel::cgal::Field<SurfaceMesh>>);
    static_assert(std::is_same_v<decltype(three), const roundel::EigenField>);
    CHECK(has_the_indices_of_a_sphere(own));
    CHECK(has_the_indices_of_a_sphere(one));
    CHECK(has_the_indices_of_a_sphere(two));
    CHECK(has_the_indices_of_a_sphere(three));
    CHECK(own.energy() == three.energy());
    CHECK(roundel::store(one, open).angle.is_valid());
    CHECK(roundel::store(two, surface).angle[SurfaceMesh::Face_index(0)] == two.angles()[0]);

    // The same for maps.
    const auto map =
        roundel::parametrize(open, one, {.quads = 500, .features = roundel::feature_angle(40)});
    CHECK(map.valid() && map.flipped().empty() && map.cones().size() == one.irregular_count());
    CHECK(roundel::parametrize(surface, two, {.quads = 500}).valid());
    CHECK(roundel::matrices(roundel::parametrize(three, {.quads = 500})).FUV.rows() == F.rows());
    CHECK(roundel::store(map, open).is_valid());

    // Making the problem, solving it and reading the field back gives the same field.
    const roundel::FieldOptions options{.constraints = {{7, 0.5}}, .constrain_curvature = 0.1};
    const auto solution = roundel::solve(roundel::orientation_problem(mesh, options));
    const auto again = roundel::orientation_field(mesh, solution, options);
    CHECK(again.angles()[7] == 0.5 && again.energy() > 0.0);
    CHECK(again.energy() == roundel::orientation_field(mesh, options).energy());
    return failures != 0;
}
