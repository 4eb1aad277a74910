#include "scenes/tool/module.hpp"

#include "scenes/errors.hpp"

#include <dlfcn.h>
#include <filesystem>

namespace raylane::scenes {

void* function_of(const Module& module, const std::string& what_fails) {
    const auto refuse = [&](const std::string& why) {
        throw SystemRefused(what_fails + ": " + printable(why, 400));
    };
    std::error_code unknown;
    const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    for (const char* place : {".", RAYLANE_MODULE_FOLDER}) {
        const std::filesystem::path path = folder / place / module.file;
        if (!std::filesystem::exists(path, unknown)) continue;
        void* const loaded = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (loaded == nullptr) refuse(::dlerror());
        void* const function = ::dlsym(loaded, module.function);
        if (function == nullptr) refuse(std::string(module.file) + " belongs to another version");
        return function;
    }
    refuse("missing module " + std::string(module.file) + ", which needs " + module.built_where);
    return nullptr;
}

} // namespace raylane::scenes
