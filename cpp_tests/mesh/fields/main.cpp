// Compares orientation fields that were assembled in different ways. The arguments name meshes: OFF
// files, jittered:FILE for meshes whose symmetry makes integers tie, or shape:NAME:TRIANGLES, which
// are always jittered.
//
//     fields [--reference] DIRECTORY MESH...
//
// (a) OpenMesh and CGAL assemble the same problem, with equal energies and equal integers.
// (b) With --reference: greedy rounding makes the same decisions as a reference that factorizes
//     anew after each.
// (c) The energy on the mesh is the reported energy.
// (d) Indices are multiples of 1/4 (those of the library exactly), all ways to compute them agree,
//     and their sum is the Euler characteristic.
// (e) The library's own field equals the fields of both assemblies.

#include "../../cpp/check.hpp"
#include "assembly.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>

namespace {

/// The largest differences found, for the last line of the output.
struct Worst {
    double libraries = 0.0, on_mesh = 0.0, field = 0.0, quarter = 0.0, ways = 0.0, sum = 0.0;
    std::size_t problems = 0, integers = 0, decided = 0;
} worst;

double relative(double a, double b) {
    return std::abs(a - b) / std::max(1e-6, std::abs(b));
}

void raise(double& largest, double value) {
    // A NaN counts as the largest.
    if (!(value <= largest)) {
        largest = value;
    }
}

roundel::Mesh load(const std::string& directory, const std::string& name) {
    if (name.rfind("jittered:", 0) == 0) {
        return load(directory, name.substr(9)).jittered(1e-3, 7);
    }
    if (name.rfind("shape:", 0) != 0) {
        return roundel::Mesh::read(directory + "/" + name + ".off");
    }
    const auto colon = name.rfind(':');
    const auto shape =
        roundel::Mesh::shape(name.substr(6, colon - 6), std::stoul(name.substr(colon + 1)));
    return shape.jittered(1e-3, 7);
}

/// Counts differences and prints the first.
struct Differences {
    const char* what;
    std::size_t count = 0;

    void add(bool same, const Dual& a, double kappa, std::int32_t one, std::int32_t other) {
        if (!same && count++ == 0) {
            std::printf("%s: faces %d and %d, kappa %.17g and %.17g, jumps %d and %d\n", what,
                        a.first, a.second, a.kappa, kappa, one, other);
        }
    }
};

/// Fixes about every 32nd face along one direction of space, or a single face.
Fixed fixed_faces(const Soup& soup, bool single) {
    Fixed fixed(soup.faces.size());
    fixed[soup.faces.size() / 2] = 0.3;
    const double direction[3] = {0.48, -0.6, 0.64};
    for (std::size_t f = 0; !single && f < fixed.size(); ++f) {
        std::uint64_t mixed = (f + 1) * 0x9e3779b97f4a7c15u;
        mixed ^= mixed >> 29;
        mixed *= 0xbf58476d1ce4e5b9u;
        if ((mixed >> 32) % 32 != 0) {
            continue;
        }
        const auto at = [&](int k) {
            return soup
                .points[static_cast<std::size_t>(soup.faces[f][static_cast<std::size_t>(k)])];
        };
        // Any angle is valid here. This one varies slowly over the mesh.
        const auto a = at(0), b = at(1), c = at(2);
        double along = 0.0, across = 0.0, length = 0.0, overlap = 0.0, side = 0.0;
        for (std::size_t x = 0; x < 3; ++x) {
            along += (b[x] - a[x]) * direction[x];
            length += (b[x] - a[x]) * (b[x] - a[x]);
            overlap += (b[x] - a[x]) * (c[x] - a[x]);
        }
        for (std::size_t x = 0; x < 3; ++x) {
            const double up = c[x] - a[x] - overlap / length * (b[x] - a[x]);
            across += up * direction[x];
            side += up * up;
        }
        fixed[f] = std::atan2(across / std::sqrt(side), along / std::sqrt(length));
    }
    return fixed;
}

/// (e): compares energy, integers and both kinds of indices of the library's own field with ours.
void holds_of_the_librarys_field(const roundel::Mesh& mesh, const Assembly& assembly,
                                 const Solved& solved, const Indices& indices) {
    roundel::FieldOptions options;
    options.solve.set_strategy("greedy");
    options.features = roundel::no_features();
    for (std::size_t f = 0; f < assembly.fixed.size(); ++f) {
        if (assembly.fixed[f]) {
            options.constraints.push_back({static_cast<std::int32_t>(f), *assembly.fixed[f]});
        }
    }
    const auto field = roundel::orientation_field(mesh, options);
    raise(worst.field, relative(field.energy(), solved.energy));
    raise(worst.field, relative(field.solution().energy(), solved.energy));

    const auto faces = mesh.edge_faces();
    std::size_t dual = 0;
    Differences different{"library's own field"};
    for (std::size_t e = 0; e < field.period_jumps().size(); ++e) {
        if (faces[2 * e + 1] < 0) {
            CHECK(field.period_jumps()[e] == 0);
            continue;
        }
        if (dual == assembly.edges.size()) {
            break;
        }
        const bool same = faces[2 * e] == assembly.edges[dual].first &&
                          faces[2 * e + 1] == assembly.edges[dual].second &&
                          field.period_jumps()[e] == solved.jumps[dual];
        different.add(same, assembly.edges[dual], field.kappa()[e], solved.jumps[dual],
                      field.period_jumps()[e]);
        ++dual;
    }
    CHECK(dual == assembly.edges.size() && different.count == 0);

    const auto traced = field.traced_indices();
    double sum = 0.0;
    std::size_t irregular = 0;
    for (std::size_t v = 0; v < traced.size(); ++v) {
        raise(worst.ways, std::abs(field.vertex_indices()[v] - indices.vertices[v]));
        raise(worst.ways, std::abs(traced[v] - indices.vertices[v]));
        CHECK(field.vertex_indices()[v] == 0.25 * field.vertex_index_steps()[v]);
        CHECK(traced[v] == field.vertex_indices()[v]);
        irregular += std::abs(indices.vertices[v]) > 0.1;
        sum += field.vertex_indices()[v];
    }
    for (const double loop : field.boundary_indices()) {
        sum += loop;
    }
    CHECK(field.irregular_count() == irregular);
    CHECK(field.boundary_indices().size() == indices.loops.size());
    CHECK(mesh.euler_characteristic() == indices.euler_characteristic);
    CHECK(sum == static_cast<double>(indices.euler_characteristic));
}

void holds_of_indices(const Indices& indices, const std::vector<double>& traced) {
    double sum = 0.0;
    for (std::size_t v = 0; v < indices.vertices.size(); ++v) {
        const double index = indices.vertices[v];
        sum += index;
        if (indices.interior[v]) {
            raise(worst.quarter, std::abs(index - 0.25 * std::round(4.0 * index)));
            raise(worst.ways, std::abs(index - traced[v]));
        }
    }
    for (const double loop : indices.loops) {
        sum += loop;
    }
    raise(worst.sum, std::abs(sum - static_cast<double>(indices.euler_characteristic)));
}

void holds_of(const std::string& name, const roundel::Mesh& mesh, bool single, bool reference) {
    const Soup soup = soup_of(mesh);
    const Fixed fixed = fixed_faces(soup, single);
    const Assembly one = assemble_with_openmesh(soup, fixed);
    const Assembly other = assemble_with_cgal(soup, fixed);
    const Solved solved = solve_plainly(one), again = solve_plainly(other);
    const int before = failures;

    CHECK(one.variables == other.variables && one.edges.size() == other.edges.size());
    Differences different{"OpenMesh and CGAL"};
    for (std::size_t e = 0; e < one.edges.size() && e < other.edges.size(); ++e) {
        const Dual &a = one.edges[e], &b = other.edges[e];
        const bool same = a.from == b.from && a.to == b.to && a.first == b.first &&
                          a.second == b.second && a.variable == b.variable &&
                          solved.jumps[e] == again.jumps[e];
        different.add(same, a, b.kappa, solved.jumps[e], again.jumps[e]);
    }
    CHECK(different.count == 0);
    raise(worst.libraries, relative(solved.energy, again.energy));
    // The energy of each library's assembly at the other's solution.
    raise(worst.on_mesh, relative(energy_of(one, again), again.energy));
    raise(worst.on_mesh, relative(energy_of(other, solved), solved.energy));
    const Indices indices = indices_with_openmesh(soup, one, solved);
    holds_of_indices(indices, traced_with_cgal(soup, other, again));
    holds_of_the_librarys_field(mesh, one, solved, indices);
    if (reference) {
        CHECK(jumps_of_reference(one) == solved.jumps);
        worst.decided += one.variables - soup.faces.size();
    }
    ++worst.problems;
    worst.integers += one.variables - soup.faces.size();
    std::printf("%-28s %6zu faces %6zu integers, energy %.6f%s\n", name.c_str(), soup.faces.size(),
                one.variables - soup.faces.size(), solved.energy,
                failures == before ? "" : "  FAILED");
    std::fflush(stdout);
}

} // namespace

int main(int count, char** arguments) {
    std::vector<std::string> words(arguments + 1, arguments + count);
    const bool reference = !words.empty() && words[0] == "--reference";
    if (reference) {
        words.erase(words.begin());
    }
    if (words.size() < 2) {
        return 2;
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
        try {
            const auto mesh = load(words[0], words[i]);
            holds_of(words[i], mesh, false, reference);
            holds_of(words[i] + ", one face fixed", mesh, true, reference);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s: %s\n", words[i].c_str(), error.what());
            ++failures;
        }
    }
    std::printf("%zu problems, %zu integers (%zu against the reference)\n", worst.problems,
                worst.integers, worst.decided);
    std::printf("energies: libraries differ by %.1e, mesh and report by %.1e, library's own field "
                "by %.1e\n",
                worst.libraries, worst.on_mesh, worst.field);
    std::printf("indices: %.1e from a quarter, %.1e between ways, %.1e from Euler's "
                "characteristic\n",
                worst.quarter, worst.ways, worst.sum);
    CHECK(worst.libraries <= 1e-9);
    CHECK(worst.on_mesh <= 1e-9);
    CHECK(worst.field <= 1e-9);
    CHECK(worst.quarter <= 1e-9);
    CHECK(worst.ways <= 1e-9);
    CHECK(worst.sum <= 1e-6);
    return failures != 0;
}
