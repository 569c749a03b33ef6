/* Bad constraints, one by one and as a matrix. */

#include "bad_input.h"

static void single(fixture* f) {
    const int32_t index[2] = {0, 2}, negative[2] = {-7, 0}, large[2] = {0, 3};
    const double one[2] = {1.0, 1.0}, infinite[2] = {(double)INFINITY, 1.0};
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_constraint(p, 2, NULL, one, 0.0), ROUNDEL_ERROR_NULL_POINTER,
        "constraint", NONE);
    BAD(f, roundel_problem_add_constraint(p, 2, index, NULL, 0.0), ROUNDEL_ERROR_NULL_POINTER,
        "coefficients", NONE);
    BAD(f, roundel_problem_add_constraint(p, 2, negative, one, 0.0),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 0 is -7, outside 0..3", 0);
    BAD(f, roundel_problem_add_constraint(p, 2, large, one, 0.0), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "entry 1 is 3", 1);
    BAD(f, roundel_problem_add_constraint(p, 2, index, infinite, 0.0), ROUNDEL_ERROR_NOT_FINITE,
        "entry 0", 0);
    BAD(f, roundel_problem_add_constraint(p, 2, index, one, (double)NAN), ROUNDEL_ERROR_NOT_FINITE,
        "right side", 0);
    BAD(f, roundel_problem_add_constraint(p, SIZE_MAX, index, one, 0.0), ROUNDEL_ERROR_OVERFLOW,
        "more than memory can hold", NONE);
}

static void matrix(fixture* f) {
    const int32_t rows[3] = {0, 1, 2}, falling[3] = {0, 2, 1};
    const int32_t columns[2] = {0, 1}, large[2] = {0, 3};
    const int64_t rows64[3] = {0, 1, 2}, negative64[2] = {0, -1};
    const double one[2] = {1.0, 1.0}, nan_last[2] = {1.0, (double)NAN};
    const int32_t by_column[4] = {0, 1, 2, 2}, row_of[2] = {0, 2};
    size_t first = 7, count = 7;
    roundel_problem* p = f->problem;
    BAD(f, roundel_problem_add_constraints_csr(p, 2, rows, 2, columns, one, 2, one, &first),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 3 entries, got 2", NONE);
    BAD(f, roundel_problem_add_constraints_csr(p, 3, falling, 2, columns, one, 2, one, &first),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "offset 2", 2);
    BAD(f, roundel_problem_add_constraints_csr(p, 3, rows, 2, large, one, 2, one, &first),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "matrix indices", 1);
    BAD(f, roundel_problem_add_constraints_csr_i64(p, 3, rows64, 2, negative64, one, 2, one, NULL),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "-1", 1);
    BAD(f, roundel_problem_add_constraints_csr(p, 3, rows, 2, columns, nan_last, 2, one, &first),
        ROUNDEL_ERROR_NOT_FINITE, "matrix values", 1);
    BAD(f, roundel_problem_add_constraints_csr(p, 3, rows, 2, columns, one, 2, nan_last, &first),
        ROUNDEL_ERROR_NOT_FINITE, "right sides", 1);
    BAD(f, roundel_problem_add_constraints_csr(p, 3, rows, 2, columns, one, 2, NULL, &first),
        ROUNDEL_ERROR_NULL_POINTER, "right sides", NONE);
    BAD(f, roundel_problem_add_constraints_csr(p, 3, NULL, 2, columns, one, 2, one, &first),
        ROUNDEL_ERROR_NULL_POINTER, "matrix offsets", NONE);
    BAD(f, roundel_problem_add_constraints_csc(p, 4, by_column, 2, row_of, one, 2, one, &first),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "entry 1 is 2, outside 0..2", 1);
    BAD(f, roundel_problem_add_constraints_csc(p, 3, rows, 2, columns, one, 2, one, &first),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 4 entries, got 3", NONE);
    GOOD(roundel_problem_constraint_count(p, &count));
    HOLDS(first == 7 && count == 0);
}

void bad_constraints(fixture* f) {
    single(f);
    matrix(f);
}
