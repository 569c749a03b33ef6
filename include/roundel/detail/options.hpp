/// Options of a solve, events of its callback, and the token that cancels it.

#ifndef ROUNDEL_DETAIL_OPTIONS_HPP
#define ROUNDEL_DETAIL_OPTIONS_HPP

#include <roundel/detail/error.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A flag by which any thread may cancel a solve.
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
enum class Flow : std::int32_t { go_on = 0, stop = 1 };
/// Continue the solve.
inline constexpr Flow go_on = Flow::go_on;
/// End the solve; the best solution so far is kept.
inline constexpr Flow stop = Flow::stop;

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
    /// (energy - lower_bound) / max(1, |energy|); infinite while either is infinite.
    double gap;
};

/// Options of a solve. Options that are not set have the library's defaults.
struct Options {
    /// The name of a set of options, "orientation_field" or "parametrization". It is applied first.
    std::optional<std::string> preset = std::nullopt;
    /// How integers are decided: "relax", "direct", "greedy", "adaptive",
    /// "multiple", "lattice", "exact", "auto".
    std::optional<std::string> strategy = std::nullopt;
    /// Seconds after which the best solution so far is returned.
    std::optional<double> time_limit = std::nullopt;
    /// The largest number of threads; 0 for as many as there are cores.
    std::optional<std::int64_t> threads = std::nullopt;
    /// adaptive, multiple: integers are rounded together while the sum of their deviations is at
    /// most this.
    std::optional<double> rounding_threshold = std::nullopt;
    /// adaptive: up to this many integers are decided exactly, one at a time.
    std::optional<std::int64_t> exact_integers = std::nullopt;
    /// adaptive, multiple: Gauss-Seidel updates in a pass before conjugate gradients take over.
    std::optional<std::int64_t> gauss_seidel_updates = std::nullopt;
    /// adaptive, multiple: Gauss-Seidel does not update an unknown that would change by less.
    std::optional<double> gauss_seidel_tolerance = std::nullopt;
    /// adaptive, multiple: conjugate-gradient iterations in a pass before a factorization takes
    /// over.
    std::optional<std::int64_t> cg_iterations = std::nullopt;
    /// The tolerance of conjugate gradients. adaptive: the distance of every unknown from the
    /// minimum; multiple: the length of the residual.
    std::optional<double> cg_tolerance = std::nullopt;
    /// adaptive, multiple: 1 if a pass may factorize when conjugate gradients fail.
    std::optional<std::int64_t> exact_steps = std::nullopt;
    /// The use of earlier integers: "off", "offer" (before the search begins) or "keep" (no
    /// search).
    std::optional<std::string> warm_start = std::nullopt;
    /// The elimination order: "fill_reducing", "largest_pivot" (as in Bommes' thesis), or
    /// "natural", for comparison only.
    std::optional<std::string> ordering = std::nullopt;
    /// lattice, exact, auto: up to this many integers are decided in a dense lattice.
    std::optional<std::int64_t> dense_integers = std::nullopt;
    /// lattice, exact, auto: the number of partial solutions that nearest plane keeps.
    std::optional<std::int64_t> beam_width = std::nullopt;
    /// lattice, exact, auto: perturbation rounds after the blocks.
    std::optional<std::int64_t> lattice_rounds = std::nullopt;
    /// exact, auto: the number of nodes that the proof may visit.
    std::optional<std::int64_t> nodes = std::nullopt;
    /// exact, auto: the relative gap at which the proof stops.
    std::optional<double> gap = std::nullopt;
    /// Called for every event, on the thread that called solve. An exception from it ends the
    /// solve, and solve throws it again.
    std::function<Flow(const Event&)> on_event = nullptr;
    /// A token that ends the solve when it is set.
    const CancelToken* cancel = nullptr;
    /// Further options by name, applied after those above.
    std::vector<std::pair<std::string, std::variant<std::int64_t, double, std::string>>> more = {};

    Options& set_preset(std::string value) {
        preset = std::move(value);
        return *this;
    }
    Options& set_strategy(std::string value) {
        strategy = std::move(value);
        return *this;
    }
    Options& set_time_limit(double seconds) {
        time_limit = seconds;
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
    Options& set_exact_steps(std::int64_t value) {
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

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_OPTIONS_HPP
