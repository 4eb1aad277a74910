#pragma once

#include "tests/scenes/temporary_directory.hpp"
#include "tests/scenes/tool/process.hpp"

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace raylane::tests {

/// A red mirror ball before a blue background: 16 x 12 pixels, a moment's work.
inline const std::string ball = R"({
    "image": {"width": 16, "height": 12},
    "camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
    "background": [0, 0, 0.5],
    "lights": [{"type": "directional", "direction": [-1, -2, -3]}],
    "materials": {"red": {"color": [1, 0, 0], "reflectivity": 0.5}},
    "objects": [{"type": "sphere", "material": "red", "center": [0, 0, 0], "radius": 1}]
})";

/// Options that make a picture of any scene take hours.
inline const std::vector<std::string> hours = {"--size", "4000x4000", "--spp", "65536"};
/// The same, in tiles that take a moment.
inline const std::vector<std::string> minutes = {"--size", "4000x4000", "--spp", "256"};

inline std::vector<std::string> joined(std::vector<std::string> a,
                                       const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Standard error is a terminal of that kind, as the environment's TERM says.
inline Setup on_terminal(const char* kind = "xterm") {
    Setup setup;
    setup.terminal = true;
    setup.in_child = [kind] { ::setenv("TERM", kind, 1); };
    return setup;
}

/// Until that is so. False if it takes a minute.
template <class Condition>
bool comes_true(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

/// A directory to run the tool in, with a scene and an empty directory for what comes out.
class Workshop {
  public:
    explicit Workshop(const std::string& scene = ball) {
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
    /// Until as many files as that have come out, temporaries included, also those without a name.
    /// False if that takes a minute.
    bool wait_for_files(const Process& process, int count) const {
        return comes_true([&] {
            return std::distance(std::filesystem::directory_iterator(output()), {}) +
                       process.unnamed_files_in(output()) ==
                   count;
        });
    }

    /// Until that file is there. False if that takes a minute.
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
    Outcome render(const std::string& name, const std::vector<std::string>& options = {}) const {
        return run(joined({"render", "scene.json", "-o", name}, options));
    }

  private:
    TemporaryDirectory directory_;
};

inline bool is_one_line(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n') == 1 && text.ends_with('\n');
}

} // namespace raylane::tests
