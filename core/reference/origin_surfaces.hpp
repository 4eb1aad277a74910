#pragma once

#include "core/numbers/inline_vector.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace raylane::core {

/// Returns true if a ray's start and the point at t may be on the wrong side of surfaces that it
/// has left and that it meets, because they are rounded. A ray that leaves the point then stands on
/// both surfaces: otherwise it could meet them in turns without end. The bound is 2^13 half ulps,
/// for surfaces that the ray almost touches.
inline bool is_rounded_away(const Vec3<double>& origin, double t) {
    return t <= 0x1p-40 * largest_component(origin);
}

/// A ray's crossing with a shape.
template <class Real>
struct Hit {
    Real t = std::numeric_limits<Real>::infinity();
    double error = 0.0;    ///< bound on the error of t
    bool at_start = false; ///< a contact of the start, t = 0
    ShapeId shape = no_shape;
    Face face = body;
    bool entering = false;
    Kind kind{};
    Place place{};
    bool joins = false;    ///< in a sorted list: at the same t as the hit before
    bool reversed = false; ///< its shape is a reversed part of a solid, in which the outside counts

    Hit() = default;
    Hit(const Crossing<Real>& crossing, ShapeId shape_, Kind kind_, Place place_, bool reversed_)
        : t(crossing.t), error(crossing.error), shape(shape_), face(crossing.face),
          entering(crossing.entering), kind(kind_), place(place_), reversed(reversed_) {}
    template <class Other>
    explicit Hit(const Hit<Other>& other)
        : t(Real(other.t)), error(other.error), at_start(other.at_start), shape(other.shape),
          face(other.face), entering(other.entering), kind(other.kind), place(other.place),
          joins(other.joins), reversed(other.reversed) {}

    bool any() const { return shape != no_shape; }
    /// Returns true if the ray goes to the inside of the shape, or of the solid for a reversed
    /// part.
    bool enters() const { return entering != reversed; }

    /// Orders two hits at the same t: hits at the start, then entering hits, then the lower shape
    /// id.
    bool precedes(const Hit& other) const {
        if (at_start != other.at_start) return at_start;
        if (enters() != other.enters()) return enters();
        return shape < other.shape;
    }
    /// Returns true if t alone proves that this hit is nearer.
    bool is_surely_before(const Hit& other) const {
        return static_cast<double>(other.t) - static_cast<double>(t) >
               (error + other.error) * (1.0 + 0x1p-50);
    }
};

/// One of the surfaces that a ray meets at one point.
template <class Real>
struct Contact {
    Hit<Real> hit;
    IdRange shapes; ///< its shape and the shapes coplanar with it
    MaterialIndex material;
    Vec3<Real> normal;        ///< unit, outward
    bool inside;              ///< true if the ray is on the inside now
    bool goes_inside;         ///< true if the ray goes to the inside
    ShapeId solid = no_shape; ///< the solid that it is a part of, if any
    bool is_surface = true;   ///< the contact is on the solid's surface, too

    bool is_part() const { return solid != no_shape; }
    bool is_crossed() const { return inside != goes_inside; }
};

/// Origin surfaces: the surfaces that a secondary ray starts on, with the side of each on which the
/// ray is and the side to which it goes. No arithmetic has to find them again. There may be any
/// number, such as where a block stands on a table, or at an edge. The ray crosses the surfaces
/// that it still has to cross at t = 0. Coincident surfaces of one material that are entered or
/// left together are one surface: it is seen once, however many there are.
template <class Real>
class OriginSurfaces {
  public:
    OriginSurfaces() = default;
    /// Converts from another real type.
    template <class Other>
    explicit OriginSurfaces(const OriginSurfaces<Other>& other) {
        contacts_.reset(other.size());
        std::transform(
            other.begin(), other.end(), contacts_.begin(), [](const Contact<Other>& contact) {
                return Contact<Real>{Hit<Real>(contact.hit), contact.shapes,
                                     contact.material,       convert<Real>(contact.normal),
                                     contact.inside,         contact.goes_inside,
                                     contact.solid,          contact.is_surface};
            });
    }
    /// Takes contacts, each with a different shape.
    explicit OriginSurfaces(std::span<const Contact<Real>> contacts) {
        contacts_.reset(contacts.size());
        std::copy(contacts.begin(), contacts.end(), contacts_.begin());
        std::sort(contacts_.begin(), contacts_.end(),
                  [](const Contact<Real>& a, const Contact<Real>& b) {
                      return a.shapes.first < b.shapes.first;
                  });
    }

    const Contact<Real>* begin() const { return contacts_.begin(); }
    const Contact<Real>* end() const { return contacts_.end(); }
    std::size_t size() const { return contacts_.size(); }

    const Contact<Real>* find(ShapeId id) const {
        if (contacts_.empty()) return nullptr;
        const auto* after = std::upper_bound(begin(), end(), id, is_below);
        return after != begin() && after[-1].shapes.contains(id) ? after - 1 : nullptr;
    }

    /// Returns the start for a shape's solver: the ray counts as being on the side to which it
    /// goes.
    Start start_on(ShapeId id) const {
        const Contact<Real>* contact = find(id);
        return contact != nullptr ? Start{true, contact->hit.face, contact->goes_inside} : Start{};
    }

    /// Returns the number of contacts that are one surface with the contact of a hit.
    int count_as_one(const Hit<Real>& hit) const {
        const Contact<Real>& surface = *find(hit.shape);
        int count = 0;
        for (const Contact<Real>& contact : contacts_)
            count += contact.is_surface && are_one(contact, surface) ? 1 : 0;
        return count;
    }

    /// Returns the surfaces for a ray in another direction from the same point. The contact of
    /// `hit` is the surface that was hit. The ray goes through it or stays on the side from which
    /// it was hit.
    OriginSurfaces turned(const Hit<Real>& hit, bool through, const Vec3<Real>& direction) const {
        const Contact<Real>& surface = *find(hit.shape);
        OriginSurfaces result = *this;
        const bool goes_inside = through == hit.entering;
        for (Contact<Real>& contact : result.contacts_) {
            if (!contact.is_part() && are_one(contact, surface)) {
                contact.inside = contact.goes_inside = goes_inside;
                continue;
            }
            if (contact.hit.shape == hit.shape || parallel(contact.normal, surface.normal))
                contact.goes_inside =
                    goes_inside == (dot(contact.normal, surface.normal) > Real(0));
            else
                contact.goes_inside = dot(contact.normal, direction) < Real(0);
            // The change of the solid at this point has been seen, whichever of its parts are
            // crossed.
            if (contact.hit.shape == hit.shape || (through && is_of_one(contact, surface)))
                contact.inside = contact.goes_inside;
        }
        return result;
    }

    /// Returns these surfaces and those that the ray has left shortly before, without crossing
    /// these since.
    OriginSurfaces joined(const OriginSurfaces& left) const {
        std::vector<Contact<Real>> contacts(begin(), end());
        for (const Contact<Real>& contact : left)
            if (find(contact.hit.shape) == nullptr) {
                contacts.push_back(contact);
                contacts.back().inside = contact.goes_inside;
            }
        return OriginSurfaces(contacts);
    }

  private:
    static bool is_below(ShapeId id, const Contact<Real>& contact) {
        return id < contact.shapes.first;
    }
    static bool are_one(const Contact<Real>& contact, const Contact<Real>& surface) {
        const bool alike = contact.hit.reversed == surface.hit.reversed;
        return contact.shapes.first == surface.shapes.first ||
               (contact.material == surface.material &&
                (contact.inside == surface.inside) == alike &&
                (dot(contact.normal, surface.normal) > Real(0)) == alike &&
                parallel(contact.normal, surface.normal));
    }
    /// Returns true for a part of a solid whose surface is one with `surface`.
    bool is_of_one(const Contact<Real>& part, const Contact<Real>& surface) const {
        return part.is_part() && std::any_of(begin(), end(), [&](const Contact<Real>& other) {
                   return other.solid == part.solid && other.is_surface && are_one(other, surface);
               });
    }
    /// Returns true if parallel, as far as directions of float precision can tell.
    static bool parallel(const Vec3<Real>& a, const Vec3<Real>& b) {
        constexpr Real largest_sine = Real(0x1p-24);
        return squared_length(cross(a, b)) <= largest_sine * largest_sine;
    }

    InlineVector<Contact<Real>, 4> contacts_; // sorted by shape
};

/// The first surface that a ray meets, with all its contacts there.
template <class Real>
struct Encounter {
    Hit<Real> hit;
    OriginSurfaces<Real> contacts;
};

} // namespace raylane::core
