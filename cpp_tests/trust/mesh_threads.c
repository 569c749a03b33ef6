/*
 * Several threads use one mesh and one field at once: each makes a fold-free map and quads of its
 * own, all ask for the option texts for the first time, and one token cancels them all.
 */

#include <roundel/roundel.h>

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define THREADS 3

typedef struct {
    const roundel_mesh* mesh;
    const roundel_field* field;
    const roundel_guidance* guidance;
    const roundel_quad_options* options;
    roundel_cancel_token* token;
    double* uvs;
    size_t length, quads;
    roundel_status ended;
} job;

static void* make(void* data) {
    job* mine = data;
    roundel_map* map = NULL;
    roundel_quads* quads = NULL;
    roundel_option option;
    int good = roundel_option_info(0, &option) == ROUNDEL_OK && strlen(option.text) > 0;
    good = good && roundel_map_new(mine->mesh, mine->field, mine->guidance, &map) == ROUNDEL_OK &&
           roundel_map_set_quads(map, 60) == ROUNDEL_OK &&
           roundel_map_solve_fold_free(map, NULL, NULL) == ROUNDEL_OK &&
           roundel_map_corner_uvs(map, mine->uvs, mine->length) == ROUNDEL_OK &&
           roundel_quads_make(mine->mesh, mine->options, NULL, &quads) == ROUNDEL_OK &&
           roundel_quads_count(quads, &mine->quads) == ROUNDEL_OK;
    mine->ended = good ? ROUNDEL_OK : ROUNDEL_ERROR_INVALID_ARGUMENT;
    roundel_quads_free(quads);
    roundel_map_free(map);
    return NULL;
}

static int32_t cancel_all(const roundel_event* event, void* token) {
    (void)event;
    return roundel_cancel_token_cancel(token) == ROUNDEL_OK ? 0 : 1;
}

/* The first thread cancels by its own callback. The others are cancelled by the token. */
static void* cancelled(void* data) {
    job* mine = data;
    roundel_map* map = NULL;
    const roundel_monitor monitor = {sizeof monitor, cancel_all, mine->token, mine->token};
    if (roundel_map_new(mine->mesh, mine->field, NULL, &map) == ROUNDEL_OK) {
        mine->ended = roundel_map_solve_fold_free(map, NULL, &monitor);
    }
    roundel_map_free(map);
    return NULL;
}

static int all(job* jobs, void* (*body)(void*), roundel_status expected) {
    pthread_t threads[THREADS];
    int good = 1, started = 0;
    while (started < THREADS &&
           pthread_create(&threads[started], NULL, body, jobs + started) == 0) {
        ++started;
    }
    for (int k = 0; k < started; ++k) {
        pthread_join(threads[k], NULL);
        good = good && jobs[k].ended == expected;
    }
    return good && started == THREADS;
}

int main(void) {
    roundel_mesh* mesh = NULL;
    roundel_field* field = NULL;
    roundel_guidance* guidance = NULL;
    roundel_quad_options* options = NULL;
    roundel_cancel_token* token = NULL;
    size_t faces = 0;
    job jobs[THREADS] = {0};
    int good = roundel_mesh_make_shape("rounded-cube", 300, &mesh) == ROUNDEL_OK &&
               roundel_mesh_face_count(mesh, &faces) == ROUNDEL_OK &&
               roundel_guidance_new(&guidance) == ROUNDEL_OK &&
               roundel_quad_options_new(&options) == ROUNDEL_OK &&
               roundel_quad_options_set_int(options, "quads", 60) == ROUNDEL_OK &&
               roundel_quad_options_set_guidance(options, guidance) == ROUNDEL_OK &&
               roundel_field_solve(mesh, guidance, NULL, NULL, &field) == ROUNDEL_OK &&
               roundel_cancel_token_new(&token) == ROUNDEL_OK;
    for (int k = 0; k < THREADS; ++k) {
        double* uvs = calloc(6 * faces, sizeof *uvs);
        good = good && uvs != NULL;
        jobs[k] = (job){mesh, field, guidance, options, token, uvs, 6 * faces, 0, ROUNDEL_OK};
    }
    good = good && all(jobs, make, ROUNDEL_OK);
    for (int k = 1; good && k < THREADS; ++k) {
        good = jobs[k].quads > 0 && jobs[k].quads == jobs[0].quads &&
               memcmp(jobs[k].uvs, jobs[0].uvs, 6 * faces * sizeof *jobs[k].uvs) == 0;
    }
    good = good && all(jobs, cancelled, ROUNDEL_ERROR_CANCELLED);
    for (int k = 0; k < THREADS; ++k) {
        free(jobs[k].uvs);
    }
    roundel_cancel_token_free(token);
    roundel_field_free(field);
    roundel_quad_options_free(options);
    roundel_guidance_free(guidance);
    roundel_mesh_free(mesh);
    puts(good ? "as they should" : "FAILED");
    return good ? 0 : 1;
}
