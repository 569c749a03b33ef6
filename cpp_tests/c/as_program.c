/* usage: as_program MESH UV.obj OTHER.obj EDGE_LENGTH DEGREES
 *
 * The C interface makes the same map of a mesh as the program, which wrote it to UV.obj: the same
 * coordinates at every corner to the last digit, and the same file when written to OTHER.obj. Edges
 * that turn by DEGREES or more are features; 0 means none. */

#include "check.h"
#include "same_bytes.h"

#include <roundel/roundel.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static const double turn = 3.14159265358979323846 / 180.0;

static roundel_map* made(const roundel_mesh* mesh, double edge_length, double degrees) {
    roundel_guidance* guidance = NULL;
    roundel_options* options = NULL;
    roundel_field* field = NULL;
    roundel_map* map = NULL;
    OK(roundel_guidance_new_for_quads(&guidance));
    if (degrees > 0.0) {
        OK(roundel_guidance_set_real(guidance, "feature_angle", degrees * turn));
    }
    /* A map's field ignores details that are smaller than a quad. */
    OK(roundel_guidance_set_real(guidance, "detail", edge_length));
    OK(roundel_options_new(&options));
    OK(roundel_options_set_text(options, "strategy", "adaptive"));
    OK(roundel_field_solve(mesh, guidance, options, NULL, &field));
    OK(roundel_map_new(mesh, field, NULL, &map));
    OK(roundel_map_set_edge_length(map, edge_length));
    OK(roundel_map_solve_fold_free(map, NULL, NULL));
    OK(roundel_field_free(field));
    OK(roundel_options_free(options));
    OK(roundel_guidance_free(guidance));
    return map;
}

/* Compares the coordinates with those of the file, corner by corner. Returns how many are integers,
 * as they are on isolines. */
static size_t compared(const char* name, const double* uv, size_t faces) {
    char line[512];
    double(*vt)[2] = malloc(3 * faces * sizeof *vt);
    size_t count = 0, corner = 0, whole = 0;
    FILE* file = fopen(name, "r");
    CHECK(file != NULL && vt != NULL);
    while (fgets(line, sizeof line, file) != NULL) {
        if (line[0] == 'v' && line[1] == 't') {
            char* rest = line + 2;
            CHECK(count < 3 * faces);
            vt[count][0] = strtod(rest, &rest);
            vt[count][1] = strtod(rest, &rest);
            ++count;
        } else if (line[0] == 'f') {
            size_t v[3], t[3];
            CHECK(sscanf(line, "f %zu/%zu %zu/%zu %zu/%zu", v, t, v + 1, t + 1, v + 2, t + 2) == 6);
            for (size_t k = 0; k < 3; ++k, ++corner) {
                CHECK(corner < 3 * faces && t[k] >= 1 && t[k] <= count);
                for (size_t c = 0; c < 2; ++c) {
                    const double value = uv[2 * corner + c];
                    CHECK(value == vt[t[k] - 1][c]);
                    whole += value == (double)(int64_t)value;
                }
            }
        }
    }
    CHECK(corner == 3 * faces);
    CHECK(fclose(file) == 0);
    free(vt);
    return whole;
}

int main(int count, char** argument) {
    roundel_mesh* mesh = NULL;
    size_t faces = 0, flipped = 1;
    CHECK(count == 6);
    const double edge_length = strtod(argument[4], NULL), degrees = strtod(argument[5], NULL);
    OK(roundel_mesh_read(argument[1], &mesh));
    OK(roundel_mesh_face_count(mesh, &faces));
    roundel_map* map = made(mesh, edge_length, degrees);
    OK(roundel_map_flipped_face_count(map, &flipped));
    CHECK(flipped == 0);
    double* uv = malloc(6 * faces * sizeof *uv);
    CHECK(uv != NULL);
    OK(roundel_map_corner_uvs(map, uv, 6 * faces));
    const size_t whole = compared(argument[2], uv, faces);
    CHECK(degrees == 0.0 || whole > faces / 10);
    OK(roundel_map_write(map, argument[3]));
    same_bytes(argument[2], argument[3]);
    printf("%zu faces, %zu integer coordinates\n", faces, whole);
    free(uv);
    OK(roundel_map_free(map));
    OK(roundel_mesh_free(mesh));
    return 0;
}
