/* NULL for every handle and every output argument; outputs stay untouched on failure. */

#include "bad_input.h"

static void no_problem(fixture* f) {
    const int32_t index[1] = {0};
    const int32_t offsets[2] = {0, 1};
    const double one[1] = {1.0};
    const int8_t sign[1] = {1};
    const int32_t full = ROUNDEL_TRIANGLE_FULL;
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    roundel_problem* copy = NULL;
    roundel_solution* solution = NULL;
    size_t count = 7;
    BAD(f, roundel_problem_clone(NULL, &copy), null, "problem", NONE);
    BAD(f, roundel_problem_variable_count(NULL, &count), null, "problem", NONE);
    BAD(f, roundel_problem_constraint_count(NULL, &count), null, "problem", NONE);
    BAD(f, roundel_problem_add_quadratic_triplets(NULL, full, 1, index, index, one), null,
        "problem", NONE);
    BAD(f, roundel_problem_add_quadratic_csc(NULL, full, 2, offsets, 1, index, one), null,
        "problem", NONE);
    BAD(f, roundel_problem_add_linear(NULL, one, 1), null, "problem", NONE);
    BAD(f, roundel_problem_add_linear_term(NULL, 0, 1.0), null, "problem", NONE);
    BAD(f, roundel_problem_add_constant(NULL, 1.0), null, "problem", NONE);
    BAD(f, roundel_problem_add_least_squares(NULL, 1, index, one, 0.0, 1.0, NULL), null, "problem",
        NONE);
    BAD(f, roundel_problem_add_constraint(NULL, 1, index, one, 0.0), null, "problem", NONE);
    BAD(f,
        roundel_problem_add_least_squares_csr(NULL, 2, offsets, 1, index, one, 1, one, NULL, NULL),
        null, "problem", NONE);
    BAD(f, roundel_problem_add_constraints_csr(NULL, 2, offsets, 1, index, one, 1, one, NULL), null,
        "problem", NONE);
    BAD(f, roundel_problem_set_integers(NULL, 1, index), null, "problem", NONE);
    BAD(f, roundel_problem_pin(NULL, 0, 1.0), null, "problem", NONE);
    BAD(f, roundel_problem_unpin(NULL, 0), null, "problem", NONE);
    BAD(f, roundel_problem_set_guess(NULL, one, 1), null, "problem", NONE);
    BAD(f, roundel_problem_hint_cycles(NULL, 2, offsets, 1, index, sign), null, "problem", NONE);
    BAD(f, roundel_problem_write_mps(NULL, "never.mps"), null, "problem", NONE);
    BAD(f, roundel_problem_save_replay(NULL, NULL, "never.mps"), null, "problem", NONE);
    BAD(f, roundel_problem_solve(NULL, NULL, NULL, &solution), null, "problem", NONE);
    HOLDS(copy == NULL && solution == NULL && count == 7);
}

static void no_solution(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    double number = 7.0, other = 7.0;
    int32_t known = 7;
    size_t count = 7;
    roundel_solve_status status = ROUNDEL_SOLVE_LIMIT;
    roundel_stopped_by stopped_by = ROUNDEL_STOPPED_BY_MEMORY;
    roundel_counts counts;
    roundel_seconds seconds;
    BAD(f, roundel_solution_variable_count(NULL, &count), null, "solution", NONE);
    BAD(f, roundel_solution_values(NULL, &number, 1), null, "solution", NONE);
    BAD(f, roundel_solution_energy(NULL, &number), null, "solution", NONE);
    BAD(f, roundel_solution_lower_bound(NULL, &known, &number), null, "solution", NONE);
    BAD(f, roundel_solution_gap(NULL, &known, &number), null, "solution", NONE);
    BAD(f, roundel_solution_status(NULL, &status), null, "solution", NONE);
    BAD(f, roundel_solution_is_complete(NULL, &known), null, "solution", NONE);
    BAD(f, roundel_solution_stopped_by(NULL, &stopped_by), null, "solution", NONE);
    BAD(f, roundel_solution_counts(NULL, &counts), null, "solution", NONE);
    BAD(f, roundel_solution_seconds(NULL, &seconds), null, "solution", NONE);
    BAD(f, roundel_solution_violations(NULL, &number, &other), null, "solution", NONE);
    HOLDS(number == 7.0 && other == 7.0 && known == 7 && count == 7);
    HOLDS(status == ROUNDEL_SOLVE_LIMIT && stopped_by == ROUNDEL_STOPPED_BY_MEMORY);
}

static void no_place(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    double number = 7.0;
    int32_t known = 7;
    BAD(f, roundel_problem_new(3, NULL), null, "problem", NONE);
    BAD(f, roundel_problem_clone(f->problem, NULL), null, "copy", NONE);
    BAD(f, roundel_problem_variable_count(f->problem, NULL), null, "variables", NONE);
    BAD(f, roundel_problem_constraint_count(f->problem, NULL), null, "constraints", NONE);
    BAD(f, roundel_options_new(NULL), null, "options", NONE);
    BAD(f, roundel_cancel_token_new(NULL), null, "cancel token", NONE);
    BAD(f, roundel_cancel_token_is_cancelled(f->token, NULL), null, "cancelled", NONE);
    BAD(f, roundel_problem_solve(f->problem, NULL, NULL, NULL), null, "solution", NONE);
    BAD(f, roundel_solution_variable_count(f->solution, NULL), null, "variables", NONE);
    BAD(f, roundel_solution_values(f->solution, NULL, 3), null, "values", NONE);
    BAD(f, roundel_solution_energy(f->solution, NULL), null, "energy", NONE);
    BAD(f, roundel_solution_lower_bound(f->solution, NULL, &number), null, "known", NONE);
    BAD(f, roundel_solution_lower_bound(f->solution, &known, NULL), null, "lower bound", NONE);
    BAD(f, roundel_solution_gap(f->solution, &known, NULL), null, "gap", NONE);
    BAD(f, roundel_solution_status(f->solution, NULL), null, "status", NONE);
    BAD(f, roundel_solution_is_complete(f->solution, NULL), null, "complete", NONE);
    BAD(f, roundel_solution_stopped_by(f->solution, NULL), null, "stopped by", NONE);
    BAD(f, roundel_solution_counts(f->solution, NULL), null, "counts", NONE);
    BAD(f, roundel_solution_seconds(f->solution, NULL), null, "seconds", NONE);
    BAD(f, roundel_solution_violations(f->solution, &number, NULL), null, "integrality", NONE);
    HOLDS(number == 7.0 && known == 7);
}

static void wrong_lengths(fixture* f) {
    double values[4] = {7.0, 7.0, 7.0, 7.0};
    BAD(f, roundel_solution_values(f->solution, values, 2), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "expected 3 entries, got 2", NONE);
    BAD(f, roundel_solution_values(f->solution, values, 4), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "expected 3 entries, got 4", NONE);
    BAD(f, roundel_solution_values(f->solution, values, 0), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "expected 3 entries, got 0", NONE);
    BAD(f, roundel_last_error_direction(values, 4), ROUNDEL_ERROR_LENGTH_MISMATCH, "direction",
        NONE);
    HOLDS(values[0] == 7.0 && values[3] == 7.0);
}

void bad_handles(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    no_problem(f);
    no_solution(f);
    no_place(f);
    wrong_lengths(f);
    BAD(f, roundel_cancel_token_cancel(NULL), null, "cancel token", NONE);
    BAD(f, roundel_cancel_token_finish(NULL), null, "cancel token", NONE);
    BAD(f, roundel_cancel_token_reset(NULL), null, "cancel token", NONE);
    /* An address that no handle can have. */
    BAD(f, roundel_problem_add_constant((roundel_problem*)((char*)f->problem + 1), 1.0),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "aligned", NONE);
    /* Freeing NULL is allowed. */
    GOOD(roundel_problem_free(NULL));
    GOOD(roundel_options_free(NULL));
    GOOD(roundel_solution_free(NULL));
    GOOD(roundel_cancel_token_free(NULL));
}
