// The field problem assembled with OpenMesh's half-edges: angles within faces by arctangent in
// space.

#include "assembly.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

constexpr double pi = 3.14159265358979323846;

TriMesh build(const Soup& soup) {
    TriMesh mesh;
    for (const auto& p : soup.points) {
        mesh.add_vertex(TriMesh::Point(p[0], p[1], p[2]));
    }
    for (const auto& f : soup.faces) {
        if (!mesh.add_face(VertexHandle(f[0]), VertexHandle(f[1]), VertexHandle(f[2])).is_valid()) {
            throw std::runtime_error("OpenMesh refuses a face");
        }
    }
    return mesh;
}

/// The half-edge with which the file starts a face.
HalfedgeHandle first_of(const TriMesh& mesh, const Soup& soup, FaceHandle face) {
    const auto& corners = soup.faces[static_cast<std::size_t>(face.idx())];
    return mesh.find_halfedge(VertexHandle(corners[0]), VertexHandle(corners[1]));
}

TriMesh::Normal normal_of(const TriMesh& mesh, FaceHandle face) {
    const HalfedgeHandle h = mesh.halfedge_handle(face);
    const auto a = mesh.calc_edge_vector(h);
    const auto b = mesh.calc_edge_vector(mesh.next_halfedge_handle(h));
    return OpenMesh::cross(a, b).normalized();
}

/// The direction of a half-edge in the frame of its face.
double angle_of(const TriMesh& mesh, const Soup& soup, HalfedgeHandle h) {
    const FaceHandle face = mesh.face_handle(h);
    const auto axis = mesh.calc_edge_vector(first_of(mesh, soup, face));
    const auto edge = mesh.calc_edge_vector(h);
    return std::atan2(OpenMesh::dot(OpenMesh::cross(axis, edge), normal_of(mesh, face)),
                      OpenMesh::dot(axis, edge));
}

double kappa_over(const TriMesh& mesh, const Soup& soup, HalfedgeHandle h) {
    const double here = angle_of(mesh, soup, h);
    const double there = angle_of(mesh, soup, mesh.opposite_halfedge_handle(h)) + pi;
    const double turn = std::remainder(there - here, 2.0 * pi);
    return turn <= -pi ? turn + 2.0 * pi : turn;
}

std::vector<bool> forest_of(const TriMesh& mesh, const Fixed& fixed) {
    std::vector<bool> tree(mesh.n_edges(), false), reached(mesh.n_faces(), false);
    std::queue<FaceHandle> queue;
    for (const FaceHandle face : mesh.faces()) {
        if (fixed[static_cast<std::size_t>(face.idx())]) {
            reached[static_cast<std::size_t>(face.idx())] = true;
            queue.push(face);
        }
    }
    for (; !queue.empty(); queue.pop()) {
        std::vector<HalfedgeHandle> sides;
        for (const HalfedgeHandle h : mesh.fh_range(queue.front())) {
            if (!mesh.is_boundary(mesh.edge_handle(h))) {
                sides.push_back(h);
            }
        }
        std::sort(sides.begin(), sides.end(), [&](HalfedgeHandle a, HalfedgeHandle b) {
            return mesh.opposite_face_handle(a).idx() < mesh.opposite_face_handle(b).idx();
        });
        for (const HalfedgeHandle h : sides) {
            const FaceHandle next = mesh.opposite_face_handle(h);
            if (!reached[static_cast<std::size_t>(next.idx())]) {
                reached[static_cast<std::size_t>(next.idx())] = true;
                tree[static_cast<std::size_t>(mesh.edge_handle(h).idx())] = true;
                queue.push(next);
            }
        }
    }
    return tree;
}

/// The position of every interior edge in an assembly.
std::vector<std::size_t> places_of(const TriMesh& mesh, const Assembly& assembly) {
    std::vector<std::size_t> places(mesh.n_edges(), assembly.edges.size());
    for (std::size_t e = 0; e < assembly.edges.size(); ++e) {
        const Dual& dual = assembly.edges[e];
        const auto h = mesh.find_halfedge(VertexHandle(dual.from), VertexHandle(dual.to));
        places[static_cast<std::size_t>(mesh.edge_handle(h).idx())] = e;
    }
    return places;
}

} // namespace

Assembly assemble_with_openmesh(const Soup& soup, const Fixed& fixed) {
    const TriMesh mesh = build(soup);
    const auto tree = forest_of(mesh, fixed);
    Assembly assembly{{}, mesh.n_faces(), fixed};
    for (const FaceHandle face : mesh.faces()) {
        HalfedgeHandle h = first_of(mesh, soup, face);
        for (int k = 0; k < 3; ++k, h = mesh.next_halfedge_handle(h)) {
            const FaceHandle other = mesh.opposite_face_handle(h);
            if (!other.is_valid() || other.idx() < face.idx()) {
                continue;
            }
            Dual dual{mesh.from_vertex_handle(h).idx(),
                      mesh.to_vertex_handle(h).idx(),
                      face.idx(),
                      other.idx(),
                      kappa_over(mesh, soup, h),
                      -1,
                      0,
                      true};
            const auto& a = fixed[static_cast<std::size_t>(face.idx())];
            const auto& b = fixed[static_cast<std::size_t>(other.idx())];
            if (a && b) {
                dual.counted = false;
                dual.known =
                    static_cast<std::int32_t>(std::lround((*b - *a - dual.kappa) / (0.5 * pi)));
            } else if (!tree[static_cast<std::size_t>(mesh.edge_handle(h).idx())]) {
                dual.variable = static_cast<std::int32_t>(assembly.variables++);
            }
            assembly.edges.push_back(dual);
        }
    }
    return assembly;
}

Indices indices_with_openmesh(const Soup& soup, const Assembly& assembly, const Solved& solved) {
    const TriMesh mesh = build(soup);
    const auto places = places_of(mesh, assembly);
    const auto step = [&](HalfedgeHandle h) {
        const std::size_t e = places[static_cast<std::size_t>(mesh.edge_handle(h).idx())];
        const Dual& dual = assembly.edges[e];
        const double turn = dual.kappa + 0.5 * pi * solved.jumps[e];
        return dual.first == mesh.face_handle(h).idx() ? turn : -turn;
    };
    // The angle defect of a vertex with respect to `full`, minus the turning of the cross around
    // it.
    const auto turned = [&](VertexHandle vertex, double full) {
        double sum = full;
        for (const HalfedgeHandle out : mesh.voh_range(vertex)) {
            if (mesh.is_boundary(out)) {
                continue;
            }
            const HalfedgeHandle in = mesh.prev_halfedge_handle(out);
            const auto a = mesh.calc_edge_vector(out);
            const auto b = -mesh.calc_edge_vector(in);
            sum -= std::atan2(OpenMesh::cross(a, b).norm(), OpenMesh::dot(a, b));
            // The next face in counter-clockwise order lies across the incoming half-edge.
            if (!mesh.is_boundary(mesh.edge_handle(in))) {
                sum -= step(in);
            }
        }
        return sum / (2.0 * pi);
    };
    Indices indices{{}, {}, {}, 0};
    for (const VertexHandle vertex : mesh.vertices()) {
        const bool interior = !mesh.is_boundary(vertex);
        indices.interior.push_back(interior);
        indices.vertices.push_back(interior ? turned(vertex, 2.0 * pi) : 0.0);
    }
    std::vector<bool> walked(mesh.n_halfedges(), false);
    for (const HalfedgeHandle start : mesh.halfedges()) {
        if (!mesh.is_boundary(start) || walked[static_cast<std::size_t>(start.idx())]) {
            continue;
        }
        double loop = 0.0;
        HalfedgeHandle h = start;
        do {
            walked[static_cast<std::size_t>(h.idx())] = true;
            loop += turned(mesh.to_vertex_handle(h), pi);
            h = mesh.next_halfedge_handle(h);
        } while (h != start);
        indices.loops.push_back(loop);
    }
    indices.euler_characteristic = static_cast<std::int64_t>(mesh.n_vertices()) -
                                   static_cast<std::int64_t>(mesh.n_edges()) +
                                   static_cast<std::int64_t>(mesh.n_faces());
    return indices;
}
