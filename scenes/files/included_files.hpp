#pragma once

#include "scenes/files/input_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace raylane::scenes {

/// Opens the files that a scene includes, in any format. Refuses pipes and devices, as they may
/// never end.
class IncludedFiles {
  public:
    static constexpr std::size_t deepest = 16, most = 1000;
    static constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30; ///< of each file

    /// Opens a file as text. `name` is the file's name in the scene. `depth` is that of the
    /// including file, from 0. Throws core::InvalidValue with the rule that the name breaks.
    std::unique_ptr<InputFile> open(const std::filesystem::path& path, std::string_view name,
                                    std::size_t depth);
    /// Same for a file that is not a text, and includes no other file.
    std::unique_ptr<InputFile> open_bytes(const std::filesystem::path& path, std::string_view name);

  private:
    std::size_t opened_ = 0;
};

} // namespace raylane::scenes
