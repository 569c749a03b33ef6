/* Sources that are not on the mesh, and questions about points that are not. */

#include "bad_input.h"

static const int32_t faces[3] = {0, 0, 40};
static const double inside[9] = {0.2, 0.3, 0.5, 0.5, 0.3, 0.2, 0.2, 0.3, 0.5};

static void sources_are_checked(fixture* f, const roundel_mesh* mesh) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const int32_t vertices[2] = {0, 1000000}, negative[2] = {3, -1};
    const double outside[6] = {0.2, 0.3, 0.5, 1.5, -0.5, 0.0}, nan[3] = {NAN, 0.5, 0.5};
    roundel_sources* sources = NULL;
    roundel_geodesic* geodesic = NULL;
    size_t count = 7;
    BAD(f, roundel_sources_new(NULL), null, "sources", NONE);
    GOOD(roundel_sources_new(&sources));
    BAD(f, roundel_geodesic_new(mesh, sources, INFINITY, 0, NULL, &geodesic), invalid, "no sources",
        NONE);
    BAD(f, roundel_sources_add_vertices(sources, 2, negative), range, "entry 1 is -1", 1);
    BAD(f, roundel_sources_add_vertices(sources, 2, NULL), null, "vertices", NONE);
    BAD(f, roundel_sources_add_points(sources, 2, NULL, inside), null, "faces", NONE);
    BAD(f, roundel_sources_add_points(sources, 2, faces, NULL), null, "barycentric", NONE);
    BAD(f, roundel_sources_add_polyline(sources, (size_t)-1, faces, inside, 0),
        ROUNDEL_ERROR_OVERFLOW, "barycentric", NONE);
    BAD(f, roundel_sources_add_edges(sources, 1, negative + 1), range, "entry 0 is -1", 0);
    BAD(f, roundel_sources_add_boundary(sources, NULL), null, "mesh", NONE);
    BAD(f, roundel_sources_count(sources, NULL), null, "count", NONE);
    GOOD(roundel_sources_count(sources, &count));
    HOLDS(count == 0);
    GOOD(roundel_sources_add_vertices(sources, 2, vertices));
    BAD(f, roundel_geodesic_new(mesh, sources, INFINITY, 0, NULL, &geodesic), range, "1000000", 1);
    GOOD(roundel_sources_free(sources));
    GOOD(roundel_sources_new(&sources));
    GOOD(roundel_sources_add_points(sources, 2, faces, outside));
    BAD(f, roundel_geodesic_new(mesh, sources, INFINITY, 0, NULL, &geodesic), invalid,
        "source 1: point 0 is outside of face 0", 1);
    GOOD(roundel_sources_free(sources));
    GOOD(roundel_sources_new(&sources));
    GOOD(roundel_sources_add_points(sources, 1, faces, nan));
    BAD(f, roundel_geodesic_new(mesh, sources, INFINITY, 0, NULL, &geodesic),
        ROUNDEL_ERROR_NOT_FINITE, "barycentric", 0);
    GOOD(roundel_sources_free(sources));
    GOOD(roundel_sources_new(&sources));
    GOOD(roundel_sources_add_polyline(sources, 3, faces, inside, 0));
    BAD(f, roundel_geodesic_new(mesh, sources, INFINITY, 0, NULL, &geodesic), invalid,
        "points 1 and 2", 0);
    HOLDS(geodesic == NULL);
    GOOD(roundel_sources_free(sources));
    GOOD(roundel_sources_free(NULL));
}

static void questions_are_checked(fixture* f, const roundel_mesh* mesh, size_t vertices) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const int32_t first = 0, far_face[1] = {1000000};
    roundel_sources* sources = NULL;
    roundel_geodesic *geodesic = NULL, *alone = NULL;
    roundel_mesh* other = NULL;
    int32_t number[1], path[100];
    double value[3], weights[300];
    size_t count = 7;
    GOOD(roundel_sources_new(&sources));
    GOOD(roundel_sources_add_vertices(sources, 1, &first));
    BAD(f, roundel_geodesic_new(NULL, sources, 1.0, 0, NULL, &geodesic), null, "mesh", NONE);
    BAD(f, roundel_geodesic_new(mesh, NULL, 1.0, 0, NULL, &geodesic), null, "sources", NONE);
    BAD(f, roundel_geodesic_new(mesh, sources, 1.0, 0, NULL, NULL), null, "geodesic", NONE);
    BAD(f, roundel_geodesic_new(mesh, sources, NAN, 0, NULL, &geodesic),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "limit", NONE);
    BAD(f, roundel_geodesic_new(mesh, sources, -1.0, 0, NULL, &geodesic),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "limit", NONE);
    GOOD(roundel_geodesic_new(mesh, sources, INFINITY, 1, NULL, &geodesic));
    GOOD(roundel_geodesic_new(mesh, sources, INFINITY, 0, NULL, &alone));
    GOOD(roundel_mesh_make_shape("sphere", 900, &other));
    BAD(f, roundel_geodesic_distances(NULL, value, 1), null, "geodesic", NONE);
    BAD(f, roundel_geodesic_distances(geodesic, value, 1), length, "distances", NONE);
    BAD(f, roundel_geodesic_distances(geodesic, NULL, vertices), null, "distances", NONE);
    BAD(f, roundel_geodesic_nearest_sources(geodesic, number, 1), length, "sources", NONE);
    BAD(f, roundel_geodesic_distances_at(geodesic, NULL, 1, faces, inside, value), null, "mesh",
        NONE);
    BAD(f, roundel_geodesic_distances_at(geodesic, other, 1, faces, inside, value), length,
        "vertices of the mesh", NONE);
    BAD(f, roundel_geodesic_distances_at(geodesic, mesh, 1, far_face, inside, value),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "face", 0);
    BAD(f, roundel_geodesic_distances_at(alone, mesh, 1, faces, inside, value),
        ROUNDEL_ERROR_INVALID_ARGUMENT, "everywhere", NONE);
    BAD(f, roundel_geodesic_gradients_at(geodesic, mesh, 1, faces, inside, NULL), null, "gradients",
        NONE);
    BAD(f, roundel_geodesic_path(geodesic, mesh, -1, inside, 0, NULL, NULL, &count),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "faces", 0);
    BAD(f, roundel_geodesic_path(geodesic, mesh, 40, inside, 0, NULL, NULL, NULL), null, "count",
        NONE);
    BAD(f, roundel_geodesic_path(geodesic, mesh, 40, NULL, 0, NULL, NULL, &count), null,
        "barycentric", NONE);
    BAD(f, roundel_geodesic_path(geodesic, mesh, 40, inside, 1, path, weights, &count), length,
        "points of the path", NONE);
    HOLDS(count == 7);
    GOOD(roundel_geodesic_path(geodesic, mesh, 40, inside, 0, NULL, NULL, &count));
    HOLDS(count > 1 && count <= 100);
    GOOD(roundel_geodesic_path(geodesic, mesh, 40, inside, 100, path, weights, &count));
    HOLDS(path[0] == 40 && weights[2] == 0.5);
    GOOD(roundel_geodesic_distances_at(geodesic, mesh, 1, path + count - 1, weights + 3 * count - 3,
                                       value));
    HOLDS(value[0] == 0.0);
    GOOD(roundel_geodesic_gradients_at(geodesic, mesh, 1, faces + 2, inside + 6, value));
    HOLDS(fabs(value[0] * value[0] + value[1] * value[1] + value[2] * value[2] - 1.0) < 1e-12);
    GOOD(roundel_mesh_free(other));
    GOOD(roundel_geodesic_free(alone));
    GOOD(roundel_geodesic_free(geodesic));
    GOOD(roundel_geodesic_free(NULL));
    GOOD(roundel_sources_free(sources));
}

void bad_geodesics(fixture* f) {
    roundel_mesh* mesh = NULL;
    size_t vertices = 0;
    GOOD(roundel_mesh_make_shape("sphere", 200, &mesh));
    GOOD(roundel_mesh_vertex_count(mesh, &vertices));
    sources_are_checked(f, mesh);
    questions_are_checked(f, mesh, vertices);
    GOOD(roundel_mesh_free(mesh));
}
