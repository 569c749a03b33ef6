/* Bad least-squares rows as a matrix: each error names position and row, and nothing is added. */

#include "bad_input.h"

/* The output for the number of the first row. */
static size_t first = 7;

/* Three rows of three entries. */
static roundel_status csr(roundel_problem* p, const int32_t* starts, const int32_t* columns,
                          const double* values, const double* rhs, const double* weights) {
    return roundel_problem_add_least_squares_csr(p, 4, starts, 3, columns, values, 3, rhs, weights,
                                                 &first);
}

static void rows(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const roundel_status finite = ROUNDEL_ERROR_NOT_FINITE;
    const int32_t starts[4] = {0, 2, 2, 3}, falling[4] = {0, 2, 1, 3};
    const int32_t columns[3] = {0, 2, 1}, large[3] = {0, 2, 3};
    const int64_t starts64[4] = {0, 2, 2, 3}, negative64[3] = {0, -1, 1};
    const double one[3] = {1.0, 1.0, 1.0}, nan_last[3] = {1.0, 1.0, (double)NAN};
    const double negative[3] = {1.0, -2.0, 1.0};
    roundel_problem* p = f->problem;
    BAD(f,
        roundel_problem_add_least_squares_csr(p, 3, starts, 3, columns, one, 3, one, one, &first),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 4 entries, got 3", NONE);
    BAD(f, csr(p, falling, columns, one, one, one), ROUNDEL_ERROR_INVALID_ARGUMENT, "offset 2", 2);
    BAD(f, csr(p, starts, large, one, one, one), range, "row 2: matrix indices: entry 2 is 3", 2);
    BAD(f,
        roundel_problem_add_least_squares_csr_i64(p, 4, starts64, 3, negative64, one, 3, one, NULL,
                                                  &first),
        range, "row 0: matrix indices: entry 1 is -1", 1);
    BAD(f, csr(p, starts, columns, nan_last, one, one), finite, "row 2: matrix values: entry 2", 2);
    BAD(f, csr(p, starts, columns, one, nan_last, one), finite,
        "least-squares right sides: entry 2", 2);
    BAD(f, csr(p, starts, columns, one, one, nan_last), finite, "least-squares weights: entry 2",
        2);
    BAD(f, csr(p, starts, columns, one, one, negative), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "entry 1 is -2", 1);
    BAD(f, csr(p, NULL, columns, one, one, one), null, "matrix offsets", NONE);
    BAD(f, csr(p, starts, NULL, one, one, one), null, "matrix indices", NONE);
    BAD(f, csr(p, starts, columns, one, NULL, one), null, "right sides", NONE);
    HOLDS(first == 7);
}

static void columns(fixture* f) {
    const int32_t starts[4] = {0, 1, 1, 2}, row_of[2] = {1, 0}, large[2] = {0, 2};
    const int64_t starts64[4] = {0, 1, 1, 2}, row_of64[2] = {1, 0};
    const double one[2] = {1.0, 1.0}, nan_first[2] = {(double)NAN, 1.0};
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_least_squares_csc(p, 4, starts, 2, large, one, 2, one, NULL, NULL),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "matrix indices: entry 1 is 2", 1);
    BAD(f,
        roundel_problem_add_least_squares_csc(p, 4, starts, 2, row_of, nan_first, 2, one, NULL,
                                              NULL),
        ROUNDEL_ERROR_NOT_FINITE, "row 1: matrix values: entry 0", 0);
    BAD(f,
        roundel_problem_add_least_squares_csc_i64(p, 3, starts64, 2, row_of64, one, 2, one, NULL,
                                                  NULL),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 4 entries, got 3", NONE);
}

/* The number of the next row shows that no refused row was kept. */
static void nothing_was_added(fixture* f) {
    roundel_problem* copy = NULL;
    size_t row = 0;
    GOOD(roundel_problem_clone(f->problem, &copy));
    GOOD(roundel_problem_add_least_squares(copy, 0, NULL, NULL, 0.0, 1.0, &row));
    HOLDS(row == 3);
    GOOD(roundel_problem_free(copy));
}

void bad_least_squares(fixture* f) {
    rows(f);
    columns(f);
    nothing_was_added(f);
}
