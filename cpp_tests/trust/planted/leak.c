/* A planted defect: problems that are never freed. LeakSanitizer and valgrind must report them.
 * There are several, because LeakSanitizer takes one whose address happens to be left on the stack
 * for one in use. */

#include <roundel/roundel.h>

int main(void) {
    for (int i = 0; i < 10; i++) {
        roundel_problem* problem = NULL;
        if (roundel_problem_new(3, &problem) != ROUNDEL_OK) {
            return 1;
        }
    }
    return 0;
}
