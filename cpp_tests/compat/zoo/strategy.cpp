// Programs choose another strategy by a call or by the environment, without being rewritten.

#include "zoo.hpp"

#include <CoMISo/Solver/ConstrainedSolver.hh>

#include <cstdlib>
#include <string>

namespace {

// Two integers near one half, whose sum is strongly tied to 1. Direct rounding rounds both up,
// which costs much.
double energy(const char* of_solver) {
    ColMatrix A(2, 2);
    RowMatrix C(0, 3);
    A(0, 0) = 101.0;
    A(1, 1) = 101.0;
    A(0, 1) = 100.0;
    A(1, 0) = 100.0;
    std::vector<double> b{100.51, 100.51};
    std::vector<double> x;
    std::vector<int> integers{0, 1};
    COMISO::ConstrainedSolver solver;
    solver.misolver().set_direct_rounding(true);
    solver.misolver().set_roundel_strategy(of_solver);
    CHECK(solver.misolver().get_roundel_strategy() == of_solver);
    solver.solve(C, A, x, b, integers, 0.0, false, false);
    return solver.roundel_energy();
}

} // namespace

void a_strategy_is_chosen_by_a_call_or_the_environment() {
    const double direct = energy("");
    const double best = energy("auto");
    CHECK(best < direct - 1.0);

    COMISO::set_roundel_strategy("auto");
    CHECK(energy("") == best);
    CHECK(energy("direct") == direct);
    COMISO::set_roundel_strategy("");
    CHECK(energy("") == direct);

    setenv("ROUNDEL_COMISO_STRATEGY", "auto", 1);
    CHECK(energy("") == best);
    COMISO::set_roundel_strategy("direct");
    CHECK(energy("") == direct);
    COMISO::set_roundel_strategy("");
    setenv("ROUNDEL_COMISO_STRATEGY", "luck", 1);
    try {
        energy("");
        CHECK(!"reached");
    } catch (const roundel::Error& error) {
        CHECK(error.code() == ROUNDEL_ERROR_OPTION_RANGE);
        CHECK(std::string(error.what()).find("luck") != std::string::npos);
    }
    unsetenv("ROUNDEL_COMISO_STRATEGY");
    CHECK(energy("") == direct);
}
