/* Broken files: each is refused with its line. */

#include "bad_input.h"

#include <stdio.h>
#include <string.h>

static const char* const file = "bad_input.mps";

#define HEAD "NAME p\nROWS\n N f\n E c\n"
#define COLUMNS_PART "COLUMNS\n x f 1 c 2\n M 'MARKER' 'INTORG'\n y c 1\n M 'MARKER' 'INTEND'\n"
#define RHS_PART "RHS\n R c 3\n"
#define BOUNDS_PART "BOUNDS\n FR B x\n FR B y\n"
#define QUAD_PART "QUADOBJ\n x x 2\n y y 2\n"

typedef struct {
    const char* name;
    const char* text;
    roundel_status status;
    const char* part;
    int64_t line;
    int64_t column;
} broken;

static const broken cases[] = {
    {"empty", "", ROUNDEL_ERROR_PARSE, "", 1, NONE},
    {"no end", HEAD COLUMNS_PART RHS_PART BOUNDS_PART QUAD_PART, ROUNDEL_ERROR_PARSE, "ENDATA", 17,
     NONE},
    {"unknown section", HEAD "COLUMNZ\n", ROUNDEL_ERROR_PARSE, "COLUMNZ", 5, NONE},
    {"unknown row", HEAD "COLUMNS\n x d 1\n", ROUNDEL_ERROR_PARSE, "'d'", 6, NONE},
    {"no number", HEAD "COLUMNS\n x c one\n", ROUNDEL_ERROR_PARSE, "'one'", 6, NONE},
    {"not finite", HEAD "COLUMNS\n x c 1e999\n", ROUNDEL_ERROR_PARSE, "'1e999'", 6, NONE},
    {"too few fields", HEAD "COLUMNS\n x c\n", ROUNDEL_ERROR_PARSE, "2 fields", 6, NONE},
    {"open marker", HEAD "COLUMNS\n M 'MARKER' 'INTEND'\n", ROUNDEL_ERROR_PARSE, "INTEND", 6, NONE},
    {"row twice", "NAME p\nROWS\n N f\n E c\n E c\n", ROUNDEL_ERROR_PARSE, "'c'", 5, NONE},
    {"quadratic constraint", HEAD COLUMNS_PART RHS_PART BOUNDS_PART "QCMATRIX c\n",
     ROUNDEL_ERROR_NOT_SUPPORTED, "QCMATRIX", 15, NONE},
    {"semi-continuous", HEAD COLUMNS_PART RHS_PART "BOUNDS\n SC B x 4\n",
     ROUNDEL_ERROR_NOT_SUPPORTED, "SC", 13, NONE},
    {"crossed bounds", HEAD COLUMNS_PART RHS_PART "BOUNDS\n LO B x 2\n UP B x 1\n",
     ROUNDEL_ERROR_PARSE, "'x'", 14, NONE},
    {"not convex", "NAME p\nROWS\n N f\n L c\nCOLUMNS\n x c 1\n y c 1\nQUADOBJ\n y y -2\nENDATA\n",
     ROUNDEL_ERROR_NOT_CONVEX, "'y'", 9, 1},
    {"both triangles", HEAD COLUMNS_PART RHS_PART BOUNDS_PART "QUADOBJ\n x y 1\n y x 1\nENDATA\n",
     ROUNDEL_ERROR_PARSE, "one triangle", 17, NONE},
};

static void write(const char* name, const char* text) {
    FILE* out = fopen(name, "w");
    HOLDS(out != NULL);
    if (out) {
        HOLDS(fputs(text, out) >= 0);
        HOLDS(fclose(out) == 0);
    }
}

static void contents(fixture* f) {
    roundel_problem* p = NULL;
    size_t count = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const broken* c = &cases[i];
        write(file, c->text);
        BAD_LINE(f, c->name, roundel_problem_read_mps(file, &p), c->status, c->part, c->column,
                 c->line);
        HOLDS(p == NULL);
    }
    write(file, HEAD COLUMNS_PART RHS_PART BOUNDS_PART QUAD_PART "ENDATA\n");
    GOOD(roundel_problem_read_mps(file, &p));
    GOOD(roundel_problem_constraint_count(p, &count));
    HOLDS(count == 1);
    GOOD(roundel_problem_free(p));
    remove(file);
}

static void names(fixture* f) {
    roundel_problem* p = NULL;
    roundel_options* o = NULL;
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    BAD(f, roundel_problem_read_mps(NULL, &p), null, "file", NONE);
    BAD(f, roundel_problem_read_mps(file, NULL), null, "problem", NONE);
    BAD(f, roundel_problem_read_mps("no/such/file.mps", &p), ROUNDEL_ERROR_IO, "no/such/file.mps",
        NONE);
    BAD(f, roundel_problem_read_mps(".", &p), ROUNDEL_ERROR_IO, "", NONE);
    BAD(f, roundel_problem_write_mps(f->problem, NULL), null, "file", NONE);
    BAD(f, roundel_problem_write_mps(f->problem, "no/such/file.mps"), ROUNDEL_ERROR_IO,
        "no/such/file.mps", NONE);
    BAD(f, roundel_problem_save_replay(f->problem, NULL, "wrong.txt"),
        ROUNDEL_ERROR_INVALID_ARGUMENT, ".mps", NONE);
    BAD(f, roundel_problem_save_replay(f->problem, NULL, NULL), null, "file", NONE);
    BAD(f, roundel_problem_load_replay("no/such/file.mps", &p, &o), ROUNDEL_ERROR_IO, "replay",
        NONE);
    BAD(f, roundel_problem_load_replay(file, &p, NULL), null, "options", NONE);
    HOLDS(p == NULL && o == NULL);
}

/* A saved solve loads again and gives the same values. */
static void replay(fixture* f) {
    roundel_problem* p = NULL;
    roundel_options* o = NULL;
    roundel_solution* s = NULL;
    double values[3] = {7.0, 7.0, 7.0};
    GOOD(roundel_problem_save_replay(f->problem, f->options, file));
    GOOD(roundel_problem_load_replay(file, &p, &o));
    GOOD(roundel_problem_solve(p, o, NULL, &s));
    GOOD(roundel_solution_values(s, values, 3));
    HOLDS(memcmp(values, f->values, sizeof values) == 0);
    GOOD(roundel_solution_free(s));
    GOOD(roundel_problem_free(p));
    GOOD(roundel_options_free(o));
    p = NULL;
    o = NULL;
    write("bad_input.replay.json", "{");
    BAD_LINE(f, "a broken replay file", roundel_problem_load_replay(file, &p, &o),
             ROUNDEL_ERROR_PARSE, "", NONE, 1);
    HOLDS(p == NULL && o == NULL);
    remove(file);
    remove("bad_input.replay.json");
}

void bad_files(fixture* f) {
    contents(f);
    names(f);
    replay(f);
}
