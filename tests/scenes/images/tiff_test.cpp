#include "scenes/files/errors.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/tiff.hpp"
#include "tests/scenes/files/message_of.hpp"
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

namespace {

/// Opens a file for an image of 8 bits in red, green and blue.
TIFF* open_rgb(const std::string& name, const char* mode, int width, int height) {
    TIFF* const tiff = TIFFOpen(name.c_str(), mode);
    REQUIRE(tiff != nullptr);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    return tiff;
}

} // namespace

TEST_CASE("a TIFF is turned by its orientation") {
    const TemporaryDirectory directory;
    // Pixel k has the code k. The file's rows are 0 1 2 and 3 4 5.
    const int upright[][6] = {{0, 1, 2, 3, 4, 5}, {2, 1, 0, 5, 4, 3}, {5, 4, 3, 2, 1, 0},
                              {3, 4, 5, 0, 1, 2}, {0, 3, 1, 4, 2, 5}, {3, 0, 4, 1, 5, 2},
                              {5, 2, 4, 1, 3, 0}, {2, 5, 1, 4, 0, 3}};
    for (int orientation = 1; orientation <= 8; ++orientation) {
        const std::string name = (directory.path() / "a.tif").string();
        TIFF* const tiff = open_rgb(name, "w", 3, 2);
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, orientation);
        for (std::uint32_t y = 0; y < 2; ++y) {
            std::uint8_t row[9];
            for (std::uint32_t i = 0; i < 9; ++i)
                row[i] = static_cast<std::uint8_t>(3 * y + i / 3);
            REQUIRE(TIFFWriteScanline(tiff, row, y, 0) == 1);
        }
        TIFFClose(tiff);
        const scenes::Image image = scenes::read_image(name);
        CAPTURE(orientation);
        CHECK(image.width == (orientation <= 4 ? 3 : 2));
        CHECK(image.height == (orientation <= 4 ? 2 : 3));
        for (std::size_t i = 0; i < 6; ++i)
            CHECK(255.0F * image.rgb[3 * i + 1] ==
                  Approx(static_cast<float>(upright[orientation - 1][i])));
    }
}

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
            const scenes::Image again = scenes::read_image(directory.path() / "a.tiff");
            CHECK(again.rgb.is_same(png.rgb));
            CHECK(again.alpha.is_same(png.alpha));
            CHECK(again.bits == bits);
            CHECK(again.texts == options.texts);
        }
}

namespace {

/// Writes a TIFF of 4 x 3 pixels, and returns its bytes.
std::string tiff_with(const TemporaryDirectory& directory, std::uint32_t tag, int value,
                      const char* mode = "w") {
    const std::string name = (directory.path() / "other.tif").string();
    TIFF* const tiff = open_rgb(name, mode, 4, 3);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
    if (tag != 0) TIFFSetField(tiff, tag, value);
    std::vector<std::uint8_t> row(64, 100);
    for (std::uint32_t y = 0; y < 3; ++y)
        REQUIRE(TIFFWriteScanline(tiff, row.data(), y, 0) == 1);
    TIFFClose(tiff);
    return tests::content_of(name);
}

std::string error_of(const std::string& bytes) {
    return tests::message_of<scenes::BadInput>([&] {
        scenes::InputFile file("a.tif", bytes);
        static_cast<void>(scenes::read_image(file));
    });
}

} // namespace

TEST_CASE("damaged and other TIFF images are refused") {
    const TemporaryDirectory directory;
    const std::string plain = tiff_with(directory, 0, 0);
    scenes::InputFile file("a.tif", plain);
    CHECK(scenes::read_image(file).rgb[5] == 100.0F / 255.0F);
    const std::string damaged =
        "a.tif: must be a PNG, TIFF, EXR, HDR or PFM image, got a damaged TIFF";
    for (std::size_t size = 4; size < plain.size(); ++size)
        CHECK(error_of(plain.substr(0, size)) == damaged);
    CHECK(error_of(tiff_with(directory, TIFFTAG_BITSPERSAMPLE, 32)) ==
          "a.tif: must be a TIFF of RGB, or of RGB and a separate alpha, with 8 or 16 bits, in "
          "strips");
    CHECK(scenes::looks_like_tiff(plain));
    CHECK(scenes::foreign_tag(plain).empty());
    CHECK(scenes::foreign_tag(tiff_with(directory, TIFFTAG_ORIENTATION, ORIENTATION_BOTRIGHT)) ==
          "tag 274");
    CHECK(scenes::foreign_tag(tiff_with(directory, TIFFTAG_MINSAMPLEVALUE, 5)) == "tag 280");
    tiff_with(directory, 0, 0);
    CHECK(scenes::foreign_tag(tiff_with(directory, 0, 0, "a")) == "a second image");
    CHECK(scenes::foreign_tag(tiff_with(directory, 0, 0, "wb")) == "byte order MM");
}

#endif
