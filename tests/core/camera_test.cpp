#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <set>

using namespace little_scene;

namespace {

Settings settings_of(int width, int height, int grid,
                     SamplePattern samples = SamplePattern::regular) {
    Settings settings;
    settings.width = width;
    settings.height = height;
    settings.grid = grid;
    settings.samples = samples;
    return settings;
}

} // namespace

TEST_CASE("a perspective camera's field of view spans the image's height") {
    const Camera camera{.from = {0, 0, 0}, .at = {0, 0, -7}, .field_of_view = 90.0F};
    // One pixel: its four sub-pixels are halfway out, where the edges are at slope 1.
    const CameraRays<double> rays(camera, settings_of(1, 1, 2));
    const double slopes[4][2] = {{-0.5, 0.5}, {0.5, 0.5}, {-0.5, -0.5}, {0.5, -0.5}};
    for (int sample = 0; sample < 4; ++sample) {
        const Ray<double> ray = rays.ray(0, 0, sample);
        CHECK(ray.origin == Vec3d(0.0));
        CHECK(length(ray.direction) == Approx(1.0));
        CHECK(ray.direction.x / -ray.direction.z == Approx(slopes[sample][0]));
        CHECK(ray.direction.y / -ray.direction.z == Approx(slopes[sample][1]));
    }
    // Twice as wide as high: pixels are square.
    const Ray<double> corner = CameraRays<double>(camera, settings_of(200, 100, 1)).ray(0, 0, 0);
    CHECK(corner.direction.x / -corner.direction.z == Approx(-1.99));
    CHECK(corner.direction.y / -corner.direction.z == Approx(0.99));
}

TEST_CASE("an orthographic camera's rays are parallel") {
    const Camera camera{
        .projection = Projection::orthographic, .from = {1, 2, 3}, .at = {1, 2, 0}, .height = 4.0F};
    const CameraRays<double> rays(camera, settings_of(4, 2, 1));
    const Ray<double> first = rays.ray(0, 0, 0), last = rays.ray(3, 1, 0);
    CHECK(first.direction == Vec3d(0, 0, -1));
    CHECK(last.direction == Vec3d(0, 0, -1));
    CHECK(first.origin == Vec3d(-2, 3, 3));
    CHECK(last.origin == Vec3d(4, 1, 3));
}

TEST_CASE("stratified samples stay in their cells and are reproducible") {
    std::set<std::pair<float, float>> points;
    double sum_x = 0.0, sum_y = 0.0;
    for (unsigned y = 0; y < 16; ++y)
        for (unsigned x = 0; x < 16; ++x)
            for (unsigned sample = 0; sample < 4; ++sample) {
                const SamplePoint point = sample_point(SamplePattern::stratified, x, y, sample);
                REQUIRE((point.x >= 0.0F && point.x < 1.0F && point.y >= 0.0F && point.y < 1.0F));
                points.insert({point.x, point.y});
                sum_x += static_cast<double>(point.x);
                sum_y += static_cast<double>(point.y);
            }
    CHECK(points.size() == 1024);
    // Three standard deviations of the mean.
    CHECK(sum_x / 1024 == Approx(0.5).margin(3.0 * 0.2887 / 32));
    CHECK(sum_y / 1024 == Approx(0.5).margin(3.0 * 0.2887 / 32));
    const SamplePoint again = sample_point(SamplePattern::stratified, 3, 5, 2);
    CHECK(again.x == sample_point(SamplePattern::stratified, 3, 5, 2).x);
}

TEST_CASE("a stratified ray goes through the sample point of its cell") {
    Camera camera{.projection = Projection::orthographic, .from = {0, 0, 3}, .at = {0, 0, 0}};
    camera.height = 4.0F; // 4 pixels of 1
    const CameraRays<double> rays(camera, settings_of(4, 4, 2, SamplePattern::stratified));
    for (int sample = 0; sample < 4; ++sample) {
        const SamplePoint point =
            sample_point(SamplePattern::stratified, 1, 2, static_cast<unsigned>(sample));
        const Vec3d origin = rays.ray(1, 2, sample).origin;
        CHECK(origin.x == Approx(-1.0 + (sample % 2 + static_cast<double>(point.x)) / 2.0));
        CHECK(origin.y == Approx(-(sample / 2 + static_cast<double>(point.y)) / 2.0));
    }
}

TEST_CASE("a pixel is the mean of its four sub-pixels") {
    Builder builder;
    builder.camera.from = {0, 0, 4};
    builder.background = Color(0.25F);
    builder.add_shape(Sphere{{0, 0, 0}, 1}, ruler({1, 1, 1}));
    const Scene scene = builder.finish();
    ReferenceTracer<double> coarse(scene, settings_of(8, 8, 2)),
        fine(scene, settings_of(16, 16, 1));
    int mixed = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const float a = fine.pixel(2 * x, 2 * y).x, b = fine.pixel(2 * x + 1, 2 * y).x;
            const float c = fine.pixel(2 * x, 2 * y + 1).x, d = fine.pixel(2 * x + 1, 2 * y + 1).x;
            CHECK(coarse.pixel(x, y).x == Approx((a + b + c + d) / 4.0F).epsilon(1e-6));
            mixed += std::set<float>{a, b, c, d}.size() > 1 ? 1 : 0;
        }
    CHECK(mixed > 8);
}
