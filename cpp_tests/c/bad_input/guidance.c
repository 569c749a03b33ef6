/* Guidance that refers to elements that do not exist, and results of maps that were not solved. */

#include "bad_input.h"

static void settings(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status beyond = ROUNDEL_ERROR_OPTION_RANGE;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const int32_t good[2] = {0, 1}, negative[2] = {0, -1};
    const double angles[2] = {0.5, 0.25};
    roundel_guidance* g = NULL;
    BAD(f, roundel_guidance_new(NULL), null, "guidance", NONE);
    GOOD(roundel_guidance_new(&g));
    BAD(f, roundel_guidance_set_int(NULL, "symmetry", 4), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_int(g, NULL, 4), null, "option name", NONE);
    BAD(f, roundel_guidance_set_int(g, "arms", 4), ROUNDEL_ERROR_UNKNOWN_OPTION, "arms", NONE);
    BAD(f, roundel_guidance_set_int(g, "symmetry", 3), beyond, "1|2|4|6", NONE);
    BAD(f, roundel_guidance_set_int(g, "symmetry", -4), beyond, "-4", NONE);
    BAD(f, roundel_guidance_set_real(g, "symmetry", 4.0), ROUNDEL_ERROR_OPTION_TYPE, "whole", NONE);
    BAD(f, roundel_guidance_set_constraints(NULL, 0, NULL, NULL), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_constraints(g, 2, NULL, angles), null, "faces", NONE);
    BAD(f, roundel_guidance_set_constraints(g, 2, good, NULL), null, "angles", NONE);
    BAD(f, roundel_guidance_set_constraints(g, 2, negative, angles), range, "entry 1 is -1", 1);
    BAD(f, roundel_guidance_set_guides(NULL, 0, NULL, NULL, NULL), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_guides(g, 2, good, angles, NULL), null, "weights", NONE);
    BAD(f, roundel_guidance_set_guides(g, 2, negative, angles, angles), range, "guided", 1);
    BAD(f, roundel_guidance_set_indices(NULL, 0, NULL, NULL), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_indices(g, 2, good, NULL), null, "steps", NONE);
    BAD(f, roundel_guidance_set_indices(g, 2, negative, good), range, "vertices", 1);
    BAD(f, roundel_guidance_clear_indices(NULL), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_real(NULL, "detail", 0.0), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_real(g, "constrain_curvature", 1.5), beyond, "1.5", NONE);
    BAD(f, roundel_guidance_set_real(g, "curvature_weight", -1.0), beyond, "-1", NONE);
    BAD(f, roundel_guidance_set_real(g, "constrain_curvature", (double)NAN), beyond, "NaN", NONE);
    BAD(f, roundel_guidance_set_real(g, "curvature_weight", (double)INFINITY), beyond, "inf", NONE);
    BAD(f, roundel_guidance_set_real(g, "feature_angle", 4.0), beyond, "3.14", NONE);
    BAD(f, roundel_guidance_set_real(g, "feature_angle", (double)NAN), beyond, "NaN", NONE);
    BAD(f, roundel_guidance_set_feature_edges(NULL, 0, NULL), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_feature_edges(g, 2, NULL), null, "edges", NONE);
    BAD(f, roundel_guidance_set_feature_edges(g, 2, negative), range, "feature edges", 1);
    BAD(f, roundel_guidance_set_feature_lines(NULL, 0, NULL), null, "guidance", NONE);
    BAD(f, roundel_guidance_set_feature_lines(g, 1, NULL), null, "lines", NONE);
    BAD(f, roundel_guidance_set_feature_lines(g, 1, negative), range, "lines", 1);
    BAD(f, roundel_guidance_set_feature_lines(g, (size_t)-1, good), ROUNDEL_ERROR_OVERFLOW,
        "memory", NONE);
    BAD(f, roundel_guidance_set_int(g, "align_boundary", 2), beyond, "2", NONE);
    BAD(f, roundel_guidance_set_real(g, "detail", -1.0), beyond, "-1", NONE);
    BAD(f, roundel_guidance_set_real(g, "detail", (double)NAN), beyond, "NaN", NONE);
    BAD(f, roundel_guidance_set_text(g, "detail", "all"), ROUNDEL_ERROR_OPTION_TYPE, "real", NONE);
    BAD(f, roundel_guidance_set_text(g, "detail", NULL), null, "option value", NONE);
    GOOD(roundel_guidance_set_int(g, "detail", 1));
    GOOD(roundel_guidance_set_text(g, "detail", "unset"));
    GOOD(roundel_guidance_set_real(g, "detail", 0.0));
    GOOD(roundel_guidance_free(g));
    GOOD(roundel_guidance_free(NULL));
}

static void on_a_mesh(fixture* f, const roundel_mesh* disk) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const int32_t far[2] = {0, 1000000}, twice[2] = {1, 1}, apart[2] = {0, 0};
    const double angles[2] = {0.5, 0.25};
    int32_t marks[1] = {7};
    size_t edges = 0;
    roundel_guidance* g = NULL;
    roundel_field* field = NULL;
    roundel_problem* problem = NULL;
    GOOD(roundel_guidance_new(&g));
    GOOD(roundel_mesh_edge_count(disk, &edges));
    BAD(f, roundel_guidance_read(NULL, disk, "none.txt"), null, "guidance", NONE);
    BAD(f, roundel_guidance_read(g, NULL, "none.txt"), null, "mesh", NONE);
    BAD(f, roundel_guidance_read(g, disk, NULL), null, "file", NONE);
    BAD(f, roundel_guidance_read(g, disk, "none.txt"), ROUNDEL_ERROR_IO, "none.txt", NONE);
    BAD(f, roundel_guidance_read_features(NULL, disk, "none.obj"), null, "guidance", NONE);
    BAD(f, roundel_guidance_read_features(g, NULL, "none.obj"), null, "mesh", NONE);
    BAD(f, roundel_guidance_read_features(g, disk, "none.obj"), ROUNDEL_ERROR_IO, "none.obj", NONE);
    BAD(f, roundel_mesh_mark_features(NULL, g, marks, edges), null, "mesh", NONE);
    BAD(f, roundel_mesh_mark_features(disk, NULL, NULL, edges), null, "marks", NONE);
    BAD(f, roundel_mesh_mark_features(disk, NULL, marks, 1), ROUNDEL_ERROR_LENGTH_MISMATCH, "marks",
        NONE);
    BAD(f, roundel_field_solve(NULL, g, NULL, NULL, &field), null, "mesh", NONE);
    BAD(f, roundel_field_solve(disk, g, NULL, NULL, NULL), null, "field", NONE);
    BAD(f, roundel_field_make_problem(NULL, g, &problem), null, "mesh", NONE);
    BAD(f, roundel_field_make_problem(disk, g, NULL), null, "problem", NONE);
    BAD(f, roundel_field_from_solution(disk, g, NULL, &field), null, "solution", NONE);
    BAD(f, roundel_field_from_solution(disk, g, f->solution, NULL), null, "field", NONE);
    BAD(f, roundel_field_from_solution(disk, g, f->solution, &field), ROUNDEL_ERROR_LENGTH_MISMATCH,
        "solution", NONE);
    GOOD(roundel_guidance_set_constraints(g, 2, far, angles));
    BAD(f, roundel_field_solve(disk, g, NULL, NULL, &field), range, "constrained", 1);
    GOOD(roundel_guidance_set_constraints(g, 2, twice, angles));
    BAD(f, roundel_field_solve(disk, g, NULL, NULL, &field), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "twice", 1);
    GOOD(roundel_guidance_set_constraints(g, 0, NULL, NULL));
    GOOD(roundel_guidance_set_guides(g, 2, far, angles, angles));
    BAD(f, roundel_field_solve(disk, g, NULL, NULL, &field), range, "guided", 1);
    GOOD(roundel_guidance_set_guides(g, 0, NULL, NULL, NULL));
    GOOD(roundel_guidance_set_indices(g, 2, far, twice));
    BAD(f, roundel_field_make_problem(disk, g, &problem), range, "index", 1);
    GOOD(roundel_guidance_clear_indices(g));
    GOOD(roundel_guidance_set_feature_lines(g, 1, apart));
    BAD(f, roundel_mesh_mark_features(disk, g, marks, edges), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "no edge joins", 0);
    GOOD(roundel_guidance_set_feature_lines(g, 0, NULL));
    GOOD(roundel_guidance_set_feature_edges(g, 2, far));
    BAD(f, roundel_mesh_mark_features(disk, g, marks, edges), range, "feature edges", 1);
    HOLDS(field == NULL && problem == NULL && marks[0] == 7);
    GOOD(roundel_guidance_free(g));
}

static void maps(fixture* f, const roundel_mesh* disk) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    roundel_mesh* other = NULL;
    roundel_guidance* lines = NULL;
    roundel_field *field = NULL, *two = NULL;
    roundel_map* map = NULL;
    roundel_problem* problem = NULL;
    roundel_solution* solution = NULL;
    roundel_monitor unsized_monitor = {0, NULL, NULL, NULL};
    double numbers[2] = {7.0, 7.0};
    int32_t whole[2] = {7, 7}, arms = 7;
    size_t count = 7;
    GOOD(roundel_mesh_make_shape("sphere", 200, &other));
    GOOD(roundel_guidance_new(&lines));
    GOOD(roundel_guidance_set_int(lines, "symmetry", 2));
    GOOD(roundel_field_solve(disk, NULL, NULL, NULL, &field));
    GOOD(roundel_field_solve(disk, lines, NULL, NULL, &two));
    BAD(f, roundel_field_symmetry(NULL, &arms), null, "field", NONE);
    BAD(f, roundel_field_symmetry(field, NULL), null, "symmetry", NONE);
    GOOD(roundel_field_symmetry(two, &arms));
    HOLDS(arms == 2);
    BAD(f, roundel_map_new(NULL, field, NULL, &map), null, "mesh", NONE);
    BAD(f, roundel_map_new(disk, NULL, NULL, &map), null, "field", NONE);
    BAD(f, roundel_map_new(disk, field, NULL, NULL), null, "map", NONE);
    BAD(f, roundel_map_new(other, field, NULL, &map), length, "expected", NONE);
    BAD(f, roundel_map_new(disk, two, NULL, &map), invalid, "symmetry 4", NONE);
    HOLDS(map == NULL);
    GOOD(roundel_map_new(disk, field, NULL, &map));
    BAD(f, roundel_map_set_quads(NULL, 100), null, "map", NONE);
    BAD(f, roundel_map_set_quads(map, 0), invalid, "quads is 0", NONE);
    BAD(f, roundel_map_set_edge_length(NULL, 1.0), null, "map", NONE);
    BAD(f, roundel_map_set_edge_length(map, 0.0), invalid, "above 0", NONE);
    BAD(f, roundel_map_set_edge_length(map, (double)NAN), ROUNDEL_ERROR_NOT_FINITE, "edge length",
        0);
    BAD(f, roundel_map_set_edge_lengths(NULL, numbers, 2), null, "map", NONE);
    BAD(f, roundel_map_set_edge_lengths(map, numbers, 2), length, "got 2", NONE);
    BAD(f, roundel_map_solve(NULL, NULL, NULL), null, "map", NONE);
    BAD(f, roundel_map_solve(map, NULL, &unsized_monitor), invalid, "monitor", NONE);
    BAD(f, roundel_map_solve_fold_free(NULL, NULL, NULL), null, "map", NONE);
    BAD(f, roundel_map_solve_fold_free(map, NULL, &unsized_monitor), invalid, "monitor", NONE);
    BAD(f, roundel_map_untangle(NULL, NULL), null, "map", NONE);
    BAD(f, roundel_map_untangle(map, NULL), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_make_problem(NULL, &problem), null, "map", NONE);
    BAD(f, roundel_map_make_problem(map, NULL), null, "problem", NONE);
    BAD(f, roundel_map_set_solution(map, NULL), null, "solution", NONE);
    BAD(f, roundel_map_set_solution(map, f->solution), length, "got 3", NONE);
    BAD(f, roundel_map_energy(map, numbers), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_vertex_count(map, &count), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_corner_uvs(map, numbers, 2), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_winding_defect_count(map, &count), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_round_count(map, &count), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_transitions(map, 0, NULL, NULL, NULL), invalid, "solved", NONE);
    BAD(f, roundel_map_solution(map, &solution), invalid, "has not been solved", NONE);
    BAD(f, roundel_map_write(map, "never.obj"), invalid, "has not been solved", NONE);
    GOOD(roundel_map_set_quads(map, 50));
    GOOD(roundel_options_set_text(f->options, "strategy", "relax"));
    GOOD(roundel_map_solve(map, f->options, NULL));
    BAD(f, roundel_map_untangle(map, NULL), invalid, "relaxation", NONE);
    GOOD(roundel_map_solve(map, NULL, NULL));
    BAD(f, roundel_map_untangle(map, &unsized_monitor), invalid, "monitor", NONE);
    BAD(f, roundel_map_corner_uvs(NULL, numbers, 2), null, "map", NONE);
    BAD(f, roundel_map_corner_uvs(map, numbers, 2), length, "corners", NONE);
    BAD(f, roundel_map_vertex_count(NULL, &count), null, "map", NONE);
    BAD(f, roundel_map_vertex_count(map, NULL), null, "vertex count", NONE);
    BAD(f, roundel_map_winding_defect_count(map, NULL), null, "winding defect count", NONE);
    BAD(f, roundel_map_winding_defects(map, whole, 2), length, "winding defects", NONE);
    BAD(f, roundel_map_round_count(NULL, &count), null, "map", NONE);
    BAD(f, roundel_map_refinement_count(map, NULL), null, "refinement count", NONE);
    BAD(f, roundel_map_vertex_uvs(map, numbers, 2), length, "vertices", NONE);
    BAD(f, roundel_map_vertex_corners(map, whole, 2), length, "corners", NONE);
    BAD(f, roundel_map_cut_count(map, NULL), null, "cut count", NONE);
    BAD(f, roundel_map_transitions(NULL, 0, NULL, NULL, NULL), null, "map", NONE);
    BAD(f, roundel_map_transitions(map, 1000000, whole, whole, numbers), length, "cut edges", NONE);
    BAD(f, roundel_map_cone_count(map, NULL), null, "cone count", NONE);
    BAD(f, roundel_map_cones(map, whole, 1000000), length, "cones", NONE);
    BAD(f, roundel_map_flipped_face_count(map, NULL), null, "flipped count", NONE);
    BAD(f, roundel_map_flipped_faces(map, whole, 1000000), length, "flipped", NONE);
    BAD(f, roundel_map_energy(map, NULL), null, "energy", NONE);
    BAD(f, roundel_map_solution(map, NULL), null, "solution", NONE);
    BAD(f, roundel_map_write(map, NULL), null, "file", NONE);
    BAD(f, roundel_map_write(map, "no/such/folder.obj"), ROUNDEL_ERROR_IO, "folder", NONE);
    HOLDS(numbers[0] == 7.0 && whole[0] == 7 && count == 7 && problem == NULL && solution == NULL);
    GOOD(roundel_map_free(map));
    GOOD(roundel_map_free(NULL));
    GOOD(roundel_field_free(field));
    GOOD(roundel_field_free(two));
    GOOD(roundel_guidance_free(lines));
    GOOD(roundel_mesh_free(other));
}

void bad_guidance(fixture* f) {
    roundel_mesh* disk = NULL;
    GOOD(roundel_mesh_make_shape("disk", 200, &disk));
    settings(f);
    on_a_mesh(f, disk);
    maps(f, disk);
    GOOD(roundel_mesh_free(disk));
}
