#include "scenes/tool/ranks/shared_scene.hpp"

#include "scenes/built/built_file.hpp"
#include "scenes/errors.hpp"
#include "scenes/tool/memory_file.hpp"
#include "simd/threads.hpp"

#include <optional>
#include <string>
#include <unistd.h>

namespace raylane::scenes {

namespace {

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
