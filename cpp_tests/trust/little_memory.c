/*
 * Calls the library with less and less address space than it needs: a call succeeds or ends in
 * ROUNDEL_ERROR_OUT_OF_MEMORY, never in an abort, and the same handles serve the same call once
 * there is memory again. Each call is made in a process of its own. The arguments are a mesh, and
 * the number of steps from all that a call needs to nothing; 25 if there is none.
 */

#define _POSIX_C_SOURCE 200809L

#include <roundel/roundel.h>

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* What calls work on, made with all memory that there is. */
static roundel_mesh* mesh;
static roundel_field* field;
static roundel_map* map;
static roundel_soup* soup;
static roundel_problem* angles;
static roundel_problem* grid;
static roundel_problem* current;
static const char* strategy;
static const char* file;

static roundel_status solve(void) {
    roundel_options* options = NULL;
    roundel_solution* solution = NULL;
    roundel_status status = roundel_options_new(&options);
    if (status == ROUNDEL_OK) {
        status = roundel_options_set_text(options, "strategy", strategy);
    }
    if (status == ROUNDEL_OK) {
        status = roundel_options_set_int(options, "nodes", 2000);
    }
    if (status == ROUNDEL_OK) {
        status = roundel_problem_solve(current, options, NULL, &solution);
    }
    roundel_solution_free(solution);
    roundel_options_free(options);
    return status;
}

static roundel_status solve_map(void) {
    return roundel_map_solve(map, NULL, NULL);
}

/* Defines a call that makes an object of this type, and frees it. */
#define MAKES(name, type, call)                                                                    \
    static roundel_status name(void) {                                                             \
        roundel_##type* made = NULL;                                                               \
        const roundel_status status = call;                                                        \
        roundel_##type##_free(made);                                                               \
        return status;                                                                             \
    }

MAKES(solve_field, field, roundel_field_solve(mesh, NULL, NULL, NULL, &made))
MAKES(make_map, map, roundel_map_new(mesh, field, NULL, &made))
MAKES(make_quads, quads, roundel_quads_make(mesh, NULL, NULL, &made))
MAKES(extract_quads, quads, roundel_quads_extract(map, &made))
MAKES(make_mesh, mesh, roundel_mesh_make_shape("torus", 20000, &made))
MAKES(make_problem, problem, roundel_field_make_problem(mesh, NULL, &made))
MAKES(repair, repair, roundel_soup_repair(soup, NULL, &made))
MAKES(read_soup, soup, roundel_soup_read(file, &made))
MAKES(read_mesh, mesh, roundel_mesh_read(file, &made))

/* Bytes of address space in use, now or at most. */
static size_t address_space(const char* which) {
    char line[256];
    size_t kilobytes = 0;
    FILE* status = fopen("/proc/self/status", "r");
    while (status != NULL && fgets(line, sizeof line, status) != NULL) {
        if (strncmp(line, which, strlen(which)) == 0) {
            kilobytes = strtoul(line + strlen(which), NULL, 10);
        }
    }
    if (status != NULL) {
        fclose(status);
    }
    return kilobytes << 10;
}

enum { SUCCEEDED, REFUSED, FAILED, ABORTED };

/* What becomes of a call in a process with so much room beyond what is in use. */
static int outcome(roundel_status (*call)(void), size_t room) {
    const pid_t child = fork();
    if (child == 0) {
        struct rlimit before, tight;
        getrlimit(RLIMIT_AS, &before);
        tight = before;
        tight.rlim_cur = address_space("VmSize:") + room;
        setrlimit(RLIMIT_AS, &tight);
        const roundel_status status = call();
        setrlimit(RLIMIT_AS, &before);
        if (status == ROUNDEL_OK) {
            _exit(SUCCEEDED);
        }
        if (status != ROUNDEL_ERROR_OUT_OF_MEMORY || call() != ROUNDEL_OK) {
            _exit(FAILED);
        }
        _exit(REFUSED);
    }
    int ended = 0;
    if (child < 0 || waitpid(child, &ended, 0) != child) {
        return FAILED;
    }
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : ABORTED;
}

/* Less than what a thread of its own takes, so that a call makes do with one. */
#define ONE_THREAD ((size_t)150 << 20)

/* The address space that a call takes if it has as much as it likes, or what it makes do with. */
static size_t needed(roundel_status (*call)(void)) {
    int ends[2];
    size_t need = 0;
    if (pipe(ends) != 0) {
        return 0;
    }
    const pid_t child = fork();
    if (child == 0) {
        const size_t before = address_space("VmSize:");
        struct rlimit limit;
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = before + ONE_THREAD;
        setrlimit(RLIMIT_AS, &limit);
        const roundel_status status = call();
        need = status == ROUNDEL_OK ? address_space("VmPeak:") - before : 0;
        _exit(write(ends[1], &need, sizeof need) != sizeof need);
    }
    close(ends[1]);
    if (child < 0 || read(ends[0], &need, sizeof need) != sizeof need) {
        need = 0;
    }
    close(ends[0]);
    waitpid(child, NULL, 0);
    return need;
}

static int steps = 25;

static int sweep(const char* name, roundel_status (*call)(void)) {
    int count[4] = {0};
    const size_t need = needed(call);
    for (int step = steps; step >= 0; --step) {
        ++count[outcome(call, need / (size_t)steps * (size_t)step)];
    }
    printf("%-24s %8.1f MB: %3d succeed, %3d refused, %3d failed, %3d aborted\n", name,
           (double)need / 1048576.0, count[SUCCEEDED], count[REFUSED], count[FAILED],
           count[ABORTED]);
    fflush(stdout);
    return need > 0 && count[FAILED] + count[ABORTED] == 0;
}

static int make(void) {
    return roundel_mesh_make_shape("torus", 6000, &mesh) == ROUNDEL_OK &&
           roundel_field_solve(mesh, NULL, NULL, NULL, &field) == ROUNDEL_OK &&
           roundel_map_new(mesh, field, NULL, &map) == ROUNDEL_OK &&
           roundel_map_solve(map, NULL, NULL) == ROUNDEL_OK &&
           roundel_map_make_problem(map, &grid) == ROUNDEL_OK &&
           roundel_field_make_problem(mesh, NULL, &angles) == ROUNDEL_OK;
}

int main(int argc, char** argv) {
    static const char* const strategies[] = {"relax",    "direct",  "greedy", "adaptive",
                                             "multiple", "lattice", "exact",  "auto"};
    /* Messages of an abort are of no interest here. */
    if (freopen("/dev/null", "w", stderr) == NULL || argc < 2) {
        return 2;
    }
    /* Memory that is freed returns to the system, so that a call has no more than it is given. */
    if (mallopt(M_MMAP_THRESHOLD, 1 << 16) != 1 || mallopt(M_TRIM_THRESHOLD, 1 << 16) != 1 ||
        mallopt(M_ARENA_MAX, 1) != 1) {
        return 2;
    }
    file = argv[1];
    steps = argc > 2 ? atoi(argv[2]) : steps;
    if (steps < 1 || address_space("VmPeak:") == 0) {
        return 2;
    }
    int good = 1;
    good &= sweep("mesh", make_mesh);
    good &= sweep("soup", read_soup);
    good &= sweep("mesh of a file", read_mesh);
    if (roundel_soup_read(file, &soup) != ROUNDEL_OK) {
        return 2;
    }
    good &= sweep("repair", repair);
    if (!make()) {
        return 2;
    }
    good &= sweep("problem", make_problem);
    for (size_t k = 0; k < sizeof strategies / sizeof *strategies; ++k) {
        strategy = strategies[k];
        current = angles;
        good &= sweep(strategy, solve);
        current = grid;
        good &= sweep(strategy, solve);
    }
    good &= sweep("field", solve_field);
    good &= sweep("map", make_map);
    good &= sweep("solve of a map", solve_map);
    good &= sweep("extraction", extract_quads);
    good &= sweep("quads", make_quads);
    return good ? 0 : 1;
}
