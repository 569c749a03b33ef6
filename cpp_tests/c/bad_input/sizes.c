/* Running out of memory gives a status, wherever in a call it happens: the limit on the address
 * space grows in small steps until the call succeeds. */

#define _POSIX_C_SOURCE 200809L

#include "bad_input.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

/* Entries of the large arrays, and the step between two limits. */
#define COUNT ((size_t)1 << 20)
#define STEP ((size_t)3 << 20)

static int32_t* zeros;
static int32_t* offsets;
static double* values;

typedef roundel_status (*large_call)(roundel_problem* p);

static roundel_status triplets(roundel_problem* p) {
    return roundel_problem_add_quadratic_triplets(p, ROUNDEL_TRIANGLE_FULL, COUNT, zeros, zeros,
                                                  values);
}

static roundel_status lower(roundel_problem* p) {
    return roundel_problem_add_quadratic_triplets(p, ROUNDEL_TRIANGLE_LOWER, COUNT, zeros, zeros,
                                                  values);
}

static roundel_status least_squares(roundel_problem* p) {
    return roundel_problem_add_least_squares(p, COUNT, zeros, values, 0.0, 1.0, NULL);
}

static roundel_status weighted_rows(roundel_problem* p) {
    return roundel_problem_add_least_squares_csr(p, COUNT + 1, offsets, COUNT, zeros, values, COUNT,
                                                 values, values, NULL);
}

static roundel_status by_rows(roundel_problem* p) {
    return roundel_problem_add_constraints_csr(p, COUNT + 1, offsets, COUNT, zeros, values, COUNT,
                                               values, NULL);
}

static roundel_status by_columns(roundel_problem* p) {
    int32_t ends[4] = {0, (int32_t)COUNT, (int32_t)COUNT, (int32_t)COUNT};
    return roundel_problem_add_constraints_csc(p, 4, ends, COUNT, offsets, values, COUNT, values,
                                               NULL);
}

static roundel_status many(roundel_problem* p) {
    roundel_problem* other = NULL;
    (void)p;
    const roundel_status status = roundel_problem_new(COUNT, &other);
    roundel_problem_free(other);
    return status;
}

/* Bytes of address space in use, or 0 where the system does not tell. */
static size_t in_use(void) {
    size_t pages = 0;
    FILE* file = fopen("/proc/self/statm", "r");
    if (file == NULL) {
        return 0;
    }
    if (fscanf(file, "%zu", &pages) != 1) {
        pages = 0;
    }
    fclose(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static roundel_status limited(large_call call, roundel_problem* p, size_t room) {
    struct rlimit before, tight;
    HOLDS(getrlimit(RLIMIT_AS, &before) == 0);
    tight = before;
    tight.rlim_cur = in_use() + room;
    HOLDS(setrlimit(RLIMIT_AS, &tight) == 0);
    const roundel_status status = call(p);
    HOLDS(setrlimit(RLIMIT_AS, &before) == 0);
    return status;
}

static void sweep(fixture* f, const char* name, large_call call) {
    roundel_problem* p = NULL;
    int refused = 0;
    GOOD(roundel_problem_new(3, &p));
    for (size_t room = 0; room < 200 * STEP; room += STEP) {
        size_t count = 7;
        const roundel_status status = limited(call, p, room);
        if (status == ROUNDEL_OK) {
            break;
        }
        ++refused;
        held(f, name, status,
             (expectation){ROUNDEL_ERROR_OUT_OF_MEMORY, "not enough memory", NONE, NONE});
        GOOD(roundel_problem_constraint_count(p, &count));
        HOLDS(count == 0);
    }
    HOLDS(refused > 0);
    GOOD(roundel_problem_free(p));
}

/* AddressSanitizer keeps records of its own, and ends the program if it has no memory for them. */
#ifdef __SANITIZE_ADDRESS__
static const int is_watched = 1;
#else
static const int is_watched = 0;
#endif

void bad_sizes(fixture* f) {
    if (is_watched || in_use() == 0) {
        return;
    }
    zeros = calloc(COUNT, sizeof *zeros);
    offsets = calloc(COUNT + 1, sizeof *offsets);
    values = calloc(COUNT, sizeof *values);
    HOLDS(zeros && offsets && values);
    for (size_t i = 0; i <= COUNT; ++i) {
        offsets[i] = (int32_t)i;
    }
    sweep(f, "roundel_problem_new", many);
    sweep(f, "roundel_problem_add_quadratic_triplets, full", triplets);
    sweep(f, "roundel_problem_add_quadratic_triplets, lower", lower);
    sweep(f, "roundel_problem_add_least_squares", least_squares);
    sweep(f, "roundel_problem_add_least_squares_csr", weighted_rows);
    sweep(f, "roundel_problem_add_constraints_csr", by_rows);
    sweep(f, "roundel_problem_add_constraints_csc", by_columns);
    free(zeros);
    free(offsets);
    free(values);
}
