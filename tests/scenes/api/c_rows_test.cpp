#include "tests/scenes/api/c_rows.hpp"

#include <cmath>

/// Tests of rows of the C interface: crossings, solids around points and lengths inside of
/// materials, against the C++ library.
using namespace raylane;
using namespace raylane::tests;

namespace {

struct BothScenes {
    SceneHandle in_c;
    Scene in_cpp;
};

/// Returns two balls of different materials that overlap.
BothScenes overlapping_balls() {
    const Builder in_c = builder_in_c();
    SceneBuilder builder;
    const raylane_material plain = raylane_default_material();
    std::uint32_t material = 0;
    for (const raylane_double_sphere& ball :
         {raylane_double_sphere{{0.1, 0, 0}, 1.1}, raylane_double_sphere{{0.9, 0.3, 0}, 0.7}}) {
        REQUIRE(raylane_add_material(in_c.get(), &plain, &material) == RAYLANE_OK);
        REQUIRE(raylane_add_spheres_doubles(in_c.get(), &ball, 1, material, nullptr) == RAYLANE_OK);
        builder.add(std::bit_cast<SphereOf<double>>(ball), builder.add_material({}));
    }
    return {built(in_c), builder.build()};
}

RowsHandle crossings_in_c(const TracerHandle& tracer, const raylane_rays& rays, std::size_t most,
                          bool normals) {
    return made<RowsHandle>([&](raylane_rows** to) {
        return raylane_crossings(tracer.get(), &rays, most, normals ? 1 : 0, to);
    });
}

raylane_rays to_c(const Rays& rays, std::uint64_t& refused) {
    return {rays.size(),    rays.x.data(),  rays.y.data(),     rays.z.data(), rays.dx.data(),
            rays.dy.data(), rays.dz.data(), rays.t_min.data(), nullptr,       nullptr,
            nullptr,        nullptr,        &refused};
}

} // namespace

TEST_CASE("rows of float rays and points in C are those of C++") {
    const BothScenes scenes = overlapping_balls();
    const TracerHandle asked = tracer_of(scenes.in_c);
    const Tracer tracer(scenes.in_cpp);
    Random random(21);
    Rays rays;
    std::vector<float> x, y, z;
    for (int i = 0; i < 300; ++i) {
        const core::Vec3f from = core::convert<float>(random.cube(2.0));
        const core::Vec3f along = core::convert<float>(random.direction());
        rays.add({from.x, from.y, from.z}, {along.x, along.y, along.z});
        rays.t_min.push_back(i % 3 == 0 ? 1.0F : 0.0F);
    }
    rays.dx[7] = not_a_number;
    std::uint64_t refused = 77;
    const raylane_rays in_c = to_c(rays, refused);
    CrossingRows crossings;
    for (const std::size_t most : {0, 1, 2})
        for (const bool normals : {false, true}) {
            tracer.crossings(rays.span(), crossings, {most, normals});
            check_same(crossings_in_c(asked, in_c, most, normals), crossings);
            CHECK(refused == 1);
            refused = 77;
        }
    CHECK(crossings.t.size() > 50);
    LengthRows lengths;
    tracer.path_lengths(rays.span(), lengths);
    check_same(made<RowsHandle>(
                   [&](raylane_rows** to) { return raylane_path_lengths(asked.get(), &in_c, to); }),
               lengths);
    CHECK(refused == 1);
    CHECK(std::count(lengths.material.begin(), lengths.material.end(), 1) > 10);

    const raylane_points points = {rays.size(), rays.x.data(), rays.y.data(), rays.z.data(),
                                   nullptr};
    SolidRows solids;
    tracer.contains(PointSpan{rays.x, rays.y, rays.z}, solids);
    check_same(made<RowsHandle>(
                   [&](raylane_rows** to) { return raylane_contains(asked.get(), &points, to); }),
               solids);
    CHECK(std::count(solids.shape_id.begin(), solids.shape_id.end(), 1) > 0);
}

TEST_CASE("rows of double rays and points in C are those of C++") {
    const BothScenes scenes = overlapping_balls();
    const DoubleRays rays = rays_through_all(500, 22);
    check_crossings(scenes.in_c, scenes.in_cpp, rays);
    check_lengths(scenes.in_c, scenes.in_cpp, rays);

    Random random(23);
    std::vector<double> x, y, z;
    for (int i = 0; i < 300; ++i) {
        const core::Vec3d at = random.cube(2.0);
        x.push_back(at.x);
        y.push_back(at.y);
        z.push_back(at.z);
    }
    y[3] = std::nan("");
    std::uint64_t refused = 77;
    const raylane_double_points points = {x.size(), x.data(), y.data(), z.data(), &refused};
    const TracerHandle asked = tracer_of(scenes.in_c);
    SolidRows solids;
    Tracer(scenes.in_cpp).contains(DoublePointSpan{x, y, z}, solids);
    check_same(made<RowsHandle>([&](raylane_rows** to) {
                   return raylane_contains_doubles(asked.get(), &points, to);
               }),
               solids);
    CHECK(refused == 1);
}

TEST_CASE("rows in C tell of mistakes and take NULL") {
    const auto says = [](raylane_status status, const std::string& text) {
        CHECK(status == RAYLANE_INVALID_VALUE);
        CHECK(raylane_error_text() == text);
    };
    const TracerHandle asked = tracer_of(overlapping_balls().in_c);
    const raylane_rays no_rays{};
    const raylane_points no_points{};
    raylane_rows* rows = nullptr;
    says(raylane_crossings(asked.get(), nullptr, 0, 0, &rows), "rays: must not be NULL");
    says(raylane_crossings(asked.get(), &no_rays, 0, 0, nullptr), "rows: must not be NULL");
    says(raylane_crossings(nullptr, &no_rays, 0, 0, &rows), "tracer: must not be NULL");
    says(raylane_contains(asked.get(), nullptr, &rows), "points: must not be NULL");
    says(raylane_contains(nullptr, &no_points, &rows), "tracer: must not be NULL");
    says(raylane_path_lengths(asked.get(), nullptr, &rows), "rays: must not be NULL");
    raylane_points without_y{};
    without_y.count = 1;
    const float zero = 0.0F;
    without_y.x = without_y.z = &zero;
    says(raylane_contains(asked.get(), &without_y, &rows), "y: must not be NULL");
    CHECK(rows == nullptr);

    const RowsHandle empty = crossings_in_c(asked, no_rays, 0, true);
    CHECK(raylane_rows_count(empty.get()) == 0);
    REQUIRE(raylane_rows_first(empty.get()) != nullptr);
    CHECK(raylane_rows_first(empty.get())[0] == 0);
    CHECK(raylane_rows_t(empty.get()) == nullptr);

    CHECK(raylane_rows_count(nullptr) == 0);
    CHECK(raylane_rows_first(nullptr) == nullptr);
    CHECK(raylane_rows_t(nullptr) == nullptr);
    CHECK(raylane_rows_shape_id(nullptr) == nullptr);
    raylane_rows_release(nullptr);
}
