#include "core/shapes/shape_table.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "tests/simd/kernel/shapes/solve_kernels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;

/// Compares hits that `solve` is certain of with the certified scalar solver in double.

namespace {

int rounds() {
    return tests::rounds(40, 20, 100);
}

constexpr double sentinel = -12345.0;

SceneView view_of(const Tables& tables) {
    SceneView view{};
    std::uint32_t slots = 0;
    for_each_table(tables, [&]<class Shape>(const Table<Shape>& table) {
        const auto blocks = static_cast<std::uint32_t>(table.blocks().size());
        view.tables[static_cast<int>(kind_of<Shape>)] = {
            reinterpret_cast<const float*>(table.plain_blocks().data()), blocks,
            sizeof(Block<Shape>) / sizeof(float), number_count<Shape>, slots};
        slots += 16 * blocks;
    });
    return view;
}

struct Expected {
    std::optional<core::Crossing<double>> crossing;
    Vec3d normal, shading_normal;
    bool has_normal = false; ///< false at an apex
};

template <class Shape>
Expected expected(const Shape& shape, const Ray<double>& ray, const Start& start) {
    std::uint64_t widened = 0;
    for (const core::Crossing<double>& crossing : solve(shape, ray, start, widened)) {
        if (!(crossing.t > 0.0 || (start.on_surface && crossing.t == 0.0))) continue;
        const Vec3d point = mul_add(crossing.t, ray.direction, ray.origin);
        Expected result = {crossing, outward_normal(shape, point, crossing.face), {}};
        const Vec3d nearby = mul_add(crossing.t * (1.0 + 1e-9), ray.direction, ray.origin);
        result.has_normal =
            length(outward_normal(shape, nearby, crossing.face) - result.normal) < 1e-4;
        if constexpr (requires { shading_normal(shape, point); })
            result.shading_normal = shading_normal(shape, point);
        else
            result.shading_normal = result.normal;
        return result;
    }
    return {};
}

/// The arrays of Found, padded to whole packets.
struct Rays {
    std::vector<Ray<double>> rays;
    std::vector<Expected> truth;
    std::vector<double> ox, oy, oz, dx, dy, dz;
    std::vector<std::uint32_t> first, last, origins, slot;
    std::vector<double> t, error, nx, ny, nz, sx, sy, sz;
    std::vector<std::uint32_t> hit;

    void add(const Ray<double>& ray, std::uint32_t to, ShapeId departed, const Start& start,
             const Expected& what) {
        rays.push_back(ray);
        truth.push_back(what);
        ox.push_back(ray.origin.x);
        oy.push_back(ray.origin.y);
        oz.push_back(ray.origin.z);
        dx.push_back(ray.direction.x);
        dy.push_back(ray.direction.y);
        dz.push_back(ray.direction.z);
        first.push_back(start.on_surface ? departed : no_shape);
        last.push_back(start.on_surface ? departed : no_shape);
        origins.push_back(start.face | (start.inward ? origin_inward : 0));
        slot.push_back(to);
    }

    /// Returns a view of the rays for `solve`. Values after the last ray must not matter.
    Found view(Random& random) {
        const std::size_t room = (rays.size() + 15) / 16 * 16;
        for (std::vector<double>* array : {&ox, &oy, &oz, &dx, &dy, &dz})
            array->resize(room, std::numeric_limits<double>::quiet_NaN());
        for (std::vector<std::uint32_t>* array : {&first, &last, &origins, &slot})
            while (array->size() < room)
                array->push_back(static_cast<std::uint32_t>(random.integer(0, 0x7FFFFFFF)));
        for (std::vector<double>* array : {&t, &error, &nx, &ny, &nz, &sx, &sy, &sz})
            array->assign(room, sentinel);
        hit.assign(room, 0xABCDEF);
        return {rays.size(),
                {ox.data(), oy.data(), oz.data()},
                {dx.data(), dy.data(), dz.data()},
                first.data(),
                last.data(),
                origins.data(),
                slot.data(),
                t.data(),
                error.data(),
                {nx.data(), ny.data(), nz.data()},
                {sx.data(), sy.data(), sz.data()},
                hit.data()};
    }

    bool untouched(std::size_t i) const {
        for (const std::vector<double>* array : {&t, &error, &nx, &ny, &nz, &sx, &sy, &sz})
            if ((*array)[i] != sentinel) return false;
        return hit[i] == 0xABCDEF;
    }
};

Ray<double> unit(const Ray<float>& ray) {
    return {convert<double>(ray.origin), normalized(convert<double>(ray.direction))};
}

/// Adds a ray to the shape or, half the time if that hits, a ray that leaves the shape at the hit.
/// Its side is that of the surface's normal, or with `adverse` sometimes the other.
template <class Shape>
void add_ray(Rays& rays, const Shape& shape, std::uint32_t slot, ShapeId id, Set set, bool adverse,
             Random& random) {
    const Ray<double> ray = unit(ray_sets::make_ray(shape, set, random));
    const Expected truth = expected(shape, ray, Start{});
    if (!truth.crossing || random.integer(0, 1) == 0) {
        rays.add(ray, slot, no_shape, Start{}, truth);
        return;
    }
    const Vec3d point = mul_add(truth.crossing->t, ray.direction, ray.origin);
    Vec3d direction = random.direction();
    if (adverse && random.integer(0, 3) == 0) direction = ray_sets::across(truth.normal, random);
    bool inward = dot(direction, truth.normal) < 0.0;
    if (adverse && random.integer(0, 3) == 0) inward = !inward;
    const Ray<double> onward = {point, direction};
    const Start start = {true, truth.crossing->face, inward};
    rays.add(onward, slot, id, start, expected(shape, onward, start));
}

template <class Shape>
void add_rays(Rays& rays, const Tables& tables, bool lattice, bool adverse, int count,
              Random& random) {
    const SceneView view = view_of(tables);
    const auto& table = std::get<Table<Shape>>(tables);
    std::uint32_t place = 0;
    for (int i = 0; i < count; ++i) {
        // Keeps a shape for some time, so that there are packets of one shape, of one kind, and of
        // all kinds.
        if (random.integer(0, 15) == 0 || i == 0)
            place =
                static_cast<std::uint32_t>(random.integer(0, static_cast<int>(table.size()) - 1));
        else if (random.integer(0, 1) == 0)
            place = (place + 1) % static_cast<std::uint32_t>(table.size());
        const Place at = {place / 16, static_cast<std::uint8_t>(place % 16)};
        const Set set =
            lattice ? Set::lattice
            : !adverse
                ? (!tests::is_flat<Shape> && random.integer(0, 2) == 0 ? Set::inside : Set::random)
                : ray_sets::any_set(random);
        add_ray(rays, to_floats(table.get(at)),
                view.tables[static_cast<int>(kind_of<Shape>)].first_slot + place, table.id(at), set,
                adverse, random);
    }
}

template <class Shape>
void add_shapes(Tables& tables, bool lattice, int count, Random& random) {
    ShapeList<Shape> list;
    for (int i = 0; i < count; ++i)
        list.add(ray_sets::Target<Shape>::make(random, lattice),
                 static_cast<ShapeId>(random.integer(0, 1000) * 64 + i));
    std::get<Table<Shape>>(tables) = Table<Shape>(list);
}

struct Share {
    long hits = 0, doubtful = 0;
    /// Counts rays that do not start on the shape, including those that miss it.
    long elsewhere = 0, doubtful_elsewhere = 0;
};

/// Kernels that solve the rays: `solve` alone, or `refine` as well.
enum class Way { once, again };

/// Checks one ray of `rays` after `solve`.
void check(const Rays& rays, std::size_t i, bool adverse, Share& share) {
    const Expected& truth = rays.truth[i];
    const std::uint32_t hit = rays.hit[i];
    if (truth.crossing) {
        ++share.hits;
        if ((hit & hit_doubtful) != 0) ++share.doubtful;
    }
    if (rays.first[i] == no_shape) {
        ++share.elsewhere;
        if ((hit & hit_doubtful) != 0) ++share.doubtful_elsewhere;
    }
    if ((hit & hit_doubtful) != 0) return;
    CAPTURE(i, rays.slot[i], rays.origins[i], rays.first[i] != no_shape, rays.t[i], rays.error[i],
            hit);
    if (hit == hit_none) {
        if (truth.crossing) FAIL("certain of a miss, but the ray hits");
        return;
    }
    if (!truth.crossing) FAIL("certain of a hit, but the ray misses");
    CAPTURE(truth.crossing->t, truth.crossing->error, int{truth.crossing->face},
            truth.crossing->entering);
    if ((hit & hit_face) != truth.crossing->face) FAIL("another face");
    if (((hit & hit_entering) != 0) != truth.crossing->entering) FAIL("the other side");
    if (!(std::abs(rays.t[i] - truth.crossing->t) <= rays.error[i] + truth.crossing->error))
        FAIL("t is further off than it says");
    if (!(rays.error[i] <= 0x1p-27 * rays.t[i])) FAIL("t is not accurate enough");
    if ((hit & hit_normal_unknown) != 0) return;
    const Vec3d normal(rays.nx[i], rays.ny[i], rays.nz[i]);
    const Vec3d shading(rays.sx[i], rays.sy[i], rays.sz[i]);
    CAPTURE(normal.x, normal.y, normal.z, truth.normal.x, truth.normal.y, truth.normal.z);
    if (!(std::abs(length(normal) - 1.0) < 1e-7)) FAIL("no unit normal");
    // Near an apex, a small error of the point is a large error of the normal.
    const double tolerance = adverse ? 1e-2 : 1e-6;
    if (adverse && !truth.has_normal) return;
    if (!(length(normal - truth.normal) < tolerance)) FAIL("another normal");
    if (!(length(shading - truth.shading_normal) < tolerance)) FAIL("another shading normal");
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b, std::size_t i) {
    return std::bit_cast<std::uint64_t>(a[i]) == std::bit_cast<std::uint64_t>(b[i]);
}

/// Solves the rays on every available instruction set.
void check_all(Rays& rays, const Tables& tables, bool adverse, Random& random, Share& share,
               Way way = Way::once) {
    const SceneView scene = view_of(tables);
    std::optional<Rays> before;
    for (const Isa isa : available_isas()) {
        CAPTURE(std::string(name_of(isa)));
        const SolveKernels kernels = solve_kernels_of(isa);
        const Found found = rays.view(random);
        kernels.solve(scene, found);
        if (way == Way::again) kernels.refine.refine(scene, found);
        for (std::size_t i = 0; i < rays.hit.size(); ++i) {
            if (i >= rays.rays.size() || rays.slot[i] == no_slot) {
                if (!rays.untouched(i)) FAIL("wrote to a lane without a shape");
                continue;
            }
            Share ignored;
            check(rays, i, adverse, before ? ignored : share);
            if (!before) continue;
            CAPTURE(i);
            if (rays.hit[i] != before->hit[i]) FAIL("another hit than on another instruction set");
            if (rays.hit[i] >= hit_doubtful) continue;
            if (!same_bits(rays.t, before->t, i) || !same_bits(rays.error, before->error, i) ||
                !same_bits(rays.nx, before->nx, i) || !same_bits(rays.ny, before->ny, i) ||
                !same_bits(rays.nz, before->nz, i) || !same_bits(rays.sx, before->sx, i) ||
                !same_bits(rays.sy, before->sy, i) || !same_bits(rays.sz, before->sz, i))
                FAIL("other bits than on another instruction set");
        }
        if (!before) before = rays;
    }
}

} // namespace

TEMPLATE_TEST_CASE("certain answers of solve are right", "", RAYLANE_ALL_SHAPES) {
    Random random(21);
    Share share;
    for (int round = 0; round < rounds(); ++round) {
        Tables tables;
        const bool lattice = round % 4 == 0;
        add_shapes<TestType>(tables, lattice, random.integer(1, 40), random);
        Rays rays;
        add_rays<TestType>(rays, tables, lattice, true, 16 * 16 + 5, random);
        check_all(rays, tables, true, random, share);
    }
    std::printf("hard rays, %s: %.3g of %ld hits doubtful\n",
                std::string(name_of(core::kind_of<TestType>)).c_str(),
                static_cast<double>(share.doubtful) / static_cast<double>(share.hits), share.hits);
    CHECK(share.hits > rounds() * 25);
    CHECK(share.doubtful * 2 < share.hits);
}

TEMPLATE_TEST_CASE("answers of refine are right and hardly ever doubtful", "", RAYLANE_ALL_SHAPES) {
    Random random(24);
    Share hard, lattice;
    for (int round = 0; round < rounds(); ++round) {
        Tables tables;
        const bool exact = round % 4 == 0;
        add_shapes<TestType>(tables, exact, random.integer(1, 40), random);
        Rays rays;
        add_rays<TestType>(rays, tables, exact, true, 16 * 16 + 5, random);
        check_all(rays, tables, true, random, exact ? lattice : hard, Way::again);
    }
    const double part =
        static_cast<double>(hard.doubtful_elsewhere) / static_cast<double>(hard.elsewhere);
    std::printf("hard rays, %s: %.3g of %ld doubtful in the end\n",
                std::string(name_of(core::kind_of<TestType>)).c_str(), part, hard.elsewhere);
    CHECK(hard.elsewhere > rounds() * 25);
    // The rest meet edges and rims exactly.
    CHECK(part < 0.04);
}

TEMPLATE_TEST_CASE("solve is certain of ordinary rays", "", RAYLANE_ALL_SHAPES) {
    Random random(22);
    Share share;
    for (int round = 0; round < rounds(); ++round) {
        Tables tables;
        add_shapes<TestType>(tables, false, 8, random);
        Rays rays;
        add_rays<TestType>(rays, tables, false, false, 1024, random);
        check_all(rays, tables, false, random, share);
    }
    const double part = static_cast<double>(share.doubtful) / static_cast<double>(share.hits);
    std::printf("ordinary rays, %s: %.3g of %ld hits doubtful\n",
                std::string(name_of(core::kind_of<TestType>)).c_str(), part, share.hits);
    // Some of the cones are a thousand times as wide as they are long.
    CHECK(static_cast<double>(share.doubtful) <=
          tests::max_by_chance(2e-4 * static_cast<double>(share.hits)));
}

TEST_CASE("solve sorts out packets of many kinds and leaves lanes without a shape alone") {
    Random random(23);
    Share share;
    for (int round = 0; round < rounds() / 5 + 4; ++round) { // a single round may have no hit
        Tables tables;
        Rays by_kind;
        for_each_table(tables, [&]<class Shape>(Table<Shape>&) {
            add_shapes<Shape>(tables, false, random.integer(1, 40), random);
        });
        for_each_table(tables, [&]<class Shape>(Table<Shape>&) {
            add_rays<Shape>(by_kind, tables, false, true, 21, random);
        });
        Rays rays;
        for (int i = random.integer(1, 200); i > 0; --i) {
            const std::size_t from = static_cast<std::size_t>(
                random.integer(0, static_cast<int>(by_kind.rays.size()) - 1));
            const Start start = {by_kind.first[from] != no_shape,
                                 static_cast<Face>(by_kind.origins[from] & origin_face),
                                 (by_kind.origins[from] & origin_inward) != 0};
            const bool idle = random.integer(0, 5) == 0;
            rays.add(by_kind.rays[from], idle ? no_slot : by_kind.slot[from], by_kind.first[from],
                     start, by_kind.truth[from]);
        }
        check_all(rays, tables, true, random, share);
    }
    CHECK(share.hits > 0);
}
