#pragma once

#include "scenes/files/included_files.hpp"
#include "scenes/formats/json/items.hpp"
#include "scenes/formats/json/value.hpp"

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace raylane::scenes {

/// The files that are being read, each included by the one before it.
class Inclusion {
  public:
    explicit Inclusion(const std::filesystem::path& first) : files_{first} {}

    /// Returns how many included files are still being read.
    std::size_t depth() const { return files_.size() - 1; }

    /// Opens the file that a value names, relative to the file that holds the value, and calls
    /// `read` for it. Skips a file that has already been read. Throws BadInput with the value's
    /// place if the file does not exist or is still being read. Exceptions thrown by `read`
    /// propagate.
    void include(const JsonValue& value, const std::function<void(InputFile&)>& read);

  private:
    IncludedFiles opener_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::filesystem::path> read_; // read to their ends
};

/// Takes only the parameters of a file and of the files that it includes, in the order in which a
/// scene with these `keys` is read. Leaves all errors to be reported when the scene is read.
void take_parameters(InputFile& file, std::span<const RootKey> keys, Parameters& parameters);

} // namespace raylane::scenes
