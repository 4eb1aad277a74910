#include "scenes/files/module.hpp"

#include "scenes/files/errors.hpp"

#ifndef __EMSCRIPTEN__
#include <dlfcn.h>
#endif
#include <filesystem>
#include <vector>

namespace raylane::scenes {

#ifndef __EMSCRIPTEN__

namespace {

/// Returns the folders that may have modules: of the shared library with this code first.
std::vector<std::filesystem::path> folders() {
    std::error_code unknown;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    std::vector<std::filesystem::path> result;
    Dl_info info{};
    // A relative name may be in another folder by now.
    if (::dladdr(reinterpret_cast<void*>(&function_of), &info) != 0 && info.dli_fname != nullptr &&
        info.dli_fname[0] == '/' &&
        !std::filesystem::equivalent(info.dli_fname, program, unknown)) {
        const auto folder = std::filesystem::path(info.dli_fname).parent_path();
        result.insert(result.end(), {folder, folder / "raylane"});
    }
    const std::filesystem::path folder = program.parent_path();
    result.insert(result.end(), {folder, folder / RAYLANE_MODULE_FOLDER});
    return result;
}

} // namespace

#endif

void* function_of(const Module& module, const std::string& what_fails) {
    const auto refuse = [&](const std::string& why) {
        throw SystemRefused(what_fails + ": " + printable(why, 400));
    };
#ifndef __EMSCRIPTEN__ // which has no shared libraries
    std::error_code unknown;
    for (const std::filesystem::path& folder : folders()) {
        const std::filesystem::path path = folder / module.file;
        if (!std::filesystem::exists(path, unknown)) continue;
        void* const loaded = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (loaded == nullptr) refuse(::dlerror());
        void* const function = ::dlsym(loaded, module.function);
        if (function == nullptr) refuse(std::string(module.file) + " belongs to another version");
        return function;
    }
#endif
    refuse("missing module " + std::string(module.file) + ", which needs " + module.built_where);
    return nullptr;
}

} // namespace raylane::scenes
