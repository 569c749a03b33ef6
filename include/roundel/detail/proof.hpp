/// Proofs: a solve that writes one, and the checker.

#ifndef ROUNDEL_DETAIL_PROOF_HPP
#define ROUNDEL_DETAIL_PROOF_HPP

#include <roundel/detail/options.hpp>
#include <roundel/detail/problem.hpp>
#include <roundel/detail/solution.hpp>
#include <roundel/detail/solve.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

ROUNDEL_NAMESPACE_BEGIN

/// What a proof proves.
struct Proof {
    /// The energy of the point, rounded to the next number above, if there is a point.
    std::optional<double> energy;
    /// No point within all rows, bounds and integers has less energy. Nothing if it is proved that
    /// there is no such point.
    std::optional<double> lower_bound;
    /// The largest violation of a row or bound by the point, relative to the sizes of its terms,
    /// which the checker computes.
    double violation = 0.0;
    /// The nodes of all trees.
    std::int64_t nodes = 0;
    /// What stopped the writing of the proof: then there is none. StoppedBy::none for a proof that
    /// is written, or accepted.
    StoppedBy stopped_by = StoppedBy::none;

    /// Whether there is a proof.
    explicit operator bool() const noexcept { return stopped_by == StoppedBy::none; }
};

/// A solution and what its proof proves.
struct Proved {
    Solution solution;
    Proof proof;
};

namespace detail {

inline Proof proof_of(const roundel_proof_report& report) {
    const auto finite = [](double value) {
        return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
    };
    Proof proof;
    proof.energy = finite(report.energy);
    proof.lower_bound = finite(report.lower_bound);
    proof.violation = report.violation;
    proof.nodes = report.nodes;
    proof.stopped_by = static_cast<StoppedBy>(report.stopped_by);
    return proof;
}

/// That of a call that fails.
inline Proof no_proof() {
    Proof proof;
    proof.stopped_by = StoppedBy::cancel;
    return proof;
}

inline Proof check_proof(const std::string& file, const roundel_problem* problem, Status* status) {
    roundel_proof_report report{};
    const bool holds = check(roundel_proof_check(file.c_str(), problem, &report), status);
    return holds ? proof_of(report) : no_proof();
}

} // namespace detail

/// Solves a problem and writes a proof of the bound to a file, for check_proof. The strategy must
/// be "exact" or "auto". Half of the option time_limit is for the search at most, so that time is
/// left for the proof. A proof that the limit or a cancel ends is not written; `proof` says so, and
/// the solution is there. A problem without a solution gets a proof of that, and the failure is
/// that of `solve`.
inline Proved solve_with_proof(const Problem& problem, const std::string& file,
                               const Options& options = {}, Status* status = nullptr) {
    std::size_t variables = 0;
    if (problem.get()) {
        roundel_problem_variable_count(problem.get(), &variables);
    }
    roundel_proof_report report{};
    const auto call = [&](const roundel_options* how, const roundel_monitor* monitor,
                          roundel_solution** made) {
        return roundel_problem_solve_with_proof(problem.get(), how, monitor, file.c_str(), &report,
                                                made);
    };
    Proved proved;
    proved.solution = detail::solution_of(options, call, variables, status);
    proved.proof = proved.solution ? detail::proof_of(report) : detail::no_proof();
    return proved;
}

/// Checks the proof in a file in exact numbers. One that does not hold fails with
/// ROUNDEL_ERROR_PROOF_REFUSED and the line at fault.
inline Proof check_proof(const std::string& file, Status* status = nullptr) {
    return detail::check_proof(file, nullptr, status);
}

/// Checks the proof in a file, which must be of this problem.
inline Proof check_proof(const std::string& file, const Problem& problem,
                         Status* status = nullptr) {
    if (!problem.get()) {
        Status failure;
        failure.code = ROUNDEL_ERROR_NULL_POINTER;
        failure.message = "problem is NULL";
        detail::fail(std::move(failure), status);
        return detail::no_proof();
    }
    return detail::check_proof(file, problem.get(), status);
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_PROOF_HPP
