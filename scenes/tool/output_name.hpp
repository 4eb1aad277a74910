#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace raylane::scenes {

/// Returns the default name of an output: the scene's file name without its folder and with another
/// extension.
std::string default_output(const std::filesystem::path& scene, const std::string& ending);

/// The names of several files, made from a pattern with one number, such as "frame-%05d.png". "%%"
/// stands for one %.
class NumberedName {
  public:
    /// Throws BadInput with the option's name if the pattern is malformed. `needs_number`: false if
    /// a pattern without a number is acceptable, for a single file.
    NumberedName(const std::string& option, const std::string& pattern, bool needs_number);
    std::string operator()(std::size_t number) const;

  private:
    std::string before_, behind_;
    bool has_number_ = false;
    std::size_t width_ = 0;
    char fill_ = ' ';
};

} // namespace raylane::scenes
