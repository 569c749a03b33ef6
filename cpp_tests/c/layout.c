/* The layout of every struct that crosses, as the Rust side asserts it too. */

#include <roundel/roundel.h>

#include <stddef.h>

#define WORD sizeof(void*)

_Static_assert(sizeof(roundel_status) == 4, "statuses are 32-bit");
_Static_assert(sizeof(roundel_solve_status) == 4, "statuses are 32-bit");
_Static_assert(sizeof(roundel_monitor) == 4 * WORD, "monitor");
_Static_assert(offsetof(roundel_monitor, callback) == WORD, "monitor.callback");
_Static_assert(offsetof(roundel_monitor, user_data) == 2 * WORD, "monitor.user_data");
_Static_assert(offsetof(roundel_monitor, cancel_token) == 3 * WORD, "monitor.cancel_token");
_Static_assert(offsetof(roundel_event, kind) == WORD, "event.kind");
_Static_assert(offsetof(roundel_event, phase) == WORD + 4, "event.phase");
_Static_assert(offsetof(roundel_event, fraction) == WORD + 8, "event.fraction");
_Static_assert(offsetof(roundel_event, text) == WORD + 16, "event.text");
_Static_assert(sizeof(roundel_event) == (WORD == 8 ? 64 : 56), "event");
_Static_assert(sizeof(roundel_counts) == 128, "counts");
_Static_assert(offsetof(roundel_counts, reduced_continuous) == 32, "counts.reduced_continuous");
_Static_assert(sizeof(roundel_seconds) == 128, "seconds");
_Static_assert(offsetof(roundel_seconds, total) == 24, "seconds.total");
_Static_assert(sizeof(roundel_option) == 4 * WORD + 32, "option");
_Static_assert(offsetof(roundel_option, value_type) == 4 * WORD, "option.value_type");

int main(void) {
    return roundel_abi_version() == ROUNDEL_ABI_VERSION &&
                   roundel_version_major() == ROUNDEL_VERSION_MAJOR &&
                   roundel_version_minor() == ROUNDEL_VERSION_MINOR &&
                   roundel_version_patch() == ROUNDEL_VERSION_PATCH
               ? 0
               : 1;
}
