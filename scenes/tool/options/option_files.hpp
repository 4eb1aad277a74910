#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/tool/options/option.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Files of options, "@FILE" on the command line. A file has one option a line, as "--size 8.5cm"
/// or "size 8.5cm", or an argument such as SCENE. The rest of the line is the value, with or
/// without quotes. Lines that begin with # are comments. The command line overrides the files, and
/// a file overrides the ones before it. Lists such as --show begin with those of the files.
class OptionFiles {
  public:
    /// Reads the files that `arguments`, the words behind the command's name, mention. `options`:
    /// those of the command. Options that only `others` has, those of another command, are ignored.
    /// Throws BadInput, with file and line, also for invalid values.
    OptionFiles(const std::vector<std::string>& arguments, const OptionTable& options,
                const OptionTable& others);

    /// Returns the arguments without files.
    const std::vector<std::string>& arguments() const { return arguments_; }
    /// Returns the error with the file and line of the option that its text begins with, if it came
    /// from a file.
    BadInput with_place(const BadInput& bad) const;

  private:
    struct Line {
        std::string file;
        std::size_t number; ///< from 1
        const AnyOption* option;
        std::string value;
    };

    void read(const std::string& file, const OptionTable& options, const OptionTable& others);
    /// Returns true if a line gives its option.
    bool is_used(std::size_t line) const;

    std::vector<Line> lines_;
    std::vector<const AnyOption*> on_command_line_;
    std::vector<std::string> arguments_;
};

} // namespace raylane::scenes
