#include "core/validate.hpp"
#include "raylane/raylane.hpp"
#include "tests/catch.hpp"
#include "tests/meetings/meeting.hpp"
#include "tests/oracle/truth.hpp"
#include "tests/scenes/library/ray_arrays.hpp"
#include "tests/simd/rounds.hpp"

#include <cstdio>

/// Shapes that meet, asked of the library, against the oracle.
using namespace raylane;
using namespace raylane::tests;
using meetings::Meeting;
using meetings::Way;

namespace {

struct Tally {
    long rays = 0, hits = 0, wrong = 0, off = 0, occlusions = 0, normals = 0;
};

MaterialIndex add_all(SceneBuilder& builder, const std::vector<AnyShape>& shapes) {
    const MaterialIndex material = builder.add_material({});
    const auto add = [&]<class Library>(const auto& shape, std::type_identity<Library>) {
        builder.add(std::bit_cast<Library>(shape), material);
    };
    for (const AnyShape& any : shapes)
        std::visit(
            [&]<class Shape>(const Shape& shape) {
                if constexpr (std::is_same_v<Shape, core::Sphere>)
                    add(shape, std::type_identity<Sphere>());
                else if constexpr (std::is_same_v<Shape, core::Plane>)
                    add(shape, std::type_identity<Plane>());
                else if constexpr (std::is_same_v<Shape, core::Disc>)
                    add(shape, std::type_identity<Disc>());
                else if constexpr (std::is_same_v<Shape, core::Triangle>)
                    add(shape, std::type_identity<Triangle>());
                else if constexpr (std::is_same_v<Shape, core::SmoothTriangle>)
                    add(shape, std::type_identity<SmoothTriangle>());
                else if constexpr (std::is_same_v<Shape, core::Box>)
                    add(shape, std::type_identity<Box>());
                else if constexpr (std::is_same_v<Shape, core::OpenCylinder>)
                    add(shape, std::type_identity<OpenCylinder>());
                else if constexpr (std::is_same_v<Shape, core::CappedCylinder>)
                    add(shape, std::type_identity<CappedCylinder>());
                else if constexpr (std::is_same_v<Shape, core::OpenCone>)
                    add(shape, std::type_identity<OpenCone>());
                else if constexpr (std::is_same_v<Shape, core::CappedCone>)
                    add(shape, std::type_identity<CappedCone>());
                else
                    add(shape, std::type_identity<Quadric>());
            },
            any);
    return material;
}

bool is_valid(const AnyShape& any) {
    try {
        std::visit([](const auto& shape) { core::validate(shape); }, any);
        return true;
    } catch (const core::InvalidValue&) {
        return false;
    }
}

void check(const Meeting& meeting, Tally& tally, meetings::Random& random, bool limits) {
    for (const AnyShape& shape : meeting.shapes)
        if (!is_valid(shape)) return;
    SceneBuilder builder;
    add_all(builder, meeting.shapes);
    const Tracer tracer(builder.build(), {.threads = 1});
    Rays rays;
    std::vector<std::vector<oracle::Found>> truths;
    for (const core::Ray<float>& ray : meeting.rays) {
        rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                 {ray.direction.x, ray.direction.y, ray.direction.z});
        truths.push_back(oracle::all_ahead(meeting.shapes, rays.ray(rays.size() - 1)));
        if (!limits) continue;
        const auto limit = [&](float otherwise) {
            if (truths.back().empty() || random.integer(0, 2) == 0) return otherwise;
            const auto which = static_cast<std::size_t>(
                random.integer(0, static_cast<int>(truths.back().size()) - 1));
            return meetings::ulps_off(oracle::rounded(truths.back()[which].hit.root),
                                      random.integer(-1, 1));
        };
        rays.t_min.push_back(limit(0.0F));
        rays.t_max.push_back(limit(infinity));
    }
    const Hits hits = intersect(tracer, rays);
    const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const oracle::Found* const truth =
            limits ? oracle::nearest(truths[i], rays.t_min[i], rays.t_max[i])
                   : oracle::nearest(truths[i]);
        ++tally.rays;
        tally.occlusions += blocked[i] != (truth != nullptr ? 1 : 0);
        if (truth == nullptr) {
            tally.wrong += hits.is_none(i) ? 0 : 1;
            continue;
        }
        ++tally.hits;
        if (hits.shape[i] != truth->shape) {
            ++tally.wrong;
            continue;
        }
        tally.off += hits.t[i] != oracle::rounded(truth->hit.root) ? 1 : 0;
        const oracle::Direction normal =
            oracle::normal(meeting.shapes[truth->shape], rays.ray(i), truth->hit);
        const float n[] = {hits.nx[i], hits.ny[i], hits.nz[i]};
        bool good = true;
        for (int axis = 0; axis < 3; ++axis) {
            const auto right = static_cast<float>(normal[axis]);
            good = good && (n[axis] == right || std::nextafter(n[axis], right) == right);
        }
        tally.normals += good ? 0 : 1;
    }
}

} // namespace

TEST_CASE("shapes that meet are hit in the order of real arithmetic") {
    meetings::Random random(20261122);
    constexpr int kinds = core::kind_count;
    for (const bool limits : {false, true})
        for (const Way way : meetings::all_ways) {
            Tally tally;
            for (int round = 0; round < tests::rounds(4); ++round)
                for (int kind = 0; kind < kinds; ++kind)
                    for (int other = 0; other < kinds; ++other)
                        check(meetings::MeetingMaker(kind, other, way, random).make(25), tally,
                              random, limits);
            CAPTURE(limits, meetings::way_names[static_cast<int>(way)]);
            CAPTURE(tally.rays, tally.hits);
            std::printf(
                "%s%s: %ld rays, %ld hits: %ld wrong, %ld off, %ld occlusions, %ld normals\n",
                meetings::way_names[static_cast<int>(way)], limits ? ", limits" : "", tally.rays,
                tally.hits, tally.wrong, tally.off, tally.occlusions, tally.normals);
            CHECK(tally.wrong == 0);
            CHECK(tally.off == 0);
            CHECK(tally.occlusions == 0);
            CHECK(tally.normals == 0);
        }
}
