#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <variant>
#include <vector>

namespace raylane::scenes {

/// The components of a picture's pixels in one sequence: floats, or codes of 8 or 16 bits. A code
/// stands for its fraction of the largest code. Codes are stored in the size that they have in the
/// file.
class Components {
  public:
    Components() = default;
    template <class Component>
    explicit Components(std::vector<Component> components) : components_(std::move(components)) {}

    std::size_t size() const {
        return std::visit([](const auto& all) { return all.size(); }, components_);
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
            [&]<class Component>(const std::vector<Component>& all) {
                const auto* others = std::get_if<std::vector<Component>>(&other.components_);
                return others != nullptr && others->size() == all.size() &&
                       (all.empty() ||
                        std::memcmp(others->data(), all.data(), all.size() * sizeof all[0]) == 0);
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

} // namespace raylane::scenes
