#include "scenes/images/compare.hpp"

#include "core/numbers/elementary.hpp"
#include "scenes/files/errors.hpp"

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

/// Returns component `channel` of a pixel in the form that is compared. Channel 3 is the alpha.
float component(const Image& image, std::size_t pixel, std::size_t channel) {
    const float alpha = image.alpha.size() != 0 ? image.alpha[pixel] : 1.0F;
    if (channel == 3) return alpha;
    const float color = image.rgb[3 * pixel + channel];
    return image.linear_float || image.alpha.size() == 0 ? color : alpha * color;
}

double difference(float a, float b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
    const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
    return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

/// The differences between the components of two images.
class Differences {
  public:
    Differences(const Image& a, const Image& b)
        : a_(a), b_(b), channels_(a.alpha.size() != 0 || b.alpha.size() != 0 ? 4 : 3) {
        require_same_kind(a, b);
    }

    std::size_t channels() const { return channels_; }
    double of(std::size_t pixel, std::size_t channel) const {
        return difference(component(a_, pixel, channel), component(b_, pixel, channel));
    }

  private:
    const Image& a_;
    const Image& b_;
    std::size_t channels_;
};

} // namespace

Comparison compare(const Image& a, const Image& b, float tolerance) {
    const Differences differences(a, b);
    Comparison result;
    result.pixels = std::int64_t{a.width} * a.height;
    double squares = 0.0;
    for (std::int64_t pixel = 0; pixel < result.pixels; ++pixel) {
        double of_pixel = 0.0;
        for (std::size_t channel = 0; channel < differences.channels(); ++channel) {
            const double d = differences.of(static_cast<std::size_t>(pixel), channel);
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
    result.rmse = std::sqrt(squares / (static_cast<double>(differences.channels()) *
                                       static_cast<double>(result.pixels)));
    result.psnr = -20.0 * core::log10(result.rmse); // log10(0) is -infinity
    return result;
}

core::Film difference_image(const Image& a, const Image& b) {
    const Differences differences(a, b);
    double largest = 0.0;
    for (std::size_t pixel = 0; pixel < a.rgb.size() / 3; ++pixel)
        for (std::size_t channel = 0; channel < differences.channels(); ++channel)
            if (const double d = differences.of(pixel, channel); std::isfinite(d))
                largest = std::max(largest, d);

    core::Film film(a.width, a.height);
    std::size_t pixel = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x, ++pixel) {
            const double of_alpha = differences.channels() == 4 ? differences.of(pixel, 3) : 0.0;
            for (int channel = 0; channel < 3; ++channel) {
                const double d =
                    std::max(differences.of(pixel, static_cast<std::size_t>(channel)), of_alpha);
                if (d > 0.0)
                    film.at(x, y)[channel] =
                        std::isfinite(d) ? static_cast<float>(d / largest) : 1.0F;
            }
        }
    return film;
}

} // namespace raylane::scenes
