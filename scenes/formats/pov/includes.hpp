#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes::pov {

/// A file that comes with POV-Ray, as far as raylane supports it.
struct StandardFile {
    std::string_view name;
    std::vector<std::string_view> includes; ///< other files that it includes
    /// In POV-Ray's language, by the declared name; empty for unsupported names.
    std::map<std::string, std::string, std::less<>> declarations;
};

/// Returns null for other names.
const StandardFile* standard_file(std::string_view name);

} // namespace raylane::scenes::pov
