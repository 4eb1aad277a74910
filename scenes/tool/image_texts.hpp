#pragma once

#include "simd/query/engine_counters.hpp"
#include "simd/wavefront/render.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// The texts in an image's file about its scene, its options and its rays.
namespace raylane::scenes {

using ImageTexts = std::vector<std::pair<std::string, std::string>>;

bool has_text(const ImageTexts& texts, const std::string& name);

/// Returns the text under a name. Throws BadInput with the image's name if it is missing.
const std::string& text_in(const std::string& image, const ImageTexts& texts,
                           const std::string& name);

/// Returns in one line everything except the scene that the bits of an image depend on. It includes
/// the settings that a Comment omits because the scene has them. All parts of an image have the
/// same line.
std::string options_line(core::Settings settings, const simd::RenderOptions& options);

/// Returns the checksum of that line as hexadecimal digits, which an image stores as Options.
std::string fingerprint_of_options(const core::Settings& settings,
                                   const simd::RenderOptions& options);

/// One of several parts of an image, each of which is rendered by one process. A part consists of
/// the tiles whose numbers have the same remainder modulo `count`, so that all parts take about as
/// long.
struct ImagePart {
    std::size_t number; ///< from 1
    std::size_t count;

    bool has(std::size_t tile) const { return tile % count == number - 1; }
    /// Returns a text such as "3/16".
    std::string text() const;
};

/// Parses a text such as "3/16". Returns nothing if it is malformed.
std::optional<ImagePart> image_part_of(const std::string& text);

/// The numbers of rays that each tier decided. Rays that one tier leaves in doubt go to the next.
/// The numbers depend slightly on the instruction set; the hits do not.
struct RayTiers {
    std::uint64_t first = 0;     ///< rays decided by float bounds and double arithmetic
    std::uint64_t second = 0;    ///< rays decided by tighter bounds on the results of the first
    std::uint64_t reference = 0; ///< rays and paths decided by exact arithmetic, one by one
    std::uint64_t widened = 0;   ///< ray-shape tests beyond double precision, in the second

    RayTiers() = default;
    explicit RayTiers(const simd::EngineCounters& counters);

    RayTiers& operator+=(const RayTiers& other);
    /// Returns "12 at first sight, 2 at second, 0 by the reference, 0 tests beyond double".
    std::string text() const;
};

/// Parses a text of RayTiers::text(). Returns nothing if it is malformed.
std::optional<RayTiers> ray_tiers_of(const std::string& text);

} // namespace raylane::scenes
