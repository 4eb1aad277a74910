#pragma once

#include "core/beams/beam_tracer.hpp"
#include "core/beams/survey.hpp"
#include "core/scene/region.hpp"

#include <vector>

namespace raylane::core {

/// Chooses the samples of a region's pixels in an image of a given quality (Settings::quality). In
/// each round every pixel gets all the samples that it wants, in order, until no pixel wants more:
///
/// 1. Each pixel gets the samples of a regular grid, if the survey expects them to be enough: one
///    sample at the pixel's middle, for pixels whose neighbours are about equal; or more, for all.
/// 2. The other pixels start again with points of a sequence. They double their samples until the
///    image's survey finds them sufficient. Pixels in which beams find that a shape far thinner
///    than a pixel may show continue until a sample hits the shape, or until the shape would be too
///    small to matter.
/// 3. A pixel that is done with less than half of the samples of most of its neighbours gets more,
///    and so does one with fewer if its samples are all alike.
///
/// The samples of a pixel depend on scene and settings alone. For use by one thread.
class RegionSamples {
  public:
    /// `survey` must be finished before the first round ends.
    RegionSamples(const Scene& scene, const Settings& settings, const Survey& survey);

    /// Side, in pixels, of the squares that are tested together. Regions consist of whole squares,
    /// except at the image's right and lower edges.
    static constexpr int square_size = 16;
    static constexpr int max_samples = 1024;

    void begin(const Region& region);
    /// Pixels are numbered row by row.
    int wanted(std::size_t pixel) const { return states_[pixel].wanted; }
    int taken(std::size_t pixel) const { return std::max(1, states_[pixel].samples.count()); }
    /// The number of the next sample, and SampleName::common of all samples of the round.
    int next(std::size_t pixel) const {
        return states_[pixel].samples.count() - (takes_grid() ? survey_.grid() : 0);
    }
    int common() const { return takes_grid() ? survey_.grid() : survey_.first_samples(); }
    void add(std::size_t pixel, const Sample& sample) {
        Pixel& at = states_[pixel];
        if (is_first_round_ && at.samples.count() == 0) shown_[pixel] = Shown(sample);
        at.samples.add(sample);
    }
    /// Ends a round. Returns false if no pixel wants more samples.
    bool end_round();
    Color mean(std::size_t pixel) const { return states_[pixel].samples.mean(); }
    float alpha(std::size_t pixel) const { return states_[pixel].samples.alpha(); }

  private:
    struct Pixel {
        PixelSamples samples;
        int wanted = 0;
        double around = 0.0; ///< variance
        bool may_hide = false;
        bool is_in_grid = false; ///< done with the samples of the grid
        std::uint8_t closer_looks = 0;
        std::vector<ShapeId> hidden; ///< thin shapes that may show
    };

    bool takes_grid() const { return is_first_round_ && survey_.grid() != 0; }
    void look_at(const Region& square);
    void look_closer(Pixel& pixel, int x, int y);
    bool is_ahead(int x, int y) const;
    void reopen(Pixel& pixel) const;
    int more_after(int count) const { return count != 0 ? count : survey_.first_samples(); }
    bool hides(Pixel& pixel, int x, int y);
    Square seen_by(int x, int y, int size) const;
    std::size_t number_of(int x, int y) const {
        return static_cast<std::size_t>(y - region_.y0) * width_ +
               static_cast<std::size_t>(x - region_.x0);
    }

    Settings settings_;
    const Survey& survey_;
    /// Maximum number of samples for a pixel whose thin shapes no sample has hit.
    int max_unseen_;
    BeamTracer beams_;
    Region region_{};
    std::size_t width_ = 0;
    bool is_first_round_ = false;
    std::vector<Pixel> states_;
    std::vector<Shown> shown_; // by pixel, its first sample
    std::vector<BeamCandidate> in_pixel_;
};

/// Calls visit(x, y) for a pixel and its neighbours that are in the same square and region.
template <class Visit>
void for_each_around(int x, int y, const Region& region, const Visit& visit) {
    constexpr int size = RegionSamples::square_size;
    const int x0 = x / size * size, y0 = y / size * size;
    const Region around =
        Region{x - 1, y - 1, x + 2, y + 2}.within({x0, y0, x0 + size, y0 + size}).within(region);
    for (int row = around.y0; row < around.y1; ++row)
        for (int column = around.x0; column < around.x1; ++column)
            visit(column, row);
}

} // namespace raylane::core
