// Solves an assembly through the plain C problem interface and evaluates its energy by the formula.

#include "assembly.hpp"

#include <cmath>
#include <stdexcept>

namespace {

constexpr double pi = 3.14159265358979323846;

void must(roundel_status status) {
    if (status != ROUNDEL_OK) {
        char text[256];
        roundel_last_error_message(text, sizeof text);
        throw std::runtime_error(text);
    }
}

} // namespace

Solved solve_plainly(const Assembly& assembly) {
    roundel_problem* problem = nullptr;
    must(roundel_problem_new(assembly.variables, &problem));
    for (std::size_t f = 0; f < assembly.fixed.size(); ++f) {
        if (assembly.fixed[f]) {
            must(roundel_problem_pin(problem, static_cast<std::int64_t>(f), *assembly.fixed[f]));
        }
    }
    const double factors[3] = {1.0, -1.0, 0.5 * pi};
    for (const Dual& dual : assembly.edges) {
        if (!dual.counted) {
            continue;
        }
        const std::int32_t variables[3] = {dual.first, dual.second, dual.variable};
        must(roundel_problem_add_least_squares(problem, dual.variable < 0 ? 2 : 3, variables,
                                               factors, -dual.kappa, 1.0, nullptr));
        if (dual.variable >= 0) {
            must(roundel_problem_set_integers(problem, 1, &dual.variable));
        }
    }
    roundel_options* options = nullptr;
    must(roundel_options_new(&options));
    must(roundel_options_set_text(options, "strategy", "greedy"));
    roundel_solution* solution = nullptr;
    must(roundel_problem_solve(problem, options, NULL, &solution));
    std::vector<double> values(assembly.variables);
    Solved solved{0.0, {}, {}};
    must(roundel_solution_values(solution, values.data(), values.size()));
    must(roundel_solution_energy(solution, &solved.energy));
    roundel_solution_free(solution);
    roundel_options_free(options);
    roundel_problem_free(problem);

    for (const Dual& dual : assembly.edges) {
        solved.jumps.push_back(
            dual.variable < 0
                ? dual.known
                : static_cast<std::int32_t>(values[static_cast<std::size_t>(dual.variable)]));
    }
    values.resize(assembly.fixed.size());
    solved.angles = std::move(values);
    return solved;
}

double energy_of(const Assembly& assembly, const Solved& solved) {
    double energy = 0.0;
    for (std::size_t e = 0; e < assembly.edges.size(); ++e) {
        const Dual& dual = assembly.edges[e];
        if (dual.counted) {
            const double residual = solved.angles[static_cast<std::size_t>(dual.first)] +
                                    dual.kappa + 0.5 * pi * solved.jumps[e] -
                                    solved.angles[static_cast<std::size_t>(dual.second)];
            energy += residual * residual;
        }
    }
    return energy;
}
