/* Curves that are not on the mesh, and calls that lack what they need. */

#include "bad_input.h"

static void curves_are_checked(fixture* f, const roundel_mesh* mesh) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const double far[6] = {0.0, 0.0, 0.0, 0.5, 0.0, 9.0}, nan[6] = {0.0, 0.0, 0.0, NAN, 0.0, 0.0};
    const int32_t faces[2] = {0, -1};
    const double inside[6] = {0.2, 0.3, 0.5, 0.5, 0.3, 0.2};
    roundel_curves* curves = NULL;
    size_t count = 7;
    BAD(f, roundel_curves_new(NULL), null, "curves", NONE);
    GOOD(roundel_curves_new(&curves));
    BAD(f, roundel_curves_draw(NULL, mesh, 2, far, NULL), null, "curves", NONE);
    BAD(f, roundel_curves_draw(curves, NULL, 2, far, NULL), null, "mesh", NONE);
    BAD(f, roundel_curves_draw(curves, mesh, 2, NULL, NULL), null, "points", NONE);
    BAD(f, roundel_curves_draw(curves, mesh, (size_t)-1, far, NULL), ROUNDEL_ERROR_OVERFLOW,
        "points of a curve", NONE);
    BAD(f, roundel_curves_draw(curves, mesh, 2, far, NULL), invalid, "off the surface", 1);
    BAD(f, roundel_curves_draw(curves, mesh, 1, far, NULL), invalid, "two points", NONE);
    BAD(f, roundel_curves_draw(curves, mesh, 0, NULL, NULL), invalid, "no points", NONE);
    BAD(f, roundel_curves_draw(curves, mesh, 2, nan, NULL), ROUNDEL_ERROR_NOT_FINITE, "points", 1);
    BAD(f, roundel_curves_add(curves, 2, NULL, inside), null, "faces", NONE);
    BAD(f, roundel_curves_add(curves, 1, faces, NULL), null, "barycentric", NONE);
    BAD(f, roundel_curves_add(curves, 2, faces, inside), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "entry 1 is -1", 1);
    BAD(f, roundel_curves_count(NULL, &count), null, "curves", NONE);
    BAD(f, roundel_curves_count(curves, NULL), null, "count", NONE);
    HOLDS(count == 7);
    GOOD(roundel_curves_count(curves, &count));
    HOLDS(count == 0);
    GOOD(roundel_curves_free(curves));
    GOOD(roundel_curves_free(NULL));
}

static void results_are_checked(fixture* f, const roundel_mesh* mesh) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const double line[6] = {-0.71, -0.52, 0.0, 0.63, 0.48, 0.0};
    const int32_t far_faces[2] = {0, 150};
    const double inside[6] = {0.2, 0.3, 0.5, 0.5, 0.3, 0.2};
    int32_t faces[200] = {7}, marks[1000] = {7};
    double angles[200] = {7.0}, weights[200] = {7.0};
    roundel_curves* curves = NULL;
    roundel_cut* cut = NULL;
    roundel_mesh* made = NULL;
    size_t count = 7, parts = 0, edges = 0;
    GOOD(roundel_curves_new(&curves));
    GOOD(roundel_curves_draw(curves, mesh, 2, line, NULL));
    BAD(f, roundel_curves_guides(NULL, mesh, 4, 1.0, 0, NULL, NULL, NULL, &count), null, "curves",
        NONE);
    BAD(f, roundel_curves_guides(curves, NULL, 4, 1.0, 0, NULL, NULL, NULL, &count), null, "mesh",
        NONE);
    BAD(f, roundel_curves_guides(curves, mesh, 4, 1.0, 0, NULL, NULL, NULL, NULL), null, "count",
        NONE);
    BAD(f, roundel_curves_guides(curves, mesh, 3, 1.0, 0, NULL, NULL, NULL, &count), invalid,
        "symmetry", NONE);
    BAD(f, roundel_curves_guides(curves, mesh, 4, -1.0, 0, NULL, NULL, NULL, &count), invalid,
        "weight", NONE);
    BAD(f, roundel_curves_guides(curves, mesh, 4, 1.0, 1, faces, angles, weights, &count), length,
        "guides", NONE);
    BAD(f, roundel_curves_guides(curves, mesh, 4, 1.0, 200, NULL, angles, weights, &count), null,
        "faces", NONE);
    BAD(f, roundel_cut_new(NULL, curves, &cut), null, "mesh", NONE);
    BAD(f, roundel_cut_new(mesh, NULL, &cut), null, "curves", NONE);
    BAD(f, roundel_cut_new(mesh, curves, NULL), null, "cut", NONE);
    HOLDS(count == 7 && cut == NULL && faces[0] == 7);
    GOOD(roundel_curves_guides(curves, mesh, 4, 1.0, 200, faces, angles, weights, &count));
    HOLDS(count > 7 && count <= 200);
    GOOD(roundel_cut_new(mesh, curves, &cut));
    BAD(f, roundel_cut_mesh(NULL, &made), null, "cut", NONE);
    BAD(f, roundel_cut_mesh(cut, NULL), null, "mesh", NONE);
    GOOD(roundel_cut_mesh(cut, &made));
    GOOD(roundel_mesh_face_count(made, &parts));
    GOOD(roundel_mesh_edge_count(made, &edges));
    HOLDS(parts > 200 && parts < 1000 && edges < 1000);
    BAD(f, roundel_cut_face_origins(NULL, marks, parts), null, "cut", NONE);
    BAD(f, roundel_cut_face_origins(cut, NULL, parts), null, "faces", NONE);
    BAD(f, roundel_cut_face_origins(cut, marks, parts - 1), length, "faces", NONE);
    BAD(f, roundel_cut_mark_curves(NULL, marks, edges), null, "cut", NONE);
    BAD(f, roundel_cut_mark_curves(cut, NULL, edges), null, "marks", NONE);
    BAD(f, roundel_cut_mark_curves(cut, marks, edges + 1), length, "marks", NONE);
    GOOD(roundel_cut_mark_curves(cut, marks, edges));
    GOOD(roundel_curves_add(curves, 2, far_faces, inside));
    BAD(f, roundel_curves_guides(curves, mesh, 4, 1.0, 0, NULL, NULL, NULL, &count), invalid,
        "common face", 1);
    GOOD(roundel_mesh_free(made));
    BAD(f, roundel_cut_new(mesh, curves, &cut), invalid, "common face", 1);
    GOOD(roundel_cut_free(cut));
    GOOD(roundel_cut_free(NULL));
    GOOD(roundel_curves_free(curves));
}

void bad_curves(fixture* f) {
    roundel_mesh* mesh = NULL;
    GOOD(roundel_mesh_make_shape("plane", 200, &mesh));
    curves_are_checked(f, mesh);
    results_are_checked(f, mesh);
    GOOD(roundel_mesh_free(mesh));
}
