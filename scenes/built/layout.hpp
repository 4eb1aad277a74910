#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

/// What a file of a built scene (.rl) is: a header, a directory, and what that names, each from a
/// multiple of 64 bytes on. The numbers in it are those of memory, so that it is used where it
/// lies; none but what raylane itself has there, and raised with it, is `layout::format`.
namespace raylane::scenes::layout {

static_assert(std::endian::native == std::endian::little, "the file's order of bytes");

inline constexpr std::size_t alignment = 64;
/// Another number as soon as one of the arrays is another or means something else.
inline constexpr std::uint32_t format = 3;
inline constexpr char magic[16] = {'r', 'a', 'y', 'l', 'a', 'n',  'e',    ' ',
                                   'b', 'u', 'i', 'l', 't', '\n', '\x1A', '\0'};

struct Header {
    char begin[sizeof magic];
    std::uint32_t format;
    std::uint32_t section_count;
    std::uint64_t bytes; ///< of the file
    /// Of this header, with the checksum of all that is behind it in this place.
    std::uint64_t checksum;
    std::uint64_t unused[3];
};
static_assert(sizeof(Header) == alignment);

struct Section {
    char name[32]; ///< with zeros behind it
    std::uint64_t element_bytes;
    std::uint64_t count;
    std::uint64_t place; ///< of the first in the file
    std::uint64_t unused;
};
static_assert(sizeof(Section) == alignment);

constexpr std::size_t rounded_up(std::size_t bytes) {
    return (bytes + alignment - 1) / alignment * alignment;
}

/// Names of sections; those of a kind of shape have the kind before them.
inline constexpr const char* scene = "scene"; ///< JSON: all but the shapes
inline constexpr const char* staging = "staging";
inline constexpr const char* nodes = "nodes";
inline constexpr const char* materials = "materials";
inline constexpr const char* polygons = "polygons";
inline constexpr const char* counts = "counts"; ///< of shapes, duplicates included, by kind
inline constexpr const char* radii = "radii";   ///< of packed spheres, by number
inline constexpr const char* rows = "rows";     ///< of packed spheres
inline constexpr const char* packed = "packed"; ///< spheres
inline constexpr const char* blocks = ".blocks";
inline constexpr const char* doubles = ".doubles";

} // namespace raylane::scenes::layout
