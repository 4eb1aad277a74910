#pragma once

#include "core/scene/film.hpp"
#include "core/scene/surroundings.hpp"
#include "scenes/atomic_file.hpp"

namespace raylane::scenes {

/// A picture's file. Its ending tells the format: .png (8 bits through the transfer curve), .hdr
/// (Radiance, linear, a shared exponent) or .pfm (linear floats, unchanged). "-" is standard
/// output, in PNG.
class OutputFile {
  public:
    /// Throws BadInput if the ending is none of these, SystemRefused if the file cannot be written,
    /// as far as can be known without writing it.
    explicit OutputFile(const std::filesystem::path& path);

    /// Claims what is known of the room that a picture of this size takes. Throws SystemRefused if
    /// there is none.
    void reserve(int width, int height);

    /// Writes the picture; once. `transfer` concerns .png alone. Throws SystemRefused, and then
    /// there is no new file.
    void commit(const core::Film& film, core::Transfer transfer);

  private:
    enum class Format { png, hdr, pfm };
    static Format format_of(const std::filesystem::path& path);
    void write_png(const core::Film& film, core::Transfer transfer);
    void write_hdr(const core::Film& film);
    void write_pfm(const core::Film& film);

    Format format_; // before the file: a wrong ending leaves no trace
    AtomicFile file_;
};

} // namespace raylane::scenes
