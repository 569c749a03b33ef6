/* Options: an unknown name, a wrong type and a value out of range are three different errors. */

#include "bad_input.h"

#include <stdlib.h>
#include <string.h>

static void set(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status unknown = ROUNDEL_ERROR_UNKNOWN_OPTION;
    const roundel_status type = ROUNDEL_ERROR_OPTION_TYPE;
    const roundel_status range = ROUNDEL_ERROR_OPTION_RANGE;
    roundel_options* o = f->options;
    BAD(f, roundel_options_set_int(NULL, "threads", 1), null, "options", NONE);
    BAD(f, roundel_options_set_int(o, NULL, 1), null, "name", NONE);
    BAD(f, roundel_options_set_text(o, "strategy", NULL), null, "value", NONE);
    BAD(f, roundel_options_set_int(o, "thread", 1), unknown, "'thread'", NONE);
    BAD(f, roundel_options_set_real(o, "", 1.0), unknown, "''", NONE);
    BAD(f, roundel_options_set_text(o, "Strategy", "greedy"), unknown, "'Strategy'", NONE);
    BAD(f, roundel_options_set_int(o, "strategy", 1), type, "a word", NONE);
    BAD(f, roundel_options_set_real(o, "threads", 1.0), type, "a whole number", NONE);
    BAD(f, roundel_options_set_text(o, "time_limit", "1"), type, "a real number", NONE);
    BAD(f, roundel_options_set_int(o, "threads", -1), range, "threads", NONE);
    BAD(f, roundel_options_set_int(o, "threads", INT64_MAX), range, "[0, 1024]", NONE);
    BAD(f, roundel_options_set_real(o, "time_limit", -1.0), range, "time_limit", NONE);
    BAD(f, roundel_options_set_real(o, "time_limit", (double)NAN), range, "time_limit", NONE);
    BAD(f, roundel_options_set_text(o, "strategy", "luck"), range, "luck", NONE);
    BAD(f, roundel_options_set_text(o, "\xff\xfe", "greedy"), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "UTF-8", NONE);
}

static void get(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status type = ROUNDEL_ERROR_OPTION_TYPE;
    roundel_options* o = f->options;
    int64_t whole = 7;
    double real = 7.0;
    char word[16] = "untouched";
    size_t length = 7;
    BAD(f, roundel_options_get_int(NULL, "threads", &whole), null, "options", NONE);
    BAD(f, roundel_options_get_int(o, NULL, &whole), null, "name", NONE);
    BAD(f, roundel_options_get_int(o, "threads", NULL), null, "value", NONE);
    BAD(f, roundel_options_get_int(o, "time_limit", &whole), type, "a real number", NONE);
    BAD(f, roundel_options_get_real(o, "strategy", &real), type, "a word", NONE);
    BAD(f, roundel_options_get_real(o, "none", &real), ROUNDEL_ERROR_UNKNOWN_OPTION, "none", NONE);
    BAD(f, roundel_options_get_text(o, "threads", word, sizeof word, &length), type, "whole", NONE);
    BAD(f, roundel_options_get_text(o, "strategy", word, 6, &length), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "expected 7 entries, got 6", NONE);
    BAD(f, roundel_options_get_text(o, "strategy", NULL, 6, &length), null, "buffer", NONE);
    BAD(f, roundel_options_get_text(o, "strategy", NULL, 0, NULL), null, "buffer", NONE);
    HOLDS(whole == 7 && real == 7.0 && length == 7 && strcmp(word, "untouched") == 0);
    GOOD(roundel_options_get_text(o, "strategy", NULL, 0, &length));
    GOOD(roundel_options_get_text(o, "strategy", word, length + 1, NULL));
    HOLDS(strcmp(word, "greedy") == 0);
}

static void list(fixture* f) {
    roundel_option option;
    memset(&option, 0, sizeof option);
    BAD(f, roundel_option_info(0, NULL), ROUNDEL_ERROR_NULL_POINTER, "option", NONE);
    BAD(f, roundel_option_info(roundel_option_count(), &option), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "options", 0);
    BAD(f, roundel_option_info(SIZE_MAX, &option), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "options", 0);
    HOLDS(option.name == NULL && roundel_option_count() > 0);
}

/* Every default in the list is the value that new options have. */
static void defaults(void) {
    roundel_options* o = NULL;
    GOOD(roundel_options_new(&o));
    for (size_t i = 0; i < roundel_option_count(); ++i) {
        roundel_option option;
        int64_t whole = 0;
        double real = 0.0;
        char word[64] = "";
        GOOD(roundel_option_info(i, &option));
        HOLDS(strlen(option.range) > 0 && strlen(option.text) > 0);
        switch (option.value_type) {
        case ROUNDEL_OPTION_INT:
            GOOD(roundel_options_get_int(o, option.name, &whole));
            HOLDS(whole == strtoll(option.default_value, NULL, 10));
            break;
        case ROUNDEL_OPTION_REAL:
            GOOD(roundel_options_get_real(o, option.name, &real));
            HOLDS(real == strtod(option.default_value, NULL));
            break;
        default:
            HOLDS(option.value_type == ROUNDEL_OPTION_TEXT);
            GOOD(roundel_options_get_text(o, option.name, word, sizeof word, NULL));
            HOLDS(strcmp(word, option.default_value) == 0);
        }
    }
    GOOD(roundel_options_free(o));
}

void bad_options(fixture* f) {
    set(f);
    get(f);
    list(f);
    defaults();
}
