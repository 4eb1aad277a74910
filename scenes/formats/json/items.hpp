#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/files/input_file.hpp"
#include "scenes/formats/json/value.hpp"

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

/// Whether items have a few values each, or are nested.
enum class Items : std::uint8_t { plain, nested };

/// A key that the outermost object of a file may have.
struct RootKey {
    std::string_view name;
    Holds holds;
    bool required = false;
    Items items = Items::plain;
};

/// Takes an item, and throws BadInput if the item is invalid. `name` is the item's key if items are
/// named. The document is reused for the next item.
using TakeItem =
    std::function<void(const RootKey& key, std::string_view name, const JsonDocument& item)>;

/// Receives a root key whose items are missing because of an error that has been added: the key is
/// misspelt or repeated, or its value has the wrong type. Errors that follow from that are not
/// reported.
using MissItems = std::function<void(std::string_view key)>;

/// Positions of the outermost object and of the values in it.
struct Outline {
    TextPosition root;
    std::map<std::string_view, TextPosition> values; ///< by root key

    bool has(std::string_view key) const { return values.contains(key); }
    /// Returns the position of this key's value, or that of the object if the key is missing.
    TextPosition of(std::string_view key) const {
        const auto found = values.find(key);
        return found != values.end() ? found->second : root;
    }
};

/// Reads a JSON text with comments, whose outermost value is an object. Hands over its items one by
/// one, in the order of the file, so that a long list is never held in memory. `parameters`: the
/// values of "$name" in the items.
///
/// Adds to `errors` the exceptions that `take` throws, and unknown, missing and repeated keys, and
/// continues after them. Throws BadInput with all errors so far if it cannot continue: if the text
/// is not JSON, if an item is too deep or too large for a scene, or after too many errors.
Outline read_items(InputFile& file, std::span<const RootKey> keys, const TakeItem& take,
                   const MissItems& miss, InputErrors& errors, Parameters& parameters);

} // namespace raylane::scenes
