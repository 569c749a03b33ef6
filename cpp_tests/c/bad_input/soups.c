/* Soups: lengths that lie, files that are not there, soups without a surface, NULL for every
 * argument. Defects of the soup itself are no errors: repair tells them. */

#define _POSIX_C_SOURCE 200809L

#include "bad_input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A square, a point that no polygon uses, and a polygon that names a vertex that is not there. */
static const double xyz[15] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0,
                               0.0, 0.0, 1.0, 0.0, 5.0, 5.0, 5.0};
static const int32_t sizes[2] = {4, 3};
static const int32_t corners[7] = {0, 1, 2, 3, 0, 1, 9};

static void arrays(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const roundel_status overflow = ROUNDEL_ERROR_OVERFLOW;
    const int32_t negative[2] = {8, -1}, large[2] = {INT32_MAX, INT32_MAX};
    const int64_t wide[7] = {0, 1, 2, 3, 0, 1, INT64_MIN};
    const size_t most = (size_t)-1;
    roundel_soup* soup = NULL;
    BAD(f, roundel_soup_new(5, xyz, 2, sizes, 7, corners, NULL), null, "soup", NONE);
    BAD(f, roundel_soup_new(5, NULL, 2, sizes, 7, corners, &soup), null, "coordinates", NONE);
    BAD(f, roundel_soup_new(5, xyz, 2, NULL, 7, corners, &soup), null, "sizes", NONE);
    BAD(f, roundel_soup_new(5, xyz, 2, sizes, 7, NULL, &soup), null, "corners", NONE);
    BAD(f, roundel_soup_new_i64(5, xyz, 2, sizes, 7, wide, NULL), null, "soup", NONE);
    BAD(f, roundel_soup_new_i64(5, xyz, 2, sizes, 7, NULL, &soup), null, "corners", NONE);
    BAD(f, roundel_soup_new(5, xyz, 2, sizes, 6, corners, &soup), length, "expected 7", NONE);
    BAD(f, roundel_soup_new(5, xyz, 1, sizes, 7, corners, &soup), length, "expected 4", NONE);
    BAD(f, roundel_soup_new(5, xyz, 0, NULL, 7, corners, &soup), length, "expected 0", NONE);
    BAD(f, roundel_soup_new(5, xyz, 2, large, 7, corners, &soup), length, "4294967294", NONE);
    BAD(f, roundel_soup_new_i64(5, xyz, 2, sizes, 6, wide, &soup), length, "expected 7", NONE);
    BAD(f, roundel_soup_new(5, xyz, 2, negative, 7, corners, &soup), ROUNDEL_ERROR_INVALID_ARGUMENT,
        "entry 1 is -1", 1);
    BAD(f, roundel_soup_new(most, xyz, 2, sizes, 7, corners, &soup), overflow, "coordinates", NONE);
    BAD(f, roundel_soup_new(5, xyz, most, sizes, 7, corners, &soup), overflow, "sizes", NONE);
    BAD(f, roundel_soup_new(5, xyz, 2, sizes, most, corners, &soup), overflow, "corners", NONE);
    HOLDS(soup == NULL);
    GOOD(roundel_soup_new_i64(5, xyz, 2, sizes, 7, wide, &soup));
    GOOD(roundel_soup_free(soup));
    GOOD(roundel_soup_free(NULL));
}

static void files(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status none = ROUNDEL_ERROR_NOT_SUPPORTED;
    char name[] = "soup-XXXXXX";
    roundel_soup* soup = NULL;
    roundel_mesh* mesh = NULL;
    size_t counts[3] = {7, 7, 7};
    BAD(f, roundel_soup_read(NULL, &soup), null, "file", NONE);
    BAD(f, roundel_soup_read("never.stl", NULL), null, "soup", NONE);
    BAD(f, roundel_soup_read("never.stl", &soup), ROUNDEL_ERROR_IO, "never.stl", NONE);
    BAD(f, roundel_soup_read("never.3mf", &soup), none, "3mf", NONE);
    BAD(f, roundel_soup_read("never.usda", &soup), ROUNDEL_ERROR_IO, "never.usda", NONE);
    BAD(f, roundel_soup_read_as(NULL, "off", &soup), null, "file", NONE);
    BAD(f, roundel_soup_read_as("never", NULL, &soup), null, "format", NONE);
    BAD(f, roundel_soup_read_as("never", "off", NULL), null, "soup", NONE);
    BAD(f, roundel_soup_read_as("never", "off", &soup), ROUNDEL_ERROR_IO, "never", NONE);
    BAD(f, roundel_soup_read_as("never", "doc", &soup), none, "doc", NONE);
    BAD(f, roundel_soup_read_as("never", "\xff", &soup), ROUNDEL_ERROR_INVALID_ARGUMENT, "UTF-8",
        NONE);

    const int file = mkstemp(name);
    const char bad[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n";
    HOLDS(file >= 0 && write(file, bad, strlen(bad)) == (ssize_t)strlen(bad));
    BAD(f, roundel_soup_read(name, &soup), none, "format", NONE);
    BAD_LINE(f, "a number that is none", roundel_soup_read_as(name, "OFF", &soup),
             ROUNDEL_ERROR_PARSE, "x", NONE, 5);
    /* A binary file that ends early has no lines. */
    BAD(f, roundel_soup_read_as(name, "glb", &soup), ROUNDEL_ERROR_PARSE, "", NONE);
    HOLDS(soup == NULL);

    const char good[] = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    HOLDS(ftruncate(file, 0) == 0 && lseek(file, 0, SEEK_SET) == 0 &&
          write(file, good, strlen(good)) == (ssize_t)strlen(good));
    GOOD(roundel_soup_read_as(name, "off", &soup));
    GOOD(roundel_soup_vertex_count(soup, counts));
    GOOD(roundel_soup_polygon_counts(soup, counts + 1, counts + 2));
    HOLDS(counts[0] == 4 && counts[1] == 1 && counts[2] == 4);
    GOOD(roundel_soup_free(soup));
    HOLDS(close(file) == 0 && unlink(name) == 0 && mesh == NULL);
}

static void copies(fixture* f, const roundel_soup* soup) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    size_t count = 7, all = 7;
    double numbers[15] = {7.0};
    int32_t counted[2] = {7, 7};
    int64_t named[7] = {7};
    BAD(f, roundel_soup_vertex_count(NULL, &count), null, "soup", NONE);
    BAD(f, roundel_soup_vertex_count(soup, NULL), null, "vertex count", NONE);
    BAD(f, roundel_soup_polygon_counts(NULL, &count, &all), null, "soup", NONE);
    BAD(f, roundel_soup_polygon_counts(soup, NULL, &all), null, "polygon count", NONE);
    BAD(f, roundel_soup_polygon_counts(soup, &count, NULL), null, "corner count", NONE);
    BAD(f, roundel_soup_coordinates(NULL, numbers, 15), null, "soup", NONE);
    BAD(f, roundel_soup_coordinates(soup, NULL, 15), null, "coordinates", NONE);
    BAD(f, roundel_soup_coordinates(soup, numbers, 5), length, "expected 15", NONE);
    BAD(f, roundel_soup_polygons(NULL, 2, counted, 7, named), null, "soup", NONE);
    BAD(f, roundel_soup_polygons(soup, 2, NULL, 7, named), null, "sizes", NONE);
    BAD(f, roundel_soup_polygons(soup, 2, counted, 7, NULL), null, "corners", NONE);
    BAD(f, roundel_soup_polygons(soup, 1, counted, 7, named), length, "expected 2", NONE);
    BAD(f, roundel_soup_polygons(soup, 2, counted, 6, named), length, "expected 7", NONE);
    HOLDS(count == 7 && all == 7 && numbers[0] == 7.0 && counted[0] == 7 && named[0] == 7);
    GOOD(roundel_soup_vertex_count(soup, &count));
    GOOD(roundel_soup_polygon_counts(soup, &count, &all));
    GOOD(roundel_soup_coordinates(soup, numbers, 15));
    GOOD(roundel_soup_polygons(soup, 2, counted, 7, named));
    HOLDS(count == 2 && all == 7 && memcmp(numbers, xyz, sizeof xyz) == 0);
    HOLDS(memcmp(counted, sizes, sizeof sizes) == 0 && named[3] == 3 && named[6] == 9);
}

static void settings(fixture* f, const roundel_soup* soup) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status beyond = ROUNDEL_ERROR_OPTION_RANGE;
    const roundel_status type = ROUNDEL_ERROR_OPTION_TYPE;
    roundel_option option;
    roundel_repair_options* set = NULL;
    roundel_repair* repair = NULL;
    size_t count = 7;
    BAD(f, roundel_repair_options_new(NULL), null, "repair options", NONE);
    GOOD(roundel_repair_options_new(&set));
    BAD(f, roundel_repair_options_set_int(NULL, "fill_holes", 1), null, "repair options", NONE);
    BAD(f, roundel_repair_options_set_real(NULL, "weld", 1.0), null, "repair options", NONE);
    BAD(f, roundel_repair_options_set_text(NULL, "weld", "1"), null, "repair options", NONE);
    BAD(f, roundel_repair_options_set_int(set, NULL, 1), null, "option name", NONE);
    BAD(f, roundel_repair_options_set_text(set, "weld", NULL), null, "option value", NONE);
    BAD(f, roundel_repair_options_set_int(set, "fill_holes", 1001), beyond, "1001", NONE);
    BAD(f, roundel_repair_options_set_int(set, "fill_holes", -1), beyond, "-1", NONE);
    BAD(f, roundel_repair_options_set_real(set, "fill_holes", 1.0), type, "whole", NONE);
    BAD(f, roundel_repair_options_set_text(set, "weld", "near"), type, "weld", NONE);
    BAD(f, roundel_repair_options_set_real(set, "weld", (double)NAN), beyond, "NaN", NONE);
    BAD(f, roundel_repair_options_set_real(set, "weld", (double)INFINITY), beyond, "inf", NONE);
    BAD(f, roundel_repair_options_set_real(set, "drop_components", 1.5), beyond, "1.5", NONE);
    BAD(f, roundel_repair_options_set_int(set, "quads", 1), ROUNDEL_ERROR_UNKNOWN_OPTION, "quads",
        NONE);
    for (size_t i = 0; i < roundel_repair_option_count(); ++i) {
        GOOD(roundel_repair_option_info(i, &option));
        HOLDS(option.text[0] != '\0');
    }
    BAD(f, roundel_repair_option_info(0, NULL), null, "option", NONE);
    BAD(f, roundel_repair_option_info(roundel_repair_option_count(), &option),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "options", 0);
    /* After all these calls the options are as new, and can be set. */
    GOOD(roundel_soup_repair(soup, set, &repair));
    GOOD(roundel_repair_count_of(repair, ROUNDEL_EDIT_HOLE_FILLED, &count));
    HOLDS(count == 0);
    GOOD(roundel_repair_free(repair));
    GOOD(roundel_repair_options_set_int(set, "fill_holes", 4));
    GOOD(roundel_soup_repair(soup, set, &repair));
    GOOD(roundel_repair_count_of(repair, ROUNDEL_EDIT_HOLE_FILLED, &count));
    HOLDS(count == 1);
    GOOD(roundel_repair_free(repair));
    GOOD(roundel_repair_options_free(set));
    GOOD(roundel_repair_options_free(NULL));
}

static void no_surface(fixture* f) {
    const roundel_status empty = ROUNDEL_ERROR_EMPTY;
    const double infinite[9] = {0.0, 0.0, 0.0, 1.0, 0.0, (double)INFINITY, 0.0, 1.0, 0.0};
    const int32_t triangle[1] = {3}, line[3] = {0, 1, 0};
    roundel_soup* soup = NULL;
    roundel_repair* repair = NULL;
    GOOD(roundel_soup_new(0, NULL, 0, NULL, 0, NULL, &soup));
    BAD(f, roundel_soup_repair(soup, NULL, &repair), empty, "no polygon", NONE);
    GOOD(roundel_soup_free(soup));
    GOOD(roundel_soup_new(3, infinite, 1, triangle, 3, corners, &soup));
    BAD(f, roundel_soup_repair(soup, NULL, &repair), empty, "not finite", NONE);
    GOOD(roundel_soup_free(soup));
    GOOD(roundel_soup_new(5, xyz, 1, triangle, 3, line, &soup));
    BAD(f, roundel_soup_repair(soup, NULL, &repair), empty, "degenerate", NONE);
    GOOD(roundel_soup_free(soup));
    HOLDS(repair == NULL);
}

/* The attributes of a triangle with a scalar and a colour, read from a file. */
static void attributes(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status argument = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const char name[] = "bad_input_attributes.ply";
    roundel_mesh *mesh = NULL, *other = NULL;
    roundel_attributes* found = NULL;
    size_t count = 7;
    int32_t has = 7, labels[1] = {7};
    double values[4] = {7};
    char text[16] = "7";
    FILE* file = fopen(name, "w");
    HOLDS(file != NULL);
    if (file == NULL) {
        return;
    }
    fputs("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nproperty float heat\nelement face 1\n"
          "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
          "property uchar blue\nend_header\n0 0 0 1.5\n1 0 0 2\n0 1 0 3\n3 0 1 2 255 0 51\n",
          file);
    fclose(file);
    GOOD(roundel_mesh_read(name, &mesh));
    GOOD(roundel_mesh_make_shape("torus", 200, &other));
    BAD(f, roundel_mesh_read_attributes(NULL, name, &found), null, "mesh", NONE);
    BAD(f, roundel_mesh_read_attributes(mesh, NULL, &found), null, "file", NONE);
    BAD(f, roundel_mesh_read_attributes(mesh, name, NULL), null, "attributes", NONE);
    BAD(f, roundel_mesh_read_attributes(other, name, &found), length, "expected", NONE);
    BAD(f, roundel_mesh_read_attributes(mesh, "none.ply", &found), ROUNDEL_ERROR_IO, "none.ply",
        NONE);
    HOLDS(found == NULL);
    GOOD(roundel_mesh_read_attributes(mesh, name, &found));
    remove(name);
    BAD(f, roundel_attributes_has(NULL, "uv", &has), null, "attributes", NONE);
    BAD(f, roundel_attributes_has(found, NULL, &has), null, "kind", NONE);
    BAD(f, roundel_attributes_has(found, "uv", NULL), null, "has", NONE);
    BAD(f, roundel_attributes_has(found, "weight", &has), argument, "weight", NONE);
    BAD(f, roundel_attributes_name_count(NULL, "scalars", &count), null, "attributes", NONE);
    BAD(f, roundel_attributes_name_count(found, NULL, &count), null, "kind", NONE);
    BAD(f, roundel_attributes_name_count(found, "scalars", NULL), null, "count", NONE);
    BAD(f, roundel_attributes_name_count(found, "uv", &count), argument, "uv", NONE);
    BAD(f, roundel_attributes_name(NULL, "scalars", 0, text, sizeof text, NULL), null, "attributes",
        NONE);
    BAD(f, roundel_attributes_name(found, NULL, 0, text, sizeof text, NULL), null, "kind", NONE);
    BAD(f, roundel_attributes_name(found, "scalars", 1, text, sizeof text, NULL), range, "names",
        0);
    BAD(f, roundel_attributes_name(found, "scalars", 0, text, 4, NULL), length, "got 4", NONE);
    BAD(f, roundel_attributes_name(found, "scalars", 0, NULL, 4, NULL), null, "buffer", NONE);
    BAD(f, roundel_attributes_labels(NULL, "groups", labels, 1), null, "attributes", NONE);
    BAD(f, roundel_attributes_labels(found, NULL, labels, 1), null, "kind", NONE);
    BAD(f, roundel_attributes_labels(found, "groups", labels, 1), argument, "groups", NONE);
    BAD(f, roundel_attributes_labels(found, "uv", labels, 1), argument, "uv", NONE);
    BAD(f, roundel_attributes_values(NULL, "face_colors", values, 4), null, "attributes", NONE);
    BAD(f, roundel_attributes_values(found, NULL, values, 4), null, "kind", NONE);
    BAD(f, roundel_attributes_values(found, "face_colors", NULL, 4), null, "values", NONE);
    BAD(f, roundel_attributes_values(found, "face_colors", values, 3), length, "expected 4", NONE);
    BAD(f, roundel_attributes_values(found, "uv", values, 4), argument, "uv", NONE);
    BAD(f, roundel_attributes_scalar(NULL, 0, values, 3), null, "attributes", NONE);
    BAD(f, roundel_attributes_scalar(found, 1, values, 3), range, "scalars", 0);
    BAD(f, roundel_attributes_scalar(found, 0, NULL, 3), null, "values", NONE);
    BAD(f, roundel_attributes_scalar(found, 0, values, 4), length, "expected 3", NONE);
    HOLDS(count == 7 && has == 7 && labels[0] == 7 && values[0] == 7.0 && text[0] == '7');

    GOOD(roundel_attributes_has(found, "scalars", &has));
    GOOD(roundel_attributes_name_count(found, "scalars", &count));
    HOLDS(has == 1 && count == 1);
    GOOD(roundel_attributes_name(found, "scalars", 0, text, sizeof text, NULL));
    HOLDS(strcmp(text, "heat") == 0);
    GOOD(roundel_attributes_scalar(found, 0, values, 3));
    HOLDS(values[0] == 1.5 && values[1] == 2.0 && values[2] == 3.0);
    GOOD(roundel_attributes_values(found, "face_colors", values, 4));
    HOLDS(values[0] == 1.0 && values[1] == 0.0 && values[2] == 0.2 && values[3] == 1.0);
    GOOD(roundel_attributes_free(NULL));
    GOOD(roundel_attributes_free(found));
    GOOD(roundel_mesh_free(mesh));
    GOOD(roundel_mesh_free(other));
}

static void results(fixture* f, const roundel_soup* soup) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const char summary[] = "dropped 1 polygon with missing vertices, triangulated 1 polygon, "
                           "dropped 1 unused vertex";
    roundel_repair* repair = NULL;
    roundel_mesh* mesh = NULL;
    roundel_attributes* found = NULL;
    size_t count = 7;
    int32_t a[5] = {7}, b[5] = {7}, c[5] = {7};
    char text[128] = "7";
    BAD(f, roundel_soup_repair(NULL, NULL, &repair), null, "soup", NONE);
    BAD(f, roundel_soup_repair(soup, NULL, NULL), null, "repair", NONE);
    GOOD(roundel_soup_repair(soup, NULL, &repair));
    BAD(f, roundel_repair_mesh(NULL, &mesh), null, "repair", NONE);
    BAD(f, roundel_repair_mesh(repair, NULL), null, "mesh", NONE);
    BAD(f, roundel_repair_edit_count(NULL, &count), null, "repair", NONE);
    BAD(f, roundel_repair_edit_count(repair, NULL), null, "edit count", NONE);
    BAD(f, roundel_repair_count_of(NULL, 0, &count), null, "repair", NONE);
    BAD(f, roundel_repair_count_of(repair, 0, NULL), null, "edit count", NONE);
    BAD(f, roundel_repair_count_of(repair, -1, &count), ROUNDEL_ERROR_INVALID_ARGUMENT, "-1", NONE);
    BAD(f, roundel_repair_count_of(repair, 99, &count), ROUNDEL_ERROR_INVALID_ARGUMENT, "99", NONE);
    BAD(f, roundel_repair_edits(NULL, a, b, c, 3), null, "repair", NONE);
    BAD(f, roundel_repair_edits(repair, NULL, b, c, 3), null, "kinds", NONE);
    BAD(f, roundel_repair_edits(repair, a, NULL, c, 3), null, "elements", NONE);
    BAD(f, roundel_repair_edits(repair, a, b, NULL, 3), null, "others", NONE);
    BAD(f, roundel_repair_edits(repair, a, b, c, 5), length, "expected 3", NONE);
    BAD(f, roundel_repair_summary(NULL, text, sizeof text, NULL), null, "repair", NONE);
    BAD(f, roundel_repair_summary(repair, NULL, 4, NULL), null, "buffer", NONE);
    BAD(f, roundel_repair_summary(repair, text, 4, NULL), length, "got 4", NONE);
    BAD(f, roundel_repair_vertex_count(NULL, &count), null, "repair", NONE);
    BAD(f, roundel_repair_vertex_count(repair, NULL), null, "vertex count", NONE);
    BAD(f, roundel_repair_face_count(NULL, &count), null, "repair", NONE);
    BAD(f, roundel_repair_face_count(repair, NULL), null, "face count", NONE);
    BAD(f, roundel_repair_soup_vertex_count(NULL, &count), null, "repair", NONE);
    BAD(f, roundel_repair_soup_vertex_count(repair, NULL), null, "vertex count", NONE);
    BAD(f, roundel_repair_vertex_origins(NULL, a, 4), null, "repair", NONE);
    BAD(f, roundel_repair_vertex_origins(repair, NULL, 4), null, "vertex origins", NONE);
    BAD(f, roundel_repair_vertex_origins(repair, a, 5), length, "expected 4", NONE);
    BAD(f, roundel_repair_face_origins(NULL, a, 2), null, "repair", NONE);
    BAD(f, roundel_repair_face_origins(repair, NULL, 2), null, "face origins", NONE);
    BAD(f, roundel_repair_face_origins(repair, a, 1), length, "expected 2", NONE);
    BAD(f, roundel_repair_welded_to(NULL, a, 5), null, "repair", NONE);
    BAD(f, roundel_repair_welded_to(repair, NULL, 5), null, "welded", NONE);
    BAD(f, roundel_repair_welded_to(repair, a, 4), length, "expected 5", NONE);
    BAD(f, roundel_repair_mark_attribute(NULL, "x.obj", "seams", a, 5), null, "repair", NONE);
    BAD(f, roundel_repair_mark_attribute(repair, NULL, "seams", a, 5), null, "file", NONE);
    BAD(f, roundel_repair_mark_attribute(repair, "x.obj", NULL, a, 5), null, "attribute", NONE);
    BAD(f, roundel_repair_mark_attribute(repair, "none.obj", "seams", a, 5), ROUNDEL_ERROR_IO,
        "none.obj", NONE);
    BAD(f, roundel_repair_read_attributes(NULL, "x.obj", &found), null, "repair", NONE);
    BAD(f, roundel_repair_read_attributes(repair, NULL, &found), null, "file", NONE);
    BAD(f, roundel_repair_read_attributes(repair, "x.obj", NULL), null, "attributes", NONE);
    BAD(f, roundel_repair_read_attributes(repair, "none.obj", &found), ROUNDEL_ERROR_IO, "none.obj",
        NONE);
    HOLDS(found == NULL);
    HOLDS(mesh == NULL && count == 7 && a[0] == 7 && b[0] == 7 && c[0] == 7 && text[0] == '7');

    /* After all these calls the repair is intact: what was done, and the mesh. */
    GOOD(roundel_repair_edits(repair, a, b, c, 3));
    HOLDS(a[0] == ROUNDEL_EDIT_POLYGON_OUT_OF_RANGE && b[0] == 1);
    HOLDS(a[1] == ROUNDEL_EDIT_POLYGON_TRIANGULATED && b[1] == 0 && c[1] == 2);
    HOLDS(a[2] == ROUNDEL_EDIT_VERTEX_UNUSED && b[2] == 4 && c[2] == -1);
    HOLDS(strcmp(roundel_edit_kind_name(a[2]), "vertex_unused") == 0);
    HOLDS(strcmp(roundel_edit_kind_name(-1), "unknown") == 0);
    GOOD(roundel_repair_summary(repair, NULL, 0, &count));
    HOLDS(count == strlen(summary));
    GOOD(roundel_repair_summary(repair, text, count + 1, NULL));
    HOLDS(strcmp(text, summary) == 0);
    GOOD(roundel_repair_vertex_origins(repair, a, 4));
    GOOD(roundel_repair_face_origins(repair, b, 2));
    GOOD(roundel_repair_welded_to(repair, c, 5));
    HOLDS(a[0] == 0 && a[3] == 3 && b[0] == 0 && b[1] == 0 && c[0] == 0 && c[4] == 4);
    GOOD(roundel_repair_mesh(repair, &mesh));
    GOOD(roundel_repair_free(repair));
    GOOD(roundel_mesh_face_count(mesh, &count));
    HOLDS(count == 2);
    GOOD(roundel_mesh_free(mesh));
    GOOD(roundel_repair_free(NULL));
}

void bad_soups(fixture* f) {
    roundel_soup* soup = NULL;
    GOOD(roundel_soup_new(5, xyz, 2, sizes, 7, corners, &soup));
    arrays(f);
    files(f);
    copies(f, soup);
    settings(f, soup);
    no_surface(f);
    results(f, soup);
    attributes(f);
    GOOD(roundel_soup_free(soup));
}
