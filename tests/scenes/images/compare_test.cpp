#include "scenes/files/errors.hpp"
#include "scenes/images/compare.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <limits>

using namespace raylane;
using scenes::Comparison;
using scenes::Image;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const float not_a_number = std::numeric_limits<float>::quiet_NaN();

Image image_of(std::vector<float> rgb, int width, std::vector<float> alpha = {}) {
    const int height = static_cast<int>(rgb.size()) / 3 / width;
    return {width,
            height,
            true,
            scenes::Components(std::move(rgb)),
            scenes::Components(std::move(alpha)),
            "a.pfm"};
}

} // namespace

TEST_CASE("equal images have no difference") {
    const Image image = image_of({0.0F, 0.5F, not_a_number, infinity, -infinity, 1.0F}, 2);
    const Comparison result = scenes::compare(image, image, 0.0F);
    CHECK(result.rmse == 0.0);
    CHECK(result.psnr == std::numeric_limits<double>::infinity());
    CHECK(result.largest == 0.0);
    CHECK(result.differing == 0);
    CHECK(result.pixels == 2);
    const core::Film film = scenes::difference_image(image, image);
    CHECK(film.at(1, 0) == core::Color(0.0F));
}

TEST_CASE("compare measures RMSE and PSNR and the largest difference") {
    const Image a = image_of({0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1}, 2);
    const Image b = image_of({0, 0, 0, 0.125F, 0, 0, 0, 0.5F, 0, 0.5F, 1, 0.75F}, 2);
    const Comparison result = scenes::compare(a, b, 0.125F);
    const double mean_square = (0.125 * 0.125 + 0.25 + 0.25 + 0.0625) / 12.0;
    CHECK(result.rmse == Approx(std::sqrt(mean_square)).epsilon(1e-14));
    CHECK(result.psnr == Approx(10.0 * std::log10(1.0 / mean_square)).epsilon(1e-14));
    CHECK(result.largest == 0.5);
    CHECK(result.x == 0); // the first of two equal differences
    CHECK(result.y == 1);
    CHECK(result.differing == 2); // 0.125 is not above the tolerance
    CHECK(result.pixels == 4);
    CHECK(scenes::compare(a, b, 0.0F).differing == 3);
    CHECK(scenes::compare(b, a, 0.6F).differing == 0);

    const core::Film film = scenes::difference_image(a, b);
    CHECK(film.at(0, 0) == core::Color(0.0F));
    CHECK(film.at(1, 0) == core::Color(0.25F, 0.0F, 0.0F));
    CHECK(film.at(0, 1) == core::Color(0.0F, 1.0F, 0.0F));
    CHECK(film.at(1, 1) == core::Color(1.0F, 0.0F, 0.5F));
}

TEST_CASE("one code of 255 is 48.13 dB") {
    Image a = image_of({0, 0, 0}, 1);
    Image b = image_of({1 / 255.0F, 1 / 255.0F, 1 / 255.0F}, 1);
    a.linear_float = b.linear_float = false;
    CHECK(scenes::compare(a, b, 0.0F).psnr == Approx(48.1308).epsilon(1e-6));
}

TEST_CASE("alpha is compared and colors are compared as alpha weighs them") {
    const Image a = image_of({0, 0, 0, 0.5F, 0, 0}, 2, {0, 0.5F});
    const Image opaque = image_of({0, 0, 0, 0.5F, 0, 0}, 2);
    CHECK(scenes::compare(a, a, 0.0F).differing == 0);
    for (const auto& [one, other] : {std::pair(&a, &opaque), {&opaque, &a}}) {
        const Comparison result = scenes::compare(*one, *other, 0.5F);
        CHECK(result.differing == 1);
        CHECK(result.largest == 1.0);
        CHECK(result.rmse == Approx(std::sqrt((1.0 + 0.25) / 8.0)).epsilon(1e-14));
        const core::Film film = scenes::difference_image(*one, *other);
        CHECK(film.at(0, 0) == core::Color(1.0F));
        CHECK(film.at(1, 0) == core::Color(0.5F));
    }
    // Codes are not multiplied by alpha yet. Invisible colors make no difference.
    Image b = image_of({1, 1, 1, 0.5F, 0, 0}, 2, {0, 0.5F});
    Image c = image_of({0, 0, 0, 0.75F, 0, 0}, 2, {0, 0.5F});
    b.linear_float = c.linear_float = false;
    CHECK(scenes::compare(b, c, 0.0F).differing == 1);
    CHECK(scenes::compare(b, c, 0.0F).largest == 0.125);
}

TEST_CASE("NaN and infinity differ from other values beyond any tolerance") {
    const Image a = image_of({0, 0, 0, 0, infinity, 0, 0.5F, 0, 0}, 3);
    const Image b = image_of({0, not_a_number, 0, 0, -infinity, 0, 0, 0, 0}, 3);
    const Comparison result = scenes::compare(a, b, 1e30F);
    CHECK(result.differing == 2);
    CHECK(result.largest == std::numeric_limits<double>::infinity());
    CHECK(result.x == 0);
    CHECK(result.rmse == std::numeric_limits<double>::infinity());
    CHECK(result.psnr == -std::numeric_limits<double>::infinity());
    const core::Film film = scenes::difference_image(a, b);
    CHECK(film.at(0, 0) == core::Color(0.0F, 1.0F, 0.0F));
    CHECK(film.at(1, 0) == core::Color(0.0F, 1.0F, 0.0F));
    CHECK(film.at(2, 0) == core::Color(1.0F, 0.0F, 0.0F));
}

TEST_CASE("images of different sizes or kinds are not compared") {
    const Image a = image_of({0, 0, 0, 0, 0, 0}, 2);
    Image b = image_of({0, 0, 0, 0, 0, 0}, 1);
    b.name = "b.pfm";
    CHECK_THROWS_AS(scenes::compare(a, b, 0.0F), scenes::BadInput);
    CHECK_THROWS_WITH(scenes::difference_image(a, b),
                      "b.pfm: must have 2 x 1 pixels as a.pfm has, got 1 x 2 pixels");
    Image codes = a;
    codes.linear_float = false;
    codes.name = "c.png";
    CHECK_THROWS_WITH(scenes::compare(a, codes, 0.0F),
                      "c.png: must have linear floats as a.pfm has, got integer codes");
}
