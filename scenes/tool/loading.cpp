#include "scenes/tool/loading.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/built/built_file.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "scenes/tool/system.hpp"
#include "simd/threads/threads.hpp"

#include <atomic>
#include <cstdio>
#include <optional>
#include <string>
#include <unistd.h>
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
        options.on_read = [this](std::uint64_t bytes, std::uint64_t total) {
            bytes_ = bytes;
            all_bytes_ = total;
        };
        options.on_remark = [this](const std::string& remark) { remarks_.push_back(remark); };
        return load_scene(path, options);
    }

    void added(std::size_t count) override { added_ = count; }
    void placed(std::size_t count, std::size_t total) override {
        to_place_ = total;
        placed_ += count;
    }

    /// Returns the remarks on the file. Call it after load().
    const std::vector<std::string>& remarks() const { return remarks_; }

    std::string text() const {
        const auto share = [](auto done, auto total) {
            return static_cast<double>(done) / static_cast<double>(total);
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

bool is_built(const std::filesystem::path& path) {
    std::error_code none;
    return std::filesystem::is_regular_file(path, none) && looks_built(InputFile(path).head());
}

/// Writes a scene to `memory` and returns the path by which other processes find it. If that is
/// impossible, returns an empty path and resets `memory`.
std::string put(std::optional<MemoryFile>& memory, const core::Scene& scene) {
    if (scene.solids().any()) return "";
    try {
        AtomicFile file(memory.emplace("raylane scene").path());
        write_built(file, scene);
        file.commit();
        return memory->path_for_others();
    } catch (const SystemRefused&) { // it is too large, for example
        memory.reset();
        return "";
    }
}

std::optional<core::Scene> take(const std::string& place, int threads) {
    if (place.empty()) return std::nullopt;
    try {
        InputFile file(place);
        simd::ParallelWorkers workers(threads);
        return read_built(file, &workers);
    } catch (const BadInput&) { // /proc shows the processes of another namespace
        return std::nullopt;
    } catch (const SystemRefused&) {
        return std::nullopt;
    }
}

} // namespace

core::Scene load_with_progress(const std::filesystem::path& path, LoadOptions options,
                               Verbosity verbosity, int threads, std::optional<simd::Isa> isa) {
    const auto start = std::chrono::steady_clock::now();
    Loader loader(threads, isa ? simd::node_width_of(*isa) : simd::node_width());
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

core::Scene load_seen(const std::string& scene, const SceneArguments& options, int threads,
                      const std::function<void(const Structure&)>& on_structure) {
    LoadOptions loading = options.load_options();
    loading.on_structure = on_structure;
    core::Scene loaded =
        load_with_progress(scene, std::move(loading), options.verbosity.verbosity(), threads);
    const core::Settings settings = loaded.settings();
    return seen(std::move(loaded), options.view.change(), settings);
}

core::Scene load_together(Job& job, const std::filesystem::path& path, int threads,
                          const std::function<core::Scene(int)>& load_file) {
    const bool is_input = path == "-" && job.ranks() != nullptr;
    if (is_input) job.share_standard_input();
    const auto load = [&](int with) {
        if (is_input) ::lseek(STDIN_FILENO, 0, SEEK_SET);
        return load_file(with);
    };
    std::optional<core::Scene> scene;
    const int share = job.share_of_threads(threads);
    std::optional<MemoryFile> memory;
    std::string place;
    // Hosts may take different branches here, but all ranks make the same collective calls.
    job.together([&] {
        if (!job.shares_host()) {
            scene = load(share);
        } else if (job.is_first_of_host() && !is_built(path)) {
            scene = load(threads);
            place = put(memory, *scene);
            if (!place.empty()) scene.reset(); // otherwise it is in memory twice
        }
    });
    place = job.told_on_host(place);
    job.together([&] {
        if (!scene) scene = take(place, share);
        if (!scene) scene = load(share);
    });
    return *std::move(scene);
}

} // namespace raylane::scenes
