#include "core/scene/transfer.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/writer.hpp"
#include "tests/scenes/images/png_chunk.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <bit>
#include <zlib.h>

using namespace raylane;
using namespace raylane::tests;

namespace {

Outcome verify(const ToolFixture& fixture, const std::string& image, const Options& options = {}) {
    return fixture.run(joined({"verify", image, "scene.json", "--quiet"}, options));
}

constexpr const char* right =
    "scene      same as the image names\n"
    "options    same as the image names\n"
    "pixels     192 rendered again by the reference: 192 equal, 0 within one step, 0 different\n";

constexpr const char* again = "rays       same counts as the image states\n"
                              "all bits   same as in the image\n";

/// Returns a film with the codes of a PNG. The codes of the first `pixels` pixels are changed by
/// one step.
core::Film film_of(const scenes::Image& image, int pixels = 0) {
    core::Film film(image.width, image.height);
    for (int i = 0; i < image.width * image.height; ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float code = 255.0F * image.rgb[static_cast<std::size_t>(3 * i + channel)] + 0.5F;
            const int step = i >= pixels ? 0 : code < 255.0F ? 1 : -1;
            film.at(i % image.width, i / image.width)[channel] =
                core::decode_srgb(static_cast<std::uint8_t>(static_cast<int>(code) + step));
        }
    return film;
}

/// Writes a PNG again without its alpha, with the codes of its first `pixels` changed by one step,
/// and with other texts.
template <class Texts>
void write_again(const std::filesystem::path& from, const std::filesystem::path& to, Texts texts,
                 int pixels = 0) {
    const scenes::Image image = scenes::read_image(from);
    const core::Film film = film_of(image, pixels);
    scenes::OutputFile(to).commit(film, {.texts = texts(image.texts)});
}

/// Writes an image again with one pixel inverted and with its texts.
void turn_one_over(const std::filesystem::path& path) {
    const scenes::Image image = scenes::read_image(path);
    core::Film film = film_of(image);
    core::Color& one = film.at(3, 4);
    one = core::Color(1.0F) - one;
    scenes::OutputFile(path).commit(film, {.texts = image.texts});
}

} // namespace

TEST_CASE("an image records how its rays were decided") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png", {"--stats", "a.json", "--size", "100x80"}).code == 0);
    const auto stats = nlohmann::json::parse(content_of(fixture.path() / "a.json"));
    const scenes::Image image = scenes::read_image(fixture.path() / "a.png");
    const auto rays = std::find_if(image.texts.begin(), image.texts.end(),
                                   [](const auto& text) { return text.first == "Rays"; });
    REQUIRE(rays != image.texts.end());
    const auto number = [&](const char* key) { return stats[key].get<std::uint64_t>(); };
    const std::uint64_t refined = number("rays_refined");
    const std::uint64_t left = stats["left_to_the_reference"]["rays"].get<std::uint64_t>();
    const std::uint64_t paths = stats["left_to_the_reference"]["paths"].get<std::uint64_t>();
    const std::uint64_t total = stats["rays"]["total"].get<std::uint64_t>();
    CHECK(total > 8000);
    CHECK(rays->second ==
          std::to_string(total - refined - left) + " at first sight, " + std::to_string(refined) +
              " at second, " + std::to_string(left + paths) + " by the reference, " +
              std::to_string(number("tests_beyond_double")) + " tests beyond double");
}

TEST_CASE("verify reproduces each pixel of an image from its scene and options") {
    const ToolFixture fixture;
    for (const Options& options : {Options{},
                                   {"--spp", "9", "--max-depth", "2"},
                                   {"--transfer", "linear", "--bits", "16"},
                                   {"--alpha"},
                                   {"--outline", "1.5", "--outline-color", "#ff0000"},
                                   {"--view", "top", "--depth-cue", "0.5"},
                                   {"--quality", "35"},
                                   {"--engine", "reference"}}) {
        CAPTURE(options);
        REQUIRE(fixture.render("a.png", options).code == 0);
        const Outcome outcome = verify(fixture, "a.png");
        CHECK(outcome.out == right);
        CHECK(outcome.code == 0);
        CHECK(verify(fixture, "a.png", {"--whole"}).out == right + std::string(again));
    }
    REQUIRE(fixture.render("a.png", {"--crop", "3,4,5x6"}).code == 0);
    CHECK(verify(fixture, "a.png", {"--pixels", "7"}).out.find("7 equal") != std::string::npos);
    if (!scenes::has_exr()) return;
    for (const Options& options : {Options{}, {"--bits", "32", "--aovs"}, {"--alpha"}}) {
        CAPTURE(options);
        REQUIRE(fixture.render("a.exr", options).code == 0);
        CHECK(verify(fixture, "a.exr", {"--whole"}).out == right + std::string(again));
    }
}

namespace {

/// Returns the value with its lowest bit flipped: that of a float, or of a half, which has 13 bits
/// fewer.
float with_another_bit(float value, int fewer_bits) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1U << fewer_bits);
}

} // namespace

TEST_CASE("verify finds one changed bit in each format") {
    const ToolFixture fixture;
    const auto others = [&](const std::string& name) {
        const Outcome outcome = verify(fixture, name, {"--whole", "--pixels", "1"});
        CHECK(outcome.code == 1);
        CHECK(outcome.out.ends_with("all bits   differ from the image\n"));
    };
    {
        REQUIRE(fixture.render("a.png", {"--bits", "16", "--transfer", "linear"}).code == 0);
        const scenes::Image image = scenes::read_image(fixture.path() / "a.png");
        core::Film film(image.width, image.height);
        for (std::size_t i = 0; i < film.pixels().size(); ++i)
            for (std::size_t channel = 0; channel < 3; ++channel)
                film.at(static_cast<int>(i) % image.width,
                        static_cast<int>(i) / image.width)[static_cast<int>(channel)] =
                    image.rgb[3 * i + channel];
        scenes::ImageOptions options{core::Transfer::linear, 16, {}, image.texts};
        scenes::OutputFile(fixture.path() / "a.png").commit(film, options);
        CHECK(verify(fixture, "a.png", {"--whole"}).out == right + std::string(again));
        core::Color& one = film.at(3, 4);
        one.y += one.y > 0.5F ? -1.0F / 65535.0F : 1.0F / 65535.0F;
        scenes::OutputFile(fixture.path() / "a.png").commit(film, options);
        others("a.png");
        // A step of 8 bits is 257 steps of 16 bits.
        one.y += one.y > 0.5F ? -0.5F / 255.0F : 0.5F / 255.0F;
        scenes::OutputFile(fixture.path() / "a.png").commit(film, options);
        CHECK(verify(fixture, "a.png").out.find("191 equal, 0 within one step, 1 different") !=
              std::string::npos);
    }
    if (!scenes::has_exr()) return;
    for (const int bits : {16, 32}) {
        CAPTURE(bits);
        REQUIRE(fixture.render("a.exr", {"--bits", std::to_string(bits), "--aovs"}).code == 0);
        scenes::ExrImage image = scenes::read_own_exr(fixture.path() / "a.exr");
        scenes::ImageOptions options{.bits = bits, .texts = image.texts};
        const auto written = [&] {
            fixture.write("a.exr", scenes::exr_of(image.film, &*image.aovs, options));
        };
        written();
        CHECK(verify(fixture, "a.exr", {"--whole"}).out == right + std::string(again));
        float& number = image.film.at(7, 5).x;
        const float right_number = number;
        number = with_another_bit(number, bits == 16 ? 13 : 0);
        written();
        others("a.exr");
        number = right_number;
        core::Aovs& aovs = *image.aovs;
        const std::size_t pixel = aovs.index(8, 6);
        for (float* const value : {&aovs.depth[pixel], &aovs.normal[pixel].y}) {
            const float before = *value;
            *value = with_another_bit(before, 0);
            written();
            others("a.exr");
            *value = before;
        }
        for (std::uint32_t* const value :
             {&aovs.shape[pixel], &aovs.material[pixel], &aovs.samples[pixel]}) {
            *value ^= 1U;
            written();
            others("a.exr");
            *value ^= 1U;
        }
        for (auto& [key, text] : options.texts)
            if (key == "Rays") text = "all of them, by magic";
        written();
        others("a.exr");
    }
}

TEST_CASE("verify detects a changed pixel and a changed scene") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    turn_one_over(fixture.path() / "a.png");
    const Outcome changed = verify(fixture, "a.png");
    CHECK(changed.code == 1);
    CHECK(changed.out == "scene      same as the image names\n"
                         "options    same as the image names\n"
                         "pixels     192 rendered again by the reference: 191 equal, 0 within one "
                         "step, 1 different\n"
                         "first      at pixel 3, 4\n");

    REQUIRE(fixture.render("a.png").code == 0);
    std::string scene = ball;
    scene.replace(scene.find("0.5]"), 4, "0.4]");
    fixture.write("scene.json", scene);
    const Outcome other = verify(fixture, "a.png", {"--whole"});
    CHECK(other.code == 1);
    CHECK(other.out == "scene      differs from the one that the image names\n");
}

TEST_CASE("an image records options that override its scene and the precision") {
    std::string scene = ball;
    scene.insert(1, R"("outline": {"width": 2, "color": [0.2003, 0.5, 7]},
                       "limits": {"max_transparent": 1},)");
    scene.insert(scene.find(R"("height": 12)"), R"("transfer": "linear", )");
    const ToolFixture fixture(scene);
    for (const Options& options : {Options{},
                                   {"--outline", "0"},
                                   {"--transfer", "srgb"},
                                   {"--outline-color", "#00ff00"},
                                   {"--max-transparent", "1000"},
                                   {"--precision", "double"},
                                   {"--precision", "robust"}}) {
        CAPTURE(options);
        REQUIRE(fixture.render("a.png", options).code == 0);
        const Outcome outcome = verify(fixture, "a.png", {"--whole"});
        CHECK(outcome.out.ends_with("all bits   same as in the image\n"));
        CHECK(outcome.code == 0);
    }
    if (!scenes::has_exr()) return;
    REQUIRE(fixture.render("a.exr").code == 0);
    CHECK(verify(fixture, "a.exr").code == 0);
}

TEST_CASE("verify renders an image with its own precision") {
    const ToolFixture fixture(
        R"({"image": {"width": 61, "height": 43}, "background": [0.5, 0.6, 0.8],
        "camera": {"from": [200000, 100000, 300000], "at": [0, 0, 0], "field_of_view": 0.001},
        "lights": [{"type": "point", "position": [40, 60, 50]}],
        "objects": [{"type": "sphereflake", "material": {"color": [0.9, 0.6, 0.3],
                     "reflectivity": 0.5}, "center": [0, 0, 0], "radius": 1, "depth": 3}]})");
    REQUIRE(fixture.render("exact.png").code == 0);
    for (const Options& options : {Options{"--precision", "robust"},
                                   {"--precision", "fast"},
                                   {"--precision", "double"},
                                   {"--precision", "robust", "--engine", "reference"},
                                   {"--precision", "fast", "--bits", "16", "--tile", "17"}}) {
        CAPTURE(options);
        REQUIRE(fixture.render("a.png", options).code == 0);
        const std::string pixels =
            "rendered again by the precision of the image: 500 equal, 0 within "
            "one step, 0 different\n";
        const Outcome outcome = verify(fixture, "a.png", {"--whole", "--pixels", "500"});
        CHECK(outcome.out.find(pixels) != std::string::npos);
        CHECK(outcome.code == 0);
        // Otherwise this scene would prove nothing.
        if (options.size() == 2 && options[1] != "double")
            CHECK(fixture.run({"compare", "a.png", "exact.png"}).code == 1);
    }
    turn_one_over(fixture.path() / "a.png");
    const Outcome turned = verify(fixture, "a.png", {"--pixels", "2623"});
    CHECK(turned.code == 1);
    CHECK(turned.out.find("first      at pixel 3, 4\n") != std::string::npos);
}

TEST_CASE("A PNG with a chunk that raylane does not write is refused") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png", {"--dpi", "300"}).code == 0);
    const std::string image = content_of(fixture.path() / "a.png");
    const auto with = [&](const std::string& chunks, std::size_t place) {
        std::string changed = image;
        fixture.write("b.png", changed.insert(place, chunks));
        return verify(fixture, "b.png", {"--pixels", "2"});
    };
    const std::size_t header = 8 + 12 + 13, end = image.size() - 12;
    REQUIRE(image.substr(header + 4, 4) == "pHYs");
    const auto refused = [&](const std::string& type, const std::string& chunks,
                             std::size_t place) {
        CAPTURE(type);
        const Outcome outcome = with(chunks, place);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err == "raylane: b.png: must have only chunks that raylane writes, because "
                             "others may change its appearance, got " +
                                 type + "\n");
    };
    const std::string zero(1, '\0');
    CHECK(with("", header).code == 0);
    refused("tEXt Author", png_chunk("tEXt", "Author" + zero + "me"), header);
    refused("tEXt Raw profile type exif",
            png_chunk("tEXt", "Raw profile type exif" + zero + "\nexif\n0\n"), header);
    refused("tEXt Comment", png_chunk("tEXt", "Comment" + zero + "other"), end);
    refused("iTXt XML:com.adobe.xmp",
            png_chunk("iTXt", "XML:com.adobe.xmp" + std::string(5, '\0') + "<x/>"), header);
    refused("gAMA", png_chunk("gAMA", big_endian(500'000)), header);
    std::string chromaticities;
    for (const std::uint32_t number : {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000})
        chromaticities += big_endian(number);
    refused("cHRM", png_chunk("cHRM", chromaticities), header);
    refused("sRGB", png_chunk("sRGB", zero), header);
    refused("tRNS", png_chunk("tRNS", std::string(6, '\0')), header);
    refused("bKGD", png_chunk("bKGD", std::string(6, '\0')), header);
    refused("eXIf", png_chunk("eXIf", std::string("MM\0*\0\0\0\10\0\0\0\0\0\0", 14)), header);
    refused("acTL", png_chunk("acTL", big_endian(1) + big_endian(0)), header);
    refused("fcTL", png_chunk("fcTL", std::string(26, '\0')) + png_chunk("fdAT", "0123"), end);
    // Pixels that are not square.
    std::string wide = image;
    wide.replace(header, 12 + 9, png_chunk("pHYs", big_endian(2) + big_endian(1) + "\1"));
    fixture.write("b.png", wide);
    CHECK(verify(fixture, "b.png").err.ends_with(", got pHYs\n"));
}

TEST_CASE("the option --whole checks the whole image for any choice of pixels") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    turn_one_over(fixture.path() / "a.png");
    int found = 0;
    for (int seed = 0; seed < 4; ++seed) {
        const Outcome outcome =
            verify(fixture, "a.png", {"--whole", "--pixels", "2", "--seed", std::to_string(seed)});
        CHECK(outcome.code == 1);
        CHECK(outcome.out.ends_with("all bits   differ from the image\n"));
        found += outcome.out.find("2 equal") != std::string::npos ? 1 : 0;
    }
    CHECK(found > 0);
}

TEST_CASE("the pixels that verify renders are random or follow from a seed") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    turn_one_over(fixture.path() / "a.png");
    int found = 0;
    for (int i = 0; i < 20; ++i) {
        const Outcome outcome =
            verify(fixture, "a.png", {"--pixels", "96", "--seed", std::to_string(i)});
        CHECK(outcome.out ==
              verify(fixture, "a.png", {"--pixels", "96", "--seed", std::to_string(i)}).out);
        found += outcome.code;
    }
    CHECK(found > 2);
    CHECK(found < 18);
}

TEST_CASE("verify renders each image of a sequence by itself") {
    const ToolFixture fixture(R"({"image": {"width": 16, "height": 12}, "camera": "auto",
        "parameters": {"r": 1},
        "objects": [{"type": "sphere", "material": {"color": [1, 0, 0]}, "center": [0, 0, 0], "radius": "$r"},
                    {"type": "sphere", "material": {}, "center": [1, 0, 1], "radius": 1}]})");
    std::string atoms;
    for (const char* at : {"1", "2", "4"})
        atoms += std::string("3\n\nO 0 0 0\nH ") + at + " 0 0\nH 0 " + at + " 0\n";
    fixture.write("move.xyz", atoms);
    struct Film {
        const char* scene;
        Options options;
        int count;
    };
    for (const Film& film :
         {Film{"scene.json", {"--turn", "90/3"}, 3}, Film{"scene.json", {"--set", "r=1:2:3"}, 3},
          Film{"scene.json", {"--set", "r=1:2:3", "--camera-from", "all", "--turn", "360/3"}, 3},
          Film{"scene.json", {"--set", "r=1:2:3", "--camera-from", "each", "--spp", "9"}, 3},
          Film{"move.xyz", {"--frames", ":", "--size", "16x12", "--spp", "4"}, 3},
          Film{"move.xyz", {"--frames", "-2:", "--size", "16x12", "--spp", "4", "--alpha"}, 3},
          Film{"move.xyz", {"--frames", ":", "--size", "16x12", "--camera-from", "all"}, 3}}) {
        CAPTURE(film.scene, film.options);
        REQUIRE(
            fixture
                .run(joined({"render", film.scene, "-o", "f%d.png", "--overwrite"}, film.options))
                .code == 0);
        for (int i = 0; i < film.count; ++i) {
            const std::string name = "f" + std::to_string(i) + ".png";
            if (!std::filesystem::exists(fixture.path() / name)) continue; // frames -2:
            const Outcome outcome = fixture.run({"verify", name, film.scene, "--quiet", "--whole"});
            CHECK(outcome.out == right + std::string(again));
            CHECK(outcome.code == 0);
        }
        // An image with the place of another in its sequence is not confirmed.
        scenes::ImageOptions swapped;
        const scenes::Image last = scenes::read_image(fixture.path() / "f2.png");
        swapped.texts = last.texts;
        for (auto& [key, text] : swapped.texts)
            if (key == "Film") text = "0";
        core::Film pixels(last.width, last.height);
        scenes::OutputFile(fixture.path() / "other.png").commit(pixels, swapped);
        CHECK(fixture.run({"verify", "other.png", film.scene, "--quiet"}).code == 1);
        for (const char* place : {"3", "-1", "one", ""}) {
            for (auto& [key, text] : swapped.texts)
                if (key == "Film") text = place;
            scenes::OutputFile(fixture.path() / "other.png").commit(pixels, swapped);
            const Outcome outcome = fixture.run({"verify", "other.png", film.scene, "--quiet"});
            CAPTURE(place, outcome.err);
            CHECK(outcome.code == 2);
            CHECK(is_one_line(outcome.err));
            if (std::string(place) == "3")
                CHECK(outcome.err ==
                      std::string("raylane: other.png: is image 4 of its sequence, but ") +
                          film.scene + " has fewer\n");
        }
        for (int i = 0; i < film.count; ++i)
            std::filesystem::remove(fixture.path() / ("f" + std::to_string(i) + ".png"));
    }

    // Images of different sizes with the camera of the first.
    fixture.write("wide.json", R"({"image": {"width": "$w", "height": 12}, "camera": "auto",
        "parameters": {"w": 16},
        "objects": [{"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})");
    REQUIRE(fixture.run({"render", "wide.json", "-o", "w%d.png", "--set", "w=6:40:3"}).code == 0);
    for (const char* name : {"w0.png", "w1.png", "w2.png"})
        CHECK(fixture.run({"verify", name, "wide.json", "--quiet", "--whole"}).code == 0);

    // Frames after the image are not read.
    fixture.write("broken.xyz", atoms + "3\n\nO here 0 0\n");
    const Options first = {"--size", "16x12", "--spp", "1", "--frames", ":"};
    CHECK(fixture.run(joined({"render", "broken.xyz", "-o", "b%d.png"}, first)).code == 2);
    CHECK(fixture.run({"verify", "b1.png", "broken.xyz", "--quiet"}).code == 0);
}

TEST_CASE("verify takes the light samples of the image, not of the scene") {
    std::string scene = ball;
    scene.insert(scene.find("\"image\""), R"("sampling": {"light_samples": 3}, )");
    const ToolFixture fixture(scene);
    REQUIRE(fixture.render("a.png", {"--light-samples", "0"}).code == 0);
    CHECK(verify(fixture, "a.png").out == right);
}

TEST_CASE("settings that no Comment has belong to the options of an image") {
    const auto with = [](const std::string& where, const std::string& what) {
        std::string scene = ball;
        return scene.insert(scene.find(where), what);
    };
    const std::string outlined = with("\"image\"", R"("outline": {"width": 3}, )");
    const ToolFixture fixture(outlined);
    for (const std::string& other :
         {with("\"image\"", R"("outline": {"width": 3, "color": "#ff0000"}, )"),
          with("\"image\"", R"("outline": {"width": 3, "creases": 20}, )"),
          with("\"image\"",
               R"("outline": {"width": 3}, "sampling": {"pattern": "stratified"}, )")}) {
        REQUIRE(fixture.render("a.png").code == 0);
        fixture.write("scene.json", other);
        // For any pixel that is chosen.
        const Outcome outcome = verify(fixture, "a.png", {"--pixels", "1"});
        CHECK(outcome.code == 1);
        CHECK(outcome.out.starts_with("scene      same as the image names\n"
                                      "options    differ from those that the image names\n"));
        fixture.write("scene.json", outlined);
        CHECK(verify(fixture, "a.png").out == right);
    }
    // Settings without an effect do not belong to the options.
    fixture.write("scene.json", ball);
    REQUIRE(fixture.render("a.png", {"--quality", "35"}).code == 0);
    fixture.write("scene.json", with("\"image\"", R"("sampling": {"grid": 3},
                                       "outline": {"width": 0, "creases": 20}, )"));
    CHECK(verify(fixture, "a.png", {"--whole"}).out == right + std::string(again));
    fixture.write("scene.json", ball);
    REQUIRE(fixture.render("a.png").code == 0);
    const auto without = [](auto texts) {
        std::erase_if(texts, [](const auto& text) { return text.first == "Options"; });
        return texts;
    };
    write_again(fixture.path() / "a.png", fixture.path() / "a.png", without);
    CHECK(verify(fixture, "a.png").err.ends_with("got one without Options\n"));
}

/// Light passes the box along its diagonal plane, and meets its edges to the last bit.
TEST_CASE("verify distinguishes ties in the last bit from errors") {
    const ToolFixture fixture(R"({"image": {"width": 64, "height": 64}, "background": [0.5, 0.5, 1],
        "camera": {"from": [0, 0, 6], "at": [0, 0, 0]},
        "lights": [{"type": "point", "position": [4, 4, 4]}],
        "materials": {"see": {"color": [1, 0, 0], "opacity": 0.5}},
        "objects": [{"type": "box", "material": "see", "corner": [0, -2, 2],
                     "edges": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}]})");
    REQUIRE(fixture.render("p.png", {"--spp", "4"}).code == 0);
    const Outcome outcome = verify(fixture, "p.png", {"--pixels", "4096"});
    CAPTURE(outcome.out);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find(" 0 different\n") == std::string::npos); // this scene has ties
    CHECK(outcome.out.find("\nties       ") != std::string::npos);

    turn_one_over(fixture.path() / "p.png");
    const Outcome turned = verify(fixture, "p.png", {"--pixels", "4096"});
    CHECK(turned.code == 1);
    CHECK(turned.out.find("\nfirst      at pixel ") != std::string::npos);
}

TEST_CASE("verify does not confirm an image that has lost its alpha") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png", {"--alpha"}).code == 0);
    const auto same = [](auto texts) { return texts; };
    write_again(fixture.path() / "a.png", fixture.path() / "a.png", same);
    REQUIRE(scenes::read_image(fixture.path() / "a.png").alpha.size() == 0);
    const Outcome outcome = verify(fixture, "a.png");
    CHECK(outcome.code == 1);
    CHECK(outcome.out.find("0 equal, 0 within one step, 192 different") != std::string::npos);
}

TEST_CASE("verify does not confirm an image with many pixels one step off") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    const auto same = [](auto texts) { return texts; };
    const std::filesystem::path a = fixture.path() / "a.png", b = fixture.path() / "b.png";
    for (const auto& [pixels, code] : {std::pair{3, 0}, {4, 1}, {192, 1}}) {
        write_again(a, b, same, pixels);
        const Outcome outcome = verify(fixture, "b.png");
        CAPTURE(pixels, outcome.out);
        CHECK(outcome.code == code);
        CHECK(outcome.out.find(" equal, " + std::to_string(pixels) +
                               " within one step, 0 different\n") != std::string::npos);
        CHECK(outcome.out.ends_with("steps      more than 1 pixel in 50 differs by one step, more "
                                    "than rounding causes\n") == (code == 1));
    }
    // Two of a few pixels may be one step off.
    write_again(a, b, same, 192);
    CHECK(verify(fixture, "b.png", {"--pixels", "2"}).code == 0);
    CHECK(verify(fixture, "b.png", {"--pixels", "3"}).code == 1);
}

TEST_CASE("images without valid texts give an error of one line") {
    const ToolFixture fixture;
    const auto refused = [&](const std::string& name, const std::string& with) {
        const Outcome outcome = verify(fixture, name);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(is_one_line(outcome.err));
        CAPTURE(outcome.err);
        CHECK(outcome.err.find(with) != std::string::npos);
    };
    REQUIRE(fixture.render("a.pfm").code == 0);
    refused("a.pfm",
            "a.pfm: must be a PNG, TIFF or EXR rendered by raylane, which names its scene and "
            "options, got one without Comment");
    refused("none.png", "none.png: no such file");
    const auto with_comment = [&](const std::string& comment) {
        scenes::OutputFile(fixture.path() / "b.png")
            .commit(core::Film(16, 12), {.texts = {{"Comment", comment}, {"Scene", "0"}}});
    };
    with_comment("made by hand");
    refused("b.png", "b.png: has a Comment that is not a list of options of render");
    for (const char* comment :
         {"--bogus", "--spp 4 --bogus", "--spp 4 --bogus=3", "--spp 4 -z", "--spp 4 other.json",
          "--bogus 3", "--spp 4 --spp 4", "--spp 4 --stats a.json"}) {
        with_comment(comment);
        refused("b.png", "b.png: has a Comment that is not a list of options of render");
    }
    with_comment("--help");
    refused("b.png", "b.png: has a Comment that is not a list of options of render");
    with_comment("--size 5000x5000");
    refused("b.png", "b.png: has another size than its Comment states");
    with_comment("--spp 7");
    refused("b.png", "--spp: must be");
    CHECK(verify(fixture, "b.png", {"--pixels", "0"}).err.find("--pixels: must be") !=
          std::string::npos);
}
