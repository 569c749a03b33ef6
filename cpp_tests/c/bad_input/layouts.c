/* Layouts that are none, arcs that are not there, and calls that lack what they need. */

#include "bad_input.h"

static const double CORNERS[24] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                   -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
static const int32_t SIZES[6] = {4, 4, 4, 4, 4, 4};
static const int32_t SIDES[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                  2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

static void layouts_are_checked(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const int32_t far[3] = {0, 1, 8}, twice[3] = {0, 1, 0}, triangles[6] = {0, 1, 2, 0, 1, 3};
    const int32_t threes[2] = {3, 3};
    roundel_layout* layout = NULL;
    BAD(f, roundel_layout_new(8, NULL, 6, SIZES, 24, SIDES, &layout), null, "coordinates", NONE);
    BAD(f, roundel_layout_new(8, CORNERS, 6, NULL, 24, SIDES, &layout), null, "sizes", NONE);
    BAD(f, roundel_layout_new(8, CORNERS, 6, SIZES, 24, NULL, &layout), null, "corners", NONE);
    BAD(f, roundel_layout_new(8, CORNERS, 6, SIZES, 24, SIDES, NULL), null, "layout", NONE);
    BAD(f, roundel_layout_new(8, CORNERS, 6, SIZES, 23, SIDES, &layout),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "corners", NONE);
    BAD(f, roundel_layout_new(8, CORNERS, 0, NULL, 0, NULL, &layout), invalid, "no polygons", NONE);
    BAD(f, roundel_layout_new(8, CORNERS, 1, threes, 3, far, &layout),
        ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, "polygons of the layout", 0);
    BAD(f, roundel_layout_new(8, CORNERS, 1, threes, 3, twice, &layout), invalid, "twice", 0);
    BAD(f, roundel_layout_new(8, CORNERS, 2, threes, 6, triangles, &layout), invalid, "direction",
        1);
    BAD(f, roundel_layout_read(NULL, &layout), null, "file", NONE);
    BAD(f, roundel_layout_read("there/is/no/such.obj", &layout), ROUNDEL_ERROR_IO, "such.obj",
        NONE);
    HOLDS(layout == NULL);
    GOOD(roundel_layout_free(NULL));
}

static void arcs_are_checked(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status range = ROUNDEL_ERROR_INDEX_OUT_OF_RANGE;
    const roundel_status length = ROUNDEL_ERROR_LENGTH_MISMATCH;
    const double course[6] = {-1, -1, -1, 1, -1, -1};
    int32_t ends[24] = {7};
    size_t count = 7;
    roundel_layout* layout = NULL;
    GOOD(roundel_layout_new(8, CORNERS, 6, SIZES, 24, SIDES, &layout));
    BAD(f, roundel_layout_arc_count(NULL, &count), null, "layout", NONE);
    BAD(f, roundel_layout_arc_count(layout, NULL), null, "count", NONE);
    BAD(f, roundel_layout_arcs(NULL, ends, 24), null, "layout", NONE);
    BAD(f, roundel_layout_arcs(layout, NULL, 24), null, "ends", NONE);
    BAD(f, roundel_layout_arcs(layout, ends, 12), length, "ends", NONE);
    HOLDS(count == 7 && ends[0] == 7);
    GOOD(roundel_layout_arc_count(layout, &count));
    HOLDS(count == 12);
    BAD(f, roundel_layout_fix_arc(NULL, 0, 3), null, "layout", NONE);
    BAD(f, roundel_layout_fix_arc(layout, 12, 3), range, "arcs", 0);
    BAD(f, roundel_layout_fix_arc(layout, 1, -1), ROUNDEL_ERROR_INVALID_ARGUMENT, "negative", 1);
    BAD(f, roundel_layout_hold_arcs(NULL, 1), null, "layout", NONE);
    GOOD(roundel_layout_hold_arcs(layout, 1));
    BAD(f, roundel_layout_draw_arc(NULL, 0, 2, course), null, "layout", NONE);
    BAD(f, roundel_layout_draw_arc(layout, 0, 2, NULL), null, "coordinates", NONE);
    BAD(f, roundel_layout_draw_arc(layout, 12, 2, course), range, "arcs", 0);
    GOOD(roundel_layout_free(layout));
}

static void quads_are_checked(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    int32_t numbers[12] = {7};
    size_t count = 0;
    roundel_mesh *sphere = NULL, *torus = NULL;
    roundel_layout* layout = NULL;
    roundel_quads* quads = NULL;
    GOOD(roundel_mesh_make_shape("sphere", 300, &sphere));
    GOOD(roundel_mesh_make_shape("torus", 300, &torus));
    GOOD(roundel_layout_new(8, CORNERS, 6, SIZES, 24, SIDES, &layout));
    BAD(f, roundel_quads_make_layout(NULL, layout, 60, NULL, NULL, 0, &quads), null, "mesh", NONE);
    BAD(f, roundel_quads_make_layout(sphere, NULL, 60, NULL, NULL, 0, &quads), null, "layout",
        NONE);
    BAD(f, roundel_quads_make_layout(sphere, layout, 60, NULL, NULL, 0, NULL), null, "quads", NONE);
    BAD(f, roundel_quads_make_layout(sphere, layout, 60, NULL, numbers, 11, &quads),
        ROUNDEL_ERROR_LENGTH_MISMATCH, "subdivisions", NONE);
    BAD(f, roundel_quads_make_layout(torus, layout, 60, NULL, NULL, 0, &quads), invalid,
        "Euler characteristic", NONE);
    HOLDS(quads == NULL && numbers[0] == 7);
    GOOD(roundel_layout_fix_arc(layout, 0, 3));
    GOOD(roundel_quads_make_layout(sphere, layout, 60, NULL, numbers, 12, &quads));
    GOOD(roundel_quads_count(quads, &count));
    HOLDS(numbers[0] == 3 && count >= 3 && count < 200);
    GOOD(roundel_quads_free(quads));
    GOOD(roundel_layout_free(layout));
    GOOD(roundel_mesh_free(sphere));
    GOOD(roundel_mesh_free(torus));
}

static void layouts_of_quads_are_checked(fixture* f) {
    const roundel_status null = ROUNDEL_ERROR_NULL_POINTER;
    const roundel_status invalid = ROUNDEL_ERROR_INVALID_ARGUMENT;
    const int32_t sides[5] = {0, 2, 3, 1, 4}, four = 4, five = 5;
    size_t count = 7, corners = 7;
    roundel_soup *cube = NULL, *pentagon = NULL, *quad = NULL, *back = NULL;
    roundel_layout *layout = NULL, *read = NULL;
    GOOD(roundel_soup_new(8, CORNERS, 6, SIZES, 24, SIDES, &cube));
    GOOD(roundel_soup_new(8, CORNERS, 1, &five, 5, sides, &pentagon));
    GOOD(roundel_soup_new(8, CORNERS, 1, &four, 4, sides, &quad));
    BAD(f, roundel_layout_of_quads(NULL, 0.0, NULL, &layout), null, "soup", NONE);
    BAD(f, roundel_layout_of_quads(cube, 0.0, NULL, NULL), null, "layout", NONE);
    BAD(f, roundel_layout_of_quads(cube, -1.0, NULL, &layout), invalid, "deviation", NONE);
    BAD(f, roundel_layout_of_quads(cube, NAN, NULL, &layout), invalid, "deviation", NONE);
    BAD(f, roundel_layout_of_quads(pentagon, 0.0, NULL, &layout), invalid, "5", 0);
    BAD(f, roundel_layout_of_quads(quad, 0.0, NULL, &layout), ROUNDEL_ERROR_ISOLATED_VERTEX,
        "vertex", 4);
    HOLDS(layout == NULL);
    GOOD(roundel_layout_of_quads(cube, 0.0, NULL, &layout));
    GOOD(roundel_layout_arc_count(layout, &count));
    HOLDS(count == 12);
    BAD(f, roundel_layout_soup(NULL, &back), null, "layout", NONE);
    BAD(f, roundel_layout_soup(layout, NULL), null, "soup", NONE);
    GOOD(roundel_layout_soup(layout, &back));
    GOOD(roundel_soup_polygon_counts(back, &count, &corners));
    HOLDS(count == 6 && corners == 24);
    BAD(f, roundel_layout_write(NULL, "layout.obj"), null, "layout", NONE);
    BAD(f, roundel_layout_write(layout, NULL), null, "file", NONE);
    BAD(f, roundel_layout_write(layout, "there/is/no/such.obj"), ROUNDEL_ERROR_IO, "such.obj",
        NONE);
    GOOD(roundel_layout_write(layout, "layout_written.obj"));
    GOOD(roundel_layout_read("layout_written.obj", &read));
    HOLDS(remove("layout_written.obj") == 0);
    GOOD(roundel_layout_arc_count(read, &count));
    HOLDS(count == 12);
    GOOD(roundel_layout_free(read));
    GOOD(roundel_layout_free(layout));
    GOOD(roundel_soup_free(back));
    GOOD(roundel_soup_free(quad));
    GOOD(roundel_soup_free(pentagon));
    GOOD(roundel_soup_free(cube));
}

void bad_layouts(fixture* f) {
    layouts_are_checked(f);
    arcs_are_checked(f);
    quads_are_checked(f);
    layouts_of_quads_are_checked(f);
}
