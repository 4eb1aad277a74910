/* A steel block with a round hole in its middle, and rays in double: solids, all crossings, points,
 * cells and lengths inside of materials from C. */
#include <raylane/raylane.h>

#include <stdio.h>
#include <stdlib.h>

static void check(raylane_status status) {
    if (status == RAYLANE_OK) return;
    fprintf(stderr, "%s\n", raylane_error_text());
    exit(1);
}

static raylane_scene* block_with_hole(void) {
    raylane_builder* builder;
    check(raylane_builder_create(&builder));
    const raylane_material material = raylane_default_material();
    uint32_t steel;
    check(raylane_add_material(builder, &material, &steel));

    const raylane_double_box block = {{-10, -10, -10}, {20, 0, 0}, {0, 20, 0}, {0, 0, 20}};
    const raylane_double_sphere ball = {{0, 0, 0}, 5};
    raylane_solid *whole, *hole, *solid;
    check(raylane_solid_box(&block, RAYLANE_NO_MATERIAL, &whole));
    check(raylane_solid_sphere(&ball, RAYLANE_NO_MATERIAL, &hole));
    const raylane_solid* const holes[] = {hole};
    check(raylane_solid_difference(whole, holes, 1, RAYLANE_NO_MATERIAL, &solid));
    check(raylane_add_solid(builder, solid, steel, NULL)); /* the block is shape 0, the ball 1 */
    raylane_solid_release(solid);
    raylane_solid_release(hole);
    raylane_solid_release(whole);

    raylane_scene* scene;
    check(raylane_build(builder, &scene));
    raylane_builder_release(builder);
    return scene;
}

int main(void) {
    raylane_scene* scene = block_with_hole();
    raylane_tracer* tracer;
    check(raylane_tracer_create(scene, 0, RAYLANE_EXACT, &tracer));
    raylane_scene_release(scene); /* the tracer keeps it alive */

    /* Three rays along x: through the middle, off the middle, and past the block. */
    const double x[] = {-20, -20, -20}, y[] = {0, 3, 11}, zero[] = {0, 0, 0}, dx[] = {1, 1, 1};
    const raylane_double_rays rays = {3,    x,    y,    zero, dx,   zero, zero,
                                      NULL, NULL, NULL, NULL, NULL, NULL};
    const double expected_t[] = {10, 15, 25, 30, 10, 16, 24, 30};
    const uint64_t expected_first[] = {0, 4, 8, 8};
    int wrong = 0;
    raylane_rows* rows;
    check(raylane_crossings_doubles(tracer, &rays, 0, 0, &rows));
    const uint64_t* first = raylane_rows_first(rows);
    for (size_t ray = 0; ray < raylane_rows_count(rows); ++ray) {
        printf("ray %d crosses:", (int)ray);
        for (uint64_t i = first[ray]; i < first[ray + 1]; ++i) {
            printf(" %s shape %u at %g", raylane_rows_entering(rows)[i] ? "in," : "out,",
                   (unsigned)raylane_rows_shape_id(rows)[i], raylane_rows_t(rows)[i]);
            wrong += raylane_rows_t(rows)[i] != expected_t[i];
        }
        printf("\n");
        wrong += first[ray + 1] != expected_first[ray + 1];
    }
    raylane_rows_release(rows);

    check(raylane_path_lengths_doubles(tracer, &rays, &rows)); /* 10 and 12 inside of steel */
    wrong += raylane_rows_first(rows)[3] != 2 || raylane_rows_length(rows)[0] != 10 ||
             raylane_rows_length(rows)[1] != 12;
    raylane_rows_release(rows);

    const double at[] = {0, 7, 5}; /* in the hole, in steel, on the surface of the hole */
    const raylane_double_points points = {3, at, zero, zero, NULL};
    check(raylane_contains_doubles(tracer, &points, &rows));
    first = raylane_rows_first(rows);
    wrong += first[1] != 0 || first[2] != 1 || first[3] != 2 ||
             raylane_rows_on_surface(rows)[0] != 0 || raylane_rows_on_surface(rows)[1] != 1;
    raylane_rows_release(rows);
    uint32_t cell[3], of[3]; /* the surface of the hole belongs to the hole */
    const raylane_cell_columns columns = {cell, of, NULL};
    check(raylane_cells_doubles(tracer, &points, &columns));
    wrong += cell[0] != RAYLANE_NO_SHAPE || cell[1] != 0 || cell[2] != RAYLANE_NO_SHAPE ||
             of[0] != RAYLANE_NO_MATERIAL || of[1] != 0;
    raylane_tracer_release(tracer);
    return wrong != 0;
}
