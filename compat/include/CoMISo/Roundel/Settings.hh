/// Settings that CoMISo does not have: a strategy for programs that are not rewritten, and a log
/// for messages that would otherwise be printed.

#ifndef COMISO_ROUNDEL_SETTINGS_HH
#define COMISO_ROUNDEL_SETTINGS_HH

#include <cstdlib>
#include <functional>
#include <string>
#include <utility>

namespace COMISO {

namespace roundel_detail {

/// Settings of the whole program. Set them before several threads solve.
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

/// The strategy that replaces the kind of rounding: that of the solver, or else of the program, or
/// else of the environment. Empty if none of them is set.
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

/// Chooses how all solvers of the program round, whatever their own setters say: "auto" for better
/// energies, or any other of Roundel's strategies. An empty name undoes the choice. This setting
/// overrides the environment variable ROUNDEL_COMISO_STRATEGY.
inline void set_roundel_strategy(std::string strategy) {
    roundel_detail::program().strategy = std::move(strategy);
}

/// Sets the function that receives log lines: timings, and settings that Roundel replaces by
/// others. Without it nothing is printed.
inline void set_roundel_log(std::function<void(const std::string&)> log) {
    roundel_detail::program().log = std::move(log);
}

} // namespace COMISO

#endif // COMISO_ROUNDEL_SETTINGS_HH
