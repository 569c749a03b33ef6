/*
 * A program of the days of the header beside it, that of 0.1.0, with which ABI 1 began: compiled
 * against that one, run with the library of today. The ABI number is the same, so it must work.
 */

#include "roundel/roundel.h"

#include <stdio.h>

/* An event of today is longer, if anything, and its first members are where they were. */
static int32_t listen(const roundel_event* event, void* heard) {
    *(int*)heard += event->size >= sizeof *event && event->text != NULL && event->seconds >= 0.0;
    return 0;
}

static int solves(void) {
    const int32_t index[] = {0, 1};
    const double coefficient[] = {1.0, -1.0};
    int heard = 0;
    double x[2] = {0.0, 0.0};
    roundel_counts counts;
    roundel_problem* problem = NULL;
    roundel_options* options = NULL;
    roundel_solution* solution = NULL;
    const roundel_monitor monitor = {sizeof monitor, listen, &heard, NULL};
    int good = roundel_problem_new(2, &problem) == ROUNDEL_OK &&
               roundel_problem_add_least_squares(problem, 1, index, coefficient, 0.4, 1.0, NULL) ==
                   ROUNDEL_OK &&
               roundel_problem_add_least_squares(problem, 2, index, coefficient, 0.0, 1.0, NULL) ==
                   ROUNDEL_OK &&
               roundel_problem_set_integers(problem, 1, index + 1) == ROUNDEL_OK &&
               roundel_options_new(&options) == ROUNDEL_OK &&
               roundel_options_set_text(options, "strategy", "greedy") == ROUNDEL_OK &&
               roundel_problem_solve(problem, options, &monitor, &solution) == ROUNDEL_OK &&
               roundel_solution_values(solution, x, 2) == ROUNDEL_OK &&
               roundel_solution_counts(solution, &counts) == ROUNDEL_OK;
    good = good && heard > 0 && counts.variables == 2 && counts.integers == 1 && x[1] == 0.0 &&
           x[0] > 0.199 && x[0] < 0.201;
    roundel_solution_free(solution);
    roundel_options_free(options);
    roundel_problem_free(problem);
    return good;
}

/* Errors of the past have the numbers of the past. */
static int fails(void) {
    roundel_problem* problem = NULL;
    const int good = roundel_problem_new(0, &problem) == ROUNDEL_ERROR_EMPTY &&
                     roundel_problem_new(3, NULL) == ROUNDEL_ERROR_NULL_POINTER &&
                     roundel_problem_pin(problem, 0, 1.0) == ROUNDEL_ERROR_NULL_POINTER;
    return good && problem == NULL;
}

static int finds_a_field(void) {
    double energy = -1.0;
    roundel_mesh* mesh = NULL;
    roundel_field* field = NULL;
    const int good = roundel_mesh_make_shape("sphere", 100, &mesh) == ROUNDEL_OK &&
                     roundel_field_solve(mesh, NULL, NULL, NULL, &field) == ROUNDEL_OK &&
                     roundel_field_energy(field, &energy) == ROUNDEL_OK && energy > 0.0;
    roundel_field_free(field);
    roundel_mesh_free(mesh);
    return good;
}

static int makes_quads(void) {
    size_t count = 0;
    int32_t conforming = 0;
    roundel_mesh* mesh = NULL;
    roundel_quad_options* options = NULL;
    roundel_quads* quads = NULL;
    const int good = roundel_mesh_make_shape("torus", 500, &mesh) == ROUNDEL_OK &&
                     roundel_quad_options_new(&options) == ROUNDEL_OK &&
                     roundel_quad_options_set_int(options, "quads", 100) == ROUNDEL_OK &&
                     roundel_quads_make(mesh, options, NULL, &quads) == ROUNDEL_OK &&
                     roundel_quads_count(quads, &count) == ROUNDEL_OK && count > 50 &&
                     roundel_quads_is_conforming(quads, &conforming) == ROUNDEL_OK && conforming;
    roundel_quads_free(quads);
    roundel_quad_options_free(options);
    roundel_mesh_free(mesh);
    return good;
}

int main(void) {
    const int good = roundel_abi_version() == ROUNDEL_ABI_VERSION && solves() && fails() &&
                     finds_a_field() && makes_quads();
    puts(good ? "as it did" : "FAILED");
    return good ? 0 : 1;
}
