// Solves through CoMISo's interface and checks the result with the caller's matrices.

#ifndef ROUNDING_SOLVE_HPP
#define ROUNDING_SOLVE_HPP

#include "problem.hpp"

#include "../../cpp/check.hpp"

#include <CoMISo/Solver/ConstrainedSolver.hh>

#include <cmath>
#include <string>
#include <vector>

struct Solved {
    std::vector<double> x;
    double energy;
};

// The settings of Bommes' thesis for parametrizations (section 5.3).
inline void thesis(COMISO::MISolver& settings) {
    settings.set_local_iters(0);
    settings.set_cg_iters(20);
    settings.set_iter_full(false);
}

inline Solved solved(const GmmProblem& problem, COMISO::ConstrainedSolver& solver) {
    Solved to;
    solver.solve_const(problem.C, problem.A, to.x, problem.b, problem.integers, 0.0, false, false);
    to.energy = problem.energy(to.x);
    const double told = solver.roundel_energy() + problem.constant;
    CHECK(std::abs(told - to.energy) <= 1e-6 * (1.0 + std::abs(to.energy)));
    return to;
}

inline Solved by_thesis(const GmmProblem& problem) {
    COMISO::ConstrainedSolver solver;
    thesis(solver.misolver());
    return solved(problem, solver);
}

inline Solved by(const GmmProblem& problem, const std::string& strategy) {
    COMISO::ConstrainedSolver solver;
    solver.misolver().set_roundel_strategy(strategy);
    return solved(problem, solver);
}

#endif
