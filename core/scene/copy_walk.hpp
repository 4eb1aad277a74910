#pragma once

#include "core/scene/copies.hpp"
#include "core/shapes/ray.hpp"

#include <cstdint>
#include <vector>

namespace raylane::core {

/// Finds the copies whose bounds a ray enters, roughly the nearest first, and perhaps some more.
/// Computes in float, with bounds on the errors. For use by one thread.
class CopyWalk {
  public:
    explicit CopyWalk(const Copies& copies) : copies_(&copies) {}

    /// Starts a walk along a ray, whose direction may have any length. `off`: bound on the error
    /// of each coordinate of its origin.
    void start(const Ray<double>& ray, double off = 0.0);

    /// Returns true and the next copy whose bounds the ray enters before t_limit, which may be
    /// another one at each call.
    bool next(double t_limit, std::uint32_t& copy) {
        At at{};
        do
            at = step(t_limit, copy);
        while (at == At::node);
        return at == At::copy;
    }

    enum class At { node, copy, end };
    /// Visits one node of the hierarchy, or arrives at the next copy. Begins to load the data of
    /// the next step, so the steps of several walks should alternate.
    At step(double t_limit, std::uint32_t& copy);

  private:
    struct Pending {
        float t;
        std::uint32_t child;
    };
    void enter(const Copies::Node& node, float t_limit);
    void load_next() const;

    const Copies* copies_;
    double length_ = 1.0; // of the direction
    // The ray with a direction of length 1. Its origin is moved by its error against the ray for
    // the planes of entry, and along it for those of exit.
    float from_[3]{}, until_[3]{}, inverse_[3]{};
    std::vector<Pending> pending_; // the nearest children of a node last
};

} // namespace raylane::core
