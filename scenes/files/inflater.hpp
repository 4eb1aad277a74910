#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace raylane::scenes {

/// Decompresses gzip data, which may consist of several members. Without zlib, the constructor
/// throws BadInput.
class Inflater {
  public:
    /// Fills a buffer with compressed data. Returns the number of bytes, 0 at the end.
    using Source = std::function<std::size_t(std::span<char>)>;

    /// `name`: the file's name in messages. `begin`: the first bytes of the compressed data;
    /// `source` returns those that follow.
    Inflater(std::string name, std::string begin, Source source);
    ~Inflater();

    std::size_t read(std::span<char> buffer);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace raylane::scenes
