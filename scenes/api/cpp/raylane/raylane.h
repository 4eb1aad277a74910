/** @file
 * The library's interface for C and for languages that call C. Handles are opaque. No exception
 * leaves a call. The caller owns all arrays.
 *
 * Each call that can fail returns a raylane_status: RAYLANE_OK or an error. raylane_error_text()
 * describes the error in one line, or in one line per mistake for a file with several. The C++
 * headers shapes.hpp, material.hpp, surroundings.hpp, scene.hpp, tracer.hpp and image.hpp document,
 * under the same names, the valid ranges of values, the results and thread safety.
 *
 * The caller releases each handle that a call creates. A tracer keeps its scene alive. With a NULL
 * handle, a call that returns a status fails, a call that returns a value behaves as for an empty
 * scene, and a release does nothing. */
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

/** Returns the version of the library that the program runs with, such as "0.1.0". RAYLANE_VERSION
 * is the version of this header. */
RAYLANE_API const char* raylane_version(void);

typedef enum raylane_status {
    RAYLANE_OK = 0,
    RAYLANE_INVALID_VALUE = 1,  /**< invalid value in a scene, or invalid argument */
    RAYLANE_BAD_INPUT = 2,      /**< malformed input, unknown format or missing file */
    RAYLANE_SYSTEM_REFUSED = 3, /**< the system failed to read or write a file */
    RAYLANE_OUT_OF_MEMORY = 4,
    RAYLANE_CANCELLED = 5, /**< cancelled by the progress callback */
    RAYLANE_UNKNOWN = 6
} raylane_status;

/** Returns the error message of the calling thread's last failed call; empty if none has failed.
 * Valid until another call of this thread fails. */
RAYLANE_API const char* raylane_error_text(void);

typedef struct raylane_builder raylane_builder;
typedef struct raylane_solid raylane_solid;
typedef struct raylane_scene raylane_scene;
typedef struct raylane_tracer raylane_tracer;
typedef struct raylane_rows raylane_rows;

#define RAYLANE_NO_SHAPE UINT32_MAX
#define RAYLANE_NO_MATERIAL UINT32_MAX

typedef struct raylane_vec3 {
    float x, y, z;
} raylane_vec3;
typedef struct raylane_double_vec3 {
    double x, y, z;
} raylane_double_vec3;

/** Shapes, with the fields and valid ranges of shapes.hpp. */
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

/** The same shapes in double, whose numbers count exactly. */
typedef struct raylane_double_sphere {
    raylane_double_vec3 center;
    double radius;
} raylane_double_sphere;
typedef struct raylane_double_plane {
    raylane_double_vec3 point, normal;
} raylane_double_plane;
typedef struct raylane_double_disc {
    raylane_double_vec3 center, normal;
    double radius;
} raylane_double_disc;
typedef struct raylane_double_triangle {
    raylane_double_vec3 a, b, c;
} raylane_double_triangle;
typedef struct raylane_double_smooth_triangle {
    raylane_double_vec3 a, b, c, normal_a, normal_b, normal_c;
} raylane_double_smooth_triangle;
typedef struct raylane_double_box {
    raylane_double_vec3 corner, edge_u, edge_v, edge_w;
} raylane_double_box;
typedef struct raylane_double_cylinder {
    raylane_double_vec3 base, axis;
    double radius;
} raylane_double_cylinder;
typedef struct raylane_double_cone {
    raylane_double_vec3 base, axis;
    double base_radius, top_radius;
} raylane_double_cone;
typedef struct raylane_double_quadric {
    raylane_double_vec3 center;
    double xx, yy, zz, xy, xz, yz, x, y, z, one;
    raylane_double_vec3 lower, upper;
} raylane_double_quadric;
typedef struct raylane_double_ellipsoid {
    raylane_double_vec3 center, axis_u, axis_v, axis_w;
} raylane_double_ellipsoid;

/** Enumerators of the C++ headers, in the same order. */
enum { RAYLANE_SOLID, RAYLANE_CHECKER, RAYLANE_STRIPES, RAYLANE_GRADIENT, RAYLANE_FORMULA };
enum { RAYLANE_CONSTANT, RAYLANE_SCHLICK, RAYLANE_DIELECTRIC };
enum { RAYLANE_BLINN, RAYLANE_PHONG };
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

/** Fields of Material in material.hpp. */
typedef struct raylane_material {
    struct {
        uint8_t kind;
        raylane_vec3 colors[2];
        float size;
        uint8_t axes;
        raylane_vec3 direction, from, to;
        const char* formula[3]; /**< copied; NULL: none */
    } pattern;
    float ambient, diffuse, specular, exponent;
    uint8_t highlight;
    uint8_t reflection;
    float reflectivity, transmission, index;
    struct {
        double B[3], C[3];
    } glass;
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

/** Settings of surroundings.hpp except alpha, which is always that of the scene. An image with
 * alpha is rendered over black. */
typedef struct raylane_settings {
    int width, height, grid;
    uint8_t samples, transfer;
    int max_depth;
    float min_weight, quality;
    uint8_t filter;
    int light_samples;
    int max_transparent;
    raylane_outline outline;
} raylane_settings;

/** Return the default values of the C++ structs. */
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
/** Sets SceneBuilder::merge_duplicates. 0: shapes with equal numbers and the same material stay
 * apart. Default: 1, they count as the first of them. */
RAYLANE_API raylane_status raylane_set_merge_duplicates(raylane_builder* builder, int merge);
RAYLANE_API raylane_status raylane_set_settings(raylane_builder* builder,
                                                const raylane_settings* settings);

/** Add `count` shapes of one material. Their ids are *first, *first + 1, ...; first may be NULL. If
 * a shape is invalid, the shapes before it have been added, and the error text gives its number. */
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
/** Adds triangles that tile one flat polygon. If a triangle is invalid, or not in one plane with
 * the others (see SceneBuilder::add_polygon), adds none, and the error text gives its number. */
RAYLANE_API raylane_status raylane_add_polygon(raylane_builder* builder,
                                               const raylane_triangle* triangles, size_t count,
                                               uint32_t material, uint32_t* first);

/** The same for shapes in double. */
RAYLANE_API raylane_status raylane_add_spheres_doubles(raylane_builder* builder,
                                                       const raylane_double_sphere* shapes,
                                                       size_t count, uint32_t material,
                                                       uint32_t* first);
RAYLANE_API raylane_status raylane_add_planes_doubles(raylane_builder* builder,
                                                      const raylane_double_plane* shapes,
                                                      size_t count, uint32_t material,
                                                      uint32_t* first);
RAYLANE_API raylane_status raylane_add_discs_doubles(raylane_builder* builder,
                                                     const raylane_double_disc* shapes,
                                                     size_t count, uint32_t material,
                                                     uint32_t* first);
RAYLANE_API raylane_status raylane_add_triangles_doubles(raylane_builder* builder,
                                                         const raylane_double_triangle* shapes,
                                                         size_t count, uint32_t material,
                                                         uint32_t* first);
RAYLANE_API raylane_status raylane_add_smooth_triangles_doubles(
    raylane_builder* builder, const raylane_double_smooth_triangle* shapes, size_t count,
    uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_boxes_doubles(raylane_builder* builder,
                                                     const raylane_double_box* shapes, size_t count,
                                                     uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_open_cylinders_doubles(raylane_builder* builder,
                                                              const raylane_double_cylinder* shapes,
                                                              size_t count, uint32_t material,
                                                              uint32_t* first);
RAYLANE_API raylane_status raylane_add_capped_cylinders_doubles(
    raylane_builder* builder, const raylane_double_cylinder* shapes, size_t count,
    uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_open_cones_doubles(raylane_builder* builder,
                                                          const raylane_double_cone* shapes,
                                                          size_t count, uint32_t material,
                                                          uint32_t* first);
RAYLANE_API raylane_status raylane_add_capped_cones_doubles(raylane_builder* builder,
                                                            const raylane_double_cone* shapes,
                                                            size_t count, uint32_t material,
                                                            uint32_t* first);
RAYLANE_API raylane_status raylane_add_quadrics_doubles(raylane_builder* builder,
                                                        const raylane_double_quadric* shapes,
                                                        size_t count, uint32_t material,
                                                        uint32_t* first);
RAYLANE_API raylane_status raylane_add_ellipsoids_doubles(raylane_builder* builder,
                                                          const raylane_double_ellipsoid* shapes,
                                                          size_t count, uint32_t material,
                                                          uint32_t* first);
RAYLANE_API raylane_status raylane_add_polygon_doubles(raylane_builder* builder,
                                                       const raylane_double_triangle* triangles,
                                                       size_t count, uint32_t material,
                                                       uint32_t* first);

/** Create solids, same as Solid in solid.hpp: a solid of one shape, or of other solids. The caller
 * releases each of them, and may do so before those that are made of it. `material`: an index, or
 * RAYLANE_NO_MATERIAL for that of the solid or object that this becomes a part of. A float counts
 * exactly as the double of the same value. raylane_add_solid() checks the numbers of shapes. */
RAYLANE_API raylane_status raylane_solid_sphere(const raylane_double_sphere* shape,
                                                uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_plane(const raylane_double_plane* shape, uint32_t material,
                                               raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_disc(const raylane_double_disc* shape, uint32_t material,
                                              raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_triangle(const raylane_double_triangle* shape,
                                                  uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_smooth_triangle(
    const raylane_double_smooth_triangle* shape, uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_box(const raylane_double_box* shape, uint32_t material,
                                             raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_open_cylinder(const raylane_double_cylinder* shape,
                                                       uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_capped_cylinder(const raylane_double_cylinder* shape,
                                                         uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_open_cone(const raylane_double_cone* shape,
                                                   uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_capped_cone(const raylane_double_cone* shape,
                                                     uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_quadric(const raylane_double_quadric* shape,
                                                 uint32_t material, raylane_solid** solid);
RAYLANE_API raylane_status raylane_solid_ellipsoid(const raylane_double_ellipsoid* shape,
                                                   uint32_t material, raylane_solid** solid);

/** A lens, same as Lens in solid.hpp. */
typedef struct raylane_lens {
    raylane_double_vec3 vertex, axis;
    double radii[2], conics[2], thickness, radius;
} raylane_lens;
/** Returns the default values of the C++ struct. */
RAYLANE_API raylane_lens raylane_default_lens(void);
/** Creates the solid of a lens. Fails if a field is out of range, or if the surfaces meet inside of
 * the cylinder or do not reach it. */
RAYLANE_API raylane_status raylane_solid_lens(const raylane_lens* lens, uint32_t material,
                                              raylane_solid** solid);

/** All points inside of at least one of `count` parts. This and the following functions fail if the
 * result is nested more than 1024 levels deep. */
RAYLANE_API raylane_status raylane_solid_union(const raylane_solid* const* parts, size_t count,
                                               uint32_t material, raylane_solid** solid);
/** All points inside of every one of `count` parts. */
RAYLANE_API raylane_status raylane_solid_intersection(const raylane_solid* const* parts,
                                                      size_t count, uint32_t material,
                                                      raylane_solid** solid);
/** All points inside of `whole` and outside of each of `count` solids in `taken_away`. */
RAYLANE_API raylane_status raylane_solid_difference(const raylane_solid* whole,
                                                    const raylane_solid* const* taken_away,
                                                    size_t count, uint32_t material,
                                                    raylane_solid** solid);
/** The part of the surface of `whole` that lies inside of all `count` solids in `by`. The cuts stay
 * open: they get no cap faces. */
RAYLANE_API raylane_status raylane_solid_clipped(const raylane_solid* whole,
                                                 const raylane_solid* const* by, size_t count,
                                                 uint32_t material, raylane_solid** solid);
RAYLANE_API void raylane_solid_release(raylane_solid* solid);

/** Adds a solid, same as SceneBuilder::add(solid, material). *first is the id of its first part;
 * the ids of the other parts follow. `first` may be NULL. */
RAYLANE_API raylane_status raylane_add_solid(raylane_builder* builder, const raylane_solid* solid,
                                             uint32_t material, uint32_t* first);

/** Builds the scene. Leaves the builder empty, even if the call fails, unless it fails because the
 * environment variable RAYLANE_THREADS is invalid. */
RAYLANE_API raylane_status raylane_build(raylane_builder* builder, raylane_scene** scene);
/** Reads a scene from a file. `path` is in the system's encoding; "-" is a file of that name. */
RAYLANE_API raylane_status raylane_load(const char* path, raylane_scene** scene);
/** Reads a scene from a text of `length` bytes in memory. `name` stands for the file's name in
 * messages, in the search for included files and in the choice of the format. */
RAYLANE_API raylane_status raylane_parse(const char* text, size_t length, const char* name,
                                         raylane_scene** scene);
/** Writes a scene to a file in the format of its ending: .json, .rl, .nff or .pov. Same as save()
 * in scene.hpp, without remarks. */
RAYLANE_API raylane_status raylane_save(const raylane_scene* scene, const char* path);
RAYLANE_API void raylane_scene_release(raylane_scene* scene);
RAYLANE_API size_t raylane_shape_count(const raylane_scene* scene);
RAYLANE_API size_t raylane_material_count(const raylane_scene* scene);
/** Gives a material of the scene. Fails if none has this index. */
RAYLANE_API raylane_status raylane_scene_material(const raylane_scene* scene, uint32_t index,
                                                  raylane_material* material);
/** Gives the index of a shape's material, and the id of the solid that a shape is a part of, same
 * as Scene::material_of and Scene::solid_of in scene.hpp. Fail if no shape has this id. */
RAYLANE_API raylane_status raylane_scene_material_of(const raylane_scene* scene, uint32_t shape_id,
                                                     uint32_t* material);
RAYLANE_API raylane_status raylane_scene_solid_of(const raylane_scene* scene, uint32_t shape_id,
                                                  uint32_t* solid);
/** Gives the bounds of all shapes except planes; lower > upper if the scene has no such shapes.
 * `lower` and `upper` may be NULL. */
RAYLANE_API void raylane_scene_bounds(const raylane_scene* scene, raylane_vec3* lower,
                                      raylane_vec3* upper);
RAYLANE_API raylane_settings raylane_scene_settings(const raylane_scene* scene);
/** Creates a scene whose spheres have moved, same as Scene::with_positions() in scene.hpp.
 * `positions`: `count` centres, one for each sphere that is not a part of a constructed solid. */
RAYLANE_API raylane_status raylane_with_positions(const raylane_scene* scene,
                                                  const raylane_vec3* positions, size_t count,
                                                  raylane_scene** moved);
/** The same for doubles. `positions`: count x 3 numbers. */
RAYLANE_API raylane_status raylane_with_positions_doubles(const raylane_scene* scene,
                                                          const double* positions, size_t count,
                                                          raylane_scene** moved);

/** Rays, structure of arrays, same as RaySpan and DoubleRaySpan in tracer.hpp. Each array has
 * `count` values. t_min, t_max, origin_shape, origin_face and origin_inward may be NULL. A query
 * stores in *refused how many rays it refuses: QueryStatistics::refused. `refused` may be NULL. */
typedef struct raylane_rays {
    size_t count;
    const float *origin_x, *origin_y, *origin_z, *direction_x, *direction_y, *direction_z;
    const float *t_min, *t_max;
    const uint32_t* origin_shape;
    const uint8_t *origin_face, *origin_inward;
    uint64_t* refused;
} raylane_rays;
typedef struct raylane_double_rays {
    size_t count;
    const double *origin_x, *origin_y, *origin_z, *direction_x, *direction_y, *direction_z;
    const double *t_min, *t_max;
    const uint32_t* origin_shape;
    const uint8_t *origin_face, *origin_inward;
    uint64_t* refused;
} raylane_double_rays;

/** Output arrays for hits, same as HitSpan in tracer.hpp. NULL: not wanted. */
typedef struct raylane_hits {
    float *t, *normal_x, *normal_y, *normal_z;
    uint32_t* shape_id;
    uint8_t *entering, *face;
    double* t_double;
    double *normal_double_x, *normal_double_y, *normal_double_z;
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
/** Store the number of crossings of each ray, same as Tracer::count_crossings in tracer.hpp.
 * `counts` has one element for each ray. */
RAYLANE_API raylane_status raylane_count_crossings(const raylane_tracer* tracer,
                                                   const raylane_rays* rays, uint64_t* counts);
RAYLANE_API raylane_status raylane_count_crossings_doubles(const raylane_tracer* tracer,
                                                           const raylane_double_rays* rays,
                                                           uint64_t* counts);

/** Points, structure of arrays of `count` values each, same as PointSpan in tracer.hpp. `refused`:
 * as for rays. */
typedef struct raylane_points {
    size_t count;
    const float *x, *y, *z;
    uint64_t* refused;
} raylane_points;
typedef struct raylane_double_points {
    size_t count;
    const double *x, *y, *z;
    uint64_t* refused;
} raylane_double_points;

/** Create rows of results, one for each ray or point, which the caller releases. The queries are
 * those of Tracer in tracer.hpp, with the same results. `most`: maximum number of crossings of each
 * ray, nearest first; 0: all. `normals`: 0 leaves out the columns of normals. */
RAYLANE_API raylane_status raylane_crossings(const raylane_tracer* tracer, const raylane_rays* rays,
                                             size_t most, int normals, raylane_rows** rows);
RAYLANE_API raylane_status raylane_crossings_doubles(const raylane_tracer* tracer,
                                                     const raylane_double_rays* rays, size_t most,
                                                     int normals, raylane_rows** rows);
/** Finds the solids that contain each point. */
RAYLANE_API raylane_status raylane_contains(const raylane_tracer* tracer,
                                            const raylane_points* points, raylane_rows** rows);
RAYLANE_API raylane_status raylane_contains_doubles(const raylane_tracer* tracer,
                                                    const raylane_double_points* points,
                                                    raylane_rows** rows);
/** Measures the length of each ray inside of the solids of each material. */
RAYLANE_API raylane_status raylane_path_lengths(const raylane_tracer* tracer,
                                                const raylane_rays* rays, raylane_rows** rows);
RAYLANE_API raylane_status raylane_path_lengths_doubles(const raylane_tracer* tracer,
                                                        const raylane_double_rays* rays,
                                                        raylane_rows** rows);
RAYLANE_API void raylane_rows_release(raylane_rows* rows);

/** Returns the number of rows. */
RAYLANE_API size_t raylane_rows_count(const raylane_rows* rows);
/** Returns the row offsets (as in compressed sparse rows, CSR), one more than there are rows. The
 * elements of row i are those from first[i] to first[i + 1] - 1 in each column. NULL for NULL. */
RAYLANE_API const uint64_t* raylane_rows_first(const raylane_rows* rows);
/** Return columns of first[count] elements, valid until the rows are released. A column is NULL if
 * it has no elements or if the query has no such column:
 * - crossings: t, shape_id, entering, face, tied, touching; normal_x, normal_y, normal_z if wanted;
 * - contains: shape_id, inside, on_surface;
 * - path lengths: material, length. */
RAYLANE_API const double* raylane_rows_t(const raylane_rows* rows);
RAYLANE_API const double* raylane_rows_length(const raylane_rows* rows);
RAYLANE_API const uint32_t* raylane_rows_shape_id(const raylane_rows* rows);
RAYLANE_API const uint32_t* raylane_rows_material(const raylane_rows* rows);
RAYLANE_API const uint8_t* raylane_rows_entering(const raylane_rows* rows);
RAYLANE_API const uint8_t* raylane_rows_face(const raylane_rows* rows);
RAYLANE_API const uint8_t* raylane_rows_tied(const raylane_rows* rows);
RAYLANE_API const uint8_t* raylane_rows_touching(const raylane_rows* rows);
RAYLANE_API const uint8_t* raylane_rows_inside(const raylane_rows* rows);
RAYLANE_API const uint8_t* raylane_rows_on_surface(const raylane_rows* rows);
RAYLANE_API const float* raylane_rows_normal_x(const raylane_rows* rows);
RAYLANE_API const float* raylane_rows_normal_y(const raylane_rows* rows);
RAYLANE_API const float* raylane_rows_normal_z(const raylane_rows* rows);

/** Progress of a rendering, same as Progress in image.hpp. `rgb` holds the linear components of the
 * tile's upper left pixel and then of its row; each next row starts floats_a_row floats later.
 * `rgb` is valid only during the callback. */
typedef struct raylane_progress {
    int64_t pixels, total_pixels;
    uint64_t rays;
    int tile_x, tile_y, tile_width, tile_height;
    const float* rgb;
    size_t floats_a_row;
} raylane_progress;
/** Receives the progress and the caller's `user` pointer. Returns 0 to cancel. */
typedef int (*raylane_progress_callback)(const raylane_progress* progress, void* user);

/** Renders an image into `rgb`, an array of height x width x 3 floats: rows from the top down,
 * linear RGB. settings: NULL for those of the scene, whose alpha applies in any case. threads: as
 * in RenderOptions. precision: RAYLANE_FAST to RAYLANE_PLAIN_DOUBLE. progress: may be NULL. */
RAYLANE_API raylane_status raylane_render(const raylane_scene* scene,
                                          const raylane_settings* settings, int threads,
                                          int precision, raylane_progress_callback progress,
                                          void* user, float* rgb);
/** Writes an image of height x width x 3 floats to a file in the format of its ending. Same as
 * write_image() in image.hpp. transfer: RAYLANE_SRGB or RAYLANE_LINEAR, for 8-bit formats. */
RAYLANE_API raylane_status raylane_write_image(const char* path, int width, int height,
                                               const float* rgb, int transfer);

#ifdef __cplusplus
}
#endif

/* NOLINTEND */
#endif
