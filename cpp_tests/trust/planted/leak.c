/* A planted defect: a problem that is never freed. LeakSanitizer and valgrind must report it. */

#include <roundel/roundel.h>

int main(void) {
    roundel_problem* problem = NULL;
    return roundel_problem_new(3, &problem) == ROUNDEL_OK ? 0 : 1;
}
