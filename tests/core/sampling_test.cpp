#include "core/scene/pixel_filter.hpp"
#include "core/scene/sample_sequence.hpp"
#include "tests/catch.hpp"
#include "tests/core/little_scene.hpp"

#include <cmath>
#include <set>
#include <vector>

using namespace raylane;
using namespace little_scene;

namespace {

/// True if each of so many columns and rows has one of the points.
bool is_net(const std::vector<SamplePoint>& points, int columns, int rows) {
    std::set<int> cells;
    for (const SamplePoint& point : points)
        cells.insert(static_cast<int>(point.x * static_cast<float>(columns)) +
                     columns * static_cast<int>(point.y * static_cast<float>(rows)));
    return cells.size() == points.size();
}

} // namespace

TEST_CASE("points of a pixel's sequence are spread over it, wherever one begins") {
    for (const std::uint32_t pixel : {0U, 1U, 77U, 40000U})
        for (int power = 0; power <= 10; ++power) {
            const std::uint32_t count = 1U << power;
            for (const std::uint32_t first : {0U, count, 5U * count}) {
                std::vector<SamplePoint> points;
                for (std::uint32_t i = 0; i < count; ++i)
                    points.push_back(sequence_point(pixel, 3 * pixel, first + i));
                for (int across = 0; across <= power; ++across)
                    CHECK(is_net(points, 1 << across, 1 << (power - across)));
            }
        }
    CHECK(sequence_point(3, 4, 5).x != sequence_point(4, 3, 5).x);
}

TEST_CASE("a filter's samples have its density") {
    constexpr int count = 4096;
    // Standard deviations in pixels: of a square, of a normal distribution cut off at three of its
    // own, and the window's, by its integral.
    const std::pair<PixelFilter, double> filters[] = {{PixelFilter::box, std::sqrt(1.0 / 12.0)},
                                                      {PixelFilter::gaussian, 0.4790},
                                                      {PixelFilter::blackman_harris, 0.4155}};
    for (const auto& [filter, deviation] : filters) {
        CAPTURE(static_cast<int>(filter));
        const FilterPlaces places(filter);
        double sum = 0.0, squares = 0.0, last = -10.0;
        for (int i = 0; i < count; ++i) {
            const double x = places.place((i + 0.5) / count) - 0.5;
            CHECK(x > last);
            CHECK(std::abs(x) <= reach_of(filter));
            last = x;
            sum += x;
            squares += x * x;
        }
        CHECK(std::abs(sum / count) < 1e-6);
        CHECK(std::sqrt(squares / count) == Approx(deviation).epsilon(0.01));
        CHECK(places.place(0.0) == 0.5 - reach_of(filter));
        CHECK(places.place(1.0) == 0.5 + reach_of(filter));
    }
}

TEST_CASE("a filter spreads an edge over its reach, and keeps what is even") {
    for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::blackman_harris}) {
        Builder builder;
        builder.settings.width = 8;
        builder.settings.height = 2;
        builder.settings.grid = 16;
        builder.settings.filter = filter;
        builder.camera.projection = Projection::orthographic;
        builder.camera.height = 2.0F;
        builder.background = Color(1.0F);
        builder.add_shape(Box{{-9, -9, -1}, {9, 0, 0}, {0, 18, 0}, {0, 0, 1}}, black());
        const Scene scene = builder.finish();
        ReferenceTracer<double> tracer(scene, scene.settings());
        // The edge is between the pixels 3 and 4.
        CHECK(tracer.pixel(2, 0).x == 0.0F);
        CHECK(tracer.pixel(5, 0).x == 1.0F);
        const float left = tracer.pixel(3, 0).x, right = tracer.pixel(4, 0).x;
        CHECK((left > 0.05F && left < 0.3F));
        CHECK(static_cast<double>(left + right) == Approx(1.0).margin(1e-3));
    }
}
