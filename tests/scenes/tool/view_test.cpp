#include "scenes/tool/window/mouse.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>

/// Tests of windows on Xvfb, a display whose screen is a file.
using namespace raylane::tests;

namespace {

constexpr int screen_width = 640, screen_height = 480;

/// Owns a process of Xvfb, which has its screen in a file of a folder.
class Display {
  public:
    explicit Display(const std::filesystem::path& folder) : folder_(folder) {
        int ends[2];
        if (::pipe(ends) != 0) return;
        child_ = ::fork();
        if (child_ == 0) {
            const std::string number = std::to_string(ends[1]);
            ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "640x480x24",
                     "-fbdir", folder.c_str(), "-nolisten", "tcp", nullptr);
            ::_exit(127);
        }
        ::close(ends[1]);
        char text[16] = {};
        const ssize_t size = ::read(ends[0], text, sizeof text - 1); // when Xvfb is ready
        ::close(ends[0]);
        if (size > 0) name_ = ":" + std::to_string(std::atoi(text));
    }
    ~Display() {
        if (child_ > 0) ::kill(child_, SIGKILL);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// Returns the name of the display, or "" without Xvfb.
    const std::string& name() const { return name_; }

    /// Returns red, green and blue of each pixel of the screen, whose file has the format xwd.
    std::vector<std::uint8_t> pixels() const {
        std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
        const std::string content((std::istreambuf_iterator<char>(file)), {});
        const auto number = [&](std::size_t at) { // most significant byte first
            std::uint32_t value = 0;
            for (std::size_t i = 0; i < 4; ++i)
                value = value << 8 | static_cast<std::uint8_t>(content.at(4 * at + i));
            return value;
        };
        constexpr std::size_t header_size = 0, line_bytes = 12, colors = 19, color_bytes = 12;
        const std::size_t start = number(header_size) + color_bytes * number(colors);
        std::vector<std::uint8_t> result;
        for (std::size_t y = 0; y < screen_height; ++y)
            for (std::size_t x = 0; x < screen_width; ++x)
                for (const std::size_t channel : {2, 1, 0})
                    result.push_back(static_cast<std::uint8_t>(
                        content.at(start + y * number(line_bytes) + 4 * x + channel)));
        return result;
    }

  private:
    std::filesystem::path folder_;
    pid_t child_ = -1;
    std::string name_;
};

/// Returns the pixels of a PPM of 8 bits: its last `count` bytes.
std::vector<std::uint8_t> pixels_of(const std::filesystem::path& ppm, std::size_t count) {
    std::ifstream file(ppm, std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(file)), {});
    return {content.end() - static_cast<std::ptrdiff_t>(count), content.end()};
}

Setup on_display(const std::string& name, const std::filesystem::path& directory = ".") {
    Setup setup;
    setup.directory = directory;
    setup.in_child = [name] {
        ::setenv("DISPLAY", name.c_str(), 1);
        ::setenv("SDL_VIDEODRIVER", "x11", 1);
    };
    return setup;
}

} // namespace

TEST_CASE("a missing display gives an error of one line") {
    const ToolFixture fixture;
    fixture.write("figure.txt", // of an image on paper
                  "--size 85x60mm\n--dpi 600\n--bits 16\n--outline 2\n--outline-creases 60\n"
                  "--max-transparent 1\n--transparent-shadows off\n--print\n--max-depth 4\n");
    Setup setup;
    const char* driver = GENERATE("x11", ""); // "": any driver that SDL finds
    setup.in_child = [driver] {
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        ::unsetenv("SDL_VIDEODRIVER");
        ::setenv("XDG_RUNTIME_DIR", "/tmp", 1);
        if (*driver != '\0') ::setenv("SDL_VIDEODRIVER", driver, 1);
    };
    const Outcome outcome = fixture.run({"view", "scene.json", "@figure.txt"}, setup);
    CHECK(outcome.code == 3);
    CHECK(is_one_line(outcome.err));
    CHECK(outcome.err.starts_with("raylane: view: cannot open a window: "));
}

TEST_CASE("a window shows the image of render and follows changes of the scene") {
    const ToolFixture fixture;
    std::filesystem::create_directory(fixture.path() / "screen");
    const Display display(fixture.path() / "screen");
    if (display.name().empty()) {
        WARN("skipped: Xvfb is missing");
        return;
    }
    const Options options = {"scene.json", "--size", "640x480", "--spp", "4", "--outline", "3"};
    Process viewer(joined({"view"}, options), on_display(display.name(), fixture.path()));
    constexpr std::size_t size = std::size_t{3} * screen_width * screen_height;
    std::string scene = ball;
    for (const std::string color : {"[1, 0, 0]", "[0, 1, 0]"}) {
        CAPTURE(color);
        scene.replace(scene.find("\"color\": ["), 18, "\"color\": " + color);
        if (color == "[0, 1, 0]") // settings of the file
            scene.replace(1, 0, R"("outline": {"width": 1, "color": [0, 0, 1]},)");
        fixture.write("scene.json", scene);
        REQUIRE(fixture.run(joined(joined({"render"}, options), {"-o", "out/a.ppm"})).code == 0);
        const auto expected = pixels_of(fixture.output() / "a.ppm", size);
        CHECK(comes_true([&] { return display.pixels() == expected; }));
        std::filesystem::remove(fixture.output() / "a.ppm");
    }
    viewer.send(SIGTERM);
    CHECK(viewer.wait().code == 128 + SIGTERM);
}

TEST_CASE("a window shows annotations over the image") {
    const ToolFixture fixture;
    std::filesystem::create_directory(fixture.path() / "screen");
    const Display display(fixture.path() / "screen");
    if (display.name().empty()) {
        WARN("skipped: Xvfb is missing");
        return;
    }
    fixture.write("two.xyz", "2\n\nO 0 0 0\nC 3 0 0\n");
    const Options options = {
        "two.xyz",     "--size", "640x480",  "--label",    "element C: {element}",
        "--scale-bar", "auto",   "--legend", "--distance", "index 1: index 2"};
    const Outcome rendered = fixture.run(joined(joined({"render"}, options), {"-o", "out/a.ppm"}));
    if (rendered.code != 0) {
        WARN("skipped: pango is missing");
        return;
    }
    Process viewer(joined({"view"}, options), on_display(display.name(), fixture.path()));
    const auto expected =
        pixels_of(fixture.output() / "a.ppm", std::size_t{3} * screen_width * screen_height);
    // The window blends codes, and files have rounded floats of them.
    CHECK(comes_true([&] {
        const auto pixels = display.pixels();
        return std::equal(pixels.begin(), pixels.end(), expected.begin(), expected.end(),
                          [](int a, int b) { return std::abs(a - b) <= 1; });
    }));
    viewer.send(SIGTERM);
    CHECK(viewer.wait().code == 128 + SIGTERM);
    const Outcome wrong =
        fixture.run({"view", "two.xyz", "--label", "element Fe: iron"}, on_display(display.name()));
    CHECK(wrong.code == 2);
    CHECK(wrong.err == "raylane: --label: \"element Fe\" selects none of 2 atoms\n");
}

TEST_CASE("A click names the material of the object") {
    const raylane::core::Scene scene = scene_of(R"({"image": {"width": 3, "height": 1},
        "camera": {"type": "orthographic", "from": [0, 0, 5], "at": [0, 0, 0], "height": 2},
        "lights": [], "materials": {"clear glass": {"transmission": 1}},
        "objects": [{"type": "sphere", "material": "clear glass", "center": [-2, 0, 0], "radius": 1},
                    {"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})");
    const auto click = [&](int x) {
        return raylane::scenes::what_is_at(scene, scene.settings(), x, 0);
    };
    CHECK(click(0) ==
          "sphere 0 of material 0 (clear glass), at -2 0 1, 4 away (rounded to nearest double)");
    CHECK(click(1).starts_with("sphere 1 of material 1, at 0 0 1, 4 away"));
    CHECK(click(2) == "background");
}
