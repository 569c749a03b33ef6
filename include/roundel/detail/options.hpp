/// Options of a solve, events of its callback, and the token that cancels it.

#ifndef ROUNDEL_DETAIL_OPTIONS_HPP
#define ROUNDEL_DETAIL_OPTIONS_HPP

#include <roundel/detail/error.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A flag by which any thread may cancel or finish a call.
class CancelToken {
  public:
    explicit CancelToken(Status* status = nullptr) {
        roundel_cancel_token* made = nullptr;
        detail::check(roundel_cancel_token_new(&made), status);
        handle_.reset(made);
    }

    /// Asks every solve with this token to end, including solves that have not begun.
    void cancel(Status* status = nullptr) const {
        detail::check(roundel_cancel_token_cancel(get()), status);
    }

    /// Asks every call with this token to finish with the best integers so far: see finish.
    void finish(Status* status = nullptr) const {
        detail::check(roundel_cancel_token_finish(get()), status);
    }

    /// Withdraws the request, so that the token can be used again.
    void reset(Status* status = nullptr) const {
        detail::check(roundel_cancel_token_reset(get()), status);
    }

    bool is_cancelled(Status* status = nullptr) const {
        std::int32_t set = 0;
        detail::check(roundel_cancel_token_is_cancelled(get(), &set), status);
        return set != 0;
    }

    const roundel_cancel_token* get() const noexcept { return handle_.get(); }

  private:
    detail::Handle<roundel_cancel_token, roundel_cancel_token_free> handle_;
};

/// The return value of a callback.
enum class Flow : std::int32_t {
    go_on = ROUNDEL_FLOW_CONTINUE,
    stop = ROUNDEL_FLOW_CANCEL,
    finish = ROUNDEL_FLOW_FINISH,
};
/// Continue the solve.
inline constexpr Flow go_on = Flow::go_on;
/// End the solve; the best solution so far is kept.
inline constexpr Flow stop = Flow::stop;
/// Finish the call with the best integers so far, also a call of several solves such as
/// quadrangulate. Before a first solution this is stop.
inline constexpr Flow finish = Flow::finish;

/// The kinds of events.
enum class EventKind : std::int32_t {
    progress = ROUNDEL_EVENT_PROGRESS,
    log = ROUNDEL_EVENT_LOG,
    improved = ROUNDEL_EVENT_IMPROVED,
    raised = ROUNDEL_EVENT_RAISED,
};

/// The phases of a solve.
enum class Phase : std::int32_t {
    none = ROUNDEL_PHASE_NONE,
    eliminate = ROUNDEL_PHASE_ELIMINATE,
    factor = ROUNDEL_PHASE_FACTOR,
    round = ROUNDEL_PHASE_ROUND,
    untangle = ROUNDEL_PHASE_UNTANGLE,
    quads = ROUNDEL_PHASE_QUADS,
};

/// The stages of a call.
enum class Stage : std::int32_t {
    solve = ROUNDEL_STAGE_SOLVE,
    field = ROUNDEL_STAGE_FIELD,
    map = ROUNDEL_STAGE_MAP,
    quads = ROUNDEL_STAGE_QUADS,
    smooth = ROUNDEL_STAGE_SMOOTH,
};

/// The word for a stage, such as "field".
inline std::string_view name(Stage stage) {
    switch (stage) {
    case Stage::field:
        return "field";
    case Stage::map:
        return "map";
    case Stage::quads:
        return "quads";
    case Stage::smooth:
        return "smooth";
    case Stage::solve:
        break;
    }
    return "solve";
}

/// An event that the callback receives: the state of the solve.
struct Event {
    EventKind kind;
    /// For progress, the phase of the solve and how much of it is done, from 0 to 1.
    Phase phase;
    double fraction;
    /// For a log line, its text, which is valid during the callback.
    std::string_view text;
    /// Seconds since the solve began.
    double seconds;
    /// Energy of the best solution so far; infinite before the first.
    double energy;
    /// The best lower bound so far; minus infinity before the first.
    double lower_bound;
    /// (energy - lower_bound) / |energy|: 0 where they are equal, and infinite while either is
    /// infinite or an energy of 0 is above the bound.
    double gap;
    /// The share of the whole call that is done, from 0 to 1. It never falls.
    double share;
    /// The stage of the whole call.
    Stage stage;
};

/// Options of a solve. Options that are not set have the library's defaults.
struct Options {
    /// The name of a set of options, "orientation_field" or "parametrization". It is applied first.
    std::optional<std::string> preset = std::nullopt;
    // Table of options: members.
    /// The strategy that decides the integers. One of relax, direct, greedy, adaptive, multiple,
    /// lattice, exact, auto; auto by default.
    std::optional<std::string> strategy = std::nullopt;
    /// The seconds after which the best solution so far is returned. In [0, inf]; inf by default.
    std::optional<double> time_limit = std::nullopt;
    /// The largest number of threads; 0: one for each core. In [0, 1024]; 0 by default.
    std::optional<std::int64_t> threads = std::nullopt;
    /// Adaptive, multiple: integers are rounded together while the sum of their deviations is at
    /// most this. In [0, inf]; 0.5 by default.
    std::optional<double> rounding_threshold = std::nullopt;
    /// Adaptive: up to this many integers are decided exactly, one at a time. In [0, 2147483647];
    /// 1000 by default.
    std::optional<std::int64_t> exact_integers = std::nullopt;
    /// Adaptive, multiple: the number of Gauss-Seidel updates in a pass before conjugate gradients
    /// take over. In [0, 2147483647]; 100000 by default.
    std::optional<std::int64_t> gauss_seidel_updates = std::nullopt;
    /// Adaptive, multiple: Gauss-Seidel leaves an unknown that would move by less than this. In [0,
    /// inf]; 0.001 by default.
    std::optional<double> gauss_seidel_tolerance = std::nullopt;
    /// Adaptive, multiple: the number of conjugate-gradient iterations in a pass before a
    /// factorization takes over. In [0, 2147483647]; 50 by default.
    std::optional<std::int64_t> cg_iterations = std::nullopt;
    /// Adaptive: conjugate gradients end when every unknown is estimated to be closer than this to
    /// the minimum; multiple: when the residual is shorter than this. In [0, inf]; 0.001 by
    /// default.
    std::optional<double> cg_tolerance = std::nullopt;
    /// Adaptive, multiple: 1 if a pass may factor when conjugate gradients fail. In [0, 1]; 1 by
    /// default.
    std::optional<bool> exact_steps = std::nullopt;
    /// Earlier integers: ignored, offered before the search begins, or kept as they are. One of
    /// off, offer, keep; off by default.
    std::optional<std::string> warm_start = std::nullopt;
    /// The order of eliminations and factorizations; largest_pivot solves constraints for their
    /// largest coefficient (Bommes' thesis), natural keeps the given order, for comparison. One of
    /// fill_reducing, natural, largest_pivot; fill_reducing by default.
    std::optional<std::string> ordering = std::nullopt;
    /// Lattice, exact, auto: up to this many integers are decided in a dense lattice. In [0,
    /// 20000]; 1000 by default.
    std::optional<std::int64_t> dense_integers = std::nullopt;
    /// Lattice, exact, auto: the number of partial solutions that the beam of nearest plane keeps.
    /// In [1, 1000000]; 256 by default.
    std::optional<std::int64_t> beam_width = std::nullopt;
    /// Lattice, exact, auto: the number of perturbation rounds after the blocks. In [0,
    /// 2147483647]; 1 by default.
    std::optional<std::int64_t> lattice_rounds = std::nullopt;
    /// Exact, auto: the number of nodes that the proof may visit. In [0, 9007199254740992];
    /// 10000000000 by default.
    std::optional<std::int64_t> nodes = std::nullopt;
    /// Exact, auto: the relative gap that ends the proof. In [0, inf]; 0 by default.
    std::optional<double> gap = std::nullopt;
    // End of the table.
    /// Called for every event, on the thread that called solve. What it throws ends the solve and
    /// is thrown again by solve.
    std::function<Flow(const Event&)> on_event = nullptr;
    /// A token that ends the solve when it is set.
    const CancelToken* cancel = nullptr;
    /// Further options by name, applied after those above.
    std::vector<std::pair<std::string, std::variant<std::int64_t, double, std::string>>> more = {};

    Options& set_preset(std::string value) {
        preset = std::move(value);
        return *this;
    }
    // Table of options: setters.
    Options& set_strategy(std::string value) {
        strategy = std::move(value);
        return *this;
    }
    Options& set_time_limit(double value) {
        time_limit = value;
        return *this;
    }
    Options& set_threads(std::int64_t value) {
        threads = value;
        return *this;
    }
    Options& set_rounding_threshold(double value) {
        rounding_threshold = value;
        return *this;
    }
    Options& set_exact_integers(std::int64_t value) {
        exact_integers = value;
        return *this;
    }
    Options& set_gauss_seidel_updates(std::int64_t value) {
        gauss_seidel_updates = value;
        return *this;
    }
    Options& set_gauss_seidel_tolerance(double value) {
        gauss_seidel_tolerance = value;
        return *this;
    }
    Options& set_cg_iterations(std::int64_t value) {
        cg_iterations = value;
        return *this;
    }
    Options& set_cg_tolerance(double value) {
        cg_tolerance = value;
        return *this;
    }
    Options& set_exact_steps(bool value) {
        exact_steps = value;
        return *this;
    }
    Options& set_warm_start(std::string value) {
        warm_start = std::move(value);
        return *this;
    }
    Options& set_ordering(std::string value) {
        ordering = std::move(value);
        return *this;
    }
    Options& set_dense_integers(std::int64_t value) {
        dense_integers = value;
        return *this;
    }
    Options& set_beam_width(std::int64_t value) {
        beam_width = value;
        return *this;
    }
    Options& set_lattice_rounds(std::int64_t value) {
        lattice_rounds = value;
        return *this;
    }
    Options& set_nodes(std::int64_t value) {
        nodes = value;
        return *this;
    }
    Options& set_gap(double value) {
        gap = value;
        return *this;
    }
    // End of the table.
    Options& set_on_event(std::function<Flow(const Event&)> value) {
        on_event = std::move(value);
        return *this;
    }
    Options& set_cancel(const CancelToken& token) {
        cancel = &token;
        return *this;
    }
    /// Sets any option by its name. roundel_option_info lists the names.
    Options& set(std::string name, std::variant<std::int64_t, double, std::string> value) {
        more.emplace_back(std::move(name), std::move(value));
        return *this;
    }
};

namespace detail {

/// What sets an option by name, by the type of its value.
template <class Int, class Real, class Text>
auto by_name(Int set_int, Real set_real, Text set_text) {
    return [=](auto* to, const char* name, const auto& value) -> roundel_status {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_integral_v<Value>) {
            return set_int(to, name, static_cast<std::int64_t>(value));
        } else if constexpr (std::is_floating_point_v<Value>) {
            return set_real(to, name, value);
        } else {
            return set_text(to, name, value.c_str());
        }
    };
}

// Table of options: lists.
template <class Tell> bool each_option(const Options& options, const Tell& tell) {
    if (options.strategy && !tell("strategy", *options.strategy)) {
        return false;
    }
    if (options.time_limit && !tell("time_limit", *options.time_limit)) {
        return false;
    }
    if (options.threads && !tell("threads", *options.threads)) {
        return false;
    }
    if (options.rounding_threshold && !tell("rounding_threshold", *options.rounding_threshold)) {
        return false;
    }
    if (options.exact_integers && !tell("exact_integers", *options.exact_integers)) {
        return false;
    }
    if (options.gauss_seidel_updates &&
        !tell("gauss_seidel_updates", *options.gauss_seidel_updates)) {
        return false;
    }
    if (options.gauss_seidel_tolerance &&
        !tell("gauss_seidel_tolerance", *options.gauss_seidel_tolerance)) {
        return false;
    }
    if (options.cg_iterations && !tell("cg_iterations", *options.cg_iterations)) {
        return false;
    }
    if (options.cg_tolerance && !tell("cg_tolerance", *options.cg_tolerance)) {
        return false;
    }
    if (options.exact_steps && !tell("exact_steps", *options.exact_steps)) {
        return false;
    }
    if (options.warm_start && !tell("warm_start", *options.warm_start)) {
        return false;
    }
    if (options.ordering && !tell("ordering", *options.ordering)) {
        return false;
    }
    if (options.dense_integers && !tell("dense_integers", *options.dense_integers)) {
        return false;
    }
    if (options.beam_width && !tell("beam_width", *options.beam_width)) {
        return false;
    }
    if (options.lattice_rounds && !tell("lattice_rounds", *options.lattice_rounds)) {
        return false;
    }
    if (options.nodes && !tell("nodes", *options.nodes)) {
        return false;
    }
    if (options.gap && !tell("gap", *options.gap)) {
        return false;
    }
    return true;
}
// End of the table.

} // namespace detail

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_OPTIONS_HPP
