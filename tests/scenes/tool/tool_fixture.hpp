#pragma once

#include "scenes/images/reader.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/tool/process.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comes_true.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace raylane::tests {

/// A red mirror ball before a blue background: 16 x 12 pixels, rendered in a moment.
inline const std::string ball = R"({
    "image": {"width": 16, "height": 12},
    "camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
    "background": [0, 0, 0.5],
    "lights": [{"type": "directional", "direction": [-1, -2, -3]}],
    "materials": {"red": {"color": [1, 0, 0], "reflectivity": 0.5}},
    "objects": [{"type": "sphere", "material": "red", "center": [0, 0, 0], "radius": 1}]
})";

using Options = std::vector<std::string>;

/// Options that make an image of any scene take hours.
inline const Options hours = {"--size", "4000x4000", "--spp", "65536"};
/// Options that make an image take minutes, in tiles that take a moment.
inline const Options minutes = {"--size", "4000x4000", "--spp", "256"};

inline Options joined(Options a, const Options& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Returns a setup with a terminal as standard error. `kind`: the environment's TERM.
inline Setup on_terminal(const char* kind = "xterm") {
    Setup setup;
    setup.terminal = true;
    setup.in_child = [kind] { ::setenv("TERM", kind, 1); };
    return setup;
}

/// Owns a directory to run the tool in, with a scene and an empty directory for outputs.
class ToolFixture {
  public:
    explicit ToolFixture(const std::string& scene = ball) {
        directory_.write("scene.json", scene);
        std::filesystem::create_directory(output());
    }

    std::filesystem::path path() const { return directory_.path(); }
    std::filesystem::path output() const { return directory_.path() / "out"; }
    std::filesystem::path write(const std::string& name, std::string_view content) const {
        return directory_.write(name, content);
    }
    std::vector<std::string> names() const { return directory_.names(); }
    bool is_output_empty() const { return std::filesystem::is_empty(output()); }
    /// Waits until there are `count` outputs, including temporaries with and without a name.
    /// Returns false after ten minutes.
    bool wait_for_files(const Process& process, int count) const {
        return comes_true([&] {
            return std::distance(std::filesystem::directory_iterator(output()), {}) +
                       process.unnamed_files_in(output()) ==
                   count;
        });
    }

    /// Waits until the file exists. Returns false after ten minutes.
    bool wait_for(const std::filesystem::path& file) const {
        return comes_true([&] { return std::filesystem::exists(file); });
    }

    Outcome run(const std::vector<std::string>& arguments, Setup setup = {}) const {
        return start(arguments, std::move(setup)).wait();
    }
    Process start(const std::vector<std::string>& arguments, Setup setup = {}) const {
        setup.directory = path();
        return Process(arguments, setup);
    }

    /// Renders scene.json as `name`, with `options`.
    Outcome render(const std::string& name, const Options& options = {}) const {
        return run(joined({"render", "scene.json", "-o", name}, options));
    }
    /// Does the same, which must succeed, and returns the image.
    scenes::Image rendered(const std::string& name, const Options& options = {}) const {
        REQUIRE(render(name, options).code == 0);
        return scenes::read_image(path() / name);
    }

  private:
    TemporaryDirectory directory_;
};

inline bool is_one_line(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n') == 1 && text.ends_with('\n');
}

/// Returns all lines but those of progress, "[###...] 12 % ...". A pipe gets one of these now and
/// then, after ten seconds.
inline std::string messages_in(const std::string& text) {
    std::string messages;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with('[')) messages += line + (lines.eof() ? "" : "\n");
    return messages;
}

/// Returns the last line that a terminal shows: without a progress bar that was wiped away.
inline std::string last_line(std::string text) {
    while (text.ends_with('\n') || text.ends_with('\r'))
        text.pop_back();
    const std::size_t wiped = text.rfind("\r\x1B[K"), broken = text.rfind('\n');
    if (broken != std::string::npos && (wiped == std::string::npos || broken > wiped))
        return text.substr(broken + 1);
    return wiped == std::string::npos ? text : text.substr(wiped + 4);
}

/// Returns how often a text has a part.
inline std::size_t count_of(const std::string& part, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

} // namespace raylane::tests
