#pragma once

#include "scenes/annotation/sheet.hpp"

#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Renders sheets over images, by a module that has cairo and pango.
class Overlay {
  public:
    /// Loads the module. Throws SystemRefused, with `what_fails` and the reason, if it is missing.
    explicit Overlay(const std::string& what_fails);

    /// Returns the family that texts have in place of a font that is not installed.
    std::optional<std::string> replaced_font(const std::string& font) const;

    /// Returns the pixels of a sheet: width * height premultiplied sRGB codes 0xAARRGGBB, row by
    /// row. Throws SystemRefused.
    std::vector<std::uint32_t> pixels(const Sheet& sheet) const;
    /// Composites a sheet over a film that covers `part` of the image. Throws SystemRefused.
    void cover(const Sheet& sheet, const core::Region& part, core::Transfer transfer,
               core::Film& film) const;

    static constexpr int most = 32767; ///< pixels along a side

  private:
    RenderSheet render_;
    ReplacedFont replaced_;
};

/// Returns the code 0xRRGGBB of a pixel of an overlay over a code 0xRRGGBB.
std::uint32_t over(std::uint32_t pixel, std::uint32_t code);

} // namespace raylane::scenes
