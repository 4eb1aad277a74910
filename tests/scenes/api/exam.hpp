#pragma once

#include "tests/oracle/truth.hpp"
#include "tests/scenes/api/ray_arrays.hpp"

#include <functional>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

/// Checks every kind of query of the library against the oracle.
namespace raylane::tests {

/// Visible sides of the shapes of a scene.
enum class Sides {
    both,
    some, ///< in turn both sides, the outside, and the inside
};

/// Returns the shapes that core finds valid.
template <oracle::Variant Any>
std::vector<Any> valid(std::vector<Any> shapes);
template <oracle::Variant Any>
Scene scene_of(const std::vector<Any>& shapes, Sides sides = Sides::both);
/// Returns true if both have the same kind and bits.
template <oracle::Variant Any>
bool are_same(const Any& a, const Any& b);
/// Returns for each shape whether it counts: 0 if an equal one of the same material comes before.
template <oracle::Variant Any>
std::vector<char> which_count(const std::vector<Any>& shapes, Sides sides = Sides::both);

/// Returns true if a row has all crossings of a line that count, in their order.
bool is_right(const CrossingRows& rows, std::size_t row, const oracle::Sight& sight,
              const std::function<bool(const oracle::Found&)>& counts);

/// Returns true if a row of at most one crossing has the first of all crossings, in each column.
bool is_first(const CrossingRows& firsts, const CrossingRows& rows, std::size_t row);

/// Faults of an answer.
enum class Fault {
    shape,
    t,
    normal,
    side,      ///< entered or left
    occlusion, ///< of `occluded`
    crossings, ///< of `crossings`
    other,     ///< bits differ with instruction set or number of threads; one count a span
};
inline constexpr const char* fault_names[] = {"shape",     "t",         "normal", "side",
                                              "occlusion", "crossings", "other"};

/// Counts queries and wrong answers.
struct Tally {
    long lines = 0; ///< rays before limits are added
    long rays = 0, hits = 0, crossings = 0;
    long faults[std::size(fault_names)] = {};
    std::string first[std::size(fault_names)]; ///< the first fault of each type

    long wrong() const { return std::accumulate(std::begin(faults), std::end(faults), 0L); }
    std::string report() const;
};

enum class Limits {
    none,
    at_crossings, ///< t_min and t_max at each crossing's t, an ulp before and an ulp behind it
};
enum class Ways { one, all }; ///< instruction sets and threads to compare with the library's

/// Owns one scene and its tracer, and checks answers for it. Invalid shapes are omitted.
class Exam {
  public:
    explicit Exam(std::vector<AnyShape> shapes, Sides sides = Sides::both);

    void ask(std::span<const core::Ray<float>> rays, Limits limits, Ways ways, Tally& tally);

  private:
    struct Questions {
        std::vector<oracle::Sight> sights;
        Rays rays;
        std::vector<std::size_t> sight_of; ///< by ray
    };
    struct Answers {
        Hits hits;
        std::vector<std::uint8_t> blocked;
        CrossingRows rows{}, firsts{}; ///< all crossings, and at most one a ray
    };

    static void add(Questions& questions, const core::Ray<float>& ray, float t_min, float t_max);
    static void add_limited(Questions& questions, const core::Ray<float>& ray);
    void check(Questions& questions, std::size_t i, const Answers& answers, Tally& tally) const;
    void check_others(const Rays& rays, const Answers& answers, Ways ways, Tally& tally) const;
    void blame(Fault fault, const Rays& rays, std::size_t i, const Answers& answers,
               const oracle::Found* truth, Tally& tally) const;
    std::string described(const Rays& rays, std::size_t i, const Answers& answers,
                          const oracle::Found* truth) const;

    std::vector<AnyShape> shapes_;
    Sides sides_;
    std::vector<char> counts_; ///< result of which_count
    oracle::Neighbours neighbours_;
    Scene scene_;
    Tracer tracer_;
};

} // namespace raylane::tests
