/* Proofs: what is written is accepted, and altered, missing and foreign files, missing pointers and
   bad options are refused. */

#include "bad_input.h"

#include <stdio.h>
#include <string.h>

static const char* const file = "bad_input.jsonl";
static const char* const altered = "bad_input_altered.jsonl";

/* Copies the proof with one text in place of another, which must be in it. */
static void alter(const char* old, const char* fresh) {
    static char text[1 << 16];
    FILE* in = fopen(file, "rb");
    FILE* out = fopen(altered, "wb");
    HOLDS(in != NULL && out != NULL);
    if (in != NULL && out != NULL) {
        const size_t length = fread(text, 1, sizeof text - 1, in);
        text[length] = '\0';
        char* at = strstr(text, old);
        HOLDS(length > 0 && length < sizeof text - 1 && at != NULL);
        if (at != NULL) {
            fwrite(text, 1, (size_t)(at - text), out);
            fputs(fresh, out);
            fputs(at + strlen(old), out);
        }
    }
    if (in != NULL) {
        fclose(in);
    }
    if (out != NULL) {
        HOLDS(fclose(out) == 0);
    }
}

static int32_t cancel(const roundel_event* event, void* user_data) {
    (void)user_data;
    return event->energy < (double)INFINITY ? ROUNDEL_FLOW_CANCEL : ROUNDEL_FLOW_CONTINUE;
}

static int is_there(const char* name) {
    FILE* in = fopen(name, "rb");
    if (in != NULL) {
        fclose(in);
    }
    return in != NULL;
}

static roundel_problem* make(double rhs) {
    const int32_t index[2] = {0, 1};
    const double one[1] = {1.0}, row[2] = {1.0, 2.0};
    roundel_problem* p = NULL;
    /* (x0 - 3.3)^2 + (x1 - 2.6)^2 with integers and x0 + 2 x1 <= rhs */
    GOOD(roundel_problem_new(2, &p));
    GOOD(roundel_problem_add_least_squares(p, 1, index, one, 3.3, 1.0, NULL));
    GOOD(roundel_problem_add_least_squares(p, 1, index + 1, one, 2.6, 1.0, NULL));
    GOOD(roundel_problem_add_inequality(p, 2, index, row, -(double)INFINITY, rhs, NULL));
    GOOD(roundel_problem_set_integers(p, 2, index));
    return p;
}

/* What is asked for and written is accepted. */
static void accepted(roundel_problem* p, roundel_solution** found) {
    roundel_proof_report told, checked;
    double energy = 0.0;
    memset(&told, -1, sizeof told);
    GOOD(roundel_problem_solve_with_proof(p, NULL, NULL, file, &told, found));
    GOOD(roundel_solution_energy(*found, &energy));
    GOOD(roundel_proof_check(file, NULL, &checked));
    HOLDS(fabs(checked.energy - energy) < 1e-12 && checked.lower_bound <= checked.energy);
    HOLDS(checked.energy - checked.lower_bound < 1e-8 && checked.violation <= 1e-9);
    HOLDS(told.energy == checked.energy && told.lower_bound == checked.lower_bound);
    HOLDS(told.nodes == checked.nodes && told.nodes > 0 && told.reserved[6] == 0);
    HOLDS(told.stopped_by == ROUNDEL_STOPPED_BY_NONE && checked.stopped_by == told.stopped_by);
    GOOD(roundel_proof_check(file, p, NULL));
}

static void refused(fixture* f, roundel_problem* p) {
    const roundel_status no = ROUNDEL_ERROR_PROOF_REFUSED;
    roundel_proof_report report;
    roundel_problem* other = make(7.75);
    memset(&report, 7, sizeof report);
    alter("\"values\":[", "\"values\":[1");
    BAD_LINE(f, "value", roundel_proof_check(altered, p, &report), no, "refused", NONE, 3);
    alter("{\"root\"", "{\"rooted\"");
    BAD_LINE(f, "format", roundel_proof_check(altered, NULL, &report), no, "(format)", NONE, 4);
    alter("{\"end\":", "{\"end\":1");
    HOLDS(roundel_proof_check(altered, NULL, &report) == no && roundel_last_error_line() > 4);
    BAD_LINE(f, "other", roundel_proof_check(file, other, &report), no, "(other_problem)", NONE, 2);
    BAD_LINE(f, "unknown", roundel_proof_check("no/such.jsonl", NULL, &report), ROUNDEL_ERROR_IO,
             "no/such.jsonl", NONE, NONE);
    BAD(f, roundel_proof_check(NULL, p, &report), ROUNDEL_ERROR_NULL_POINTER, "file", NONE);
    const unsigned char* bytes = (const unsigned char*)&report;
    HOLDS(bytes[0] == 7 && bytes[sizeof report - 1] == 7);
    GOOD(roundel_problem_free(other));
}

void bad_proofs(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const int32_t index[2] = {0, 1};
    const double even[2] = {2.0, 4.0};
    roundel_problem* p = make(7.5);
    roundel_solution* found = NULL;
    roundel_options* greedy = NULL;
    roundel_monitor monitor = {sizeof monitor, cancel, NULL, NULL};
    roundel_proof_report report;
    remove(file);
    BAD(f, roundel_problem_solve_with_proof(NULL, NULL, NULL, file, NULL, &found), null, "problem",
        NONE);
    BAD(f, roundel_problem_solve_with_proof(p, NULL, NULL, NULL, NULL, &found), null, "file", NONE);
    BAD(f, roundel_problem_solve_with_proof(p, NULL, NULL, file, NULL, NULL), null, "solution",
        NONE);
    BAD(f, roundel_problem_solve_with_proof(p, NULL, NULL, "no/such/dir.jsonl", NULL, &found),
        ROUNDEL_ERROR_IO, "no/such/dir.jsonl", NONE);
    GOOD(roundel_options_new(&greedy));
    GOOD(roundel_options_set_text(greedy, "strategy", "greedy"));
    BAD(f, roundel_problem_solve_with_proof(p, greedy, NULL, file, NULL, &found),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "greedy", NONE);
    GOOD(roundel_options_free(greedy));
    HOLDS(found == NULL && !is_there(file));

    /* A cancelled solve keeps its solution, and no proof is written. */
    GOOD(roundel_problem_solve_with_proof(p, NULL, &monitor, file, &report, &found));
    HOLDS(found != NULL && !is_there(file) && report.nodes == 0);
    HOLDS(report.stopped_by == ROUNDEL_STOPPED_BY_CANCEL);
    GOOD(roundel_solution_free(found));
    found = NULL;

    accepted(p, &found);
    GOOD(roundel_solution_free(found));
    found = NULL;
    refused(f, p);

    /* 2 x0 + 4 x1 = 3: the proof is written that there is no point. */
    GOOD(roundel_problem_add_constraint(p, 2, index, even, 3.0));
    BAD(f, roundel_problem_solve_with_proof(p, NULL, NULL, file, &report, &found),
        ROUNDEL_ERROR_NO_INTEGER_SOLUTION, "constraint 0", 0);
    HOLDS(found == NULL);
    GOOD(roundel_proof_check(file, p, &report));
    HOLDS(isinf(report.energy) && isinf(report.lower_bound) && report.lower_bound > 0.0);
    GOOD(roundel_problem_free(p));
    remove(file);
    remove(altered);
}
