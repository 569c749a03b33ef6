// The functions that other direct users call: every setting, the second forms of solve, the stop
// watch.

#include "zoo.hpp"

#include <CoMISo/Config/CoMISoDefines.hh>
#include <CoMISo/Config/config.hh>
#include <CoMISo/Solver/ConstrainedSolver.hh>
#include <CoMISo/Solver/MISolver.hh>
#include <CoMISo/Utils/StopWatch.hh>

#include <algorithm>
#include <string>

#if !COMISO_GMM_AVAILABLE || !COMISO_EIGEN3_AVAILABLE
#error "GMM and Eigen are present, so both macros must be defined"
#endif
#if COMISO_GUROBI_AVAILABLE || COMISO_CPLEX_AVAILABLE || COMISO_SUITESPARSE_AVAILABLE
#error "Gurobi, CPLEX and SuiteSparse are absent, so their macros must not be defined"
#endif

namespace {

class COMISODLLEXPORT Exported {};

using Type = COMISO::MISolver::RoundingType;
static_assert(Type::DEFAULT == Type::MULTIPLE);

// Two integers near one half, with x0 + x1 strongly tied to 1. Rounded at once, both go up. Rounded
// one after the other, the second compensates for the first.
struct Pair {
    ColMatrix A{2, 2};
    RowMatrix C{0, 3};
    std::vector<double> b{100.51, 100.51};
    std::vector<double> x;
    std::vector<int> integers{0, 1};

    Pair() {
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t j = 0; j < 2; ++j) {
                A(i, j) = i == j ? 101.0 : 100.0;
            }
        }
    }
    double sum(COMISO::ConstrainedSolver& solver) {
        solver.solve(C, A, x, b, integers, 0.0, false, false);
        return x[0] + x[1];
    }
};

} // namespace

#define COMES_BACK(name, value)                                                                    \
    do {                                                                                           \
        CHECK(!(settings.get_##name() == (value)));                                                \
        settings.set_##name(value);                                                                \
        CHECK(settings.get_##name() == (value));                                                   \
    } while (false)

#define TURNS_ON(name)                                                                             \
    do {                                                                                           \
        settings.set_##name(false);                                                                \
        CHECK(!settings.get_##name());                                                             \
        settings.set_##name();                                                                     \
        CHECK(settings.get_##name());                                                              \
    } while (false)

void settings_come_back_as_set() {
    COMISO::MISolver settings;
    CHECK(settings.get_inital_full() && settings.get_iter_full() && settings.get_final_full());
    CHECK(settings.get_multiple_rounding() && settings.get_multiple_rounding_threshold() == 0.5);
    CHECK(settings.get_local_iters() == 100000 && settings.get_local_error() == 1e-3);
    CHECK(settings.get_cg_iters() == 50 && settings.get_cg_error() == 1e-3);
    TURNS_ON(inital_full);
    TURNS_ON(iter_full);
    TURNS_ON(final_full);
    TURNS_ON(direct_rounding);
    TURNS_ON(no_rounding);
    TURNS_ON(multiple_rounding);
    TURNS_ON(gurobi_rounding);
    TURNS_ON(cplex_rounding);
    TURNS_ON(stats);
    COMES_BACK(local_iters, 7u);
    COMES_BACK(local_error, 1e-5);
    COMES_BACK(cg_iters, 20u);
    COMES_BACK(cg_error, 1e-6);
    COMES_BACK(multiple_rounding_threshold, 0.25);
    COMES_BACK(noise, 3u);
    COMES_BACK(gurobi_max_time, 12.5);
    settings.set_use_constraint_reordering(false);
    CHECK(!settings.use_constraint_reordering());
    settings.use_constraint_reordering() = true;
    CHECK(settings.use_constraint_reordering());
    for (Type type : {Type::NONE, Type::DIRECT, Type::MULTIPLE, Type::GUROBI, Type::CPLEX}) {
        settings.set_rounding_type(type);
        CHECK(settings.get_rounding_type() == type);
    }
    COMISO::ConstrainedSolver solver;
    solver.set_epsilon(1e-6);
    solver.set_noisy(2);
    CHECK(solver.epsilon() == 1e-6 && solver.noisy() == 2);
    solver.set_use_constraint_reordering(false);
    CHECK(!solver.misolver().use_constraint_reordering() && !solver.use_constraint_reordering());

    COMISO::StopWatch watch;
    watch.start();
    CHECK(watch.elapsed() >= 0.0 && watch.restart() >= 0.0);
    const double stopped = watch.stop();
    CHECK(stopped >= 0.0 && stopped < 60e3 && watch.elapsed() == stopped);
}

// The order of precedence is Gurobi, CPLEX, none, direct, multiple, one at a time.
void rounding_types_follow_their_precedence() {
    std::vector<std::string> lines;
    COMISO::set_roundel_log([&](const std::string& line) { lines.push_back(line); });
    const auto told = [&](const std::string& word) {
        return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
            return line.find(word) != std::string::npos;
        });
    };
    Pair pair;
    {
        COMISO::ConstrainedSolver solver;
        COMISO::MISolver& settings = solver.misolver();
        CHECK(pair.sum(solver) == 1.0);
        settings.set_direct_rounding();
        CHECK(pair.sum(solver) == 2.0);
        settings.set_no_rounding();
        CHECK(near(pair.sum(solver), 201.02 / 201.0) && pair.x[0] != 1.0);
        CHECK(lines.empty());
        settings.set_cplex_rounding();
        CHECK(pair.sum(solver) == 1.0 && told("CPLEX") && !told("Gurobi"));
        settings.set_gurobi_rounding();
        CHECK(pair.sum(solver) == 1.0 && told("Gurobi"));
    }
    {
        COMISO::ConstrainedSolver solver;
        solver.misolver().set_direct_rounding(false);
        CHECK(solver.misolver().get_rounding_type() == Type::MULTIPLE && pair.sum(solver) == 1.0);
        solver.misolver().set_multiple_rounding_threshold(2.0);
        CHECK(pair.sum(solver) == 2.0);
        solver.misolver().set_multiple_rounding(false);
        CHECK(pair.sum(solver) == 1.0);
        lines.clear();
        solver.solve(pair.C, pair.A, pair.x, pair.b, pair.integers);
        CHECK(lines.size() == 1 && told("ms"));
    }
    // Without iterations the second integer is not updated after the first is rounded.
    COMISO::ConstrainedSolver deaf;
    deaf.misolver().set_multiple_rounding(false);
    deaf.misolver().set_local_iters(0);
    deaf.misolver().set_cg_iters(0);
    deaf.misolver().set_iter_full(false);
    CHECK(pair.sum(deaf) == 2.0);
    deaf.misolver().set_iter_full(true);
    CHECK(pair.sum(deaf) == 1.0);
    // Halves are rounded away from zero.
    ColMatrix A(2, 2);
    A(0, 0) = 1.0;
    A(1, 1) = 1.0;
    RowMatrix C(0, 3);
    std::vector<double> b{0.5, -0.5};
    std::vector<int> both{0, 1};
    COMISO::ConstrainedSolver solver;
    solver.solve_const(C, A, pair.x, b, both);
    CHECK(pair.x[0] == 1.0 && pair.x[1] == -1.0);
    COMISO::set_roundel_log(nullptr);
}

void least_squares_and_a_second_solve() {
    const Small small;
    // The rows of Small, each with its negated right side.
    RowMatrix B(3, 4);
    B(0, 0) = 1.0;
    B(0, 3) = -0.4;
    B(1, 1) = 1.0;
    B(1, 3) = -2.7;
    B(2, 0) = 1.0;
    B(2, 1) = -1.0;
    B(2, 2) = 1.0;
    RowMatrix C = small.C;
    std::vector<int> integers = small.integers;
    std::vector<double> x;
    COMISO::ConstrainedSolver solver;
    solver.solve(C, B, x, integers);
    CHECK(near(x, small.best(2.0)));
    const double energy =
        std::pow(x[0] - 0.4, 2) + std::pow(x[1] - 2.7, 2) + std::pow(x[0] - x[1] + x[2], 2);
    CHECK(near(solver.roundel_energy(), energy));
    // `reg` times 5/3, the mean of the diagonal of A = B'B, is added to that diagonal.
    const double reg = 0.3;
    solver.solve(C, B, x, integers, reg);
    solver.solve(C, B, x, integers, reg, false);
    std::vector<double> same;
    Small full;
    for (std::size_t i = 0; i < 3; ++i) {
        full.A(i, i) += 0.5;
    }
    COMISO::ConstrainedSolver other;
    other.solve(full.C, full.A, same, full.b, full.integers);
    CHECK(near(x, same));
    CHECK(!near(x, small.best(2.0)));
    solver.solve_const(C, B, x, integers, 0.0, false, false);
    CHECK(near(x, small.best(2.0)));

    // Another right side of the constraint, with its own sign, by values and by pointers.
    const std::vector<double> constraint{0.5};
    solver.resolve(x, constraint, small.b);
    CHECK(near(x, small.best(2.0, 0.5)) && near(x[0] + 2.0 * x[2], 0.5));
    const std::vector<double> right{0.4, 6.7, 0.0};
    other.solve_const(small.C, small.A, x, small.b, small.integers, 0.0, false, false);
    CHECK(near(x, small.best(2.0)));
    solver.resolve(x, constraint, right);
    other.resolve(same, &constraint, &right);
    CHECK(near(x, same) && x[1] == 4.0);
    other.resolve(same, nullptr, &small.b);
    CHECK(near(same, small.best(2.0, 0.5)));
    other.resolve(same, std::vector<double>{1.5});
    CHECK(near(same, small.best(2.0)));
    other.resolve(same);
    CHECK(near(same, small.best(2.0)));

    // The fourth argument decides whether timings go to the log.
    int lines = 0;
    COMISO::set_roundel_log(
        [&](const std::string& line) { lines += line.find("ms") < line.size(); });
    other.resolve(same, constraint, small.b, false);
    CHECK(near(same, small.best(2.0, 0.5)) && lines == 0);
    other.resolve(same, constraint, small.b, true);
    CHECK(near(same, small.best(2.0, 0.5)) && lines == 1);
    other.resolve(same, constraint, small.b);
    CHECK(lines == 2);
    COMISO::set_roundel_log(nullptr);
}

namespace {

template <class Call> roundel_status failure(const Call& call, std::int64_t* index = nullptr) {
    try {
        call();
    } catch (const roundel::Error& error) {
        if (index) {
            *index = error.index();
        }
        return std::string(error.what()).empty() ? ROUNDEL_OK : error.code();
    }
    return ROUNDEL_OK;
}

} // namespace

void errors_name_what_is_wrong() {
    std::int64_t index = -1;
    COMISO::ConstrainedSolver solver;
    std::vector<double> before{1.0, 2.0};
    CHECK(failure([&] { solver.resolve(before); }) == ROUNDEL_ERROR_INVALID_ARGUMENT);

    // A repeated row is redundant. With another right side it contradicts.
    for (const bool contradicts : {false, true}) {
        Small small;
        gmm::resize(small.C, 2, 4);
        small.C(1, 0) = 2.0;
        small.C(1, 2) = 4.0;
        small.C(1, 3) = contradicts ? -2.5 : -3.0;
        const auto code = failure(
            [&] { solver.solve(small.C, small.A, before, small.b, small.integers); }, &index);
        CHECK(code == (contradicts ? ROUNDEL_ERROR_INFEASIBLE : ROUNDEL_OK));
        CHECK(!contradicts || index == 1 || index == 0);
        CHECK(near(before, small.best(2.0)));
    }
    // 2 x0 + 4 x1 = 3 has no integer solution, while 2 x0 + 3 x1 = 1 has one.
    for (const double last : {4.0, 3.0}) {
        Pair pair;
        gmm::resize(pair.C, 1, 3);
        pair.C(0, 0) = 2.0;
        pair.C(0, 1) = last;
        pair.C(0, 2) = last == 4.0 ? -3.0 : -1.0;
        const auto code =
            failure([&] { solver.solve(pair.C, pair.A, pair.x, pair.b, pair.integers); }, &index);
        CHECK(code == (last == 4.0 ? ROUNDEL_ERROR_NO_INTEGER_SOLUTION : ROUNDEL_OK));
        CHECK(last == 4.0 ? index == 0 : 2.0 * pair.x[0] + 3.0 * pair.x[1] == 1.0);
    }
    Small small;
    RowMatrix narrow(1, 3);
    narrow(0, 0) = 1.0;
    CHECK(failure([&] { solver.solve(narrow, small.A, small.x, small.b, small.integers); }) ==
          ROUNDEL_ERROR_LENGTH_MISMATCH);
    ColMatrix oblong(3, 2);
    CHECK(failure([&] { solver.solve(small.C, oblong, small.x, small.b, small.integers); }) ==
          ROUNDEL_ERROR_LENGTH_MISMATCH);
    RowMatrix empty(1, 1);
    CHECK(failure([&] { solver.solve(small.C, empty, small.x, small.integers); }) ==
          ROUNDEL_ERROR_LENGTH_MISMATCH);
    std::vector<int> outside{1, 3};
    CHECK(failure([&] { solver.solve(small.C, small.A, small.x, small.b, outside); }, &index) ==
          ROUNDEL_ERROR_INDEX_OUT_OF_RANGE);
    CHECK(index == 1);
    std::vector<double> shorter{1.0};
    solver.solve(small.C, small.A, small.x, small.b, small.integers);
    CHECK(failure([&] { solver.resolve(small.x, nullptr, shorter); }) ==
          ROUNDEL_ERROR_LENGTH_MISMATCH);
}
