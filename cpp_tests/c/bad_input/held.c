/* What a call that fails is held to, and the count of those that were not. */

#include "bad_input.h"

#include <string.h>

static FILE* report;
static int cases;
static int failures;

void report_to(FILE* file) {
    report = file;
}

void failed(const char* call, const char* what) {
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

/* The same handles serve a valid call, with the result that they gave at first. */
static void still_works(fixture* f, const char* call) {
    roundel_solution* again = NULL;
    double energy = 0.0;
    double values[3] = {0.0, 0.0, 0.0};
    int holds = roundel_problem_add_constant(f->problem, 0.0) == ROUNDEL_OK &&
                roundel_options_set_text(f->options, "strategy", "greedy") == ROUNDEL_OK &&
                roundel_problem_solve(f->problem, f->options, NULL, &again) == ROUNDEL_OK &&
                roundel_solution_energy(again, &energy) == ROUNDEL_OK &&
                roundel_solution_values(again, values, 3) == ROUNDEL_OK && energy == f->energy &&
                memcmp(values, f->values, sizeof values) == 0;
    if (!holds) {
        failed(call, "a valid call after it fails, or gives another result");
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

int all_held(void) {
    fprintf(report, "%d bad inputs, %d failures\n", cases, failures);
    return failures == 0 && cases >= 60;
}
