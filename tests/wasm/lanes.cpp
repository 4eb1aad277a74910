#include "core/numbers/vector.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "simd/wavefront/render.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <emscripten.h>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Interface for hashes.js: images and rays by a chosen instruction set, and decimal numbers. A
/// function that fails returns null, and lanes_error() returns the reason.
namespace {

using namespace raylane;

std::optional<core::Scene> scene;
std::vector<float> floats;
std::string bytes, error;

template <class Work>
auto attempt(const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::exception& thrown) {
        error = thrown.what();
    }
    return nullptr;
}

template <class Number>
void append(const Number& number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
}

} // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* lanes_error() {
    return error.c_str();
}

/// Returns the names of the instruction sets, one a line.
EMSCRIPTEN_KEEPALIVE const char* lanes_isas() {
    bytes.clear();
    for (const simd::Isa isa : simd::available_isas())
        bytes.append(simd::name_of(isa)).append("\n");
    return bytes.c_str();
}

EMSCRIPTEN_KEEPALIVE double lanes_fma(double a, double b, double c) {
    return std::fma(a, b, c);
}
EMSCRIPTEN_KEEPALIVE float lanes_fmaf(float a, float b, float c) {
    return std::fma(a, b, c);
}

EMSCRIPTEN_KEEPALIVE const char* lanes_load(const char* text, std::size_t length,
                                            const char* name) {
    return attempt([&] {
        scene = scenes::parse_scene(name, std::string_view(text, length));
        return name;
    });
}

/// Returns 3 floats for each pixel, from the top down.
EMSCRIPTEN_KEEPALIVE const float* lanes_draw(int isa, int width, int height, int grid) {
    return attempt([&] {
        core::Settings settings = scene->settings();
        settings.width = width;
        settings.height = height;
        settings.grid = grid;
        settings.quality = 0.0F;
        const simd::Rendering rendering = simd::render(
            *scene, settings, {.isa = simd::available_isas()[static_cast<std::size_t>(isa)]});
        floats.clear();
        for (const core::Color& pixel : rendering.film.pixels())
            floats.insert(floats.end(), {pixel.x, pixel.y, pixel.z});
        return static_cast<const float*>(floats.data());
    });
}

/// Returns the hits of `count` rays of 6 floats each (origin and direction): 22 bytes a ray, as
/// `raylane trace` writes them.
EMSCRIPTEN_KEEPALIVE const char* lanes_trace(int isa, const float* rays, std::size_t count) {
    return attempt([&] {
        std::vector<float> columns[6], t(count), normal[3];
        for (int column = 0; column < 6; ++column)
            for (std::size_t i = 0; i < count; ++i)
                columns[column].push_back(rays[6 * i + static_cast<std::size_t>(column)]);
        for (std::vector<float>& component : normal)
            component.resize(count);
        std::vector<core::ShapeId> shape(count);
        std::vector<std::uint8_t> entering(count), face(count);
        const simd::StreamTracer tracer(*scene, 1,
                                        simd::available_isas()[static_cast<std::size_t>(isa)]);
        simd::RayStream<float> stream{};
        stream.count = count;
        simd::HitStream hits{};
        for (int axis = 0; axis < 3; ++axis) {
            stream.origin[axis] = columns[axis].data();
            stream.direction[axis] = columns[3 + axis].data();
            hits.normal[axis] = normal[axis].data();
        }
        hits.t = t.data();
        hits.shape = shape.data();
        hits.entering = entering.data();
        hits.face = face.data();
        tracer.nearest(stream, hits);
        bytes.clear();
        for (std::size_t i = 0; i < count; ++i) {
            append(t[i]);
            for (const std::vector<float>& component : normal)
                append(component[i]);
            append(shape[i]);
            append(entering[i]);
            append(face[i]);
        }
        return bytes.data();
    });
}

/// Returns a number in a file's text as a float, or NaN if it is not a number.
EMSCRIPTEN_KEEPALIVE float lanes_float(const char* text) {
    return scenes::to_float(text).value_or(std::nanf(""));
}
EMSCRIPTEN_KEEPALIVE double lanes_double(const char* text) {
    double number = std::nan("");
    std::from_chars(text, text + std::strlen(text), number);
    return number;
}
/// Returns a number as the library writes it.
EMSCRIPTEN_KEEPALIVE const char* lanes_float_text(float number) {
    bytes = scenes::to_text(number);
    return bytes.c_str();
}
EMSCRIPTEN_KEEPALIVE const char* lanes_double_text(double number) {
    char text[32];
    bytes.assign(text, std::to_chars(text, text + sizeof text, number).ptr);
    return bytes.c_str();
}

} // extern "C"
