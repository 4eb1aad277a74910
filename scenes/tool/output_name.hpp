#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace raylane::scenes {

/// That of a picture without a name: the scene's, here, with another ending.
std::string default_output(const std::filesystem::path& scene, const std::string& ending);

/// The name of each of several files: of a pattern with one number, such as "frame-%05d.png", where
/// %% is one %.
class NumberedName {
  public:
    /// Throws BadInput, by the name of the option, for what is none. `needs_number`: false if one
    /// without will do, for one file.
    NumberedName(const std::string& option, const std::string& pattern, bool needs_number);
    std::string operator()(std::size_t number) const;

  private:
    std::string before_, behind_;
    bool has_number_ = false;
    std::size_t width_ = 0;
    char fill_ = ' ';
};

} // namespace raylane::scenes
