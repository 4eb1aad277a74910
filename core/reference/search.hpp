#pragma once

#include "core/reference/counters.hpp"
#include "core/reference/rounding.hpp"
#include "core/reference/solid_surfaces.hpp"
#include "core/scene/copy_walk.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

/// Finds the hits of a ray: one shape after the other, through the hierarchy or by brute force.
namespace raylane::core {

template <class Signature>
class FunctionRef;

/// Non-owning reference to a callable, for functions that are compiled once instead of once per
/// callable. It must not outlive the callable.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>)
        FunctionRef(const Callable& callable) // NOLINT: implicit
        : callable_(std::addressof(callable)),
          call_([](const void* pointer, Arguments... arguments) {
              return (*static_cast<const Callable*>(pointer))(
                  std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(callable_, std::forward<Arguments>(arguments)...);
    }

  private:
    const void* callable_;
    Result (*call_)(const void*, Arguments...);
};

enum class Search : std::uint8_t { hierarchy, every_shape };

/// Searches one scene. For use by one thread.
template <class Real>
class Searcher {
  public:
    /// Predicate on a hit.
    using OfHit = FunctionRef<bool(const Hit<Real>&)>;

    Searcher(const Scene& scene, Search search, Precision precision = precision_of<Real>);

    /// Returns the first crossing with t < t_limit for which `counts(hit)` is true. Without one, t
    /// is infinite.
    Encounter<Real> nearest(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, OfHit counts,
                            Real t_limit = std::numeric_limits<Real>::infinity());

    /// Calls visit(hit) for the crossings of surfaces with t < t_limit, in no order, until it
    /// returns false.
    void each(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, Real t_limit, OfHit visit);

    /// Returns the point of a crossing, and the unit normal on the outside (the front) there.
    SurfacePoint<Real> surface_at(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                                  const Hit<Real>& hit) const;

    /// Sorts hits into the order in which the ray meets them.
    void sort(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
              std::vector<Hit<Real>>& hits);

    Counters counters;

  private:
    bool is_exact() const { return precision_ == Precision::exact; }
    bool is_surface(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                    const Hit<Real>& hit);

    /// A hit that may be the first, or in contact with the first.
    struct Candidate {
        Hit<Real> hit;
        bool may_be_hit;
    };
    Hit<Real> look(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, OfHit counts,
                   Real t_limit);
    Encounter<Real> encounter(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                              const Hit<Real>& best);
    template <class AnyHit, class Compare>
    Encounter<Real> first_of(const std::vector<AnyHit>& hits, const Ray<Real>& ray,
                             const OriginSurfaces<Real>& origins, const Compare& compare);

    struct Pending {
        Real t;
        Child child;
    };
    template <class Most, class Visit>
    void for_each_candidate(const Ray<Real>& ray, const Most& t_limit, const Visit& visit);
    template <class Most, class Visit>
    void walk(const Ray<Real>& ray, const Most& t_limit, const Visit& visit);
    template <class Most, class Visit>
    void walk_copies(const Ray<Real>& ray, const Most& t_limit, const Visit& visit);
    void cross_block(Kind kind, std::uint32_t index, const Ray<Real>& ray,
                     const OriginSurfaces<Real>& origins,
                     FunctionRef<void(const Hit<Real>&)> visit);

    const Scene& scene_;
    Search search_;
    Precision precision_;
    std::vector<Pending> pending_;      // nearest last
    std::vector<Candidate> candidates_; // of the search for the nearest hit
    std::vector<Contact<Real>> contacts_;
    std::vector<SharpHit> sharp_; // the candidates, or the hits to sort
    SolidSurfaces solid_surfaces_;
    std::optional<CopyWalk> copy_walk_;
};

extern template class Searcher<float>;
extern template class Searcher<double>;

} // namespace raylane::core
