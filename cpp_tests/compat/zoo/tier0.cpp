// The functions that libigl 2.5 and its ports call.

#include "zoo.hpp"

#include <CoMISo/Solver/ConstrainedSolver.hh>
#include <CoMISo/Solver/GMM_Tools.hh>
#include <CoMISo/Solver/MISolver.hh>

#include <type_traits>

static_assert(std::is_default_constructible_v<COMISO::ConstrainedSolver>);
static_assert(std::is_constructible_v<COMISO::ConstrainedSolver, bool>);
static_assert(!std::is_copy_constructible_v<COMISO::ConstrainedSolver>);
static_assert(!std::is_copy_assignable_v<COMISO::ConstrainedSolver>);
static_assert(std::is_same_v<decltype(std::declval<COMISO::ConstrainedSolver&>().misolver()),
                             COMISO::MISolver&>);

void a_parametrizer_solves_as_libigl_does() {
    for (const bool direct : {true, false}) {
        Small small;
        small.integers = {1, 1, 1};
        COMISO::ConstrainedSolver solver;
        COMISO::MISolver& settings = solver.misolver();
        settings.set_local_iters(5);
        settings.set_direct_rounding(direct);
        solver.solve(small.C, small.A, small.x, small.b, small.integers, 0.0, false, false);
        CHECK(near(small.x, small.best(2.0)));
        CHECK(small.x[1] == 2.0);
        CHECK(near(small.x[0] + 2.0 * small.x[2], 1.5));
    }
    // The calls with five, six and seven arguments.
    Small small;
    COMISO::ConstrainedSolver solver(false);
    solver.solve(small.C, small.A, small.x, small.b, small.integers);
    CHECK(near(small.x, small.best(2.0)));
    solver.solve(small.C, small.A, small.x, small.b, small.integers, 0.0);
    solver.solve(small.C, small.A, small.x, small.b, small.integers, 0.0, true);
    CHECK(near(small.x, small.best(2.0)));
    // `reg` has no effect.
    const std::vector<double> without = small.x;
    for (const double reg : {1e-6, 0.3, 1e3}) {
        solver.solve(small.C, small.A, small.x, small.b, small.integers, reg);
        CHECK(small.x == without);
        solver.solve_const(small.C, small.A, small.x, small.b, small.integers, reg, false, false);
        CHECK(small.x == without);
    }
}

// No constraint rows, and a constraint matrix that lacks the column of right sides.
void a_smooth_field_solves_without_constraints() {
    const std::size_t n = 6;
    ColMatrix A(n, n);
    RowMatrix C(0, n);
    std::vector<double> b(n, 0.0);
    std::vector<double> x(2, 7.0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        A(i, i) += 1.0;
        A(i + 1, i + 1) += 1.0;
        A(i, i + 1) -= 1.0;
        A(i + 1, i) -= 1.0;
    }
    A(0, 0) += 1.0;
    b[0] = 2.6;
    std::vector<int> integers{5};
    COMISO::ConstrainedSolver solver;
    solver.solve(C, A, x, b, integers, 0.0, false, true);
    CHECK(x.size() == n && x[5] == 3.0);
    // The chain goes from the target 2.6 to the integer in equal steps.
    for (std::size_t i = 0; i < n; ++i) {
        CHECK(near(x[i], 2.6 + 0.4 * static_cast<double>(i + 1) / 6.0));
    }
    integers.clear();
    solver.solve(C, A, x, b, integers);
    CHECK(near(x, std::vector<double>(n, 2.6)));
}

void entries_read_and_take_assignments() {
    const auto assign = [](auto matrix) {
        matrix(1, 2) = 2.0;
        matrix(1, 2) += 0.5;
        matrix(1, 2) -= 1.0;
        matrix(0, 0) = matrix(1, 2);
        matrix(0, 0) *= 4.0;
        matrix(0, 1) = 3.0;
        matrix(0, 1) = 0.0;
        const auto& read = matrix;
        const double sum = read(0, 0) + read(1, 2) + read(0, 1) + matrix(0, 2);
        CHECK(sum == 7.5);
        CHECK(gmm::nnz(matrix) == 2);
        CHECK(gmm::mat_nrows(matrix) == 2 && gmm::mat_ncols(matrix) == 3);
        gmm::resize(matrix, 1, 4);
        CHECK(gmm::nnz(matrix) == 1 && matrix.nrows() == 1 && matrix.ncols() == 4);
        gmm::clear(matrix);
        CHECK(gmm::nnz(matrix) == 0);
    };
    assign(RowMatrix(2, 3));
    assign(ColMatrix(2, 3));
    gmm::wsvector<double> v(4);
    v[3] = 2.0;
    v[1] += 1.5;
    CHECK(gmm::vect_size(v) == 4 && gmm::nnz(v) == 2 && v[3] == 2.0 && v[0] == 0.0);
}
