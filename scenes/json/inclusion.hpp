#pragma once

#include "scenes/included_files.hpp"
#include "scenes/json/value.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace raylane::scenes {

/// The files that are being read, each included by the one before it.
class Inclusion {
  public:
    explicit Inclusion(const std::filesystem::path& first) : files_{first} {}

    /// How many have been included that are still being read.
    std::size_t depth() const { return files_.size() - 1; }

    /// Opens the file that a value names, by where the file is that it stands in, and has it read.
    /// Once: a file that has been read is passed over. Throws BadInput with the value's place if
    /// there is none, or it is being read at this moment; and what `read` throws.
    void include(const JsonValue& value, const std::function<void(InputFile&)>& read);

  private:
    IncludedFiles opener_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::filesystem::path> read_; // and done with
};

} // namespace raylane::scenes
