/// Roundel for C++17 and later: a header-only layer over the C interface.
///
///     roundel::Problem problem(3);
///     problem.least_squares({0, 1}, {1.0, -1.0}, 0.4);   // (x0 - x1 - 0.4)^2
///     problem.constrain({0, 2}, {1.0, -1.0}, 0.0);       // x0 = x2
///     problem.integer({1});
///     auto solution = roundel::solve(problem, {.strategy = "greedy"});   // C++20
///     for (double x : solution.values()) ...
///
/// In C++17: `roundel::Options options; options.set_strategy("greedy");`.
///
/// Errors. A call that fails throws roundel::Error, which names the element at fault. Every call
/// also takes a `Status*` as its last argument; given one, it throws nothing and reports there
/// instead. Built with exceptions turned off, a failure without a Status ends the program.
///
/// Problem, Solution and CancelToken own their C objects, move and do not copy. A const object may
/// be used from several threads at once, any other from one.

#ifndef ROUNDEL_HPP
#define ROUNDEL_HPP

#include <roundel/roundel.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#if defined(__has_include)
#if __has_include(<version>)
#include <version>
#endif
#endif
#if defined(__cpp_lib_span)
#include <span>
#endif

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define ROUNDEL_HPP_EXCEPTIONS 1
#else
#define ROUNDEL_HPP_EXCEPTIONS 0
#endif

namespace roundel {

// The span in the signatures depends on the standard: units of both kinds may meet in a program.
#if defined(__cpp_lib_span)
inline namespace with_std_span {
template <class T> using span = std::span<T>;
#else
inline namespace with_own_span {

/// The part of std::span that this header needs, for C++17.
template <class T> class span {
  public:
    using element_type = T;
    using value_type = std::remove_cv_t<T>;
    using iterator = T*;

    constexpr span() noexcept = default;
    constexpr span(T* data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t N> constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    /// Any contiguous container of T.
    template <class C,
              class = std::enable_if_t<std::is_convertible_v<
                  std::remove_pointer_t<decltype(std::declval<C&>().data())> (*)[], T (*)[]>>>
    constexpr span(C&& container) noexcept : data_(container.data()), size_(container.size()) {}

    constexpr T* data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T* begin() const noexcept { return data_; }
    constexpr T* end() const noexcept { return data_ + size_; }
    constexpr T& operator[](std::size_t i) const noexcept { return data_[i]; }
    constexpr T& front() const noexcept { return data_[0]; }
    constexpr T& back() const noexcept { return data_[size_ - 1]; }

  private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};
#endif

/// How a call went, for callers that do not want exceptions.
struct Status {
    roundel_status code = ROUNDEL_OK;
    /// Names the element at fault.
    std::string message{};
    /// The element at fault, from 0; -1 if there is none.
    std::int64_t index = -1;
    /// The line of the file at fault, from 1; -1 if there is none.
    std::int64_t line = -1;
    /// For an unbounded or non-convex problem, the direction that proves it.
    std::vector<double> direction{};

    explicit operator bool() const noexcept { return code == ROUNDEL_OK; }
};

/// What calls throw that were not given a Status.
class Error : public std::runtime_error {
  public:
    explicit Error(Status status)
        : std::runtime_error(status.message),
          status_(std::make_shared<const Status>(std::move(status))) {}

    roundel_status code() const noexcept { return status_->code; }
    std::int64_t index() const noexcept { return status_->index; }
    std::int64_t line() const noexcept { return status_->line; }
    const std::vector<double>& direction() const noexcept { return status_->direction; }

  private:
    // Shared, because copying an exception must not throw.
    std::shared_ptr<const Status> status_;
};

namespace detail {

/// Reports a failure to the caller's Status, or throws.
inline void fail(Status&& failure, Status* status) {
    if (status) {
        *status = std::move(failure);
        return;
    }
#if ROUNDEL_HPP_EXCEPTIONS
    throw Error(std::move(failure));
#else
    std::terminate();
#endif
}

/// Whether a call went well; if not, its failure is reported. `variables` is the length of the
/// direction that the failure may come with.
inline bool check(roundel_status code, Status* status, std::size_t variables = 0) {
    if (code == ROUNDEL_OK) {
        if (status) {
            *status = Status{};
        }
        return true;
    }
    Status failure;
    failure.code = code;
    failure.index = roundel_last_error_index();
    failure.line = roundel_last_error_line();
    failure.message.resize(roundel_last_error_message(nullptr, 0));
    roundel_last_error_message(failure.message.data(), failure.message.size() + 1);
    if (code == ROUNDEL_ERROR_UNBOUNDED || code == ROUNDEL_ERROR_NOT_CONVEX) {
        failure.direction.resize(variables);
        if (roundel_last_error_direction(failure.direction.data(), variables) != ROUNDEL_OK) {
            failure.direction.clear();
        }
    }
    fail(std::move(failure), status);
    return false;
}

/// Whether two arrays that belong together have the same length, which C takes only once.
inline bool same_length(std::size_t one, std::size_t other, Status* status) {
    if (one == other) {
        return true;
    }
    Status failure;
    failure.code = ROUNDEL_ERROR_LENGTH_MISMATCH;
    failure.message = "arrays that belong together have " + std::to_string(one) + " and " +
                      std::to_string(other) + " entries";
    fail(std::move(failure), status);
    return false;
}

template <auto free> struct Free {
    template <class T> void operator()(T* object) const noexcept { free(object); }
};
template <class T, auto free> using Handle = std::unique_ptr<T, Free<free>>;

} // namespace detail

/// Which entries of a symmetric matrix are given.
enum class Triangle : std::int32_t {
    /// Both triangles, which must agree.
    full = ROUNDEL_TRIANGLE_FULL,
    /// Only entries with row <= column, which stand for both.
    upper = ROUNDEL_TRIANGLE_UPPER,
    /// Only entries with row >= column, which stand for both.
    lower = ROUNDEL_TRIANGLE_LOWER,
};

/// Whether a compressed matrix is stored column by column (CSC) or row by row (CSR).
enum class Layout { columns, rows };

/// A compressed sparse matrix in the caller's arrays: column (or row) k has the entries from
/// offsets[k] to before offsets[k + 1]. Index is std::int32_t or std::int64_t.
template <class Index> struct Compressed {
    static_assert(std::is_same_v<Index, std::int32_t> || std::is_same_v<Index, std::int64_t>,
                  "indices are std::int32_t or std::int64_t");
    Layout layout;
    span<const Index> offsets;
    span<const Index> indices;
    span<const double> values;
};

/// A mixed-integer quadratic problem under construction: minimise
/// 1/2 x'Qx + q'x + c + sum_k w_k (a_k . x - r_k)^2 subject to C x = d, x_i integer for i in I.
///
/// Parts may be given in any order and any number of times: terms add up. A call that fails
/// changes nothing.
class Problem {
  public:
    using Indices = span<const std::int32_t>;
    using Numbers = span<const double>;

    /// A problem of `variables` unknowns with objective zero.
    explicit Problem(std::size_t variables, Status* status = nullptr) {
        roundel_problem* made = nullptr;
        detail::check(roundel_problem_new(variables, &made), status);
        handle_.reset(made);
    }

    /// Takes over a problem of the C interface.
    explicit Problem(roundel_problem* owned) noexcept : handle_(owned) {}

    /// A copy that lives on its own.
    Problem clone(Status* status = nullptr) const {
        roundel_problem* copy = nullptr;
        detail::check(roundel_problem_clone(get(), &copy), status);
        return Problem(copy);
    }

    std::size_t variables(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_problem_variables(get(), &count), status);
        return count;
    }

    /// Number of constraints so far, which is the number of the next one.
    std::size_t constraints(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_problem_constraints(get(), &count), status);
        return count;
    }

    /// Adds entries to Q, duplicates summed.
    void quadratic(Triangle triangle, Indices rows, Indices columns, Numbers values,
                   Status* status = nullptr) {
        add_triplets(roundel_problem_add_quadratic_triplets, triangle, rows, columns, values,
                     status);
    }

    /// As above with 64-bit indices.
    void quadratic(Triangle triangle, span<const std::int64_t> rows,
                   span<const std::int64_t> columns, Numbers values, Status* status = nullptr) {
        add_triplets(roundel_problem_add_quadratic_triplets_i64, triangle, rows, columns, values,
                     status);
    }

    /// Adds a compressed matrix to Q.
    template <class Index>
    void quadratic(const Compressed<Index>& matrix, Triangle triangle, Status* status = nullptr) {
        if (!detail::same_length(matrix.indices.size(), matrix.values.size(), status)) {
            return;
        }
        constexpr bool wide = std::is_same_v<Index, std::int64_t>;
        const auto add = [&](auto function) {
            return function(get(), static_cast<std::int32_t>(triangle), matrix.offsets.size(),
                            matrix.offsets.data(), matrix.indices.size(), matrix.indices.data(),
                            matrix.values.data());
        };
        const bool columns = matrix.layout == Layout::columns;
        roundel_status code;
        if constexpr (wide) {
            code = columns ? add(roundel_problem_add_quadratic_csc_i64)
                           : add(roundel_problem_add_quadratic_csr_i64);
        } else {
            code = columns ? add(roundel_problem_add_quadratic_csc)
                           : add(roundel_problem_add_quadratic_csr);
        }
        detail::check(code, status);
    }

    /// Adds to the linear term, one number a variable.
    void linear(Numbers values, Status* status = nullptr) {
        detail::check(roundel_problem_add_linear(get(), values.data(), values.size()), status);
    }

    /// Adds to the linear term of one variable.
    void linear(std::int64_t variable, double coefficient, Status* status = nullptr) {
        detail::check(roundel_problem_add_linear_term(get(), variable, coefficient), status);
    }

    /// Adds a constant to the objective.
    void constant(double value, Status* status = nullptr) {
        detail::check(roundel_problem_add_constant(get(), value), status);
    }

    /// Adds weight (sum_k coefficients[k] x[indices[k]] - rhs)^2 to the objective, without a factor
    /// of 1/2, and returns the row's number.
    std::size_t least_squares(Indices indices, Numbers coefficients, double rhs = 0.0,
                              double weight = 1.0, Status* status = nullptr) {
        std::size_t row = 0;
        if (detail::same_length(indices.size(), coefficients.size(), status)) {
            detail::check(roundel_problem_add_least_squares(get(), indices.size(), indices.data(),
                                                            coefficients.data(), rhs, weight, &row),
                          status);
        }
        return row;
    }

    std::size_t least_squares(std::initializer_list<std::int32_t> indices,
                              std::initializer_list<double> coefficients, double rhs = 0.0,
                              double weight = 1.0, Status* status = nullptr) {
        return least_squares(Indices(indices.begin(), indices.size()),
                             Numbers(coefficients.begin(), coefficients.size()), rhs, weight,
                             status);
    }

    /// Adds the constraint sum_k coefficients[k] x[indices[k]] = rhs.
    void constrain(Indices indices, Numbers coefficients, double rhs, Status* status = nullptr) {
        if (detail::same_length(indices.size(), coefficients.size(), status)) {
            detail::check(roundel_problem_add_constraint(get(), indices.size(), indices.data(),
                                                         coefficients.data(), rhs),
                          status);
        }
    }

    void constrain(std::initializer_list<std::int32_t> indices,
                   std::initializer_list<double> coefficients, double rhs,
                   Status* status = nullptr) {
        constrain(Indices(indices.begin(), indices.size()),
                  Numbers(coefficients.begin(), coefficients.size()), rhs, status);
    }

    /// Adds the constraints C x = rhs, one a row of the matrix, and returns the first one's number.
    template <class Index>
    std::size_t constrain(const Compressed<Index>& matrix, Numbers rhs, Status* status = nullptr) {
        std::size_t first = 0;
        if (!detail::same_length(matrix.indices.size(), matrix.values.size(), status)) {
            return first;
        }
        constexpr bool wide = std::is_same_v<Index, std::int64_t>;
        const auto add = [&](auto function) {
            return function(get(), matrix.offsets.size(), matrix.offsets.data(),
                            matrix.indices.size(), matrix.indices.data(), matrix.values.data(),
                            rhs.size(), rhs.data(), &first);
        };
        const bool columns = matrix.layout == Layout::columns;
        roundel_status code;
        if constexpr (wide) {
            code = columns ? add(roundel_problem_add_constraints_csc_i64)
                           : add(roundel_problem_add_constraints_csr_i64);
        } else {
            code = columns ? add(roundel_problem_add_constraints_csc)
                           : add(roundel_problem_add_constraints_csr);
        }
        detail::check(code, status);
        return first;
    }

    /// Makes variables integer.
    void integer(Indices variables, Status* status = nullptr) {
        detail::check(roundel_problem_set_integers(get(), variables.size(), variables.data()),
                      status);
    }

    void integer(std::initializer_list<std::int32_t> variables, Status* status = nullptr) {
        integer(Indices(variables.begin(), variables.size()), status);
    }

    /// Fixes one variable to a value.
    void pin(std::int64_t variable, double value, Status* status = nullptr) {
        detail::check(roundel_problem_pin(get(), variable, value), status);
    }

    /// Frees a pinned variable again.
    void unpin(std::int64_t variable, Status* status = nullptr) {
        detail::check(roundel_problem_unpin(get(), variable), status);
    }

    /// Sets the point that variables keep to where the objective does not decide them.
    void guess(Numbers values, Status* status = nullptr) {
        detail::check(roundel_problem_set_guess(get(), values.data(), values.size()), status);
    }

    /// The object of the C interface; nullptr after a move.
    roundel_problem* get() noexcept { return handle_.get(); }
    const roundel_problem* get() const noexcept { return handle_.get(); }

  private:
    template <class Function, class Index>
    void add_triplets(Function function, Triangle triangle, span<const Index> rows,
                      span<const Index> columns, Numbers values, Status* status) {
        if (detail::same_length(rows.size(), columns.size(), status) &&
            detail::same_length(rows.size(), values.size(), status)) {
            detail::check(function(get(), static_cast<std::int32_t>(triangle), rows.size(),
                                   rows.data(), columns.data(), values.data()),
                          status);
        }
    }

    detail::Handle<roundel_problem, roundel_problem_free> handle_;
};

/// A flag by which any thread may cancel a solve.
class CancelToken {
  public:
    explicit CancelToken(Status* status = nullptr) {
        roundel_cancel_token* made = nullptr;
        detail::check(roundel_cancel_token_new(&made), status);
        handle_.reset(made);
    }

    /// Asks every solve that holds this token to end, those yet to begin included.
    void cancel(Status* status = nullptr) const {
        detail::check(roundel_cancel_token_cancel(get()), status);
    }

    /// Takes the request back, so that the token can be used again.
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

/// What a callback answers.
enum class Flow : std::int32_t { go_on = 0, stop = 1 };
/// Go on.
inline constexpr Flow go_on = Flow::go_on;
/// End the solve; the best solution so far is kept.
inline constexpr Flow stop = Flow::stop;

/// What an event tells.
enum class EventKind : std::int32_t {
    progress = ROUNDEL_EVENT_PROGRESS,
    log = ROUNDEL_EVENT_LOG,
    improved = ROUNDEL_EVENT_IMPROVED,
};

/// A part of the solve.
enum class Phase : std::int32_t {
    none = ROUNDEL_PHASE_NONE,
    eliminate = ROUNDEL_PHASE_ELIMINATE,
    factor = ROUNDEL_PHASE_FACTOR,
    round = ROUNDEL_PHASE_ROUND,
};

/// One message to the callback, with where the solve stands.
struct Event {
    EventKind kind;
    /// For progress, the part of the solve and how much of it is done, from 0 to 1.
    Phase phase;
    double fraction;
    /// For a log line, its text, which lives as long as the callback runs.
    std::string_view text;
    /// Seconds since the solve began.
    double seconds;
    /// Energy of the best solution so far; infinite before the first.
    double energy;
    /// The best lower bound so far; minus infinity before the first.
    double lower_bound;
    /// (energy - lower_bound) / max(1, |energy|), infinite while either is.
    double gap;
};

/// How to solve. What is not set has the library's default.
struct Options {
    /// How integers are decided: "relax", "direct", "greedy".
    std::optional<std::string> strategy = std::nullopt;
    /// Seconds after which the best solution so far is returned.
    std::optional<double> time_limit = std::nullopt;
    /// Threads that may be used at most; 0 means as many as there are cores.
    std::optional<std::int64_t> threads = std::nullopt;
    /// Called for every event, on the thread that called solve. What it throws ends the solve and
    /// is thrown again by solve.
    std::function<Flow(const Event&)> on_event = nullptr;
    /// Ends the solve when it is set.
    const CancelToken* cancel = nullptr;
    /// Any option by its name, after those above.
    std::vector<std::pair<std::string, std::variant<std::int64_t, double, std::string>>> more = {};

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
    Options& set_on_event(std::function<Flow(const Event&)> value) {
        on_event = std::move(value);
        return *this;
    }
    Options& set_cancel(const CancelToken& token) {
        cancel = &token;
        return *this;
    }
    /// Sets any option by its name, as roundel_option_info lists them.
    Options& set(std::string name, std::variant<std::int64_t, double, std::string> value) {
        more.emplace_back(std::move(name), std::move(value));
        return *this;
    }
};

/// How a solve ended.
enum class SolveStatus : std::int32_t {
    optimal = ROUNDEL_SOLVE_OPTIMAL,
    feasible = ROUNDEL_SOLVE_FEASIBLE,
    limit = ROUNDEL_SOLVE_LIMIT,
    cancelled = ROUNDEL_SOLVE_CANCELLED,
    relaxed = ROUNDEL_SOLVE_RELAXED,
};

/// The word for how a solve ended.
inline const char* name(SolveStatus status) noexcept {
    return roundel_solve_status_name(static_cast<std::int32_t>(status));
}

/// The largest violations of a solution.
struct Violations {
    double constraint = 0.0;
    double integrality = 0.0;
};

/// A solution: values, what they cost, and how far from the best they can be.
class Solution {
  public:
    /// None: what solve returns when it reports a failure to a Status.
    Solution() noexcept = default;

    /// Takes over a solution of the C interface.
    explicit Solution(roundel_solution* owned, Status* status = nullptr) : handle_(owned) {
        std::size_t variables = 0;
        if (detail::check(roundel_solution_variables(get(), &variables), status)) {
            values_.resize(variables);
            detail::check(roundel_solution_values(get(), values_.data(), variables), status);
        }
    }

    /// Whether there is one.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// One value a variable, as long as the solution lives.
    span<const double> values() const& noexcept { return {values_.data(), values_.size()}; }
    span<const double> values() const&& = delete;

    /// The objective, in the caller's units.
    double energy(Status* status = nullptr) const {
        double value = 0.0;
        detail::check(roundel_solution_energy(get(), &value), status);
        return value;
    }

    /// No integer solution has less energy than this.
    std::optional<double> lower_bound(Status* status = nullptr) const {
        return maybe(roundel_solution_lower_bound, status);
    }

    /// (energy - lower_bound) / max(1, |energy|), where there is a bound.
    std::optional<double> gap(Status* status = nullptr) const {
        return maybe(roundel_solution_gap, status);
    }

    /// How the solve ended.
    SolveStatus status(Status* status = nullptr) const {
        auto value = ROUNDEL_SOLVE_FEASIBLE;
        detail::check(roundel_solution_status(get(), &value), status);
        return static_cast<SolveStatus>(value);
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

namespace detail {

/// Carries events to a std::function, and what it throws around the C frames in between.
struct Watcher {
    const std::function<Flow(const Event&)>& on_event;
    std::exception_ptr thrown = nullptr;

    static std::int32_t callback(const roundel_event* event, void* user_data) noexcept {
        auto& self = *static_cast<Watcher*>(user_data);
        const Event view{static_cast<EventKind>(event->kind),
                         static_cast<Phase>(event->phase),
                         event->fraction,
                         event->text,
                         event->seconds,
                         event->energy,
                         event->lower_bound,
                         event->gap};
#if ROUNDEL_HPP_EXCEPTIONS
        try {
            return static_cast<std::int32_t>(self.on_event(view));
        } catch (...) {
            // A solve that has been told to stop may still send an event: keep the first.
            if (!self.thrown) {
                self.thrown = std::current_exception();
            }
            return static_cast<std::int32_t>(stop);
        }
#else
        return static_cast<std::int32_t>(self.on_event(view));
#endif
    }
};

inline roundel_status set(roundel_options* options, const char* name, const std::string& value) {
    return roundel_options_set_text(options, name, value.c_str());
}
inline roundel_status set(roundel_options* options, const char* name, double value) {
    return roundel_options_set_real(options, name, value);
}
inline roundel_status set(roundel_options* options, const char* name, std::int64_t value) {
    return roundel_options_set_int(options, name, value);
}

/// The C interface's options for `options`.
inline bool apply(const Options& options, roundel_options* handle, Status* status) {
    const auto one = [&](const char* name, const auto& value) {
        return !value || check(set(handle, name, *value), status);
    };
    if (!one("strategy", options.strategy) || !one("time_limit", options.time_limit) ||
        !one("threads", options.threads)) {
        return false;
    }
    for (const auto& [name, value] : options.more) {
        const auto code = std::visit(
            [&, key = name.c_str()](const auto& v) { return set(handle, key, v); }, value);
        if (!check(code, status)) {
            return false;
        }
    }
    return true;
}

} // namespace detail

/// Solves a problem. It may be solved again, as it is or after changes.
inline Solution solve(const Problem& problem, const Options& options = {},
                      Status* status = nullptr) {
    roundel_options* made = nullptr;
    if (!detail::check(roundel_options_new(&made), status)) {
        return {};
    }
    const detail::Handle<roundel_options, roundel_options_free> handle(made);
    if (!detail::apply(options, handle.get(), status)) {
        return {};
    }
    detail::Watcher watcher{options.on_event};
    roundel_monitor monitor{};
    monitor.size = sizeof monitor;
    if (options.on_event) {
        monitor.callback = detail::Watcher::callback;
        monitor.user_data = &watcher;
    }
    monitor.cancel_token = options.cancel ? options.cancel->get() : nullptr;
    roundel_solution* found = nullptr;
    const auto code = roundel_solve_with(problem.get(), handle.get(), &monitor, &found);
    detail::Handle<roundel_solution, roundel_solution_free> owned(found);
#if ROUNDEL_HPP_EXCEPTIONS
    if (watcher.thrown) {
        std::rethrow_exception(watcher.thrown);
    }
#endif
    std::size_t variables = 0;
    if (code != ROUNDEL_OK && problem.get()) {
        roundel_problem_variables(problem.get(), &variables);
    }
    if (!detail::check(code, status, variables)) {
        return {};
    }
    return Solution(owned.release(), status);
}

} // inline namespace
} // namespace roundel

#endif // ROUNDEL_HPP
