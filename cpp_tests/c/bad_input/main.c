/* Runs every group of cases with stdout and stderr redirected to a file, which must stay empty. */

#define _POSIX_C_SOURCE 200809L

#include "bad_input.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static FILE* report;
static int cases;
static int failures;

static void failed(const char* call, const char* what) {
    fprintf(report, "FAILED %s: %s\n", call, what);
    ++failures;
}

void fine(const char* call, int holds) {
    if (!holds) {
        char text[512];
        roundel_last_error_message(text, sizeof text);
        failed(call, text);
    }
}

/* The same handles serve a valid call and give the same result as at first. */
static void still_works(fixture* f, const char* call) {
    roundel_solution* again = NULL;
    double energy = 0.0;
    double values[3] = {0.0, 0.0, 0.0};
    int holds = roundel_problem_add_constant(f->problem, 0.0) == ROUNDEL_OK &&
                roundel_options_set_text(f->options, "strategy", "greedy") == ROUNDEL_OK &&
                roundel_solve(f->problem, f->options, &again) == ROUNDEL_OK &&
                roundel_solution_energy(again, &energy) == ROUNDEL_OK &&
                roundel_solution_values(again, values, 3) == ROUNDEL_OK && energy == f->energy &&
                memcmp(values, f->values, sizeof values) == 0;
    if (!holds) {
        failed(call, "a valid call after it fails or gives another result");
    }
    roundel_solution_free(again);
}

void held(fixture* f, const char* call, roundel_status status, expectation expected) {
    char text[512];
    ++cases;
    const size_t length = roundel_last_error_message(text, sizeof text);
    const int64_t index = roundel_last_error_index();
    const int64_t line = roundel_last_error_line();
    if (status != expected.status) {
        fprintf(report, "%s, not %s: %s\n", roundel_status_name(status),
                roundel_status_name(expected.status), text);
        failed(call, "another status");
    } else if (length == 0 || strstr(text, expected.part) == NULL) {
        fprintf(report, "'%s' is not in '%s'\n", expected.part, text);
        failed(call, "another message");
    } else if (index != expected.index) {
        fprintf(report, "%lld, not %lld: %s\n", (long long)index, (long long)expected.index, text);
        failed(call, "another index");
    } else if (line != expected.line) {
        fprintf(report, "%lld, not %lld: %s\n", (long long)line, (long long)expected.line, text);
        failed(call, "another line");
    }
    still_works(f, call);
}

/* (x0 - 0.4)^2 + (x0 - x1)^2 + (x1 - x2)^2 with x2 an integer. */
static int make(fixture* f) {
    const int32_t index[3] = {0, 1, 2};
    const double coefficient[2] = {1.0, -1.0};
    return roundel_problem_new(3, &f->problem) == ROUNDEL_OK &&
           roundel_problem_add_least_squares(f->problem, 1, index, coefficient, 0.4, 1.0, NULL) ==
               ROUNDEL_OK &&
           roundel_problem_add_least_squares(f->problem, 2, index, coefficient, 0.0, 1.0, NULL) ==
               ROUNDEL_OK &&
           roundel_problem_add_least_squares(f->problem, 2, index + 1, coefficient, 0.0, 1.0,
                                             NULL) == ROUNDEL_OK &&
           roundel_problem_set_integers(f->problem, 1, index + 2) == ROUNDEL_OK &&
           roundel_options_new(&f->options) == ROUNDEL_OK &&
           roundel_cancel_token_new(&f->token) == ROUNDEL_OK &&
           roundel_solve(f->problem, f->options, &f->solution) == ROUNDEL_OK &&
           roundel_solution_energy(f->solution, &f->energy) == ROUNDEL_OK &&
           roundel_solution_values(f->solution, f->values, 3) == ROUNDEL_OK;
}

int main(void) {
    char captured[] = "captured-XXXXXX";
    const int file = mkstemp(captured);
    report = fdopen(dup(STDERR_FILENO), "w");
    if (file < 0 || report == NULL || dup2(file, STDOUT_FILENO) < 0 ||
        dup2(file, STDERR_FILENO) < 0) {
        return 2;
    }
    fixture f = {0};
    HOLDS(make(&f));
    bad_handles(&f);
    bad_objective(&f);
    bad_constraints(&f);
    bad_least_squares(&f);
    bad_unknowns(&f);
    bad_options(&f);
    bad_monitors(&f);
    bad_problems(&f);
    bad_files(&f);
    bad_meshes(&f);
    bad_sizes(&f);
    bad_solvers(&f);
    bad_guidance(&f);
    bad_quads(&f);
    HOLDS(roundel_solution_free(f.solution) == ROUNDEL_OK);
    HOLDS(roundel_options_free(f.options) == ROUNDEL_OK);
    HOLDS(roundel_cancel_token_free(f.token) == ROUNDEL_OK);
    HOLDS(roundel_problem_free(f.problem) == ROUNDEL_OK);

    fflush(stdout);
    fflush(stderr);
    struct stat printed;
    if (fstat(file, &printed) != 0 || printed.st_size != 0) {
        failed("everything", "something was printed");
    }
    close(file);
    unlink(captured);
    fprintf(report, "%d bad inputs, %d failures\n", cases, failures);
    return failures == 0 && cases >= 60 ? 0 : 1;
}
