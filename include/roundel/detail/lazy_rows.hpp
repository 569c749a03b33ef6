/// Solves a problem to which a function adds rows.

#ifndef ROUNDEL_DETAIL_LAZY_ROWS_HPP
#define ROUNDEL_DETAIL_LAZY_ROWS_HPP

#include <roundel/detail/options.hpp>
#include <roundel/detail/problem.hpp>
#include <roundel/detail/solution.hpp>
#include <roundel/detail/solve.hpp>
#include <roundel/detail/span.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>

ROUNDEL_NAMESPACE_BEGIN

/// A point that rows may cut off, during the callback.
struct Candidate {
    /// One value for each variable.
    span<const double> values;
    /// The objective at the point.
    double energy;
    /// Whether all integer variables have integer values; false for the minimiser of a relaxation.
    bool is_integer;
};

/// Receives a candidate and adds rows to an empty problem of as many variables: its inequalities
/// and constraints hold for the rest of the solve, and nothing else in it is read.
using LazyRows = std::function<Flow(const Candidate& candidate, Problem& rows)>;

namespace detail {

/// Passes candidates to a std::function, and carries its exceptions past the C frames in between.
struct RowAsker {
    const LazyRows& lazy;
    std::exception_ptr thrown = nullptr;

    /// The library's rows as a Problem that does not free them.
    struct Lent {
        explicit Lent(roundel_problem* rows) noexcept : problem(rows) {}
        ~Lent() { problem.release(); }
        Lent(const Lent&) = delete;
        Lent& operator=(const Lent&) = delete;
        Problem problem;
    };

    static std::int32_t callback(const roundel_candidate* candidate, roundel_problem* rows,
                                 void* user_data) noexcept {
        auto& self = *static_cast<RowAsker*>(user_data);
        const Candidate view{span<const double>(candidate->values, candidate->count),
                             candidate->energy, candidate->is_integer != 0};
        Lent lent(rows);
#if ROUNDEL_HPP_EXCEPTIONS
        try {
            return static_cast<std::int32_t>(self.lazy(view, lent.problem));
        } catch (...) {
            if (!self.thrown) {
                self.thrown = std::current_exception();
            }
            return static_cast<std::int32_t>(stop);
        }
#else
        return static_cast<std::int32_t>(self.lazy(view, lent.problem));
#endif
    }
};

} // namespace detail

/// Solves a problem together with rows that `lazy` adds during the search, because there are too
/// many to give them all before it. It sees each point that could become the solution, and the
/// minimiser of each relaxation that is not integer. A point that its rows cut off is never a
/// solution. What it adds must not depend on the order of its calls. An exception of `lazy` ends
/// the solve and is thrown again.
inline Solution solve_with_lazy_rows(const Problem& problem, const LazyRows& lazy,
                                     const Options& options = {}, Status* status = nullptr) {
    std::size_t variables = 0;
    if (problem.get()) {
        roundel_problem_variable_count(problem.get(), &variables);
    }
    detail::RowAsker asker{lazy};
    const auto call = [&](const roundel_options* how, const roundel_monitor* monitor,
                          roundel_solution** made) {
        const auto code = roundel_problem_solve_lazy(
            problem.get(), how, monitor, lazy ? detail::RowAsker::callback : nullptr, &asker, made);
#if ROUNDEL_HPP_EXCEPTIONS
        if (asker.thrown) {
            roundel_solution_free(*made);
            *made = nullptr;
            std::rethrow_exception(asker.thrown);
        }
#endif
        return code;
    };
    return detail::solution_of(options, call, variables, status);
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_LAZY_ROWS_HPP
