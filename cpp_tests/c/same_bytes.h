/* Whether two files are the same to the byte. */

#ifndef ROUNDEL_TESTS_SAME_BYTES_H
#define ROUNDEL_TESTS_SAME_BYTES_H

#include "check.h"

#include <stdio.h>

static void same_bytes(const char* one, const char* other) {
    FILE* a = fopen(one, "rb");
    FILE* b = fopen(other, "rb");
    CHECK(a != NULL && b != NULL);
    for (int byte = 0; byte != EOF;) {
        byte = getc(a);
        CHECK(byte == getc(b));
    }
    CHECK(fclose(a) == 0 && fclose(b) == 0);
}

#endif
