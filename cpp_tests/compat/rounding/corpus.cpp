// The decisions of the original CoMISo on a corpus of seamless parametrizations, compared with
// ours.
//
// usage: corpus DIRECTORY SCRATCH.mps
//
// DIRECTORY holds each problem as problem.mps.gz, and original_integers.json with the decisions
// under the settings of the thesis: {"problem": {"X7": 3, ...}, ...}. Without the directory the
// program ends with 77.

#include "solve.hpp"

#include <cstdio>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

namespace {

using Decisions = std::map<std::size_t, double>;

std::map<std::string, Decisions> read(const std::string& file) {
    std::ifstream stream(file);
    std::ostringstream content;
    content << stream.rdbuf();
    const std::string text = content.str();
    const std::regex item("\"([^\"]+)\"\\s*:\\s*(\\{|-?[0-9]+)");
    std::map<std::string, Decisions> problems;
    Decisions* of = nullptr;
    for (std::sregex_iterator at(text.begin(), text.end(), item), end; at != end; ++at) {
        if ((*at)[2] == "{") {
            of = &problems[(*at)[1]];
        } else {
            (*of)[std::stoul((*at)[1].str().substr(1))] = std::stod((*at)[2]);
        }
    }
    return problems;
}

} // namespace

int main(int, char** arguments) {
    const std::string directory = arguments[1];
    const auto problems = read(directory + "/original_integers.json");
    if (problems.empty()) {
        std::printf("skipped: there is no corpus in %s\n", arguments[1]);
        return 77;
    }
    std::printf("%-20s %9s %12s %12s %7s %12s %12s\n", "problem", "equal", "original", "compat",
                "ratio", "defaults", "auto");
    for (const auto& [name, decisions] : problems) {
        auto given = roundel::Problem::read_mps(directory + "/" + name + ".mps.gz");
        const GmmProblem problem = in_gmm(given, arguments[2]);
        CHECK(problem.integers.size() == decisions.size());
        for (const auto& [variable, value] : decisions) {
            given.pin(static_cast<std::int64_t>(variable), value);
        }
        const double original = roundel::solve(given).energy();
        const Solved ours = by_thesis(problem);
        const Solved standard = by(problem, "");
        const Solved best = by(problem, "auto");
        std::size_t equal = 0;
        for (const auto& [variable, value] : decisions) {
            equal += ours.x[variable] == value ? 1 : 0;
        }
        std::printf("%-20s %4zu/%4zu %12.6f %12.6f %7.4f %12.6f %12.6f\n", name.c_str(), equal,
                    decisions.size(), original, ours.energy, ours.energy / original,
                    standard.energy, best.energy);
        CHECK(problem.violation(ours.x) < 1e-6 && problem.violation(best.x) < 1e-6);
        CHECK(std::abs(ours.energy - original) <= 0.05 * original);
        CHECK(standard.energy <= 1.05 * original);
        // On a cube the decisions of the original are optimal.
        const bool cube = name.find("cube") != std::string::npos;
        CHECK(cube ? std::abs(best.energy - original) <= 1e-6 * original
                   : best.energy < original - 1e-3);
    }
    return failures != 0;
}
