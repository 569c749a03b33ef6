// Proofs: what is written is accepted, altered files are refused.

#include "wrapper.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace {

/// (x0 - 3.3)^2 + (x1 - 2.6)^2 with integers and x0 + 2 x1 <= rhs.
roundel::Problem bounded(double rhs) {
    roundel::Problem problem(2);
    problem.least_squares({0}, {1.0}, 3.3);
    problem.least_squares({1}, {1.0}, 2.6);
    problem.inequality({0, 1}, {1.0, 2.0}, -INFINITY, rhs);
    problem.integer({0, 1});
    return problem;
}

/// Writes the proof with `fresh` in place of `old`.
void alter(const std::string& file, const std::string& old, const std::string& fresh) {
    std::stringstream all;
    all << std::ifstream(file).rdbuf();
    std::string text = all.str();
    const auto at = text.find(old);
    CHECK(at != std::string::npos);
    text.replace(at, old.size(), fresh);
    std::ofstream(file) << text;
}

} // namespace

void proofs_are_written_and_checked() {
    const std::string file = "wrapper.jsonl";
    std::remove(file.c_str());
    const roundel::Problem problem = bounded(7.5);
    const auto proved = roundel::solve_with_proof(problem, file);
    CHECK(proved.solution.status() == roundel::SolveStatus::optimal);
    CHECK(proved.proof && proved.proof.nodes > 0);
    for (const auto& proof : {roundel::check_proof(file), roundel::check_proof(file, problem)}) {
        CHECK(proof && proof.nodes == proved.proof.nodes);
        CHECK(std::abs(*proof.energy - proved.solution.energy()) < 1e-12);
        CHECK(*proof.lower_bound <= *proof.energy && *proof.energy - *proof.lower_bound < 1e-8);
        CHECK(proof.violation <= 1e-9);
    }

    roundel::Status status;
    CHECK(!roundel::check_proof(file, bounded(7.75), &status));
    CHECK(status.code == ROUNDEL_ERROR_PROOF_REFUSED && status.line == 2);
    alter(file, "\"values\":[", "\"values\":[1");
    bool is_refused = false;
    try {
        roundel::check_proof(file);
    } catch (const roundel::Error& error) {
        is_refused = error.code() == ROUNDEL_ERROR_PROOF_REFUSED;
        CHECK(error.line() == 3);
    }
    CHECK(is_refused);
    std::remove(file.c_str());
    CHECK(!roundel::check_proof(file, &status) && status.code == ROUNDEL_ERROR_IO);

    // A cancelled solve keeps its solution and writes no proof.
    roundel::Options options;
    options.set_on_event([](const roundel::Event& event) {
        return std::isfinite(event.energy) ? roundel::stop : roundel::go_on;
    });
    const auto stopped = roundel::solve_with_proof(problem, file, options);
    CHECK(stopped.solution && !stopped.proof);
    CHECK(stopped.proof.stopped_by == roundel::StoppedBy::cancel);
    CHECK(!std::ifstream(file).good());

    roundel::Options greedy;
    greedy.set_strategy("greedy");
    CHECK(!roundel::solve_with_proof(problem, file, greedy, &status).solution);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);

    roundel::Problem empty = bounded(7.5);
    empty.constrain({0, 1}, {2.0, 4.0}, 3.0);
    const auto none = roundel::solve_with_proof(empty, file, {}, &status);
    CHECK(!none.solution && status.code == ROUNDEL_ERROR_NO_INTEGER_SOLUTION);
    const auto proof = roundel::check_proof(file, empty);
    CHECK(proof && !proof.energy && !proof.lower_bound);
    std::remove(file.c_str());
}
