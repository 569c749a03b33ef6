/* A planted defect: a sum of ints that overflows. UndefinedBehaviorSanitizer must report it. */

#include <limits.h>

int main(int argc, char** argv) {
    (void)argv;
    const int sum = INT_MAX + argc;
    return sum == 0 ? 1 : 0;
}
