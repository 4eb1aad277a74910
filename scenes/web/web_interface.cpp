#include "core/scene/transfer.hpp"
#include "raylane/raylane.hpp"

#include <cstddef>
#include <cstdint>
#include <emscripten.h>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The functions that engine.js calls. There is one scene, and the last image of it. Functions
/// that can fail return true on success; web_error() returns the reason of a failure.
namespace {

using namespace raylane;

std::optional<Scene> scene;
Image image;
std::vector<std::uint8_t> bytes; // RGBA, in a canvas's format
std::uint64_t rays = 0;
std::string error;

template <class Work>
bool attempt(const Work& work) {
    try {
        work();
        return true;
    } catch (const std::bad_alloc&) {
        error = "out of memory";
    } catch (const std::exception& thrown) {
        error = thrown.what();
    }
    return false;
}

/// A camera in the form that JavaScript reads: a sequence of numbers.
struct CameraNumbers {
    float projection;
    Vec3 from, at, up;
    float field_of_view, height, lens_radius, focus_distance;
};
CameraNumbers camera_numbers;

void encode() {
    const core::Encoder code(scene->settings().transfer == Transfer::srgb ? core::Transfer::srgb
                                                                          : core::Transfer::linear);
    const std::size_t count = image.rgb.size() / 3;
    bytes.resize(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            bytes[4 * i + channel] = code(image.rgb[3 * i + channel]);
        bytes[4 * i + 3] = 255;
    }
}

} // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* web_error() {
    return error.c_str();
}

EMSCRIPTEN_KEEPALIVE const char* web_version() {
    return raylane::version();
}

/// `name`: its extension, if any, decides the format.
EMSCRIPTEN_KEEPALIVE bool web_load(const char* text, std::size_t length, const char* name) {
    return attempt([&] { scene = parse(std::string_view(text, length), name); });
}

EMSCRIPTEN_KEEPALIVE double web_shape_count() {
    return static_cast<double>(scene->shape_count());
}

EMSCRIPTEN_KEEPALIVE int web_width() {
    return scene->settings().width;
}
EMSCRIPTEN_KEEPALIVE int web_height() {
    return scene->settings().height;
}
EMSCRIPTEN_KEEPALIVE int web_grid() {
    return scene->settings().grid;
}
EMSCRIPTEN_KEEPALIVE float web_quality() {
    return scene->settings().quality;
}

/// Returns 14 floats, to read, or to change before web_look().
EMSCRIPTEN_KEEPALIVE CameraNumbers* web_camera() {
    const Camera camera = scene->camera();
    camera_numbers = {camera.projection == Projection::perspective ? 0.0F : 1.0F,
                      camera.from,
                      camera.at,
                      camera.up,
                      camera.field_of_view,
                      camera.height,
                      camera.lens_radius,
                      camera.focus_distance};
    return &camera_numbers;
}

/// Sets the scene's camera to the numbers that web_camera() returned.
EMSCRIPTEN_KEEPALIVE bool web_look() {
    return attempt([&] {
        const CameraNumbers& from = camera_numbers;
        scene = scene->seen_by(
            {from.projection == 0.0F ? Projection::perspective : Projection::orthographic,
             from.from, from.at, from.up, from.field_of_view, from.height, from.lens_radius,
             from.focus_distance});
    });
}

/// Renders rows of an image from `first` on, with grid x grid samples, or as the scene requests if
/// `grid` is 0.
EMSCRIPTEN_KEEPALIVE bool web_render(int width, int height, int grid, int first, int rows) {
    return attempt([&] {
        Settings settings = scene->settings();
        settings.width = width;
        settings.height = height;
        settings.alpha = false; // otherwise the page behind the canvas shows
        if (grid != 0) {
            settings.grid = grid;
            settings.quality = 0.0F;
        }
        RenderOptions options;
        options.settings = settings;
        options.crop = PixelRect{0, first, width, rows};
        image = render(*scene, options, [](const Progress& progress) {
                    rays = progress.rays;
                    return true;
                }).value();
        encode();
    });
}

/// Results of the last web_render(): 4 bytes per pixel through the scene's transfer curve, 3 linear
/// floats per pixel, and the number of rays.
EMSCRIPTEN_KEEPALIVE const std::uint8_t* web_bytes() {
    return bytes.data();
}
EMSCRIPTEN_KEEPALIVE const float* web_film() {
    return image.rgb.data();
}
EMSCRIPTEN_KEEPALIVE double web_rays() {
    return static_cast<double>(rays);
}

} // extern "C"
