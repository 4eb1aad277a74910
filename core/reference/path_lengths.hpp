#pragma once

#include "core/reference/containing.hpp"
#include "core/reference/crossing_order.hpp"

#include <span>
#include <vector>

namespace raylane::core {

/// The length of a ray inside of the solids of one material.
struct MaterialLength {
    MaterialIndex material;
    double length; ///< in the scene's unit, within an ulp; infinite where it has no end
};

/// Measures how much of a ray, from t_min to t_max, is inside of each material's solids: of what is
/// in several of one material, once; what is cut open has no inside. To be used by one thread.
class PathLengths {
  public:
    explicit PathLengths(const Scene& scene);

    /// Appends lengths that are not 0, by material. `hits`: all of the ray's crossings with solids,
    /// in order; of those that it starts in, the ways out alone.
    void add(const LeavingRay& from, std::span<const Hit<double>> hits, double t_min, double t_max,
             std::vector<MaterialLength>& lengths);

  private:
    /// An end of what is inside: a crossing, or a limit.
    struct End {
        const SharpHit* crossing = nullptr;
        double limit = 0.0;

        Bounded<DoubleDouble> t() const;
    };
    struct Inside {
        End begin, end;
    };
    struct OfMaterial {
        MaterialIndex material;
        int depth = 0;
        End begin{};
        std::vector<Inside> parts{};
    };

    OfMaterial& of(MaterialIndex material);
    OfMaterial& of(const Hit<double>& hit) { return of(scene_.medium_index_of(hit.shape)); }
    void begin_around_start(const LeavingRay& from, std::span<const Hit<double>> hits,
                            double t_min);
    Bounded<DoubleDouble> sum_of(const std::vector<Inside>& parts) const;
    Bounded<DoubleDouble> exact_sum_of(const LeavingRay& from,
                                       const std::vector<Inside>& parts) const;

    const Scene& scene_;
    std::vector<Solids::Index> endless_; // solids without bounds that are not cut open
    std::vector<Hit<double>> closed_;    // those of solids that are not cut open, where some are
    std::vector<SharpHit> sharp_;
    std::vector<std::pair<ShapeId, std::size_t>> by_solid_; // with the number of the hit
    std::vector<OfMaterial> materials_; // of the ray, and some more of earlier ones
    std::size_t count_ = 0;
    std::vector<std::uint32_t> place_of_; // by material, if it is there
};

} // namespace raylane::core
