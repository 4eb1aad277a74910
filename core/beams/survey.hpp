#pragma once

#include "core/beams/pixel_samples.hpp"
#include "core/numbers/infinity.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raylane::core {

/// Decides how many samples the pixels of an image of a given quality get (Settings::quality).
/// Samples some pixels beforehand, estimates the image's error and cost under several policies, and
/// chooses the cheapest policy that reaches the quality.
///
/// Under a policy a pixel is done when its variance is at most limit * n^2 for its n samples, and n
/// is at least `fewest`. One more sample then lowers the squared error by the same amount in every
/// pixel.
class Survey {
    /// Stages of a pixel: 1 sample, at its middle, then 4, 8, ... 64. A limit may require further
    /// stages.
    static constexpr std::size_t stages = 6;
    static constexpr std::size_t measured_stages = 5; ///< all but the last, the reference
    static constexpr int samples_at(std::size_t stage) { return stage == 0 ? 1 : 2 << stage; }
    /// The stage of a pixel with `count` samples, not counting its middle.
    static std::size_t stage_of(int count) {
        return count == 0 ? 0 : static_cast<std::size_t>(std::bit_width(unsigned(count))) - 2;
    }

  public:
    explicit Survey(const Settings& settings);

    /// The first pass samples the neighbourhoods of many places. The second pass samples fewer
    /// pixels, most of them where neighbours differ. Batches of a pass are independent.
    enum class Pass : std::uint8_t { look, sample };
    std::size_t batches(Pass pass) const;
    /// Ends a pass. Call when all batches have been taken.
    void end(Pass pass);

    /// The state of a pixel: variance_around() it, and PixelSamples::squares_shown of its samples
    /// without the middle.
    struct Known {
        double around;
        double squares;
        int count; ///< of these samples
    };
    bool is_done(const Known& pixel) const { return is_done(pixel, policy_); }
    /// Returns false if is_done() is true for all pixels.
    bool asks_for_variance() const { return policy_.limit < infinity<double>; }
    /// Returns how many samples the regular grid has with which pixels begin: a square number, or 0
    /// if they begin with the sequence. The grid is enough for some pixels.
    int grid() const { return policy_.grid; }
    /// Returns how many samples a pixel gets first if it has no grid or its grid is not enough.
    int first_samples() const {
        return std::max(static_cast<int>(std::bit_ceil(static_cast<unsigned>(policy_.fewest))),
                        samples_at(1));
    }

    /// Collects the samples of a batch, with the interface of RegionSamples. For use by one thread.
    class Samples {
      public:
        Samples(Survey& survey, Pass pass, std::size_t batch);
        std::size_t pixels() const { return pixels_.size(); }
        int x(std::size_t pixel) const { return pixels_[pixel].x; }
        int y(std::size_t pixel) const { return pixels_[pixel].y; }
        int next(std::size_t pixel) const { return pixels_[pixel].next; }
        int common() const { return round_ == 0 ? 1 : round_ == 1 ? measured_grid : 0; }
        int wanted(std::size_t pixel) const { return pixels_[pixel].wanted; }
        void add(std::size_t pixel, const Sample& sample);
        bool end_round();

      private:
        struct Pixel {
            int x, y;
            std::size_t number;        ///< of its place or record
            int next = -1, wanted = 1; ///< first its middle, the grid of one sample
            PixelSamples samples{}, in_grid{};
            double cost = 0.0;
            Mean means[measured_stages]{};
        };

        bool end_stage(Pixel& pixel) const;

        Survey& survey_;
        Pass pass_;
        int round_ = 0; ///< 0: middles, 1: grids, then stages of the sequence
        std::vector<Pixel> pixels_;
    };

  private:
    struct Place {
        int x, y;
        Shown around[9]{};
        std::size_t neighbours = 0; ///< includes the place itself
    };
    struct Record {
        std::size_t place;
        double weight;                           ///< number of pixels that the record stands for
        double around;                           ///< variance
        double cost = 0.0;                       ///< of a sample
        double squares[stages]{};                ///< 0 for the middle
        double squared_error[measured_stages]{}; ///< relative to the mean of all 64 samples
        double squared_error_of_grid = 0.0;      ///< likewise, of measured_grid samples
    };
    static constexpr int measured_grid = 4;
    struct Policy {
        int fewest = 1;
        bool spares_alike = true; ///< one sample is enough where all neighbours are equal
        double limit = 0.0;
        int grid = spares_alike || fewest == 1 ? 1 : 0;
    };
    struct Outcome {
        double squared_error = 0.0, cost = 0.0; ///< mean over pixels
    };

    static double likely_variance(const Known& pixel);
    static bool is_done(const Known& pixel, const Policy& policy);
    static double weighted_samples(int samples, const Policy& policy);
    void choose_records();
    void choose_policy();
    void fit_errors();
    double squared_error_at(const Record& record, std::size_t stage) const;
    Outcome outcome_of(const Policy& policy) const;
    double mean_cost() const;
    double squared_error_of(double excess_decibels) const;

    Settings settings_;
    std::vector<Place> places_;
    std::vector<Record> records_;
    /// The squared error of that many samples, divided by the variance of one sample, by stage.
    std::vector<double> left_;
    /// The image's squared error with a regular grid of n samples in each pixel: this multiple of n
    /// to the power `exponent`.
    struct GridError {
        double scale, exponent;
    } grid_error_{};
    Policy policy_;
};

} // namespace raylane::core
