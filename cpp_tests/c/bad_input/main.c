/* Runs every group of cases with stdout and stderr redirected to a file, which must stay empty. */

#define _POSIX_C_SOURCE 200809L

#include "bad_input.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/* (x0 - 0.4)^2 + (x0 - x1)^2 + (x1 - x2)^2 with x2 an integer. */
static int make(fixture* f) {
    const int32_t index[3] = {0, 1, 2};
    const double coefficient[2] = {1.0, -1.0};
    return roundel_problem_new(3, &f->problem) == ROUNDEL_OK &&
           roundel_problem_add_least_squares(f->problem, 1, index, coefficient, 0.4, 1.0, NULL) ==
               ROUNDEL_OK &&
           roundel_problem_add_least_squares(f->problem, 2, index, coefficient, 0.0, 1.0, NULL) ==
               ROUNDEL_OK &&
           roundel_problem_add_least_squares(f->problem, 2, index + 1, coefficient, 0.0, 1.0,
                                             NULL) == ROUNDEL_OK &&
           roundel_problem_set_integers(f->problem, 1, index + 2) == ROUNDEL_OK &&
           roundel_options_new(&f->options) == ROUNDEL_OK &&
           roundel_cancel_token_new(&f->token) == ROUNDEL_OK &&
           roundel_problem_solve(f->problem, f->options, NULL, &f->solution) == ROUNDEL_OK &&
           roundel_solution_energy(f->solution, &f->energy) == ROUNDEL_OK &&
           roundel_solution_values(f->solution, f->values, 3) == ROUNDEL_OK;
}

int main(void) {
    char captured[] = "captured-XXXXXX";
    const int file = mkstemp(captured);
    FILE* report = fdopen(dup(STDERR_FILENO), "w");
    report_to(report);
    if (file < 0 || report == NULL || dup2(file, STDOUT_FILENO) < 0 ||
        dup2(file, STDERR_FILENO) < 0) {
        return 2;
    }
    fixture f = {0};
    HOLDS(make(&f));
    bad_handles(&f);
    bad_objective(&f);
    bad_constraints(&f);
    bad_inequalities(&f);
    bad_lazy_rows(&f);
    bad_proofs(&f);
    bad_least_squares(&f);
    bad_unknowns(&f);
    bad_options(&f);
    bad_monitors(&f);
    bad_problems(&f);
    bad_files(&f);
    bad_meshes(&f);
    bad_sizes(&f);
    bad_solvers(&f);
    bad_guidance(&f);
    bad_quads(&f);
    bad_soups(&f);
    bad_geodesics(&f);
    bad_curves(&f);
    bad_layouts(&f);
    HOLDS(roundel_solution_free(f.solution) == ROUNDEL_OK);
    HOLDS(roundel_options_free(f.options) == ROUNDEL_OK);
    HOLDS(roundel_cancel_token_free(f.token) == ROUNDEL_OK);
    HOLDS(roundel_problem_free(f.problem) == ROUNDEL_OK);

    fflush(stdout);
    fflush(stderr);
    struct stat printed;
    if (fstat(file, &printed) != 0 || printed.st_size != 0) {
        failed("everything", "something was printed");
    }
    close(file);
    unlink(captured);
    return all_held() ? 0 : 1;
}
