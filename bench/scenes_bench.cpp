#include "bench/rendering.hpp"
#include "scenes/formats/scene_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

/// Measures whole images of scene files, with the sizes and samples that the files set: by the
/// vector engine, and by the scalar reference in the same run.

namespace {

using namespace raylane;
namespace fs = std::filesystem;

/// Returns the folders of RAYLANE_SCENES, separated by colons; by default those of the source tree,
/// and of the NFF scenes in shared/scenes beside the source tree.
std::vector<fs::path> folders() {
    const fs::path source = RAYLANE_SOURCE_DIR;
    const char* given = std::getenv("RAYLANE_SCENES");
    if (given == nullptr) return {source / "scenes", source.parent_path() / "shared" / "scenes"};
    std::vector<fs::path> paths;
    std::istringstream list(given);
    for (std::string folder; std::getline(list, folder, ':');)
        paths.emplace_back(folder);
    return paths;
}

bool is_scene(const fs::path& path) {
    if (path.extension() == ".nff") return true;
    return path.extension() == ".json" && path.stem().extension() != ".schema";
}

std::vector<fs::path> scene_files() {
    std::vector<fs::path> files;
    for (const fs::path& folder : folders()) {
        std::error_code absent;
        std::vector<fs::path> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, absent))
            if (is_scene(entry.path())) found.push_back(entry.path());
        std::sort(found.begin(), found.end());
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

/// Loads a file when it is first measured. The next file replaces it.
std::shared_ptr<const core::Scene> load(const fs::path& path) {
    static fs::path loaded;
    static std::shared_ptr<const core::Scene> scene;
    if (loaded != path) {
        scene = std::make_shared<const core::Scene>(scenes::load_scene(path));
        loaded = path;
    }
    return scene;
}

const bool registered = [] {
    for (const fs::path& path : scene_files()) {
        bench::add_renderings("scene/" + path.stem().string(), [path] { return load(path); });
    }
    return true;
}();

} // namespace
