#include "raylane/raylane.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/images/reader.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>

using namespace raylane;
using tests::message_of;

namespace {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
static_assert(std::is_same_v<Layers, Aovs>, "the former name");
#pragma GCC diagnostic pop

Scene mirrored_ball() {
    SceneBuilder builder;
    builder.settings.width = 70;
    builder.settings.height = 50;
    builder.background = {0.25F, 0.5F, 0.75F};
    builder.add_light({.position = {4, 6, 5}});
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({.reflectivity = 0.5F}));
    return builder.build();
}

std::vector<float> inner_pixels(const Scene& scene) {
    const core::Scene& inner = library::Internals::of(scene);
    const simd::Rendering rendering = simd::render(inner, inner.settings(), {});
    std::vector<float> rgb;
    for (const core::Color& pixel : rendering.film.pixels())
        rgb.insert(rgb.end(), {pixel.x, pixel.y, pixel.z});
    return rgb;
}

/// Returns a scene that float precision can render, too, and faster.
Scene lone_egg() {
    SceneBuilder builder;
    builder.settings.width = builder.settings.height = 100;
    builder.camera.from = {0, 0, 6};
    builder.add_light({.position = {4, 6, 5}});
    builder.add(Quadric{.center = {0, 0, 0},
                        .xx = 1,
                        .yy = 2,
                        .zz = 3,
                        .one = -1,
                        .lower = {-1.1F, -1.1F, -1.1F},
                        .upper = {1.1F, 1.1F, 1.1F}},
                builder.add_material({}));
    return builder.build();
}

} // namespace

TEST_CASE("other precisions give other images") {
    const Scene egg = lone_egg();
    const auto drawn = [&](Precision precision) {
        return render(egg, {.precision = precision}).rgb;
    };
    CHECK(drawn(Precision::fast) != drawn(Precision::exact));
    CHECK(message_of<InvalidValue>([&] { drawn(static_cast<Precision>(4)); }) ==
          "precision: must be a Precision");
}

TEST_CASE("an image of the library equals the renderer's") {
    const Scene scene = mirrored_ball();
    const Image image = render(scene);
    CHECK(image.width == 70);
    CHECK(image.height == 50);
    CHECK(image.rgb == inner_pixels(scene));
    CHECK(image.at(0, 0) == Color{0.25F, 0.5F, 0.75F});
    const std::size_t pixel = 3 * (20 * 70 + 30);
    CHECK(image.at(30, 20) == Color{image.rgb[pixel], image.rgb[pixel + 1], image.rgb[pixel + 2]});
    CHECK(render(scene, {.threads = 3}).rgb == image.rgb);
}

TEST_CASE("settings can replace the scene's") {
    const Scene scene = mirrored_ball();
    Settings settings = scene.settings();
    settings.width = 7;
    settings.height = 5;
    const Image image = render(scene, {.settings = settings});
    CHECK(image.rgb.size() == 7 * 5 * 3);
    settings.grid = 0;
    CHECK(message_of([&] { render(scene, {.settings = settings}); }) ==
          "settings/grid: must be from 1 to 256, got 0");
    CHECK_THROWS_AS(render(scene, {.settings = settings}), InvalidValue);
    CHECK(message_of([&] { render(scene, {.threads = -1}); }) ==
          "threads: must be from 0 to 4096, got -1");
}

TEST_CASE("a scene without lights shows ambient light") {
    SceneBuilder builder;
    builder.settings.width = builder.settings.height = 9;
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({.ambient = 0.5F}));
    CHECK(render(builder.build()).at(4, 4) == Color{0.5F, 0.5F, 0.5F});
}

TEST_CASE("progress is reported in order up to the end") {
    const Scene scene = mirrored_ball();
    Progress last;
    int calls = 0;
    std::atomic<int> inside = 0;
    const auto image = render(scene, {.threads = 4}, [&](const Progress& progress) {
        CHECK(++inside == 1);
        CHECK(progress.pixels >= last.pixels);
        CHECK(progress.rays >= last.rays);
        CHECK(progress.total_pixels == 70 * 50);
        last = progress;
        ++calls;
        --inside;
        return true;
    });
    REQUIRE(image.has_value());
    CHECK(image->rgb == render(scene).rgb);
    CHECK(last.pixels == 70 * 50);
    CHECK(last.rays > 70 * 50);
    CHECK(calls > 1);
    CHECK(render(scene, {}, ProgressCallback())->rgb == image->rgb);
}

TEST_CASE("a rendering can be cancelled") {
    const Scene scene = mirrored_ball();
    int tiles = 0;
    render(scene, {}, [&](const Progress&) { return ++tiles > 0; });
    for (const int after : {1, 2, tiles})
        for (const int threads : {1, 4}) {
            int calls = 0;
            const auto image = render(scene, {.threads = threads},
                                      [&](const Progress&) { return ++calls < after; });
            CHECK(!image);
            CHECK(calls == after);
        }
}

TEST_CASE("a cancelled rendering ends soon") {
    const Scene scene = mirrored_ball();
    Settings settings = scene.settings();
    settings.width = settings.height = 1024; // takes minutes
    settings.grid = 64;
    CHECK(!render(scene, {.settings = settings}, [](const Progress&) { return false; }));
}

TEST_CASE("exceptions thrown by the progress callback propagate") {
    const Scene scene = mirrored_ball();
    int calls = 0;
    CHECK_THROWS_AS(render(scene, {.threads = 4},
                           [&](const Progress&) -> bool {
                               ++calls;
                               throw std::out_of_range("enough");
                           }),
                    std::out_of_range);
    CHECK(calls == 1);
}

TEST_CASE("a callback may use the library itself") {
    const Scene scene = mirrored_ball();
    const Tracer tracer(scene);
    const std::vector<float> zero(5000, 0.0F), five(5000, 5.0F), back(5000, -1.0F);
    const auto image = render(scene, {.threads = 3}, [&](const Progress&) {
        std::vector<std::uint8_t> hit(zero.size());
        tracer.occluded({zero, zero, five, zero, zero, back}, hit);
        return hit.front() == 1 && hit.back() == 1;
    });
    CHECK(image.has_value());
}

TEST_CASE("several images can be rendered at a time") {
    const Scene scene = mirrored_ball();
    const Image image = render(scene);
    std::vector<Image> images(4);
    {
        std::vector<std::jthread> threads;
        for (Image& own : images)
            threads.emplace_back([&] { own = render(scene, {.threads = 2}); });
    }
    for (const Image& own : images)
        CHECK(own.rgb == image.rgb);
}

TEST_CASE("an image is written in the format of the file's ending") {
    const tests::TemporaryDirectory directory;
    const Image image = render(mirrored_ball());
    for (const std::string name : {"a.pfm", "a.hdr", "a.png"}) {
        write_image(directory.path() / name, image);
        const scenes::Image read = scenes::read_image(directory.path() / name);
        CHECK(read.width == 70);
        CHECK(read.height == 50);
        if (name == "a.pfm") CHECK(read.rgb.floats() == image.rgb);
        if (name == "a.png") CHECK(read.rgb[0] * 255.0F == Approx(137.0F)); // 0.25 in sRGB
    }
    write_image(directory.path() / "linear.png", image, {.transfer = Transfer::linear});
    CHECK(scenes::read_image(directory.path() / "linear.png").rgb[0] * 255.0F == Approx(64.0F));
}

TEST_CASE("a PNG may have 16 bits and a resolution") {
    const tests::TemporaryDirectory directory;
    const Image image = render(mirrored_ball());
    write_image(directory.path() / "a.png", image, {.bits = 16, .dpi = 600});
    const scenes::Image read = scenes::read_image(directory.path() / "a.png");
    CHECK(read.rgb[0] * 65535.0F == Approx(35199.0F)); // 0.25 in sRGB
    const auto refusal = [&](const char* name, const ImageEncoding& encoding) {
        return message_of<InvalidValue>(
            [&] { write_image(directory.path() / name, image, encoding); });
    };
    CHECK(refusal("b.png", {.bits = 12}) == "bits: must be 8 or 16");
    CHECK(refusal("b.tga", {.bits = 16}) == "bits: must be 8, except in .png");
    CHECK(refusal("b.png", {.dpi = 0.5F}) == "dpi: must be from 1 to 10000, or 0 for none");
    CHECK(refusal("b.pfm", {.dpi = 300}) == "dpi: must be 0, except in .png");
    CHECK(directory.file_count() == 1);
}

TEST_CASE("an image with alpha has no background") {
    const Scene scene = mirrored_ball();
    Settings settings = scene.settings();
    settings.alpha = true;
    const Image image = render(scene, {.settings = settings});
    REQUIRE(image.alpha.size() == 70 * 50);
    CHECK(image.alpha[0] == 0.0F);
    CHECK(image.at(0, 0) == Color{0, 0, 0});
    CHECK(image.alpha[25 * 70 + 35] == 1.0F);
    CHECK(image.at(35, 25) == render(scene).at(35, 25));
    CHECK(render(scene).alpha.empty());

    std::vector<float> alpha(image.alpha.size());
    render(scene, {.settings = settings}, [&](const Progress& progress) {
        const Tile& tile = progress.tile;
        for (int row = 0; row < tile.height; ++row)
            std::copy_n(tile.alpha + static_cast<std::size_t>(row) * (tile.floats_a_row / 3),
                        tile.width, alpha.begin() + (tile.y + row) * 70 + tile.x);
        return true;
    });
    CHECK(alpha == image.alpha);

    const tests::TemporaryDirectory directory;
    write_image(directory.path() / "a.png", image);
    const scenes::Image read = scenes::read_image(directory.path() / "a.png");
    CHECK(read.alpha[0] == 0.0F);
    CHECK(read.alpha[25 * 70 + 35] == 1.0F);
    Image lacking = image;
    lacking.alpha.pop_back();
    CHECK(message_of([&] { write_image(directory.path() / "b.png", lacking); }) ==
          "alpha: must be empty, or one for each of 70 x 50 pixels, got 3499");
}

TEST_CASE("a crop has the pixels and AOVs of the whole image") {
    const Scene scene = mirrored_ball();
    const Image whole_image = render(scene, {.aovs = true});
    REQUIRE(whole_image.aovs.depth.size() == 70 * 50);
    CHECK(whole_image.aovs.shape_id[0] == no_shape);
    CHECK(whole_image.aovs.depth[0] == std::numeric_limits<float>::infinity());
    const std::size_t middle = 25 * 70 + 35;
    CHECK(whole_image.aovs.shape_id[middle] == 0);
    CHECK(whole_image.aovs.material[middle] == 0);
    CHECK(whole_image.aovs.samples[middle] == 1);
    const float* const normal = &whole_image.aovs.normal[3 * middle];
    CHECK(std::hypot(normal[0], normal[1], normal[2]) == Approx(1.0F).epsilon(1e-6));
    CHECK(render(scene).aovs.depth.empty());

    const PixelRect crop{30, 20, 11, 7};
    std::int64_t pixels = 0;
    const std::optional<Image> part =
        render(scene, {.crop = crop, .aovs = true}, [&](const Progress& progress) {
            CHECK(progress.total_pixels == 11 * 7);
            CHECK((progress.tile.x >= 30 && progress.tile.y >= 20)); // in the whole image
            pixels = progress.pixels;
            return true;
        });
    CHECK(pixels == 11 * 7);
    REQUIRE(part);
    CHECK((part->width == 11 && part->height == 7));
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 11; ++x) {
            CHECK(part->at(x, y) == whole_image.at(30 + x, 20 + y));
            CHECK(part->aovs.depth[static_cast<std::size_t>(y * 11 + x)] ==
                  whole_image.aovs.depth[static_cast<std::size_t>((20 + y) * 70 + 30 + x)]);
        }
    constexpr int most = std::numeric_limits<int>::max();
    for (const PixelRect& outside : {PixelRect{0, 0, 71, 1},
                                     {0, 0, 1, 0},
                                     {-1, 0, 2, 2},
                                     {69, 49, 1, 2},
                                     {1, 1, most, most},
                                     {most, most, 1, 1}})
        CHECK(message_of<InvalidValue>([&] { render(scene, {.crop = outside}); }) ==
              "crop: must lie within the image");
}

TEST_CASE("images that cannot be written leave no file") {
    const tests::TemporaryDirectory directory;
    const Image image = render(mirrored_ball());
    const std::string folder = directory.path().string();
    CHECK_THROWS_AS(write_image(folder + "/a.gif", image), BadInput);
    CHECK(message_of([&] { write_image(folder + "/a.gif", image); }) ==
          folder + "/a.gif: must end in .png, .hdr, .pfm, .tga, .bmp or .ppm, got \".gif\"");
    CHECK_THROWS_AS(write_image(folder + "/none/a.png", image), SystemRefused);
    Image lacking = image;
    lacking.rgb.pop_back();
    CHECK(message_of([&] { write_image(folder + "/a.png", lacking); }) ==
          "rgb: must be 3 components for each of 70 x 50 pixels, got 10499");
    CHECK(message_of([&] { write_image(folder + "/a.png", Image{}); }) ==
          "width: must be from 1 to 65535, got 0");
    CHECK(message_of([&] {
              write_image(folder + "/a.png", Image{1, -1, {}});
          }) == "height: must be from 1 to 65535, got -1");
    CHECK(directory.file_count() == 0);
}

TEST_CASE("the callback receives each tile of an image once") {
    const Scene scene = mirrored_ball();
    Image put_together{70, 50, std::vector<float>(std::size_t{3} * 70 * 50, -1.0F)};
    std::int64_t pixels = 0;
    const std::optional<Image> image = render(scene, {.threads = 3}, [&](const Progress& progress) {
        const Tile& tile = progress.tile;
        for (int row = 0; row < tile.height; ++row)
            for (int column = 0; column < tile.width; ++column) {
                const Color color = tile.at(column, row);
                float* pixel =
                    put_together.rgb.data() + 3 * ((tile.y + row) * 70 + tile.x + column);
                CHECK(pixel[0] == -1.0F);
                pixel[0] = color.x;
                pixel[1] = color.y;
                pixel[2] = color.z;
                ++pixels;
            }
        return true;
    });
    REQUIRE(image);
    CHECK(pixels == 70 * 50);
    CHECK(put_together.rgb == image->rgb);
}

TEST_CASE("an invalid transfer is refused when an image is written") {
    CHECK(message_of<InvalidValue>([&] {
              write_image("none.png", {1, 1, {0, 0, 0}}, {.transfer = static_cast<Transfer>(2)});
          }) == "transfer: must be a Transfer");
}
