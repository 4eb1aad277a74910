#include "scenes/tool/window/window.hpp"

#include "scenes/errors.hpp"
#include "scenes/tool/module.hpp"

namespace raylane::scenes {

std::unique_ptr<Window> open_window(const std::string& title, int width, int height) {
    constexpr const char* failure = "view: cannot open a window";
    static const auto open = reinterpret_cast<OpenWindow>(function_of(
        {"raylane-window.so", open_window_name, "SDL2 at build time (Debian: libsdl2-dev)"},
        failure));
    const char* why = "";
    Window* window = open(title.c_str(), width, height, &why);
    if (window == nullptr) throw SystemRefused(std::string(failure) + ": " + printable(why, 400));
    return std::unique_ptr<Window>(window);
}

} // namespace raylane::scenes
