#pragma once

#include "scenes/errors.hpp"
#include "scenes/input_file.hpp"
#include "scenes/json/value.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string_view>

namespace raylane::scenes {

enum class Holds : std::uint8_t {
    one_item,    ///< its value
    item_list,   ///< an array of items
    named_items, ///< an object of items
};

/// What items are like: a few values each, or others within others.
enum class Items : std::uint8_t { plain, nested };

/// A key that the outermost object of a file may have.
struct RootKey {
    std::string_view name;
    Holds holds;
    bool required = false;
    Items items = Items::plain;
};

/// Takes an item, and throws BadInput for what is wrong with it; `name` is its key if it is one of
/// named items. The document is used again for the next one.
using TakeItem =
    std::function<void(const RootKey& key, std::string_view name, const JsonDocument& item)>;

/// Learns of a root key whose items are missing by a mistake that has been added to the errors: it
/// is misspelt, or its value is of another type. Errors that follow from that are not reported.
using MissItems = std::function<void(std::string_view key)>;

/// Where the outermost object begins, and the values in it.
struct Outline {
    TextPosition root;
    std::map<std::string_view, TextPosition> values; ///< by root key

    bool has(std::string_view key) const { return values.contains(key); }
    /// Of the value with this key, or of the object that lacks it.
    TextPosition of(std::string_view key) const {
        const auto found = values.find(key);
        return found != values.end() ? found->second : root;
    }
};

/// Reads a JSON text with comments, whose outermost value is an object, and hands over its items,
/// one by one and in the order of the file, so that a long list is never held in memory.
/// `parameters`: what "$name" stands for in them.
///
/// Adds to `errors` what `take` throws, and unknown, missing and repeated keys, and goes on behind
/// them. Throws BadInput with all errors so far where it cannot: for what is not JSON, for items
/// too deep or too large to belong to a scene, and where there are too many errors already.
Outline read_items(InputFile& file, std::span<const RootKey> keys, const TakeItem& take,
                   const MissItems& miss, InputErrors& errors, Parameters* parameters = nullptr);

} // namespace raylane::scenes
