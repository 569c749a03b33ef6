/// A stop watch that counts milliseconds.

#ifndef COMISO_UTILS_STOPWATCH_HH
#define COMISO_UTILS_STOPWATCH_HH

#include <CoMISo/Config/CoMISoDefines.hh>

#include <chrono>

namespace COMISO {

class COMISODLLEXPORT StopWatch {
  public:
    /// Starts the measurement.
    void start() {
        start_ = Clock::now();
        running_ = true;
    }

    /// Returns the milliseconds since the start and starts again.
    double restart() {
        const double milliseconds = elapsed();
        start();
        return milliseconds;
    }

    /// Stops, and returns the milliseconds since the start.
    double stop() {
        end_ = Clock::now();
        running_ = false;
        return elapsed();
    }

    /// Milliseconds from the start to the stop, or to now while it runs.
    double elapsed() const {
        const Clock::time_point end = running_ ? Clock::now() : end_;
        return std::chrono::duration<double, std::milli>(end - start_).count();
    }

  private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point start_{};
    Clock::time_point end_{};
    bool running_ = false;
};

} // namespace COMISO

#endif // COMISO_UTILS_STOPWATCH_HH
