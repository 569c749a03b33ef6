/* Invalid meshes, fields constrained at faces that do not exist, and NULL for every argument. */

#include "bad_input.h"

/* A closed tetrahedron with outward faces. */
static const double xyz[12] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
static const int32_t tetrahedron[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

static void arrays(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const int32_t large[3] = {0, 1, 4}, negative[3] = {0, -1, 2};
    const int64_t wide[3] = {0, INT64_MAX, 2};
    const double infinite[9] = {0.0, 0.0, 0.0, 1.0, 0.0, (double)INFINITY, 0.0, 1.0, 0.0};
    roundel_mesh* mesh = NULL;
    BAD(f, roundel_mesh_new(4, xyz, 4, tetrahedron, NULL), null, "mesh", NONE);
    BAD(f, roundel_mesh_new(4, NULL, 4, tetrahedron, &mesh), null, "coordinates", NONE);
    BAD(f, roundel_mesh_new(4, xyz, 4, NULL, &mesh), null, "corners", NONE);
    BAD(f, roundel_mesh_new_i64(4, xyz, 1, NULL, &mesh), null, "corners", NONE);
    BAD(f, roundel_mesh_new(0, NULL, 0, NULL, &mesh), ROUNDEL_ERROR_EMPTY, "no faces", NONE);
    BAD(f, roundel_mesh_new((size_t)-1, xyz, 4, tetrahedron, &mesh), ROUNDEL_ERROR_OVERFLOW,
        "coordinates", NONE);
    BAD(f, roundel_mesh_new((size_t)-1 / 24, xyz, 4, tetrahedron, &mesh), ROUNDEL_ERROR_OVERFLOW,
        "coordinates", NONE);
    BAD(f, roundel_mesh_new(4, xyz, (size_t)-1 / 2, tetrahedron, &mesh), ROUNDEL_ERROR_OVERFLOW,
        "corners", NONE);
    BAD(f, roundel_mesh_new(4, xyz, 1, large, &mesh), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "entry 2 is 4", 2);
    BAD(f, roundel_mesh_new(4, xyz, 1, negative, &mesh), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "entry 1 is -1", 1);
    BAD(f, roundel_mesh_new_i64(4, xyz, 1, wide, &mesh), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "9223372036854775807", 1);
    BAD(f, roundel_mesh_new(3, infinite, 1, tetrahedron, &mesh), ROUNDEL_ERROR_NOT_FINITE,
        "vertex 1", 1);
    HOLDS(mesh == NULL);
}

static void no_manifolds(fixture* f) {
    const int32_t twice[6] = {0, 1, 2, 1, 3, 1};
    const int32_t crowded[9] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    const int32_t turned[6] = {0, 1, 2, 0, 1, 3};
    const int32_t bow_tie[6] = {0, 1, 2, 2, 3, 4};
    const double line[9] = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0};
    const double five[15] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0,
                             0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0};
    roundel_mesh* mesh = NULL;
    BAD(f, roundel_mesh_new(4, xyz, 2, twice, &mesh), ROUNDEL_ERROR_REPEATED_VERTEX, "face 1", 1);
    BAD(f, roundel_mesh_new(3, line, 1, tetrahedron, &mesh), ROUNDEL_ERROR_ZERO_AREA, "face 0", 0);
    BAD(f, roundel_mesh_new(5, five, 3, crowded, &mesh), ROUNDEL_ERROR_NON_MANIFOLD_EDGE,
        "edge 0-1", 0);
    BAD(f, roundel_mesh_new(4, xyz, 2, turned, &mesh), ROUNDEL_ERROR_INCONSISTENT_ORIENTATION,
        "faces 0 and 1", 0);
    BAD(f, roundel_mesh_new(5, five, 4, tetrahedron, &mesh), ROUNDEL_ERROR_ISOLATED_VERTEX,
        "vertex 4", 4);
    BAD(f, roundel_mesh_new(5, five, 2, bow_tie, &mesh), ROUNDEL_ERROR_NON_MANIFOLD_VERTEX,
        "vertex 2", 2);
    HOLDS(mesh == NULL);
}

static void names(fixture* f, const roundel_mesh* tetra) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    roundel_mesh* mesh = NULL;
    BAD(f, roundel_mesh_make_shape(NULL, 100, &mesh), null, "shape", NONE);
    BAD(f, roundel_mesh_make_shape("sphere", 100, NULL), null, "mesh", NONE);
    BAD(f, roundel_mesh_make_shape("teapot", 100, &mesh), invalid, "teapot", NONE);
    BAD(f, roundel_mesh_make_shape("sphere", 0, &mesh), invalid, "triangles is 0", NONE);
    BAD(f, roundel_mesh_make_shape("sphere", (size_t)-1, &mesh), invalid, "triangles", NONE);
    BAD(f, roundel_mesh_make_shape("\xff", 100, &mesh), invalid, "UTF-8", NONE);
    BAD(f, roundel_mesh_jitter(NULL, 0.1, 1, &mesh), null, "mesh", NONE);
    BAD(f, roundel_mesh_jitter(tetra, 0.1, 1, NULL), null, "copy", NONE);
    BAD(f, roundel_mesh_jitter(tetra, (double)NAN, 1, &mesh), invalid, "jitter", NONE);
    BAD(f, roundel_mesh_read(NULL, &mesh), null, "file", NONE);
    BAD(f, roundel_mesh_read("never.off", NULL), null, "mesh", NONE);
    BAD(f, roundel_mesh_read("never.off", &mesh), ROUNDEL_ERROR_IO, "never.off", NONE);
    BAD(f, roundel_mesh_read("never.3mf", &mesh), ROUNDEL_ERROR_NOT_SUPPORTED, "3mf", NONE);
    BAD(f, roundel_mesh_write(NULL, "never.off"), null, "mesh", NONE);
    BAD(f, roundel_mesh_write(tetra, NULL), null, "file", NONE);
    BAD(f, roundel_mesh_write(tetra, "no/such/folder.off"), ROUNDEL_ERROR_IO, "folder", NONE);
    BAD(f, roundel_mesh_write(tetra, "never"), ROUNDEL_ERROR_NOT_SUPPORTED, "format", NONE);
    HOLDS(mesh == NULL);
}

static void copies(fixture* f, const roundel_mesh* tetra) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    double numbers[12] = {7.0};
    int32_t whole[12] = {7};
    size_t count = 7;
    int64_t euler = 7;
    BAD(f, roundel_mesh_vertex_count(NULL, &count), null, "mesh", NONE);
    BAD(f, roundel_mesh_edge_count(NULL, &count), null, "mesh", NONE);
    BAD(f, roundel_mesh_face_count(NULL, &count), null, "mesh", NONE);
    BAD(f, roundel_mesh_boundary_loop_count(NULL, &count), null, "mesh", NONE);
    BAD(f, roundel_mesh_euler_characteristic(NULL, &euler), null, "mesh", NONE);
    BAD(f, roundel_mesh_vertex_count(tetra, NULL), null, "vertex count", NONE);
    BAD(f, roundel_mesh_edge_count(tetra, NULL), null, "edge count", NONE);
    BAD(f, roundel_mesh_face_count(tetra, NULL), null, "face count", NONE);
    BAD(f, roundel_mesh_boundary_loop_count(tetra, NULL), null, "boundary", NONE);
    BAD(f, roundel_mesh_euler_characteristic(tetra, NULL), null, "Euler", NONE);
    BAD(f, roundel_mesh_coordinates(NULL, numbers, 12), null, "mesh", NONE);
    BAD(f, roundel_mesh_coordinates(tetra, NULL, 12), null, "coordinates", NONE);
    BAD(f, roundel_mesh_coordinates(tetra, numbers, 4), length, "expected 12", NONE);
    BAD(f, roundel_mesh_corners(NULL, whole, 12), null, "mesh", NONE);
    BAD(f, roundel_mesh_corners(tetra, NULL, 12), null, "corners", NONE);
    BAD(f, roundel_mesh_corners(tetra, whole, 0), length, "expected 12", NONE);
    BAD(f, roundel_mesh_edge_faces(NULL, whole, 12), null, "mesh", NONE);
    BAD(f, roundel_mesh_edge_faces(tetra, whole, 6), length, "expected 12", NONE);
    BAD(f, roundel_mesh_face_edges(NULL, whole, 12), null, "mesh", NONE);
    BAD(f, roundel_mesh_face_edges(tetra, whole, 13 - 2), length, "expected 12", NONE);
    HOLDS(numbers[0] == 7.0 && whole[0] == 7 && count == 7 && euler == 7);
}

static void constraints(fixture* f, const roundel_mesh* tetra) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const int32_t faces[2] = {1, 4}, twice[2] = {2, 2};
    const double angles[2] = {0.5, 0.25}, infinite[2] = {0.5, (double)NAN};
    int32_t found[4] = {7, 7, 7, 7};
    double direction[4] = {7.0, 7.0, 7.0, 7.0};
    size_t count = 7;
    roundel_guidance* g = NULL;
    roundel_field* field = NULL;
    roundel_problem* problem = NULL;
    roundel_monitor unsized_monitor = {0, NULL, NULL, NULL};
    GOOD(roundel_guidance_new(&g));
    BAD(f, roundel_field_solve(NULL, NULL, NULL, NULL, &field), null, "mesh", NONE);
    BAD(f, roundel_field_solve(tetra, NULL, NULL, NULL, NULL), null, "field", NONE);
    BAD(f, roundel_field_solve(tetra, NULL, NULL, &unsized_monitor, &field),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "monitor", NONE);
    BAD(f, roundel_field_make_problem(NULL, NULL, &problem), null, "mesh", NONE);
    BAD(f, roundel_field_make_problem(tetra, NULL, NULL), null, "problem", NONE);
    BAD(f, roundel_field_from_solution(NULL, NULL, f->solution, &field), null, "mesh", NONE);
    BAD(f, roundel_field_from_solution(tetra, NULL, NULL, &field), null, "solution", NONE);
    BAD(f, roundel_field_from_solution(tetra, NULL, f->solution, NULL), null, "field", NONE);
    BAD(f, roundel_field_from_solution(tetra, NULL, f->solution, &field),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "got 3", NONE);
    GOOD(roundel_guidance_set_constraints(g, 2, faces, angles));
    BAD(f, roundel_field_solve(tetra, g, NULL, NULL, &field), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
        "constrained faces: entry 1 is 4", 1);
    BAD(f, roundel_field_make_problem(tetra, g, &problem), ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "4",
        1);
    GOOD(roundel_guidance_set_constraints(g, 2, twice, angles));
    BAD(f, roundel_field_solve(tetra, g, NULL, NULL, &field), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "twice", 1);
    GOOD(roundel_guidance_set_constraints(g, 2, twice, infinite));
    BAD(f, roundel_field_solve(tetra, g, NULL, NULL, &field), ROUNDEL_ERROR_NOT_FINITE, "constrain",
        1);
    GOOD(roundel_guidance_free(g));
    BAD(f, roundel_mesh_curvature_constraints(NULL, 0.5, 4, found, direction, &count), null, "mesh",
        NONE);
    BAD(f, roundel_mesh_curvature_constraints(tetra, 0.5, 4, NULL, direction, &count), null,
        "faces", NONE);
    BAD(f, roundel_mesh_curvature_constraints(tetra, 0.5, 4, found, NULL, &count), null, "angles",
        NONE);
    BAD(f, roundel_mesh_curvature_constraints(tetra, 0.5, 4, found, direction, NULL), null, "count",
        NONE);
    BAD(f, roundel_mesh_curvature_constraints(tetra, 0.5, 1, found, direction, &count),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "expected 2 entries, got 1", NONE);
    BAD(f, roundel_mesh_curvature_constraints(tetra, 1.5, 4, found, direction, &count),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "fraction", NONE);
    BAD(f, roundel_mesh_curvature_constraints(tetra, (double)NAN, 4, found, direction, &count),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "fraction", NONE);
    HOLDS(field == NULL && problem == NULL && count == 7 && found[0] == 7 && direction[0] == 7.0);
}

static void fields(fixture* f, const roundel_mesh* tetra) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const int32_t face[1] = {0};
    const double angle[1] = {0.5};
    double numbers[6] = {7.0}, energy = 7.0;
    int32_t jumps[6] = {7};
    size_t count = 7;
    roundel_guidance* g = NULL;
    roundel_field* field = NULL;
    roundel_solution* solution = NULL;
    GOOD(roundel_guidance_new(&g));
    GOOD(roundel_guidance_set_constraints(g, 1, face, angle));
    GOOD(roundel_field_solve(tetra, g, NULL, NULL, &field));
    GOOD(roundel_guidance_free(g));
    BAD(f, roundel_field_angles(NULL, numbers, 4), null, "field", NONE);
    BAD(f, roundel_field_angles(field, NULL, 4), null, "angles", NONE);
    BAD(f, roundel_field_angles(field, numbers, 6), length, "angles: expected 4", NONE);
    BAD(f, roundel_field_period_jumps(NULL, jumps, 6), null, "field", NONE);
    BAD(f, roundel_field_period_jumps(field, NULL, 6), null, "period jumps", NONE);
    BAD(f, roundel_field_period_jumps(field, jumps, 4), length, "expected 6", NONE);
    BAD(f, roundel_field_kappa(NULL, numbers, 6), null, "field", NONE);
    BAD(f, roundel_field_kappa(field, numbers, 4), length, "kappa: expected 6", NONE);
    BAD(f, roundel_field_vertex_indices(NULL, numbers, 4), null, "field", NONE);
    BAD(f, roundel_field_vertex_indices(field, numbers, 6), length, "expected 4", NONE);
    BAD(f, roundel_field_traced_indices(NULL, numbers, 4), null, "field", NONE);
    BAD(f, roundel_field_traced_indices(field, numbers, 6), length, "expected 4", NONE);
    BAD(f, roundel_field_boundary_indices(NULL, numbers, 0), null, "field", NONE);
    BAD(f, roundel_field_boundary_indices(field, numbers, 1), length, "expected 0", NONE);
    BAD(f, roundel_field_vertex_index_steps(NULL, jumps, 4), null, "field", NONE);
    BAD(f, roundel_field_vertex_index_steps(field, NULL, 4), null, "index steps", NONE);
    BAD(f, roundel_field_vertex_index_steps(field, jumps, 6), length, "expected 4", NONE);
    BAD(f, roundel_field_boundary_index_steps(NULL, jumps, 0), null, "field", NONE);
    BAD(f, roundel_field_boundary_index_steps(field, jumps, 1), length, "expected 0", NONE);
    BAD(f, roundel_field_energy(NULL, &energy), null, "field", NONE);
    BAD(f, roundel_field_energy(field, NULL), null, "energy", NONE);
    BAD(f, roundel_field_irregular_count(NULL, &count), null, "field", NONE);
    BAD(f, roundel_field_irregular_count(field, NULL), null, "irregular", NONE);
    BAD(f, roundel_field_solution(NULL, &solution), null, "field", NONE);
    BAD(f, roundel_field_solution(field, NULL), null, "solution", NONE);
    HOLDS(numbers[0] == 7.0 && jumps[0] == 7 && energy == 7.0 && count == 7 && solution == NULL);
    /* After all these calls the field is intact. */
    GOOD(roundel_field_angles(field, numbers, 4));
    HOLDS(numbers[0] == 0.5);
    GOOD(roundel_field_free(field));
    GOOD(roundel_field_free(NULL));
}

void bad_meshes(fixture* f) {
    roundel_mesh* tetra = NULL;
    GOOD(roundel_mesh_new(4, xyz, 4, tetrahedron, &tetra));
    arrays(f);
    no_manifolds(f);
    names(f, tetra);
    copies(f, tetra);
    constraints(f, tetra);
    fields(f, tetra);
    GOOD(roundel_mesh_free(tetra));
    GOOD(roundel_mesh_free(NULL));
}
