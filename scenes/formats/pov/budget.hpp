#pragma once

#include "scenes/formats/pov/scanner.hpp"

#include <cstddef>
#include <memory>

namespace raylane::scenes::pov {

/// Limits the cost of reading a scene: words stand for time, bytes for memory. Both limits grow
/// with the files' length, so that only loops, macros and arrays can reach them.
class Budget {
  public:
    static constexpr std::size_t max_words = 100'000'000, words_for_each = 8;
    static constexpr std::size_t max_bytes = std::size_t{1} << 28, bytes_for_each = 64;
    /// Words that are counted for each texture, and for each shape that is put into the scene.
    static constexpr std::size_t words_of_item = 24;

    void add_file(std::size_t bytes) { file_bytes_ += bytes; }

    /// Fails above the limit.
    void count_words(std::size_t words, const Place& place);

    /// Counts bytes of memory until the pointer is released. Fails above the limit.
    std::shared_ptr<void> reserve(std::size_t bytes, const Place& place);

    /// Counts bytes of memory permanently. Fails above the limit.
    void keep(std::size_t bytes, const Place& place);

  private:
    std::size_t words_ = 0, file_bytes_ = 0;
    std::shared_ptr<std::size_t> bytes_ = std::make_shared<std::size_t>(0);
};

} // namespace raylane::scenes::pov
