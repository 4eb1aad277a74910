#include "scenes/tool/loading.hpp"

#include "scenes/errors.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "simd/threads.hpp"

#include <atomic>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

std::string millions(std::size_t shapes) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f million shapes", static_cast<double>(shapes) / 1e6);
    return text;
}

/// Reads and builds a scene and counts its progress. Another thread may call text().
class Loader : public simd::ParallelWorkers {
  public:
    using ParallelWorkers::ParallelWorkers;

    core::Scene load(const std::filesystem::path& path, LoadOptions options) {
        options.workers = this;
        options.on_read = [this](std::uint64_t bytes, std::uint64_t of) {
            bytes_ = bytes;
            all_bytes_ = of;
        };
        options.on_remark = [this](const std::string& remark) { remarks_.push_back(remark); };
        return load_scene(path, options);
    }

    void added(std::size_t count) override { added_ = count; }
    void placed(std::size_t count, std::size_t all) override {
        to_place_ = all;
        placed_ += count;
    }

    /// Returns the remarks on the file. Call it after load().
    const std::vector<std::string>& remarks() const { return remarks_; }

    std::string text() const {
        const auto share = [](auto done, auto all) {
            return static_cast<double>(done) / static_cast<double>(all);
        };
        if (to_place_ > 0)
            return bar_text(share(placed_.load(), to_place_.load())) + "  of " +
                   millions(to_place_) + " placed";
        std::string read = millions(added_) + " read";
        // The size of a pipe is unknown (0). A file of a few bytes may be read completely while it
        // still generates many shapes.
        if (bytes_ >= all_bytes_) return read;
        return bar_text(share(bytes_.load(), all_bytes_.load())) + "  " + read;
    }

  private:
    std::atomic<std::uint64_t> bytes_ = 0, all_bytes_ = 0;
    std::atomic<std::size_t> added_ = 0, placed_ = 0, to_place_ = 0;
    std::vector<std::string> remarks_;
};

} // namespace

core::Scene load_with_progress(const std::filesystem::path& path, LoadOptions options,
                               Verbosity verbosity, int threads) {
    const auto start = std::chrono::steady_clock::now();
    Loader loader(threads);
    core::Scene scene = [&] {
        const ProgressLine line(verbosity, [&] { return loader.text(); });
        return loader.load(path, std::move(options));
    }();
    if (verbosity == Verbosity::quiet) return scene;
    for (const std::string& remark : loader.remarks())
        std::fprintf(stderr, "%s\n", remark.c_str());
    if (verbosity == Verbosity::verbose)
        std::fprintf(stderr, "%s: %zu shapes, read and built in %s\n",
                     printable(path.string(), 4096).c_str(), scene.shape_count(),
                     duration_text(seconds_since(start)).c_str());
    return scene;
}

core::Scene load_seen(const std::string& scene, const SceneArguments& options, int threads) {
    core::Scene loaded =
        load_with_progress(scene, options.load_options(), options.verbosity.verbosity(), threads);
    const core::Settings settings = loaded.settings();
    return seen(std::move(loaded), options.view.change(), settings);
}

} // namespace raylane::scenes
