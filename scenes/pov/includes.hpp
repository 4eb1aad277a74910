#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raylane::scenes::pov {

/// What is known of the files that come with POV-Ray, in its language; nothing for other names.
std::optional<std::string> standard_include(std::string_view name);

} // namespace raylane::scenes::pov
