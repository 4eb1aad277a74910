#pragma once

#include "raylane/raylane.hpp"
#include "tests/scenes/api/in_library.hpp"
#include "tests/support/ray_sets.hpp"

#include <bit>
#include <limits>

/// Arrays of rays and of hits for tests of the library, and scenes for them.
namespace raylane::tests {

using ray_sets::Random;
using ray_sets::Set;

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Owns the arrays of rays.
struct Rays {
    std::vector<float> x, y, z, dx, dy, dz, t_min, t_max;

    void add(const Vec3& origin, const Vec3& direction) {
        x.push_back(origin.x);
        y.push_back(origin.y);
        z.push_back(origin.z);
        dx.push_back(direction.x);
        dy.push_back(direction.y);
        dz.push_back(direction.z);
    }
    std::size_t size() const { return x.size(); }
    RaySpan span() const { return {x, y, z, dx, dy, dz, t_min, t_max}; }
    RaySpan part(std::size_t first, std::size_t count) const {
        const auto column = [&](const std::vector<float>& values) {
            return values.empty() ? std::span<const float>()
                                  : std::span(values).subspan(first, count);
        };
        return {column(x),  column(y),  column(z),     column(dx),
                column(dy), column(dz), column(t_min), column(t_max)};
    }
    core::Ray<double> ray(std::size_t i) const {
        return {core::convert<double>(core::Vec3f(x[i], y[i], z[i])),
                core::convert<double>(core::Vec3f(dx[i], dy[i], dz[i]))};
    }
};

struct Hits {
    explicit Hits(std::size_t count)
        : t(count, -1.0F), nx(count, 9.0F), ny(count, 9.0F), nz(count, 9.0F), shape(count, 12345),
          entering(count, 77) {}

    std::vector<float> t, nx, ny, nz;
    std::vector<ShapeId> shape;
    std::vector<std::uint8_t> entering;

    HitSpan span() { return {t, nx, ny, nz, shape, entering}; }
    bool operator==(const Hits&) const = default;
    bool is_same(std::size_t i, const Hits& other) const {
        return t[i] == other.t[i] && nx[i] == other.nx[i] && ny[i] == other.ny[i] &&
               nz[i] == other.nz[i] && shape[i] == other.shape[i] &&
               entering[i] == other.entering[i];
    }
    bool is_none(std::size_t i) const {
        return t[i] == infinity && nx[i] == 0.0F && ny[i] == 0.0F && nz[i] == 0.0F &&
               shape[i] == no_shape && entering[i] == 0;
    }
};

/// Hits with their faces and t in double.
struct FullHits : Hits {
    explicit FullHits(std::size_t count) : Hits(count), face(count, 77), t_double(count, -1.0) {}
    template <class RayArrays>
    FullHits(const Tracer& tracer, const RayArrays& rays) : FullHits(rays.size()) {
        tracer.intersect(rays.span(), span());
    }

    std::vector<std::uint8_t> face;
    std::vector<double> t_double;

    HitSpan span() {
        HitSpan hits = Hits::span();
        hits.face = face;
        hits.t_double = t_double;
        return hits;
    }
    bool is_same(std::size_t i, const FullHits& other, std::size_t k) const {
        return t[i] == other.t[k] && nx[i] == other.nx[k] && ny[i] == other.ny[k] &&
               nz[i] == other.nz[k] && shape[i] == other.shape[k] &&
               entering[i] == other.entering[k] && face[i] == other.face[k] &&
               t_double[i] == other.t_double[k];
    }
};

/// Owns the arrays of normals in double.
struct DoubleNormals {
    explicit DoubleNormals(std::size_t count) : x(count, 9.0), y(count, 9.0), z(count, 9.0) {}

    std::vector<double> x, y, z;

    void add_to(HitSpan& hits) {
        hits.normal_double_x = x;
        hits.normal_double_y = y;
        hits.normal_double_z = z;
    }
    core::Vec3d operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    bool operator==(const DoubleNormals&) const = default;
};

inline Hits intersect(const Tracer& tracer, const Rays& rays) {
    Hits hits(rays.size());
    tracer.intersect(rays.span(), hits.span());
    return hits;
}

inline std::vector<std::uint8_t> occluded(const Tracer& tracer, const Rays& rays) {
    std::vector<std::uint8_t> result(rays.size(), 77);
    tracer.occluded(rays.span(), result);
    return result;
}

struct Heap {
    Scene scene;
    Rays rays;
};

template <class CoreShape>
ShapeId add(SceneBuilder& builder, const CoreShape& shape, MaterialIndex material) {
    return builder.add(std::bit_cast<typename InLibrary<CoreShape>::Type>(shape), material);
}

template <class CoreShape>
void add_kind(SceneBuilder& builder, MaterialIndex material, int count, bool lattice,
              Random& random, Rays& rays) {
    for (int i = 0; i < count; ++i) {
        const auto shape = ray_sets::Target<CoreShape>::make(random, lattice);
        add(builder, shape, material);
        for (const Set set : ray_sets::all_sets) {
            if ((set == Set::lattice) != lattice) continue;
            const core::Ray<float> ray = ray_sets::make_ray(shape, set, random);
            rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                     {ray.direction.x, ray.direction.y, ray.direction.z});
        }
    }
}

/// Returns a scene of all kinds of shapes in one heap, with rays that are hard for some of them.
inline Heap heap(bool lattice, int of_each_kind, std::uint64_t seed, const Material& look = {}) {
    Random random(seed);
    SceneBuilder builder;
    Rays rays;
    const MaterialIndex material = builder.add_material(look);
    core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        const int count = is_bounded<Shape> ? of_each_kind : 2;
        add_kind<Shape>(builder, material, count, lattice, random, rays);
    });
    return {builder.build(), rays};
}

inline Heap heap() {
#ifdef RAYLANE_FEW_RAYS
    return heap(false, 6, 1);
#else
    return heap(false, 40, 1);
#endif
}

/// Returns a scene of a unit ball around the origin.
inline Scene ball(const Material& material = {}) {
    SceneBuilder builder;
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material(material));
    return builder.build();
}

/// Returns a ray down the z axis to the unit ball: t = 4 and 6.
inline Rays to_ball() {
    Rays rays;
    rays.add({0, 0, 5}, {0, 0, -1});
    return rays;
}

} // namespace raylane::tests
