#pragma once

#include <cstdint>

namespace raylane::scenes {

/// A user's action on a window.
struct WindowEvent {
    enum class Kind : std::uint8_t {
        none,
        woken, ///< wake() was called
        resized,
        turned,  ///< dragged by the left button: `across` and `down`, in pixels
        moved,   ///< dragged by another button, or with shift pressed
        zoomed,  ///< by `notches` of the wheel
        clicked, ///< at (x, y), by the left button, without a drag
        key,     ///< an ASCII character
        closed,
    };
    Kind kind = Kind::none;
    int x = 0, y = 0, across = 0, down = 0;
    double notches = 0.0;
    char key = '\0';
};

/// A window that shows images. Only the thread that opened it may use it, except for wake().
class Window {
  public:
    Window() = default;
    virtual ~Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    virtual int width() const = 0;
    virtual int height() const = 0;
    virtual void set_title(const char* title) = 0;
    /// Shows width * height pixels 0xRRGGBB, row by row, scaled to the whole window.
    virtual void show(const std::uint32_t* pixels, int width, int height) = 0;
    /// Returns the next event, or one of kind `none` after `milliseconds` without any.
    virtual WindowEvent wait(int milliseconds) = 0;
    /// Makes wait() return. Thread-safe.
    virtual void wake() = 0;
};

/// The function of the module that opens windows. It returns null and sets the reason if it cannot
/// open one.
extern "C" using OpenWindow =
    Window * (*)(const char* title, int width, int height, const char** why);
inline constexpr const char* open_window_name = "raylane_open_window";

} // namespace raylane::scenes
