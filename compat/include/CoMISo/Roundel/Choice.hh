/// Translates CoMISo's settings to Roundel's options.

#ifndef COMISO_ROUNDEL_CHOICE_HH
#define COMISO_ROUNDEL_CHOICE_HH

#include <CoMISo/Roundel/Rounding.hh>
#include <CoMISo/Roundel/Settings.hh>

#include <roundel/roundel.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace COMISO {
namespace roundel_detail {

/// The number as an option takes it.
inline std::int64_t count_of(unsigned int value) {
    const std::int64_t largest = std::numeric_limits<std::int32_t>::max();
    return std::min<std::int64_t>(value, largest);
}

/// The options that correspond to `settings`.
inline ::roundel::Options options_for(const Rounding& settings) {
    using Type = Rounding::RoundingType;
    ::roundel::Options options;
    const Type type = settings.get_rounding_type();
    if (type == Type::NONE) {
        return options.set_strategy("relax");
    }
    const std::string strategy = strategy_for(settings.get_roundel_strategy());
    if (!strategy.empty()) {
        return options.set_strategy(strategy);
    }
    switch (type) {
    case Type::GUROBI:
        log("Gurobi is not used: the exact strategy takes its place");
        return options.set_strategy("exact").set_time_limit(settings.get_gurobi_max_time());
    case Type::CPLEX:
        log("CPLEX is not used: the exact strategy takes its place");
        return options.set_strategy("exact");
    case Type::DIRECT:
        return options.set_strategy("direct");
    default:
        break;
    }
    // This ordering makes the elimination keep the same integers as CoMISo, and the iterations are
    // the same. With a threshold of zero, integers are rounded one at a time.
    const double threshold =
        settings.get_multiple_rounding() ? settings.get_multiple_rounding_threshold() : 0.0;
    return options.set_strategy("multiple")
        .set_ordering("largest_pivot")
        .set_rounding_threshold(threshold)
        .set_gauss_seidel_updates(count_of(settings.get_local_iters()))
        .set_gauss_seidel_tolerance(settings.get_local_error())
        .set_cg_iterations(count_of(settings.get_cg_iters()))
        .set_cg_tolerance(settings.get_cg_error())
        .set_exact_steps(settings.get_iter_full() ? 1 : 0);
}

/// Writes to the log how long a solve took.
inline void log_timings(const ::roundel::Options& options, const ::roundel::Solution& solution) {
    const roundel_seconds seconds = solution.seconds();
    log(*options.strategy + ": " + std::to_string(solution.counts().integers) + " integers, " +
        std::to_string(seconds.eliminate * 1e3) + " ms for constraints, " +
        std::to_string(seconds.total * 1e3) + " ms in all");
}

} // namespace roundel_detail
} // namespace COMISO

#endif // COMISO_ROUNDEL_CHOICE_HH
