#include "scenes/image/compare.hpp"

#include "scenes/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::scenes {

namespace {

std::string size_of(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

std::string kind_of(const Image& image) {
    return image.linear_float ? "linear floats" : "integer codes";
}

void require_same_kind(const Image& a, const Image& b) {
    const auto require_same = [&](const std::string& of_a, const std::string& of_b) {
        if (of_a != of_b)
            throw BadInput(b.name, "",
                           "must have " + of_a + " as " + printable(a.name, 4096) + " has, got " +
                               of_b);
    };
    require_same(size_of(a), size_of(b));
    require_same(kind_of(a), kind_of(b));
}

double difference(float a, float b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
    const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
    return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

} // namespace

Comparison compare(const Image& a, const Image& b, float tolerance) {
    require_same_kind(a, b);
    Comparison result;
    result.pixels = std::int64_t{a.width} * a.height;
    double squares = 0.0;
    for (std::int64_t pixel = 0; pixel < result.pixels; ++pixel) {
        double of_pixel = 0.0;
        for (std::int64_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const double d = difference(a.rgb[i], b.rgb[i]);
            squares += d * d;
            of_pixel = std::max(of_pixel, d);
        }
        if (of_pixel > static_cast<double>(tolerance)) ++result.differing;
        if (of_pixel > result.largest) {
            result.largest = of_pixel;
            result.x = static_cast<int>(pixel % a.width);
            result.y = static_cast<int>(pixel / a.width);
        }
    }
    result.rmse = std::sqrt(squares / (3.0 * static_cast<double>(result.pixels)));
    result.psnr = -20.0 * std::log10(result.rmse); // log10(0) is -infinity
    return result;
}

core::Film difference_image(const Image& a, const Image& b) {
    require_same_kind(a, b);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        if (const double d = difference(a.rgb[i], b.rgb[i]); std::isfinite(d))
            largest = std::max(largest, d);

    core::Film film(a.width, a.height);
    std::size_t i = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int channel = 0; channel < 3; ++channel, ++i) {
                const double d = difference(a.rgb[i], b.rgb[i]);
                if (d > 0.0)
                    film.at(x, y)[channel] =
                        std::isfinite(d) ? static_cast<float>(d / largest) : 1.0F;
            }
    return film;
}

} // namespace raylane::scenes
