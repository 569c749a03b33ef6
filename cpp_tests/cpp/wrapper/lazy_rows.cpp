// Rows that come during a solve.

#include "wrapper.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Integers that want to be 0.4, 0.5, 0.6, ...
roundel::Problem crowd(std::int32_t n) {
    roundel::Problem problem(static_cast<std::size_t>(n));
    for (std::int32_t i = 0; i < n; ++i) {
        problem.least_squares({i}, {1.0}, 0.4 + 0.1 * i);
        problem.integer({i});
    }
    return problem;
}

/// Neighbours are at least one apart.
roundel::Flow apart(const roundel::Candidate& candidate, roundel::Problem& rows) {
    const auto& x = candidate.values;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        if (x[i + 1] - x[i] < 1.0 - 1e-9) {
            const auto at = static_cast<std::int32_t>(i);
            rows.inequality({at, at + 1}, {-1.0, 1.0}, 1.0, none);
        }
    }
    return roundel::go_on;
}

} // namespace

void rows_come_during_a_solve() {
    const std::int32_t n = 6;
    const roundel::Problem problem = crowd(n);
    roundel::Problem whole = crowd(n);
    for (std::int32_t i = 0; i + 1 < n; ++i) {
        whole.inequality({i, i + 1}, {-1.0, 1.0}, 1.0, none);
    }
    const auto found = roundel::solve_with_lazy_rows(problem, apart);
    CHECK(found.status() == roundel::SolveStatus::optimal);
    CHECK(std::abs(found.energy() - roundel::solve(whole).energy()) < 1e-9);
    const auto thrown = [](const roundel::Candidate&, roundel::Problem&) -> roundel::Flow {
        throw std::runtime_error("enough");
    };
    std::string text;
    try {
        roundel::solve_with_lazy_rows(problem, thrown);
    } catch (const std::runtime_error& error) {
        text = error.what();
    }
    CHECK(text == "enough");
    roundel::Status status;
    CHECK(!roundel::solve_with_lazy_rows(problem, nullptr, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_NULL_POINTER);
}

void files_may_maximise() {
    const std::string file = "wrapper.lp";
    const roundel::Problem problem = crowd(3);
    problem.write(file);
    bool maximises = true;
    const auto read = roundel::Problem::read(file, &maximises);
    CHECK(!maximises);
    CHECK(std::abs(roundel::solve(read).energy() - roundel::solve(problem).energy()) < 1e-12);
    std::remove(file.c_str());
    roundel::Status status;
    const auto gone = roundel::Problem::read(file, &maximises, &status);
    CHECK(status.code == ROUNDEL_ERROR_IO && gone.get() == nullptr);
}
