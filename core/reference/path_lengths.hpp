#pragma once

#include "core/reference/containing.hpp"
#include "core/reference/crossing_order.hpp"

#include <span>
#include <vector>

namespace raylane::core {

/// The bodies inside of which lengths are measured: the solids of a material, taken together, or
/// each solid.
enum class Bodies : std::uint8_t { materials, solids };

/// The length of a ray inside of one body.
struct BodyLength {
    std::uint32_t body; ///< the material's index, or the solid's id: that of its first part
    double length;      ///< in the scene's unit, within an ulp; infinite without an end
};

/// A ray's crossing with a shape that is a solid by itself.
struct SolidCrossing {
    std::uint32_t body; ///< as in BodyLength
    bool enters;
    bool from_inside; ///< the ray starts inside of the shape, and leaves it here
    Bounded<DoubleDouble> t;
};

/// Measures the length of a ray, from t_min to t_max, inside of each body. A stretch inside of
/// several solids of one body counts once. A solid that is cut open has no inside. For use by one
/// thread.
class PathLengths {
  public:
    explicit PathLengths(const Scene& scene);

    /// Appends one length for each body, unless it is 0, in the order of BodyLength::body. `hits`:
    /// all of the ray's crossings with solids, in order; for solids that it starts in, only the
    /// exits.
    void add(const LeavingRay& from, std::span<const Hit<double>> hits, double t_min, double t_max,
             Bodies bodies, std::vector<BodyLength>& lengths);
    /// Same for crossings whose order is certain, in scenes without compound solids. Returns false,
    /// and appends nothing, if a limit or a length needs more digits.
    bool add_certain(const Ray<double>& ray, std::span<const SolidCrossing> crossings, double t_min,
                     double t_max, std::vector<BodyLength>& lengths);

  private:
    /// An end of an interval inside of a material: a crossing, or a limit.
    struct End {
        bool is_limit = true;
        Bounded<DoubleDouble> at{};         ///< of a limit or certain crossing
        const SharpHit* crossing = nullptr; ///< of any other crossing

        Bounded<DoubleDouble> t() const { return crossing != nullptr ? crossing->wide_t() : at; }
        bool is_limit_at(double t) const { return is_limit && at.value.high == t; }
    };
    static End limit_at(double t) { return {true, t, nullptr}; }
    struct Inside {
        End begin, end;
    };
    struct Body {
        std::uint32_t number; ///< as in BodyLength
        std::size_t bucket;
        int depth = 0;
        End begin{};
        std::vector<Inside> parts{};
    };

    void forget(std::size_t most);
    Body& numbered(std::uint32_t number);
    std::uint32_t number_of(ShapeId shape) const {
        return bodies_ == Bodies::materials ? scene_.medium_index_of(shape)
                                            : scene_.solids().solid_of(shape);
    }
    Body& body_of(ShapeId shape) { return numbered(number_of(shape)); }
    static void pass(Body& one, bool enters, const End& end);
    void end_at(double t_max);
    void begin_around_start(const LeavingRay& from, std::span<const Hit<double>> hits,
                            double t_min);
    Bounded<DoubleDouble> sum_of(const std::vector<Inside>& parts) const;
    Bounded<DoubleDouble> exact_sum_of(const LeavingRay& from, const std::vector<Inside>& parts,
                                       int& exponent) const;

    const Scene& scene_;
    Bodies bodies_ = Bodies::materials;
    std::vector<Solids::Index> endless_; // solids without bounds that are not cut open
    std::vector<Hit<double>> closed_; // hits of solids that are not cut open, if some are cut open
    std::vector<SharpHit> sharp_;
    std::vector<std::pair<ShapeId, std::size_t>> by_solid_; // with the index of the hit
    std::vector<Body> all_; // of the ray: the first count_; the rest is spare
    std::size_t count_ = 0;
    // A hash table of indices in all_, which is as good as empty if no body has the bucket.
    std::vector<std::uint32_t> buckets_;
};

} // namespace raylane::core
