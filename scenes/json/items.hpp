#pragma once

#include "scenes/input_file.hpp"
#include "scenes/json/value.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace raylane::scenes {

enum class Holds : std::uint8_t {
    one_item,    ///< its value
    item_list,   ///< an array of items
    named_items, ///< an object of items
};

/// A key that the outermost object of a file may have.
struct RootKey {
    std::string_view name;
    Holds holds;
    bool required = false;
};

/// Takes an item; `name` is its key if it is one of named items. The document is used again for the
/// next one.
using TakeItem =
    std::function<void(const RootKey& key, std::string_view name, const JsonDocument& item)>;

/// Reads a JSON text with comments, whose outermost value is an object, and hands over its items,
/// one by one and in the order of the file, so that a long list is never held in memory. Throws
/// BadInput for what is not JSON, for unknown, missing and repeated keys, and for items too deep or
/// too large to belong to a scene.
void read_items(InputFile& file, std::span<const RootKey> keys, const TakeItem& take);

} // namespace raylane::scenes
