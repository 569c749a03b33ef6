/* usage: default_quads_c MESH QUADS.obj OTHER.obj
 *
 * The quads that the C interface makes of a mesh when it is told nothing are those that the program
 * wrote to QUADS.obj when it was told nothing: the same file when written to OTHER.obj. */

#include "check.h"
#include "same_bytes.h"

#include <roundel/roundel.h>

#include <stddef.h>
#include <stdio.h>

static void written(roundel_quads* quads, const char* reference, const char* file) {
    int32_t conforming = 0;
    OK(roundel_quads_is_conforming(quads, &conforming));
    CHECK(conforming == 1);
    remove(file);
    OK(roundel_quads_write(quads, file));
    same_bytes(reference, file);
    OK(roundel_quads_free(quads));
}

int main(int count, char** argument) {
    roundel_mesh* mesh = NULL;
    roundel_quad_options* options = NULL;
    roundel_quads* quads = NULL;
    CHECK(count == 4);
    OK(roundel_mesh_read(argument[1], &mesh));

    OK(roundel_quad_options_new(&options));
    OK(roundel_quads_make(mesh, options, NULL, &quads));
    OK(roundel_quad_options_free(options));
    written(quads, argument[2], argument[3]);

    /* NULL stands for the default options. */
    OK(roundel_quads_make(mesh, NULL, NULL, &quads));
    written(quads, argument[2], argument[3]);

    OK(roundel_mesh_free(mesh));
    return 0;
}
