#pragma once

#include <span>
#include <string_view>

namespace raylane::scenes {

/// A page of the documentation, in Markdown.
struct Page {
    std::string_view topic, text;
};

/// Returns the pages that an installed copy has: the README first.
std::span<const Page> documentation_pages();

} // namespace raylane::scenes
