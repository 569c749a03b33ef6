/// Failures: they are thrown, or reported in a Status.

#ifndef ROUNDEL_DETAIL_ERROR_HPP
#define ROUNDEL_DETAIL_ERROR_HPP

#include <roundel/detail/span.hpp>
#include <roundel/roundel.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define ROUNDEL_HPP_EXCEPTIONS 1
#else
#define ROUNDEL_HPP_EXCEPTIONS 0
#endif

ROUNDEL_NAMESPACE_BEGIN

/// The outcome of a call, for callers that do not want exceptions.
struct Status {
    roundel_status code = ROUNDEL_OK;
    /// A message that names the element at fault.
    std::string message{};
    /// The element at fault, from 0; -1 if there is none.
    std::int64_t index = -1;
    /// The line of the file at fault, from 1; -1 if there is none.
    std::int64_t line = -1;
    /// For an unbounded or non-convex problem, the direction that proves it.
    std::vector<double> direction{};

    explicit operator bool() const noexcept { return code == ROUNDEL_OK; }
};

/// The exception of calls without a Status.
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

/// Stores a failure in the caller's Status, or throws it.
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

/// Whether a call succeeded. A failure is reported. `variables` is the length of the direction that
/// the failure may contain.
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

/// Whether two arrays that belong together have the same length, because C takes only one length.
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

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_ERROR_HPP
