// <roundel/cgal.hpp>: fields of CGAL's FaceGraphs, removed elements, results in property maps.

#include "../../cpp/check.hpp"
#include "../surface_mesh.hpp"

#include <roundel/cgal.hpp>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

constexpr double half_pi = 1.57079632679489661923;

/// The energy, computed from the property maps that hold the field.
template <class G, class Angle, class Jump, class Kappa>
double energy_in(const G& graph, Angle angle, Jump jump, Kappa kappa) {
    double energy = 0.0;
    for (const auto h : halfedges(graph)) {
        const auto back = opposite(h, graph);
        if (is_border(h, graph) || is_border(back, graph)) {
            continue;
        }
        CHECK(get(jump, h) == -get(jump, back));
        const double residual = get(angle, face(h, graph)) + get(kappa, h) +
                                half_pi * get(jump, h) - get(angle, face(back, graph));
        energy += 0.5 * residual * residual;
    }
    return energy;
}

void property_maps_hold_the_field() {
    auto mesh = surface_mesh<Kernel>(roundel::Mesh::shape("torus", 900).jittered(1e-3, 1));
    const auto field = roundel::orientation_field(
        mesh, roundel::FieldOptions().set_constraints({{5, 0.25}, {400, 1.0}}));
    const auto p = roundel::store(field, mesh);
    const double energy = energy_in(mesh, p.angle, p.period_jump, p.kappa);
    CHECK(energy > 0.0 && std::abs(energy - field.energy()) <= 1e-9 * energy);
    double sum = 0.0;
    for (const auto v : mesh.vertices()) {
        sum += p.index[v];
    }
    CHECK(std::abs(sum) < 1e-6);
    CHECK((mesh.property_map<Mesh::Face_index, double>("f:roundel_angle").second));
    CHECK(roundel::store(field, mesh).angle[Mesh::Face_index(3)] == p.angle[Mesh::Face_index(3)]);
}

/// While a graph has removed elements, numbers skip them and the maps cover the remaining ones.
void removed_elements_are_skipped() {
    auto mesh = surface_mesh<Kernel>(roundel::Mesh::shape("sphere", 500).jittered(1e-3, 1));
    CGAL::Euler::remove_center_vertex(mesh.halfedge(Mesh::Vertex_index(17)), mesh);
    CGAL::Euler::remove_face(mesh.halfedge(Mesh::Vertex_index(100)), mesh);
    std::vector<Mesh::Face_index> polygons;
    for (const auto f : mesh.faces()) {
        if (mesh.degree(f) > 3) {
            polygons.push_back(f);
        }
    }
    CHECK(polygons.size() == 1);
    for (const auto f : polygons) {
        CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
    }
    CHECK(mesh.has_garbage());
    const auto field = roundel::orientation_field(
        mesh,
        roundel::FieldOptions().set_constraints({{400, 0.5}}).set_features(roundel::no_features()));
    CHECK(field.angles().size() == mesh.number_of_faces());
    CHECK(field.boundary_indices().size() == 2);
    const auto p = roundel::store(field, mesh);
    const auto fixed = field.elements().faces[400];
    CHECK(!mesh.is_removed(fixed) && fixed.idx() > 400 && p.angle[fixed] == 0.5);
    mesh.collect_garbage();
    const auto angle = mesh.property_map<Mesh::Face_index, double>("f:roundel_angle").first;
    const auto jump =
        mesh.property_map<Mesh::Halfedge_index, std::int32_t>("h:roundel_period_jump").first;
    const auto kappa = mesh.property_map<Mesh::Halfedge_index, double>("h:roundel_kappa").first;
    const double energy = energy_in(mesh, angle, jump, kappa);
    CHECK(std::abs(energy - field.energy()) <= 1e-9 * energy);
}

/// A FaceGraph that is not a Surface_mesh, with property maps of the caller.
void other_face_graphs_have_fields() {
    Polyhedron polyhedron;
    CGAL::copy_face_graph(
        surface_mesh<Kernel>(roundel::Mesh::shape("genus-2", 700).jittered(1e-3, 1)), polyhedron);
    const auto field = roundel::orientation_field(
        polyhedron, roundel::FieldOptions().set_constraints({{0, 0.125}}));
    CHECK(field.angles().size() == num_faces(polyhedron));
    std::map<roundel::cgal::Face<Polyhedron>, double> angle;
    std::map<roundel::cgal::Halfedge<Polyhedron>, std::int32_t> jump;
    std::map<roundel::cgal::Halfedge<Polyhedron>, double> kappa;
    std::map<roundel::cgal::Vertex<Polyhedron>, double> index;
    const auto angles = boost::make_assoc_property_map(angle);
    const auto jumps = boost::make_assoc_property_map(jump);
    const auto kappas = boost::make_assoc_property_map(kappa);
    roundel::store(field, polyhedron, angles, jumps, kappas, boost::make_assoc_property_map(index));
    const double energy = energy_in(polyhedron, angles, jumps, kappas);
    CHECK(energy > 0.0 && std::abs(energy - field.energy()) <= 1e-9 * energy);
    double sum = 0.0;
    for (const auto& entry : index) {
        sum += entry.second;
    }
    CHECK(index.size() == num_vertices(polyhedron) && std::abs(sum + 2.0) < 1e-6);
}

/// Both sides of an edge that is not cut have the same coordinates. Over the cut they turn and
/// shift, so that lengths stay the same.
template <class G, class Uv> void holds_a_map(const G& graph, Uv uv, std::size_t cut) {
    std::size_t torn = 0;
    for (const auto e : edges(graph)) {
        const auto h = halfedge(e, graph), back = opposite(h, graph);
        if (is_border(h, graph) || is_border(back, graph)) {
            continue;
        }
        const auto a = get(uv, prev(h, graph)), b = get(uv, h);
        const auto c = get(uv, back), d = get(uv, prev(back, graph));
        const double one = std::hypot(b[0] - a[0], b[1] - a[1]);
        CHECK(std::abs(one - std::hypot(d[0] - c[0], d[1] - c[1])) <= 1e-9 * (1.0 + one));
        torn += a != c || b != d;
    }
    CHECK(torn > 0 && torn <= cut);
}

void property_maps_hold_a_map() {
    auto mesh = surface_mesh<Kernel>(roundel::Mesh::shape("genus-2", 900).jittered(1e-3, 1));
    const auto field = roundel::orientation_field(mesh);
    const auto map = roundel::parametrize(mesh, field, roundel::MapOptions().set_quads(300));
    const auto uv = roundel::store(map, mesh);
    holds_a_map(mesh, uv, map.transitions().size());
    CHECK((mesh.property_map<Mesh::Halfedge_index, std::array<double, 2>>("h:roundel_uv").second));
    CHECK(map.cones().size() == field.irregular_count());

    Polyhedron polyhedron;
    CGAL::copy_face_graph(mesh, polyhedron);
    const auto second = roundel::orientation_field(polyhedron);
    const auto other = roundel::parametrize(polyhedron, second);
    std::map<roundel::cgal::Halfedge<Polyhedron>, std::array<double, 2>> kept;
    const auto uvs = boost::make_assoc_property_map(kept);
    roundel::store(other, polyhedron, uvs);
    holds_a_map(polyhedron, uvs, other.transitions().size());
}

void property_maps_hold_distances() {
    const auto plane = roundel::Mesh::shape("plane", 200);
    Mesh mesh = surface_mesh<Kernel>(plane);
    roundel::Sources sources;
    sources.add_vertex(0);
    const auto map = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance").first;
    CHECK(roundel::store_distance(mesh, sources, map));
    const auto from = mesh.point(Mesh::Vertex_index(0));
    for (const auto v : mesh.vertices()) {
        const double exact = std::sqrt((mesh.point(v) - from).squared_length());
        CHECK(std::fabs(map[v] - exact) < 1e-14);
    }
}

void polygons_are_refused_by_number() {
    Mesh mesh;
    std::vector<Mesh::Vertex_index> v;
    for (double x : {0.0, 1.0, 2.0}) {
        v.push_back(mesh.add_vertex(Kernel::Point_3(x, 0.0, 0.0)));
        v.push_back(mesh.add_vertex(Kernel::Point_3(x, 1.0, 0.0)));
    }
    mesh.add_face(v[0], v[2], v[3]);
    mesh.add_face(v[0], v[3], v[1]);
    mesh.add_face(v[2], v[4], v[5], v[3]);
    roundel::Status status;
    const auto field = roundel::orientation_field(mesh, {}, &status);
    CHECK(!field && status.code == ROUNDEL_ERROR_NOT_A_TRIANGLE && status.index == 2);
}

} // namespace

int main() {
    property_maps_hold_the_field();
    removed_elements_are_skipped();
    other_face_graphs_have_fields();
    property_maps_hold_a_map();
    property_maps_hold_distances();
    polygons_are_refused_by_number();
    return failures != 0;
}
