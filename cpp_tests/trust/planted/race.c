/* A planted defect: two threads write to one int. ThreadSanitizer must report it. */

#include <pthread.h>
#include <stddef.h>

static int shared;

static void* count(void* unused) {
    for (int k = 0; k < 10000; ++k) {
        ++shared;
    }
    return unused;
}

int main(void) {
    pthread_t other;
    if (pthread_create(&other, NULL, count, NULL) != 0) {
        return 1;
    }
    count(NULL);
    pthread_join(other, NULL);
    return shared > 0 ? 0 : 1;
}
