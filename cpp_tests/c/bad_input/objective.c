/* Bad quadratic, linear and least-squares terms. */

#include "bad_input.h"

static const int32_t full = ROUNDEL_TRIANGLE_FULL;
static const int32_t upper = ROUNDEL_TRIANGLE_UPPER;
static const int32_t lower = ROUNDEL_TRIANGLE_LOWER;

static void triplets(fixture* f) {
    const int32_t diagonal[3] = {0, 1, 2};
    const int32_t negative[3] = {0, -1, 2};
    const int32_t large[3] = {0, 1, 3};
    const int64_t huge[3] = {0, (int64_t)1 << 40, 2};
    const int64_t wide[3] = {0, 1, 2};
    const int32_t above[1] = {0}, below[1] = {2};
    const double ones[3] = {1.0, 1.0, 1.0};
    const double nan_last[3] = {1.0, 1.0, (double)NAN};
    const double infinite[3] = {(double)INFINITY, 1.0, 1.0};
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_quadratic_triplets(p, 3, 3, diagonal, diagonal, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "triangle 3", NONE);
    BAD(f, roundel_problem_add_quadratic_triplets(p, -1, 3, diagonal, diagonal, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "triangle -1", NONE);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, NULL, diagonal, ones),
        ROUNDEL_ERROR_NULL_POINTER, "rows", NONE);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, diagonal, NULL, ones),
        ROUNDEL_ERROR_NULL_POINTER, "columns", NONE);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, diagonal, diagonal, NULL),
        ROUNDEL_ERROR_NULL_POINTER, "values", NONE);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, negative, diagonal, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "-1", 1);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, diagonal, large, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "outside 0..3", 2);
    BAD(f, roundel_problem_add_quadratic_triplets_i64(p, full, 3, huge, wide, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "1099511627776", 1);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, diagonal, diagonal, nan_last),
        ROUNDEL_ERROR_NOT_FINITE, "quadratic values", 2);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 3, diagonal, diagonal, infinite),
        ROUNDEL_ERROR_NOT_FINITE, "quadratic values", 0);
    BAD(f, roundel_problem_add_quadratic_triplets(p, upper, 1, below, above, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "upper", 0);
    BAD(f, roundel_problem_add_quadratic_triplets(p, lower, 1, above, below, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "lower", 0);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, 1, above, below, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "not symmetric", 0);
    BAD(f, roundel_problem_add_quadratic_triplets(p, full, SIZE_MAX, diagonal, diagonal, ones),
        ROUNDEL_ERROR_OVERFLOW, "more than memory can hold", NONE);
    GOOD(roundel_problem_add_quadratic_triplets(p, full, 0, NULL, NULL, NULL));
}

static void compressed(fixture* f) {
    const int32_t offsets[4] = {0, 1, 2, 3};
    const int32_t falling[4] = {0, 2, 1, 3};
    const int32_t negative[4] = {0, -1, 2, 3};
    const int32_t late[4] = {1, 1, 2, 3};
    const int32_t far[4] = {0, 1, 2, 9};
    const int32_t few[4] = {0, 1, 2, 2};
    const int32_t diagonal[3] = {0, 1, 2};
    const int32_t large[3] = {0, 1, 3};
    const int64_t offsets64[4] = {0, 1, 2, 3};
    const int64_t negative64[3] = {0, 1, -2};
    const double ones[3] = {1.0, 1.0, 1.0};
    const double nan_first[3] = {(double)NAN, 1.0, 1.0};
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_quadratic_csc(p, 9, 4, offsets, 3, diagonal, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "triangle 9", NONE);
    BAD(f, roundel_problem_add_quadratic_csc(p, full, 3, offsets, 3, diagonal, ones),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "matrix offsets: expected 4 entries, got 3", NONE);
    BAD(f, roundel_problem_add_quadratic_csc(p, full, 0, NULL, 3, diagonal, ones),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "matrix offsets", NONE);
    BAD(f, roundel_problem_add_quadratic_csc(p, full, 4, NULL, 3, diagonal, ones),
        ROUNDEL_ERROR_NULL_POINTER, "matrix offsets", NONE);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, offsets, 3, NULL, ones),
        ROUNDEL_ERROR_NULL_POINTER, "matrix indices", NONE);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, offsets, 3, diagonal, NULL),
        ROUNDEL_ERROR_NULL_POINTER, "matrix values", NONE);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, falling, 3, diagonal, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "offset 2", 2);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, late, 3, diagonal, ones),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "offset 0", 0);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, negative, 3, diagonal, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "matrix offsets", 1);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, far, 3, diagonal, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "matrix offsets", 3);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, few, 3, diagonal, ones),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "matrix indices: expected 2 entries, got 3", NONE);
    BAD(f, roundel_problem_add_quadratic_csr(p, full, 4, offsets, 3, large, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "matrix indices", 2);
    BAD(f, roundel_problem_add_quadratic_csc_i64(p, full, 4, offsets64, 3, negative64, ones),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "-2", 2);
    BAD(f, roundel_problem_add_quadratic_csc(p, full, 4, offsets, 3, diagonal, nan_first),
        ROUNDEL_ERROR_NOT_FINITE, "matrix values", 0);
}

static void linear(fixture* f) {
    const double ones[4] = {1.0, 1.0, 1.0, 1.0};
    const double nan_middle[3] = {1.0, (double)NAN, 1.0};
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_linear(p, ones, 2), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "linear terms: expected 3 entries, got 2", NONE);
    BAD(f, roundel_problem_add_linear(p, ones, 4), ROUNDEL_ERROR_LENGTH_MISMATCH, "got 4", NONE);
    BAD(f, roundel_problem_add_linear(p, NULL, 3), ROUNDEL_ERROR_NULL_POINTER, "linear", NONE);
    BAD(f, roundel_problem_add_linear(p, NULL, 0), ROUNDEL_ERROR_LENGTH_MISMATCH, "linear", NONE);
    BAD(f, roundel_problem_add_linear(p, nan_middle, 3), ROUNDEL_ERROR_NOT_FINITE, "linear", 1);
    BAD(f, roundel_problem_add_linear_term(p, 3, 1.0), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "outside 0..3", 0);
    BAD(f, roundel_problem_add_linear_term(p, -1, 1.0), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "-1", 0);
    BAD(f, roundel_problem_add_linear_term(p, 0, (double)NAN), ROUNDEL_ERROR_NOT_FINITE, "linear",
        0);
    BAD(f, roundel_problem_add_constant(p, (double)-INFINITY), ROUNDEL_ERROR_NOT_FINITE, "constant",
        0);
}

static void least_squares(fixture* f) {
    const int32_t index[2] = {0, 1}, bad[2] = {0, 5};
    const double one[2] = {1.0, 1.0}, nan_last[2] = {1.0, (double)NAN};
    size_t row = 7;
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_least_squares(p, 2, NULL, one, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NULL_POINTER, "least-squares", NONE);
    BAD(f, roundel_problem_add_least_squares(p, 2, index, NULL, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NULL_POINTER, "coefficients", NONE);
    BAD(f, roundel_problem_add_least_squares(p, 2, bad, one, 0.0, 1.0, &row),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 1 is 5", 1);
    BAD(f, roundel_problem_add_least_squares(p, 2, index, nan_last, 0.0, 1.0, &row),
        ROUNDEL_ERROR_NOT_FINITE, "least-squares", 1);
    BAD(f, roundel_problem_add_least_squares(p, 2, index, one, (double)NAN, 1.0, &row),
        ROUNDEL_ERROR_NOT_FINITE, "right side", 0);
    BAD(f, roundel_problem_add_least_squares(p, 2, index, one, 0.0, (double)INFINITY, &row),
        ROUNDEL_ERROR_NOT_FINITE, "weight", 0);
    BAD(f, roundel_problem_add_least_squares(p, 2, index, one, 0.0, -1.0, &row),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "negative", NONE);
    HOLDS(row == 7);
}

static void cycles(fixture* f) {
    const int32_t offsets[2] = {0, 2}, short_offsets[2] = {0, 1};
    const int32_t rows[2] = {0, 1}, missing[2] = {0, 3};
    const int8_t signs[2] = {1, -1}, twos[2] = {1, 2};
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_hint_cycles(p, 2, offsets, 2, missing, signs),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "cycle rows", 1);
    BAD(f, roundel_problem_hint_cycles(p, 2, offsets, 2, rows, twos),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "sign 2", 1);
    BAD(f, roundel_problem_hint_cycles(p, 2, short_offsets, 2, rows, signs),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "offsets", NONE);
    BAD(f, roundel_problem_hint_cycles(p, 2, offsets, 2, rows, NULL), ROUNDEL_ERROR_NULL_POINTER,
        "cycle signs", NONE);
}

void bad_objective(fixture* f) {
    triplets(f);
    compressed(f);
    linear(f);
    least_squares(f);
    cycles(f);
}
