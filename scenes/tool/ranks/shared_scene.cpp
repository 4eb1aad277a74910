#include "scenes/tool/ranks/shared_scene.hpp"

#include "scenes/built/built_file.hpp"
#include "scenes/errors.hpp"
#include "simd/workers.hpp"

#include <optional>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace raylane::scenes {

namespace {

/// A file in memory alone, which others of the same user can open by its place as long as it lives.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(::memfd_create("raylane scene", MFD_CLOEXEC)) {}
    ~MemoryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    bool exists() const { return descriptor_ >= 0; }
    std::string own_place() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
    std::string place() const {
        return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_);
    }

  private:
    int descriptor_;
};

bool is_built(const std::filesystem::path& path) {
    std::error_code none;
    return std::filesystem::is_regular_file(path, none) && looks_built(InputFile(path).head());
}

/// Where others find a scene; empty where that cannot be.
std::string put(const MemoryFile& memory, const core::Scene& scene) {
    if (!memory.exists() || scene.solids().any()) return "";
    try {
        AtomicFile file(memory.own_place());
        write_built(file, scene);
        file.commit();
        return memory.place();
    } catch (const SystemRefused&) { // it is too large, for one thing
        return "";
    }
}

std::optional<core::Scene> take(const std::string& place, int threads) {
    if (place.empty()) return std::nullopt;
    try {
        InputFile file(place);
        simd::ParallelWorkers workers(threads);
        return read_built(file, &workers);
    } catch (const BadInput&) { // another namespace's processes
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
    // Hosts may differ in all of this, but not in what they do together.
    job.together([&] {
        if (!job.shares_host()) {
            scene = load(share);
        } else if (job.is_first_of_host() && !is_built(path)) {
            scene = load(threads);
            place = put(memory.emplace(), *scene);
            if (!place.empty()) scene.reset(); // it is there twice
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
