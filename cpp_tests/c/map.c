/* Fields and maps through the C interface: indices are counted exactly, the sharp edges of a gear
 * and the rim of a plate lie exactly on isolines, a second solve gives the same map, and a callback
 * cancels. */

#include "check.h"

#include <roundel/roundel.h>

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    roundel_mesh* mesh;
    roundel_guidance* guidance;
    roundel_field* field;
    size_t faces, edges;
} model;

static model made(const char* shape, size_t triangles) {
    model m = {0};
    OK(roundel_mesh_make_shape(shape, triangles, &m.mesh));
    OK(roundel_mesh_face_count(m.mesh, &m.faces));
    OK(roundel_mesh_edge_count(m.mesh, &m.edges));
    OK(roundel_guidance_new(&m.guidance));
    OK(roundel_guidance_set_real(m.guidance, "feature_angle", 0.7));
    OK(roundel_guidance_set_real(m.guidance, "curvature_weight", 0.1));
    /* The default would work on a proof for a minute. */
    roundel_options* options = NULL;
    OK(roundel_options_new(&options));
    OK(roundel_options_set_text(options, "strategy", "lattice"));
    OK(roundel_field_solve(m.mesh, m.guidance, options, NULL, &m.field));
    OK(roundel_options_free(options));
    return m;
}

static void freed(model* m) {
    OK(roundel_field_free(m->field));
    OK(roundel_guidance_free(m->guidance));
    OK(roundel_mesh_free(m->mesh));
}

/* Indices are integers over 4, both counts and turns, and sum to the Euler characteristic. */
static void indices(const model* m) {
    size_t vertices = 0, loops = 0, irregular = 0, counted = 0;
    int64_t euler = 0, sum = 0;
    OK(roundel_mesh_vertex_count(m->mesh, &vertices));
    OK(roundel_mesh_boundary_loop_count(m->mesh, &loops));
    OK(roundel_mesh_euler_characteristic(m->mesh, &euler));
    OK(roundel_field_irregular_count(m->field, &irregular));
    int32_t* steps = malloc((vertices + loops) * sizeof *steps);
    double* turns = malloc((vertices + loops) * sizeof *turns);
    CHECK(steps != NULL && turns != NULL);
    OK(roundel_field_vertex_index_steps(m->field, steps, vertices));
    OK(roundel_field_boundary_index_steps(m->field, steps + vertices, loops));
    OK(roundel_field_vertex_indices(m->field, turns, vertices));
    OK(roundel_field_boundary_indices(m->field, turns + vertices, loops));
    for (size_t i = 0; i < vertices + loops; ++i) {
        CHECK(turns[i] == 0.25 * steps[i]);
        sum += steps[i];
        counted += i < vertices && (turns[i] == 0.25 || turns[i] == -0.25);
    }
    CHECK(sum == 4 * euler && counted == irregular);
    OK(roundel_field_traced_indices(m->field, turns, vertices));
    for (size_t v = 0; v < vertices; ++v) {
        CHECK(turns[v] == 0.25 * steps[v]);
    }
    free(steps);
    free(turns);
}

static double* corners(const roundel_map* map, size_t faces) {
    double* uv = malloc(6 * faces * sizeof *uv);
    CHECK(uv != NULL);
    OK(roundel_map_corner_uvs(map, uv, 6 * faces));
    return uv;
}

/* Counts the sides of faces on features. Each must lie on an integer isoline to the last digit. */
static size_t isolines(const model* m, const double* uv) {
    int32_t* mark = malloc(m->edges * sizeof *mark);
    int32_t* edge = malloc(3 * m->faces * sizeof *edge);
    size_t count = 0;
    CHECK(mark != NULL && edge != NULL);
    OK(roundel_mesh_mark_features(m->mesh, m->guidance, mark, m->edges));
    OK(roundel_mesh_face_edges(m->mesh, edge, 3 * m->faces));
    for (size_t side = 0; side < 3 * m->faces; ++side) {
        if (mark[edge[side]] == 1) {
            const double* a = uv + 2 * side;
            const double* b = uv + 2 * (side % 3 == 2 ? side - 2 : side + 1);
            const int along_v = a[0] == b[0] && floor(a[0]) == a[0];
            const int along_u = a[1] == b[1] && floor(a[1]) == a[1];
            CHECK(along_u || along_v);
            ++count;
        }
    }
    free(mark);
    free(edge);
    return count;
}

/* The corners of the faces have the coordinates of their vertices on the cut surface. */
static void indexed(const roundel_map* map, const double* uv, size_t faces) {
    size_t vertices = 0;
    OK(roundel_map_vertex_count(map, &vertices));
    double* of_vertex = malloc(2 * vertices * sizeof *of_vertex);
    int32_t* corner = malloc(3 * faces * sizeof *corner);
    CHECK(of_vertex != NULL && corner != NULL);
    OK(roundel_map_vertex_uvs(map, of_vertex, 2 * vertices));
    OK(roundel_map_vertex_corners(map, corner, 3 * faces));
    for (size_t k = 0; k < 3 * faces; ++k) {
        CHECK(memcmp(of_vertex + 2 * corner[k], uv + 2 * k, 2 * sizeof *uv) == 0);
    }
    free(of_vertex);
    free(corner);
}

static void transitions(const roundel_map* map) {
    size_t cut = 0;
    OK(roundel_map_cut_count(map, &cut));
    CHECK(cut > 0);
    int32_t* edge = malloc(cut * sizeof *edge);
    int32_t* quarters = malloc(cut * sizeof *quarters);
    double* translation = malloc(2 * cut * sizeof *translation);
    CHECK(edge != NULL && quarters != NULL && translation != NULL);
    OK(roundel_map_transitions(map, cut, edge, quarters, translation));
    for (size_t i = 0; i < cut; ++i) {
        CHECK(i == 0 || edge[i - 1] < edge[i]);
        CHECK(quarters[i] >= 0 && quarters[i] < 4);
        CHECK(floor(translation[2 * i]) == translation[2 * i]);
        CHECK(floor(translation[2 * i + 1]) == translation[2 * i + 1]);
    }
    free(edge);
    free(quarters);
    free(translation);
}

/* Solving again at another size gives the same map as a new map at that size. */
static void again(const model* m, roundel_map* map) {
    roundel_map* fresh = NULL;
    double energies[2] = {0.0, 1.0};
    OK(roundel_map_set_edge_length(map, 0.09));
    OK(roundel_map_solve(map, NULL, NULL));
    OK(roundel_map_new(m->mesh, m->field, NULL, &fresh));
    OK(roundel_map_set_edge_length(fresh, 0.09));
    OK(roundel_map_solve(fresh, NULL, NULL));
    double *a = corners(map, m->faces), *b = corners(fresh, m->faces);
    CHECK(memcmp(a, b, 6 * m->faces * sizeof *a) == 0);
    OK(roundel_map_energy(map, energies));
    OK(roundel_map_energy(fresh, energies + 1));
    CHECK(energies[0] == energies[1] && isolines(m, a) > 0);

    /* The same length along and across in every face, given as a list. */
    double* lengths = malloc(2 * m->faces * sizeof *lengths);
    CHECK(lengths != NULL);
    for (size_t i = 0; i < 2 * m->faces; ++i) {
        lengths[i] = 0.09;
    }
    OK(roundel_map_set_edge_lengths(fresh, lengths, 2 * m->faces));
    OK(roundel_map_solve(fresh, NULL, NULL));
    OK(roundel_map_corner_uvs(fresh, b, 6 * m->faces));
    CHECK(memcmp(a, b, 6 * m->faces * sizeof *a) == 0);
    free(lengths);
    free(a);
    free(b);
    OK(roundel_map_free(fresh));
}

/* A map of few quads has folds at the holes of the plate. Untangling removes some of them and keeps
 * its features on isolines. */
static void untangled(const model* m) {
    roundel_map* map = NULL;
    size_t before = 0, after = 0;
    OK(roundel_map_new(m->mesh, m->field, NULL, &map));
    OK(roundel_map_set_quads(map, 210));
    OK(roundel_map_solve(map, NULL, NULL));
    OK(roundel_map_flipped_face_count(map, &before));
    OK(roundel_map_untangle(map, NULL));
    OK(roundel_map_flipped_face_count(map, &after));
    CHECK(before > 0 && after < before);
    double* uv = corners(map, m->faces);
    CHECK(isolines(m, uv) > 100);
    free(uv);
    OK(roundel_map_free(map));
}

/* Stiffening changes the map. Untangling removes folds of direct rounding with it and without it.
 */
static void stiffened(const model* m) {
    roundel_map* map = NULL;
    roundel_options* direct = NULL;
    size_t before = 0, soft = 0, stiff = 0;
    OK(roundel_options_new(&direct));
    OK(roundel_options_set_text(direct, "strategy", "direct"));
    OK(roundel_map_new(m->mesh, m->field, NULL, &map));
    OK(roundel_map_set_quads(map, 80));
    OK(roundel_map_solve(map, direct, NULL));
    OK(roundel_map_flipped_face_count(map, &before));
    OK(roundel_map_untangle(map, NULL));
    OK(roundel_map_flipped_face_count(map, &stiff));
    double* a = corners(map, m->faces);

    OK(roundel_map_set_stiffening_count(map, 0));
    OK(roundel_map_solve(map, direct, NULL));
    OK(roundel_map_untangle(map, NULL));
    OK(roundel_map_flipped_face_count(map, &soft));
    double* b = corners(map, m->faces);
    CHECK(before > 0 && soft < before && stiff < before);
    CHECK(memcmp(a, b, 6 * m->faces * sizeof *a) != 0);
    free(a);
    free(b);
    OK(roundel_map_free(map));
    OK(roundel_options_free(direct));
}

/* The fold-free solve decides collapsed cones anew and refines the mesh where folds remain. A plain
 * solve of the same map afterwards gives the same result as before. */
static void fold_free(const model* m) {
    roundel_map* map = NULL;
    size_t rounded = 0, flipped = 9, winding_defects = 9, rounds = 0, refinements = 9;
    OK(roundel_map_new(m->mesh, m->field, NULL, &map));
    OK(roundel_map_set_quads(map, 210));
    OK(roundel_map_solve(map, NULL, NULL));
    OK(roundel_map_flipped_face_count(map, &rounded));
    double* plain = corners(map, m->faces);
    OK(roundel_map_refinement_count(map, &refinements));
    CHECK(rounded > 0 && refinements == 0);

    OK(roundel_map_solve_fold_free(map, NULL, NULL));
    OK(roundel_map_flipped_face_count(map, &flipped));
    OK(roundel_map_winding_defect_count(map, &winding_defects));
    OK(roundel_map_round_count(map, &rounds));
    OK(roundel_map_refinement_count(map, &refinements));
    CHECK(flipped == 0 && winding_defects == 0 && rounds + refinements > 0);
    OK(roundel_map_winding_defects(map, NULL, 0));
    double* uv = corners(map, m->faces);
    CHECK(isolines(m, uv) > 100);
    OK(roundel_map_untangle(map, NULL));
    double* still = corners(map, m->faces);
    CHECK(memcmp(uv, still, 6 * m->faces * sizeof *uv) == 0);

    OK(roundel_map_solve(map, NULL, NULL));
    OK(roundel_map_corner_uvs(map, uv, 6 * m->faces));
    CHECK(memcmp(uv, plain, 6 * m->faces * sizeof *uv) == 0);
    OK(roundel_map_round_count(map, &rounds));
    CHECK(rounds == 0);
    free(still);
    free(plain);
    free(uv);
    OK(roundel_map_free(map));
}

/* Taking the solution of the map's problem gives the same map as solving the map. */
static void elsewhere(const model* m, roundel_map* map) {
    roundel_problem* problem = NULL;
    roundel_solution* solution = NULL;
    double *a = corners(map, m->faces), *b = NULL;
    OK(roundel_map_make_problem(map, &problem));
    OK(roundel_problem_solve(problem, NULL, NULL, &solution));
    OK(roundel_map_set_solution(map, solution));
    b = corners(map, m->faces);
    CHECK(memcmp(a, b, 6 * m->faces * sizeof *a) == 0);
    free(a);
    free(b);
    OK(roundel_solution_free(solution));
    OK(roundel_problem_free(problem));
}

static int32_t count_events(const roundel_event* event, void* user_data) {
    int* calls = user_data;
    (void)event;
    ++*calls;
    return 0;
}

static int32_t stop_at_once(const roundel_event* event, void* user_data) {
    (void)event;
    (void)user_data;
    return 1;
}

static void watched(const model* m) {
    roundel_map* map = NULL;
    roundel_monitor monitor = {sizeof monitor, stop_at_once, NULL, NULL};
    double energy = 7.0;
    int calls = 0;
    OK(roundel_map_new(m->mesh, m->field, NULL, &map));
    CHECK(roundel_map_solve(map, NULL, &monitor) == ROUNDEL_ERROR_CANCELLED);
    CHECK(roundel_map_solve_fold_free(map, NULL, &monitor) == ROUNDEL_ERROR_CANCELLED);
    CHECK(roundel_map_energy(map, &energy) == ROUNDEL_ERROR_INVALID_ARGUMENT && energy == 7.0);
    monitor.callback = count_events;
    monitor.user_data = &calls;
    OK(roundel_map_solve(map, NULL, &monitor));
    OK(roundel_map_energy(map, &energy));
    CHECK(calls > 0 && energy > 0.0);
    OK(roundel_map_free(map));
}

int main(void) {
    const char* const shapes[] = {"gear", "plate-with-holes"};
    for (size_t i = 0; i < 2; ++i) {
        model m = made(shapes[i], 2000);
        indices(&m);
        roundel_map* map = NULL;
        OK(roundel_map_new(m.mesh, m.field, NULL, &map));
        OK(roundel_map_set_quads(map, 600));
        OK(roundel_map_solve(map, NULL, NULL));
        double* uv = corners(map, m.faces);
        CHECK(isolines(&m, uv) > 100);
        indexed(map, uv, m.faces);
        if (i == 0) {
            transitions(map);
        }
        again(&m, map);
        elsewhere(&m, map);
        if (i == 1) {
            untangled(&m);
            fold_free(&m);
        }
        watched(&m);
        free(uv);
        OK(roundel_map_free(map));
        freed(&m);
    }
    model genus = made("genus-2", 2000);
    stiffened(&genus);
    freed(&genus);
    return 0;
}
