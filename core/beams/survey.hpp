#pragma once

#include "core/beams/pixel_samples.hpp"
#include "core/numbers/infinity.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raylane::core {

class Scene;

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
    static constexpr int all_samples = 64; ///< samples_at() the last stage
    /// A pixel's samples give several histories of equal likelihood, because each aligned run of 4,
    /// 8, ... samples of a sequence is as likely as the first. A history begins in a run of 16, and
    /// doubles to the aligned run of twice the length.
    static constexpr std::size_t histories = 4;
    static constexpr int samples_of_run = all_samples / static_cast<int>(histories);

    struct Record;

  public:
    Survey(const Scene& scene, const Settings& settings);

    /// The first pass samples the neighbourhoods of many places. The second pass samples fewer
    /// pixels, most of them where neighbours differ. If a regular grid promises to be cheapest, the
    /// third pass measures its error in the same pixels: it depends on how edges lie to the grid,
    /// so it does not follow from that of other grids. Batches of a pass are independent.
    enum class Pass : std::uint8_t { look, sample, grid };
    static constexpr Pass passes[] = {Pass::look, Pass::sample, Pass::grid};
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
        int common() const { return round_ == 0 ? 1 : round_ == 1 ? grid_ : 0; }
        int wanted(std::size_t pixel) const { return pixels_[pixel].wanted; }
        void add(std::size_t pixel, const Sample& sample);
        bool end_round();

      private:
        struct Pixel {
            int x, y;
            std::size_t number;        ///< of its place or record
            int next = -1, wanted = 1; ///< first its middle, the grid of one sample
            double cost = 0.0;
            Mean middle{};
            PixelSamples in_grid{}, runs[histories]{};
            /// The first 4 and the first 8 samples of each run.
            Mean means[histories][2]{};
            double squares[histories][2]{};
        };

        void add_to_run(Pixel& pixel, int number, const Sample& sample) const;
        void begin_grids();
        void complete(const Pixel& pixel) const;
        void complete_sequence(const Pixel& pixel, Record& record) const;

        Survey& survey_;
        Pass pass_;
        int grid_;      ///< number of samples
        int round_ = 0; ///< 0: middles, 1: grids, 2: sequences
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
        double weight;                      ///< number of pixels that the record stands for
        double around;                      ///< variance
        double cost = 0.0;                  ///< of a sample
        double variance = 0.0;              ///< of one sample
        Mean mean{};                        ///< mean of all 64 samples
        double squared_error_of_grid = 0.0; ///< relative to that, of the grid measured last
        struct AtStage {
            double squared_error; ///< relative to the mean of all 64 samples
            double limit;         ///< the smallest limit that finds the samples sufficient
        } at[histories][stages]{};
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

    static double limit_of(const Known& pixel, int samples);
    static bool is_done(const Known& pixel, const Policy& policy);
    static bool is_done(const Record& record, std::size_t history, std::size_t stage,
                        const Policy& policy);
    static double weighted_samples(int samples, const Policy& policy);
    void choose_records();
    void choose_policy();
    bool suits(double squared_error) const;
    void choose_grid(double max_samples);
    void judge_grid();
    void fit_errors();
    double measured_error_of_grid() const;
    double squared_error_at(const Record& record, std::size_t history, std::size_t stage) const;
    double squared_error_of_run(int count) const;
    double squared_error_of_grid(int count) const;
    Outcome outcome_of(const Policy& policy) const;
    double mean_cost() const;
    double squared_error_of(double excess_decibels) const;

    Settings settings_;
    bool samples_follow_sequences_; ///< those on lights and on the lens, in grids, too
    std::vector<Place> places_;
    std::vector<Record> records_;
    /// The image's squared error with n samples of a sequence in each pixel: a / n + b / n^(3/2).
    struct Decay {
        double a = 0.0, b = 0.0;
        double at(double n) const { return a / n + b / (n * std::sqrt(n)); }
        static Decay fit(const std::array<double, 4>& differences);
    } error_;
    /// The same by stage, divided by the mean variance of a sample.
    std::vector<double> left_;
    double grid_to_sequence_ = 1.0; ///< ratio of the squared errors
    int promising_grid_ = 0;        ///< number of samples; 0: none
    Policy policy_;
};

} // namespace raylane::core
