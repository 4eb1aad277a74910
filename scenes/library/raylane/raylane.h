/** @file
 * The library for C, and for all that can call C. Handles are opaque, no exception comes across,
 * and arrays are the caller's.
 *
 * Each call returns RAYLANE_OK, or what went wrong; raylane_error_text() says it in one line, but
 * for a file with several mistakes, each of which has a line. What a value may be, what the answers
 * mean and how threads may call is what the C++ headers say of the same names: shapes.hpp,
 * material.hpp, surroundings.hpp, scene.hpp, tracer.hpp, image.hpp.
 *
 * Handles that a call makes are released by the caller. A tracer keeps its scene. NULL is no
 * handle; to release it does nothing. */
#ifndef RAYLANE_H
#define RAYLANE_H
/* NOLINTBEGIN: this is C. */

#include "raylane/api.h"
#include "raylane/version.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Version of the library that the program runs with; RAYLANE_VERSION is that of this header. */
RAYLANE_API const char* raylane_version(void);

typedef enum raylane_status {
    RAYLANE_OK = 0,
    RAYLANE_INVALID_VALUE = 1,  /**< a value that no scene may hold, or no call may be made with */
    RAYLANE_BAD_INPUT = 2,      /**< a file that cannot be meant, or is not there */
    RAYLANE_SYSTEM_REFUSED = 3, /**< the system would not read or write */
    RAYLANE_OUT_OF_MEMORY = 4,
    RAYLANE_CANCELLED = 5, /**< by the callback */
    RAYLANE_UNKNOWN = 6
} raylane_status;

/** What this thread's last call that failed has to say. Valid until it fails again. */
RAYLANE_API const char* raylane_error_text(void);

typedef struct raylane_builder raylane_builder;
typedef struct raylane_scene raylane_scene;
typedef struct raylane_tracer raylane_tracer;

#define RAYLANE_NO_SHAPE UINT32_MAX

typedef struct raylane_vec3 {
    float x, y, z;
} raylane_vec3;

/** Shapes, as in shapes.hpp. */
typedef struct raylane_sphere {
    raylane_vec3 center;
    float radius;
} raylane_sphere;
typedef struct raylane_plane {
    raylane_vec3 point, normal;
} raylane_plane;
typedef struct raylane_disc {
    raylane_vec3 center, normal;
    float radius;
} raylane_disc;
typedef struct raylane_triangle {
    raylane_vec3 a, b, c;
} raylane_triangle;
typedef struct raylane_smooth_triangle {
    raylane_vec3 a, b, c, normal_a, normal_b, normal_c;
} raylane_smooth_triangle;
typedef struct raylane_box {
    raylane_vec3 corner, edge_u, edge_v, edge_w;
} raylane_box;
typedef struct raylane_cylinder {
    raylane_vec3 base, axis;
    float radius;
} raylane_cylinder;
typedef struct raylane_cone {
    raylane_vec3 base, axis;
    float base_radius, top_radius;
} raylane_cone;
typedef struct raylane_quadric {
    raylane_vec3 center;
    float xx, yy, zz, xy, xz, yz, x, y, z, one;
    raylane_vec3 lower, upper;
} raylane_quadric;
typedef struct raylane_ellipsoid {
    raylane_vec3 center, axis_u, axis_v, axis_w;
} raylane_ellipsoid;

/** Enumerators of the C++ headers, in their order. */
enum { RAYLANE_SOLID, RAYLANE_CHECKER, RAYLANE_STRIPES, RAYLANE_GRADIENT, RAYLANE_BACK_PLANE };
enum { RAYLANE_CONSTANT, RAYLANE_SCHLICK, RAYLANE_DIELECTRIC };
enum { RAYLANE_BOTH_SIDES, RAYLANE_OUTSIDE, RAYLANE_INSIDE };
enum {
    RAYLANE_POINT_LIGHT,
    RAYLANE_DIRECTIONAL_LIGHT,
    RAYLANE_SKY_LIGHT,
    RAYLANE_SPHERE_LIGHT,
    RAYLANE_DISC_LIGHT,
    RAYLANE_RECTANGLE_LIGHT
};
enum { RAYLANE_NO_FOG, RAYLANE_LINEAR_Z_FOG, RAYLANE_LINEAR_FOG, RAYLANE_EXPONENTIAL_FOG };
enum { RAYLANE_PERSPECTIVE, RAYLANE_ORTHOGRAPHIC };
enum { RAYLANE_SRGB, RAYLANE_LINEAR };
enum { RAYLANE_REGULAR, RAYLANE_STRATIFIED };
enum { RAYLANE_BOX_FILTER, RAYLANE_GAUSSIAN, RAYLANE_BLACKMAN_HARRIS };
enum { RAYLANE_FAST, RAYLANE_ROBUST, RAYLANE_EXACT, RAYLANE_PLAIN_DOUBLE };

typedef struct raylane_material {
    struct {
        uint8_t kind;
        raylane_vec3 colors[2];
        float size;
        uint8_t axes;
        raylane_vec3 direction, from, to;
    } pattern;
    float ambient, diffuse, specular, exponent;
    uint8_t reflection;
    float reflectivity, transmission, index;
    raylane_vec3 absorption;
    uint8_t visible;
    float opacity;
} raylane_material;

typedef struct raylane_light {
    uint8_t kind;
    raylane_vec3 position, direction, color;
    float radius;
    raylane_vec3 edge_u, edge_v, ground;
    float reach;
} raylane_light;

typedef struct raylane_fog {
    uint8_t kind;
    raylane_vec3 color;
    float start, end, density;
} raylane_fog;

typedef struct raylane_camera {
    uint8_t projection;
    raylane_vec3 from, at, up;
    float field_of_view, height, lens_radius, focus_distance;
} raylane_camera;

typedef struct raylane_outline {
    float width;
    raylane_vec3 color;
    float creases;
} raylane_outline;

/** All but alpha, which is the scene's whatever these say: one that has it is drawn over black. */
typedef struct raylane_settings {
    int width, height, grid;
    uint8_t samples, transfer;
    int max_depth;
    float min_weight, quality;
    uint8_t filter;
    int light_samples;
    int max_see_through;
    raylane_outline outline;
} raylane_settings;

/** The values that C++ starts with. */
RAYLANE_API raylane_material raylane_default_material(void);
RAYLANE_API raylane_light raylane_default_light(void);
RAYLANE_API raylane_fog raylane_default_fog(void);
RAYLANE_API raylane_camera raylane_default_camera(void);
RAYLANE_API raylane_settings raylane_default_settings(void);

RAYLANE_API raylane_status raylane_builder_create(raylane_builder** builder);
RAYLANE_API void raylane_builder_release(raylane_builder* builder);

RAYLANE_API raylane_status raylane_add_material(raylane_builder* builder,
                                                const raylane_material* material, uint32_t* index);
RAYLANE_API raylane_status raylane_add_light(raylane_builder* builder, const raylane_light* light);
RAYLANE_API raylane_status raylane_set_fog(raylane_builder* builder, const raylane_fog* fog);
RAYLANE_API raylane_status raylane_set_camera(raylane_builder* builder,
                                              const raylane_camera* camera);
RAYLANE_API raylane_status raylane_set_background(raylane_builder* builder, raylane_vec3 color);
RAYLANE_API raylane_status raylane_set_settings(raylane_builder* builder,
                                                const raylane_settings* settings);

/** `count` shapes of one material: their ids are *first, *first + 1, ...; first may be NULL. Of a
 * list in which one is not valid, those before it have been added, and the text says which one it
 * is. */
RAYLANE_API raylane_status raylane_add_spheres(raylane_builder* builder,
                                               const raylane_sphere* shapes, size_t count,
                                               uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_planes(raylane_builder* builder, const raylane_plane* shapes,
                                              size_t count, uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_discs(raylane_builder* builder, const raylane_disc* shapes,
                                             size_t count, uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_triangles(raylane_builder* builder,
                                                 const raylane_triangle* shapes, size_t count,
                                                 uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_smooth_triangles(raylane_builder* builder,
                                                        const raylane_smooth_triangle* shapes,
                                                        size_t count, uint32_t material,
                                                        uint32_t* first);
RAYLANE_API raylane_status raylane_add_boxes(raylane_builder* builder, const raylane_box* shapes,
                                             size_t count, uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_open_cylinders(raylane_builder* builder,
                                                      const raylane_cylinder* shapes, size_t count,
                                                      uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_capped_cylinders(raylane_builder* builder,
                                                        const raylane_cylinder* shapes,
                                                        size_t count, uint32_t material,
                                                        uint32_t* first);
RAYLANE_API raylane_status raylane_add_open_cones(raylane_builder* builder,
                                                  const raylane_cone* shapes, size_t count,
                                                  uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_capped_cones(raylane_builder* builder,
                                                    const raylane_cone* shapes, size_t count,
                                                    uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_quadrics(raylane_builder* builder,
                                                const raylane_quadric* shapes, size_t count,
                                                uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_ellipsoids(raylane_builder* builder,
                                                  const raylane_ellipsoid* shapes, size_t count,
                                                  uint32_t material, uint32_t* first);
/** Triangles that tile one flat polygon: all of them are added or, if one is not valid, none; the
 * text says which one it is. */
RAYLANE_API raylane_status raylane_add_polygon(raylane_builder* builder,
                                               const raylane_triangle* triangles, size_t count,
                                               uint32_t material, uint32_t* first);

/** The builder is new then, whether this succeeds or not, unless it is RAYLANE_THREADS in the
 * environment that is no number of threads. */
RAYLANE_API raylane_status raylane_build(raylane_builder* builder, raylane_scene** scene);
/** A file, by its path in the system's encoding ("-" is one of that name); or a text in memory,
 * which messages call `name`. */
RAYLANE_API raylane_status raylane_load(const char* path, raylane_scene** scene);
RAYLANE_API raylane_status raylane_parse(const char* text, size_t length, const char* name,
                                         raylane_scene** scene);
/** Writes a scene to a file, in the format of its ending: .json, .rl, .nff or .pov, as save() of
 * scene.hpp. */
RAYLANE_API raylane_status raylane_save(const raylane_scene* scene, const char* path);
RAYLANE_API void raylane_scene_release(raylane_scene* scene);
RAYLANE_API size_t raylane_shape_count(const raylane_scene* scene);
RAYLANE_API size_t raylane_material_count(const raylane_scene* scene);
/** Of all shapes but planes; lower > upper if there are none. */
RAYLANE_API void raylane_scene_bounds(const raylane_scene* scene, raylane_vec3* lower,
                                      raylane_vec3* upper);
RAYLANE_API raylane_settings raylane_scene_settings(const raylane_scene* scene);

/** Rays, structure of arrays: as RaySpan and DoubleRaySpan. Arrays have `count` values each; the
 * limits' and origin_* may be NULL. */
typedef struct raylane_rays {
    size_t count;
    const float *origin_x, *origin_y, *origin_z, *direction_x, *direction_y, *direction_z;
    const float *t_min, *t_max;
    const uint32_t* origin_shape;
    const uint8_t *origin_face, *origin_inward;
} raylane_rays;
typedef struct raylane_double_rays {
    size_t count;
    const double *origin_x, *origin_y, *origin_z, *direction_x, *direction_y, *direction_z;
    const double *t_min, *t_max;
    const uint32_t* origin_shape;
    const uint8_t *origin_face, *origin_inward;
} raylane_double_rays;

/** Hits, as HitSpan. NULL: not wanted. */
typedef struct raylane_hits {
    float *t, *normal_x, *normal_y, *normal_z;
    uint32_t* shape;
    uint8_t *entering, *face;
    double* t_double;
} raylane_hits;

RAYLANE_API raylane_status raylane_tracer_create(const raylane_scene* scene, int threads,
                                                 int precision, raylane_tracer** tracer);
RAYLANE_API void raylane_tracer_release(raylane_tracer* tracer);

RAYLANE_API raylane_status raylane_intersect(const raylane_tracer* tracer, const raylane_rays* rays,
                                             const raylane_hits* hits);
RAYLANE_API raylane_status raylane_intersect_doubles(const raylane_tracer* tracer,
                                                     const raylane_double_rays* rays,
                                                     const raylane_hits* hits);
RAYLANE_API raylane_status raylane_occluded(const raylane_tracer* tracer, const raylane_rays* rays,
                                            uint8_t* occluded);
RAYLANE_API raylane_status raylane_occluded_doubles(const raylane_tracer* tracer,
                                                    const raylane_double_rays* rays,
                                                    uint8_t* occluded);

/** As Progress: `rgb` has the linear components of the tile's upper left pixel and then of its row,
 * the row below is floats_a_row further; not to be read behind the call. */
typedef struct raylane_progress {
    int64_t pixels, total_pixels;
    uint64_t rays;
    int tile_x, tile_y, tile_width, tile_height;
    const float* rgb;
    size_t floats_a_row;
} raylane_progress;
/** Returns 0 to cancel. */
typedef int (*raylane_progress_callback)(const raylane_progress* progress, void* user);

/** The picture, into height x width x 3 floats of the caller's: rows from the top down, linear RGB.
 * settings: NULL for the scene's own; its alpha counts in any case. progress: NULL for none. */
RAYLANE_API raylane_status raylane_render(const raylane_scene* scene,
                                          const raylane_settings* settings, int threads,
                                          int precision, raylane_progress_callback progress,
                                          void* user, float* rgb);
/** transfer: RAYLANE_SRGB or RAYLANE_LINEAR, for PNG. */
RAYLANE_API raylane_status raylane_write_image(const char* path, int width, int height,
                                               const float* rgb, int transfer);

#ifdef __cplusplus
}
#endif

/* NOLINTEND */
#endif
