/* A planted defect: reads past the end of an array on the heap. AddressSanitizer must report it. */

#include <stdlib.h>

int main(int argc, char** argv) {
    (void)argv;
    int* array = calloc(4, sizeof *array);
    const int found = array == NULL ? 1 : array[3 + argc];
    free(array);
    return found == 0 ? 0 : 1;
}
