/* A planted defect: an array that is shorter than the length passed. AddressSanitizer must report
 * that the library reads past its end. */

#include <roundel/roundel.h>

#include <stdlib.h>

int main(void) {
    roundel_problem* problem = NULL;
    double* values = calloc(2, sizeof *values);
    int good = values != NULL && roundel_problem_new(9, &problem) == ROUNDEL_OK;
    good = good && roundel_problem_add_linear(problem, values, 9) == ROUNDEL_OK;
    roundel_problem_free(problem);
    free(values);
    return good ? 0 : 1;
}
