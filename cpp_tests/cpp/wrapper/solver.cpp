// The solver gives the same answers for changed data as a first solve.

#include "wrapper.hpp"

#include <algorithm>
#include <vector>

namespace {

bool same(const roundel::Solution& a, const roundel::Solution& b) {
    return a && b && std::equal(a.values().begin(), a.values().end(), b.values().begin());
}

/// x0 + x1 + x2 = rhs and (x0 - target)^2 + (x1 + 1)^2 + (x2 - 2)^2, with x1 and x2 integer.
roundel::Problem small(double rhs, double target) {
    roundel::Problem problem(3);
    problem.least_squares({0}, {1.0}, target);
    problem.least_squares({1}, {1.0}, -1.0);
    problem.least_squares({2}, {1.0}, 2.0);
    problem.constrain({0, 1, 2}, {1.0, 1.0, 1.0}, rhs);
    problem.integer({1, 2});
    return problem;
}

} // namespace

void a_solver_gives_the_same_as_a_solve() {
    roundel::Solver solver(small(1.5, 0.25));
    CHECK(same(solver.solve(), roundel::solve(small(1.5, 0.25))));

    const std::vector<double> rhs = {4.25};
    const std::vector<double> targets = {0.75, -1.0, 2.0};
    solver.constraint_right_sides(rhs).least_squares_right_sides(targets);
    CHECK(same(solver.solve(), roundel::solve(small(4.25, 0.75))));

    roundel::Problem pinned = small(4.25, 0.75);
    pinned.pin(2, -3.0);
    CHECK(same(solver.pin(2, -3.0).solve(), roundel::solve(pinned)));
    const double kept = solver.unpin(2).solve(roundel::Options().set_warm_start("keep")).energy();
    CHECK(kept > roundel::solve(small(4.25, 0.75)).energy());
    const auto offered = solver.solve(roundel::Options().set_warm_start("offer"));
    CHECK(offered.energy() <= kept);

    const std::vector<double> linear = {0.0, 8.0, 0.0};
    const roundel::Solution before = solver.solve();
    const roundel::Solution after = solver.linear(linear).solve();
    CHECK(after.values()[1] < before.values()[1]);

    roundel::Status status;
    const std::vector<double> one = {1.0};
    solver.guess(one, &status);
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    solver.pin(1, 0.5);
    CHECK(!solver.solve({}, &status) && status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    CHECK(status.index == 1);
    solver.unpin(1);
    CHECK(solver.solve());
    const roundel::Solver moved = std::move(solver);
    CHECK(moved && !solver);
}
