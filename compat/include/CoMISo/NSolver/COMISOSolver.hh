/// Solves quadratic objectives with linear equality constraints that are given as functions.

#ifndef COMISO_NSOLVER_COMISOSOLVER_HH
#define COMISO_NSOLVER_COMISOSOLVER_HH

#include <CoMISo/Config/CoMISoDefines.hh>
#include <CoMISo/Config/config.hh>
#include <CoMISo/NSolver/LinearConstraint.hh>
#include <CoMISo/NSolver/NConstraintInterface.hh>
#include <CoMISo/NSolver/NProblemInterface.hh>
#include <CoMISo/NSolver/VariableType.hh>
#include <CoMISo/Solver/ConstrainedSolver.hh>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <string>
#include <vector>

namespace COMISO {

/// Solves the quadratic problem that the gradients and Hessians at zero define, which is exact for
/// a quadratic objective and linear constraints. Inequalities and binary variables are refused.
class COMISODLLEXPORT COMISOSolver {
  public:
    using PairUiV = COMISO::PairUiV;

    /// The solver that is used, for its settings.
    ConstrainedSolver& solver() { return solver_; }

    /// Minimises the problem and stores the result in it. Throws a roundel::Error if it cannot be
    /// solved.
    void solve(NProblemInterface* problem, std::vector<NConstraintInterface*>& constraints,
               std::vector<PairUiV>& discrete, double reg = 0.0, bool show_miso_settings = true,
               bool show_timings = true) {
        const int n = problem->n_unknowns();
        const std::vector<double> zero(static_cast<std::size_t>(n), 0.0);

        NProblemInterface::SMatrixNP hessian(n, n);
        problem->eval_hessian(zero.data(), hessian);
        Eigen::VectorXd right(n);
        problem->eval_gradient(zero.data(), right.data());
        right = -right;

        const auto rows = rows_of(constraints, n);
        const std::vector<int> integers = integers_of(discrete);
        Eigen::VectorXd x;
        solver_.solve_const(rows, hessian, x, right, integers, reg, show_miso_settings,
                            show_timings);
        problem->store_result(x.data());
    }

    /// The same without integers.
    void solve(NProblemInterface* problem, std::vector<NConstraintInterface*>& constraints,
               double reg = 0.0, bool show_miso_settings = true, bool show_timings = true) {
        std::vector<PairUiV> none;
        solve(problem, constraints, none, reg, show_miso_settings, show_timings);
    }

  private:
    using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    static RowMatrix rows_of(const std::vector<NConstraintInterface*>& constraints, int n) {
        const std::vector<double> zero(static_cast<std::size_t>(n), 0.0);
        std::vector<Eigen::Triplet<double>> entries;
        int row = 0;
        for (NConstraintInterface* constraint : constraints) {
            if (constraint->constraint_type() != NConstraintInterface::NC_EQUAL) {
                roundel_detail::refuse(ROUNDEL_ERROR_NOT_SUPPORTED,
                                       "constraint " + std::to_string(row) +
                                           " is an inequality, which is not supported yet");
            }
            NConstraintInterface::SVectorNC gradient(n);
            constraint->eval_gradient(zero.data(), gradient);
            for (NConstraintInterface::SVectorNC::InnerIterator it(gradient); it; ++it) {
                entries.emplace_back(row, static_cast<int>(it.index()), it.value());
            }
            entries.emplace_back(row, n, constraint->eval_constraint(zero.data()));
            ++row;
        }
        RowMatrix rows(row, n + 1);
        rows.setFromTriplets(entries.begin(), entries.end());
        return rows;
    }

    static std::vector<int> integers_of(const std::vector<PairUiV>& discrete) {
        std::vector<int> integers;
        for (const auto& [variable, type] : discrete) {
            if (type == Binary) {
                roundel_detail::refuse(ROUNDEL_ERROR_NOT_SUPPORTED,
                                       "variable " + std::to_string(variable) +
                                           " is binary, which is not supported yet");
            }
            if (type == Integer) {
                integers.push_back(static_cast<int>(variable));
            }
        }
        return integers;
    }

    ConstrainedSolver solver_;
};

} // namespace COMISO

#endif // COMISO_NSOLVER_COMISOSOLVER_HH
