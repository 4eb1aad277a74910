#pragma once

#include "scenes/files/input_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace raylane::scenes {

/// The components of an image's pixels in one sequence: floats, or codes of 8 or 16 bits. A code
/// stands for its fraction of the largest code. Codes are stored in the size that they have in the
/// file.
class Components {
  public:
    Components() = default;
    template <class Component>
    explicit Components(std::vector<Component> components) : components_(std::move(components)) {}

    std::size_t size() const {
        return std::visit([](const auto& values) { return values.size(); }, components_);
    }

    float operator[](std::size_t i) const {
        if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&components_))
            return static_cast<float>((*bytes)[i]) / 255.0F;
        if (const auto* words = std::get_if<std::vector<std::uint16_t>>(&components_))
            return static_cast<float>((*words)[i]) / 65535.0F;
        return (*std::get_if<std::vector<float>>(&components_))[i];
    }

    /// Returns true if both have the same type, number and bits of components.
    bool is_same(const Components& other) const {
        return std::visit(
            [&]<class Component>(const std::vector<Component>& values) {
                const auto* others = std::get_if<std::vector<Component>>(&other.components_);
                return others != nullptr && others->size() == values.size() &&
                       (values.empty() || std::memcmp(others->data(), values.data(),
                                                      values.size() * sizeof values[0]) == 0);
            },
            components_);
    }

    /// Returns all components as floats.
    std::vector<float> floats() const {
        std::vector<float> floats(size());
        for (std::size_t i = 0; i < floats.size(); ++i)
            floats[i] = (*this)[i];
        return floats;
    }

  private:
    std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>>
        components_;
};

/// An image with the components that its file has.
struct Image {
    int width = 0;
    int height = 0;
    /// True if the components are linear floats (EXR, HDR, PFM); false if they are codes divided by
    /// the largest code (PNG, TIFF).
    bool linear_float = false;
    Components rgb;   ///< width * height * 3, rows from the top down
    Components alpha; ///< width * height; empty: 1 everywhere
    std::string name; ///< of the file, for messages
    /// Texts of a PNG, TIFF or EXR beside the pixels, same as ImageOptions::texts.
    std::vector<std::pair<std::string, std::string>> texts{};
    int bits = 0; ///< per component in the file: 8 or 16 (PNG, TIFF), 16 or 32 (EXR), 0 (others)
};

/// Reads a PNG, TIFF, EXR, HDR or PFM image; the content decides which. Grey becomes RGB. Throws
/// BadInput for other formats and for malformed or excessively large images, and SystemRefused.
Image read_image(const std::filesystem::path& path);
Image read_image(InputFile& file);

} // namespace raylane::scenes
