// Compiled with -fno-exceptions: every failure is reported in a Status.

#include "check.hpp"

#include <roundel/roundel.hpp>

int main() {
    roundel::Status status;
    roundel::Problem none(0, &status);
    CHECK(!status && status.code == ROUNDEL_ERROR_EMPTY && !status.message.empty());
    roundel::Problem problem(2, &status);
    CHECK(status);
    problem.integer({0, 2}, &status);
    CHECK(status.code == ROUNDEL_ERROR_INDEX_OUT_OF_RANGE && status.index == 1);
    problem.least_squares({0, 1}, {1.0, -1.0}, 0.25, 1.0, &status);
    CHECK(status && status.message.empty() && status.index == -1);
    const auto failed = roundel::solve(problem, roundel::Options().set_strategy("luck"), &status);
    CHECK(!failed && failed.values().empty() && status.code == ROUNDEL_ERROR_OPTION_RANGE);
    const auto solution = roundel::solve(problem, {}, &status);
    CHECK(solution && status && solution.values().size() == 2);
    return failures != 0;
}
