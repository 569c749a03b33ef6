/* A planted defect: one thread writes to an array while the library reads it in another.
 * ThreadSanitizer must report it with the library's side of the race. */

#include <roundel/roundel.h>

#include <pthread.h>

static double linear[1000];

static void* change(void* unused) {
    for (int k = 0; k < 100; ++k) {
        for (int i = 0; i < 1000; ++i) {
            linear[i] = (double)k;
        }
    }
    return unused;
}

int main(void) {
    pthread_t other;
    roundel_problem* problem = NULL;
    if (roundel_problem_new(1000, &problem) != ROUNDEL_OK ||
        pthread_create(&other, NULL, change, NULL) != 0) {
        return 1;
    }
    for (int k = 0; k < 100; ++k) {
        roundel_problem_add_linear(problem, linear, 1000);
    }
    pthread_join(other, NULL);
    roundel_problem_free(problem);
    return 0;
}
