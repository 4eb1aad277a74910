#include "scenes/formats/pov/assembly.hpp"

#include "core/shapes/invalid_value.hpp"
#include "core/solids/half_spaces.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace raylane::scenes::pov {

namespace {

using core::Ends, core::Made, core::Solid, core::Vec3d;

Look look_of(const Object& object, const Look& inherited, const Shared<Motion>& above) {
    Look look = inherited;
    if (object.texture != nullptr) {
        look.texture = object.texture;
        look.above = above;
    }
    if (object.interior != nullptr) look.interior = object.interior;
    look.is_hollow = inherited.is_hollow || object.is_hollow;
    return look;
}

bool has_inside(const Object& object) {
    return object.kind != ObjectKind::shape ||
           std::visit(
               []<class Shape>(const Shape&) { return core::has_inside<core::InFloat<Shape>>; },
               object.shape);
}

const core::PlaneOf<double>* plane_of(const core::PartShape& shape) {
    return std::get_if<core::PlaneOf<double>>(&shape);
}

/// Returns true for an inverse object other than a plane: only planes can be described inside out.
bool is_inside_out(const Object& object) {
    return object.inverse &&
           (object.kind != ObjectKind::shape || plane_of(object.shape) == nullptr);
}

/// Returns the solid between an open cylinder's or cone's ends, without faces at the ends.
Solid between_ends(const core::PartShape& shape, const Vec3d& base, const Vec3d& axis) {
    Solid solid{Made::by_clip};
    solid.parts.resize(3);
    solid.parts[0].shape = shape;
    solid.parts[1].shape = core::PlaneOf<double>{base, -axis};
    solid.parts[2].shape = core::PlaneOf<double>{base + axis, axis};
    return solid;
}

/// Returns the object's shape as a part of a solid. As in POV-Ray, an open cylinder that is a part
/// of another object also stops at its ends.
Solid part_of(const Object& object) {
    return std::visit(
        [&]<class Shape>(const Shape& shape) -> Solid {
            Solid solid;
            solid.shape = shape;
            constexpr core::Kind kind = core::kind_of<Shape>;
            if constexpr (kind == core::Kind::open_cylinder || kind == core::Kind::open_cone) {
                return between_ends(shape, shape.base, shape.axis);
            } else if constexpr (kind == core::Kind::plane) {
                if (object.inverse) solid.shape = core::PlaneOf<double>{shape.point, -shape.normal};
                return solid;
            } else if constexpr (core::has_inside<core::InFloat<Shape>>) {
                return solid;
            } else {
                fail(object.place,
                     "must have an inside to be a part of another object or to be clipped, got a " +
                         std::string(core::name_of(kind)) + ", which has none");
            }
        },
        object.shape);
}

/// POV-Ray renders nothing farther than 1e7 from a ray's origin.
constexpr float far_away = 0x1p24F;
const core::Bounds farthest{core::Vec3f(-far_away), core::Vec3f(far_away)};

/// Returns a quadric as a part of others, in a box that bounds it without cutting it.
Solid as_far_as_seen(Solid quadric) {
    constexpr double size = 2.0 * static_cast<double>(far_away);
    Solid box;
    box.shape = core::BoxOf<double>{
        Vec3d(-0.5 * size), {size, 0.0, 0.0}, {0.0, size, 0.0}, {0.0, 0.0, size}};
    box.cuts_nothing = true;
    Solid result{Made::by_clip};
    result.parts = {std::move(quadric), std::move(box)};
    return result;
}

/// Negates z. Zeros stay positive.
template <class Shape>
void turn_z(Shape& shape) {
    if constexpr (requires { shape.center; }) shape.center.z = 0.0 - shape.center.z;
    if constexpr (requires { shape.base; }) {
        shape.base.z = 0.0 - shape.base.z;
        shape.axis.z = 0.0 - shape.axis.z;
    }
}

} // namespace

void Assembly::set_mirrored() {
    Motion motion{core::Transform::scaling({1.0, 1.0, -1.0})};
    motion.rows[2][2] = -1.0;
    motion.translation.reset();
    mirror_ = std::make_shared<const Motion>(std::move(motion));
}

Solid Assembly::moved(const Object& object, const Solid& solid,
                      const Shared<Motion>& motion) const {
    if (motion == nullptr) return solid;
    if (motion == mirror_ && solid.made == Made::of_shape) { // the most frequent case
        Solid result = solid;
        const bool is_simple = std::visit(
            []<class Shape>(Shape& shape) {
                constexpr core::Kind kind = core::kind_of<Shape>;
                constexpr bool simple =
                    kind == core::Kind::sphere || kind == core::Kind::open_cylinder ||
                    kind == core::Kind::capped_cylinder || kind == core::Kind::open_cone ||
                    kind == core::Kind::capped_cone;
                if constexpr (simple) turn_z(shape);
                return simple;
            },
            result.shape);
        if (is_simple) return result;
    }
    try {
        return motion->exact(solid);
    } catch (const core::InvalidValue& invalid) {
        fail(object.place, invalid.what());
    }
}

void Assembly::put(const Object& object, const Solid& solid, core::MaterialIndex material) {
    try {
        if (solid.made != Made::of_shape)
            builder_.add_solid(solid, material);
        else
            std::visit([&](const auto& shape) { builder_.add(shape, material); }, solid.shape);
    } catch (const core::InvalidValue& invalid) {
        fail(object.place, invalid.what());
    }
}

void Assembly::add_mesh(const Object& object, const Look& look, const Shared<Motion>& motion) {
    core::MaterialIndex own = core::no_material;
    std::vector<core::MaterialIndex> materials_of(object.mesh->textures.size(), core::no_material);
    for (const MeshTriangle& triangle : object.mesh->triangles) {
        core::MaterialIndex& material =
            triangle.texture < 0 ? own : materials_of[static_cast<std::size_t>(triangle.texture)];
        if (material == core::no_material) {
            Look its = look;
            if (triangle.texture >= 0) {
                its.texture = object.mesh->textures[static_cast<std::size_t>(triangle.texture)];
                its.above = motion;
            }
            material = materials.index_of(its, object.place);
        }
        Solid solid;
        solid.shape = triangle.shape;
        put(object, moved(object, solid, motion), material);
    }
}

void Assembly::add_shape(const Object& object, const core::PartShape& shape, const Look& look,
                         const Shared<Motion>& motion) {
    Solid solid;
    solid.shape = shape;
    solid = moved(object, solid, motion);
    if (auto* quadric = std::get_if<core::QuadricOf<double>>(&solid.shape)) {
        const core::Bounds own = core::bounds_of_common(std::array{core::HalfSpace{*quadric}});
        *quadric = core::within(*quadric, core::is_finite(own) ? own : farthest);
    }
    const auto* plane = solid.made == Made::of_shape ? plane_of(solid.shape) : nullptr;
    put(object, solid, materials.index_of(look, object.place, plane));
}

/// Adds a quadric as one shape if its only clip is a box that moves with it. Otherwise returns
/// false.
bool Assembly::add_quadric(const Object& object, const Look& look, const Shared<Motion>& motion,
                           const Clips& clips) {
    const auto* form = std::get_if<core::QuadricOf<double>>(&object.shape);
    if (form == nullptr || clips.size() != 1 || clips[0].above != motion ||
        (motion != nullptr && !motion->translation))
        return false;
    const Object& by = *clips[0].by;
    const auto* box = std::get_if<core::BoxOf<double>>(&by.shape);
    if (box == nullptr || by.kind != ObjectKind::shape || by.motion != nullptr || by.inverse ||
        !by.clips.empty())
        return false;
    core::QuadricOf<double> quadric = *form;
    if (motion != nullptr) quadric.center = *motion->translation;
    quadric.lower = box->corner;
    quadric.upper = box->corner + box->edge_u + box->edge_v + box->edge_w;
    Solid solid;
    solid.shape = quadric;
    put(object, solid, materials.index_of(look, object.place));
    return true;
}

void Assembly::add(const Object& object, const Look& inherited, const Shared<Motion>& above,
                   Clips clips) {
    if (object.is_hidden || object.count == 0) return;
    const Look look = look_of(object, inherited, above);
    const Shared<Motion> motion = both(object.motion, above);
    for (const Shared<Object>& clip : object.clips)
        clips.push_back({clip, motion});
    switch (object.kind) {
    case ObjectKind::all_in_one:
        for (const Shared<Object>& part : object.parts)
            add(*part, look, motion, clips);
        return;
    case ObjectKind::mesh:
        if (!clips.empty())
            fail(object.place, "must not be clipped, because meshes have no inside");
        add_mesh(object, look, motion);
        return;
    case ObjectKind::shape:
        note_fog(object, look);
        if (clips.empty()) return add_shape(object, object.shape, look, motion);
        if (add_quadric(object, look, motion, clips)) return;
        break;
    case ObjectKind::light:
    case ObjectKind::merge:
    case ObjectKind::intersection:
    case ObjectKind::difference:
        note_fog(object, look);
        break;
    }
    Solid solid = clipped(made_of(object, look, motion), clips);
    solid.material = materials.index_of(look, object.place);
    put(object, solid, core::no_material);
}

/// Notes the first transparent object in which fog differs from POV-Ray's: in raylane, fog fills
/// objects without an index of refraction.
void Assembly::note_fog(const Object& object, const Look& look) {
    if (look.texture == nullptr || fog_differs_at) return;
    const auto& color = look.texture->pigment.color.at;
    const bool bends = look.interior != nullptr && look.interior->has_index;
    if (color[3] + color[4] > 0.0 && bends == look.is_hollow && has_inside(object))
        fog_differs_at = object.place;
}

/// Adds the lights in an object of any kind: lights are never hidden, clipped or subtracted.
void Assembly::add_lights(const Object& object, const Shared<Motion>& above) {
    if (object.lights == 0) return;
    const Shared<Motion> motion = both(object.motion, above);
    if (object.light != nullptr) lights.push_back(object.light->moved(motion));
    for (const Shared<Object>& part : object.parts)
        add_lights(*part, motion);
}

/// Returns the solid of an object, without its clips.
Solid Assembly::made_of(const Object& object, const Look& look, const Shared<Motion>& motion) {
    if (object.kind == ObjectKind::shape) {
        Solid solid = moved(object, part_of(object), motion);
        return std::holds_alternative<core::QuadricOf<double>>(object.shape)
                   ? as_far_as_seen(std::move(solid))
                   : solid;
    }
    if (object.kind == ObjectKind::mesh)
        fail(object.place,
             "must have an inside to be a part of another object, got a mesh, which has none");
    Solid joined{Made::by_union}, less{Made::by_difference};
    if (object.kind == ObjectKind::intersection || object.kind == ObjectKind::difference)
        joined.made = Made::by_intersection;
    bool is_first = true;
    for (const Shared<Object>& part : object.parts) {
        if (part->count == 0) continue;
        const bool is_taken = object.kind == ObjectKind::difference && !is_first;
        const bool is_kept = is_taken == is_inside_out(*part);
        if (!is_kept && joined.made == Made::by_union)
            fail(part->place, "must not be inverse in a union, because its outside is unbounded");
        (is_kept ? joined : less).parts.push_back(described(*part, look, motion, false));
        is_first = false;
    }
    if (joined.parts.empty())
        fail(object.place, "must have an object that is not inverse and not subtracted");
    if (less.parts.empty()) return joined;
    less.parts.insert(less.parts.begin(),
                      joined.parts.size() == 1 ? std::move(joined.parts[0]) : std::move(joined));
    return less;
}

Solid Assembly::described(const Object& object, const Look& inherited, const Shared<Motion>& above,
                          bool is_clip) {
    const Look look = look_of(object, inherited, above);
    const Shared<Motion> motion = both(object.motion, above);
    Clips clips;
    for (const Shared<Object>& clip : object.clips)
        clips.push_back({clip, motion});
    Solid solid = clipped(made_of(object, look, motion), clips);
    if (!is_clip && (object.texture != nullptr || object.interior != nullptr))
        solid.material = materials.index_of(look, object.place);
    return solid;
}

Solid Assembly::clipped(Solid solid, const Clips& clips) {
    if (clips.empty()) return solid;
    Solid result{Made::by_clip};
    result.parts.push_back(std::move(solid));
    for (const Clip& clip : clips) {
        if (is_inside_out(*clip.by))
            fail(clip.by->place, "must not be inverse if it clips, unless it is a plane");
        result.parts.push_back(described(*clip.by, {}, clip.above, true));
    }
    return result;
}

} // namespace raylane::scenes::pov
