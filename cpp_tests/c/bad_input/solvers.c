/* Solvers and presets given NULL, wrong lengths, NaN or contradictory right sides. The solver stays
 * usable. */

#include "bad_input.h"

#include <string.h>

/* x0 + x1 = d0, x0 + x1 = d1, 2 x2 = d2 with x2 an integer. */
static roundel_solver* contradictable(void) {
    const int32_t index[3] = {0, 1, 2};
    const double one[2] = {1.0, 1.0}, two[1] = {2.0};
    roundel_problem* p = NULL;
    roundel_solver* s = NULL;
    GOOD(roundel_problem_new(3, &p));
    for (int32_t i = 0; i < 3; ++i) {
        GOOD(roundel_problem_add_least_squares(p, 1, index + i, one, 0.4, 1.0, NULL));
    }
    GOOD(roundel_problem_add_constraint(p, 2, index, one, 0.5));
    GOOD(roundel_problem_add_constraint(p, 2, index, one, 0.5));
    GOOD(roundel_problem_add_constraint(p, 1, index + 2, two, 4.0));
    GOOD(roundel_problem_set_integers(p, 1, index + 2));
    GOOD(roundel_solver_new(p, &s));
    GOOD(roundel_problem_free(p));
    return s;
}

static void arguments(fixture* f, roundel_solver* s) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const roundel_status finite = ROUNDEL_ERROR_NOT_FINITE;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const double fine_values[3] = {0.5, 0.5, 4.0}, nan[3] = {0.5, (double)NAN, 4.0};
    roundel_solver* made = NULL;
    roundel_solution* x = NULL;
    BAD(f, roundel_solver_new(NULL, &made), null, "problem", NONE);
    BAD(f, roundel_solver_new(f->problem, NULL), null, "solver", NONE);
    BAD(f, roundel_solver_set_linear(NULL, fine_values, 3), null, "solver", NONE);
    BAD(f, roundel_solver_set_linear(s, NULL, 3), null, "linear", NONE);
    BAD(f, roundel_solver_set_linear(s, fine_values, 2), length, "expected 3 entries, got 2", NONE);
    BAD(f, roundel_solver_set_linear(s, nan, 3), finite, "linear", 1);
    BAD(f, roundel_solver_set_constraint_right_sides(NULL, fine_values, 3), null, "solver", NONE);
    BAD(f, roundel_solver_set_constraint_right_sides(s, NULL, 3), null, "constraint", NONE);
    BAD(f, roundel_solver_set_constraint_right_sides(s, fine_values, 0), length, "got 0", NONE);
    BAD(f, roundel_solver_set_constraint_right_sides(s, nan, 3), finite, "constraint", 1);
    BAD(f, roundel_solver_set_least_squares_right_sides(NULL, fine_values, 3), null, "solver",
        NONE);
    BAD(f, roundel_solver_set_least_squares_right_sides(s, NULL, 3), null, "least-squares", NONE);
    BAD(f, roundel_solver_set_least_squares_right_sides(s, fine_values, 2), length, "got 2", NONE);
    BAD(f, roundel_solver_set_least_squares_right_sides(s, nan, 3), finite, "least-squares", 1);
    BAD(f, roundel_solver_set_guess(NULL, fine_values, 3), null, "solver", NONE);
    BAD(f, roundel_solver_set_guess(s, NULL, 3), null, "guess", NONE);
    BAD(f, roundel_solver_set_guess(s, fine_values, 1), length, "got 1", NONE);
    BAD(f, roundel_solver_set_guess(s, nan, 3), finite, "guess", 1);
    BAD(f, roundel_solver_pin(NULL, 0, 1.0), null, "solver", NONE);
    BAD(f, roundel_solver_pin(s, 3, 1.0), range, "outside 0..3", 0);
    BAD(f, roundel_solver_pin(s, -1, 1.0), range, "-1", 0);
    BAD(f, roundel_solver_pin(s, 0, (double)INFINITY), finite, "pinned", 0);
    BAD(f, roundel_solver_unpin(NULL, 0), null, "solver", NONE);
    BAD(f, roundel_solver_unpin(s, INT64_MAX), range, "9223372036854775807", 0);
    BAD(f, roundel_solver_solve(NULL, NULL, NULL, &x), null, "solver", NONE);
    BAD(f, roundel_solver_solve(s, NULL, NULL, NULL), null, "solution", NONE);
    HOLDS(made == NULL && x == NULL);
    GOOD(roundel_solver_free(NULL));
}

/* The values of a solve that must succeed. */
static void solved(roundel_solver* s, double values[3]) {
    roundel_solution* x = NULL;
    GOOD(roundel_solver_solve(s, NULL, NULL, &x));
    GOOD(roundel_solution_values(x, values, 3));
    GOOD(roundel_solution_free(x));
}

static void data(fixture* f, roundel_solver* s) {
    const double apart[3] = {0.5, 0.75, 4.0}, odd[3] = {0.5, 0.5, 3.0}, holds[3] = {0.5, 0.5, 4.0};
    double before[3], after[3];
    roundel_solution* x = NULL;
    solved(s, before);
    GOOD(roundel_solver_set_constraint_right_sides(s, apart, 3));
    BAD(f, roundel_solver_solve(s, NULL, NULL, &x), ROUNDEL_ERROR_INFEASIBLE, "0.75", 1);
    GOOD(roundel_solver_set_constraint_right_sides(s, odd, 3));
    BAD(f, roundel_solver_solve(s, NULL, NULL, &x), ROUNDEL_ERROR_NO_INTEGER_SOLUTION, "2 x2 = 3",
        2);
    GOOD(roundel_solver_set_constraint_right_sides(s, holds, 3));
    GOOD(roundel_solver_pin(s, 2, 1.5));
    BAD(f, roundel_solver_solve(s, NULL, NULL, &x), ROUNDEL_ERROR_INVALID_ARGUMENT, "pinned to 1.5",
        2);
    GOOD(roundel_solver_unpin(s, 2));
    HOLDS(x == NULL);
    solved(s, after);
    HOLDS(memcmp(before, after, sizeof before) == 0);
}

static void presets(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    roundel_preset preset;
    roundel_options* options = NULL;
    memset(&preset, 0, sizeof preset);
    BAD(f, roundel_options_set_preset(NULL, "parametrization"), null, "options", NONE);
    BAD(f, roundel_options_set_preset(f->options, NULL), null, "preset", NONE);
    BAD(f, roundel_options_set_preset(f->options, "luck"), ROUNDEL_ERROR_OPTION_RANGE, "luck",
        NONE);
    BAD(f, roundel_preset_info(0, NULL), null, "preset", NONE);
    BAD(f, roundel_preset_info(roundel_preset_count(), &preset), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "presets", 0);
    HOLDS(preset.name == NULL && roundel_preset_count() >= 2);
    GOOD(roundel_options_new(&options));
    for (size_t i = 0; i < roundel_preset_count(); ++i) {
        char word[16] = "";
        GOOD(roundel_preset_info(i, &preset));
        GOOD(roundel_options_set_preset(options, preset.name));
        GOOD(roundel_options_get_text(options, "strategy", word, sizeof word, NULL));
        HOLDS(strcmp(word, "adaptive") == 0 && strlen(preset.text) > 0);
    }
    GOOD(roundel_options_free(options));
}

void bad_solvers(fixture* f) {
    roundel_solver* s = contradictable();
    arguments(f, s);
    data(f, s);
    presets(f);
    GOOD(roundel_solver_free(s));
}
