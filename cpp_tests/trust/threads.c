/*
 * Several threads solve one problem at once, another thread cancels one solve, and each thread gets
 * its own error messages.
 */

#define _POSIX_C_SOURCE 200809L

#include <roundel/roundel.h>

#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define SIZE 40
#define THREADS 4

typedef struct {
    const roundel_problem* problem;
    double values[SIZE];
    int good;
} job;

static roundel_problem* make_problem(void) {
    roundel_problem* problem = NULL;
    int32_t index[SIZE];
    double row[SIZE];
    int good = roundel_problem_new(SIZE, &problem) == ROUNDEL_OK;
    unsigned state = 1;
    for (int32_t k = 0; k < SIZE; ++k) {
        index[k] = k;
    }
    for (int i = 0; good && i < SIZE; ++i) {
        for (int k = 0; k < SIZE; ++k) {
            state = state * 1664525u + 1013904223u;
            row[k] = (double)(state >> 24) / 16.0 + (i == k ? 24.0 : 0.0);
        }
        const double rhs = 100.0 * row[i];
        good = roundel_problem_add_least_squares(problem, SIZE, index, row, rhs, 1.0, NULL) ==
               ROUNDEL_OK;
    }
    good = good && roundel_problem_set_integers(problem, SIZE, index) == ROUNDEL_OK;
    return good ? problem : NULL;
}

static roundel_options* make_options(const char* strategy) {
    roundel_options* options = NULL;
    const int good = roundel_options_new(&options) == ROUNDEL_OK &&
                     roundel_options_set_text(options, "strategy", strategy) == ROUNDEL_OK;
    return good ? options : NULL;
}

static void* solve(void* data) {
    job* mine = data;
    char text[200];
    roundel_options* options = make_options("lattice");
    roundel_solution* solution = NULL;
    mine->good = roundel_problem_solve(mine->problem, options, NULL, &solution) == ROUNDEL_OK &&
                 roundel_solution_values(solution, mine->values, SIZE) == ROUNDEL_OK &&
                 roundel_solution_values(solution, mine->values, 1) != ROUNDEL_OK &&
                 roundel_last_error_message(text, sizeof text) > 0;
    roundel_solution_free(solution);
    roundel_options_free(options);
    return NULL;
}

static void* cancel_soon(void* token) {
    const struct timespec pause = {0, 50 * 1000 * 1000};
    nanosleep(&pause, NULL);
    roundel_cancel_token_cancel(token);
    return NULL;
}

static int together(const roundel_problem* problem) {
    pthread_t threads[THREADS];
    static job jobs[THREADS];
    int good = 1;
    for (int k = 0; k < THREADS; ++k) {
        jobs[k].problem = problem;
        good = good && pthread_create(&threads[k], NULL, solve, &jobs[k]) == 0;
    }
    for (int k = 0; good && k < THREADS; ++k) {
        pthread_join(threads[k], NULL);
        good = jobs[k].good && memcmp(jobs[k].values, jobs[0].values, sizeof jobs[k].values) == 0;
    }
    return good;
}

static int cancelled(const roundel_problem* problem) {
    pthread_t other;
    roundel_cancel_token* token = NULL;
    roundel_solution* solution = NULL;
    roundel_options* options = make_options("exact");
    roundel_solve_status status = ROUNDEL_SOLVE_FEASIBLE;
    int good = roundel_cancel_token_new(&token) == ROUNDEL_OK;
    const roundel_monitor monitor = {sizeof monitor, NULL, NULL, token};
    good = good && pthread_create(&other, NULL, cancel_soon, token) == 0;
    if (good) {
        /* A slow machine may have no solution yet, and a fast one may have proved the optimum. */
        const roundel_status ended = roundel_problem_solve(problem, options, &monitor, &solution);
        pthread_join(other, NULL);
        good = ended == ROUNDEL_ERROR_CANCELLED ||
               (ended == ROUNDEL_OK && roundel_solution_status(solution, &status) == ROUNDEL_OK &&
                (status == ROUNDEL_SOLVE_CANCELLED || status == ROUNDEL_SOLVE_OPTIMAL));
    }
    roundel_solution_free(solution);
    roundel_options_free(options);
    roundel_cancel_token_free(token);
    return good;
}

int main(void) {
    roundel_problem* problem = make_problem();
    const int good = problem != NULL && together(problem) && cancelled(problem);
    roundel_problem_free(problem);
    puts(good ? "as they should" : "FAILED");
    return good ? 0 : 1;
}
