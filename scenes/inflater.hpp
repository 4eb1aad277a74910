#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace raylane::scenes {

/// Gives back what gzip has compressed, one piece or several one after the other. Built without
/// zlib, it says that it cannot.
class Inflater {
  public:
    /// Fills a buffer with what is compressed; 0 at the end.
    using Source = std::function<std::size_t(std::span<char>)>;

    /// `name`: what messages call the file; `begin`: its first bytes, which `source` follows.
    Inflater(std::string name, std::string begin, Source source);
    ~Inflater();

    std::size_t read(std::span<char> buffer);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace raylane::scenes
