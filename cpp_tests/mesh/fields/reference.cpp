// Greedy rounding as a simple reference: after every rounding it assembles, factorizes and solves
// the normal equations of the remaining unknowns from scratch.

#include "assembly.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

constexpr double pi = 3.14159265358979323846;

/// The values of all variables that minimise the energy while the decided ones are held.
std::vector<double> minimised(const Assembly& assembly,
                              const std::vector<std::optional<double>>& decided) {
    std::vector<Eigen::Index> place(assembly.variables, -1);
    Eigen::Index free = 0;
    for (std::size_t v = 0; v < assembly.variables; ++v) {
        if (!decided[v]) {
            place[v] = free++;
        }
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(free);
    for (const Dual& dual : assembly.edges) {
        if (!dual.counted) {
            continue;
        }
        // first - second + pi/2 jump + kappa, squared.
        const std::int32_t variable[3] = {dual.first, dual.second, dual.variable};
        const double factor[3] = {1.0, -1.0, 0.5 * pi};
        const int terms = dual.variable < 0 ? 2 : 3;
        double constant = dual.kappa;
        for (int k = 0; k < terms; ++k) {
            const auto& value = decided[static_cast<std::size_t>(variable[k])];
            constant += value ? factor[k] * *value : 0.0;
        }
        for (int k = 0; k < terms; ++k) {
            const Eigen::Index row = place[static_cast<std::size_t>(variable[k])];
            if (row < 0) {
                continue;
            }
            right[row] -= factor[k] * constant;
            for (int l = 0; l < terms; ++l) {
                const Eigen::Index column = place[static_cast<std::size_t>(variable[l])];
                if (column >= 0) {
                    entries.emplace_back(row, column, factor[k] * factor[l]);
                }
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(free, free);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    if (factors.info() != Eigen::Success) {
        throw std::runtime_error("the reference cannot factorize");
    }
    const Eigen::VectorXd solution = factors.solve(right);
    std::vector<double> values(assembly.variables);
    for (std::size_t v = 0; v < assembly.variables; ++v) {
        values[v] = decided[v] ? *decided[v] : solution[place[v]];
    }
    return values;
}

} // namespace

std::vector<std::int32_t> jumps_of_reference(const Assembly& assembly) {
    std::vector<std::optional<double>> decided(assembly.variables);
    const std::size_t faces = assembly.fixed.size();
    for (std::size_t f = 0; f < faces; ++f) {
        decided[f] = assembly.fixed[f];
    }
    for (std::size_t round = faces; round < assembly.variables; ++round) {
        const auto values = minimised(assembly, decided);
        const auto distance = [&](std::size_t v) {
            return decided[v] ? std::numeric_limits<double>::infinity()
                              : std::abs(values[v] - std::round(values[v]));
        };
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t v = faces; v < assembly.variables; ++v) {
            least = std::min(least, distance(v));
        }
        std::size_t chosen = faces;
        while (distance(chosen) > least + 1e-9) {
            ++chosen;
        }
        decided[chosen] = std::round(values[chosen]);
    }
    std::vector<std::int32_t> jumps;
    for (const Dual& dual : assembly.edges) {
        jumps.push_back(dual.variable < 0 ? dual.known
                                          : static_cast<std::int32_t>(
                                                *decided[static_cast<std::size_t>(dual.variable)]));
    }
    return jumps;
}
