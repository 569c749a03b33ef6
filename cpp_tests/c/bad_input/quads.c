/* Bad quad options: sizes that are not positive, a missing mesh and bad settings. */

#include "bad_input.h"

static void settings(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const roundel_status beyond = ROUNDEL_ERROR_OPTION_RANGE;
    const double lengths[3] = {1.0, 1.0, 1.0};
    const int32_t bad_vertices[2] = {0, -1};
    roundel_option unknown;
    roundel_quad_options* q = NULL;
    BAD(f, roundel_quad_options_new(NULL), null, "quad options", NONE);
    BAD(f, roundel_guidance_new_for_quads(NULL), null, "guidance", NONE);
    GOOD(roundel_quad_options_new(&q));
    BAD(f, roundel_quad_options_set_int(NULL, "quads", 1), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_real(NULL, "edge_length", 1.0), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_int(q, "quads", 0), beyond, "[1,", NONE);
    BAD(f, roundel_quad_options_set_real(q, "quads", 1.0), ROUNDEL_ERROR_OPTION_TYPE, "whole",
        NONE);
    BAD(f, roundel_quad_options_set_real(q, "edge_length", 0.0), beyond, "(0,", NONE);
    BAD(f, roundel_quad_options_set_real(q, "edge_length", -1.0), beyond, "-1", NONE);
    BAD(f, roundel_quad_options_set_real(q, "edge_length", (double)NAN), beyond, "NaN", NONE);
    BAD(f, roundel_quad_options_set_text(q, "field_strategy", "luck"), beyond, "luck", NONE);
    BAD(f, roundel_quad_options_set_text(q, "count", "nearly"), beyond, "nearly", NONE);
    BAD(f, roundel_quad_options_set_int(q, "count", 1), ROUNDEL_ERROR_OPTION_TYPE, "word", NONE);
    BAD(f, roundel_quad_options_set_int(q, "triangles", 1), ROUNDEL_ERROR_UNKNOWN_OPTION,
        "triangles", NONE);
    for (size_t i = 0; i < roundel_quad_option_count(); ++i) {
        roundel_option option;
        GOOD(roundel_quad_option_info(i, &option));
        HOLDS(option.text[0] != '\0');
    }
    BAD(f, roundel_quad_option_info(roundel_quad_option_count(), &unknown),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "options", 0);
    BAD(f, roundel_guidance_option_info(roundel_guidance_option_count(), &unknown),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "options", 0);
    BAD(f, roundel_quad_options_set_edge_lengths(NULL, NULL, 0), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_edge_lengths(q, NULL, 2), null, "edge lengths", NONE);
    BAD(f, roundel_quad_options_set_edge_lengths(q, lengths, 3), invalid, "two a face", NONE);
    BAD(f, roundel_quad_options_add_mirror(NULL, "x"), null, "quad options", NONE);
    BAD(f, roundel_quad_options_add_mirror(q, NULL), null, "mirror", NONE);
    BAD(f, roundel_quad_options_add_mirror(q, "1,2,3"), invalid, "'1,2,3'", NONE);
    BAD(f, roundel_quad_options_set_real(q, "mirror_tolerance", -1), beyond, "-1", NONE);
    BAD(f, roundel_quad_options_set_density(NULL, NULL, 0), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_density(q, NULL, 2), null, "densities", NONE);
    BAD(f, roundel_quad_options_set_near_vertices(NULL, 0, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_near_vertices(q, 1, NULL), null, "vertices", NONE);
    BAD(f, roundel_quad_options_set_near_vertices(q, 2, bad_vertices),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "vertices", 1);
    BAD(f, roundel_quad_options_set_real(q, "adapt", 1.5), beyond, "[0, 1]", NONE);
    BAD(f, roundel_quad_options_set_real(q, "stretch", -0.5), beyond, "[0, 1]", NONE);
    BAD(f, roundel_quad_options_set_real(q, "min_length", 0.0), beyond, "(0,", NONE);
    BAD(f, roundel_quad_options_set_real(q, "max_length", -1.0), beyond, "(0,", NONE);
    BAD(f, roundel_quad_options_set_real(q, "gradation", 1.0), beyond, "(1,", NONE);
    BAD(f, roundel_quad_options_set_text(q, "near", "far"), beyond, "features", NONE);
    BAD(f, roundel_quad_options_set_guidance(NULL, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_field_options(NULL, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_map_options(NULL, NULL), null, "quad options", NONE);
    BAD(f, roundel_quad_options_set_int(q, "untangle", 2), beyond, "2", NONE);
    BAD(f, roundel_quad_options_set_int(q, "vary_curvature", 3), beyond, "3", NONE);
    BAD(f, roundel_quad_options_set_int(q, "smooth", -1), beyond, "-1", NONE);
    GOOD(roundel_quad_options_set_guidance(q, NULL));
    GOOD(roundel_quad_options_set_field_options(q, NULL));
    GOOD(roundel_quad_options_set_map_options(q, NULL));
    GOOD(roundel_quad_options_free(q));
    GOOD(roundel_quad_options_free(NULL));
}

static void sizes(fixture* f, const roundel_mesh* torus) {
    const double two[4] = {1.0, 1.0, 1.0, 1.0};
    roundel_quad_options* q = NULL;
    roundel_quads* made = NULL;
    GOOD(roundel_quad_options_new(&q));
    BAD(f, roundel_quads_make(NULL, q, NULL, &made), ROUNDEL_ERROR_NULL_POINTER, "mesh", NONE);
    BAD(f, roundel_quads_make(torus, q, NULL, NULL), ROUNDEL_ERROR_NULL_POINTER, "quads", NONE);
    GOOD(roundel_quad_options_set_edge_lengths(q, two, 4));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_LENGTH_MISMATCH, "edge lengths",
        NONE);
    HOLDS(made == NULL);
    GOOD(roundel_quad_options_free(q));
}

static void mirrors(fixture* f, const roundel_mesh* torus) {
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    roundel_quads* made = NULL;
    roundel_quad_options* q = NULL;
    double plane[4] = {7, 7, 7, 7};
    double deviation = 7;
    GOOD(roundel_quad_options_new(&q));
    GOOD(roundel_quad_options_add_mirror(q, "1,0,0,9"));
    GOOD(roundel_quad_options_set_real(q, "mirror_tolerance", 1));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), invalid, "mirror plane 0", 0);
    HOLDS(made == NULL);
    GOOD(roundel_quad_options_free(q));
    BAD(f, roundel_mesh_mirror_plane(NULL, "x", plane, &deviation), ROUNDEL_ERROR_NULL_POINTER,
        "mesh", NONE);
    BAD(f, roundel_mesh_mirror_plane(torus, NULL, plane, &deviation), ROUNDEL_ERROR_NULL_POINTER,
        "mirror", NONE);
    BAD(f, roundel_mesh_mirror_plane(torus, "x", NULL, &deviation), ROUNDEL_ERROR_NULL_POINTER,
        "plane", NONE);
    BAD(f, roundel_mesh_mirror_plane(torus, "x", plane, NULL), ROUNDEL_ERROR_NULL_POINTER,
        "deviation", NONE);
    BAD(f, roundel_mesh_mirror_plane(torus, "0,0,0,1", plane, &deviation), invalid, "normal", 0);
    HOLDS(plane[0] == 7 && deviation == 7);
    GOOD(roundel_mesh_mirror_plane(torus, "-y", plane, &deviation));
    HOLDS(plane[0] == 0 && plane[1] == -1 && plane[2] == 0 && deviation < 0.1);
}

static void densities(fixture* f, const roundel_mesh* torus) {
    double dense[256];
    const int32_t far[1] = {1000000};
    size_t vertices = 0;
    roundel_quad_options* q = NULL;
    roundel_quads* made = NULL;
    GOOD(roundel_mesh_vertex_count(torus, &vertices));
    HOLDS(vertices <= 256);
    for (size_t v = 0; v < 256; ++v) {
        dense[v] = 1.0;
    }
    GOOD(roundel_quad_options_new(&q));
    GOOD(roundel_quad_options_set_density(q, dense, 2));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_LENGTH_MISMATCH, "densities",
        NONE);
    dense[7] = 0.0;
    GOOD(roundel_quad_options_set_density(q, dense, vertices));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_INVALID_ARGUMENT, "above 0", 7);
    dense[7] = (double)NAN;
    GOOD(roundel_quad_options_set_density(q, dense, vertices));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_NOT_FINITE, "densities", 7);
    GOOD(roundel_quad_options_set_density(q, NULL, 0));
    GOOD(roundel_quad_options_set_text(q, "near", "vertices"));
    GOOD(roundel_quad_options_set_near_vertices(q, 1, far));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "near", 0);
    GOOD(roundel_quad_options_set_near_vertices(q, 0, NULL));
    GOOD(roundel_quad_options_set_real(q, "min_length", 2.0));
    GOOD(roundel_quad_options_set_real(q, "max_length", 1.0));
    BAD(f, roundel_quads_make(torus, q, NULL, &made), ROUNDEL_ERROR_INVALID_ARGUMENT, "largest",
        NONE);
    HOLDS(made == NULL);
    GOOD(roundel_quad_options_free(q));
}

/* Labels and numbers of the torus, which has at most 256 faces and 768 corners. */
static void transfers(fixture* f, const roundel_mesh* torus) {
    const roundel_status mismatch = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    static int32_t labels[256], found[4096];
    static double values[1024], carried[16384];
    size_t faces = 0, vertices = 0, count = 0, points = 0, near = 7;
    roundel_quads* quads = NULL;
    GOOD(roundel_mesh_face_count(torus, &faces));
    GOOD(roundel_mesh_vertex_count(torus, &vertices));
    GOOD(roundel_quads_make(torus, NULL, NULL, &quads));
    GOOD(roundel_quads_count(quads, &count));
    GOOD(roundel_quads_vertex_count(quads, &points));
    HOLDS(faces <= 256 && count <= 4096 && points <= 16384 && 4 * count <= 16384);
    found[0] = 77;
    carried[0] = 77.0;
    BAD(f, roundel_quads_transfer_face_labels(NULL, torus, labels, faces, NULL, found, count), null,
        "quads", NONE);
    BAD(f, roundel_quads_transfer_face_labels(quads, NULL, labels, faces, NULL, found, count), null,
        "mesh", NONE);
    BAD(f, roundel_quads_transfer_face_labels(quads, torus, NULL, faces, NULL, found, count), null,
        "labels", NONE);
    BAD(f, roundel_quads_transfer_face_labels(quads, torus, labels, faces, NULL, NULL, count), null,
        "labels", NONE);
    BAD(f, roundel_quads_transfer_face_labels(quads, torus, labels, 3, NULL, found, count),
        mismatch, "labels of faces", NONE);
    BAD(f, roundel_quads_transfer_face_labels(quads, torus, labels, faces, NULL, found, 1),
        mismatch, "labels of the quads", NONE);
    labels[5] = -2;
    BAD(f, roundel_quads_transfer_face_labels(quads, torus, labels, faces, NULL, found, count),
        invalid, "below -1", 5);
    BAD(f,
        roundel_quads_transfer_vertex_values(NULL, torus, 1, values, vertices, NULL, carried,
                                             points),
        null, "quads", NONE);
    BAD(f,
        roundel_quads_transfer_vertex_values(quads, torus, 1, NULL, vertices, NULL, carried,
                                             points),
        null, "values", NONE);
    BAD(f, roundel_quads_transfer_vertex_values(quads, torus, 0, values, 0, NULL, carried, 0),
        invalid, "components", NONE);
    BAD(f,
        roundel_quads_transfer_vertex_values(quads, torus, 2, values, vertices, NULL, carried,
                                             points),
        mismatch, "values of vertices", NONE);
    BAD(f,
        roundel_quads_transfer_vertex_values(quads, torus, 1, values, vertices, NULL, carried,
                                             points - 1),
        mismatch, "values of the quads", NONE);
    BAD(f,
        roundel_quads_transfer_corner_values(quads, torus, SIZE_MAX, values, 3 * faces, NULL,
                                             carried, 4 * count),
        mismatch, "values of corners", NONE);
    values[9] = (double)INFINITY;
    BAD(f,
        roundel_quads_transfer_vertex_values(quads, torus, 1, values, vertices, NULL, carried,
                                             points),
        ROUNDEL_ERROR_NOT_FINITE, "values of vertices", 9);
    BAD(f,
        roundel_quads_transfer_corner_values(quads, torus, 1, values, 3 * faces, NULL, carried,
                                             4 * count),
        ROUNDEL_ERROR_NOT_FINITE, "values of corners", 9);
    HOLDS(found[0] == 77 && carried[0] == 77.0);
    labels[5] = -1;
    values[9] = 0.0;
    GOOD(roundel_quads_transfer_face_labels(quads, torus, labels, faces, NULL, found, count));
    GOOD(roundel_quads_transfer_vertex_values(quads, torus, 1, values, vertices, NULL, carried,
                                              points));
    HOLDS(found[0] == 0 && carried[0] == 0.0);
    BAD(f, roundel_quads_near_feature_count(NULL, &near), null, "quads", NONE);
    BAD(f, roundel_quads_near_feature_count(quads, NULL), null, "near feature count", NONE);
    HOLDS(near == 7);
    GOOD(roundel_quads_near_feature_count(quads, &near));
    HOLDS(near == 0);
    near = 7;
    BAD(f, roundel_quads_paired_face_count(NULL, &near), null, "quads", NONE);
    BAD(f, roundel_quads_paired_face_count(quads, NULL), null, "paired face count", NONE);
    HOLDS(near == 7);
    GOOD(roundel_quads_paired_face_count(quads, &near));
    HOLDS(near == 0);
    GOOD(roundel_quads_free(quads));
}

void bad_quads(fixture* f) {
    roundel_mesh* torus = NULL;
    GOOD(roundel_mesh_make_shape("torus", 200, &torus));
    settings(f);
    sizes(f, torus);
    mirrors(f, torus);
    densities(f, torus);
    transfers(f, torus);
    GOOD(roundel_mesh_free(torus));
}
