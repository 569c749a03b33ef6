/* Bad quad options: sizes that are not positive, a missing mesh and bad settings. */

#include "bad_input.h"

static void settings(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const double lengths[3] = {1.0, 1.0, 1.0};
    roundel_quad_options* q = NULL;
    BAD(f, roundel_quad_options_new(NULL), null, "quad options", NONE);
    BAD(f, roundel_guidance_new_for_quads(NULL), null, "guidance", NONE);
    GOOD(roundel_quad_options_new(&q));
    BAD(f, roundel_quad_options_set_quads(NULL, 1), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_edge_length(NULL, 1.0), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_edge_lengths(NULL, NULL, 0), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_edge_lengths(q, NULL, 2), null, "edge lengths", NONE);
    BAD(f, roundel_quad_options_set_edge_lengths(q, lengths, 3), invalid, "two a face", NONE);
    BAD(f, roundel_quad_options_set_guidance(NULL, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_field_options(NULL, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_map_options(NULL, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_untangle(NULL, 1), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_untangle(q, 2), invalid, "not 2", NONE);
    BAD(f, roundel_quad_options_set_vary_curvature(NULL, 1), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_vary_curvature(q, 3), invalid, "not 3", NONE);
    BAD(f, roundel_quad_options_set_smooth(NULL, 1), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_smooth(q, -1), invalid, "not -1", NONE);
    GOOD(roundel_quad_options_set_guidance(q, NULL));
    GOOD(roundel_quad_options_set_field_options(q, NULL));
    GOOD(roundel_quad_options_set_map_options(q, NULL));
    GOOD(roundel_quad_options_free(q));
    GOOD(roundel_quad_options_free(NULL));
}

static void sizes(fixture* f, const roundel_mesh* torus) {
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const double two[4] = {1.0, 1.0, 1.0, 1.0};
    roundel_quad_options* q = NULL;
    roundel_quads* made = NULL;
    GOOD(roundel_quad_options_new(&q));
    BAD(f, roundel_quads_make(NULL, q, NULL, &made), ROUNDEL_ERROR_NULL_POINTER, "mesh", NONE);
    BAD(f, roundel_quads_make(torus, q, NULL, NULL), ROUNDEL_ERROR_NULL_POINTER, "quads", NONE);
    GOOD(roundel_quad_options_set_quads(q, 0));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), invalid, "quads is 0", NONE);
    GOOD(roundel_quad_options_set_edge_length(q, 0.0));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), invalid, "edge length", NONE);
    GOOD(roundel_quad_options_set_edge_length(q, -1.0));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), invalid, "edge length", NONE);
    GOOD(roundel_quad_options_set_edge_length(q, (double)NAN));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_NOT_FINITE, "edge length", 0);
    GOOD(roundel_quad_options_set_edge_lengths(q, two, 4));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_LENGTH_MISMATCH, "edge lengths",
        NONE);
    HOLDS(made == NULL);
    GOOD(roundel_quad_options_free(q));
}

void bad_quads(fixture* f) {
    roundel_mesh* torus = NULL;
    GOOD(roundel_mesh_make_shape("torus", 200, &torus));
    settings(f);
    sizes(f, torus);
    GOOD(roundel_mesh_free(torus));
}
