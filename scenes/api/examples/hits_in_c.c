/* A ball, rays at it, and a picture: the library from C. */
#include <raylane/raylane.h>

#include <stdio.h>
#include <stdlib.h>

static void check(raylane_status status) {
    if (status == RAYLANE_OK) return;
    fprintf(stderr, "%s\n", raylane_error_text());
    exit(1);
}

int main(void) {
    raylane_builder* builder;
    check(raylane_builder_create(&builder));
    raylane_light light = raylane_default_light();
    light.position.x = 4;
    light.position.y = 6;
    light.position.z = 5;
    check(raylane_add_light(builder, &light));
    raylane_material material = raylane_default_material();
    material.specular = 0.5F;
    uint32_t shiny;
    check(raylane_add_material(builder, &material, &shiny));
    const raylane_sphere ball = {{0, 0, 0}, 1};
    check(raylane_add_spheres(builder, &ball, 1, shiny, NULL));
    raylane_scene* scene;
    check(raylane_build(builder, &scene));
    raylane_builder_release(builder);

    raylane_tracer* tracer;
    check(raylane_tracer_create(scene, 0, RAYLANE_EXACT, &tracer));
    const float x[] = {0, 2}, zero[] = {0, 0}, z[] = {5, 5}, dz[] = {-1, -1};
    float t[2]; /* will be 4 and infinity */
    raylane_rays rays = {2, x, zero, z, zero, zero, dz, NULL, NULL, NULL, NULL, NULL, NULL};
    raylane_hits hits = {.t = t};
    check(raylane_intersect(tracer, &rays, &hits));
    raylane_tracer_release(tracer);

    raylane_settings settings = raylane_scene_settings(scene);
    float* rgb = malloc(sizeof(float) * 3 * (size_t)settings.width * (size_t)settings.height);
    if (rgb == NULL) return 1;
    check(raylane_render(scene, NULL, 0, RAYLANE_EXACT, NULL, NULL, rgb));
    check(raylane_write_image("ball.png", settings.width, settings.height, rgb, RAYLANE_SRGB));
    free(rgb);
    raylane_scene_release(scene);
    return t[0] == 4 && t[1] > 1e38F ? 0 : 1;
}
