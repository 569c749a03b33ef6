/// The result of a solve.

#ifndef ROUNDEL_DETAIL_SOLUTION_HPP
#define ROUNDEL_DETAIL_SOLUTION_HPP

#include <roundel/detail/error.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// How a solve ended.
enum class SolveStatus : std::int32_t {
    optimal = ROUNDEL_SOLVE_OPTIMAL,
    feasible = ROUNDEL_SOLVE_FEASIBLE,
    limit = ROUNDEL_SOLVE_LIMIT,
    cancelled = ROUNDEL_SOLVE_CANCELLED,
    relaxed = ROUNDEL_SOLVE_RELAXED,
};

/// The name of a status.
inline const char* name(SolveStatus status) noexcept {
    return roundel_solve_status_name(static_cast<std::int32_t>(status));
}

/// Why a search ended before it had visited everything that could be better.
enum class StoppedBy : std::int32_t {
    /// It is complete, it has reached the option gap, or its strategy proves nothing.
    none = ROUNDEL_STOPPED_BY_NONE,
    /// The option nodes, set by the caller.
    nodes = ROUNDEL_STOPPED_BY_NODES,
    time = ROUNDEL_STOPPED_BY_TIME,
    memory = ROUNDEL_STOPPED_BY_MEMORY,
    cancel = ROUNDEL_STOPPED_BY_CANCEL,
    /// A budget of the library: the work of auto, or the default of nodes.
    budget = ROUNDEL_STOPPED_BY_BUDGET,
};

/// The word for what stopped a search.
inline const char* name(StoppedBy stopped_by) noexcept {
    return roundel_stopped_by_name(static_cast<std::int32_t>(stopped_by));
}

/// The largest violations of constraints and integrality.
struct Violations {
    double constraint = 0.0;
    double integrality = 0.0;
};

/// A solution: its values, their energy, and a bound on how far it is from the optimum.
class Solution {
  public:
    /// An empty solution, which solve returns when it reports a failure in a Status.
    Solution() noexcept = default;

    /// Takes ownership of a solution of the C interface.
    explicit Solution(roundel_solution* owned, Status* status = nullptr) : handle_(owned) {
        std::size_t variables = 0;
        if (detail::check(roundel_solution_variable_count(get(), &variables), status)) {
            values_.resize(variables);
            detail::check(roundel_solution_values(get(), values_.data(), variables), status);
        }
    }

    /// Whether the solution is not empty.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// One value for each variable. The view is valid as long as the solution.
    span<const double> values() const& noexcept { return {values_.data(), values_.size()}; }
    span<const double> values() const&& = delete;

    /// The objective, in the caller's units.
    double energy(Status* status = nullptr) const {
        double value = 0.0;
        detail::check(roundel_solution_energy(get(), &value), status);
        return value;
    }

    /// A lower bound on the energy of all integer solutions.
    std::optional<double> lower_bound(Status* status = nullptr) const {
        return maybe(roundel_solution_lower_bound, status);
    }

    /// (energy - lower_bound) / |energy|, if there is a bound: 0 where they are equal, and infinite
    /// for an energy of 0 above the bound.
    std::optional<double> gap(Status* status = nullptr) const {
        return maybe(roundel_solution_gap, status);
    }

    /// How the solve ended.
    SolveStatus status(Status* status = nullptr) const {
        auto value = ROUNDEL_SOLVE_FEASIBLE;
        detail::check(roundel_solution_status(get(), &value), status);
        return static_cast<SolveStatus>(value);
    }

    /// Whether the search has visited everything that could be better. Always true without
    /// integers. A solution can be optimal without that, if a bound proves it.
    bool is_complete(Status* status = nullptr) const {
        std::int32_t value = 0;
        detail::check(roundel_solution_is_complete(get(), &value), status);
        return value != 0;
    }

    /// Why the search ended before it was complete.
    StoppedBy stopped_by(Status* status = nullptr) const {
        auto value = ROUNDEL_STOPPED_BY_NONE;
        detail::check(roundel_solution_stopped_by(get(), &value), status);
        return static_cast<StoppedBy>(value);
    }

    /// Sizes of the problem before and after elimination.
    roundel_counts counts(Status* status = nullptr) const {
        roundel_counts value{};
        detail::check(roundel_solution_counts(get(), &value), status);
        return value;
    }

    /// Wall-clock seconds by phase.
    roundel_seconds seconds(Status* status = nullptr) const {
        roundel_seconds value{};
        detail::check(roundel_solution_seconds(get(), &value), status);
        return value;
    }

    Violations violations(Status* status = nullptr) const {
        Violations value;
        detail::check(roundel_solution_violations(get(), &value.constraint, &value.integrality),
                      status);
        return value;
    }

    const roundel_solution* get() const noexcept { return handle_.get(); }

  private:
    template <class Function> std::optional<double> maybe(Function function, Status* status) const {
        std::int32_t known = 0;
        double value = 0.0;
        detail::check(function(get(), &known, &value), status);
        return known != 0 ? std::optional<double>(value) : std::nullopt;
    }

    detail::Handle<roundel_solution, roundel_solution_free> handle_;
    std::vector<double> values_;
};

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_SOLUTION_HPP
