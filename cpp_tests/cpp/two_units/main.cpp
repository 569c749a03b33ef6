// The C++17 unit of a program whose other unit, other.cpp, is C++20.

#include "../check.hpp"

#include <roundel/roundel.hpp>

double solved_in_another_unit();

int main() {
    roundel::Problem problem(1);
    problem.least_squares({0}, {1.0}, 2.5);
    const auto solution = roundel::solve(problem);
    CHECK(solution.values()[0] == 2.5);
    CHECK(solved_in_another_unit() == 2.5);
    return failures != 0;
}
