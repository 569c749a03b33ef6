// The solver without constraints, and the matrix types that ConstrainedSolver names.

#include "zoo.hpp"

#include <CoMISo/Solver/ConstrainedSolver.hh>
#include <CoMISo/Solver/MISolver.hh>

#include <array>
#include <limits>
#include <string>
#include <type_traits>

static_assert(std::is_same_v<COMISO::ConstrainedSolver::RowMatrix, RowMatrix>);
static_assert(std::is_same_v<COMISO::ConstrainedSolver::CSCMatrix, gmm::csc_matrix<double>>);

namespace {

// A is the tridiagonal matrix (-1, 3, -1), with b = A (0.6, 1.6, -2.3).
struct Chain {
    COMISO::ConstrainedSolver::CSCMatrix A;
    std::vector<double> x;
    std::vector<double> b{0.2, 6.5, -8.5};
    std::vector<int> integers{0, 1, 2};

    static double entry(std::size_t i, std::size_t j) {
        return i == j ? 3.0 : i + 1 == j || j + 1 == i ? -1.0 : 0.0;
    }
    Chain() {
        ColMatrix filled(3, 3);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                filled(i, j) += entry(i, j);
            }
        }
        gmm::copy(filled, A);
    }
    double energy(const std::array<double, 3>& at) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                sum += at[i] * entry(i, j) * at[j];
            }
            sum -= 2.0 * b[i] * at[i];
        }
        return sum;
    }
    // The best integers of [-5, 5]^3, by trying them all.
    std::vector<double> best() const {
        double least = std::numeric_limits<double>::infinity();
        std::vector<double> found;
        for (int i = -5; i <= 5; ++i) {
            for (int j = -5; j <= 5; ++j) {
                for (int k = -5; k <= 5; ++k) {
                    const double here = energy({double(i), double(j), double(k)});
                    if (here < least) {
                        least = here;
                        found = {double(i), double(j), double(k)};
                    }
                }
            }
        }
        return found;
    }
};

} // namespace

void a_matrix_is_solved_without_constraints() {
    Chain chain;
    COMISO::MISolver solver;
    // Without integers x solves A x = b.
    std::vector<int> none;
    solver.solve(chain.A, chain.x, chain.b, none);
    CHECK(near(chain.x, {0.6, 1.6, -2.3}));
    // Direct rounding takes the nearest integers of that.
    solver.set_direct_rounding();
    solver.solve(chain.A, chain.x, chain.b, chain.integers);
    CHECK(near(chain.x, {1.0, 2.0, -2.0}));
    solver.set_no_rounding();
    solver.solve(chain.A, chain.x, chain.b, chain.integers);
    CHECK(near(chain.x, {0.6, 1.6, -2.3}));

    COMISO::MISolver best;
    best.set_roundel_strategy("exact");
    best.solve(chain.A, chain.x, chain.b, chain.integers);
    CHECK(near(chain.x, chain.best()));

    // One integer, twice: the others are optimal for it, 3 x0 = 0.2 + x1 and 3 x2 = -8.5 + x1.
    COMISO::MISolver one;
    std::vector<int> twice{1, 1};
    one.solve(chain.A, chain.x, chain.b, twice);
    CHECK(near(chain.x, {2.2 / 3.0, 2.0, -6.5 / 3.0}));

    // The same by the solver with constraints, of which there are none.
    COMISO::ConstrainedSolver constrained;
    COMISO::ConstrainedSolver::RowMatrix C(0, 4);
    std::vector<double> same;
    constrained.solve(C, chain.A, same, chain.b, twice);
    CHECK(near(chain.x, same));

    // Timings go to the log if statistics are asked for.
    int lines = 0;
    COMISO::set_roundel_log([&](const std::string&) { ++lines; });
    one.solve(chain.A, chain.x, chain.b, twice);
    CHECK(lines == 0);
    one.set_stats();
    one.solve(chain.A, chain.x, chain.b, twice);
    CHECK(lines == 1);
    COMISO::set_roundel_log(nullptr);

    // An error leaves x as it was.
    std::vector<double> shorter{1.0};
    try {
        one.solve(chain.A, same, shorter, twice);
        CHECK(!"reached");
    } catch (const roundel::Error& error) {
        CHECK(error.code() == ROUNDEL_ERROR_LENGTH_MISMATCH);
    }
    CHECK(near(chain.x, same));
}
