/* Well-formed problems that have no solution. */

#include "bad_input.h"

static const int32_t x[4] = {0, 1, 2, 3};

/* x0^2 + x1^2 + x2^2 + x3^2. */
static roundel_problem* convex(void) {
    const double two[4] = {2.0, 2.0, 2.0, 2.0};
    roundel_problem* p = NULL;
    GOOD(roundel_problem_new(4, &p));
    GOOD(roundel_problem_add_quadratic_triplets(p, ROUNDEL_TRIANGLE_FULL, 4, x, x, two));
    return p;
}

static void solves(const roundel_problem* p) {
    roundel_solution* s = NULL;
    GOOD(roundel_problem_solve(p, NULL, NULL, &s));
    GOOD(roundel_solution_free(s));
}

/* The handle still accepts and answers calls, although no change can repair its constraints. */
static void answers(roundel_problem* p) {
    size_t count = 0;
    GOOD(roundel_problem_add_constant(p, 1.0));
    GOOD(roundel_problem_constraint_count(p, &count));
    GOOD(roundel_problem_free(p));
}

static void contradictory(fixture* f) {
    const double ones[3] = {1.0, 1.0, 1.0}, sum[2] = {1.0, 2.0};
    roundel_solution* s = NULL;
    roundel_problem* p = convex();
    GOOD(roundel_problem_add_constraint(p, 1, x, ones, 5.0));
    GOOD(roundel_problem_add_constraint(p, 0, NULL, NULL, 1.0));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_INFEASIBLE,
        "constraint 1: 0 = 1", 1);
    answers(p);

    p = convex();
    GOOD(roundel_problem_add_constraint(p, 2, x, sum, 5.0));
    GOOD(roundel_problem_add_constraint(p, 2, x, sum, 5.0));
    GOOD(roundel_problem_add_constraint(p, 2, x, sum, 6.0));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_INFEASIBLE,
        "constraint 2: x0 + 2 x1 = 6", 2);
    answers(p);

    p = convex();
    GOOD(roundel_problem_pin(p, 0, 1.0));
    GOOD(roundel_problem_add_constraint(p, 1, x + 1, ones, 3.0));
    GOOD(roundel_problem_add_constraint(p, 1, x, ones, 2.0));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_INFEASIBLE,
        "constraint 1: x0 = 2", 1);
    GOOD(roundel_problem_unpin(p, 0));
    solves(p);
    answers(p);
    HOLDS(s == NULL);
}

static void non_integral(fixture* f) {
    const double even[2] = {2.0, 4.0}, three[1] = {3.0}, one[1] = {1.0};
    roundel_solution* s = NULL;
    roundel_problem* p = convex();
    GOOD(roundel_problem_set_integers(p, 2, x));
    GOOD(roundel_problem_add_constraint(p, 1, x + 2, one, 1.0));
    GOOD(roundel_problem_add_constraint(p, 2, x, even, 3.0));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_NO_INTEGER_SOLUTION,
        "constraint 1: 2 x0 + 4 x1 = 3", 1);
    answers(p);

    p = convex();
    GOOD(roundel_problem_set_integers(p, 1, x));
    GOOD(roundel_problem_add_constraint(p, 1, x, three, 1.0));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_NO_INTEGER_SOLUTION,
        "constraint 0", 0);
    answers(p);

    p = convex();
    GOOD(roundel_problem_set_integers(p, 2, x));
    GOOD(roundel_problem_pin(p, 1, 0.5));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "variable 1 is pinned to 0.5", 1);
    GOOD(roundel_problem_pin(p, 1, 2.0));
    solves(p);
    answers(p);
    HOLDS(s == NULL);
}

static void indefinite(fixture* f) {
    const double minus[1] = {-4.0}, plus[1] = {6.0};
    double direction[4] = {0.0, 0.0, 0.0, 0.0}, untouched[3] = {7.0, 7.0, 7.0};
    roundel_solution* s = NULL;
    roundel_problem* p = convex();
    GOOD(roundel_problem_add_quadratic_triplets(p, ROUNDEL_TRIANGLE_LOWER, 1, x + 2, x + 2, minus));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_NOT_CONVEX, "variable 2", 2);
    HOLDS(roundel_problem_solve(p, NULL, NULL, &s) == ROUNDEL_ERROR_NOT_CONVEX);
    GOOD(roundel_last_error_direction(direction, 4));
    HOLDS(fabs(direction[2]) == 1.0 && direction[0] == 0.0);
    BAD(f, roundel_last_error_direction(untouched, 3), ROUNDEL_ERROR_LENGTH_MISMATCH, "direction",
        NONE);
    HOLDS(untouched[0] == 7.0 && s == NULL);
    GOOD(roundel_problem_add_quadratic_triplets(p, ROUNDEL_TRIANGLE_LOWER, 1, x + 2, x + 2, plus));
    solves(p);
    answers(p);
}

static void unbounded(fixture* f) {
    double direction[4] = {0.0, 0.0, 0.0, 0.0};
    const double two[1] = {2.0};
    roundel_solution* s = NULL;
    roundel_problem* p = NULL;
    GOOD(roundel_problem_new(4, &p));
    solves(p);
    GOOD(roundel_problem_add_linear_term(p, 3, -1.0));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_UNBOUNDED, "variable 3", 3);
    HOLDS(roundel_problem_solve(p, NULL, NULL, &s) == ROUNDEL_ERROR_UNBOUNDED);
    GOOD(roundel_last_error_direction(direction, 4));
    HOLDS(direction[3] == 1.0 && s == NULL);
    GOOD(roundel_problem_add_quadratic_triplets(p, ROUNDEL_TRIANGLE_FULL, 1, x + 3, x + 3, two));
    solves(p);
    answers(p);
}

/* Sums that overflow a double, which is noticed when the model is assembled. */
static void overflowing(fixture* f) {
    const double large[1] = {1.5e308};
    roundel_solution* s = NULL;
    roundel_problem* p = convex();
    GOOD(roundel_problem_add_linear_term(p, 1, large[0]));
    GOOD(roundel_problem_add_linear_term(p, 1, large[0]));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_OVERFLOW, "variable 1", 1);
    answers(p);
    p = convex();
    GOOD(roundel_problem_add_least_squares(p, 1, x, large, 1.0, 1.0, NULL));
    BAD(f, roundel_problem_solve(p, NULL, NULL, &s), ROUNDEL_ERROR_OVERFLOW, "(0, 0)", 0);
    answers(p);
    HOLDS(s == NULL);
}

void bad_problems(fixture* f) {
    contradictory(f);
    non_integral(f);
    indefinite(f);
    unbounded(f);
    overflowing(f);
}
