/* Rows that come during a solve: no callback, rows that are refused, a callback that cancels, rows
   that contradict each other, and the answers of rows that are given before the solve. */

#include "bad_input.h"

typedef struct {
    int kind;
    int calls;
} asked;

static int32_t give(const roundel_candidate* candidate, roundel_problem* rows, void* user_data) {
    asked* a = user_data;
    const int32_t index[2] = {0, 1}, outside[1] = {2};
    const double row[2] = {1.0, 2.0}, one[1] = {1.0};
    a->calls += candidate->size == sizeof *candidate && candidate->count == 2;
    switch (a->kind) {
    case 0: /* x0 + 2 x1 <= 4 */
        if (candidate->values[0] + 2.0 * candidate->values[1] > 4.0) {
            GOOD(roundel_problem_add_inequality(rows, 2, index, row, -(double)INFINITY, 4.0, NULL));
        }
        return ROUNDEL_FLOW_CONTINUE;
    case 1: /* A row that is refused changes nothing. */
        HOLDS(roundel_problem_add_inequality(rows, 1, outside, one, 0.0, 1.0, NULL) ==
              ROUNDEL_ERROR_INDEX_OUT_OF_RANGE);
        return ROUNDEL_FLOW_CONTINUE;
    case 2: /* x0 = 1, a constraint. */
        GOOD(roundel_problem_add_constraint(rows, 1, index, one, 1.0));
        return ROUNDEL_FLOW_CONTINUE;
    case 3: /* x0 >= 5 and x0 <= 4 */
        GOOD(roundel_problem_add_inequality(rows, 1, index, one, 5.0, (double)INFINITY, NULL));
        GOOD(roundel_problem_add_inequality(rows, 1, index, one, -(double)INFINITY, 4.0, NULL));
        return ROUNDEL_FLOW_CONTINUE;
    default:
        return ROUNDEL_FLOW_CANCEL;
    }
}

static void gives(roundel_problem* p, int kind, double x0, double x1) {
    asked a = {kind, 0};
    roundel_solution* found = NULL;
    double x[2] = {0.0, 0.0};
    GOOD(roundel_problem_solve_lazy(p, NULL, NULL, give, &a, &found));
    GOOD(roundel_solution_values(found, x, 2));
    HOLDS(fabs(x[0] - x0) < 1e-9 && fabs(x[1] - x1) < 1e-9 && a.calls > 0);
    GOOD(roundel_solution_free(found));
}

void bad_lazy_rows(fixture* f) {
    const int32_t index[2] = {0, 1};
    const double one[1] = {1.0};
    asked a = {4, 0};
    roundel_problem* p = NULL;
    roundel_solution* found = NULL;
    /* (x0 - 3)^2 + (x1 - 3)^2 with x0 an integer */
    GOOD(roundel_problem_new(2, &p));
    GOOD(roundel_problem_add_least_squares(p, 1, index, one, 3.0, 1.0, NULL));
    GOOD(roundel_problem_add_least_squares(p, 1, index + 1, one, 3.0, 1.0, NULL));
    GOOD(roundel_problem_set_integers(p, 1, index));

    BAD(f, roundel_problem_solve_lazy(p, NULL, NULL, NULL, NULL, &found),
        ROUNDEL_ERROR_NULL_POINTER, "callback", NONE);
    BAD(f, roundel_problem_solve_lazy(NULL, NULL, NULL, give, &a, &found),
        ROUNDEL_ERROR_NULL_POINTER, "problem", NONE);
    BAD(f, roundel_problem_solve_lazy(p, NULL, NULL, give, &a, NULL), ROUNDEL_ERROR_NULL_POINTER,
        "solution", NONE);
    HOLDS(a.calls == 0 && found == NULL);
    a.kind = 3;
    BAD(f, roundel_problem_solve_lazy(p, NULL, NULL, give, &a, &found), ROUNDEL_ERROR_INFEASIBLE,
        "inequality 0", 0);
    a.kind = 4;
    BAD(f, roundel_problem_solve_lazy(p, NULL, NULL, give, &a, &found), ROUNDEL_ERROR_CANCELLED,
        "cancelled", NONE);
    HOLDS(a.calls > 0 && found == NULL);
    gives(p, 0, 2.0, 1.0);
    gives(p, 1, 3.0, 3.0);
    gives(p, 2, 1.0, 3.0);
    GOOD(roundel_problem_free(p));
}
