#pragma once

#include "core/ray.hpp"
#include "core/scene.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace raylane::core {

/// A ray's crossing with a shape.
template <class Real>
struct Hit {
    Real t = std::numeric_limits<Real>::infinity();
    double error = 0.0;    ///< what t may be off by
    bool at_start = false; ///< a contact of the start, t = 0
    ShapeId shape = no_shape;
    Face face = body;
    bool entering = false;
    Kind kind = Kind::sphere;
    Slot slot{};

    bool any() const { return shape != no_shape; }

    /// A total order: by t; at equal t what is entered before what is left, then by shape.
    bool before(const Hit& other) const { return key() < other.key(); }

    /// Whether no arithmetic in double can tell which comes first.
    bool coincides(const Hit& other) const {
        return std::abs(static_cast<double>(t) - static_cast<double>(other.t)) <=
               error + other.error;
    }

  private:
    auto key() const { return std::tuple(t, !at_start, !entering, shape); }
};

/// One of the surfaces that a ray meets at one point.
template <class Real>
struct Contact {
    Hit<Real> hit;
    IdRange shapes;    ///< its shape and what lies in one plane with it
    Vec3<Real> normal; ///< unit, outward
    bool inside;       ///< whether the ray is on its inside now
    bool goes_inside;  ///< and where it goes

    bool is_crossed() const { return inside != goes_inside; }
};

/// What a secondary ray knows of the surfaces that it leaves: which they are, on which side it is,
/// and to which it goes. No arithmetic has to find that again. It is more than one surface where a
/// block stands on a table, or at an edge. Those which the ray is still to cross it crosses at t =
/// 0.
template <class Real>
class Departure {
  public:
    /// Others are forgotten. A path keeps as many at each of its bends, on the stack.
    static constexpr int most_contacts = 4;

    void add(const Contact<Real>& contact) {
        if (size_ < most_contacts) contacts_[size_++] = contact;
    }

    const Contact<Real>* begin() const { return contacts_.data(); }
    const Contact<Real>* end() const { return contacts_.data() + size_; }

    const Contact<Real>* find(ShapeId id) const {
        for (const Contact<Real>& contact : *this)
            if (contact.shapes.contains(id)) return &contact;
        return nullptr;
    }

    /// How a shape's solver has to see the start: as if the ray were already where it goes.
    Start start_on(ShapeId id) const {
        const Contact<Real>* contact = find(id);
        return contact != nullptr ? Start{true, contact->hit.face, contact->goes_inside} : Start{};
    }

    /// For a ray in another direction from the same point, which is one of the contacts' `hit`. It
    /// either goes through that surface, or stays on the side from which it was hit.
    Departure turned(const Hit<Real>& hit, bool through, const Vec3<Real>& direction) const {
        const Contact<Real>& surface = *find(hit.shape);
        Departure result = *this;
        const bool goes_inside = through == hit.entering;
        for (int i = 0; i < size_; ++i) {
            Contact<Real>& contact = result.contacts_[i];
            if (&surface == &contacts_[i])
                contact.inside = contact.goes_inside = goes_inside;
            else if (parallel(contact.normal, surface.normal))
                contact.goes_inside =
                    goes_inside == (dot(contact.normal, surface.normal) > Real(0));
            else
                contact.goes_inside = dot(contact.normal, direction) < Real(0);
        }
        return result;
    }

  private:
    /// As far as directions of float precision can tell.
    static bool parallel(const Vec3<Real>& a, const Vec3<Real>& b) {
        constexpr Real largest_sine = Real(0x1p-24);
        return squared_length(cross(a, b)) <= largest_sine * largest_sine;
    }

    std::array<Contact<Real>, most_contacts> contacts_;
    int size_ = 0;
};

/// The first surface that a ray meets, with all that it meets there.
template <class Real>
struct Encounter {
    Hit<Real> hit;
    Departure<Real> contacts;
    bool is_close = false; ///< the next one is too near for t to be off by more than a rounding
};

} // namespace raylane::core
