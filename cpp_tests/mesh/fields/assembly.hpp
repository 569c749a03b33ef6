// The field problem as assembled with one mesh library, and the functions that check its solutions.

#ifndef ASSEMBLY_HPP
#define ASSEMBLY_HPP

#include "soup.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// An interior edge as seen from face `first`, with face `second` on its other side.
struct Dual {
    /// The vertices of the edge, in the direction in which it runs in its first face.
    std::int32_t from, to;
    std::int32_t first, second;
    /// The angle of the frame of the first face in that of the second.
    double kappa;
    /// The variable of its period jump, or -1 where the jump is known.
    std::int32_t variable;
    std::int32_t known;
    /// Whether its row is part of the energy. It is not between two fixed faces.
    bool counted;
};

/// Interior edges in increasing order of their first face and of the local edge there.
struct Assembly {
    std::vector<Dual> edges;
    std::size_t variables;
    Fixed fixed;
};

/// A solution of an assembly: one angle for each face and one jump for each interior edge.
struct Solved {
    double energy;
    std::vector<double> angles;
    std::vector<std::int32_t> jumps;
};

/// Indices of all vertices (zero at the boundary) and of the boundary loops.
struct Indices {
    std::vector<double> vertices;
    std::vector<bool> interior;
    std::vector<double> loops;
    std::int64_t euler_characteristic;
};

Assembly assemble_with_openmesh(const Soup& soup, const Fixed& fixed);
/// Computes indices from the period jumps by walking around vertices and along boundaries.
Indices indices_with_openmesh(const Soup& soup, const Assembly& assembly, const Solved& solved);

Assembly assemble_with_cgal(const Soup& soup, const Fixed& fixed);
/// Computes indices of vertices by carrying an arm of the cross around each of them in space.
std::vector<double> traced_with_cgal(const Soup& soup, const Assembly& assembly,
                                     const Solved& solved);

/// Decides every jump by greedy rounding with a new factorization after each.
std::vector<std::int32_t> jumps_of_reference(const Assembly& assembly);

/// Solves through the plain C problem interface by greedy rounding.
Solved solve_plainly(const Assembly& assembly);

/// The energy on the mesh, computed from angles and jumps.
double energy_of(const Assembly& assembly, const Solved& solved);

#endif
