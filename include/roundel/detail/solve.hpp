/// Solves a problem in one call.

#ifndef ROUNDEL_DETAIL_SOLVE_HPP
#define ROUNDEL_DETAIL_SOLVE_HPP

#include <roundel/detail/options.hpp>
#include <roundel/detail/problem.hpp>
#include <roundel/detail/solution.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <variant>

ROUNDEL_NAMESPACE_BEGIN

namespace detail {

/// Passes events to a std::function, and carries its exceptions past the C frames in between.
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
                         event->gap,
                         event->share,
                         static_cast<Stage>(event->stage)};
#if ROUNDEL_HPP_EXCEPTIONS
        try {
            return static_cast<std::int32_t>(self.on_event(view));
        } catch (...) {
            // A solve that was told to stop may still send events. Keep the first exception.
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

using OptionsHandle = Handle<roundel_options, roundel_options_free>;

/// The C interface's options for `options`; empty after a failure.
inline OptionsHandle handle_for(const Options& options, Status* status) {
    roundel_options* made = nullptr;
    if (!check(roundel_options_new(&made), status)) {
        return nullptr;
    }
    OptionsHandle handle(made);
    if (options.preset &&
        !check(roundel_options_set_preset(made, options.preset->c_str()), status)) {
        return nullptr;
    }
    const auto set =
        by_name(roundel_options_set_int, roundel_options_set_real, roundel_options_set_text);
    const auto tell = [&](const char* name, const auto& value) {
        return check(set(made, name, value), status);
    };
    if (!each_option(options, tell)) {
        return nullptr;
    }
    for (const auto& [name, value] : options.more) {
        const auto code =
            std::visit([&, key = name.c_str()](const auto& v) { return set(made, key, v); }, value);
        if (!check(code, status)) {
            return nullptr;
        }
    }
    return handle;
}

/// Calls `call` with the C interface's options and monitor for `options`. Returns whether it
/// succeeded. An exception of the callback is thrown again.
template <class Call>
bool watched(const Options& options, const Call& call, std::size_t variables, Status* status) {
    const auto handle = handle_for(options, status);
    if (!handle) {
        return false;
    }
    Watcher watcher{options.on_event};
    roundel_monitor monitor{};
    monitor.size = sizeof monitor;
    if (options.on_event) {
        monitor.callback = Watcher::callback;
        monitor.user_data = &watcher;
    }
    monitor.cancel_token = options.cancel ? options.cancel->get() : nullptr;
    const roundel_status code = call(handle.get(), &monitor);
#if ROUNDEL_HPP_EXCEPTIONS
    if (watcher.thrown) {
        std::rethrow_exception(watcher.thrown);
    }
#endif
    return check(code, status, variables);
}

} // namespace detail

namespace detail {

/// The solution that `call` returns through its last parameter; empty after a failure.
template <class Call>
Solution solution_of(const Options& options, const Call& call, std::size_t variables,
                     Status* status) {
    Handle<roundel_solution, roundel_solution_free> found;
    const auto keep = [&](const roundel_options* how, const roundel_monitor* monitor) {
        roundel_solution* made = nullptr;
        const auto code = call(how, monitor, &made);
        found.reset(made);
        return code;
    };
    if (!watched(options, keep, variables, status)) {
        return {};
    }
    return Solution(found.release(), status);
}

} // namespace detail

/// Solves a problem. It may be solved again, unchanged or after changes.
inline Solution solve(const Problem& problem, const Options& options = {},
                      Status* status = nullptr) {
    // The length of the direction that some failures contain; 0 for a problem that was moved away.
    std::size_t variables = 0;
    if (problem.get()) {
        roundel_problem_variable_count(problem.get(), &variables);
    }
    const auto call = [&](const roundel_options* how, const roundel_monitor* monitor,
                          roundel_solution** made) {
        return roundel_problem_solve(problem.get(), how, monitor, made);
    };
    return detail::solution_of(options, call, variables, status);
}

/// Writes a problem and its options, so that the solve can be repeated elsewhere: `file`, which
/// ends in ".mps" or ".mps.gz", and beside it a file that ends in ".replay.json".
inline void save_replay(const Problem& problem, const Options& options, const std::string& file,
                        Status* status = nullptr) {
    if (const auto handle = detail::handle_for(options, status)) {
        detail::check(roundel_problem_save_replay(problem.get(), handle.get(), file.c_str()),
                      status);
    }
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_SOLVE_HPP
