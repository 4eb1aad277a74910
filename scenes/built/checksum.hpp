#pragma once

#include "core/hierarchy/workers.hpp"
#include "scenes/built/layout.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Of a file of a built scene: what its header says, so that a byte that is another is found. By
/// xxHash's XXH3, 64 bits of each piece of 1 MiB, and of all of these; against accidents alone.
namespace raylane::scenes {

/// The checksum of bytes that come one after the other.
class Checksum {
  public:
    Checksum();
    ~Checksum();
    Checksum(const Checksum&) = delete;
    Checksum& operator=(const Checksum&) = delete;

    void add(std::span<const std::byte> bytes);
    std::uint64_t result() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
    std::size_t in_piece_ = 0;
    std::vector<std::uint64_t> pieces_;
};

/// The same of bytes that are there, by all workers.
std::uint64_t checksum_of(std::span<const std::byte> bytes, core::Workers& workers);

/// What a header is to have, whose file has that checksum behind it.
std::uint64_t checksum_of(layout::Header header, std::uint64_t behind);

} // namespace raylane::scenes
