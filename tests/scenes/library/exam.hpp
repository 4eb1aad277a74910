#pragma once

#include "tests/oracle/truth.hpp"
#include "tests/scenes/library/ray_arrays.hpp"

#include <functional>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

/// Scenes and rays asked of the library in every way there is, against the oracle.
namespace raylane::tests {

/// Sides of shapes that can be seen.
enum class Sides {
    both,
    some, ///< of every third shape the outside, of every third the inside, of the others both
};

/// Without what core finds not valid.
template <oracle::Variant Any>
std::vector<Any> valid(std::vector<Any> shapes);
template <oracle::Variant Any>
Scene scene_of(const std::vector<Any>& shapes, Sides sides = Sides::both);
/// Float by float.
template <oracle::Variant Any>
bool are_same(const Any& a, const Any& b);
/// By shape: false if one before it is the same, of one material.
template <oracle::Variant Any>
std::vector<char> which_count(const std::vector<Any>& shapes, Sides sides = Sides::both);

/// True if a row has all crossings of a line that count, and in their order.
bool is_right(const CrossingRows& rows, std::size_t row, const oracle::Sight& sight,
              const std::function<bool(const oracle::Found&)>& counts);

/// Fault that an answer may have.
enum class Fault {
    shape,
    t,
    normal,
    side,      ///< entered or left
    occlusion, ///< by `occluded`
    crossings, ///< by `crossings`
    other,     ///< another instruction set or number of threads gives other bits; counts spans
};
inline constexpr const char* fault_names[] = {"shape",     "t",         "normal", "side",
                                              "occlusion", "crossings", "other"};

/// Tally of what was asked, and of the wrong answers.
struct Tally {
    long lines = 0; ///< without their limits
    long rays = 0, hits = 0, crossings = 0;
    long faults[std::size(fault_names)] = {};
    std::string first[std::size(fault_names)]; ///< of each

    long wrong() const { return std::accumulate(std::begin(faults), std::end(faults), 0L); }
    std::string report() const;
};

enum class Limits {
    none,
    at_crossings, ///< t_min and t_max at each crossing's t, an ulp before and an ulp behind it
};
enum class Ways { one, all }; ///< of instruction sets and threads besides the library's

/// One scene. What core finds not valid is left out of it.
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
        CrossingRows rows{};
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
    std::vector<char> counts_; ///< which_count
    oracle::Neighbours neighbours_;
    Scene scene_;
    Tracer tracer_;
};

} // namespace raylane::tests
