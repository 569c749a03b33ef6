/* The layout of every struct of the C interface, which the Rust side asserts too. */

#include <roundel/roundel.h>

#include <stddef.h>

#define WORD sizeof(void*)

/* The offset of every member that is not reserved. */
#define AT(type, member, offset)                                                                   \
    _Static_assert(offsetof(type, member) == (offset), #type "." #member)

_Static_assert(sizeof(roundel_status) == 4, "statuses are 32-bit");
_Static_assert(sizeof(roundel_solve_status) == 4, "statuses are 32-bit");

_Static_assert(sizeof(roundel_monitor) == 4 * WORD, "monitor");
AT(roundel_monitor, size, 0);
AT(roundel_monitor, callback, WORD);
AT(roundel_monitor, user_data, 2 * WORD);
AT(roundel_monitor, cancel_token, 3 * WORD);

_Static_assert(sizeof(roundel_event) == (WORD == 8 ? 80 : 72), "event");
AT(roundel_event, size, 0);
AT(roundel_event, kind, WORD);
AT(roundel_event, phase, WORD + 4);
AT(roundel_event, fraction, WORD + 8);
AT(roundel_event, text, WORD + 16);
AT(roundel_event, seconds, WORD == 8 ? 32 : 24);
AT(roundel_event, energy, WORD == 8 ? 40 : 32);
AT(roundel_event, lower_bound, WORD == 8 ? 48 : 40);
AT(roundel_event, gap, WORD == 8 ? 56 : 48);
AT(roundel_event, share, WORD == 8 ? 64 : 56);
AT(roundel_event, stage, WORD == 8 ? 72 : 64);

_Static_assert(sizeof(roundel_counts) == 128, "counts");
AT(roundel_counts, variables, 0);
AT(roundel_counts, integers, 8);
AT(roundel_counts, constraints, 16);
AT(roundel_counts, reduced_integers, 24);
AT(roundel_counts, reduced_continuous, 32);
AT(roundel_counts, factor_nonzeros, 40);
AT(roundel_counts, inequalities, 48);

_Static_assert(sizeof(roundel_seconds) == 128, "seconds");
AT(roundel_seconds, eliminate, 0);
AT(roundel_seconds, factor, 8);
AT(roundel_seconds, round, 16);
AT(roundel_seconds, total, 24);

_Static_assert(sizeof(roundel_proof_report) == 64, "proof report");
AT(roundel_proof_report, energy, 0);
AT(roundel_proof_report, lower_bound, 8);
AT(roundel_proof_report, violation, 16);
AT(roundel_proof_report, nodes, 24);
AT(roundel_proof_report, stopped_by, 32);

_Static_assert(sizeof(roundel_option) == 4 * WORD + 32, "option");
AT(roundel_option, name, 0);
AT(roundel_option, default_value, WORD);
AT(roundel_option, range, 2 * WORD);
AT(roundel_option, text, 3 * WORD);
AT(roundel_option, value_type, 4 * WORD);

_Static_assert(sizeof(roundel_preset) == 2 * WORD + 48, "preset");
AT(roundel_preset, name, 0);
AT(roundel_preset, text, WORD);

int main(void) {
    return roundel_abi_version() == ROUNDEL_ABI_VERSION &&
                   roundel_version_major() == ROUNDEL_VERSION_MAJOR &&
                   roundel_version_minor() == ROUNDEL_VERSION_MINOR &&
                   roundel_version_patch() == ROUNDEL_VERSION_PATCH
               ? 0
               : 1;
}
