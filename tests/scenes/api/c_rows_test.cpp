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
                          int normals) {
    return made<RowsHandle>([&](raylane_rows** to) {
        return raylane_crossings(tracer.get(), &rays, most, normals, to);
    });
}

raylane_rays to_c(const Rays& rays, std::uint64_t& refused) {
    return {rays.size(),    rays.x.data(),  rays.y.data(),     rays.z.data(), rays.dx.data(),
            rays.dy.data(), rays.dz.data(), rays.t_min.data(), nullptr,       nullptr,
            nullptr,        nullptr,        &refused};
}

/// Checks the counts of a query for all crossings, with one refused ray.
void check_statistics(const Tracer& tracer, const Rays& rays,
                      const raylane_crossing_statistics& counts) {
    CrossingRows rows;
    CrossingStatistics statistics;
    tracer.crossings(rays.span(), rows, {}, &statistics);
    CHECK(statistics.by_bounds > 0);
    CHECK(counts.by_bounds == statistics.by_bounds);
    CHECK(counts.by_digits == statistics.by_digits);
    CHECK(counts.exactly == statistics.exactly);
    CHECK(counts.beyond_double == statistics.beyond_double);
    CHECK(counts.refused == 1);
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
        for (const int normals : {0, 1, 2, 3}) {
            tracer.crossings(rays.span(), crossings, {most, normals % 2 != 0, normals >= 2});
            check_same(crossings_in_c(asked, in_c, most, normals), crossings);
            CHECK(refused == 1);
            refused = 77;
        }
    CHECK(crossings.t.size() > 50);
    check_statistics(tracer, rays,
                     raylane_rows_statistics(crossings_in_c(asked, in_c, 0, 0).get()));
    LengthRows lengths;
    tracer.path_lengths(rays.span(), lengths);
    check_same(made<RowsHandle>(
                   [&](raylane_rows** to) { return raylane_path_lengths(asked.get(), &in_c, to); }),
               lengths);
    CHECK(refused == 1);
    CHECK(std::count(lengths.material.begin(), lengths.material.end(), 1) > 10);

    SolidLengthRows of_solids;
    tracer.solid_lengths(rays.span(), of_solids);
    refused = 77;
    const RowsHandle solid_lengths = made<RowsHandle>(
        [&](raylane_rows** to) { return raylane_solid_lengths(asked.get(), &in_c, to); });
    check_same(solid_lengths, of_solids);
    CHECK(refused == 1);
    CHECK(raylane_rows_statistics(solid_lengths.get()).refused == 1);
    CHECK(raylane_rows_statistics(solid_lengths.get()).by_bounds == 0);

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
    check_solid_lengths(scenes.in_c, scenes.in_cpp, rays);

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
    refused = 77;

    std::vector<ShapeId> cell(x.size(), 77), same_cell(x.size());
    std::vector<MaterialIndex> material(x.size(), 77), same_material(x.size());
    std::vector<std::uint8_t> on_surface(x.size(), 77), same_on(x.size());
    Tracer(scenes.in_cpp).cells(DoublePointSpan{x, y, z}, {same_cell, same_material, same_on});
    const raylane_cell_columns columns = {cell.data(), material.data(), on_surface.data()};
    REQUIRE(raylane_cells_doubles(asked.get(), &points, &columns) == RAYLANE_OK);
    CHECK(cell == same_cell);
    CHECK(material == same_material);
    CHECK(on_surface == same_on);
    CHECK(refused == 1);
    CHECK(std::count(cell.begin(), cell.end(), 1) > 0);
    const std::vector<float> nx(x.begin(), x.end()), ny(y.begin(), y.end()), nz(z.begin(), z.end());
    const raylane_points floats = {x.size(), nx.data(), ny.data(), nz.data(), nullptr};
    Tracer(scenes.in_cpp).cells(PointSpan{nx, ny, nz}, {.shape_id = same_cell});
    const raylane_cell_columns ids = {cell.data(), nullptr, nullptr};
    REQUIRE(raylane_cells(asked.get(), &floats, &ids) == RAYLANE_OK);
    CHECK(cell == same_cell);
}

TEST_CASE("rays that continue from hits in C are those of C++") {
    const BothScenes scenes = overlapping_balls();
    const TracerHandle asked = tracer_of(scenes.in_c);
    DoubleRays rays = rays_through_all(300, 24);
    const std::size_t n = rays.size();
    Hits found(n);
    std::vector<std::uint8_t> face(n);
    std::vector<double> t(n);
    HitSpan hits = found.span();
    hits.face = face;
    hits.t_double = t;
    Tracer(scenes.in_cpp).intersect(rays.span(), hits);
    std::vector<double> d[3];
    Random random(25);
    for (std::size_t i = 0; i < n; ++i)
        for (auto& column : d)
            column.push_back(random.uniform(-1.0, 1.0));
    const OnwardRays<double> truth = onward(rays.span(), hits, d[0], d[1], d[2]);

    std::uint64_t refused = 77;
    raylane_double_rays in_c = to_c(rays, refused);
    raylane_hits from_c{};
    from_c.t_double = t.data();
    from_c.normal_x = found.nx.data();
    from_c.normal_y = found.ny.data();
    from_c.normal_z = found.nz.data();
    from_c.shape_id = found.shape.data();
    from_c.face = face.data();
    std::vector<std::uint8_t> inward(n, 77);
    auto& [x, y, z] = rays.origin; // the new origins replace the old ones
    REQUIRE(raylane_onward_doubles(&in_c, &from_c, d[0].data(), d[1].data(), d[2].data(), x.data(),
                                   y.data(), z.data(), inward.data()) == RAYLANE_OK);
    CHECK(inward == truth.inward);
    for (std::size_t i = 0; i < n; ++i) {
        const bool any = found.shape[i] != no_shape;
        CHECK((any ? x[i] == truth.origin_x[i] && z[i] == truth.origin_z[i] : std::isnan(y[i])));
    }
    in_c.direction_x = d[0].data();
    in_c.direction_y = d[1].data();
    in_c.direction_z = d[2].data();
    in_c.t_max = nullptr;
    in_c.origin_shape = from_c.shape_id;
    in_c.origin_face = from_c.face;
    in_c.origin_inward = inward.data();
    std::vector<std::uint64_t> counts(n), same(n);
    CHECK(raylane_count_crossings_doubles(asked.get(), &in_c, counts.data()) == RAYLANE_OK);
    Tracer(scenes.in_cpp).count_crossings(truth.span(), same);
    CHECK(counts == same);
    CHECK(refused ==
          static_cast<std::uint64_t>(std::count(found.shape.begin(), found.shape.end(), no_shape)));
    CHECK(std::count(counts.begin(), counts.end(), 0) < static_cast<std::ptrdiff_t>(n - 20));

    CHECK(raylane_onward_doubles(&in_c, &from_c, d[0].data(), nullptr, d[2].data(), x.data(),
                                 y.data(), z.data(), inward.data()) == RAYLANE_INVALID_VALUE);
    CHECK(std::string(raylane_error_text()) == "direction_y: must not be NULL");
    from_c.face = nullptr;
    CHECK(raylane_onward_doubles(&in_c, &from_c, d[0].data(), d[1].data(), d[2].data(), x.data(),
                                 y.data(), z.data(), inward.data()) == RAYLANE_INVALID_VALUE);
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
    for (const int normals : {-1, 4})
        says(raylane_crossings(asked.get(), &no_rays, 0, normals, &rows),
             "normals: must be from 0 to 3, got " + std::to_string(normals));
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

    const RowsHandle empty = crossings_in_c(asked, no_rays, 0, RAYLANE_NORMALS);
    CHECK(raylane_rows_count(empty.get()) == 0);
    REQUIRE(raylane_rows_first(empty.get()) != nullptr);
    CHECK(raylane_rows_first(empty.get())[0] == 0);
    CHECK(raylane_rows_t(empty.get()) == nullptr);

    CHECK(raylane_rows_count(nullptr) == 0);
    CHECK(raylane_rows_statistics(nullptr).refused == 0);
    CHECK(raylane_rows_first(nullptr) == nullptr);
    CHECK(raylane_rows_t(nullptr) == nullptr);
    CHECK(raylane_rows_shape_id(nullptr) == nullptr);
    raylane_rows_release(nullptr);
}
