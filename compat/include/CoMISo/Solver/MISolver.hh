/// CoMISo's mixed-integer solver without constraints, and its settings.

#ifndef COMISO_SOLVER_MISOLVER_HH
#define COMISO_SOLVER_MISOLVER_HH

#include <CoMISo/Config/CoMISoDefines.hh>
#include <CoMISo/Config/config.hh>
#include <CoMISo/Roundel/Choice.hh>
#include <CoMISo/Roundel/Matrices.hh>
#include <CoMISo/Roundel/Problem.hh>
#include <CoMISo/Roundel/Rounding.hh>
#include <CoMISo/Roundel/Settings.hh>
#include <CoMISo/Solver/GMM_Tools.hh>

#include <roundel/roundel.hpp>

#include <vector>

namespace COMISO {

/// Minimises x'Ax - 2 x'b with some unknowns integer, by the settings that it has.
class COMISODLLEXPORT MISolver : public roundel_detail::Rounding {
  public:
    /// Solves for x, which is resized. A is symmetric and stored in full. No other argument
    /// changes. What cannot be solved throws a roundel::Error and leaves x unchanged.
    template <class Matrix, class Vector, class Right, class Indices>
    void solve(const Matrix& A, Vector& x, const Right& rhs, const Indices& to_round) const {
        ::roundel::Problem problem = roundel_detail::quadratic_problem(
            roundel_detail::entries_of(A), roundel_detail::numbers_of(rhs));
        roundel_detail::make_integer(problem, to_round);
        const ::roundel::Options options = roundel_detail::options_for(*this);
        const ::roundel::Solution solution = ::roundel::solve(problem, options);
        roundel_detail::store(solution, x);
        if (get_stats()) {
            roundel_detail::log_timings(options, solution);
        }
    }
};

} // namespace COMISO

#endif // COMISO_SOLVER_MISOLVER_HH
