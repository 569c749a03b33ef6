/* Monitors with a wrong size, a cancel before the start, and a time limit of zero. */

#include "bad_input.h"

#include <string.h>

typedef struct {
    roundel_monitor monitor;
    void* later;
} longer_monitor;

static int32_t stop_at_once(const roundel_event* event, void* user_data) {
    *(int*)user_data += event->size == sizeof *event && event->text != NULL;
    return 1;
}

void bad_monitors(fixture* f) {
    roundel_solution* found = NULL;
    roundel_monitor monitor;
    longer_monitor longer;
    const roundel_problem* p = f->problem;
    memset(&monitor, 0, sizeof monitor);
    BAD(f, roundel_problem_solve(p, NULL, &monitor, &found), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "size is 0", NONE);
    monitor.size = sizeof monitor - 1;
    BAD(f, roundel_problem_solve(p, NULL, &monitor, &found), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "sizeof(roundel_monitor)", NONE);
    monitor.size = (size_t)1 << 20;
    BAD(f, roundel_problem_solve(p, NULL, &monitor, &found), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "size is 1048576", NONE);

    /* A struct of a later version is accepted while its new members are zero. */
    memset(&longer, 0, sizeof longer);
    longer.monitor.size = sizeof longer;
    longer.later = &longer;
    BAD(f, roundel_problem_solve(p, NULL, &longer.monitor, &found), ROUNDEL_ERROR_NOT_SUPPORTED,
        "does not know", NONE);
    HOLDS(found == NULL);
    longer.later = NULL;
    GOOD(roundel_problem_solve(p, NULL, &longer.monitor, &found));
    GOOD(roundel_solution_free(found));
    found = NULL;

    monitor.size = sizeof monitor;
    monitor.cancel_token = f->token;
    GOOD(roundel_cancel_token_cancel(f->token));
    BAD(f, roundel_problem_solve(p, NULL, &monitor, &found), ROUNDEL_ERROR_CANCELLED, "cancelled",
        NONE);
    GOOD(roundel_cancel_token_reset(f->token));
    GOOD(roundel_problem_solve(p, NULL, &monitor, &found));
    GOOD(roundel_solution_free(found));
    found = NULL;

    roundel_options* hurried = NULL;
    GOOD(roundel_options_new(&hurried));
    GOOD(roundel_options_set_int(hurried, "time_limit", 0));
    BAD(f, roundel_problem_solve(p, hurried, NULL, &found), ROUNDEL_ERROR_TIME_LIMIT, "time limit",
        NONE);
    GOOD(roundel_options_set_real(hurried, "time_limit", (double)INFINITY));
    GOOD(roundel_problem_solve(p, hurried, NULL, &found));
    GOOD(roundel_solution_free(found));
    GOOD(roundel_options_free(hurried));
    found = NULL;
    HOLDS(found == NULL);

    /* A callback stops the solve at its first event: the result is an error or the best solution so
     * far. */
    int events = 0;
    monitor.cancel_token = NULL;
    monitor.callback = stop_at_once;
    monitor.user_data = &events;
    const roundel_status status = roundel_problem_solve(p, NULL, &monitor, &found);
    HOLDS(status == ROUNDEL_ERROR_CANCELLED || (status == ROUNDEL_OK && found != NULL));
    HOLDS(events >= 1);
    GOOD(roundel_solution_free(found));
}
