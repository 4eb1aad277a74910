#include "core/scene/material.hpp"
#include "core/shapes/invalid_value.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace raylane::core;

namespace {

constexpr int width = 7, height = 5;

Texture::Codes random_codes() {
    std::mt19937 random(51);
    Texture::Codes codes(std::size_t{3} * width * height);
    for (auto& code : codes)
        code = static_cast<std::uint8_t>(random());
    return codes;
}

/// Returns a component in linear light, by IEC 61966-2-1.
double linear(std::uint8_t code) {
    const double x = code / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// Returns the colour at x columns from the left and y rows from below, of pixels that `at` selects
/// by their whole numbers.
template <class At>
Vec3d between_pixels(double x, double y, const At& at) {
    const double left = std::floor(x - 0.5), low = std::floor(y - 0.5);
    Vec3d sum(0.0);
    for (const double column : {left, left + 1.0})
        for (const double row : {low, low + 1.0})
            sum += (1.0 - std::abs(x - 0.5 - column)) * (1.0 - std::abs(y - 0.5 - row)) *
                   at(static_cast<int>(column), static_cast<int>(row));
    return sum;
}

struct Pixels {
    Texture::Codes codes = random_codes();

    Vec3d operator()(int column, int row_from_below) const {
        const std::uint8_t* pixel =
            codes.data() + 3 * ((height - 1 - row_from_below) * width + column);
        return {linear(pixel[0]), linear(pixel[1]), linear(pixel[2])};
    }
};

Pattern pattern_of(const Texture& image, ImageWrap wrap = ImageWrap::repeat) {
    Pattern pattern;
    pattern.kind = PatternKind::image;
    pattern.image = image;
    pattern.wrap = wrap;
    return pattern;
}

int modulo(int a, int b) {
    return (a % b + b) % b;
}

bool near(const Vec3d& a, const Vec3d& b) {
    return largest_component(a - b) < 1e-7;
}

} // namespace

TEST_CASE("images are filtered in linear light as by a plain formula in double") {
    const Pixels pixels;
    const Texture image(width, height, pixels.codes);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-3.0, 3.0), fraction(0.0, 1.0);
    Pattern pattern = pattern_of(image);
    pattern.width = 0.7F;
    pattern.height = 1.3F;
    for (int i = 0; i < 2000; ++i) {
        const double u = number(random), v = number(random);
        const double x = u / static_cast<double>(pattern.width) * width;
        const double y = v / static_cast<double>(pattern.height) * height;
        pattern.wrap = ImageWrap::repeat;
        CHECK(near(color_in_image(pattern, {u, v}, false),
                   between_pixels(x, y, [&](int column, int row) {
                       return pixels(modulo(column, width), modulo(row, height));
                   })));
        pattern.wrap = ImageWrap::clamp;
        const auto nearest = [&](int column, int row) {
            return pixels(std::clamp(column, 0, width - 1), std::clamp(row, 0, height - 1));
        };
        CHECK(near(color_in_image(pattern, {u, v}, false), between_pixels(x, y, nearest)));
    }
    // The same with three copies around a shape, whose rows end at its poles.
    pattern = pattern_of(image);
    pattern.width = 1.0F / 3.0F;
    for (int i = 0; i < 2000; ++i) {
        const double u = fraction(random), v = i % 5 == 0 ? i % 2 : fraction(random);
        CHECK(near(color_in_image(pattern, {u, v}, true),
                   between_pixels(u / static_cast<double>(pattern.width) * width, v * height,
                                  [&](int column, int row) {
                                      return pixels(modulo(column, width),
                                                    std::clamp(row, 0, height - 1));
                                  })));
    }
}

TEST_CASE("an image is continuous at the seam, and its poles have one row") {
    const Pixels pixels;
    const Pattern pattern = pattern_of(Texture(width, height, pixels.codes));
    for (const double v : {0.0, 0.3, 0.5, 1.0})
        CHECK(
            near(color_in_image(pattern, {0.0, v}, true), color_in_image(pattern, {1.0, v}, true)));
    CHECK(near(color_in_image(pattern, {0.5 / width, 1.0}, true), pixels(0, height - 1)));
    CHECK(near(color_in_image(pattern, {0.5 / width, 0.0}, true), pixels(0, 0)));
    CHECK(near(color_in_image(pattern, {0.0, 0.5 / height}, true),
               0.5 * (pixels(0, 0) + pixels(width - 1, 0))));
    // A plane repeats the image without an end.
    CHECK(near(color_in_image(pattern, {0.5 / width, 0.0}, false),
               0.5 * (pixels(0, 0) + pixels(0, height - 1))));
    // Half of the image's height is repeated on round shapes, too.
    Pattern twice = pattern;
    twice.height = 0.5F;
    CHECK(near(color_in_image(twice, {0.5 / width, 0.5}, true),
               0.5 * (pixels(0, 0) + pixels(0, height - 1))));
    CHECK(near(color_in_image(twice, {0.5 / width, 1.0}, true), pixels(0, height - 1)));
}

TEST_CASE("every coordinate shows a pixel of the image") {
    const Pixels pixels;
    Pattern pattern = pattern_of(Texture(width, height, pixels.codes));
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double extreme : {1e9, 1e17, 1e300, infinity, 1e-300, 0.1234567, std::nan("")})
        for (const double sign : {1.0, -1.0})
            for (const ImageWrap wrap : {ImageWrap::repeat, ImageWrap::clamp})
                for (const bool is_round : {false, true})
                    for (const float size : {1.0F, 1e30F, 1e-30F, 1e-6F}) {
                        pattern.wrap = wrap;
                        pattern.width = pattern.height = size;
                        const double v = is_round ? 0.1234567 : sign * extreme;
                        const Vec3d color = color_in_image(pattern, {sign * extreme, v}, is_round);
                        CHECK(color.x >= 0.0);
                        CHECK(color.x <= 1.0);
                    }
}

TEST_CASE("floats of an image are linear, and copies share the pixels") {
    const Texture image(1, 2, Texture::Floats{4.0F, 0.25F, 0.0F, 1.0F, 0.5F, 8.0F}, "lamp.png");
    CHECK(image.pixel(0, 0) == Vec3d(4.0, 0.25, 0.0));
    CHECK(color_in_image(pattern_of(image), {0.3, 0.5}, true) == Vec3d(2.5, 0.375, 4.0));
    const Texture copy = image.named("other.png");
    CHECK(&copy.components() == &image.components());
    CHECK(copy == image);
    CHECK(copy.file() == "other.png");
    CHECK_FALSE(copy == Texture(1, 2, Texture::Floats(6, 1.0F)));
    CHECK_FALSE(copy == Texture());
}

TEST_CASE("an image without pixels, or with invalid ones, is refused") {
    CHECK_THROWS_AS(Texture(0, 2, Texture::Codes()), InvalidValue);
    CHECK_THROWS_AS(Texture(1, 1, Texture::Codes(4)), InvalidValue);
    CHECK_THROWS_AS(Texture(1, 1, Texture::Floats{0.0F, -1.0F, 0.0F}), InvalidValue);
    CHECK_THROWS_AS(Texture(1, 1, Texture::Floats{0.0F, std::nanf(""), 0.0F}), InvalidValue);
    CHECK_THROWS_AS(Texture(std::size_t{1} << 40, std::size_t{1} << 40, Texture::Codes()),
                    InvalidValue);
}
