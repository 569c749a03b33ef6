/* Ends the program at the first condition that fails, and prints the library's error message. */

#ifndef ROUNDEL_TESTS_CHECK_H
#define ROUNDEL_TESTS_CHECK_H

#include <roundel/roundel.h>

#include <stdio.h>
#include <stdlib.h>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            char text[256];                                                                        \
            roundel_last_error_message(text, sizeof text);                                         \
            fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, text);             \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)
#define OK(call) CHECK((call) == ROUNDEL_OK)

#endif
