#pragma once

#include "core/hierarchy/workers.hpp"
#include "scenes/formats/built/layout.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Checksums of built scenes, stored in the header so that a changed byte is detected. They use
/// xxHash's XXH3: 64 bits of each piece of 1 MiB, and of the list of these. They protect against
/// accidents only, not against tampering.
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

/// Returns the checksum of bytes that are all in memory, computed by all workers.
std::uint64_t checksum_of(std::span<const std::byte> bytes, core::Workers& workers);

/// Returns the checksum for a header, where `behind` is the checksum of all bytes behind the
/// header.
std::uint64_t checksum_of(layout::Header header, std::uint64_t behind);

} // namespace raylane::scenes
