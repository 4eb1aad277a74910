// This file is a separate module; see open_window().
#include "scenes/tool/window/window.hpp"

#include <SDL.h>
#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using raylane::scenes::Window, raylane::scenes::WindowEvent;

constexpr int farthest_click = 3; // pixels that the pointer may move during a click

class SdlWindow final : public Window {
  public:
    explicit SdlWindow(SDL_Window* window) : window_(window) {}
    ~SdlWindow() override {
        SDL_FreeSurface(image_);
        SDL_DestroyWindow(window_);
        SDL_Quit();
    }

    int width() const override {
        int width = 0;
        SDL_GetWindowSize(window_, &width, nullptr);
        return width;
    }
    int height() const override {
        int height = 0;
        SDL_GetWindowSize(window_, nullptr, &height);
        return height;
    }
    void set_title(const char* title) override { SDL_SetWindowTitle(window_, title); }

    void show(const std::uint32_t* pixels, int width, int height) override {
        SDL_FreeSurface(image_);
        image_ = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_RGB888);
        if (image_ == nullptr) return; // out of memory: no image is shown
        for (int y = 0; y < height; ++y)
            std::copy_n(
                pixels + static_cast<std::ptrdiff_t>(y) * width, width,
                reinterpret_cast<std::uint32_t*>(static_cast<std::uint8_t*>(image_->pixels) +
                                                 static_cast<std::ptrdiff_t>(y) * image_->pitch));
        draw();
    }

    WindowEvent wait(int milliseconds) override {
        SDL_Event event;
        if (SDL_WaitEventTimeout(&event, milliseconds) == 0) return {};
        return event_of(event);
    }

    void wake() override {
        SDL_Event event{};
        event.type = SDL_USEREVENT;
        SDL_PushEvent(&event);
    }

  private:
    using Kind = WindowEvent::Kind;

    void draw() const {
        SDL_Surface* surface = SDL_GetWindowSurface(window_);
        if (surface == nullptr || image_ == nullptr) return;
        if (image_->w == surface->w && image_->h == surface->h)
            SDL_BlitSurface(image_, nullptr, surface, nullptr);
        else
            SDL_BlitScaled(image_, nullptr, surface, nullptr);
        SDL_UpdateWindowSurface(window_);
    }

    WindowEvent motion(const SDL_MouseMotionEvent& motion) {
        if (motion.state == 0) return {};
        is_dragged_ = is_dragged_ || std::abs(motion.x - from_x_) > farthest_click ||
                      std::abs(motion.y - from_y_) > farthest_click;
        if (!is_dragged_) return {};
        const bool turns =
            (motion.state & SDL_BUTTON_LMASK) != 0 && (SDL_GetModState() & KMOD_SHIFT) == 0;
        return {.kind = turns ? Kind::turned : Kind::moved,
                .x = motion.x,
                .y = motion.y,
                .across = motion.xrel,
                .down = motion.yrel};
    }

    WindowEvent event_of(const SDL_Event& event) {
        switch (event.type) {
        case SDL_QUIT:
            return {.kind = Kind::closed};
        case SDL_USEREVENT:
            return {.kind = Kind::woken};
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_EXPOSED) draw();
            if (event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED) return {.kind = Kind::resized};
            return {};
        case SDL_MOUSEBUTTONDOWN:
            from_x_ = event.button.x;
            from_y_ = event.button.y;
            is_dragged_ = false;
            return {};
        case SDL_MOUSEBUTTONUP:
            if (is_dragged_ || event.button.button != SDL_BUTTON_LEFT) return {};
            return {.kind = Kind::clicked, .x = event.button.x, .y = event.button.y};
        case SDL_MOUSEMOTION:
            return motion(event.motion);
        case SDL_MOUSEWHEEL:
            return {.kind = Kind::zoomed, .notches = static_cast<double>(event.wheel.preciseY)};
        case SDL_KEYDOWN: {
            const SDL_Keycode key = event.key.keysym.sym;
            if (key == SDLK_ESCAPE) return {.kind = Kind::closed};
            if (key <= 0 || key > 127) return {};
            return {.kind = Kind::key, .key = static_cast<char>(key)};
        }
        default:
            return {};
        }
    }

    SDL_Window* window_;
    SDL_Surface* image_ = nullptr; // shown last
    int from_x_ = 0, from_y_ = 0;  // where the button was pressed
    bool is_dragged_ = false;
};

/// Returns true for drivers that SDL chooses without a display, unless the user has chosen one.
bool shows_nothing(const char* driver) {
    if (driver == nullptr || std::getenv("SDL_VIDEODRIVER") != nullptr) return false;
    const std::string_view name = driver;
    return name == "offscreen" || name == "dummy" || name == "evdev";
}

} // namespace

extern "C" __attribute__((visibility("default"))) Window*
raylane_open_window(const char* title, int width, int height, const char** why) {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1"); // the tool has its own handlers
    SDL_Window* window = nullptr;
    static std::string reason;
    const bool is_there = SDL_Init(SDL_INIT_VIDEO) == 0;
    if (is_there && shows_nothing(SDL_GetCurrentVideoDriver()))
        SDL_SetError("no display");
    else if (is_there)
        window = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width,
                                  height, SDL_WINDOW_RESIZABLE);
    if (window == nullptr) {
        reason = SDL_GetError();
        SDL_Quit();
        *why = reason.c_str();
        return nullptr;
    }
    return new SdlWindow(window);
}
