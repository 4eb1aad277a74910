#include "core/reference/path_lengths.hpp"

#include "core/reference/rounding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace raylane::core {

namespace {

using Extended = Bounded<DoubleDouble>;

/// Returns the length of a vector that is not 0, as a number times 2^exponent.
Extended length_of(const Vec3d& v, int& exponent) {
    exponent = std::ilogb(largest_component(v));
    Vec3<Extended> scaled;
    for (int axis = 0; axis < 3; ++axis)
        scaled[axis] = std::ldexp(v[axis], -exponent); // tiny components do not matter
    return sqrt(squared_length(scaled));
}

/// Returns true if the sum is certainly not 0, and accurate enough to be rounded to double.
bool is_good(const Extended& sum) {
    return sum.value.high > 0.0 && sum.error <= 0x1p-60 * sum.value.high;
}

void sort_from(std::size_t first, std::vector<BodyLength>& lengths) {
    std::sort(lengths.begin() + static_cast<std::ptrdiff_t>(first), lengths.end(),
              [](const BodyLength& a, const BodyLength& b) { return a.body < b.body; });
}

} // namespace

PathLengths::PathLengths(const Scene& scene) : scene_(scene), endless_(unbounded_solids(scene)) {
    std::erase_if(endless_, [&](Solids::Index solid) { return scene.solids().node(solid).open; });
}

/// Forgets all bodies, and prepares for at most `most`.
void PathLengths::forget(std::size_t most) {
    count_ = 0;
    const std::size_t least = std::bit_ceil(2 * most + 1);
    if (buckets_.size() < least) buckets_.resize(least);
}

PathLengths::Body& PathLengths::numbered(std::uint32_t number) {
    std::size_t bucket = number * std::uint64_t{0x9E3779B97F4A7C15} >> 32;
    for (;; ++bucket) {
        bucket &= buckets_.size() - 1;
        const std::uint32_t index = buckets_[bucket];
        if (index >= count_ || all_[index].bucket != bucket) break;
        if (all_[index].number == number) return all_[index];
    }
    buckets_[bucket] = static_cast<std::uint32_t>(count_);
    if (count_ == all_.size()) all_.emplace_back();
    Body& added = all_[count_++];
    added.number = number;
    added.bucket = bucket;
    added.depth = 0;
    added.begin = {};
    added.parts.clear();
    return added;
}

/// Begins the solids that the ray starts in: those that it leaves before it enters them, and those
/// that it never crosses but that contain its end.
void PathLengths::begin_around_start(const LeavingRay& from, std::span<const Hit<double>> hits,
                                     double t_min) {
    const auto begin = [&](Body& one) { pass(one, true, limit_at(t_min)); };
    by_solid_.clear();
    for (std::size_t i = 0; i < hits.size(); ++i)
        by_solid_.emplace_back(scene_.solids().solid_of(hits[i].shape), i);
    std::sort(by_solid_.begin(), by_solid_.end());
    for (std::size_t k = 0; k < by_solid_.size(); ++k) {
        const auto& [solid, i] = by_solid_[k];
        const bool is_first = k == 0 || by_solid_[k - 1].first != solid;
        if (is_first && !hits[i].enters()) begin(body_of(hits[i].shape));
    }
    for (const Solids::Index solid : endless_) {
        const std::pair any(scene_.solids().node(solid).shape, std::size_t{0});
        const auto met = std::lower_bound(by_solid_.begin(), by_solid_.end(), any);
        const bool is_met = met != by_solid_.end() && met->first == any.first;
        if (!is_met && side_at_end(scene_, solid, from.ray) == Side::inside)
            begin(body_of(any.first));
    }
}

void PathLengths::add(const LeavingRay& from, std::span<const Hit<double>> found, double t_min,
                      double t_max, Bodies bodies, std::vector<BodyLength>& lengths) {
    if (!(t_min < t_max)) return;
    bodies_ = bodies;
    // A ray may leave a solid that is cut open without having entered it.
    std::span<const Hit<double>> hits = found;
    if (std::any_of(found.begin(), found.end(),
                    [&](const Hit<double>& hit) { return scene_.solids().is_open(hit.shape); })) {
        closed_.clear();
        std::copy_if(found.begin(), found.end(), std::back_inserter(closed_),
                     [&](const Hit<double>& hit) { return !scene_.solids().is_open(hit.shape); });
        hits = closed_;
    }
    sharp_.assign(hits.begin(), hits.end());
    forget(hits.size() + endless_.size());

    begin_around_start(from, hits, t_min);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit<double>& hit = hits[i];
        End end{false, {}, &sharp_[i]};
        if (compare_t(scene_, from, hit, t_min) <= 0)
            end = limit_at(t_min);
        else if (compare_t(scene_, from, hit, t_max) >= 0)
            end = limit_at(t_max);
        pass(body_of(hit.shape), hit.enters(), end);
    }
    end_at(t_max);

    const CrossingOrder order(scene_, from);
    int of_speed = 0;
    const Extended speed = length_of(from.ray.direction, of_speed);
    const std::size_t first = lengths.size();
    for (std::size_t i = 0; i < count_; ++i) {
        Body& one = all_[i];
        if (one.depth > 0 && !std::isfinite(t_max)) {
            lengths.push_back({one.number, t_max});
            continue;
        }
        for (const Inside& part : one.parts)
            for (const End& end : {part.begin, part.end})
                if (end.crossing != nullptr) end.crossing->widen(scene_, from);
        Extended sum = sum_of(one.parts);
        int exponent = 0;
        if (!is_good(sum)) {
            std::erase_if(one.parts, [&](const Inside& part) {
                return part.begin.crossing != nullptr && part.end.crossing != nullptr &&
                       order.compare(*part.begin.crossing, *part.end.crossing) == 0;
            });
            sum = exact_sum_of(from, one.parts, exponent);
        }
        const double length = std::ldexp(in_double(sum * speed).value, exponent + of_speed);
        if (!one.parts.empty()) lengths.push_back({one.number, length});
    }
    sort_from(first, lengths);
}

bool PathLengths::add_certain(const Ray<double>& ray, std::span<const SolidCrossing> crossings,
                              double t_min, double t_max, std::vector<BodyLength>& lengths) {
    if (!(t_min < t_max)) return true;
    forget(crossings.size());
    for (const SolidCrossing& crossing : crossings)
        if (crossing.from_inside) pass(numbered(crossing.body), true, limit_at(t_min));
    for (const SolidCrossing& crossing : crossings) {
        const Bounded<double> t = in_double(crossing.t);
        const double off = t.error + 0x1p-52 * t.magnitude(); // covers the sums' roundings
        End end{false, crossing.t, nullptr};
        if (t.value + off <= t_min)
            end = limit_at(t_min);
        else if (t.value - off >= t_max)
            end = limit_at(t_max);
        else if (!(t.value - off > t_min && t.value + off < t_max))
            return false;
        pass(numbered(crossing.body), crossing.enters, end);
    }
    end_at(t_max);

    const Extended speed = sqrt(squared_length(convert<Extended>(ray.direction)));
    const std::size_t first = lengths.size();
    for (std::size_t i = 0; i < count_; ++i) {
        const Body& one = all_[i];
        if (one.parts.empty()) continue;
        const Extended sum = sum_of(one.parts);
        if (!is_good(sum)) {
            lengths.resize(first);
            return false;
        }
        lengths.push_back({one.number, in_double(sum * speed).value});
    }
    sort_from(first, lengths);
    return true;
}

/// Passes a crossing of one of the body's solids, or a limit in its place.
void PathLengths::pass(Body& one, bool enters, const End& end) {
    if (enters) {
        if (one.depth++ == 0) one.begin = end;
    } else if (--one.depth == 0) {
        const bool is_none = end.is_limit && one.begin.is_limit_at(end.at.value.high);
        if (!is_none) one.parts.push_back({one.begin, end});
    }
}

/// Ends the bodies that the ray never leaves at t_max.
void PathLengths::end_at(double t_max) {
    for (std::size_t i = 0; i < count_; ++i) {
        Body& one = all_[i];
        if (one.depth > 0 && !one.begin.is_limit_at(t_max))
            one.parts.push_back({one.begin, limit_at(t_max)});
    }
}

Bounded<DoubleDouble> PathLengths::sum_of(const std::vector<Inside>& parts) const {
    Extended sum;
    for (const Inside& part : parts)
        sum = sum + (part.end.t() - part.begin.t());
    return sum;
}

/// Returns the sum of parts that are not empty, with as many digits as it takes, as a number times
/// 2^exponent.
Bounded<DoubleDouble> PathLengths::exact_sum_of(const LeavingRay& from,
                                                const std::vector<Inside>& parts,
                                                int& exponent) const {
    if (parts.empty()) return {};
    const auto t_within = [&](const End& end, int within) -> Dyadic {
        if (end.crossing == nullptr) return end.at.value.high;
        const Hit<double>& hit = end.crossing->hit();
        return end.crossing->root(scene_, from).near(hit.t, hit.error, within);
    };
    for (int within = -60;; within *= 2) {
        Dyadic sum;
        for (const Inside& part : parts)
            sum = sum + (t_within(part.end, within) - t_within(part.begin, within));
        exponent = static_cast<int>(sum.approximately().exponent);
        sum = sum * Dyadic::power_of_2(-exponent);
        // Each end has an error of 2^within. The other terms bound the digits beyond two doubles
        // and underflow.
        const double high = sum.approximately().to_double();
        const double low = (sum - Dyadic(high)).approximately().to_double();
        const double error =
            std::ldexp(2.0 * static_cast<double>(parts.size()), within - exponent) +
            0x1p-48 * std::abs(low) + std::numeric_limits<double>::min();
        const Extended known{{high, low}, error};
        if (is_good(known)) return known;
    }
}

} // namespace raylane::core
