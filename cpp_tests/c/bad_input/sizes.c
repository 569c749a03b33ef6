/* Memory that cannot be had is a status. The address space is limited, so that it cannot. */

#define _POSIX_C_SOURCE 200809L

#include "bad_input.h"

#include <sys/resource.h>

void bad_sizes(fixture* f) {
    struct rlimit before, tight;
    roundel_problem* p = NULL;
    HOLDS(getrlimit(RLIMIT_AS, &before) == 0);
    tight = before;
    tight.rlim_cur = (rlim_t)1 << 30;
    HOLDS(setrlimit(RLIMIT_AS, &tight) == 0);
    BAD(f, roundel_problem_new(((size_t)1 << 31) - 1, &p), ROUNDEL_ERROR_OUT_OF_MEMORY,
        "not enough memory", NONE);
    HOLDS(p == NULL);
    HOLDS(setrlimit(RLIMIT_AS, &before) == 0);
}
