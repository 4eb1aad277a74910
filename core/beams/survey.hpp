#pragma once

#include "core/beams/pixel_samples.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raylane::core {

/// Finds how far samples have to go in a picture of a quality (Settings::quality): some of its
/// pixels are sampled well beforehand, and tell what the picture's error and its cost would be by
/// each of some policies. The cheapest one is chosen.
///
/// By each, a pixel is done when the likely variance of n samples is at most limit * n^2, and n at
/// least `fewest`: then the next sample takes as much off the picture's squared error everywhere.
class Survey {
    /// Samples of a pixel: 1, its middle, or 4, 8, ... 64; as a limit may ask for, further.
    static constexpr std::size_t stages = 6;
    static constexpr std::size_t measured_stages = 5; ///< but for the last, which errors are from
    static constexpr int samples_at(std::size_t stage) { return stage == 0 ? 1 : 2 << stage; }
    /// Of samples beside the middle.
    static std::size_t stage_of(int count) {
        return count == 0 ? 0 : static_cast<std::size_t>(std::bit_width(unsigned(count))) - 2;
    }

  public:
    explicit Survey(const Settings& settings);

    /// It is made in two passes: of many places the surroundings are looked at, and of fewer, for
    /// the most part where these differ, the pixel is sampled. Batches of either are independent.
    enum class Pass : std::uint8_t { look, sample };
    std::size_t batches(Pass pass) const;
    /// To be called when all batches have been taken.
    void end(Pass pass);

    /// What is known of a pixel: variance_around() it, and of its samples, but for its middle, the
    /// sum of their squares about the mean (PixelSamples::squares_shown).
    struct Known {
        double around;
        double squares;
        int count; ///< of these samples
    };
    bool is_done(const Known& pixel) const { return is_done(pixel, policy_); }
    /// The samples that a pixel has at least once its middle does not do.
    int first_samples() const { return std::max(policy_.fewest, samples_at(1)); }

    /// The samples of a batch, for one thread, as RegionSamples has them of a region.
    class Samples {
      public:
        Samples(Survey& survey, Pass pass, std::size_t batch);
        std::size_t pixels() const { return pixels_.size(); }
        int x(std::size_t pixel) const { return pixels_[pixel].x; }
        int y(std::size_t pixel) const { return pixels_[pixel].y; }
        int next(std::size_t pixel) const { return pixels_[pixel].next; }
        int wanted(std::size_t pixel) const { return pixels_[pixel].wanted; }
        void add(std::size_t pixel, const Sample& sample);
        bool end_round();

      private:
        struct Pixel {
            int x, y;
            std::size_t number; ///< of its place or record
            int next, wanted;
            PixelSamples samples{};
            Vec3d means[measured_stages]{};
        };

        bool end_stage(Pixel& pixel) const;

        Survey& survey_;
        Pass pass_;
        std::vector<Pixel> pixels_;
    };

  private:
    struct Place {
        int x, y;
        Shown around[9]{};
        std::size_t neighbours = 0; ///< itself, too
    };
    struct Record {
        std::size_t place;
        double weight;                           ///< pixels that it stands for
        double around;                           ///< variance
        double squares[stages]{};                ///< 0 of the middle
        double squared_error[measured_stages]{}; ///< from the mean of all 64
    };
    struct Policy {
        int fewest = 1;
        bool spares_alike = true; ///< one sample does where all around is exactly alike
        double limit = 0.0;
    };
    struct Outcome {
        double squared_error = 0.0, samples = 0.0; ///< of a pixel, in the mean
    };

    static double likely_variance(const Known& pixel);
    static bool is_done(const Known& pixel, const Policy& policy);
    void choose_records();
    void choose_policy();
    void fit_errors();
    double squared_error_at(const Record& record, std::size_t stage) const;
    Outcome outcome_of(const Policy& policy) const;

    Settings settings_;
    std::vector<Place> places_;
    std::vector<Record> records_;
    /// By stage, of so many samples: the squared error as a part of the variance.
    std::vector<double> left_;
    Policy policy_;
};

} // namespace raylane::core
