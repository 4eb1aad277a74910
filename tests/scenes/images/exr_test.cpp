#include "scenes/files/errors.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/images/writer.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/images/little_memory.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <limits>
#include <random>

using namespace raylane;
using tests::TemporaryDirectory;

namespace {

core::Film little_film() {
    core::Film film(3, 2);
    film.at(0, 0) = {0.5F, 0.25F, 1e-3F};
    film.at(1, 0) = {1e6F, -1e6F, 2.0F};
    film.at(2, 1) = {0.1F, 0.2F, 0.3F};
    return film;
}

} // namespace

TEST_CASE("an output file without an EXR encoder refuses the ending .exr") {
    const TemporaryDirectory directory;
    CHECK_THROWS_AS(scenes::OutputFile(directory.path() / "a.exr"), scenes::BadInput);
    CHECK(directory.names().empty());
}

#ifdef RAYLANE_WITH_OPENEXR

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

TEST_CASE("an EXR holds the film's floats or the nearest halves") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out.exr";
    const core::Film film = little_film();
    for (const int bits : {0, 16, 32}) {
        scenes::OutputFile(path, scenes::more_encoders).commit(film, {.bits = bits});
        const scenes::Image image = scenes::read_image(path);
        CHECK(image.linear_float);
        REQUIRE(image.rgb.size() == 3 * film.pixels().size());
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            const float meant = film.pixels()[i / 3][static_cast<int>(i % 3)];
            if (bits == 32)
                CHECK(image.rgb[i] == meant);
            else // values beyond the range of half become its largest
                CHECK(std::abs(image.rgb[i] - std::clamp(meant, -65504.0F, 65504.0F)) <=
                      0x1p-11F * std::abs(meant));
        }
    }
    CHECK(directory.file_count() == 1);
}

TEST_CASE("an EXR has a film's alpha and colors multiplied by it") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out.exr";
    core::Film film(2, 1, /*with_alpha=*/true);
    film.at(0, 0) = {0.5F, 0.25F, 0.125F};
    film.alpha_at(0, 0) = 0.5F;
    for (const int bits : {16, 32}) {
        scenes::OutputFile(path, scenes::more_encoders).commit(film, {.bits = bits});
        const scenes::Image image = scenes::read_image(path);
        CHECK(image.rgb.floats() == std::vector<float>{0.5F, 0.25F, 0.125F, 0, 0, 0});
        CHECK(image.alpha.floats() == std::vector<float>{0.5F, 0});
        const Imf::InputFile file(path.c_str());
        CHECK(file.header().channels()["A"].type == (bits == 32 ? Imf::FLOAT : Imf::HALF));
    }
}

TEST_CASE("an EXR has the AOVs and the resolution and texts of the options") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "out.exr";
    core::Aovs aovs(3, 2);
    aovs.depth[4] = 2.5F;
    aovs.normal[4] = {0.0F, 0.6F, -0.8F};
    aovs.shape[4] = 16'777'217; // not a float
    aovs.material[4] = 7;
    aovs.samples[4] = 16;
    const scenes::ImageOptions options{.dpi = 300.0F,
                                       .texts = {{"Software", "raylane"}, {"Comment", "--spp 16"}}};
    scenes::OutputFile(path, scenes::more_encoders).commit(little_film(), options, &aovs);

    Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    CHECK(Imf::xDensity(header) == 300.0F);
    CHECK(Imf::comments(header) == "--spp 16");
    CHECK(header.typedAttribute<Imf::StringAttribute>("software").value() == "raylane");
    int channels = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        ++channels;
    CHECK(channels == 10);

    std::vector<float> depth(6), normal(6);
    std::vector<std::uint32_t> shape(6), material(6), samples(6);
    Imf::FrameBuffer buffer;
    const auto add = [&](const char* name, Imf::PixelType type, auto& values) {
        REQUIRE(header.channels().findChannel(name) != nullptr);
        CHECK(header.channels()[name].type == type);
        buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(values.data()), 4, 12));
    };
    add("Z", Imf::FLOAT, depth);
    add("N.Z", Imf::FLOAT, normal);
    add("id.shape", Imf::UINT, shape);
    add("id.material", Imf::UINT, material);
    add("samples", Imf::UINT, samples);
    file.setFrameBuffer(buffer);
    file.readPixels(0, 1);
    CHECK(depth == aovs.depth);
    CHECK(depth[0] == std::numeric_limits<float>::infinity());
    CHECK(normal[4] == -0.8F);
    CHECK(shape == aovs.shape);
    CHECK(shape[0] == 4294967295U);
    CHECK(material == aovs.material);
    CHECK(samples == aovs.samples);
}

TEST_CASE("An EXR with attributes or channels that raylane does not write is refused as foreign") {
    const TemporaryDirectory directory;
    const auto own = directory.path() / "own.exr", path = directory.path() / "a.exr";
    const core::Aovs aovs(3, 2);
    const scenes::ImageOptions options{.dpi = 300.0F,
                                       .texts = {{"Software", "raylane"}, {"Comment", "--spp 16"}}};
    scenes::OutputFile(own, scenes::more_encoders).commit(little_film(), options, &aovs);
    const auto complaint = [&](const auto& change) {
        Imf::InputFile from(own.c_str());
        Imf::Header header = from.header();
        change(header);
        {
            Imf::OutputFile to(path.c_str(), header);
            to.copyPixels(from);
        }
        return tests::message_of<scenes::BadInput>([&] { scenes::read_own_exr(path); });
    };
    using Header = Imf::Header;
    const auto insert = [](const char* name, const auto& attribute) {
        return [=](Header& header) { header.insert(name, attribute); };
    };
    const std::string refused = path.string() + ": must be an EXR rendered by raylane";
    CHECK(complaint([](const Header&) {}) == "no error");
    CHECK(complaint(insert("author", Imf::StringAttribute("me"))) == "no error");
    CHECK(complaint(insert("colorInteropID", Imf::StringAttribute("lin_ap0"))) == refused);
    CHECK(complaint(insert("any", Imf::FloatAttribute(1.0F))) == refused);
    CHECK(complaint([](Header& header) { Imf::addChromaticities(header, {}); }) == refused);
    CHECK(complaint([](Header& header) { Imf::addWhiteLuminance(header, 80.0F); }) == refused);
    CHECK(complaint([](Header& header) { header.pixelAspectRatio() = 2.0F; }) == refused);
    CHECK(complaint([](Header& header) { header.displayWindow().max.x = 1; }) == refused);
    // Another channel, which a copy of the pixels cannot add.
    Header header(3, 2);
    for (const char* name : {"R", "G", "B", "left.R"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    std::vector<float> values(6);
    Imf::FrameBuffer buffer;
    for (const char* name : {"R", "G", "B", "left.R"})
        buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 12));
    {
        Imf::OutputFile to(path.c_str(), header);
        to.setFrameBuffer(buffer);
        to.writePixels(2);
    }
    CHECK(tests::message_of<scenes::BadInput>([&] { scenes::read_own_exr(path); }) == refused);
}

TEST_CASE("an EXR without colors or with fewer samples than pixels is refused before it is read") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "a.exr";
    const auto complaint = [&](const char* name, int sampling) {
        Imf::Header header(64, 64);
        header.channels().insert(name, Imf::Channel(Imf::HALF, sampling, sampling));
        if (*name != 'q')
            for (const char* other : {"R", "B"})
                header.channels().insert(other, Imf::Channel(Imf::HALF));
        std::vector<half> zeros(64 * 64);
        Imf::FrameBuffer buffer;
        for (auto channel = header.channels().begin(); channel != header.channels().end();
             ++channel)
            buffer.insert(channel.name(),
                          Imf::Slice(Imf::HALF, reinterpret_cast<char*>(zeros.data()), sizeof(half),
                                     64 * sizeof(half), channel.channel().xSampling,
                                     channel.channel().ySampling));
        {
            Imf::OutputFile file(path.c_str(), header);
            file.setFrameBuffer(buffer);
            file.writePixels(64);
        }
        return tests::message_in<scenes::BadInput>(directory.path(),
                                                   [&] { scenes::read_image(path); });
    };
    CHECK(complaint("G", 1) == "no error");
    CHECK(complaint("G", 2) == "a.exr: must be an EXR whose channels have a sample for each pixel");
    CHECK(complaint("q", 1) ==
          "a.exr: must be an EXR with channels R, G and B, or Y, got none \"R\"");
    CHECK(complaint("q", 64) ==
          "a.exr: must be an EXR with channels R, G and B, or Y, got none \"R\"");
}

TEST_CASE("a damaged EXR is bad input") {
    const TemporaryDirectory directory;
    const core::Aovs aovs(3, 2);
    const scenes::ImageOptions named{.texts = {{"Title", "a scene"}}};
    const std::string bytes = scenes::exr_of(core::Film(3, 2, /*with_alpha=*/true), &aovs, named);
    const auto read = [&](const std::string& content) {
        const auto path = directory.write("a.exr", content);
        return tests::message_in<scenes::BadInput>(directory.path(),
                                                   [&] { scenes::read_image(path); });
    };
    const std::string damaged =
        "a.exr: must be a PNG, TIFF, EXR, HDR or PFM image, got a damaged EXR";
    CHECK(read(bytes) == "no error");
    for (std::size_t size = 4; size + 1 < bytes.size(); size += 7)
        CHECK(read(bytes.substr(0, size)) == damaged);
    // OpenEXR allocates the length that a string attribute claims.
    std::string claims = bytes;
    const std::string text("\0string\0", 8);
    claims.replace(claims.find(text) + text.size(), 4, std::string("\x00\x00\x00\x7E", 4));
    CHECK(read(claims) == damaged);
    const auto reads = [&] {
        return scenes::read_image(directory.write("b.exr", claims)).width == 3;
    };
    if (!tests::sanitized) CHECK(tests::within(100, reads) == tests::Ended::as_bad_input);
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        std::string mutated = bytes;
        for (int k = 0; k < 1 + i % 3; ++k)
            mutated[4 + random() % (mutated.size() - 4)] = static_cast<char>(random());
        const std::string message = read(mutated); // throws no other exception
        CHECK((message == "no error" || message.starts_with("a.exr: must be a")));
    }
}

#endif
