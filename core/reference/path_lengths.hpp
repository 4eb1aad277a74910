#pragma once

#include "core/reference/containing.hpp"
#include "core/reference/crossing_order.hpp"

#include <span>
#include <vector>

namespace raylane::core {

/// The length of a ray inside of the solids of one material.
struct MaterialLength {
    MaterialIndex material;
    double length; ///< in the scene's unit, within an ulp; infinite without an end
};

/// Measures the length of a ray, from t_min to t_max, inside of each material's solids. A stretch
/// inside of several solids of one material counts once. A solid that is cut open has no inside.
/// For use by one thread.
class PathLengths {
  public:
    explicit PathLengths(const Scene& scene);

    /// Appends one length for each material, unless it is 0, in the order of the materials. `hits`:
    /// all of the ray's crossings with solids, in order; for solids that it starts in, only the
    /// exits.
    void add(const LeavingRay& from, std::span<const Hit<double>> hits, double t_min, double t_max,
             std::vector<MaterialLength>& lengths);

  private:
    /// An end of an interval inside of a material: a crossing, or a limit.
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
    std::vector<Hit<double>> closed_; // hits of solids that are not cut open, if some are cut open
    std::vector<SharpHit> sharp_;
    std::vector<std::pair<ShapeId, std::size_t>> by_solid_; // with the index of the hit
    std::vector<OfMaterial> materials_; // of the ray: the first count_; the rest is spare
    std::size_t count_ = 0;
    std::vector<std::uint32_t> place_of_; // by material: its index in materials_, if present
};

} // namespace raylane::core
