#include "core/shapes/material_indices.hpp"

#include <algorithm>

namespace raylane::core {

namespace {

int width_of(MaterialIndex material) {
    return material == 0 ? 0 : material < 0x100 ? 1 : material < 0x10000 ? 2 : 4;
}

} // namespace

void MaterialIndices::push_back(MaterialIndex material) {
    constexpr std::size_t least = 64;
    const int width = std::max(width_, width_of(material));
    if (width != width_ || room_.is_shared() ||
        room_.bytes() < (size_ + 1) * static_cast<std::size_t>(width))
        rearrange(width, size_ < reserved_ ? reserved_ : std::max(least, 2 * size_));
    put(size_++, material);
}

void MaterialIndices::put(std::size_t i, MaterialIndex material) {
    const auto put_as = [&](auto number) {
        std::memcpy(room_.data() + i * sizeof number, &number, sizeof number);
    };
    if (width_ == 1) put_as(static_cast<std::uint8_t>(material));
    if (width_ == 2) put_as(static_cast<std::uint16_t>(material));
    if (width_ == 4) put_as(static_cast<std::uint32_t>(material));
}

void MaterialIndices::rearrange(int width, std::size_t count) {
    MaterialIndices other;
    other.width_ = width;
    other.room_ = BigArray<std::uint8_t>(count * static_cast<std::size_t>(width));
    if (width == width_ && size_ > 0 && width > 0)
        std::memcpy(other.room_.data(), room_.data(), stored().size());
    else
        for (std::size_t i = 0; i < size_; ++i)
            other.put(i, stored_at(i));
    width_ = width;
    room_ = std::move(other.room_);
}

void MaterialIndices::push_back_repeated(const MaterialIndices& of_one, std::size_t times) {
    const std::size_t first = size();
    if (times == 0 || of_one.size() == 0) return;
    repeats_.push_back({first, first + times * of_one.size(), size_,
                        std::make_shared<const MaterialIndices>(of_one)});
}

const MaterialIndices::Repeat* MaterialIndices::repeat_before(std::size_t i) const {
    const auto after = std::upper_bound(
        repeats_.begin(), repeats_.end(), i,
        [](std::size_t index, const Repeat& repeat) { return index < repeat.first; });
    return after == repeats_.begin() ? nullptr : &*(after - 1);
}

MaterialIndex MaterialIndices::at_any(std::size_t i) const {
    const Repeat* const repeat = repeat_before(i);
    if (repeat != nullptr && i < repeat->end)
        return (*repeat->of_one)[(i - repeat->first) % repeat->of_one->size()];
    return stored_at(repeat == nullptr ? i : i - repeat->end + repeat->stored);
}

std::size_t MaterialIndices::stored_index(std::size_t i) const {
    const Repeat* const repeat = repeats_.empty() ? nullptr : repeat_before(i);
    if (repeat == nullptr) return i;
    return i < repeat->end ? no_index : i - repeat->end + repeat->stored;
}

MaterialIndices MaterialIndices::renumbered(std::span<const MaterialIndex> new_index) const {
    MaterialIndices result;
    result.reserve(size_);
    for (std::size_t i = 0; i < size_; ++i)
        result.push_back(new_index[stored_at(i)]);
    for (Repeat repeat : repeats_) {
        repeat.of_one =
            std::make_shared<const MaterialIndices>(repeat.of_one->renumbered(new_index));
        result.repeats_.push_back(std::move(repeat));
    }
    return result;
}

MaterialIndices MaterialIndices::all_stored() const {
    MaterialIndices joined;
    for (std::size_t i = 0; i < size(); ++i)
        joined.push_back((*this)[i]);
    return joined;
}

void MaterialIndices::reserve(std::size_t size) {
    reserved_ = size;
    if (size > size_ && room_.bytes() < size * static_cast<std::size_t>(width_))
        rearrange(width_, size);
}

void MaterialIndices::shrink_to_fit() {
    if (room_.bytes() > stored().size()) rearrange(width_, size_);
}

} // namespace raylane::core
