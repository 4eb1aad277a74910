#include "core/beams/survey.hpp"

#include "core/beams/region_samples.hpp"
#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace raylane::core {

namespace {

/// Returns how many pixels a pass takes: one in so many, but at least 512, if there are as many,
/// and at most `most`.
std::size_t share_of(std::size_t pixels, std::size_t one_in, std::size_t most) {
    return std::min(pixels, std::clamp<std::size_t>(pixels / one_in, 512, most));
}
std::size_t places_in(std::size_t pixels) {
    return share_of(pixels, 6, std::clamp<std::size_t>(pixels / 128, 4096, 6144));
}
std::size_t sampled_in(std::size_t pixels) {
    return share_of(pixels, 24, 768);
}
/// Places in a batch.
constexpr std::size_t batch_places = 128;
/// The chance of a place grows with its variance. This multiple of the mean variance is added to
/// it, so that no place is left out.
constexpr double anywhere = 1.0;

/// The estimate of a pixel's variance starts from half of the variance around it, with the weight
/// of 8 samples. Over twelve scenes this pair took 2 % more samples than the best pair for each
/// scene.
constexpr double within = 0.5, worth_of_around = 8.0;

/// The cost of a ray of a later round, in rays of the first: rays of scattered pixels share less
/// work in frusta. It was 1.8 in a sphereflake of half mirrors and 2.3 in a lattice (1200 x 900,
/// AVX2), and is about 1 where most rays go to the sky, one by one.
constexpr double scattered = 1.7;

/// Decibels above the quality of the settings: a margin because the estimate scatters.
constexpr double margin = 1.1;
/// Decibels beyond these that a policy may have, as the result should have at most 2 in all.
constexpr double excess = 0.6;
/// A policy with more is chosen if its cost times this is less than that of the others.
constexpr double dislike = 4.0;
/// Decibels above the quality that a regular grid may have. Its steps are large, so that the range
/// is wider.
constexpr double least_of_grid = 0.3, most_of_grid = 1.7;

std::size_t pixels_of(const Settings& settings) {
    return static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
}

double squared_distance(const Vec3d& a, const Vec3d& b, Transfer transfer) {
    double sum = 0.0;
    for (int channel = 0; channel < 3; ++channel) {
        const auto on_film = [&](double linear) {
            return shown(std::clamp(linear, 0.0, 1.0), transfer);
        };
        const double off = on_film(a[channel]) - on_film(b[channel]);
        sum += off * off / 3.0;
    }
    return sum;
}

PixelSamples sum(const PixelSamples& a, const PixelSamples& b) {
    PixelSamples both = a;
    both += b;
    return both;
}

/// The background counts as white.
double squared_distance(const Mean& a, const Mean& b, Transfer transfer) {
    return squared_distance(a.color, b.color, transfer) +
           squared_distance(Vec3d(a.transmittance), Vec3d(b.transmittance), transfer);
}

bool uses_sequences(const Scene& scene, const Settings& settings) {
    return scene.camera().lens_radius > 0.0F ||
           (settings.light_samples != Settings::hard_light &&
            std::any_of(scene.lights().begin(), scene.lights().end(),
                        [](const Light& light) { return is_soft(light.kind); }));
}

} // namespace

Survey::Survey(const Scene& scene, const Settings& settings)
    : settings_(settings), samples_follow_sequences_(uses_sequences(scene, settings)) {
    const std::size_t pixels = pixels_of(settings);
    const std::uint64_t key = sequence_key(0, 0, SequenceUse::in_pixel);
    for (std::size_t i = 0; i < places_in(pixels); ++i) {
        const SamplePoint point = sequence_point(key, static_cast<std::uint32_t>(i));
        places_.push_back({static_cast<int>(point.x * static_cast<float>(settings.width)),
                           static_cast<int>(point.y * static_cast<float>(settings.height))});
    }
    // Rays of a batch share work if they are near each other.
    constexpr int tile = 64;
    std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
        return std::tuple(a.y / tile, a.x / tile, a.y, a.x) <
               std::tuple(b.y / tile, b.x / tile, b.y, b.x);
    });
}

std::size_t Survey::batches(Pass pass) const {
    if (pass == Pass::grid && promising_grid_ == 0) return 0;
    const std::size_t total = pass == Pass::look ? places_.size() : records_.size();
    return (total + batch_places - 1) / batch_places;
}

Survey::Samples::Samples(Survey& survey, Pass pass, std::size_t batch)
    : survey_(survey), pass_(pass),
      grid_(pass == Pass::grid ? survey.promising_grid_ : measured_grid) {
    const Region image{0, 0, survey.settings_.width, survey.settings_.height};
    const std::size_t begin = batch * batch_places;
    if (pass == Pass::look) {
        const std::size_t end = std::min(begin + batch_places, survey.places_.size());
        pixels_.reserve(9 * (end - begin));
        for (std::size_t number = begin; number < end; ++number)
            for_each_around(survey.places_[number].x, survey.places_[number].y, image,
                            [&](int x, int y) {
                                pixels_.push_back({x, y, number});
                            });
        return;
    }
    const std::size_t end = std::min(begin + batch_places, survey.records_.size());
    for (std::size_t number = begin; number < end; ++number) {
        const Place& place = survey.places_[survey.records_[number].place];
        pixels_.push_back({place.x, place.y, number});
    }
    if (pass == Pass::grid) begin_grids();
}

void Survey::Samples::begin_grids() {
    round_ = 1;
    for (Pixel& pixel : pixels_) {
        pixel.next = -grid_;
        pixel.wanted = grid_;
    }
}

void Survey::Samples::add(std::size_t pixel, const Sample& sample) {
    Pixel& at = pixels_[pixel];
    at.cost += sample.cost;
    if (const int number = at.next++; number >= 0) return add_to_run(at, number, sample);
    if (round_ == 1) return at.in_grid.add(sample);
    at.middle = {sample.color, sample.transmittance};
    if (pass_ == Pass::sample) return;
    Place& place = survey_.places_[at.number];
    place.around[place.neighbours++] = Shown(sample);
}

void Survey::Samples::add_to_run(Pixel& pixel, int number, const Sample& sample) const {
    const auto history = static_cast<std::size_t>(number / samples_of_run);
    PixelSamples& run = pixel.runs[history];
    run.add(sample);
    for (const std::size_t stage : {1, 2})
        if (run.count() == samples_at(stage)) {
            pixel.means[history][stage - 1] = run.exact_mean();
            pixel.squares[history][stage - 1] = run.squares_shown(survey_.settings_.transfer);
        }
}

bool Survey::Samples::end_round() {
    if (pass_ == Pass::look) return false;
    if (round_ == 0) {
        begin_grids();
        return true;
    }
    if (round_ == 1 && pass_ == Pass::sample) {
        round_ = 2;
        for (Pixel& pixel : pixels_)
            pixel.wanted = all_samples;
        return true;
    }
    for (const Pixel& pixel : pixels_)
        complete(pixel);
    return false;
}

/// Fills the pixel's record.
void Survey::Samples::complete(const Pixel& pixel) const {
    Record& record = survey_.records_[pixel.number];
    if (pass_ == Pass::sample) complete_sequence(pixel, record);
    record.squared_error_of_grid =
        squared_distance(pixel.in_grid.exact_mean(), record.mean, survey_.settings_.transfer);
}

void Survey::Samples::complete_sequence(const Pixel& pixel, Record& record) const {
    const Transfer transfer = survey_.settings_.transfer;
    const PixelSamples halves[] = {sum(pixel.runs[0], pixel.runs[1]),
                                   sum(pixel.runs[2], pixel.runs[3])};
    const PixelSamples both_halves = sum(halves[0], halves[1]);
    record.mean = both_halves.exact_mean();
    const auto error_of = [&](const Mean& mean) {
        return squared_distance(mean, record.mean, transfer);
    };
    record.cost = pixel.cost / (1.0 + measured_grid + all_samples);
    record.variance = both_halves.squares_shown(transfer) / (all_samples - 1.0);
    for (std::size_t history = 0; history < histories; ++history) {
        const auto set = [&](std::size_t stage, const Mean& mean, double squares) {
            const int count = stage == 0 ? 0 : samples_at(stage);
            record.at[history][stage] = {
                error_of(mean), limit_of({record.around, squares, count}, samples_at(stage))};
        };
        set(0, pixel.middle, 0.0);
        for (const std::size_t stage : {1, 2})
            set(stage, pixel.means[history][stage - 1], pixel.squares[history][stage - 1]);
        const PixelSamples* const longer[] = {&pixel.runs[history], &halves[history / 2],
                                              &both_halves};
        for (const std::size_t stage : {3, 4, 5})
            set(stage, longer[stage - 3]->exact_mean(), longer[stage - 3]->squares_shown(transfer));
    }
}

void Survey::end(Pass pass) {
    switch (pass) {
    case Pass::look:
        return choose_records();
    case Pass::sample:
        return choose_policy();
    case Pass::grid:
        return judge_grid();
    }
}

/// Systematic sampling: chances are added up, and each step of the sum takes a place. A record
/// stands for step / chance places.
void Survey::choose_records() {
    std::vector<double> around;
    double total = 0.0;
    for (const Place& place : places_) {
        around.push_back(variance_around({place.around, place.neighbours}));
        total += around.back();
    }
    const auto count = static_cast<double>(places_.size());
    const double base = total > 0.0 ? anywhere * total / count : 1.0;
    const auto samples = static_cast<double>(sampled_in(pixels_of(settings_)));
    const double step = (total + base * count) / samples;
    double due = 0.5 * step;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const double chance = around[i] + base;
        if (chance < step) {
            due -= chance;
            if (due > 0.0) continue;
            due += step;
        }
        records_.push_back({i, std::max(1.0, step / chance), around[i]});
    }
}

/// Returns the smallest limit that finds a pixel's samples sufficient.
double Survey::limit_of(const Known& pixel, int samples) {
    const double around = within * pixel.around, n = samples;
    const double variance = pixel.count == 0 ? around
                                             : (worth_of_around * around + pixel.squares) /
                                                   (worth_of_around + pixel.count - 1.0);
    return variance / (n * n);
}

bool Survey::is_done(const Known& pixel, const Policy& policy) {
    if (policy.spares_alike && pixel.count == 0 && pixel.around == 0.0) return true;
    const int n = pixel.count == 0 ? policy.grid : pixel.count;
    return n >= policy.fewest && limit_of(pixel, n) <= policy.limit;
}

/// Decides for a measured pixel. Beyond the last stage, its variance is known.
bool Survey::is_done(const Record& record, std::size_t history, std::size_t stage,
                     const Policy& policy) {
    const int count = samples_at(stage);
    if (stage >= stages)
        return is_done({record.around, record.variance * (count - 1.0), count}, policy);
    if (stage == 0 && policy.spares_alike && record.around == 0.0) return true;
    return (stage == 0 ? policy.grid : count) >= policy.fewest &&
           record.at[history][stage].limit <= policy.limit;
}

/// Returns E(n) = a / n + b / n^(3/2) with the given E(n) - E(2 n) for 4, 8, 16 and 32 samples,
/// except for a least sum of squared relative deviations. Neither term is negative.
///
/// a is the error that samples do not stratify, such as that of the light at a point by both
/// coordinates of the point; b that of edges.
Survey::Decay Survey::Decay::fit(const std::array<double, 4>& differences) {
    double aa = 0.0, ab = 0.0, bb = 0.0, a1 = 0.0, b1 = 0.0;
    double n = 4.0;
    for (const double difference : differences) {
        if (difference > 0.0) {
            const double a = (1.0 / n - 0.5 / n) / difference;
            const double b = Decay{0.0, 1.0}.at(n) * (1.0 - std::sqrt(0.125)) / difference;
            aa += a * a;
            ab += a * b;
            bb += b * b;
            a1 += a;
            b1 += b;
        }
        n *= 2.0;
    }
    if (aa == 0.0) return {};
    const double determinant = aa * bb - ab * ab;
    const double a = a1 * bb - b1 * ab, b = b1 * aa - a1 * ab;
    if (a <= 0.0 || determinant <= 0.0) return {0.0, b1 / bb};
    if (b <= 0.0) return {a1 / aa, 0.0};
    return {a / determinant, b / determinant};
}

/// The mean of n samples differs from the mean of 64 by E(n) - E(64), because the n are a part of
/// the 64. A grid is no part of the 64, so its difference is the sum of both errors.
void Survey::fit_errors() {
    double to_all[stages]{}, variance = 0.0, weights = 0.0;
    for (const Record& record : records_) {
        for (const auto& history : record.at)
            for (std::size_t stage = 1; stage < measured_stages; ++stage)
                to_all[stage] += record.weight / histories * history[stage].squared_error;
        variance += record.weight * record.variance;
        weights += record.weight;
    }
    std::array<double, 4> differences{};
    for (std::size_t stage = 1; stage < measured_stages; ++stage)
        differences[stage - 1] = (to_all[stage] - to_all[stage + 1]) / weights;
    error_ = Decay::fit(differences);
    left_.clear();
    for (std::size_t stage = 0; left_.empty() || samples_at(stage - 1) < RegionSamples::max_samples;
         ++stage)
        left_.push_back(variance > 0.0 ? error_.at(samples_at(stage)) / (variance / weights) : 0.0);

    const double as_sequence = error_.at(measured_grid);
    grid_to_sequence_ =
        as_sequence > 0.0 ? std::clamp(measured_error_of_grid() / as_sequence, 0.5, 2.0) : 1.0;
}

/// Returns the image's squared error with the grid that was measured last.
double Survey::measured_error_of_grid() const {
    double error = 0.0, weights = 0.0;
    for (const Record& record : records_) {
        error += record.weight * record.squared_error_of_grid;
        weights += record.weight;
    }
    return error / weights - error_.at(all_samples);
}

/// Returns the image's squared error with the first `count` samples of a sequence. Their aligned
/// runs, one for each bit of the number, have independent errors.
double Survey::squared_error_of_run(int count) const {
    double sum = 0.0;
    for (int run = 1; run <= count; run *= 2)
        if ((count & run) != 0) sum += error_.at(run) * run * run;
    return sum / (static_cast<double>(count) * count);
}

/// Returns the image's squared error with a regular grid of `count` samples in each pixel.
double Survey::squared_error_of_grid(int count) const {
    return grid_to_sequence_ *
           (samples_follow_sequences_ ? squared_error_of_run(count) : error_.at(count));
}

double Survey::squared_error_at(const Record& record, std::size_t history,
                                std::size_t stage) const {
    if (stage >= measured_stages) return record.variance * left_[stage];
    const double measured = record.at[history][stage].squared_error;
    const double of_reference = record.variance * left_[stages - 1];
    // The middle is no part of the reference.
    return stage == 0 ? std::max(0.0, measured - of_reference) : measured + of_reference;
}

Survey::Outcome Survey::outcome_of(const Policy& policy) const {
    Outcome outcome;
    double weights = 0.0;
    for (const Record& record : records_) {
        double squared_error = 0.0, samples = 0.0;
        for (std::size_t history = 0; history < histories; ++history) {
            std::size_t stage = 0;
            while (samples_at(stage) < RegionSamples::max_samples &&
                   !is_done(record, history, stage, policy))
                ++stage;
            squared_error += squared_error_at(record, history, stage);
            samples += weighted_samples(samples_at(stage), policy);
        }
        outcome.squared_error += record.weight / histories * squared_error;
        outcome.cost += record.weight / histories * record.cost * samples;
        weights += record.weight;
    }
    return {outcome.squared_error / weights, outcome.cost / weights};
}

/// Returns the mean cost of a sample over all pixels.
double Survey::mean_cost() const {
    double cost = 0.0, weights = 0.0;
    for (const Record& record : records_) {
        cost += record.weight * record.cost;
        weights += record.weight;
    }
    return cost / weights;
}

/// Returns the number of a pixel's samples as if all were of the first round.
double Survey::weighted_samples(int samples, const Policy& policy) {
    const int first = policy.grid != 0 ? policy.grid : std::max(policy.fewest, samples_at(1));
    if (samples <= first) return first;
    return first + scattered * (policy.grid != 0 ? samples : samples - first);
}

/// Returns the squared error of an image whose quality exceeds that of the settings by so much.
double Survey::squared_error_of(double excess_decibels) const {
    return core::pow(10.0, -(static_cast<double>(settings_.quality) + excess_decibels) / 10.0);
}

/// Finds the largest limit of each policy that reaches the quality, by bisection, as the error
/// grows with the limit. Chooses the cheapest policy, if possible one that does not exceed the
/// quality by much.
void Survey::choose_policy() {
    fit_errors();
    const double asked = squared_error_of(margin), too_good = squared_error_of(margin + excess);
    const double sample_cost = mean_cost();
    const double max_cost = RegionSamples::max_samples * sample_cost;
    double least = infinity<double>, min_price = infinity<double>;
    for (const bool spares_alike : {true, false})
        for (std::size_t stage = 0; stage < stages; ++stage) {
            Policy policy{samples_at(stage), spares_alike};
            double low = -48.0, high = 4.0; // of the limit's power of two
            for (int halving = 0; halving < 16; ++halving) {
                const double middle = 0.5 * (low + high);
                policy.limit = core::pow(2.0, middle);
                (outcome_of(policy).squared_error <= asked ? low : high) = middle;
            }
            policy.limit = core::pow(2.0, low);
            const Outcome outcome = outcome_of(policy);
            const double cost = outcome.squared_error <= asked
                                    ? outcome.cost
                                    : max_cost * outcome.squared_error / asked;
            const double price = outcome.squared_error < too_good ? dislike * cost : cost;
            if (price < min_price) {
                min_price = price;
                least = cost;
                policy_ = policy;
            }
        }
    choose_grid(least / sample_cost);
}

bool Survey::suits(double squared_error) const {
    return squared_error <= squared_error_of(least_of_grid) &&
           squared_error >= squared_error_of(most_of_grid);
}

/// Finds the smallest grid that promises the quality for all pixels, if it has fewer samples than
/// `max_samples`.
void Survey::choose_grid(double max_samples) {
    for (int side = 2; side * side < max_samples; ++side)
        if (const int count = side * side; suits(squared_error_of_grid(count))) {
            promising_grid_ = count;
            if (count == measured_grid) judge_grid();
            return;
        }
}

/// Takes the promising grid if its measured error suits.
void Survey::judge_grid() {
    const int count = std::exchange(promising_grid_, 0);
    if (count != 0 && suits(measured_error_of_grid()))
        policy_ = {count, false, infinity<double>, count};
}

} // namespace raylane::core
