#include "core/beams/survey.hpp"

#include "core/beams/region_samples.hpp"
#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"
#include "core/scene/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace raylane::core {

namespace {

/// Returns how many pixels a pass takes: one in so many, but at least 512, if there are as many,
/// and at most `most`.
std::size_t share_of(std::size_t pixels, std::size_t one_in, std::size_t most) {
    return std::min(pixels, std::clamp<std::size_t>(pixels / one_in, 512, most));
}
std::size_t places_in(std::size_t pixels) {
    return share_of(pixels, 6, std::clamp<std::size_t>(pixels / 128, 2048, 4096));
}
std::size_t sampled_in(std::size_t pixels) {
    return share_of(pixels, 24, 1024);
}
/// Places in a batch.
constexpr std::size_t batch_places = 128;
/// The chance of a place grows with its deviation. This multiple of the mean deviation is added to
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

/// The background counts as white.
double squared_distance(const Mean& a, const Mean& b, Transfer transfer) {
    return squared_distance(a.color, b.color, transfer) +
           squared_distance(Vec3d(a.transmittance), Vec3d(b.transmittance), transfer);
}

} // namespace

Survey::Survey(const Settings& settings) : settings_(settings) {
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
    const std::size_t all = pass == Pass::look ? places_.size() : records_.size();
    return (all + batch_places - 1) / batch_places;
}

Survey::Samples::Samples(Survey& survey, Pass pass, std::size_t batch)
    : survey_(survey), pass_(pass) {
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
}

void Survey::Samples::add(std::size_t pixel, const Sample& sample) {
    Pixel& at = pixels_[pixel];
    at.cost += sample.cost;
    if (at.next++ >= 0) return at.samples.add(sample);
    if (round_ == 1) return at.in_grid.add(sample);
    at.means[0] = {sample.color, sample.transmittance};
    if (pass_ == Pass::sample) return;
    Place& place = survey_.places_[at.number];
    place.around[place.neighbours++] = Shown(sample);
}

bool Survey::Samples::end_round() {
    if (pass_ == Pass::look) return false;
    if (++round_ == 1) {
        for (Pixel& pixel : pixels_) {
            pixel.next = -measured_grid;
            pixel.wanted = measured_grid;
        }
        return true;
    }
    bool is_any = false;
    for (Pixel& pixel : pixels_)
        if (end_stage(pixel)) is_any = true;
    return is_any;
}

/// Returns false if the stage was the last.
bool Survey::Samples::end_stage(Pixel& pixel) const {
    const Transfer transfer = survey_.settings_.transfer;
    Record& record = survey_.records_[pixel.number];
    const int count = pixel.samples.count();
    const std::size_t stage = stage_of(count);
    if (stage > 0) record.squares[stage] = pixel.samples.squares_shown(transfer);
    if (stage > 0 && stage < measured_stages) pixel.means[stage] = pixel.samples.exact_mean();
    if (stage + 1 < stages) {
        pixel.wanted = samples_at(stage + 1) - count;
        return true;
    }
    pixel.wanted = 0;
    record.cost = pixel.cost / (1.0 + measured_grid + count);
    for (std::size_t measured = 0; measured < measured_stages; ++measured)
        record.squared_error[measured] =
            squared_distance(pixel.means[measured], pixel.samples.exact_mean(), transfer);
    record.squared_error_of_grid =
        squared_distance(pixel.in_grid.exact_mean(), pixel.samples.exact_mean(), transfer);
    return false;
}

void Survey::end(Pass pass) {
    if (pass == Pass::look)
        choose_records();
    else
        choose_policy();
}

/// Systematic sampling: chances are added up, and each step of the sum takes a place. A record
/// stands for step / chance places.
void Survey::choose_records() {
    std::vector<double> around, chances;
    double all = 0.0;
    for (const Place& place : places_) {
        around.push_back(variance_around({place.around, place.neighbours}));
        chances.push_back(std::sqrt(around.back()));
        all += chances.back();
    }
    const auto count = static_cast<double>(places_.size());
    const double base = all > 0.0 ? anywhere * all / count : 1.0;
    const auto samples = static_cast<double>(sampled_in(pixels_of(settings_)));
    const double step = (all + base * count) / samples;
    double due = 0.5 * step;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const double chance = chances[i] + base;
        if (chance < step) {
            due -= chance;
            if (due > 0.0) continue;
            due += step;
        }
        records_.push_back({i, std::max(1.0, step / chance), around[i]});
    }
}

double Survey::likely_variance(const Known& pixel) {
    const double around = within * pixel.around;
    if (pixel.count == 0) return around;
    return (worth_of_around * around + pixel.squares) / (worth_of_around + pixel.count - 1.0);
}

bool Survey::is_done(const Known& pixel, const Policy& policy) {
    if (policy.spares_alike && pixel.count == 0 && pixel.around == 0.0) return true;
    const double n = pixel.count == 0 ? policy.grid : pixel.count;
    return n >= policy.fewest && likely_variance(pixel) <= policy.limit * n * n;
}

/// The squared error of n samples is E(n) = c r^log2(n) times the variance. The mean of n samples
/// differs from the mean of 64 by E(n) - E(64), because the n are a part of the 64. The differences
/// at 8 and 32 samples give r and c. A grid is no part of the 64, so its difference is the sum.
void Survey::fit_errors() {
    double variance = 0.0, of_8 = 0.0, of_32 = 0.0, of_grid = 0.0, weights = 0.0;
    for (const Record& record : records_) {
        variance += record.weight * record.squares[stages - 1] / (samples_at(stages - 1) - 1.0);
        of_8 += record.weight * record.squared_error[2];
        of_32 += record.weight * record.squared_error[4];
        of_grid += record.weight * record.squared_error_of_grid;
        weights += record.weight;
    }
    // (r^3 - r^6) / (r^5 - r^6) = (1 + r + r^2) / r^2
    const double more = of_8 / of_32 - 1.0;
    const double root = more > 0.0 ? (1.0 + std::sqrt(1.0 + 4.0 * more)) / (2.0 * more) : 0.5;
    const double r = std::clamp(root, 0.25, 0.5);
    const double r5 = r * r * r * r * r;
    const double c = variance > 0.0 ? of_32 / (r5 - r5 * r) / variance : 0.0;
    left_.clear();
    for (std::size_t stage = 0; left_.empty() || samples_at(stage - 1) < RegionSamples::max_samples;
         ++stage)
        left_.push_back(c * core::pow(r, static_cast<double>(stage + (stage > 0 ? 1 : 0))));

    const double exponent = core::log(r) / core::log(2.0);
    const double as_sequence = variance * c * core::pow(double{measured_grid}, exponent);
    const double in_grid = of_grid - variance * left_[stages - 1];
    const double ratio = as_sequence > 0.0 ? std::clamp(in_grid / as_sequence, 0.5, 2.0) : 1.0;
    grid_error_ = {ratio * variance / weights * c, exponent};
}

double Survey::squared_error_at(const Record& record, std::size_t stage) const {
    const double variance = record.squares[stages - 1] / (samples_at(stages - 1) - 1.0);
    if (stage < measured_stages) return record.squared_error[stage] + variance * left_[stages - 1];
    return variance * left_[stage];
}

Survey::Outcome Survey::outcome_of(const Policy& policy) const {
    Outcome all;
    double weights = 0.0;
    for (const Record& record : records_) {
        std::size_t stage = 0;
        const auto is_done = [&] {
            const Known known{record.around, record.squares[std::min(stage, stages - 1)],
                              stage == 0 ? 0 : samples_at(stage)};
            return Survey::is_done(known, policy);
        };
        while (samples_at(stage) < RegionSamples::max_samples && !is_done())
            ++stage;
        all.squared_error += record.weight * squared_error_at(record, stage);
        all.cost += record.weight * record.cost * weighted_samples(samples_at(stage), policy);
        weights += record.weight;
    }
    return {all.squared_error / weights, all.cost / weights};
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
/// grows with the limit. Chooses the cheapest policy of those that do not exceed the quality by
/// much, if there are any. Last, compares it with the same grid in all pixels.
void Survey::choose_policy() {
    fit_errors();
    const double asked = squared_error_of(margin), too_good = squared_error_of(margin + excess);
    const double sample_cost = mean_cost();
    const double max_cost = RegionSamples::max_samples * sample_cost;
    double least = infinity<double>;
    bool is_too_good = true;
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
            const bool exceeds = outcome.squared_error < too_good;
            if (exceeds == is_too_good ? cost < least : is_too_good) {
                least = cost;
                is_too_good = exceeds;
                policy_ = policy;
            }
        }
    for (int side = 2; side * side <= RegionSamples::max_samples; ++side) {
        const int count = side * side;
        const double error =
            grid_error_.scale * core::pow(static_cast<double>(count), grid_error_.exponent);
        const double cost = count * sample_cost;
        if (error <= squared_error_of(least_of_grid) && error >= squared_error_of(most_of_grid) &&
            cost < least) {
            least = cost;
            policy_ = {count, false, infinity<double>, count};
        }
    }
}

} // namespace raylane::core
