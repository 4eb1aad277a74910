#include "core/numbers/sample_sequence.hpp"
#include "core/scene/pixel_filter.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <bit>
#include <cmath>
#include <set>
#include <vector>

using namespace raylane;
using namespace little_scene;

namespace {

/// Returns whether no two points share a cell of a grid of `columns` x `rows`.
bool is_net(const std::vector<SamplePoint>& points, int columns, int rows) {
    std::set<int> cells;
    for (const SamplePoint& point : points)
        cells.insert(static_cast<int>(point.x * static_cast<float>(columns)) +
                     columns * static_cast<int>(point.y * static_cast<float>(rows)));
    return cells.size() == points.size();
}

} // namespace

TEST_CASE("each aligned run of a pixel's sequence is spread over the pixel") {
    for (const std::uint32_t pixel : {0U, 1U, 77U, 40000U})
        for (int power = 0; power <= 10; ++power) {
            const std::uint32_t count = 1U << power;
            for (const std::uint32_t first : {0U, count, 5U * count}) {
                std::vector<SamplePoint> points, shuffled;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const std::uint64_t key = sequence_key(pixel, 3 * pixel, 0);
                    points.push_back(sequence_point(key, first + i));
                    shuffled.push_back(shuffled_point(key, first + i));
                }
                for (int across = 0; across <= power; ++across) {
                    CHECK(is_net(points, 1 << across, 1 << (power - across)));
                    CHECK(is_net(shuffled, 1 << across, 1 << (power - across)));
                }
            }
        }
    const auto first_of = [](std::uint32_t x, std::uint32_t y, std::uint32_t use) {
        return sequence_point(sequence_key(x, y, use), 5).x;
    };
    CHECK(first_of(3, 4, 0) != first_of(4, 3, 0));
    CHECK(first_of(3, 4, 0) != first_of(3, 4, 1));
}

TEST_CASE("points on lights are spread over pixels and squares of pixels") {
    for (const int samples : {1, 4, 16})
        for (const std::uint32_t count : {1U, 2U})
            for (const int side : {1, 2, 4, 8}) {
                std::vector<SamplePoint> points;
                for (int y = 296; y < 296 + side; ++y)
                    for (int x = 520; x < 520 + side; ++x)
                        for (int number = 0; number < samples; ++number) {
                            const PointRange range =
                                points_on_light({x, y, number, samples}, count, 1, 0, 2);
                            for (std::uint32_t k = 0; k < count; ++k)
                                points.push_back(shuffled_point(range.key, range.first + k));
                        }
                const int power = std::countr_zero(points.size());
                CAPTURE(samples, count, side, power);
                for (int across = 0; across <= power; ++across)
                    CHECK(is_net(points, 1 << across, 1 << (power - across)));
            }
    const auto first_of = [](const SampleName& sample, std::uint32_t light) {
        const PointRange range = points_on_light(sample, 1, 0, light, 2);
        return shuffled_point(range.key, range.first).x;
    };
    CHECK(first_of({1, 2, -1, 4}, 0) != first_of({1, 2, 0, 4}, 0));
    CHECK(first_of({1, 2, 0, 4}, 0) != first_of({1, 2, 0, 4}, 1));
    CHECK(first_of({1, 2, 4, 4}, 0) != first_of({1, 3, 4, 4}, 0));
}

/// Otherwise, one side of each pixel would show the view from one side of the lens.
TEST_CASE("shuffled points of one sequence do not correlate with another sequence") {
    constexpr std::uint32_t pixels = 256, count = 64, grid = 8;
    const auto side = [](double x) { return x < 0.5 ? -1.0 : 1.0; };
    double with_sequence = 0.0, with_column = 0.0, with_row = 0.0; // squares of correlations
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        double sequence = 0.0, column = 0.0, row = 0.0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double near_side = side(static_cast<double>(
                shuffled_point(sequence_key(pixel, 0, SequenceUse::on_lens), i).x));
            const double far_side = static_cast<double>(
                sequence_point(sequence_key(pixel, 0, SequenceUse::in_pixel), i).x);
            sequence += near_side * side(far_side) / count;
            column += near_side * side((i % grid + 0.5) / grid) / count;
            row += near_side * side((i / grid + 0.5) / grid) / count;
        }
        with_sequence += sequence * sequence / pixels;
        with_column += column * column / pixels;
        with_row += row * row / pixels;
    }
    // The value is 1 for sequences in the same order, and 1 / 64 for independent ones.
    CHECK(with_sequence < 0.05);
    CHECK(with_column < 0.05);
    CHECK(with_row < 0.05);
}

TEST_CASE("a filter's samples have its density") {
    constexpr int count = 4096;
    // Standard deviations in pixels: of a uniform distribution, of a normal distribution that is
    // cut off at three standard deviations, and of the window, by its integral.
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

TEST_CASE("a filter spreads an edge over its reach and keeps even areas") {
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
