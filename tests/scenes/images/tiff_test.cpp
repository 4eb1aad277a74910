#include "scenes/files/errors.hpp"
#include "scenes/images/exr.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using tests::TemporaryDirectory;

namespace {

core::Film film_of(bool with_alpha) {
    core::Film film(70, 300, with_alpha);
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const float alpha = with_alpha ? static_cast<float>(y % 5) / 4.0F : 1.0F;
            film.at(x, y) = alpha * core::Color(static_cast<float>(x) / 69.0F,
                                                static_cast<float>(y) / 299.0F, 1.5F);
            if (with_alpha) film.alpha_at(x, y) = alpha;
        }
    return film;
}

} // namespace

TEST_CASE("an output file without an encoder refuses the ending .tif") {
    const TemporaryDirectory directory;
    CHECK_THROWS_AS(scenes::OutputFile(directory.path() / "a.tif"), scenes::BadInput);
    CHECK(directory.names().empty());
}

#ifdef RAYLANE_WITH_TIFF

#include <tiffio.h>

TEST_CASE("a TIFF has the codes of a PNG and the resolution") {
    const TemporaryDirectory directory;
    for (const bool with_alpha : {false, true})
        for (const int bits : {8, 16}) {
            const core::Film film = film_of(with_alpha);
            const scenes::ImageOptions options{
                .bits = bits, .dpi = 600.0F, .texts = {{"Title", "a"}, {"Comment", "--spp 4"}}};
            scenes::OutputFile(directory.path() / "a.png").commit(film, options);
            scenes::OutputFile(directory.path() / "a.tiff", scenes::more_encoders)
                .commit(film, options);
            const scenes::Image png = scenes::read_image(directory.path() / "a.png");
            TIFF* const tiff = TIFFOpen((directory.path() / "a.tiff").c_str(), "r");
            REQUIRE(tiff != nullptr);
            std::uint32_t width = 0, height = 0;
            std::uint16_t depth = 0, samples = 0, unit = 0;
            float dpi = 0.0F;
            char* text = nullptr;
            TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
            TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
            TIFFGetField(tiff, TIFFTAG_BITSPERSAMPLE, &depth);
            TIFFGetField(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
            TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &dpi);
            TIFFGetField(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
            REQUIRE(TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1);
            CHECK(std::string(text) == "Comment: --spp 4");
            CHECK(dpi == 600.0F);
            CHECK(unit == RESUNIT_INCH);
            CHECK(depth == bits);
            REQUIRE(samples == (with_alpha ? 4 : 3));
            REQUIRE(width == 70);
            REQUIRE(height == 300);
            std::size_t wrong = 0;
            std::vector<std::uint8_t> row(static_cast<std::size_t>(TIFFScanlineSize(tiff)));
            for (std::uint32_t y = 0; y < height; ++y) {
                REQUIRE(TIFFReadScanline(tiff, row.data(), y, 0) == 1);
                for (std::uint32_t i = 0; i < width * samples; ++i) {
                    float component = static_cast<float>(row[i]) / 255.0F;
                    if (bits == 16) {
                        std::uint16_t code = 0;
                        std::memcpy(&code, &row[2 * i], sizeof code);
                        component = static_cast<float>(code) / 65535.0F;
                    }
                    const std::size_t pixel = y * width + i / samples;
                    const float expected =
                        i % samples == 3 ? png.alpha[pixel] : png.rgb[3 * pixel + i % samples];
                    wrong += component != expected ? 1 : 0;
                }
            }
            CHECK(wrong == 0);
            TIFFClose(tiff);
        }
}

#endif
