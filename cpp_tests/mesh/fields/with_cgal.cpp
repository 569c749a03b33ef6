// The field problem assembled with CGAL's Surface_mesh: triangles are laid out flat, corner by
// corner.

#include "assembly.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <complex>
#include <deque>
#include <map>
#include <stdexcept>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Vector = Kernel::Vector_3;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;
using Face = SurfaceMesh::Face_index;
using Halfedge = SurfaceMesh::Halfedge_index;
using Flat = std::complex<double>;

constexpr double pi = 3.14159265358979323846;

Vertex vertex(std::int32_t v) {
    return Vertex(static_cast<SurfaceMesh::size_type>(v));
}

SurfaceMesh build(const Soup& soup) {
    SurfaceMesh mesh;
    for (const auto& p : soup.points) {
        mesh.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    }
    for (const auto& f : soup.faces) {
        if (mesh.add_face(vertex(f[0]), vertex(f[1]), vertex(f[2])) == SurfaceMesh::null_face()) {
            throw std::runtime_error("CGAL refuses a face");
        }
    }
    return mesh;
}

Halfedge first_of(const SurfaceMesh& mesh, const Soup& soup, Face face) {
    const auto& corners = soup.faces[face];
    return mesh.halfedge(vertex(corners[0]), vertex(corners[1]));
}

Vector along(const SurfaceMesh& mesh, Halfedge h) {
    return mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
}

Vector unit(const Vector& v) {
    return v / std::sqrt(v.squared_length());
}

Vector normal_of(const SurfaceMesh& mesh, Face face) {
    const Halfedge h = mesh.halfedge(face);
    return unit(CGAL::cross_product(along(mesh, h), along(mesh, mesh.next(h))));
}

/// The third corner of a half-edge's face, when the half-edge runs from 0 to its length.
Flat third_corner(const SurfaceMesh& mesh, Halfedge h) {
    const Vector base = along(mesh, h);
    const Vector side = -along(mesh, mesh.prev(h));
    const double length = std::sqrt(base.squared_length());
    const double height = std::sqrt(CGAL::cross_product(base, side).squared_length()) / length;
    return {base * side / length, height};
}

/// The direction of the first edge of the half-edge's face, in the plane in which the half-edge
/// runs along the real axis.
Flat axis_of(const SurfaceMesh& mesh, const Soup& soup, Halfedge h) {
    const Halfedge first = first_of(mesh, soup, mesh.face(h));
    const Flat tip(std::sqrt(along(mesh, h).squared_length()), 0.0);
    const Flat third = third_corner(mesh, h);
    if (first == h) {
        return tip;
    }
    return first == mesh.next(h) ? third - tip : -third;
}

double kappa_over(const SurfaceMesh& mesh, const Soup& soup, Halfedge h) {
    const Flat here = axis_of(mesh, soup, h);
    // The other triangle lies below the edge, so it is turned by half a turn.
    const Flat there = -axis_of(mesh, soup, mesh.opposite(h));
    const double turn = std::arg(here * std::conj(there));
    return turn <= -pi ? pi : turn;
}

std::vector<bool> forest_of(const SurfaceMesh& mesh, const Fixed& fixed) {
    std::vector<bool> tree(mesh.number_of_edges(), false), reached(fixed.size(), false);
    std::deque<Face> queue;
    for (const Face face : mesh.faces()) {
        if (fixed[face]) {
            reached[face] = true;
            queue.push_back(face);
        }
    }
    while (!queue.empty()) {
        // In the order of the neighbours' numbers.
        std::multimap<Face, Halfedge> next;
        for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(queue.front()))) {
            const Face across = mesh.face(mesh.opposite(h));
            if (across != SurfaceMesh::null_face()) {
                next.emplace(across, h);
            }
        }
        queue.pop_front();
        for (const auto& [face, h] : next) {
            if (!reached[face]) {
                reached[face] = true;
                tree[mesh.edge(h)] = true;
                queue.push_back(face);
            }
        }
    }
    return tree;
}

} // namespace

Assembly assemble_with_cgal(const Soup& soup, const Fixed& fixed) {
    const SurfaceMesh mesh = build(soup);
    const auto tree = forest_of(mesh, fixed);
    Assembly assembly{{}, fixed.size(), fixed};
    for (const Face face : mesh.faces()) {
        for (const Halfedge h : mesh.halfedges_around_face(first_of(mesh, soup, face))) {
            const Face other = mesh.face(mesh.opposite(h));
            if (other == SurfaceMesh::null_face() || other < face) {
                continue;
            }
            Dual dual{};
            dual.from = static_cast<std::int32_t>(mesh.source(h).idx());
            dual.to = static_cast<std::int32_t>(mesh.target(h).idx());
            dual.first = static_cast<std::int32_t>(face.idx());
            dual.second = static_cast<std::int32_t>(other.idx());
            dual.kappa = kappa_over(mesh, soup, h);
            dual.variable = -1;
            dual.counted = !(fixed[face] && fixed[other]);
            if (!dual.counted) {
                const double quarters = (*fixed[other] - *fixed[face] - dual.kappa) * 2.0 / pi;
                dual.known = static_cast<std::int32_t>(std::lround(quarters));
            } else if (!tree[mesh.edge(h)]) {
                dual.variable = static_cast<std::int32_t>(assembly.variables);
                ++assembly.variables;
            }
            assembly.edges.push_back(dual);
        }
    }
    return assembly;
}

std::vector<double> traced_with_cgal(const Soup& soup, const Assembly& assembly,
                                     const Solved& solved) {
    const SurfaceMesh mesh = build(soup);
    std::vector<std::int32_t> jump(mesh.number_of_halfedges(), 0);
    for (std::size_t e = 0; e < assembly.edges.size(); ++e) {
        const Halfedge h =
            mesh.halfedge(vertex(assembly.edges[e].from), vertex(assembly.edges[e].to));
        jump[h] = solved.jumps[e];
        jump[mesh.opposite(h)] = -solved.jumps[e];
    }
    const auto arm = [&](Face face, std::int32_t quarters) {
        const Vector x = unit(along(mesh, first_of(mesh, soup, face)));
        const Vector y = CGAL::cross_product(normal_of(mesh, face), x);
        const double angle = solved.angles[face] + 0.5 * pi * quarters;
        return Vector(std::cos(angle) * x + std::sin(angle) * y);
    };
    std::vector<double> indices;
    for (const Vertex v : mesh.vertices()) {
        indices.push_back(0.0);
        if (mesh.is_border(v)) {
            continue;
        }
        double total = 2.0 * pi;
        std::int32_t quarters = 0;
        // Half-edges into the vertex in counter-clockwise order. CGAL's own order is clockwise.
        const Halfedge start = mesh.halfedge(v);
        Halfedge in = start;
        do {
            const Halfedge out = mesh.next(in);
            const Vector a = along(mesh, out), b = -along(mesh, in);
            total -= std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
            const Face from = mesh.face(in), to = mesh.face(mesh.opposite(in));
            const Vector leaving = arm(from, quarters);
            quarters -= jump[in];
            const Vector matched = arm(to, quarters);
            // Across the edge, the component along it stays and the component normal to it turns
            // with the plane.
            const Vector edge = unit(along(mesh, in)), up = normal_of(mesh, to);
            const Vector across_here = CGAL::cross_product(normal_of(mesh, from), edge);
            const Vector carried =
                (leaving * edge) * edge + (leaving * across_here) * CGAL::cross_product(up, edge);
            total += std::atan2(CGAL::cross_product(carried, matched) * up, carried * matched);
            in = mesh.prev(mesh.opposite(in));
        } while (in != start);
        indices.back() = total / (2.0 * pi);
    }
    return indices;
}
