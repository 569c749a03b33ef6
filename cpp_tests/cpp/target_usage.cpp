// The example for which the interface was designed, in C++20, with its Eigen matrix written out.

#include "check.hpp"

#include <roundel/roundel.hpp>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <span>
#include <vector>

int main() {
    const double kappa = 0.3;
    const std::size_t n = 6;
    roundel::Problem problem(n);
    problem.least_squares({0, 1, 4}, {1.0, -1.0, M_PI_2}, /*rhs*/ -kappa);
    const std::vector<std::int32_t> offsets = {0, 1, 2, 3, 4, 5, 6};
    const std::vector<std::int32_t> rows = {0, 1, 2, 3, 4, 5};
    const std::vector<double> values(n, 2.0);
    const roundel::Compressed<std::int32_t> Q{roundel::Layout::columns, offsets, rows, values};
    problem.quadratic(Q, roundel::Triangle::full);
    problem.constrain({0, 3, 5}, {1.0, -1.0, 1.0}, 0.0);
    problem.integer({4, 5});

    int events = 0;
    auto solution = roundel::solve(
        problem,
        {.strategy = "greedy", .time_limit = 10.0, .on_event = [&](const roundel::Event& e) {
             events += e.seconds >= 0.0;
             return roundel::go_on;
         }});
    if (solution.status() == roundel::SolveStatus::optimal) {
        std::cout << "proved: " << solution.energy() << '\n';
    }
    std::span<const double> x = solution.values();

    CHECK(events > 0);
    CHECK(x.size() == n);
    CHECK(x[4] == std::round(x[4]) && x[5] == std::round(x[5]));
    CHECK(std::abs(x[0] - x[3] + x[5]) < 1e-12);
    const double row = x[0] - x[1] + M_PI_2 * x[4] + kappa;
    double energy = row * row;
    for (double v : x) {
        energy += v * v;
    }
    CHECK(std::abs(energy - solution.energy()) < 1e-12);
    return failures != 0;
}
