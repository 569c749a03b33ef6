/// What the original does not have: a choice of strategy for programs that are not changed, and a
/// place for what would otherwise be printed.

#ifndef COMISO_ROUNDEL_SETTINGS_HH
#define COMISO_ROUNDEL_SETTINGS_HH

#include <cstdlib>
#include <functional>
#include <string>
#include <utility>

namespace COMISO {

namespace roundel_detail {

/// Settings of the whole program, to be made before solves run in several threads.
struct Program {
    std::string strategy;
    std::function<void(const std::string&)> log;
};

inline Program& program() {
    static Program settings;
    return settings;
}

inline void log(const std::string& line) {
    if (program().log) {
        program().log(line);
    }
}

/// The strategy that stands for the rounding that was asked for: that of the solver, else that of
/// the program, else that of the environment, else none.
inline std::string strategy_for(const std::string& of_solver) {
    if (!of_solver.empty()) {
        return of_solver;
    }
    if (!program().strategy.empty()) {
        return program().strategy;
    }
    const char* word = std::getenv("ROUNDEL_COMISO_STRATEGY");
    return word ? word : "";
}

} // namespace roundel_detail

/// Chooses how all solvers of the program round, in place of what they are told by their own
/// setters: "auto" for better energies, or any other of Roundel's strategies. Empty takes it back.
/// Comes before the environment variable ROUNDEL_COMISO_STRATEGY.
inline void set_roundel_strategy(std::string strategy) {
    roundel_detail::program().strategy = std::move(strategy);
}

/// Where lines go about timings, and about what was asked for and is done otherwise. Nothing is
/// printed without.
inline void set_roundel_log(std::function<void(const std::string&)> log) {
    roundel_detail::program().log = std::move(log);
}

} // namespace COMISO

#endif // COMISO_ROUNDEL_SETTINGS_HH
