/*
 * Makes ten thousand small solves in one process, some of them with errors and some cancelled.
 * Memory use at the end is no larger than after the first thousand. The argument is another number
 * of solves.
 */

#define _POSIX_C_SOURCE 200809L

#include <roundel/roundel.h>

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>

#define SIZE 6

static int32_t stop_at_once(const roundel_event* event, void* user_data) {
    (void)event;
    (void)user_data;
    return 1;
}

/* A chain of differences, one constraint and integers: every part that a problem can have. */
static int solve_once(int round) {
    const char* const strategies[] = {"auto", "greedy", "exact", "adaptive", "lattice", "direct"};
    const int32_t index[SIZE] = {0, 1, 2, 3, 4, 5};
    const double sign[2] = {1.0, -1.0};
    const int contradicts = round % 7 == 3;
    const int cancels = round % 11 == 5;
    const roundel_monitor monitor = {sizeof monitor, cancels ? stop_at_once : NULL, NULL, NULL};
    roundel_problem* problem = NULL;
    roundel_options* options = NULL;
    roundel_solver* solver = NULL;
    roundel_solution* solution = NULL;
    double values[SIZE];
    int good = roundel_problem_new(SIZE, &problem) == ROUNDEL_OK &&
               roundel_options_new(&options) == ROUNDEL_OK &&
               roundel_options_set_text(options, "strategy", strategies[round % 6]) == ROUNDEL_OK;
    for (int k = 0; good && k + 1 < SIZE; ++k) {
        good = roundel_problem_add_least_squares(problem, 2, index + k, sign, 0.3 * round, 1.0,
                                                 NULL) == ROUNDEL_OK;
    }
    good = good && roundel_problem_set_integers(problem, 3, index + 2) == ROUNDEL_OK &&
           roundel_problem_add_constraint(problem, 2, index, sign, 0.5) == ROUNDEL_OK &&
           roundel_problem_add_constraint(problem, 2, index, sign, contradicts ? 1.5 : 0.5) ==
               ROUNDEL_OK &&
           roundel_solver_new(problem, &solver) == ROUNDEL_OK;
    if (good) {
        const roundel_status ended = roundel_solver_solve(solver, options, &monitor, &solution);
        good = contradicts ? ended == ROUNDEL_ERROR_INFEASIBLE || ended == ROUNDEL_ERROR_CANCELLED
               : cancels   ? ended == ROUNDEL_OK || ended == ROUNDEL_ERROR_CANCELLED
                           : ended == ROUNDEL_OK &&
                               roundel_solution_values(solution, values, SIZE) == ROUNDEL_OK;
    }
    roundel_solution_free(solution);
    roundel_solver_free(solver);
    roundel_options_free(options);
    roundel_problem_free(problem);
    return good;
}

int main(int argc, char** argv) {
    const int solves = argc > 1 ? atoi(argv[1]) : 10000;
    size_t early = 0;
    for (int round = 0; round < solves; ++round) {
        if (!solve_once(round)) {
            char text[256];
            roundel_last_error_message(text, sizeof text);
            fprintf(stderr, "solve %d: %s\n", round, text);
            return 1;
        }
        if (round == solves / 10) {
            early = mallinfo2().uordblks;
        }
    }
    const size_t late = mallinfo2().uordblks;
    printf("%d solves: %zu bytes in use, %zu after a tenth of them\n", solves, late, early);
    /* The allocator keeps some freed memory. A leak of 30 bytes a solve would exceed this limit. */
    return late <= early + (1 << 18) ? 0 : 1;
}
