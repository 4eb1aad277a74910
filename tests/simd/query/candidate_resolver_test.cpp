#include "core/reference/tracer.hpp"
#include "simd/isa/isa.hpp"
#include "simd/query/as_core.hpp"
#include "simd/query/transparency_walk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

#include <bit>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;

/// Compares the engine's hits with the certified scalar search, for rays that float bounds cannot
/// decide.

namespace {

constexpr std::size_t ray_count = 331; // the last packet is not full

int rounds() {
    return tests::rounds(70, 20, 200);
}

/// Rays and their memory.
struct Stream {
    Paths paths{};

    explicit Stream(std::size_t count) {
        arena_ = arena_for([&](Arena& a) { paths.take_from(a, count, false); });
        paths.count = count;
        paths.start_nowhere(0, count);
    }

  private:
    Arena arena_;
};

/// Finds the hits of a stream's rays.
struct Finding {
    TransparencyWalk finder;
    EngineCounters counters;

    Finding(const SceneData& data, const Kernels& kernels, const Paths& paths)
        : finder(data, {&kernels, Precision::exact}) {
        arena_ = arena_for([&](Arena& a) { finder.take_from(a, paths.count); });
        finder.nearest(paths, nullptr, counters);
    }

  private:
    Arena arena_;
};

/// Shapes of all kinds, `of_each` of each, and hard rays at them. About half of the rays that hit
/// go on from there.
class Round {
  public:
    Round(int of_each, Random& random)
        : scene_(make(of_each, random)), data_(scene_), stream_(ray_count),
          reference_(scene_, scene_.settings(), Search::every_shape) {
        for (std::size_t lane = 0; lane < ray_count; ++lane)
            add(lane, random);
    }

    const SceneData& data() const { return data_; }
    const Paths& paths() const { return stream_.paths; }
    const Encounter<double>& truth(std::size_t lane) const { return truths_[lane]; }

  private:
    static Scene make(int of_each, Random& random) {
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            for (int i = 0; i < of_each; ++i)
                builder.add(ray_sets::Target<Shape>::make(random, false), 0);
        });
        return std::move(builder).build();
    }

    Ray<double> aim(Random& random) {
        int left = random.integer(0, kind_count - 1);
        Ray<float> aimed{};
        for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            if (left-- != 0) return;
            const auto& blocks = std::get<Table<Shape>>(scene_.shapes()).blocks();
            std::size_t block = 0;
            int place = 0;
            do {
                const int last = static_cast<int>(blocks.size()) - 1;
                block = static_cast<std::size_t>(random.integer(0, last));
                place = random.integer(0, block_size - 1);
            } while (blocks[block].ids[place] == no_shape);
            aimed = ray_sets::make_ray(blocks[block].get(place), ray_sets::any_set(random), random);
        });
        return {convert<double>(aimed.origin), normalized(convert<double>(aimed.direction))};
    }

    void add(std::size_t lane, Random& random) {
        const Paths& paths = stream_.paths;
        Ray<double> ray = aim(random);
        const Encounter<double> expected = reference_.nearest(ray, {});
        if (expected.hit.any() && random.integer(0, 1) == 0) {
            ray = {mul_add(expected.hit.t, ray.direction, ray.origin), random.direction()};
            const std::uint32_t slot = data_.slot_of(expected.hit.kind, expected.hit.place);
            const bool inward = dot(ray.direction, expected.contacts.begin()->normal) < 0.0;
            const std::uint32_t bits = expected.hit.face | (inward ? hit_entering : 0);
            paths.start_on(lane, slot, data_.record_of(slot), bits, /*through=*/true);
        }
        for (int axis = 0; axis < 3; ++axis) {
            paths.origin[axis][lane] = ray.origin[axis];
            paths.direction[axis][lane] = ray.direction[axis];
        }
        truths_.push_back(reference_.nearest(ray, origin_surfaces_of(data_, paths, lane)));
    }

    Scene scene_;
    SceneData data_;
    Stream stream_;
    ReferenceTracer<double> reference_;
    std::vector<Encounter<double>> truths_;
};

bool at_contacts(const TransparencyWalk& finder, std::size_t lane) {
    for (const std::uint32_t each : finder.at_contacts())
        if (each == lane) return true;
    return false;
}

void check_truth(const Round& round, const TransparencyWalk& finder) {
    for (std::size_t lane = 0; lane < ray_count; ++lane) {
        const Hit<double>& truth = round.truth(lane).hit;
        CAPTURE(lane, truth.any(), truth.t, round.paths().origin_slot[lane]);
        if (at_contacts(finder, lane)) continue;
        const Hits& hits = finder.hits();
        if (!truth.any()) {
            if (hits.slot[lane] != no_slot) FAIL("a hit for a miss");
            continue;
        }
        if (hits.slot[lane] != round.data().slot_of(truth.kind, truth.place)) FAIL("another shape");
        CAPTURE(hits.t[lane], hits.error[lane], hits.hit[lane]);
        if (((hits.hit[lane] & hit_entering) != 0) != truth.entering) FAIL("the other side");
        if (!(std::abs(hits.t[lane] - truth.t) <= 0x1p-25 * truth.t)) FAIL("another t");
    }
}

/// Compares lane `a` of one with lane `b` of the other.
void check_same_bits(const TransparencyWalk& one, std::size_t a, const TransparencyWalk& other,
                     std::size_t b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    const Hits &x = one.hits(), &y = other.hits();
    CAPTURE(a);
    if (at_contacts(one, a) != at_contacts(other, b)) FAIL("at contacts or not");
    if (at_contacts(one, a)) return;
    if (x.slot[a] != y.slot[b]) FAIL("another shape");
    if (x.slot[a] == no_slot) return;
    if (x.hit[a] != y.hit[b] || !same(x.t[a], y.t[b]) || !same(x.normal[0][a], y.normal[0][b]) ||
        !same(x.normal[1][a], y.normal[1][b]) || !same(x.normal[2][a], y.normal[2][b]))
        FAIL("other bits");
}

/// Checks the ray of one lane by itself.
void check_alone(Round& round, const Kernels& kernels, const TransparencyWalk& together,
                 std::size_t lane) {
    const Stream alone(1);
    alone.paths.copy_ray(round.paths(), lane, 0);
    const Finding finding(round.data(), kernels, alone.paths);
    check_same_bits(together, lane, finding.finder, 0);
}

void check_rounds(int of_each, int count) {
    Random random(static_cast<std::uint64_t>(of_each));
    EngineCounters counters;
    for (int i = 0; i < count; ++i) {
        Round round(of_each, random);
        std::optional<Finding> first;
        for (const Isa isa : available_isas()) {
            const Kernels& kernels = kernels_of(isa);
            CAPTURE(i, std::string(kernels.name));
            if (first) {
                const Finding next(round.data(), kernels, round.paths());
                for (std::size_t lane = 0; lane < ray_count; ++lane)
                    check_same_bits(first->finder, lane, next.finder, lane);
                continue;
            }
            first.emplace(round.data(), kernels, round.paths());
            check_truth(round, first->finder);
            counters += first->counters;
            check_alone(round, kernels, first->finder,
                        static_cast<std::size_t>(random.integer(0, ray_count - 1)));
        }
    }
    const auto rays = static_cast<std::uint64_t>(count) * ray_count;
    CAPTURE(counters.refined, counters.doubtful, rays);
    CHECK(counters.refined * 20 > rays);
    CHECK(static_cast<double>(counters.doubtful) <
          tests::max_by_chance(static_cast<double>(rays) / 400.0));
}

} // namespace

TEST_CASE("hard rays at few shapes have the reference's hits") {
    check_rounds(1, rounds());
}

TEST_CASE("hard rays at many shapes have the reference's hits") {
    check_rounds(20, (rounds() + 1) / 2);
}
