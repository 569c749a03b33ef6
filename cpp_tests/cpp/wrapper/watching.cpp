// Options, callbacks and cancel tokens.

#include "wrapper.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace std::string_literals;

void options_follow_the_librarys_list() {
    // Every option has a member of the same name. A new option must be added to this list.
    const std::set<std::string> members = {"strategy",
                                           "time_limit",
                                           "threads",
                                           "rounding_threshold",
                                           "exact_integers",
                                           "gauss_seidel_updates",
                                           "gauss_seidel_tolerance",
                                           "cg_iterations",
                                           "cg_tolerance",
                                           "exact_steps",
                                           "warm_start",
                                           "ordering",
                                           "dense_integers",
                                           "beam_width",
                                           "lattice_rounds",
                                           "nodes",
                                           "gap"};
    std::set<std::string> listed;
    for (std::size_t i = 0; i < roundel_option_count(); ++i) {
        roundel_option option;
        CHECK(roundel_option_info(i, &option) == ROUNDEL_OK);
        listed.insert(option.name);
    }
    CHECK(members == listed);

    const roundel::Problem problem = chain(4);
    roundel::Options relaxed;
    relaxed.set_strategy("relax").set_time_limit(60.0).set_threads(1);
    CHECK(roundel::solve(problem, relaxed).status() == roundel::SolveStatus::relaxed);
    roundel::Options local;
    local.set_strategy("adaptive").set_exact_integers(0).set_rounding_threshold(0.25);
    local.set_gauss_seidel_updates(1000).set_gauss_seidel_tolerance(1e-6);
    local.set_cg_iterations(20).set_cg_tolerance(1e-6).set_exact_steps(1);
    CHECK(roundel::solve(problem, local).violations().integrality == 0.0);
    roundel::Options preset;
    preset.set_preset("parametrization").set_ordering("natural").set_warm_start("offer");
    CHECK(roundel::solve(problem, preset).counts().factor_nonzeros > 0);
    roundel::Options proof;
    proof.set_strategy("exact").set_dense_integers(500).set_beam_width(16).set_lattice_rounds(2);
    proof.set_nodes(1000000).set_gap(0.0);
    CHECK(roundel::solve(problem, proof).status() == roundel::SolveStatus::optimal);
    roundel::Options by_name;
    by_name.set("strategy", "relax"s).set("threads", std::int64_t{1}).set("time_limit", 60.0);
    CHECK(roundel::solve(problem, by_name).status() == roundel::SolveStatus::relaxed);
    roundel::Status status;
    CHECK(!roundel::solve(problem, by_name.set("speed", 1.0), &status));
    CHECK(status.code == ROUNDEL_ERROR_UNKNOWN_OPTION);
    CHECK(!roundel::solve(problem, preset.set_preset("luck"), &status));
    CHECK(status.code == ROUNDEL_ERROR_OPTION_RANGE);
    roundel::Options late;
    CHECK(!roundel::solve(problem, late.set_time_limit(0.0), &status));
    CHECK(status.code == ROUNDEL_ERROR_TIME_LIMIT);
}

void callbacks_stop_and_throw() {
    const roundel::Problem problem = chain(200);
    int improved = 0;
    roundel::Options options;
    options.set_on_event([&](const roundel::Event& event) {
        if (event.kind == roundel::EventKind::improved) {
            ++improved;
            CHECK(event.gap >= 0.0 && event.phase == roundel::Phase::none);
        }
        return roundel::go_on;
    });
    CHECK(roundel::solve(problem, options) && improved > 0);

    // The best solution is kept when its own event stops the solve.
    options.set_on_event([](const roundel::Event& event) {
        return event.kind == roundel::EventKind::improved ? roundel::stop : roundel::go_on;
    });
    const roundel::Solution stopped = roundel::solve(problem, options);
    CHECK(stopped && stopped.violations().integrality == 0.0);

    // A solve that is stopped at its first event may have no solution.
    roundel::Status status;
    options.set_on_event([](const roundel::Event&) { return roundel::stop; });
    const roundel::Solution early = roundel::solve(problem, options, &status);
    CHECK(early ? early.status() == roundel::SolveStatus::cancelled
                : status.code == ROUNDEL_ERROR_CANCELLED);

    // An exception of a callback reaches the caller unchanged, with or without a Status.
    int events = 0;
    options.set_on_event([&](const roundel::Event&) -> roundel::Flow {
        ++events;
        throw std::runtime_error("mine");
    });
    for (roundel::Status* told : {static_cast<roundel::Status*>(nullptr), &status}) {
        try {
            roundel::solve(problem, options, told);
            CHECK(!"reached");
        } catch (const std::runtime_error& error) {
            CHECK(error.what() == "mine"s);
        }
    }
    CHECK(events >= 2);
    CHECK(roundel::solve(problem));
}

void tokens_cancel_from_other_threads() {
    const roundel::Problem problem = chain(200);
    const roundel::CancelToken token;
    roundel::Options options;
    std::atomic<bool> begun{false};
    options.set_cancel(token).set_on_event([&](const roundel::Event&) {
        begun = true;
        // The solve waits here until the other thread has set the token.
        while (!token.is_cancelled()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return roundel::go_on;
    });
    std::thread other([&] {
        while (!begun) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        token.cancel();
    });
    roundel::Status status;
    const roundel::Solution solution = roundel::solve(problem, options, &status);
    other.join();
    CHECK(solution ? solution.status() == roundel::SolveStatus::cancelled
                   : status.code == ROUNDEL_ERROR_CANCELLED);

    // A token that is set before the start cancels, and is usable again after a reset.
    const roundel::Problem small = chain(4);
    options.set_on_event(nullptr);
    CHECK(!roundel::solve(small, options, &status));
    CHECK(status.code == ROUNDEL_ERROR_CANCELLED);
    token.reset();
    CHECK(!token.is_cancelled() && roundel::solve(small, options));
}

void threads_share_a_problem_and_keep_their_errors() {
    const roundel::Problem problem = chain(500);
    const roundel::Solution alone = roundel::solve(problem);
    constexpr std::size_t count = 4;
    bool same[count] = {};
    bool own[count] = {};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < count; ++t) {
        threads.emplace_back([&, t] {
            const auto solution = roundel::solve(problem);
            same[t] = std::equal(solution.values().begin(), solution.values().end(),
                                 alone.values().begin(), alone.values().end());
            // Each thread fails at another entry and gets its own error.
            roundel::Problem mine(1);
            std::vector<std::int32_t> bad(t + 1, 0);
            bad.back() = 9;
            own[t] = true;
            for (int again = 0; again < 200; ++again) {
                roundel::Status status;
                mine.integer(bad, &status);
                own[t] = own[t] && status.index == static_cast<std::int64_t>(t);
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (std::size_t t = 0; t < count; ++t) {
        CHECK(same[t]);
        CHECK(own[t]);
    }
}
