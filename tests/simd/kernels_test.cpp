#include "core/scene/shape_table.hpp"
#include "core/shapes/solve.hpp"
#include "simd/isa.hpp"
#include "tests/catch.hpp"
#include "tests/ray_sets.hpp"
#include "tests/simd/rounds.hpp"

#include <bit>
#include <cmath>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;

/// Every lane of every kernel against the scalar float reference, to the bit.

namespace {

int rounds() {
    return tests::rounds(1500);
}

constexpr std::size_t rays_a_round = 16 * 16 + 5; // the last packet is not full

float as_float(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}

struct Expected {
    float t = std::numeric_limits<float>::infinity();
    std::uint32_t shape = no_shape;
    float face = 0.0F;
    bool entering = false;
};

/// What the scalar reference says, one shape after the other.
template <class Shape>
void expect(const Shape& shape, ShapeId id, const Ray<float>& ray, const Start& start,
            Expected& best) {
    std::uint64_t widened = 0;
    for (const core::Crossing<float>& crossing : solve(shape, ray, start, widened)) {
        if (!(crossing.t > 0.0F || (start.on_surface && crossing.t == 0.0F))) continue;
        if (!(crossing.t < best.t || (crossing.t == best.t && id < best.shape))) continue;
        best = {crossing.t, id, static_cast<float>(crossing.face), crossing.entering};
    }
}

/// Owns the arrays of a stream.
struct Stream {
    std::vector<float> ox, oy, oz, dx, dy, dz, first, last, from_face, inward;
    std::vector<float> t, shape, face, entering;
    std::vector<Ray<float>> rays;
    std::vector<Start> starts;

    void add(const Ray<float>& ray, ShapeId departed, const Start& start) {
        rays.push_back(ray);
        starts.push_back(start);
        push({ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
              ray.direction.z, as_float(start.on_surface ? departed : no_shape),
              as_float(start.on_surface ? departed : no_shape), static_cast<float>(start.face),
              start.inward ? 1.0F : 0.0F, std::numeric_limits<float>::infinity(),
              as_float(no_shape), 0.0F, 0.0F});
    }

    /// Inert lanes, full of NaN.
    void fill_up() {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        while (ox.size() % 16 != 0)
            push({nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, -1.0F, as_float(no_shape), nan,
                  nan});
    }

    PacketStream view() {
        return {rays.size(),
                {ox.data(), oy.data(), oz.data()},
                {dx.data(), dy.data(), dz.data()},
                first.data(),
                last.data(),
                from_face.data(),
                inward.data(),
                t.data(),
                shape.data(),
                face.data(),
                entering.data()};
    }

  private:
    void push(const std::array<float, 14>& values) {
        std::vector<float>* const arrays[14] = {&ox, &oy,    &oz,   &dx,        &dy,
                                                &dz, &first, &last, &from_face, &inward,
                                                &t,  &shape, &face, &entering};
        for (int i = 0; i < 14; ++i)
            arrays[i]->push_back(values[i]);
    }
};

bool same(const Expected& expected, const Stream& stream, std::size_t i) {
    return std::bit_cast<std::uint32_t>(expected.t) == std::bit_cast<std::uint32_t>(stream.t[i]) &&
           expected.shape == std::bit_cast<std::uint32_t>(stream.shape[i]) &&
           expected.face == stream.face[i] &&
           (expected.entering ? 1.0F : 0.0F) == stream.entering[i];
}

template <class Shape>
struct Round {
    Block<Shape> block;
    Stream stream;

    explicit Round(Random& random) {
        const int count = random.integer(1, block_size);
        const ShapeId first_id = static_cast<ShapeId>(random.integer(0, 1000));
        const bool lattice = random.integer(0, 3) == 0;
        for (int lane = 0; lane < count; ++lane)
            block.set(lane, ray_sets::Target<Shape>::make(random, lattice), first_id + lane);
        for (std::size_t i = 0; i < rays_a_round; ++i) {
            const int lane = random.integer(0, count - 1);
            const Set set = lattice ? Set::lattice : ray_sets::any_set(random);
            const Ray<float> ray = ray_sets::make_ray(block.get(lane), set, random);
            add_ray(ray, lane, random);
        }
        stream.fill_up();
    }

    ShapeBlock view() const { return {block.values, reinterpret_cast<const float*>(block.ids)}; }

  private:
    /// From where it starts, or half the time from where it hits, as a ray that leaves the surface.
    void add_ray(const Ray<float>& ray, int lane, Random& random) {
        const Shape shape = block.get(lane);
        std::uint64_t widened = 0;
        for (const core::Crossing<float>& crossing : solve(shape, ray, Start{}, widened)) {
            if (!(crossing.t > 0.0F) || random.integer(0, 1) == 0) continue;
            const Vec3f point = mul_add(crossing.t, ray.direction, ray.origin);
            const Vec3f direction = ray_sets::rounded(random.direction());
            const bool inward = random.integer(0, 1) == 0;
            stream.add({point, direction}, block.ids[lane], {true, crossing.face, inward});
            return;
        }
        stream.add(ray, no_shape, Start{});
    }
};

template <class Shape>
void check_round(const Kernels& kernels, Random& random, int& hits) {
    Round<Shape> round(random);
    const auto kind = static_cast<KindNumber>(kind_of<Shape>);
    const std::size_t count = round.stream.rays.size();
    std::vector<Expected> expected(count);
    for (std::size_t i = 0; i < count; ++i)
        for (int lane = 0; lane < block_size && round.block.ids[lane] != no_shape; ++lane) {
            const ShapeId id = round.block.ids[lane];
            const bool departs = std::bit_cast<std::uint32_t>(round.stream.first[i]) == id;
            expect(round.block.get(lane), id, round.stream.rays[i],
                   departs ? round.stream.starts[i] : Start{}, expected[i]);
        }

    Stream by_rays = round.stream, by_block = round.stream;
    PacketStream view = by_rays.view();
    // Against the order of the ids: the tie goes to the lower one all the same.
    for (int lane = block_size - 1; lane >= 0; --lane)
        if (round.block.ids[lane] != no_shape)
            kernels.intersect_rays(kind, round.view(), lane, view);
    view = by_block.view();
    for (std::size_t i = 0; i < count; ++i)
        kernels.intersect_block(kind, round.view(), view, i);

    // Halfway to the hit nothing is in the way, behind it something is.
    Stream far = round.stream, near = round.stream, far_by_block = round.stream;
    for (std::size_t i = 0; i < count; ++i) {
        const bool hit = expected[i].shape != no_shape;
        near.t[i] = hit ? expected[i].t : 1e30F;
        far.t[i] = far_by_block.t[i] =
            hit ? std::nextafter(expected[i].t, std::numeric_limits<float>::infinity()) : 1e30F;
    }
    PacketStream near_view = near.view(), far_view = far.view(), block_view = far_by_block.view();
    for (int lane = 0; lane < block_size && round.block.ids[lane] != no_shape; ++lane) {
        kernels.occlude_rays(kind, round.view(), lane, near_view);
        kernels.occlude_rays(kind, round.view(), lane, far_view);
    }
    for (std::size_t i = 0; i < count; ++i) {
        kernels.occlude_block(kind, round.view(), block_view, i);
        const bool hit = expected[i].shape != no_shape;
        if (near.t[i] == -1.0F) FAIL("blocked before the hit");
        if ((far.t[i] == -1.0F) != hit) FAIL("one shape, many shadow rays");
        if ((far_by_block.t[i] == -1.0F) != hit) FAIL("one shadow ray, many shapes");
    }

    for (std::size_t i = 0; i < count; ++i) {
        hits += expected[i].shape != no_shape ? 1 : 0;
        const bool right_by_rays = same(expected[i], by_rays, i);
        if (right_by_rays && same(expected[i], by_block, i)) continue;
        CAPTURE(i, expected[i].t, by_rays.t[i], by_block.t[i], expected[i].face, by_rays.face[i],
                round.stream.starts[i].on_surface);
        FAIL((right_by_rays ? "one ray, many shapes" : "one shape, many rays"));
    }
    for (std::size_t i = count; i < by_rays.t.size(); ++i)
        if (by_rays.t[i] != -1.0F) FAIL("an inert lane was hit");
}

/// All faces of a shape at once, at points on and around it.
template <class Shape>
void check_normals(const Kernels& kernels, Random& random) {
    const Round<Shape> round(random);
    std::vector<float> x, y, z, face;
    std::vector<Vec3f> expected;
    for (const Ray<float>& ray : round.stream.rays) {
        std::uint64_t widened = 0;
        for (const core::Crossing<float>& crossing :
             solve(round.block.get(0), ray, Start{}, widened)) {
            const Vec3f point = mul_add(crossing.t, ray.direction, ray.origin);
            x.push_back(point.x);
            y.push_back(point.y);
            z.push_back(point.z);
            face.push_back(static_cast<float>(crossing.face));
            expected.push_back(outward_normal(round.block.get(0), point, crossing.face));
        }
    }
    for (std::vector<float>* array : {&x, &y, &z, &face})
        array->resize((array->size() + 15) / 16 * 16);
    std::vector<float> nx(x.size()), ny(x.size()), nz(x.size());
    const float* const points[3] = {x.data(), y.data(), z.data()};
    float* const normals[3] = {nx.data(), ny.data(), nz.data()};
    kernels.outward_normals(static_cast<KindNumber>(kind_of<Shape>), round.view(), 0,
                            expected.size(), points, face.data(), normals);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const Vec3f found(nx[i], ny[i], nz[i]);
        for (int axis = 0; axis < 3; ++axis)
            if (std::bit_cast<std::uint32_t>(found[axis]) !=
                    std::bit_cast<std::uint32_t>(expected[i][axis]) &&
                !(std::isnan(found[axis]) && std::isnan(expected[i][axis]))) {
                CAPTURE(i, face[i], nx[i], expected[i].x, ny[i], expected[i].y, nz[i],
                        expected[i].z);
                FAIL("another normal");
            }
    }
}

} // namespace

TEMPLATE_TEST_CASE("every lane of every kernel says what the scalar float reference says", "",
                   RAYLANE_ALL_SHAPES) {
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        const Kernels& kernels = kernels_of(isa);
        CAPTURE(std::string(kernels.name));
        Random random(11);
        int hits = 0;
        for (int round = 0; round < rounds(); ++round)
            check_round<TestType>(kernels, random, hits);
        for (int round = 0; round < rounds() / 4; ++round)
            check_normals<TestType>(kernels, random);
        CHECK(hits > rounds() * static_cast<int>(rays_a_round) / 8);
    }
}
