#pragma once

#include <cstdint>
#include <string>
#include <zlib.h>

namespace raylane::tests {

inline std::string big_endian(std::uint32_t number) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += static_cast<char>(number >> shift);
    return text;
}

/// Returns a chunk of a PNG, with its length and checksum.
inline std::string png_chunk(const std::string& type, const std::string& content) {
    const std::string text = type + content;
    const auto checksum =
        ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    return big_endian(static_cast<std::uint32_t>(content.size())) + text +
           big_endian(static_cast<std::uint32_t>(checksum));
}

} // namespace raylane::tests
