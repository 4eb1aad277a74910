#pragma once

#include "scenes/input_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace raylane::scenes {

/// Opens the files that a scene includes, whatever its format. A pipe or a device is no file to
/// include, as it may never end.
class IncludedFiles {
  public:
    static constexpr std::size_t deepest = 16, most = 1000;
    static constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30; ///< of each

    /// Opens a file as text. `name`: the scene's word for it. `depth`: of the including file, from
    /// 0. Throws core::InvalidValue with the rule that the name breaks.
    std::unique_ptr<InputFile> open(const std::filesystem::path& path, std::string_view name,
                                    std::size_t depth);

  private:
    std::size_t opened_ = 0;
};

} // namespace raylane::scenes
