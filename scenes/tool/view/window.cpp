#include "scenes/tool/view/window.hpp"

#include "scenes/errors.hpp"

#include <dlfcn.h>
#include <filesystem>

namespace raylane::scenes {

namespace {

[[noreturn]] void refuse(const std::string& why) {
    throw SystemRefused("view: cannot open a window: " + printable(why, 400));
}

/// Beside the program, as it is built, or where it is installed.
void* module_of_windows() {
    std::error_code unknown;
    const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    for (const char* place : {".", RAYLANE_MODULE_FOLDER}) {
        const std::filesystem::path path = folder / place / "raylane-window.so";
        if (!std::filesystem::exists(path, unknown)) continue;
        void* module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) refuse(::dlerror());
        return module;
    }
    refuse("there is no raylane-window.so, which is built where SDL2 is (Debian: libsdl2-dev)");
}

} // namespace

std::unique_ptr<Window> open_window(const std::string& title, int width, int height) {
    // It stays for as long as the program: its functions are called when the window is closed.
    static void* const module = module_of_windows();
    const auto open = reinterpret_cast<OpenWindow>(::dlsym(module, open_window_name));
    if (open == nullptr) refuse("raylane-window.so is of another version");
    const char* why = "";
    Window* window = open(title.c_str(), width, height, &why);
    if (window == nullptr) refuse(why);
    return std::unique_ptr<Window>(window);
}

} // namespace raylane::scenes
