#pragma once

#include "core/beams/beam_tracer.hpp"
#include "core/beams/pixel_samples.hpp"

namespace raylane::core {

/// Which samples the pixels of a region want in a picture of a quality (Settings::quality). Round
/// after round, each is given all that it wants, in order, until none wants any more:
///
/// 1. Its middle, one sample. Squares of pixels that see one surface alike are looked at by beams;
///    those that are even are done.
/// 2. The others start again, with points of a sequence. A pixel wants as many again until the
///    deviation of its samples says that its mean is good enough, and its beam that nothing hides
///    in it which they do not show; where something does, until there are so many that it would be
///    too small to matter.
///
/// What a pixel gets depends on scene and settings alone. To be used by one thread.
class RegionSamples {
  public:
    RegionSamples(const Scene& scene, const Settings& settings);

    /// Pixels on a side of the squares that are looked at together: regions consist of whole ones,
    /// but at the picture's right and lower edges.
    static constexpr int square_size = 16;
    static constexpr int most_samples = 1024;
    /// Samples of a pixel in which so much may show that it is not known.
    static constexpr int least_unknown = 64;
    /// Samples of a pixel in which a shadow or a colour may begin or end.
    static constexpr int least_on_step = 16;

    void begin(const Region& region);
    /// Pixels are numbered row by row.
    int wanted(std::size_t pixel) const { return states_[pixel].wanted; }
    int taken(std::size_t pixel) const { return states_[pixel].samples.count(); }
    /// Where in pixel (x, y) its sample `number` is, from its upper left corner, but for the
    /// filter.
    SamplePoint place(int x, int y, int number) const;
    void add(std::size_t pixel, const Sample& sample) {
        states_[pixel].samples.add(sample);
        if (is_first_round_) states_[pixel].first = sample;
    }
    /// False if no pixel wants any more.
    bool end_round();
    Color mean(std::size_t pixel) const { return states_[pixel].samples.mean(); }
    float alpha(std::size_t pixel) const { return states_[pixel].samples.alpha(); }

  private:
    static constexpr int least_uneven = 4; ///< pixels on a side
    static constexpr int most_hidden = 6;

    struct PixelSquare {
        int x, y, size;
    };

    struct Pixel {
        PixelSamples samples;
        Sample first; ///< its middle, in the first round
        int wanted = 1;
        double tolerance = 0.0; ///< what its mean may be off by
        int least = 0;          ///< samples, if not all of `hidden` is seen; 0: not known yet
        int hidden_count = 0;
        std::uint8_t closer_looks = 0;
        std::array<ShapeId, most_hidden> hidden{}; ///< that may show
    };

    void look_at(const PixelSquare& square);
    template <class Visit>
    void for_each_pixel(const PixelSquare& square, const Visit& visit);
    void find_even(const PixelSquare& square);
    Square seen_by(const PixelSquare& square) const;
    bool looks_even(const PixelSquare& square, double& t_likely) const;
    void look_closer(std::size_t number, int x, int y);
    bool hides(Pixel& pixel, int x, int y);
    static bool has_seen(const PixelSamples& samples, ShapeId id);
    void mark_edges();
    std::size_t number_of(int x, int y) const {
        return static_cast<std::size_t>(y - region_.y0) * width_ + (x - region_.x0);
    }

    const Scene& scene_;
    Settings settings_;
    double tolerance_;
    bool is_grainy_;  ///< neighbours' samples differ by lights with a size, or by the lens
    bool is_blurred_; ///< by a lens
    /// Samples of a pixel in which something may show that none of them does.
    int most_unseen_;
    BeamTracer beams_;
    Region region_{};
    int width_ = 0;
    bool is_first_round_ = false;
    std::vector<Pixel> states_;
    std::vector<ShapeId> shown_;
    std::vector<BeamCandidate> in_pixel_;
};

} // namespace raylane::core
