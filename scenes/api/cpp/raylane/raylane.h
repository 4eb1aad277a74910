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
/** Returns the same version as a number, to compare with RAYLANE_VERSION_NUMBER. */
RAYLANE_API int raylane_version_number(void);

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
typedef struct raylane_transform raylane_transform;
typedef struct raylane_solid raylane_solid;
typedef struct raylane_group raylane_group;
typedef struct raylane_scene raylane_scene;
typedef struct raylane_tracer raylane_tracer;
typedef struct raylane_rows raylane_rows;
typedef struct raylane_texture raylane_texture;

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
enum {
    RAYLANE_SOLID,
    RAYLANE_CHECKER,
    RAYLANE_STRIPES,
    RAYLANE_GRADIENT,
    RAYLANE_FORMULA,
    RAYLANE_IMAGE,
    RAYLANE_CUTAWAY
};
enum { RAYLANE_WORLD_SPACE, RAYLANE_OBJECT_SPACE };
enum { RAYLANE_REPEAT, RAYLANE_CLAMP };
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
/** Types of shapes, and the numbers of each: those of its struct in double, in the same order. */
enum {
    RAYLANE_SPHERE,
    RAYLANE_PLANE,
    RAYLANE_DISC,
    RAYLANE_TRIANGLE,
    RAYLANE_SMOOTH_TRIANGLE,
    RAYLANE_BOX,
    RAYLANE_OPEN_CYLINDER,
    RAYLANE_CAPPED_CYLINDER,
    RAYLANE_OPEN_CONE,
    RAYLANE_CAPPED_CONE,
    RAYLANE_QUADRIC,
    RAYLANE_ELLIPSOID
};
#define RAYLANE_MAX_NUMBERS 19 /**< of a quadric */

/** Fields of Material in material.hpp. */
typedef struct raylane_material {
    struct {
        uint8_t kind;
        raylane_vec3 colors[2];
        float size;
        uint8_t axes;
        raylane_vec3 direction, from, to;
        const char* formula[3]; /**< copied; NULL: none */
        uint8_t space;
        const raylane_texture* image; /**< shared; NULL: none */
        float width, height;
        uint8_t wrap;
        raylane_vec3 axis;
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

/** A camera that raylane_build() places, same as AutoCamera in surroundings.hpp. */
typedef struct raylane_auto_camera {
    uint8_t projection;
    raylane_vec3 direction, up;
    float field_of_view, zoom, depth_cue;
} raylane_auto_camera;

typedef struct raylane_outline {
    float width;
    raylane_vec3 color;
    float creases;
} raylane_outline;

/** Settings of surroundings.hpp except alpha, which is that of the scene or of raylane_image. An
 * image with alpha is rendered over black. */
typedef struct raylane_settings {
    int width, height, grid;
    uint8_t samples, transfer;
    int max_depth;
    float min_weight, quality;
    uint8_t filter;
    int light_samples;
    int max_transparent;
    uint8_t transparent_shadows; /**< 0 or 1 */
    raylane_outline outline;
} raylane_settings;

/** Create an image for patterns from height x width x 3 components, or from a PNG file, same as
 * Texture in material.hpp and read_texture() in image.hpp. Materials share the pixels, and keep
 * them after the release. */
RAYLANE_API raylane_status raylane_texture_from_codes(int width, int height, const uint8_t* srgb,
                                                      raylane_texture** texture);
RAYLANE_API raylane_status raylane_texture_from_floats(int width, int height, const float* linear,
                                                       raylane_texture** texture);
RAYLANE_API raylane_status raylane_read_texture(const char* path, raylane_texture** texture);
RAYLANE_API void raylane_texture_release(raylane_texture* texture);

/** Return the default values of the C++ structs. */
RAYLANE_API raylane_material raylane_default_material(void);
RAYLANE_API raylane_light raylane_default_light(void);
RAYLANE_API raylane_fog raylane_default_fog(void);
RAYLANE_API raylane_camera raylane_default_camera(void);
RAYLANE_API raylane_auto_camera raylane_default_auto_camera(void);
RAYLANE_API raylane_settings raylane_default_settings(void);

/** Give the values that files know by name, same as material_preset() and catalogue_glass() in
 * material.hpp, named_view() in surroundings.hpp and color_from_srgb() in vector.hpp. Fail for an
 * unknown name; the error text lists all. B and C: three numbers each, for raylane_material::glass.
 */
RAYLANE_API raylane_status raylane_material_preset(const char* name, raylane_material* material);
RAYLANE_API raylane_status raylane_catalogue_glass(const char* name, double* B, double* C);
RAYLANE_API raylane_status raylane_named_view(const char* name, raylane_auto_camera* camera);
RAYLANE_API raylane_status raylane_color_from_srgb(const char* text, raylane_vec3* color);
/** Gives the box with faces across the axes and these opposite corners, lower < upper. The edges
 * are upper - lower, rounded to doubles. */
RAYLANE_API raylane_status raylane_aligned_box(raylane_double_vec3 lower, raylane_double_vec3 upper,
                                               raylane_double_box* box);

RAYLANE_API raylane_status raylane_builder_create(raylane_builder** builder);
RAYLANE_API void raylane_builder_release(raylane_builder* builder);

RAYLANE_API raylane_status raylane_add_material(raylane_builder* builder,
                                                const raylane_material* material, uint32_t* index);
/** The same with a name, which is copied. raylane_save() writes it. */
RAYLANE_API raylane_status raylane_add_named_material(raylane_builder* builder,
                                                      const raylane_material* material,
                                                      const char* name, uint32_t* index);
RAYLANE_API raylane_status raylane_add_light(raylane_builder* builder, const raylane_light* light);
RAYLANE_API raylane_status raylane_set_fog(raylane_builder* builder, const raylane_fog* fog);
RAYLANE_API raylane_status raylane_set_camera(raylane_builder* builder,
                                              const raylane_camera* camera);
/** Sets SceneBuilder::auto_camera, which replaces the camera. NULL: the camera counts. */
RAYLANE_API raylane_status raylane_set_auto_camera(raylane_builder* builder,
                                                   const raylane_auto_camera* camera);
/** Sets SceneBuilder::camera_lights: not 0 adds two lights that follow the camera. Default: 0. */
RAYLANE_API raylane_status raylane_set_camera_lights(raylane_builder* builder, int lights);
/** Sets SceneBuilder::wavelengths: `count` of them in nanometres, at most 64. */
RAYLANE_API raylane_status raylane_set_wavelengths(raylane_builder* builder,
                                                   const double* wavelengths, size_t count);
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
RAYLANE_API raylane_status raylane_add_smooth_polygon(raylane_builder* builder,
                                                      const raylane_smooth_triangle* triangles,
                                                      size_t count, uint32_t material,
                                                      uint32_t* first);

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
RAYLANE_API raylane_status raylane_add_smooth_polygon_doubles(
    raylane_builder* builder, const raylane_double_smooth_triangle* triangles, size_t count,
    uint32_t material, uint32_t* first);

/** Generators of many shapes, same as Sphereflake and Lattice in generators.hpp. */
typedef struct raylane_sphereflake {
    raylane_vec3 center;
    float radius;
    int depth;
    raylane_vec3 up;
} raylane_sphereflake;
typedef struct raylane_lattice {
    raylane_double_vec3 corner;
    int n;
    float spacing, sphere_radius, strut_radius;
} raylane_lattice;
RAYLANE_API raylane_sphereflake raylane_default_sphereflake(void);
RAYLANE_API raylane_lattice raylane_default_lattice(void);
/** Add the shapes of a generator. *first is the first id; `first` may be NULL. With
 * RAYLANE_NO_MATERIAL, struts have the material of the spheres. */
RAYLANE_API raylane_status raylane_add_sphereflake(raylane_builder* builder,
                                                   const raylane_sphereflake* flake,
                                                   uint32_t material, uint32_t* first);
RAYLANE_API raylane_status raylane_add_lattice(raylane_builder* builder,
                                               const raylane_lattice* lattice, uint32_t material,
                                               uint32_t strut_material, uint32_t* first);

/** Create an affine map x -> M x + t in exact numbers, same as Transform in transform.hpp: the
 * identity, or the three rows of M, each followed by its element of t, 12 numbers. To transform a
 * transformed object rounds again: combine the maps by raylane_transform_then() to round once. */
RAYLANE_API raylane_status raylane_transform_create(raylane_transform** transform);
RAYLANE_API raylane_status raylane_transform_matrix(const double* rows,
                                                    raylane_transform** transform);
RAYLANE_API void raylane_transform_release(raylane_transform* transform);
/** Change a map: it is then followed by another one. `by`: factors, degrees about the axes x, y and
 * z one after the other, or lengths. A call that fails changes nothing. */
RAYLANE_API raylane_status raylane_transform_scale(raylane_transform* transform,
                                                   raylane_double_vec3 by);
RAYLANE_API raylane_status raylane_transform_rotate(raylane_transform* transform,
                                                    raylane_double_vec3 by);
RAYLANE_API raylane_status raylane_transform_translate(raylane_transform* transform,
                                                       raylane_double_vec3 by);
RAYLANE_API raylane_status raylane_transform_then(raylane_transform* transform,
                                                  const raylane_transform* next);

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
/** The solid with each number of its shapes transformed and rounded once, same as
 * Solid::transformed() in solid.hpp. Parts keep their materials. */
RAYLANE_API raylane_status raylane_solid_transformed(const raylane_solid* solid,
                                                     const raylane_transform* transform,
                                                     raylane_solid** transformed);
/** The solid with another material. Parts that have their own material keep it. */
RAYLANE_API raylane_status raylane_solid_of_material(const raylane_solid* solid, uint32_t material,
                                                     raylane_solid** result);
RAYLANE_API void raylane_solid_release(raylane_solid* solid);

/** Adds a solid, same as SceneBuilder::add(solid, material). *first is the id of its first part;
 * the ids of the other parts follow. `first` may be NULL. */
RAYLANE_API raylane_status raylane_add_solid(raylane_builder* builder, const raylane_solid* solid,
                                             uint32_t material, uint32_t* first);

/** Groups: objects with a common transform or material, same as Group in group.hpp. Members are
 * shapes, solids, and the members of other groups. Members with RAYLANE_NO_MATERIAL take the
 * material of the group, of a group around it or of raylane_add_group(). */
RAYLANE_API raylane_status raylane_group_create(raylane_group** group);
RAYLANE_API void raylane_group_release(raylane_group* group);
/** Returns the number of members. */
RAYLANE_API size_t raylane_group_size(const raylane_group* group);
/** Add `count` shapes to a group. If a shape is invalid, the shapes before it have been added, and
 * the error text gives its number. A float counts exactly as the double of the same value. */
RAYLANE_API raylane_status raylane_group_add_spheres(raylane_group* group,
                                                     const raylane_double_sphere* shapes,
                                                     size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_planes(raylane_group* group,
                                                    const raylane_double_plane* shapes,
                                                    size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_discs(raylane_group* group,
                                                   const raylane_double_disc* shapes, size_t count,
                                                   uint32_t material);
RAYLANE_API raylane_status raylane_group_add_triangles(raylane_group* group,
                                                       const raylane_double_triangle* shapes,
                                                       size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_smooth_triangles(
    raylane_group* group, const raylane_double_smooth_triangle* shapes, size_t count,
    uint32_t material);
RAYLANE_API raylane_status raylane_group_add_boxes(raylane_group* group,
                                                   const raylane_double_box* shapes, size_t count,
                                                   uint32_t material);
RAYLANE_API raylane_status raylane_group_add_open_cylinders(raylane_group* group,
                                                            const raylane_double_cylinder* shapes,
                                                            size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_capped_cylinders(raylane_group* group,
                                                              const raylane_double_cylinder* shapes,
                                                              size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_open_cones(raylane_group* group,
                                                        const raylane_double_cone* shapes,
                                                        size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_capped_cones(raylane_group* group,
                                                          const raylane_double_cone* shapes,
                                                          size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_quadrics(raylane_group* group,
                                                      const raylane_double_quadric* shapes,
                                                      size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_ellipsoids(raylane_group* group,
                                                        const raylane_double_ellipsoid* shapes,
                                                        size_t count, uint32_t material);
RAYLANE_API raylane_status raylane_group_add_solid(raylane_group* group, const raylane_solid* solid,
                                                   uint32_t material);
RAYLANE_API raylane_status raylane_group_add_group(raylane_group* group,
                                                   const raylane_group* members, uint32_t material);
/** The group with each number of its shapes transformed and rounded once, same as
 * Group::transformed() in group.hpp. */
RAYLANE_API raylane_status raylane_group_transformed(const raylane_group* group,
                                                     const raylane_transform* transform,
                                                     raylane_group** transformed);
/** The group with the material for members without one. */
RAYLANE_API raylane_status raylane_group_of_material(const raylane_group* group, uint32_t material,
                                                     raylane_group** result);
/** The union of the members, which are solids and half-spaces, for use as a part of another solid.
 * Fails if the group is empty. */
RAYLANE_API raylane_status raylane_solid_group(const raylane_group* group, uint32_t material,
                                               raylane_solid** solid);
/** Adds all members of a group as objects of the scene. A builder takes a group any number of
 * times. *first is the id of the first shape; `first` may be NULL. */
RAYLANE_API raylane_status raylane_add_group(raylane_builder* builder, const raylane_group* group,
                                             uint32_t material, uint32_t* first);

/** The place of a copy of a group, same as Placement in group.hpp. */
typedef struct raylane_placement {
    raylane_double_vec3 translate, rotate;
    double scale;
} raylane_placement;
/** Returns the default values of the C++ struct. */
RAYLANE_API raylane_placement raylane_default_placement(void);
/** Adds `count` copies of a group, same as SceneBuilder::add(group, placements, material) in
 * scene.hpp, which tells when copies are kept as copies. *first is the id of the first shape;
 * `first` may be NULL. */
RAYLANE_API raylane_status raylane_add_copies(raylane_builder* builder, const raylane_group* group,
                                              const raylane_placement* placements, size_t count,
                                              uint32_t material, uint32_t* first);
/** Sets SceneBuilder::keep_from, the number of shapes in one call from which copies are kept. */
RAYLANE_API raylane_status raylane_set_keep_from(raylane_builder* builder, size_t shapes);

/** Builds the scene. Leaves the builder empty, even if the call fails, unless it fails because the
 * environment variable RAYLANE_THREADS is invalid. */
RAYLANE_API raylane_status raylane_build(raylane_builder* builder, raylane_scene** scene);
/** Returns the remarks of the calling thread's last call of raylane_load(), raylane_parse(), their
 * variants for atoms, raylane_save(), raylane_render() or raylane_render_image(), one a line; empty
 * without remarks. These are warnings: contents of a file that raylane ignores, a scene without
 * objects, a feature that a format cannot express, or annotations that are left out. Valid until
 * the next such call of this thread. */
RAYLANE_API const char* raylane_remarks(void);
/** Reads a scene from a file. `path` is in the system's encoding; "-" is a file of that name. */
RAYLANE_API raylane_status raylane_load(const char* path, raylane_scene** scene);
/** Reads a scene from a text of `length` bytes in memory. `name` stands for the file's name in
 * messages, in the search for included files and in the choice of the format. */
RAYLANE_API raylane_status raylane_parse(const char* text, size_t length, const char* name,
                                         raylane_scene** scene);
/** An option of scenes from atoms, same as AtomOptions in scene.hpp: {"style", "balls"},
 * {"representations", "ligand: sticks"}, {"scale_bar", "auto"}. */
typedef struct raylane_atom_option {
    const char *name, *value;
} raylane_atom_option;
/** Reads atoms from memory with `count` options, same as parse_atoms() in scene.hpp. */
RAYLANE_API raylane_status raylane_parse_atoms(const char* text, size_t length, const char* name,
                                               const raylane_atom_option* options, size_t count,
                                               raylane_scene** scene);
/** Reads atoms from a file with `count` options, same as load_atoms() in scene.hpp. */
RAYLANE_API raylane_status raylane_load_atoms(const char* path, const raylane_atom_option* options,
                                              size_t count, raylane_scene** scene);
/** Writes a scene to a file in the format of its ending: .json, .rl, .nff or .pov. Same as save()
 * in scene.hpp. */
RAYLANE_API raylane_status raylane_save(const raylane_scene* scene, const char* path);
RAYLANE_API void raylane_scene_release(raylane_scene* scene);
RAYLANE_API size_t raylane_shape_count(const raylane_scene* scene);
RAYLANE_API size_t raylane_material_count(const raylane_scene* scene);
/** Gives a material of the scene. Fails if none has this index. The texts of a formula and the
 * image are valid until the calling thread's next call of this function or of
 * raylane_material_preset(). */
RAYLANE_API raylane_status raylane_scene_material(const raylane_scene* scene, uint32_t index,
                                                  raylane_material* material);
/** Gives the name of a material, empty if it has none. Stores at most `size` bytes with the final
 * 0, and the length of the whole name in *length. `name` may be NULL if `size` is 0; `length` may
 * be NULL. */
RAYLANE_API raylane_status raylane_scene_material_name(const raylane_scene* scene, uint32_t index,
                                                       char* name, size_t size, size_t* length);
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
RAYLANE_API raylane_camera raylane_scene_camera(const raylane_scene* scene);
RAYLANE_API raylane_fog raylane_scene_fog(const raylane_scene* scene);
RAYLANE_API raylane_vec3 raylane_scene_background(const raylane_scene* scene);
/** Gives the lights of a scene: at most `size` of them, and their number in *count. `lights` may be
 * NULL if `size` is 0. */
RAYLANE_API raylane_status raylane_scene_lights(const raylane_scene* scene, raylane_light* lights,
                                                size_t size, size_t* count);

/** Gives a shape with exactly the numbers that it was given, same as Scene::shape() in scene.hpp.
 * *type is RAYLANE_SPHERE to RAYLANE_ELLIPSOID. `numbers`: RAYLANE_MAX_NUMBERS doubles, of which
 * the first ones are the members of the type's struct in double. Fails if no shape has this id. */
RAYLANE_API raylane_status raylane_scene_shape(const raylane_scene* scene, uint32_t shape_id,
                                               int* type, double* numbers);
/** Give the shapes of a type with exactly the numbers that they were given, in the order of their
 * ids, same as Scene::shapes() in scene.hpp. Store at most `size` ids, materials and shapes, and
 * the number of all in *count. Arrays that are not wanted may be NULL, also all of them. */
RAYLANE_API raylane_status raylane_scene_spheres(const raylane_scene* scene, uint32_t* ids,
                                                 uint32_t* materials, raylane_double_sphere* shapes,
                                                 size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_planes(const raylane_scene* scene, uint32_t* ids,
                                                uint32_t* materials, raylane_double_plane* shapes,
                                                size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_discs(const raylane_scene* scene, uint32_t* ids,
                                               uint32_t* materials, raylane_double_disc* shapes,
                                               size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_triangles(const raylane_scene* scene, uint32_t* ids,
                                                   uint32_t* materials,
                                                   raylane_double_triangle* shapes, size_t size,
                                                   size_t* count);
RAYLANE_API raylane_status raylane_scene_smooth_triangles(const raylane_scene* scene, uint32_t* ids,
                                                          uint32_t* materials,
                                                          raylane_double_smooth_triangle* shapes,
                                                          size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_boxes(const raylane_scene* scene, uint32_t* ids,
                                               uint32_t* materials, raylane_double_box* shapes,
                                               size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_open_cylinders(const raylane_scene* scene, uint32_t* ids,
                                                        uint32_t* materials,
                                                        raylane_double_cylinder* shapes,
                                                        size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_capped_cylinders(const raylane_scene* scene, uint32_t* ids,
                                                          uint32_t* materials,
                                                          raylane_double_cylinder* shapes,
                                                          size_t size, size_t* count);
RAYLANE_API raylane_status raylane_scene_open_cones(const raylane_scene* scene, uint32_t* ids,
                                                    uint32_t* materials,
                                                    raylane_double_cone* shapes, size_t size,
                                                    size_t* count);
RAYLANE_API raylane_status raylane_scene_capped_cones(const raylane_scene* scene, uint32_t* ids,
                                                      uint32_t* materials,
                                                      raylane_double_cone* shapes, size_t size,
                                                      size_t* count);
RAYLANE_API raylane_status raylane_scene_quadrics(const raylane_scene* scene, uint32_t* ids,
                                                  uint32_t* materials,
                                                  raylane_double_quadric* shapes, size_t size,
                                                  size_t* count);
RAYLANE_API raylane_status raylane_scene_ellipsoids(const raylane_scene* scene, uint32_t* ids,
                                                    uint32_t* materials,
                                                    raylane_double_ellipsoid* shapes, size_t size,
                                                    size_t* count);

/** Creates a scene with the same shapes and another camera, same as Scene::seen_by(). */
RAYLANE_API raylane_status raylane_seen_by(const raylane_scene* scene, const raylane_camera* camera,
                                           raylane_scene** seen);
/** Gives a perspective camera that shows all bounded shapes, same as Scene::camera_on_all().
 * `direction`: line of sight, of any length except zero. `aspect`: width divided by height. */
RAYLANE_API raylane_status raylane_camera_on_all(const raylane_scene* scene, raylane_vec3 direction,
                                                 float aspect, raylane_camera* camera);
/** Gives the rays of an image, same as camera_rays() in camera_rays.hpp: those that
 * raylane_render() traces through the centres of pixels. `origins` and `directions`: 3 x height x
 * width numbers, the x of all rays, then all y, then all z. Ray y width + x belongs to pixel (x,
 * y). */
RAYLANE_API raylane_status raylane_camera_rays(const raylane_camera* camera, int width, int height,
                                               double* origins, double* directions);
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

/** Give the rays that continue from hits in new directions, same as onward() in tracer.hpp. Store
 * their origins, and the sides for raylane_rays::origin_inward. The other members of the new rays
 * are the directions, and the hits' shape_id and face as origin_shape and origin_face. `hits` must
 * have t or t_double (for doubles the better choice), the three normals, shape_id and face. If a
 * ray hit nothing, its new origin is NaN, so it is refused. Origins may be stored over the old
 * ones. */
RAYLANE_API raylane_status raylane_onward(const raylane_rays* rays, const raylane_hits* hits,
                                          const float* direction_x, const float* direction_y,
                                          const float* direction_z, float* origin_x,
                                          float* origin_y, float* origin_z, uint8_t* inward);
RAYLANE_API raylane_status raylane_onward_doubles(
    const raylane_double_rays* rays, const raylane_hits* hits, const double* direction_x,
    const double* direction_y, const double* direction_z, double* origin_x, double* origin_y,
    double* origin_z, uint8_t* inward);

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

/** Output arrays for closest points, same as ClosestSpan in tracer.hpp. NULL: not wanted. */
typedef struct raylane_closest_points {
    double *distance, *point_x, *point_y, *point_z;
    uint32_t* shape_id;
    uint8_t* face;
} raylane_closest_points;

/** Find the surface point that is closest to each point, same as Tracer::closest in tracer.hpp.
 * `max_distance` has one element for each point; NULL: infinity. */
RAYLANE_API raylane_status raylane_closest(const raylane_tracer* tracer,
                                           const raylane_points* points, const double* max_distance,
                                           const raylane_closest_points* closest);
RAYLANE_API raylane_status raylane_closest_doubles(const raylane_tracer* tracer,
                                                   const raylane_double_points* points,
                                                   const double* max_distance,
                                                   const raylane_closest_points* closest);

/** Output arrays for the cells of points, same as CellSpan in tracer.hpp. NULL: not wanted. */
typedef struct raylane_cell_columns {
    uint32_t *shape_id, *material;
    uint8_t* on_surface;
} raylane_cell_columns;
/** Find the cell of each point, same as Tracer::cells in tracer.hpp: of the solids that it is
 * inside of, the one that was added last. */
RAYLANE_API raylane_status raylane_cells(const raylane_tracer* tracer, const raylane_points* points,
                                         const raylane_cell_columns* cells);
RAYLANE_API raylane_status raylane_cells_doubles(const raylane_tracer* tracer,
                                                 const raylane_double_points* points,
                                                 const raylane_cell_columns* cells);

/** Normals of crossings: floats, doubles, or the sum of both. */
enum { RAYLANE_NO_NORMALS = 0, RAYLANE_NORMALS = 1, RAYLANE_NORMALS_DOUBLE = 2 };

/** Create rows of results, one for each ray or point, which the caller releases. The queries are
 * those of Tracer in tracer.hpp, with the same results. `most`: maximum number of crossings of each
 * ray, nearest first; 0: all. `normals`: RAYLANE_NO_NORMALS, RAYLANE_NORMALS,
 * RAYLANE_NORMALS_DOUBLE or the sum of the last two: the columns of normals. */
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
/** Measures the length of each ray inside of each solid. */
RAYLANE_API raylane_status raylane_solid_lengths(const raylane_tracer* tracer,
                                                 const raylane_rays* rays, raylane_rows** rows);
RAYLANE_API raylane_status raylane_solid_lengths_doubles(const raylane_tracer* tracer,
                                                         const raylane_double_rays* rays,
                                                         raylane_rows** rows);
RAYLANE_API void raylane_rows_release(raylane_rows* rows);

/** Counts of a query for all crossings, same as CrossingStatistics in tracer.hpp. */
typedef struct raylane_crossing_statistics {
    uint64_t by_bounds, by_digits, exactly, beyond_double, refused;
} raylane_crossing_statistics;
/** Returns the counts of the query that made the rows. Rows of other queries than those for
 * crossings count only refused rays or points. All counts are 0 for NULL. */
RAYLANE_API raylane_crossing_statistics raylane_rows_statistics(const raylane_rows* rows);

/** Returns the number of rows. */
RAYLANE_API size_t raylane_rows_count(const raylane_rows* rows);
/** Returns the row offsets (as in compressed sparse rows, CSR), one more than there are rows. The
 * elements of row i are those from first[i] to first[i + 1] - 1 in each column. NULL for NULL. */
RAYLANE_API const uint64_t* raylane_rows_first(const raylane_rows* rows);
/** Return columns of first[count] elements, valid until the rows are released. A column is NULL if
 * it has no elements or if the query has no such column:
 * - crossings: t, shape_id, entering, face, tied, touching; normals if wanted;
 * - contains: shape_id, inside, on_surface;
 * - path lengths: material, length;
 * - solid lengths: shape_id, length. */
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
RAYLANE_API const double* raylane_rows_normal_double_x(const raylane_rows* rows);
RAYLANE_API const double* raylane_rows_normal_double_y(const raylane_rows* rows);
RAYLANE_API const double* raylane_rows_normal_double_z(const raylane_rows* rows);

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

/** Options of raylane_render_image(), same as RenderOptions in image.hpp. `settings` and `progress`
 * may be NULL. The image has the part with these sides and this upper left pixel, or, if
 * crop_width and crop_height are 0, all pixels. annotations: the name of an SVG file for the
 * annotations of a scene of atoms; NULL: they are put over the image. */
typedef struct raylane_render_options {
    const raylane_settings* settings;
    int threads, precision;
    int crop_x, crop_y, crop_width, crop_height;
    raylane_progress_callback progress;
    void* user;
    const char* annotations;
} raylane_render_options;
/** Returns the default values of the C++ struct. */
RAYLANE_API raylane_render_options raylane_default_render_options(void);
/** Output arrays of an image with height x width pixels, same as Image and Aovs in image.hpp.
 * NULL: not wanted. If `alpha` is not NULL, the image has alpha, whatever the scene's settings.
 * `rgb` and `normal` have three floats for each pixel. */
typedef struct raylane_image {
    float *rgb, *alpha, *depth, *normal;
    uint32_t *shape_id, *material, *samples;
} raylane_image;
/** Renders an image, or a part of it, with alpha and AOVs if they are wanted. `options` may be
 * NULL. */
RAYLANE_API raylane_status raylane_render_image(const raylane_scene* scene,
                                                const raylane_render_options* options,
                                                const raylane_image* image);
/** Writes an image of height x width x 3 floats to a file in the format of its ending. Same as
 * write_image() in image.hpp. transfer: RAYLANE_SRGB or RAYLANE_LINEAR, for 8-bit formats. */
RAYLANE_API raylane_status raylane_write_image(const char* path, int width, int height,
                                               const float* rgb, int transfer);

#ifdef __cplusplus
}
#endif

/* NOLINTEND */
#endif
