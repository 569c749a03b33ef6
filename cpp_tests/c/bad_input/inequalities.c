/* Bad inequalities, one by one and as a matrix, bad bounds and binaries; and a problem that they
 * limit. */

#include "bad_input.h"

#define NO_LIMIT ((double)INFINITY)

static void single(fixture* f) {
    const int32_t index[2] = {0, 2}, negative[2] = {-7, 0}, large[2] = {0, 3};
    const double one[2] = {1.0, 1.0}, infinite[2] = {NO_LIMIT, 1.0}, nan = (double)NAN;
    const roundel_status bad = ROUNDEL_ERROR_INVALID_ARGUMENT;
    roundel_problem* p = f->problem;
    size_t row = 7;
    BAD(f, roundel_problem_add_inequality(NULL, 2, index, one, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NULL_POINTER, "problem", NONE);
    BAD(f, roundel_problem_add_inequality(p, 2, NULL, one, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NULL_POINTER, "inequality", NONE);
    BAD(f, roundel_problem_add_inequality(p, 2, index, NULL, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NULL_POINTER, "coefficients", NONE);
    BAD(f, roundel_problem_add_inequality(p, 2, negative, one, 0.0, 1.0, &row),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 0 is -7, outside 0..3", 0);
    BAD(f, roundel_problem_add_inequality(p, 2, large, one, 0.0, 1.0, NULL),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 1 is 3", 1);
    BAD(f, roundel_problem_add_inequality(p, 2, index, infinite, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NOT_FINITE, "entry 0", 0);
    BAD(f, roundel_problem_add_inequality(p, 2, index, one, nan, 1.0, &row), bad, "NaN", 0);
    BAD(f, roundel_problem_add_inequality(p, 2, index, one, 0.0, nan, &row), bad, "NaN", 0);
    BAD(f, roundel_problem_add_inequality(p, 2, index, one, 2.0, 1.0, &row), bad,
        "lower limit 2 above the upper limit 1", 0);
    BAD(f, roundel_problem_add_inequality(p, 2, index, one, NO_LIMIT, NO_LIMIT, &row), bad,
        "which no finite number is", 0);
    BAD(f, roundel_problem_add_inequality(p, SIZE_MAX, index, one, 0.0, 1.0, &row),
        ROUNDEL_ERROR_OVERFLOW, "more than memory can hold", NONE);
    HOLDS(row == 7);
}

static void matrix(fixture* f) {
    const int32_t rows[3] = {0, 1, 2}, falling[3] = {0, 2, 1};
    const int32_t columns[2] = {0, 1}, large[2] = {0, 3};
    const int64_t rows64[3] = {0, 1, 2}, negative64[2] = {0, -1};
    const double one[2] = {1.0, 1.0}, nan_last[2] = {1.0, (double)NAN}, below[2] = {1.0, 0.5};
    const int32_t by_column[4] = {0, 1, 2, 2}, row_of[2] = {0, 2};
    const int64_t by_column64[4] = {0, 1, 2, 2}, row_of64[2] = {0, 2};
    const roundel_status bad = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    size_t first = 7, count = 7;
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_inequalities_csr(p, 2, rows, 2, columns, one, 2, one, one, &first),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 3 entries, got 2", NONE);
    BAD(f,
        roundel_problem_add_inequalities_csr(p, 3, falling, 2, columns, one, 2, one, one, &first),
        bad, "offset 2", 2);
    BAD(f, roundel_problem_add_inequalities_csr(p, 3, rows, 2, large, one, 2, one, one, &first),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "matrix indices", 1);
    BAD(f,
        roundel_problem_add_inequalities_csr_i64(p, 3, rows64, 2, negative64, one, 2, one, one,
                                                 NULL),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "-1", 1);
    BAD(f,
        roundel_problem_add_inequalities_csr(p, 3, rows, 2, columns, nan_last, 2, one, one, &first),
        ROUNDEL_ERROR_NOT_FINITE, "row 1: matrix values", 1);
    BAD(f,
        roundel_problem_add_inequalities_csr(p, 3, rows, 2, columns, one, 2, nan_last, one, &first),
        bad, "NaN", 1);
    BAD(f, roundel_problem_add_inequalities_csr(p, 3, rows, 2, columns, one, 2, one, below, &first),
        bad, "entry 1 has the lower limit 1 above the upper limit 0.5", 1);
    BAD(f, roundel_problem_add_inequalities_csr(p, 3, rows, 2, columns, one, 2, NULL, one, &first),
        null, "lower sides", NONE);
    BAD(f, roundel_problem_add_inequalities_csr(p, 3, rows, 2, columns, one, 2, one, NULL, &first),
        null, "upper sides", NONE);
    BAD(f, roundel_problem_add_inequalities_csr(p, 3, NULL, 2, columns, one, 2, one, one, &first),
        null, "matrix offsets", NONE);
    BAD(f,
        roundel_problem_add_inequalities_csc(p, 4, by_column, 2, row_of, one, 2, one, one, &first),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 1 is 2, outside 0..2", 1);
    BAD(f,
        roundel_problem_add_inequalities_csc_i64(p, 4, by_column64, 2, row_of64, one, 2, one, one,
                                                 &first),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 1 is 2, outside 0..2", 1);
    BAD(f, roundel_problem_add_inequalities_csc(p, 3, rows, 2, columns, one, 2, one, one, &first),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 4 entries, got 3", NONE);
    BAD(f, roundel_problem_inequality_count(p, NULL), null, "inequalities", NONE);
    GOOD(roundel_problem_inequality_count(p, &count));
    HOLDS(first == 7 && count == 0);
}

static void bounds(fixture* f) {
    const int32_t index[2] = {0, 2}, large[2] = {0, 3}, negative[1] = {-1};
    const double zero[2] = {0.0, 0.0}, below[2] = {0.0, -1.0}, nan[2] = {(double)NAN, 0.0};
    const roundel_status bad = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    double lower[3] = {7.0, 7.0, 7.0}, upper[3];
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_set_bounds(NULL, 2, index, zero, zero), null, "problem", NONE);
    BAD(f, roundel_problem_set_bounds(p, 2, NULL, zero, zero), null, "bounded variables", NONE);
    BAD(f, roundel_problem_set_bounds(p, 2, index, NULL, zero), null, "lower bounds", NONE);
    BAD(f, roundel_problem_set_bounds(p, 2, index, zero, NULL), null, "upper bounds", NONE);
    BAD(f, roundel_problem_set_bounds(p, 2, large, zero, zero), range, "entry 1 is 3", 1);
    BAD(f, roundel_problem_set_bounds(p, 2, index, zero, below), bad,
        "entry 1 has the lower limit 0 above the upper limit -1", 1);
    BAD(f, roundel_problem_set_bounds(p, 2, index, nan, zero), bad, "NaN", 0);
    BAD(f, roundel_problem_set_bounds(p, SIZE_MAX, index, zero, zero), ROUNDEL_ERROR_OVERFLOW,
        "more than memory can hold", NONE);
    BAD(f, roundel_problem_set_binaries(p, 2, large), range, "binary variables: entry 1 is 3", 1);
    BAD(f, roundel_problem_set_binaries(p, 1, negative), range, "-1", 0);
    BAD(f, roundel_problem_set_binaries(p, 1, NULL), null, "binary", NONE);
    BAD(f, roundel_problem_bounds(p, lower, upper, 2), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "expected 3 entries, got 2", NONE);
    BAD(f, roundel_problem_bounds(p, NULL, upper, 3), null, "lower bounds", NONE);
    BAD(f, roundel_problem_bounds(p, lower, NULL, 3), null, "upper bounds", NONE);
    HOLDS(lower[0] == 7.0);
    GOOD(roundel_problem_bounds(p, lower, upper, 3));
    for (size_t i = 0; i < 3; ++i) {
        HOLDS(lower[i] == -NO_LIMIT && upper[i] == NO_LIMIT);
    }
}

/* (x0 - 3)^2 + (x1 - 3)^2 with x0 + 2 x1 <= 4, x0 an integer, and x1 binary if need be. */
static roundel_problem* limited(int binary) {
    const int32_t index[2] = {0, 1};
    const double one[1] = {1.0}, row[2] = {1.0, 2.0};
    roundel_problem* p = NULL;
    size_t number = 7;
    GOOD(roundel_problem_new(2, &p));
    GOOD(roundel_problem_add_least_squares(p, 1, index, one, 3.0, 1.0, NULL));
    GOOD(roundel_problem_add_least_squares(p, 1, index + 1, one, 3.0, 1.0, NULL));
    GOOD(roundel_problem_add_inequality(p, 2, index, row, -NO_LIMIT, 4.0, &number));
    GOOD(roundel_problem_set_integers(p, 1, index));
    if (binary) {
        GOOD(roundel_problem_set_binaries(p, 1, index + 1));
    }
    HOLDS(number == 0);
    return p;
}

/* Solves and compares with values that are known by hand. */
static void gives(roundel_solver* s, double x0, double x1) {
    roundel_solution* x = NULL;
    roundel_counts counts = {0};
    double values[2] = {0.0, 0.0}, constraint = 1.0, integrality = 1.0;
    GOOD(roundel_solver_solve(s, NULL, NULL, &x));
    GOOD(roundel_solution_values(x, values, 2));
    GOOD(roundel_solution_counts(x, &counts));
    GOOD(roundel_solution_violations(x, &constraint, &integrality));
    HOLDS(fabs(values[0] - x0) < 1e-9 && fabs(values[1] - x1) < 1e-9);
    HOLDS(counts.inequalities == 1 && counts.constraints == 0 && constraint < 1e-9);
    GOOD(roundel_solution_free(x));
}

static void solved(fixture* f) {
    const double none[1] = {-NO_LIMIT}, four[1] = {4.0}, three[1] = {3.0}, nan[1] = {(double)NAN};
    const double zero[1] = {0.0}, one[1] = {1.0};
    const int32_t first[1] = {0}, second[1] = {1}, third[1] = {2};
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    double lower[2], upper[2];
    roundel_solver* s = NULL;
    roundel_solution* x = NULL;
    roundel_problem* p = limited(0);
    GOOD(roundel_solver_new(p, &s));
    GOOD(roundel_problem_free(p));
    /* x0 = 2 leaves x1 = 1 with energy 5, x0 = 1 leaves 1.5 with 6.25, x0 = 3 leaves 0.5 with 6.25.
     */
    gives(s, 2.0, 1.0);
    BAD(f, roundel_solver_set_inequality_sides(NULL, none, four, 1), null, "solver", NONE);
    BAD(f, roundel_solver_set_inequality_sides(s, NULL, four, 1), null, "lower sides", NONE);
    BAD(f, roundel_solver_set_inequality_sides(s, none, NULL, 1), null, "upper sides", NONE);
    BAD(f, roundel_solver_set_inequality_sides(s, none, four, 0), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "expected 1 entries, got 0", NONE);
    BAD(f, roundel_solver_set_inequality_sides(s, nan, four, 1), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "NaN", 0);
    BAD(f, roundel_solver_set_inequality_sides(s, four, three, 1), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "above the upper limit 3", 0);
    BAD(f, roundel_solver_set_bounds(NULL, 1, first, zero, one), null, "solver", NONE);
    BAD(f, roundel_solver_set_bounds(s, 1, NULL, zero, one), null, "bounded variables", NONE);
    BAD(f, roundel_solver_set_bounds(s, 1, third, zero, one), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "outside 0..2", 0);
    BAD(f, roundel_solver_set_bounds(s, 1, first, one, zero), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "lower limit 1 above the upper limit 0", 0);
    gives(s, 2.0, 1.0);
    GOOD(roundel_solver_set_bounds(s, 1, first, zero, one));
    gives(s, 1.0, 1.5);
    GOOD(roundel_solver_set_inequality_sides(s, none, three, 1));
    gives(s, 1.0, 1.0);
    /* x0 + 2 x1 = 4 has no point with x0 <= 1 and x1 <= 1. */
    GOOD(roundel_solver_set_inequality_sides(s, four, four, 1));
    GOOD(roundel_solver_set_bounds(s, 1, second, zero, one));
    BAD(f, roundel_solver_solve(s, NULL, NULL, &x), ROUNDEL_ERROR_INFEASIBLE, "no solution", 0);
    HOLDS(x == NULL);
    GOOD(roundel_solver_free(s));
    p = limited(1);
    GOOD(roundel_problem_bounds(p, lower, upper, 2));
    HOLDS(lower[0] == -NO_LIMIT && upper[0] == NO_LIMIT && lower[1] == 0.0 && upper[1] == 1.0);
    GOOD(roundel_solver_new(p, &s));
    gives(s, 2.0, 1.0);
    GOOD(roundel_solver_free(s));
    GOOD(roundel_problem_free(p));
}

void bad_inequalities(fixture* f) {
    single(f);
    matrix(f);
    bounds(f);
    solved(f);
}
