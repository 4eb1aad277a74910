#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace raylane::scenes {

/// What hands do to a window.
struct WindowEvent {
    enum class Kind : std::uint8_t {
        none,
        woken, ///< wake() was called
        resized,
        turned,  ///< dragged by the left button: `across` and `down`, in pixels
        moved,   ///< dragged by another one, or with shift held
        zoomed,  ///< by `notches` of the wheel
        clicked, ///< at (x, y), by the left button, without being dragged
        key,     ///< an ASCII character
        closed,
    };
    Kind kind = Kind::none;
    int x = 0, y = 0, across = 0, down = 0;
    double notches = 0.0;
    char key = '\0';
};

/// A window that shows pictures. To be used by the thread that has opened it, but for wake().
class Window {
  public:
    Window() = default;
    virtual ~Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    virtual int width() const = 0;
    virtual int height() const = 0;
    virtual void set_title(const char* title) = 0;
    /// width * height pixels 0xRRGGBB, row by row, over all of the window.
    virtual void show(const std::uint32_t* pixels, int width, int height) = 0;
    /// The next event; of kind none if there is none for so many milliseconds.
    virtual WindowEvent wait(int milliseconds) = 0;
    /// Has wait() return, by any thread.
    virtual void wake() = 0;
};

/// Opens one, by a module that is loaded for it: what opens windows takes longer to load than many
/// a picture to draw. Throws SystemRefused where there is no display, or no such module.
std::unique_ptr<Window> open_window(const std::string& title, int width, int height);

/// What the module has. Null, and why, where there is no window.
extern "C" using OpenWindow =
    Window * (*)(const char* title, int width, int height, const char** why);
inline constexpr const char* open_window_name = "raylane_open_window";

} // namespace raylane::scenes
