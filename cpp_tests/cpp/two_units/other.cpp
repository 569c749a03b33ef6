// A C++20 unit, where roundel::span is std::span, beside a C++17 unit, where it is not.

#include <roundel/roundel.hpp>

#include <roundel/roundel.hpp>

#include <span>

static_assert(std::is_same_v<roundel::span<int>, std::span<int>>);

double solved_in_another_unit();

double solved_in_another_unit() {
    roundel::Problem problem(1);
    problem.least_squares({0}, {1.0}, 2.5);
    const auto solution = roundel::solve(problem);
    const std::span<const double> values = solution.values();
    return values[0];
}
