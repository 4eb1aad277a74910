#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

/// Layout of a built scene's file (.rl): a header, a directory, and the sections that the directory
/// names, each at a multiple of 64 bytes. Numbers are stored as in memory, so that the file is used
/// in place. Arrays have raylane's own layout in memory; `layout::format` is raised when that
/// changes.
namespace raylane::scenes::layout {

static_assert(std::endian::native == std::endian::little, "the file's order of bytes");

inline constexpr std::size_t alignment = 64;
/// Changes whenever an array's layout or meaning changes.
inline constexpr std::uint32_t format = 5;
inline constexpr char magic[16] = {'r', 'a', 'y', 'l', 'a', 'n',  'e',    ' ',
                                   'b', 'u', 'i', 'l', 't', '\n', '\x1A', '\0'};

struct Header {
    char begin[sizeof magic];
    std::uint32_t format;
    std::uint32_t section_count;
    std::uint64_t bytes; ///< size of the file
    /// Checksum of this header, computed with the checksum of all bytes behind the header in this
    /// field.
    std::uint64_t checksum;
    std::uint64_t unused[3];
};
static_assert(sizeof(Header) == alignment);

struct Section {
    char name[32]; ///< padded with zeros
    std::uint64_t element_bytes;
    std::uint64_t count;
    std::uint64_t place; ///< offset of the first element in the file
    std::uint64_t unused;
};
static_assert(sizeof(Section) == alignment);

constexpr std::size_t rounded_up(std::size_t bytes) {
    return (bytes + alignment - 1) / alignment * alignment;
}

/// Names of sections. A section of one kind of shape has the kind as a prefix.
inline constexpr const char* scene = "scene"; ///< JSON: everything except the shapes
inline constexpr const char* auto_camera = "staging";
inline constexpr const char* nodes = "nodes";
inline constexpr const char* materials = "materials";
inline constexpr const char* polygons = "polygons";
inline constexpr const char* counts = "counts"; ///< shapes of each kind, duplicates included
inline constexpr const char* radii = "radii";   ///< of packed spheres, by palette index
inline constexpr const char* rows = "rows";     ///< of packed spheres
inline constexpr const char* packed = "packed"; ///< blocks of packed spheres
inline constexpr const char* blocks = ".blocks";
inline constexpr const char* doubles = ".doubles";
inline constexpr const char* merged = ".merged"; ///< shapes that equal stored ones

} // namespace raylane::scenes::layout
