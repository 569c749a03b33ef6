// Problems: ownership, the effect of every part, failures, files.

#include "wrapper.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

template <class T>
constexpr bool moves_only =
    std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
    !std::is_copy_constructible_v<T>;

static_assert(moves_only<roundel::Problem>);
static_assert(moves_only<roundel::Solution>);
static_assert(moves_only<roundel::CancelToken>);
static_assert(std::is_nothrow_copy_constructible_v<roundel::Error>);

template <class Call> roundel_status thrown_by(Call&& call) {
    try {
        call();
    } catch (const roundel::Error& error) {
        CHECK(std::string(error.what()).size() > 0);
        return error.code();
    }
    return ROUNDEL_OK;
}

void ownership_moves_and_does_not_copy() {
    roundel::Problem one = chain(4);
    const roundel::Problem other = one.clone();
    one.constant(5.0);
    const roundel::Problem moved = std::move(one);
    CHECK(roundel::solve(moved).energy() == roundel::solve(other).energy() + 5.0);
    CHECK(thrown_by([&] { one.constant(1.0); }) == ROUNDEL_ERROR_NULL_POINTER);
    CHECK(thrown_by([&] { roundel::solve(one); }) == ROUNDEL_ERROR_NULL_POINTER);
    roundel::Solution solution = roundel::solve(moved);
    const std::vector<double> values(solution.values().begin(), solution.values().end());
    roundel::Solution taken;
    CHECK(!taken);
    taken = std::move(solution);
    CHECK(taken && values.size() == 4 && taken.values()[3] == values[3]);
}

// E(x) = 1/2 x'Qx + q'x + c, with Q given in every possible way, at a minimiser known by hand.
void every_part_of_a_problem_counts() {
    const std::vector<std::int32_t> offsets = {0, 2, 4}, indices = {0, 1, 0, 1};
    const std::vector<std::int64_t> offsets64 = {0, 2, 4}, indices64 = {0, 1, 0, 1};
    const std::vector<double> values = {2.0, 1.0, 1.0, 3.0};
    const std::vector<std::int32_t> rows = {0, 1, 1}, columns = {0, 0, 1};
    const std::vector<std::int64_t> rows64 = {0, 0, 1}, columns64 = {0, 1, 1};
    const std::vector<double> half = {2.0, 1.0, 3.0};
    roundel::Problem given[6] = {roundel::Problem(2), roundel::Problem(2), roundel::Problem(2),
                                 roundel::Problem(2), roundel::Problem(2), roundel::Problem(2)};
    using roundel::Compressed;
    using roundel::Layout;
    using roundel::Triangle;
    given[0].quadratic(Compressed<std::int32_t>{Layout::columns, offsets, indices, values},
                       Triangle::full);
    given[1].quadratic(Compressed<std::int64_t>{Layout::rows, offsets64, indices64, values},
                       Triangle::full);
    given[2].quadratic(Triangle::lower, rows, columns, half);
    given[3].quadratic(Triangle::upper, rows64, columns64, half);
    given[4].quadratic(Compressed<std::int32_t>{Layout::rows, offsets, indices, values},
                       Triangle::full);
    given[5].quadratic(Compressed<std::int64_t>{Layout::columns, offsets64, indices64, values},
                       Triangle::full);
    for (roundel::Problem& problem : given) {
        problem.linear(std::vector<double>{-3.0, -3.0});
        problem.linear(1, -1.0);
        problem.constant(10.0);
        // Q x = -q: 2 x0 + x1 = 3, x0 + 3 x1 = 4.
        const roundel::Solution solution = roundel::solve(problem);
        CHECK(std::abs(solution.values()[0] - 1.0) < 1e-12);
        CHECK(std::abs(solution.values()[1] - 1.0) < 1e-12);
        CHECK(std::abs(solution.energy() - 6.5) < 1e-12);
        CHECK(solution.status() == roundel::SolveStatus::optimal);
        CHECK(std::string(roundel::name(solution.status())) == "optimal");
        CHECK(solution.gap().value_or(1.0) < 1e-9);
        CHECK(solution.is_complete() && solution.stopped_by() == roundel::StoppedBy::none);
        CHECK(std::string(roundel::name(solution.stopped_by())) == "none");
        CHECK(solution.counts().variables == 2 && solution.seconds().total >= 0.0);
        CHECK(solution.violations().integrality == 0.0);
    }

    // x0 - x1 = 1 and x1 - x2 = 1 as a matrix, with x0 pinned to 5. The guess has no effect.
    roundel::Problem problem(3);
    const std::vector<std::int32_t> row_offsets = {0, 2, 4}, column_of = {0, 1, 1, 2};
    const std::vector<double> signs = {1.0, -1.0, 1.0, -1.0}, ones = {1.0, 1.0};
    const Compressed<std::int32_t> C{Layout::rows, row_offsets, column_of, signs};
    CHECK(problem.constrain(C, ones) == 0);
    CHECK(problem.constraints() == 2 && problem.variables() == 3);
    problem.pin(0, 5.0);
    problem.guess(std::vector<double>{1.0, 2.0, 3.0});
    const roundel::Solution pinned = roundel::solve(problem);
    CHECK(pinned.values()[0] == 5.0 && std::abs(pinned.values()[2] - 3.0) < 1e-12);
    problem.unpin(0);
    problem.pin(2, 0.0);
    CHECK(std::abs(roundel::solve(problem).energy()) < 1e-12);
}

// 1/2 (x0 - x1 - 0.3)^2, 2 (x1 - 0.25 - x2)^2 and 3 (x2 - 0.7)^2, with an integer.
void rows_given_together_are_rows_given_one_by_one() {
    using roundel::Compressed;
    using roundel::Layout;
    const std::vector<std::int32_t> rows = {0, 2, 4, 5}, column_of = {0, 1, 1, 2, 2};
    const std::vector<double> by_rows = {1.0, -1.0, 1.0, -1.0, 1.0};
    const std::vector<std::int64_t> columns = {0, 1, 3, 5}, row_of = {0, 0, 1, 1, 2};
    const std::vector<double> by_columns = {1.0, -1.0, 1.0, -1.0, 1.0};
    const std::vector<double> rhs = {0.3, 0.25, 0.7}, weights = {0.5, 2.0, 3.0};
    const Compressed<std::int32_t> A{Layout::rows, rows, column_of, by_rows};
    const Compressed<std::int64_t> B{Layout::columns, columns, row_of, by_columns};
    roundel::Problem given[3] = {roundel::Problem(3), roundel::Problem(3), roundel::Problem(3)};
    given[0].least_squares({0, 1}, {1.0, -1.0}, 0.3, 0.5);
    given[0].least_squares({1, 2}, {1.0, -1.0}, 0.25, 2.0);
    given[0].least_squares({2}, {1.0}, 0.7, 3.0);
    CHECK(given[1].least_squares(A, rhs, weights) == 0);
    CHECK(given[2].least_squares(B, rhs, weights) == 0);
    std::vector<std::vector<double>> found;
    for (roundel::Problem& problem : given) {
        problem.integer({1});
        const auto solution = roundel::solve(problem);
        found.emplace_back(solution.values().begin(), solution.values().end());
        found.back().push_back(solution.energy());
    }
    CHECK(found[0] == found[1] && found[0] == found[2]);
    // Without weights all weights are 1, and the row numbers continue.
    CHECK(given[1].least_squares(A, rhs) == 3);
    roundel::Status status;
    const std::vector<double> two = {1.0, 1.0};
    given[1].least_squares(A, rhs, two, &status);
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    const std::vector<double> below = {1.0, 1.0, -1.0};
    given[1].least_squares(A, rhs, below, &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT && status.index == 2);
    CHECK(given[1].least_squares({0}, {1.0}) == 6);
}

// (x0 - 3)^2 + (x1 - 3)^2 with x0 + 2 x1 <= 4, given one by one and as a matrix, and x0 an integer.
void rows_and_bounds_limit_a_problem() {
    using roundel::Compressed;
    using roundel::Layout;
    const auto value = [](const roundel::Solution& of, std::size_t at) { return of.values()[at]; };
    const double none = std::numeric_limits<double>::infinity();
    const std::vector<std::int32_t> rows = {0, 2}, columns = {0, 1};
    const std::vector<std::int64_t> rows64 = {0, 2}, columns64 = {0, 1};
    const std::vector<std::int32_t> by_column = {0, 1, 2}, row_of = {0, 0};
    const std::vector<std::int64_t> by_column64 = {0, 1, 2}, row_of64 = {0, 0};
    const std::vector<double> values = {1.0, 2.0}, lower = {-none}, upper = {4.0};
    roundel::Problem given[5] = {roundel::Problem(2), roundel::Problem(2), roundel::Problem(2),
                                 roundel::Problem(2), roundel::Problem(2)};
    const Compressed<std::int32_t> csr{Layout::rows, rows, columns, values};
    const Compressed<std::int64_t> csr64{Layout::rows, rows64, columns64, values};
    const Compressed<std::int32_t> csc{Layout::columns, by_column, row_of, values};
    const Compressed<std::int64_t> csc64{Layout::columns, by_column64, row_of64, values};
    CHECK(given[0].inequality({0, 1}, {1.0, 2.0}, -none, 4.0) == 0);
    CHECK(given[1].inequality(csr, lower, upper) == 0);
    CHECK(given[2].inequality(csr64, lower, upper) == 0);
    CHECK(given[3].inequality(csc, lower, upper) == 0);
    CHECK(given[4].inequality(csc64, lower, upper) == 0);
    for (roundel::Problem& problem : given) {
        problem.least_squares({0}, {1.0}, 3.0);
        problem.least_squares({1}, {1.0}, 3.0);
        problem.integer({0});
        CHECK(problem.inequalities() == 1 && problem.constraints() == 0);
        // x0 = 2 leaves x1 = 1 with energy 5; x0 = 1 leaves x1 = 1.5 with 6.25.
        const roundel::Solution solution = roundel::solve(problem);
        CHECK(solution.status() == roundel::SolveStatus::optimal);
        CHECK(std::abs(solution.energy() - 5.0) < 1e-9 && solution.values()[0] == 2.0);
        CHECK(solution.counts().inequalities == 1 && solution.violations().constraint < 1e-9);
        problem.bounds(0, -none, 1.0);
        CHECK(std::abs(roundel::solve(problem).energy() - 6.25) < 1e-9);
    }
    const std::vector<std::int32_t> both = {1, 0};
    const std::vector<double> least = {0.5, 0.0}, most = {0.5, none};
    given[0].bounds(both, least, most);
    CHECK(given[0].bounds().first == std::vector<double>({0.0, 0.5}));
    CHECK(given[0].bounds().second == std::vector<double>({none, 0.5}));
    CHECK(std::abs(value(roundel::solve(given[0]), 0) - 3.0) < 1e-9);
    given[0].binary({0});
    CHECK(given[0].bounds().second[0] == 1.0);
    CHECK(value(roundel::solve(given[0]), 0) == 1.0);

    roundel::Status status;
    given[0].bounds(1, 2.0, 1.0, &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT && status.index == 0);
    given[0].inequality(csr, upper, lower, &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT && status.index == 0);
    given[0].inequality(csr, lower, least, &status);
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(given[0].inequalities() == 1);
    // 4 <= x0 + 2 x1 does not hold with x0 <= 1 and x1 <= 0.5.
    given[0].inequality({0, 1}, {1.0, 2.0}, 4.0, none);
    CHECK(!roundel::solve(given[0], {}, &status) && status.code == ROUNDEL_ERROR_INFEASIBLE);

    roundel::Solver solver(given[1]);
    const std::vector<double> one = {1.0}, unlimited = {-none}, three = {3.0};
    const std::vector<std::int32_t> second = {1};
    CHECK(std::abs(value(solver.solve(), 1) - 1.5) < 1e-9);
    solver.inequality_sides(unlimited, three);
    CHECK(std::abs(value(solver.solve(), 1) - 1.0) < 1e-9);
    solver.bounds(second, unlimited, least, &status);
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(std::abs(value(solver.solve(), 1) - 1.0) < 1e-9);
    // x0 <= 1, x1 <= 1 and x0 + 2 x1 <= 4.
    solver.bounds(second, unlimited, one).inequality_sides(unlimited, upper);
    CHECK(std::abs(value(solver.solve(), 1) - 1.0) < 1e-9);
}

void failures_throw_or_are_reported() {
    roundel::Problem problem(3);
    try {
        problem.constrain({0, 7}, {1.0, 1.0}, 0.0);
        CHECK(!"reached");
    } catch (const roundel::Error& error) {
        CHECK(error.code() == ROUNDEL_ERROR_INDEX_OUT_OF_RANGE && error.index() == 1);
        CHECK(error.line() == -1 && error.direction().empty());
        CHECK(std::string(error.what()).find("is 7") != std::string::npos);
    }
    roundel::Status status;
    problem.constrain({0, 1}, {1.0}, 0.0, &status);
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH && !status.message.empty());
    problem.linear(2, -1.0, &status);
    CHECK(status && status.message.empty());
    const roundel::Solution none = roundel::solve(problem, {}, &status);
    CHECK(!none && status.code == ROUNDEL_ERROR_UNBOUNDED && status.index == 2);
    CHECK(status.direction == std::vector<double>({0.0, 0.0, 1.0}));
}

void files_keep_the_problem() {
    const std::string file = "wrapper.mps";
    const roundel::Problem problem = chain(6);
    const double energy = roundel::solve(problem).energy();
    problem.write_mps(file);
    CHECK(std::abs(roundel::solve(roundel::Problem::read_mps(file)).energy() - energy) < 1e-12);
    roundel::Options options;
    roundel::save_replay(problem, options.set_strategy("direct"), file);
    std::remove(file.c_str());
    std::remove("wrapper.replay.json");
    roundel::Status status;
    const roundel::Problem gone = roundel::Problem::read_mps(file, &status);
    CHECK(status.code == ROUNDEL_ERROR_IO && gone.get() == nullptr);
}
