#include "core/optics/optics.hpp"
#include "simd/isa/isa.hpp"
#include "simd/query/as_core.hpp"
#include "simd/wavefront/shadow_tracer.hpp"
#include "tests/simd/wavefront/spawn_tally.hpp"
#include "tests/simd/wavefront/spawn_truth.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <sstream>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using namespace raylane::tests;

/// Rays that leave a surface in the vector engine. They do not meet that surface again unless it
/// curves back, and never miss the next surface, however close.

namespace {

int rounds() {
    return tests::rounds(70, 5, 200);
}

constexpr std::size_t rays_per_nest = 512;
constexpr int oracle_share = 16; // the oracle checks one in so many rays

ShapeId add_to(SceneBuilder& builder, const AnyShape& any) {
    return std::visit([&](const auto& shape) { return builder.add(shape, 0); }, any);
}

Scene scene_of(const std::vector<AnyShape>& shapes) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    for (const AnyShape& shape : shapes)
        add_to(builder, shape);
    return std::move(builder).build();
}

/// Spawns rays from a shape and checks them.
class Spawning {
  public:
    Spawning(const CloseShells& nest, const tests::Place& place, const Kernels& kernels,
             Random& random, Tally& tally)
        : random_(random), tally_(tally), nest_(nest), place_(place),
          placing_(place.offset, place.factor), shapes_{placing_(nest.shape), placing_(nest.outer),
                                                        placing_(nest.inner)},
          truth_(nest, place, shapes_), kind_(tests::kind_of(nest.shape)),
          alone_(scene_of({shapes_[0]})), alone_data_(alone_) {
        if (random.integer(0, 1) == 0)
            for (const AnyShape& sphere : far_spheres(place, random))
                shapes_.push_back(sphere);
        scene_.emplace(scene_of(shapes_));
        data_.emplace(*scene_);
        kernels_ = &kernels;
    }

    void check() {
        ReferenceTracer<double> reference(*scene_, {});
        TransparencyWalk first(alone_data_, {kernels_});
        TransparencyWalk empty_space(alone_data_, {kernels_});
        TransparencyWalk next(*data_, {kernels_});
        ShadowTracer shadows(*data_, {kernels_}, reference, true);
        const Arena arena = arena_for([&](Arena& a) {
            first.take_from(a, rays_per_nest);
            empty_space.take_from(a, 2 * rays_per_nest);
            next.take_from(a, 2 * rays_per_nest);
            shadows.take_from(a, rays_per_nest, false);
            paths_.take_from(a, rays_per_nest, false);
            spawned_.take_from(a, 2 * rays_per_nest, false);
            slots_ = a.take<std::uint32_t>(rays_per_nest);
            order_ = a.take<std::uint32_t>(rays_per_nest);
        });
        hit(first);
        spawn();
        find(next, reference);
        for (int light = 0; light < 2; ++light)
            look_at_light(shadows);
        leave_alone(empty_space);
    }

  private:
    /// Finds the engine's hits of rays on the shape.
    void hit(TransparencyWalk& finder) {
        paths_.count = rays_per_nest;
        for (std::size_t i = 0; i < paths_.count; ++i) {
            const Ray<double> ray = ray_to(nest_, place_, random_);
            for (int axis = 0; axis < 3; ++axis) {
                paths_.origin[axis][i] = ray.origin[axis];
                paths_.direction[axis][i] = ray.direction[axis];
            }
        }
        paths_.start_nowhere(0, paths_.count);
        EngineCounters counters;
        finder.nearest(paths_, nullptr, counters);
        REQUIRE(finder.at_contacts().empty());
        hits_ = finder.hits();
        hit_count_ = 0;
        for (std::size_t i = 0; i < paths_.count; ++i)
            if (hits_.slot[i] != no_slot) order_[hit_count_++] = static_cast<std::uint32_t>(i);
        const std::uint32_t slot = slot_of_shape();
        std::fill_n(slots_, paths_.count, slot);
        hits_.slot = slots_;
    }

    std::uint32_t slot_of_shape() const {
        const TableView& table = data_->view().tables[static_cast<int>(kind_)];
        std::uint32_t slot = table.first_slot;
        while (data_->id_of(slot) != shape_id)
            ++slot;
        return slot;
    }

    /// The surface at a hit, as core::ReferenceTracer::surface_at has it.
    struct Surface {
        Ray<double> ray;
        Vec3d point, flat, normal;
        bool entering;
    };
    Surface surface_at(std::uint32_t lane) const {
        const Ray<double> ray = ray_of(paths_, lane);
        const bool entering = (hits_.hit[lane] & hit_entering) != 0;
        const auto get = [&](const auto& columns) {
            const Vec3d v(columns[0][lane], columns[1][lane], columns[2][lane]);
            return entering ? v : -v;
        };
        Vec3d flat = get(hits_.normal);
        Vec3d normal = hits_.shading_normal[0] != nullptr ? get(hits_.shading_normal) : flat;
        if (dot(normal, flat) < 0.0) normal = -normal;
        if (dot(flat, ray.direction) > 0x1p-20) normal = flat = -ray.direction;
        return {ray, mul_add(hits_.t[lane], ray.direction, ray.origin), flat, normal, entering};
    }

    void add_spawned(std::uint32_t lane, const Surface& surface, const Vec3d& direction,
                     bool through) {
        const std::size_t to = spawned_.count++;
        for (int axis = 0; axis < 3; ++axis) {
            spawned_.origin[axis][to] = surface.point[axis];
            spawned_.direction[axis][to] = direction[axis];
        }
        spawned_.sample[to] = through ? refracted_ray : reflected_ray;
        const std::uint32_t slot = slots_[lane];
        spawned_.start_on(to, slot, data_->record_of(slot), hits_.hit[lane], through);
    }

    void spawn() {
        constexpr double indices[][2] = {{1.0, 1.5}, {1.5, 1.0}, {1.0, 1.0001}, {1.0, 4.0}};
        spawned_.count = 0;
        for (std::size_t k = 0; k < hit_count_; ++k) {
            const Surface surface = surface_at(order_[k]);
            Vec3d away = reflected(surface.ray.direction, surface.normal);
            if (dot(away, surface.flat) <= 0.0)
                away = reflected(surface.ray.direction, surface.flat);
            add_spawned(order_[k], surface, normalized(away), false);

            const auto [before, behind] = indices[random_.integer(0, 3)];
            auto refraction = refract(surface.ray.direction, surface.normal, before, behind);
            if (!refraction.total && dot(refraction.transmitted, surface.flat) >= 0.0)
                refraction = refract(surface.ray.direction, surface.flat, before, behind);
            if (!refraction.total)
                add_spawned(order_[k], surface, normalized(refraction.transmitted), true);
        }
    }

    void find(TransparencyWalk& finder, ReferenceTracer<double>& reference) {
        EngineCounters counters;
        finder.nearest(spawned_, nullptr, counters);
        tally_.doubtful += static_cast<long>(counters.doubtful);
        std::vector<Next> found(spawned_.count);
        const Hits& hits = finder.hits();
        for (std::size_t i = 0; i < spawned_.count; ++i)
            if (hits.slot[i] != no_slot)
                found[i] = {data_->id_of(hits.slot[i]), hits.t[i],
                            (hits.hit[i] & hit_entering) != 0};
        for (const std::uint32_t i : finder.at_contacts()) {
            ++tally_.followed;
            const Hit<double> hit =
                reference.nearest(ray_of(spawned_, i), origin_surfaces_of(*data_, spawned_, i)).hit;
            found[i] = {hit.shape, hit.t, hit.entering};
        }
        for (std::size_t i = 0; i < spawned_.count; ++i) {
            const bool inward = (spawned_.origin_bits[i] & origin_inward) != 0;
            ++tally_.rays[inward ? 1 : 0][spawned_.sample[i]];
            compare(found[i], ray_of(spawned_, i), origin_surfaces_of(*data_, spawned_, i), inward);
        }
    }

    /// Compares the engine's answer with the certified search, the oracle and the construction.
    void compare(const Next& found, const Ray<double>& ray, const OriginSurfaces<double>& origins,
                 bool inward) {
        Searcher<double> searcher(*scene_, Search::every_shape);
        const Hit<double> certified =
            searcher.nearest(ray, origins, [](const Hit<double>&) { return true; }).hit;
        agree(found, {certified.shape, certified.t, certified.entering}, ray, inward,
              "the certified search");

        if (const std::optional<Next> next = truth_.by_construction(ray, inward)) {
            ++tally_.by_construction;
            agree(found, *next, ray, inward, "the construction");
        }
        if (random_.integer(1, oracle_share) == 1 && found.shape <= inner_id)
            if (const std::optional<Next> next = truth_.by_oracle(ray, inward)) {
                ++tally_.by_oracle;
                agree(found, *next, ray, inward, "the oracle");
            }
    }

    void agree(const Next& found, const Next& expected, const Ray<double>& ray, bool inward,
               const char* whose) {
        const bool same = found.shape == expected.shape &&
                          (found.shape == no_shape || found.entering == expected.entering);
        const double allowed = 0x1p-24 * expected.t + truth_.slack(ray);
        const bool near = std::isnan(expected.t) || found.t == expected.t ||
                          std::abs(found.t - expected.t) <= allowed;
        if (same && near) return;
        if (same) {
            ++tally_.other;
        } else if (found.shape == shape_id) {
            ++tally_.self_hits;
        } else if (expected.shape != shape_id && expected.shape != no_shape) {
            ++tally_.missed;
        } else {
            ++tally_.other;
        }
        tell(whose, ": shape ", static_cast<int>(expected.shape), " at ", expected.t,
             ", engine: ", static_cast<int>(found.shape), " at ", found.t,
             inward ? ", inward" : ", outward", ", size ",
             place_.size * static_cast<double>(place_.factor), ", slack ", truth_.slack(ray));
    }

    template <class... Parts>
    void tell(const Parts&... parts) {
        if (tally_.self_hits + tally_.missed + tally_.other > 3) return;
        std::ostringstream text;
        (text << ... << parts) << "\n";
        tally_.first_faults += text.str();
    }

    /// Returns a position in the gaps, next to them, or far away.
    Vec3f light_position() {
        const Surface near = surface_at(
            order_[static_cast<std::size_t>(random_.integer(0, static_cast<int>(hit_count_) - 1))]);
        const double size = place_.size * static_cast<double>(place_.factor);
        const double distance = size * random_.log_uniform(1e-7, random_.integer(0, 1) ? 1.0 : 1e3);
        return rounded(near.point + near.flat * distance);
    }

    /// Checks that in a scene of this shape alone, the engine knows without help that outward rays
    /// meet nothing.
    void leave_alone(TransparencyWalk& finder) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < spawned_.count; ++i) {
            if ((spawned_.origin_bits[i] & origin_inward) != 0) continue;
            spawned_.copy(spawned_, i, kept);
            spawned_.origin_slot[kept++] =
                alone_data_.view().tables[static_cast<int>(kind_)].first_slot;
        }
        spawned_.count = kept;
        EngineCounters counters;
        finder.nearest(spawned_, nullptr, counters);
        tally_.into_the_open += static_cast<long>(kept);
        tally_.doubtful_in_the_open += static_cast<long>(counters.doubtful);
        if (may_come_back(nest_.shape)) return;
        for (std::size_t i = 0; i < kept; ++i)
            if (finder.hits().slot[i] != no_slot && ++tally_.self_hits != 0)
                tell("alone: at ", finder.hits().t[i]);
    }

    void look_at_light(ShadowTracer& tracer) {
        if (hit_count_ == 0) return;
        LightView light{};
        light.is_point = random_.integer(0, 3) != 0;
        const Vec3d position = convert<double>(light_position()), sun = random_.direction();
        for (int axis = 0; axis < 3; ++axis) {
            light.position[axis] = position[axis];
            light.to_light[axis] = sun[axis];
        }
        SpawnedRays& rays = tracer.rays();
        rays.count = 0;
        for (std::size_t k = 0; k < hit_count_; ++k) {
            const Surface surface = surface_at(order_[k]);
            const Vec3d offset = position - surface.point;
            const double distance =
                light.is_point ? length(offset) : std::numeric_limits<double>::infinity();
            const Vec3d direction = light.is_point ? offset / distance : sun;
            if (!(dot(surface.flat, direction) > 0.0)) continue;
            const std::size_t to = rays.count++;
            for (int axis = 0; axis < 3; ++axis) {
                rays.origin[axis][to] = surface.point[axis];
                rays.direction[axis][to] = direction[axis];
                rays.weight[axis][to] = 1.0;
            }
            rays.distance[to] = distance;
            rays.parent[to] = static_cast<double>(k);
        }
        EngineCounters counters;
        const bool coherent = random_.integer(0, 1) == 0;
        tracer.look_at({paths_, hits_, order_, hit_count_, coherent});
        tracer.trace(light, counters);
        tally_.followed += static_cast<long>(counters.followed);
        for (std::size_t k = 0; k < rays.count; ++k)
            check_shadow(tracer, k);
    }

    void check_shadow(ShadowTracer& tracer, std::size_t k) {
        const SpawnedRays& rays = tracer.rays();
        const std::uint32_t lane = order_[static_cast<std::size_t>(rays.parent[k])];
        const bool inward = (hits_.hit[lane] & hit_entering) == 0;
        ++tally_.rays[inward ? 1 : 0][shadow_ray];
        const Ray<double> ray{{rays.origin[0][k], rays.origin[1][k], rays.origin[2][k]},
                              {rays.direction[0][k], rays.direction[1][k], rays.direction[2][k]}};
        spawned_.start_on(0, slots_[lane], data_->record_of(slots_[lane]), hits_.hit[lane],
                          /*through=*/false);
        const OriginSurfaces<double> origins = origin_surfaces_of(*data_, spawned_, 0);
        Searcher<double> searcher(*scene_, Search::every_shape);
        const Hit<double> certified =
            searcher.nearest(ray, origins, [](const Hit<double>&) { return true; }).hit;
        const double distance = rays.distance[k];
        const bool arrives = tracer.arrives(k);
        agree_on_shadow(arrives, {certified.shape, certified.t, certified.entering}, distance, ray,
                        "the certified search");
        if (const std::optional<Next> next = truth_.by_construction(ray, inward))
            if (next->shape != shape_id && std::isinf(distance)) {
                ++tally_.by_construction;
                if (arrives && ++tally_.missed != 0) tell("the construction: the light arrives");
            }
        if (random_.integer(1, oracle_share) == 1 && shapes_.size() == 3)
            if (const std::optional<Next> next = truth_.by_oracle(ray, inward)) {
                ++tally_.by_oracle;
                agree_on_shadow(arrives, *next, distance, ray, "the oracle");
            }
    }

    void agree_on_shadow(bool arrives, const Next& next, double distance, const Ray<double>& ray,
                         const char* whose) {
        // The oracle has no t for a second crossing with the shape that the ray leaves.
        if (std::isnan(next.t) || std::abs(next.t - distance) <= 0x1p-26 * distance) return;
        if (arrives == !(next.t < distance)) return;
        ++(arrives ? tally_.missed : tally_.self_hits);
        tell(whose, ": shape ", static_cast<int>(next.shape), " at ", next.t, ", light at ",
             distance, arrives ? ", which arrives" : ", which does not arrive", ", slack ",
             truth_.slack(ray));
    }

    Random& random_;
    Tally& tally_;
    const CloseShells& nest_;
    const tests::Place& place_;
    Placing placing_;
    std::vector<AnyShape> shapes_; // by id
    SpawnTruth truth_;
    Kind kind_;
    Scene alone_;
    SceneData alone_data_;
    std::optional<Scene> scene_;
    std::optional<SceneData> data_;
    const Kernels* kernels_;

    Paths paths_{}, spawned_{};
    Hits hits_{}; // `slot` in the scene of all shapes
    std::uint32_t* slots_ = nullptr;
    std::uint32_t* order_ = nullptr; // the lanes that have hit the shape
    std::size_t hit_count_ = 0;
};

} // namespace

TEMPLATE_TEST_CASE("spawned rays meet the next surface and not the one that they leave", "[long]",
                   RAYLANE_ALL_SHAPES) {
    constexpr Kind kind = core::kind_of<TestType>;
    const auto isas = available_isas();
    Random random(20261100 + static_cast<int>(kind));
    Tally tally;
    for (int round = 0; round < rounds(); ++round) {
        const tests::Place place(random);
        const CloseShells nest = NestOf<TestType>::make(place.size, random);
        const Kernels& kernels = kernels_of(isas[static_cast<std::size_t>(round) % isas.size()]);
        Spawning(nest, place, kernels, random, tally).check();
    }
    print(kind, tally);
    CAPTURE(tally.first_faults);
    CHECK(tally.self_hits == 0);
    CHECK(tally.missed == 0);
    CHECK(tally.other == 0);
    CHECK(tally.doubtful_in_the_open * 200 <= tally.into_the_open);
    if (rounds() < 50) return;
    CHECK(tally.all() > 100L * rounds());
    for (const auto& side : tally.rays)
        for (const long count : side)
            CHECK(count > tally.all() / 100);
}
