#include "scenes/tool/checkpoint/tile_records.hpp"

#include <algorithm>
#include <cstring>

namespace raylane::scenes {

namespace {

using Counts = simd::EngineCounters::Numbers;

class Writer {
  public:
    explicit Writer(std::string& bytes) : bytes_(bytes) {}
    template <class T>
    void operator()(const T& value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

  private:
    std::string& bytes_;
};

class Reader {
  public:
    explicit Reader(std::span<const char> bytes) : bytes_(bytes) {}
    template <class T>
    void operator()(T& value) {
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_ = bytes_.subspan(sizeof value);
    }

  private:
    std::span<const char> bytes_;
};

/// Visits all numbers of a tile in the order of its record, to read or write them.
template <class Film, class Aovs, class Visit>
void visit_pixels(const core::Region& tile, const core::Region& crop, Film& film, Aovs* aovs,
                  const Visit& visit) {
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            auto& color = film.at(x, y);
            visit(color.x);
            visit(color.y);
            visit(color.z);
        }
    if (film.has_alpha())
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                visit(film.alpha_at(x, y));
    if (aovs == nullptr) return;
    const core::Region part = tile.within(crop);
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x) {
            const std::size_t i = aovs->index(x - crop.x0, y - crop.y0);
            visit(aovs->depth[i]);
            visit(aovs->normal[i].x);
            visit(aovs->normal[i].y);
            visit(aovs->normal[i].z);
            visit(aovs->shape[i]);
            visit(aovs->material[i]);
            visit(aovs->samples[i]);
        }
}

constexpr std::size_t bytes_of_aovs =
    4 * sizeof(float) + sizeof(core::ShapeId) + sizeof(core::MaterialIndex) + sizeof(std::uint32_t);

} // namespace

TileRecords::TileRecords(const core::Settings& settings, const simd::RenderOptions& options)
    : grid_(simd::grid_of(settings, options)), crop_(options.crop.value_or(grid_.part())),
      alpha_(settings.alpha), aovs_(options.aovs) {}

std::size_t TileRecords::bytes(std::size_t number) const {
    const core::Region region = grid_.tile(number), part = region.within(crop_);
    std::size_t bytes = sizeof(Counts) + static_cast<std::size_t>(region.pixels()) *
                                             (alpha_ ? 4 : 3) * sizeof(float);
    if (aovs_ && part.x0 < part.x1 && part.y0 < part.y1)
        bytes += static_cast<std::size_t>(part.pixels()) * bytes_of_aovs;
    return bytes;
}

void TileRecords::append(const simd::FinishedTile& tile, std::string& bytes) const {
    Writer write(bytes);
    for (const std::uint64_t number : tile.counters.as_numbers())
        write(number);
    visit_pixels(tile.region, crop_, tile.film, aovs_ ? &tile.aovs : nullptr,
                 [&](const auto& value) { write(value); });
}

void TileRecords::fill(const simd::TileToFill& tile, std::span<const char> bytes) const {
    Reader read(bytes);
    Counts counts;
    for (std::uint64_t& number : counts)
        read(number);
    tile.counters = simd::EngineCounters::of_numbers(counts);
    visit_pixels(tile.region, crop_, tile.film, aovs_ ? &tile.aovs : nullptr,
                 [&](auto& value) { read(value); });
}

} // namespace raylane::scenes
