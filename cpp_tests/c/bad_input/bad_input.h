/* Bad input through the C interface: the declarations that all groups of cases share.
 *
 * A case is one call that must fail. Its status, its index and a part of its message are checked.
 * After each case the same handle must serve a valid call as if nothing had happened. */

#ifndef BAD_INPUT_H
#define BAD_INPUT_H

#include <roundel/roundel.h>

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* No index, or no line. */
#define NONE (-1)

/* A small valid problem with three variables, of which the last is an integer, solved once. */
typedef struct {
    roundel_problem* problem;
    roundel_options* options;
    roundel_solution* solution;
    roundel_cancel_token* token;
    double energy;
    double values[3];
} fixture;

/* The expected outcome of a call that fails. */
typedef struct {
    roundel_status status;
    const char* part;
    int64_t index;
    int64_t line;
} expectation;

/* Where failures are written. */
void report_to(FILE* file);
/* Whether there were enough cases, and all did as they should. */
int all_held(void);
void failed(const char* call, const char* what);
void held(fixture* f, const char* call, roundel_status status, expectation expected);
void fine(const char* call, int holds);

#define BAD(f, call, status, part, index)                                                          \
    held((f), #call, (call), (expectation){(status), (part), (index), NONE})
#define BAD_LINE(f, name, call, status, part, index, line)                                         \
    held((f), (name), (call), (expectation){(status), (part), (index), (line)})
#define GOOD(call) fine(#call, (call) == ROUNDEL_OK)
#define HOLDS(condition) fine(#condition, (condition))

void bad_handles(fixture* f);
void bad_objective(fixture* f);
void bad_constraints(fixture* f);
void bad_inequalities(fixture* f);
void bad_lazy_rows(fixture* f);
void bad_proofs(fixture* f);
void bad_least_squares(fixture* f);
void bad_unknowns(fixture* f);
void bad_options(fixture* f);
void bad_monitors(fixture* f);
void bad_problems(fixture* f);
void bad_files(fixture* f);
void bad_meshes(fixture* f);
void bad_sizes(fixture* f);
void bad_solvers(fixture* f);
void bad_guidance(fixture* f);
void bad_quads(fixture* f);
void bad_soups(fixture* f);
void bad_geodesics(fixture* f);
void bad_curves(fixture* f);
void bad_layouts(fixture* f);

#endif
