#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/writer.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/images/little_memory.hpp"
#include "tests/scenes/images/png_chunk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <zlib.h>

using namespace raylane;
using core::Transfer;
using scenes::Image;
using tests::big_endian;
using tests::content_of;
using tests::png_chunk;
using tests::TemporaryDirectory;

namespace {

/// Returns a film with values from 0 to 1: parts are smooth enough for run lengths, parts too
/// rough.
core::Film film_of(int width, int height) {
    core::Film film(width, height);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> noise(0.0F, 1.0F);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            film.at(x, y) = {static_cast<float>(x) / static_cast<float>(width),
                             x < width / 2 ? 0.25F : noise(random), y % 2 == 0 ? 0.0F : 1.0F};
    return film;
}

void write(const std::filesystem::path& path, const core::Film& film, Transfer transfer) {
    scenes::OutputFile file(path);
    file.commit(film, transfer);
}

std::string error_of_reading(const std::filesystem::path& path) {
    return tests::message_in<scenes::BadInput>(path.parent_path(),
                                               [&] { scenes::read_image(path); });
}

bool same_bits(const scenes::Components& components, const std::vector<float>& b) {
    const std::vector<float> a = components.floats();
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    });
}

template <std::size_t size>
std::string bytes(const char (&literal)[size]) {
    return {literal, size - 1};
}

/// Returns an RGB PNG of `rows`, each with its filter byte in front. Their size is not checked.
std::string png_of(std::uint32_t width, std::uint32_t height, char bits, const std::string& rows) {
    uLongf size = ::compressBound(static_cast<uLong>(rows.size()));
    std::string compressed(size, '\0');
    ::compress(reinterpret_cast<Bytef*>(compressed.data()), &size,
               reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()));
    compressed.resize(size);
    return "\x89PNG\r\n\x1A\n" +
           png_chunk("IHDR", big_endian(width) + big_endian(height) + bits + bytes("\2\0\0\0")) +
           png_chunk("IDAT", compressed) + png_chunk("IEND", "");
}

/// 2 x 1 pixels of 16 bits: (0, 65535, 257), (1, 2, 32768).
const std::string sixteen_bit_png = bytes(
    "\x89PNG\r\n\x1A\n\x00\x00\x00\x0DIHDR\x00\x00\x00\x02\x00\x00\x00\x01\x10\x02\x00\x00\x00"
    "\x2B\xD0\x34\x9E\x00\x00\x00\x15IDAT\x78\xDA\x63\x60\x60\xF8\xFF\x9F\x91\x91\x81\x91\x81"
    "\xA9\x81\x01\x00\x14\x14\x02\x84\x49\xA7\x06\x6A\x00\x00\x00\x00IEND\xAE\x42\x60\x82");

/// 2 x 1 pixels of grey and opacity: (0, 255), (51, 128).
const std::string grey_png = bytes(
    "\x89PNG\r\n\x1A\n\x00\x00\x00\x0DIHDR\x00\x00\x00\x02\x00\x00\x00\x01\x08\x04\x00\x00\x00"
    "\x5E\x2B\xB7\x01\x00\x00\x00\x0DIDAT\x78\xDA\x63\x60\xF8\x6F\xDC\x00\x00\x03\xE8\x01\xB3"
    "\xBA\xEB\x8F\xF2\x00\x00\x00\x00IEND\xAE\x42\x60\x82");

} // namespace

TEST_CASE("a PNG holds the codes of the transfer curve") {
    const TemporaryDirectory directory;
    const core::Film film = film_of(37, 21);
    for (const Transfer transfer : {Transfer::srgb, Transfer::linear}) {
        const auto path = directory.path() / "out.png";
        write(path, film, transfer);
        const Image image = scenes::read_image(path);
        CHECK(image.width == 37);
        CHECK(image.height == 21);
        CHECK_FALSE(image.linear_float);
        CHECK(image.name == path.string());
        std::vector<float> codes;
        for (const core::Color& pixel : film.pixels())
            for (int channel = 0; channel < 3; ++channel)
                codes.push_back(static_cast<float>(core::encode(pixel[channel], transfer)) /
                                255.0F);
        CHECK(same_bits(image.rgb, codes));
    }
    CHECK(directory.file_count() == 1);
}

TEST_CASE("a PNG has 16 bits on request") {
    const TemporaryDirectory directory;
    const core::Film film = film_of(37, 21);
    const auto path = directory.path() / "out.png";
    scenes::OutputFile(path).commit(film, {.bits = 16});
    std::vector<float> codes;
    for (const core::Color& pixel : film.pixels())
        for (int channel = 0; channel < 3; ++channel)
            codes.push_back(
                static_cast<float>(core::encode_in_16_bits(pixel[channel], Transfer::srgb)) /
                65535.0F);
    CHECK(same_bits(scenes::read_image(path).rgb, codes));
}

TEST_CASE("a PNG has a film's alpha and colors not multiplied by it") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out.png";
    core::Film film(4, 1, /*with_alpha=*/true);
    film.at(0, 0) = core::Color(0.125F, 0.25F, 0.5F);
    film.alpha_at(0, 0) = 0.5F;
    film.at(1, 0) = core::Color(0.3F);
    film.alpha_at(1, 0) = 1.0F;
    film.at(2, 0) = core::Color(0.25F); // a highlight: more than its alpha
    film.alpha_at(2, 0) = 0.125F;       // the last pixel stays empty
    for (const int bits : {8, 16}) {
        scenes::OutputFile(path).commit(film, {.bits = bits});
        const Image image = scenes::read_image(path);
        const auto code = [&](float linear, Transfer transfer) {
            return bits == 8
                       ? static_cast<float>(core::encode(linear, transfer)) / 255.0F
                       : static_cast<float>(core::encode_in_16_bits(linear, transfer)) / 65535.0F;
        };
        std::vector<float> rgb, alpha;
        for (const float linear :
             {0.25F, 0.5F, 1.0F, 0.3F, 0.3F, 0.3F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F})
            rgb.push_back(code(linear, Transfer::srgb));
        for (const float share : {0.5F, 1.0F, 0.125F, 0.0F})
            alpha.push_back(code(share, Transfer::linear));
        CHECK(same_bits(image.rgb, rgb));
        CHECK(same_bits(image.alpha, alpha));
    }
}

TEST_CASE("a PNG has the resolution and texts of the options and no time stamp") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out.png";
    const auto written = [&](const scenes::ImageOptions& options) {
        scenes::OutputFile(path).commit(film_of(5, 3), options);
        CHECK(scenes::read_image(path).width == 5);
        return content_of(path);
    };
    const auto holds = [](const std::string& content, const std::string& part) {
        return content.find(part) != std::string::npos;
    };
    const std::string plain = written({});
    for (const char* type : {"pHYs", "tEXt", "iTXt", "tIME"})
        CHECK(!holds(plain, type));
    const scenes::ImageOptions options{
        .dpi = 300.0F, .texts = {{"Software", "raylane"}, {"Title", "caf\xC3\xA9"}}};
    const std::string told = written(options);
    CHECK(holds(told, png_chunk("pHYs", big_endian(11811) + big_endian(11811) + "\1")));
    CHECK(holds(told, png_chunk("tEXt", bytes("Software\0raylane"))));
    CHECK(holds(told, png_chunk("iTXt", bytes("Title\0\0\0\0\0caf\xC3\xA9"))));
    CHECK(!holds(told, "tIME"));
    CHECK(told == written(options));
}

TEST_CASE("two PNGs of equal films have equal bytes") {
    const TemporaryDirectory directory;
    write(directory.path() / "a.png", film_of(200, 100), Transfer::srgb);
    write(directory.path() / "b.PNG", film_of(200, 100), Transfer::srgb);
    CHECK(content_of(directory.path() / "a.png") == content_of(directory.path() / "b.PNG"));
}

TEST_CASE("an HDR image is right to 1/128 of each pixel's largest component") {
    const TemporaryDirectory directory;
    for (const int width : {1, 7, 8, 300}) { // run lengths are used from 8 on
        core::Film film = film_of(width, 5);
        film.at(0, 0) = {1e-40F, 0.0F, 0.0F};
        film.at(0, 1) = {1000.0F, 1.0F, 3e-5F};
        film.at(0, 2) = {0.99999994F, 3.3e38F, 1.0F};
        film.at(0, 3) = {std::nanf(""), -1.0F, 2.0F};
        film.at(0, 4) = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F};
        const auto path = directory.path() / "out.hdr";
        write(path, film, Transfer::srgb);
        const Image image = scenes::read_image(path);
        REQUIRE(image.rgb.size() == film.pixels().size() * 3);
        CHECK(image.linear_float);

        const float largest = 0x1.FFFFFEp126F; // of the format
        film.at(0, 2).y = largest;
        film.at(0, 3) = {0.0F, 0.0F, 2.0F};
        film.at(0, 4).x = largest;
        bool close = true;
        for (std::size_t i = 0; i < film.pixels().size(); ++i) {
            const core::Color& pixel = film.pixels()[i];
            const float most = std::max({pixel.x, pixel.y, pixel.z, 1e-32F});
            for (int channel = 0; channel < 3; ++channel)
                close =
                    close && std::abs(pixel[channel] - image.rgb[3 * i + channel]) <= most / 128;
        }
        CHECK(close);
    }
}

TEST_CASE("a PFM holds the film's floats unchanged") {
    const TemporaryDirectory directory;
    core::Film film = film_of(9, 4);
    film.at(0, 0) = {-1.5F, 1e-45F, -0.0F};
    film.at(1, 0) = {std::nanf(""), std::numeric_limits<float>::infinity(), 3.4028235e38F};
    const auto path = directory.path() / "out.pfm";
    write(path, film, Transfer::srgb);
    const Image image = scenes::read_image(path);
    std::vector<float> floats;
    for (const core::Color& pixel : film.pixels())
        floats.insert(floats.end(), {pixel.x, pixel.y, pixel.z});
    CHECK(same_bits(image.rgb, floats));

    core::Film column(1, 2);
    column.at(0, 0) = {1.0F, 0.0F, 0.0F};
    column.at(0, 1) = {-2.0F, 0.0F, 0.0F};
    write(path, column, Transfer::srgb);
    CHECK(content_of(path) ==
          bytes("PF\n1 2\n-1.0\n\x00\x00\x00\xC0\x00\x00\x00\x00\x00\x00\x00\x00"
                "\x00\x00\x80\x3F\x00\x00\x00\x00\x00\x00\x00\x00"));
}

TEST_CASE("images of other programs are read") {
    const TemporaryDirectory directory;
    const Image sixteen = scenes::read_image(directory.write("a.png", sixteen_bit_png));
    CHECK(same_bits(sixteen.rgb,
                    {0.0F, 1.0F, 257 / 65535.0F, 1 / 65535.0F, 2 / 65535.0F, 32768 / 65535.0F}));
    // The content determines the format, not the ending.
    const Image grey = scenes::read_image(directory.write("b.hdr", grey_png));
    CHECK(same_bits(grey.rgb, {0.0F, 0.0F, 0.0F, 0.2F, 0.2F, 0.2F}));
    CHECK(same_bits(grey.alpha, {1.0F, 128 / 255.0F}));
    CHECK(sixteen.alpha.size() == 0);

    const std::string big_endian = bytes("Pf\n2 1\n1\n\x3F\x80\x00\x00\xC0\x00\x00\x00");
    const Image map = scenes::read_image(directory.write("c.pfm", big_endian));
    CHECK(map.linear_float);
    CHECK(same_bits(map.rgb, {1.0F, 1.0F, 1.0F, -2.0F, -2.0F, -2.0F}));

    const std::string flat = bytes("#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n"
                                   "\x80\x40\x00\x81\xFF\x00\x00\x00");
    const Image radiance = scenes::read_image(directory.write("d.hdr", flat));
    CHECK(same_bits(radiance.rgb, {1.0F, 0.5F, 0.0F, 0.0F, 0.0F, 0.0F}));
}

TEST_CASE("a file that is not an image is bad input") {
    const TemporaryDirectory directory;
    const auto error_of = [&](const std::string& content) {
        return error_of_reading(directory.write("a.png", content));
    };
    const std::string damaged = "a.png: must be a PNG, TIFF, EXR, HDR or PFM image, got a damaged ";
    CHECK(error_of("") == "a.png: must be a PNG, TIFF, EXR, HDR or PFM image, got another format");
    CHECK(error_of("GIF89a") ==
          "a.png: must be a PNG, TIFF, EXR, HDR or PFM image, got another format");
    CHECK(error_of("\x89PNG\r\n\x1A\n") == damaged + "PNG");
    CHECK(error_of("PFM\n1 1\n-1\nabcdabcdabcd") == damaged + "PFM");
    CHECK(error_of("PF\n1 one\n-1\nabcdabcdabcd") == damaged + "PFM");
    CHECK(error_of("PF\n1 1\n0\nabcdabcdabcd") == damaged + "PFM");
    CHECK(error_of("#?RADIANCE\n\n-Y 1 +X 1\nabcd") == damaged + "HDR");
    CHECK(error_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+X 1 -Y 1\nabcd") == damaged + "HDR");
    // stb_image loops for ever on runs of zero length.
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
    CHECK(error_of(header + bytes("\x02\x02\x00\x08\x00\x00\x00\x00")) == damaged + "HDR");
    CHECK(error_of(header + bytes("\x02\x02\x00\x08\x89\x00")) == damaged + "HDR");

    const std::string absurd =
        "a.png: must be an image of 1 to 65535 pixels a side and at most 268435456 in total, got ";
    CHECK(error_of("PF\n0 5\n-1\n") == absurd + "0 x 5");
    CHECK(error_of("PF\n100000 1\n-1\n") == absurd + "100000 x 1");
    CHECK(error_of("PF\n60000 60000\n-1\n") == absurd + "60000 x 60000");
    CHECK(error_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X -8\n") == absurd + "-8 x 1");
    CHECK(error_of(png_of(0x7FFFFFFF, 1, 16, "")) == absurd + "2147483647 x 1");
    CHECK(error_of(png_of(16385, 16384, 8, "")) == absurd + "16385 x 16384");

    CHECK(error_of_reading(directory.path() / "none.png") == "none.png: no such file");
}

TEST_CASE("a PNG with bytes behind its image or too few rows is damaged") {
    const TemporaryDirectory directory;
    const auto error_of = [&](const std::string& content) {
        return error_of_reading(directory.write("a.png", content));
    };
    const std::string damaged =
        "a.png: must be a PNG, TIFF, EXR, HDR or PFM image, got a damaged PNG";
    const std::string pixel = bytes("\x00\x10\x20\x30"); // a filter and three codes
    CHECK(error_of(png_of(1, 1, 8, pixel)) == "no error");
    CHECK(error_of(png_of(1, 1, 8, pixel) + "x") == damaged);
    CHECK(error_of(png_of(1, 1, 8, pixel + std::string(100'000, 'x'))) == damaged);
    CHECK(error_of(png_of(1, 2, 8, pixel)) == damaged);
}

TEST_CASE("a PNG takes the memory of its codes and a lack of memory is reported", "[native]") {
    const TemporaryDirectory directory;
    constexpr std::uint32_t side = 4096;
    std::string rows;
    for (std::uint32_t y = 0; y < side; ++y)
        rows.append(1, '\0').append(std::size_t{side} * 6, '\x7F');
    const auto path = directory.write("a.png", png_of(side, side, 16, rows));
    // 96 MiB of codes; as floats they would be twice as many.
    const auto reads = [&] { return scenes::read_image(path).width == int{side}; };
    if (tests::sanitized) return;
    CHECK(tests::within(130, reads) == tests::Ended::well);
    CHECK(tests::within(60, reads) == tests::Ended::refused_by_the_system);
}

TEST_CASE("a truncated image is bad input and a damaged PNG is always noticed") {
    const TemporaryDirectory directory;
    std::mt19937 random(6);
    for (const char* name : {"a.png", "a.hdr", "a.pfm"}) {
        const auto path = directory.path() / name;
        write(path, film_of(19, 7), Transfer::srgb);
        const std::string content = content_of(path);
        int accepted = 0;
        for (std::size_t length = 0; length < content.size(); ++length) {
            directory.write(name, content.substr(0, length));
            if (error_of_reading(path) == "no error") ++accepted;
        }
        CHECK(accepted == 0);
        accepted = 0;
        for (int i = 0; i < 300; ++i) {
            std::string damaged = content;
            damaged[random() % damaged.size()] = static_cast<char>(random());
            directory.write(name, damaged);
            if (damaged != content && error_of_reading(path) == "no error") ++accepted;
        }
        if (path.extension() == ".png") CHECK(accepted == 0); // PNG has checksums
    }
}
