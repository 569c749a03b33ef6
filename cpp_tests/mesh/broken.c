/* The C interface refuses each broken mesh of the archive with its status and the element at fault,
 * and accepts a sound one. */

#include <roundel/roundel.h>

#include <stdio.h>
#include <string.h>

typedef struct {
    const char* name;
    roundel_status status;
    long long index;
} refusal;

static const refusal refusals[] = {
    {"blobby-shuffled", ROUNDEL_ERROR_INCONSISTENT_ORIENTATION, 0},
    {"cube-shuffled", ROUNDEL_ERROR_INCONSISTENT_ORIENTATION, 0},
    {"oblong-shuffled", ROUNDEL_ERROR_INCONSISTENT_ORIENTATION, 1},
    {"tet-shuffled", ROUNDEL_ERROR_INCONSISTENT_ORIENTATION, 0},
    {"cube4-shuffled", ROUNDEL_ERROR_NOT_A_TRIANGLE, 0},
    {"polygon_mesh", ROUNDEL_ERROR_NON_MANIFOLD_VERTEX, 4113},
    {"degtri_sliding", ROUNDEL_ERROR_ZERO_AREA, 2},
    {"prim", ROUNDEL_ERROR_NOT_A_TRIANGLE, 2},
    {"cube-ouvert", ROUNDEL_ERROR_ISOLATED_VERTEX, 8},
    {"no-such-file", ROUNDEL_ERROR_IO, -1},
    {"sphere", ROUNDEL_OK, -1},
};

int main(int count, char** arguments) {
    int failures = 0;
    if (count != 2) {
        return 2;
    }
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; ++i) {
        const refusal* expected = &refusals[i];
        char file[4096], text[512];
        roundel_mesh* mesh = NULL;
        if (snprintf(file, sizeof file, "%s/%s.off", arguments[1], expected->name) >=
            (int)sizeof file) {
            return 2;
        }
        const roundel_status status = roundel_mesh_read(file, &mesh);
        const int made = mesh != NULL;
        roundel_mesh_free(mesh);
        roundel_last_error_message(text, sizeof text);
        if (status != expected->status || made != (status == ROUNDEL_OK) ||
            (status != ROUNDEL_OK && roundel_last_error_index() != expected->index)) {
            fprintf(stderr, "%s: %s, index %lld: %s\n", expected->name, roundel_status_name(status),
                    (long long)roundel_last_error_index(), text);
            ++failures;
        }
    }
    return failures != 0;
}
