/// A solver for many solves of one problem with changing right sides.

#ifndef ROUNDEL_DETAIL_SOLVER_HPP
#define ROUNDEL_DETAIL_SOLVER_HPP

#include <roundel/detail/solve.hpp>

#include <cstddef>
#include <cstdint>

ROUNDEL_NAMESPACE_BEGIN

/// A problem with fixed matrices and integers that is solved many times. Elimination, orderings and
/// factors are kept, so a solve with other right sides costs a fraction of the first.
///
/// The solution equals that of `solve` for the same data, except that a warm start may improve it.
/// A solve that fails changes nothing.
class Solver {
  public:
    /// A solver for a copy of `problem`.
    explicit Solver(const Problem& problem, Status* status = nullptr) {
        roundel_solver* made = nullptr;
        if (detail::check(roundel_solver_new(problem.get(), &made), status)) {
            handle_.reset(made);
            roundel_problem_variable_count(problem.get(), &variables_);
        }
    }

    /// Whether there is a solver.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// Replaces the linear term, one value for each variable.
    Solver& linear(span<const double> values, Status* status = nullptr) {
        return told(roundel_solver_set_linear(get(), values.data(), values.size()), status);
    }

    /// Replaces the right sides of the constraints, one for each constraint.
    Solver& constraint_right_sides(span<const double> values, Status* status = nullptr) {
        return told(roundel_solver_set_constraint_right_sides(get(), values.data(), values.size()),
                    status);
    }

    /// Replaces the right sides of the least-squares rows, one for each row.
    Solver& least_squares_right_sides(span<const double> values, Status* status = nullptr) {
        return told(
            roundel_solver_set_least_squares_right_sides(get(), values.data(), values.size()),
            status);
    }

    /// Replaces the sides of the inequalities, one lower and one upper side for each.
    Solver& inequality_sides(span<const double> lower, span<const double> upper,
                             Status* status = nullptr) {
        if (detail::same_length(lower.size(), upper.size(), status)) {
            return told(roundel_solver_set_inequality_sides(get(), lower.data(), upper.data(),
                                                            lower.size()),
                        status);
        }
        return *this;
    }

    /// Sets lower[k] <= x[variables[k]] <= upper[k], in place of earlier bounds of these variables.
    Solver& bounds(span<const std::int32_t> variables, span<const double> lower,
                   span<const double> upper, Status* status = nullptr) {
        if (detail::same_length(variables.size(), lower.size(), status) &&
            detail::same_length(variables.size(), upper.size(), status)) {
            return told(roundel_solver_set_bounds(get(), variables.size(), variables.data(),
                                                  lower.data(), upper.data()),
                        status);
        }
        return *this;
    }

    /// Sets the point whose values variables keep where the objective does not determine them. A
    /// warm start begins there.
    Solver& guess(span<const double> values, Status* status = nullptr) {
        return told(roundel_solver_set_guess(get(), values.data(), values.size()), status);
    }

    /// Fixes a variable to a value.
    Solver& pin(std::int64_t variable, double value, Status* status = nullptr) {
        return told(roundel_solver_pin(get(), variable, value), status);
    }

    /// Releases a pinned variable.
    Solver& unpin(std::int64_t variable, Status* status = nullptr) {
        return told(roundel_solver_unpin(get(), variable), status);
    }

    /// Solves the problem with its current data.
    Solution solve(const Options& options = {}, Status* status = nullptr) {
        const auto call = [this](const roundel_options* how, const roundel_monitor* monitor,
                                 roundel_solution** made) {
            return roundel_solver_solve(get(), how, monitor, made);
        };
        return detail::solution_of(options, call, variables_, status);
    }

    roundel_solver* get() const noexcept { return handle_.get(); }

  private:
    Solver& told(roundel_status code, Status* status) {
        detail::check(code, status);
        return *this;
    }

    detail::Handle<roundel_solver, roundel_solver_free> handle_;
    std::size_t variables_ = 0;
};

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_SOLVER_HPP
