/* Bad integers, pins and guesses; problems with no variables and with too many. */

#include "bad_input.h"

void bad_unknowns(fixture* f) {
    const int32_t twice[3] = {2, 2, 2}, large[2] = {2, 3}, negative[1] = {-1};
    const double guess[4] = {0.0, 0.0, 0.0, 0.0}, infinite[3] = {0.0, 0.0, (double)INFINITY};
    roundel_problem *p = f->problem, *made = NULL;
    BAD(f, roundel_problem_new(0, &made), ROUNDEL_ERROR_EMPTY, "no variables", NONE);
    BAD(f, roundel_problem_new((size_t)1 << 31, &made), ROUNDEL_ERROR_OVERFLOW, "2147483648", NONE);
    BAD(f, roundel_problem_new((size_t)-1, &made), ROUNDEL_ERROR_OVERFLOW, "2^31", NONE);
    HOLDS(made == NULL);
    BAD(f, roundel_problem_set_integers(p, 2, large), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "integer variables: entry 1 is 3", 1);
    BAD(f, roundel_problem_set_integers(p, 1, negative), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "-1", 0);
    BAD(f, roundel_problem_set_integers(p, 1, NULL), ROUNDEL_ERROR_NULL_POINTER, "integer", NONE);
    GOOD(roundel_problem_set_integers(p, 3, twice));
    BAD(f, roundel_problem_pin(p, 3, 1.0), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "outside 0..3", 0);
    BAD(f, roundel_problem_pin(p, INT64_MIN, 1.0), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "-9223372036854775808", 0);
    BAD(f, roundel_problem_pin(p, 0, (double)NAN), ROUNDEL_ERROR_NOT_FINITE, "pinned", 0);
    BAD(f, roundel_problem_unpin(p, INT64_MAX), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "9223372036854775807", 0);
    GOOD(roundel_problem_unpin(p, 0));
    BAD(f, roundel_problem_set_guess(p, guess, 4), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "initial guess: expected 3 entries, got 4", NONE);
    BAD(f, roundel_problem_set_guess(p, NULL, 3), ROUNDEL_ERROR_NULL_POINTER, "guess", NONE);
    BAD(f, roundel_problem_set_guess(p, infinite, 3), ROUNDEL_ERROR_NOT_FINITE, "guess", 2);
}
