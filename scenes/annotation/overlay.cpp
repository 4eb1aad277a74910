#include "scenes/annotation/overlay.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/module.hpp"

#include <algorithm>
#include <cstddef>

namespace raylane::scenes {

namespace {

void* function_named(const char* name, const std::string& what_fails) {
    return function_of(
        {"raylane-annotation.so", name, "pango at build time (Debian: libpango1.0-dev)"},
        what_fails);
}

} // namespace

Overlay::Overlay(const std::string& what_fails)
    : render_(reinterpret_cast<RenderSheet>(function_named(render_sheet_name, what_fails))),
      replaced_(reinterpret_cast<ReplacedFont>(function_named(replaced_font_name, what_fails))) {}

std::optional<std::string> Overlay::replaced_font(const std::string& font) const {
    const char* const used = replaced_(font.c_str());
    return used != nullptr ? std::optional<std::string>(used) : std::nullopt;
}

std::vector<std::uint32_t> Overlay::pixels(const Sheet& sheet) const {
    std::vector<std::uint32_t> result(static_cast<std::size_t>(sheet.width) *
                                      static_cast<std::size_t>(sheet.height));
    if (const char* const why = render_(&sheet, result.data()))
        throw SystemRefused(std::string("annotations: cannot be rendered: ") + why);
    return result;
}

void Overlay::cover(const Sheet& sheet, const core::Region& part, core::Transfer transfer,
                    core::Film& film) const {
    blend(pixels(sheet), sheet.width, part, transfer, film);
}

std::uint32_t over(std::uint32_t pixel, std::uint32_t code) {
    constexpr std::uint32_t most = 255;
    const std::uint32_t below = most - (pixel >> 24);
    std::uint32_t result = 0;
    for (const int shift : {0, 8, 16}) {
        const std::uint32_t under = ((code >> shift & most) * below + most / 2) / most;
        result |= std::min(most, (pixel >> shift & most) + under) << shift;
    }
    return result;
}

} // namespace raylane::scenes
