#include "scenes/formats/json/object.hpp"

#include "core/scene/generators.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/group.hpp"
#include "core/solids/lens.hpp"
#include "core/solids/object_space.hpp"
#include "scenes/formats/json/transform.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

using core::Ends;

using core::Made, core::Solid;

/// The purpose that an object is read for.
enum class Use {
    object, ///< added to the scene
    member, ///< by itself, in a group or a definition
    part,   ///< a part of a solid
};

/// The most shapes that instances add to one object, and to all definitions together, which are
/// kept.
constexpr std::size_t max_parts = std::size_t{1} << 20;
constexpr int max_depth = 256;

/// Describes objects within one object of the file.
class SolidReader {
  public:
    /// `parts`: shapes of instances that already count.
    explicit SolidReader(const ObjectContext& given, std::size_t parts = 0)
        : context(given), parts_(parts) {}

    std::vector<Solid> described(const JsonValue& object, Use use);
    std::size_t parts() const { return parts_; }

    const ObjectContext& context;

  private:
    std::vector<Solid> instance_of(const JsonValue& object, Use use);

    std::size_t parts_; // shapes of instances
};

/// Reads one object, and adds it or describes it.
class ObjectReader {
  public:
    /// Reads an object that is added.
    ObjectReader(const JsonValue& object, core::SceneBuilder& builder, const ObjectContext& context)
        : object_(object), builder_(&builder), context_(context), use_(Use::object) {}
    /// Reads an object that is described.
    ObjectReader(const JsonValue& object, SolidReader& describer, Use use, Solid& described)
        : object_(object), context_(describer.context), describer_(&describer), use_(use),
          described_(&described) {}

    void read(std::type_identity<core::Sphere>) {
        allow({"type", "material", "center", "radius"});
        add(core::SphereOf<double>{vector("center"), number("radius")});
    }

    void read(std::type_identity<core::Plane>) {
        allow({"type", "material", "point", "normal"});
        add(core::PlaneOf<double>{vector("point"), vector("normal")});
    }

    void read(std::type_identity<core::Disc>) {
        allow({"type", "material", "center", "normal", "radius"});
        add(core::DiscOf<double>{vector("center"), vector("normal"), number("radius")});
    }

    void read(std::type_identity<core::Triangle>) {
        allow({"type", "material", "a", "b", "c", "normals"});
        const core::TriangleOf<double> flat{vector("a"), vector("b"), vector("c")};
        if (!object_.find("normals")) {
            add(flat);
            return;
        }
        const std::vector<JsonValue> normals = object_.at("normals").array(3, "vectors");
        add(core::SmoothTriangleOf<double>{flat.a, flat.b, flat.c, normals[0].real_vector(),
                                           normals[1].real_vector(), normals[2].real_vector()});
    }

    void read(std::type_identity<core::SmoothTriangle>) {
        read(std::type_identity<core::Triangle>());
    }

    void read(std::type_identity<core::Box>);

    template <Ends ends>
    void read(std::type_identity<core::Cylinder<ends>>) {
        allow({"type", "material", "base", "axis", "radius", "capped"});
        if (capped())
            add(cylinder_with<Ends::capped>());
        else
            add(cylinder_with<Ends::open>());
    }

    template <Ends ends>
    void read(std::type_identity<core::Cone<ends>>) {
        allow({"type", "material", "base", "axis", "base_radius", "top_radius", "capped"});
        if (capped())
            add(cone_with<Ends::capped>());
        else
            add(cone_with<Ends::open>());
    }

    void read(std::type_identity<core::Quadric>);

    void read(std::type_identity<core::Ellipsoid>) {
        allow({"type", "material", "center", "axes"});
        const core::Vec3d center = vector("center");
        const std::vector<JsonValue> axes = object_.at("axes").array(3, "vectors");
        add(core::EllipsoidOf<double>{center, axes[0].real_vector(), axes[1].real_vector(),
                                      axes[2].real_vector()});
    }

    void made(Made by);
    void lens();
    void several();
    void copies();

    void sphereflake() {
        refuse_unless_added();
        object_.allow_only({"type", "material", "center", "radius", "depth", "up"});
        core::Sphereflake flake{.center = object_.at("center").vector(),
                                .radius = object_.at("radius").number(),
                                .depth = integer("depth")};
        if (const auto up = object_.find("up")) flake.up = up->vector();
        const core::MaterialIndex own = material();
        checked(object_, [&] {
            context_.definitions.count(count_of(flake), object_);
            core::add(*builder_, flake, own);
        });
    }

    void lattice();

    /// Calls the reader function of the object's type.
    static void read(const JsonValue& object, ObjectReader& reader);

  private:
    core::Vec3d vector(std::string_view key) const { return object_.at(key).real_vector(); }
    double number(std::string_view key) const { return object_.at(key).real(); }
    int integer(std::string_view key) const { return object_.at(key).integer(); }
    bool capped() const {
        const auto value = object_.find("capped");
        return !value || value->boolean();
    }
    core::MaterialIndex material() const { return context_.material_of(object_.at("material")); }

    /// Throws if the object has keys other than these and the transform's.
    void allow(std::initializer_list<std::string_view> keys) const {
        std::array<std::string_view, 16> words;
        const auto end = std::copy(keys.begin(), keys.end(), words.begin());
        const auto last = std::copy(transform_keys.begin(), transform_keys.end(), end);
        object_.allow_only(std::span<const std::string_view>(words.begin(), last));
    }

    template <class Shape>
    void add(const Shape& shape) {
        if (described_ != nullptr) {
            // Validates here, where the place in the file is known. Skips quadrics that are parts
            // of solids: the reader has already refused bounds for them.
            checked(object_, [&] {
                if (use_ != Use::part || !std::is_same_v<Shape, core::QuadricOf<double>>)
                    validate(shape);
            });
            *described_ = {.shape = shape, .material = material_if_any()};
            return;
        }
        const core::MaterialIndex own = material();
        checked(object_, [&] { builder_->add(shape, own); });
    }

    /// Returns the object's own material, or no_material if it takes that of the whole.
    core::MaterialIndex material_if_any() const {
        const auto own = object_.find("material");
        return own ? context_.material_of(*own) : core::no_material;
    }
    void refuse_unless_added() const {
        if (described_ != nullptr)
            object_.at("type").fail("must be a single shape here, got \"" +
                                    std::string(object_.at("type").string()) + "\"");
    }

    template <Ends ends>
    core::CylinderOf<double, ends> cylinder_with() const {
        return {vector("base"), vector("axis"), number("radius")};
    }

    template <Ends ends>
    core::ConeOf<double, ends> cone_with() const {
        const auto top_radius = object_.find("top_radius");
        return {vector("base"), vector("axis"), number("base_radius"),
                top_radius ? top_radius->real() : 0.0};
    }

    const JsonValue& object_;
    core::SceneBuilder* builder_ = nullptr;
    const ObjectContext& context_;
    SolidReader* describer_ = nullptr;
    Use use_;
    Solid* described_ = nullptr;
};

void ObjectReader::read(std::type_identity<core::Box>) {
    allow({"type", "material", "corner", "edges", "min", "max"});
    if (!object_.find("min") && !object_.find("max")) {
        const core::Vec3d corner = vector("corner");
        const std::vector<JsonValue> edges = object_.at("edges").array(3, "vectors");
        add(core::BoxOf<double>{corner, edges[0].real_vector(), edges[1].real_vector(),
                                edges[2].real_vector()});
        return;
    }
    for (const std::string_view key : {"corner", "edges"})
        for (const std::string_view other : {"min", "max"})
            object_.exclude(key, other);
    const core::Vec3d lower = vector("min"), upper = vector("max");
    for (int axis = 0; axis < 3; ++axis)
        if (!(lower[axis] < upper[axis]))
            object_.at("max").array(3, "numbers")[axis].fail_expecting(
                "more than min's " + object_.at("min").array(3, "numbers")[axis].quoted());
    const core::BoxOf<double> box = core::aligned_box(lower, upper - lower);
    if (described_ != nullptr) return add(box);
    const core::MaterialIndex own = material();
    checked(object_, [&] {
        try {
            builder_->add(box, own);
        } catch (const core::InvalidValue& invalid) {
            const bool corner = invalid.field.starts_with("corner");
            throw core::InvalidValue(corner ? "min" : "max", invalid.expectation);
        }
    });
}

void ObjectReader::read(std::type_identity<core::Quadric>) {
    allow({"type", "material", "center", "matrix", "lower", "upper"});
    double matrix[4][4];
    const std::vector<JsonValue> rows = object_.at("matrix").array(4, "rows");
    for (int row = 0; row < 4; ++row) {
        const std::vector<JsonValue> values = rows[row].array(4, "numbers");
        for (int column = 0; column < 4; ++column) {
            matrix[row][column] = values[column].real();
            if (column < row && matrix[row][column] != matrix[column][row])
                values[column].fail_expecting("equal to matrix/" + std::to_string(column) + "/" +
                                              std::to_string(row) +
                                              ", because the matrix is symmetric");
        }
    }
    core::QuadricOf<double> quadric{};
    if (const auto center = object_.find("center")) quadric.center = center->real_vector();
    quadric.xx = matrix[0][0];
    quadric.yy = matrix[1][1];
    quadric.zz = matrix[2][2];
    quadric.xy = matrix[0][1];
    quadric.xz = matrix[0][2];
    quadric.yz = matrix[1][2];
    quadric.x = matrix[0][3];
    quadric.y = matrix[1][3];
    quadric.z = matrix[2][3];
    quadric.one = matrix[3][3];
    if (use_ != Use::part) {
        quadric.lower = vector("lower");
        quadric.upper = vector("upper");
    } else {
        for (const std::string_view key : {"lower", "upper"})
            if (const auto end = object_.find(key))
                end->fail("must not be given in a solid, where a quadric is unbounded: intersect "
                          "it with a box");
    }
    add(quadric);
}

void ObjectReader::made(Made by) {
    allow({"type", "material", "objects"});
    Solid solid{.made = by, .material = material_if_any()};
    SolidReader own(context_);
    SolidReader& describer = describer_ != nullptr ? *describer_ : own;
    for (const JsonValue& object : object_.at("objects").array("objects")) {
        // A group is the union of its objects.
        solid.parts.push_back(core::union_of(describer.described(object, Use::part)));
    }
    if (described_ != nullptr)
        *described_ = std::move(solid);
    else
        checked(object_, [&] { builder_->add_solid(solid, core::no_material); });
}

void ObjectReader::lens() {
    allow({"type", "material", "vertex", "axis", "radii", "conics", "thickness", "radius"});
    core::Lens lens;
    if (const auto vertex = object_.find("vertex")) lens.vertex = vertex->real_vector();
    if (const auto axis = object_.find("axis")) lens.axis = axis->real_vector();
    for (const auto& [key, numbers] :
         {std::pair{"radii", &lens.radii}, std::pair{"conics", &lens.conics}}) {
        const auto found = object_.find(key);
        if (!found && numbers == &lens.conics) continue;
        const std::vector<JsonValue> values = object_.at(key).array(2, "numbers");
        *numbers = {values[0].real(), values[1].real()};
    }
    lens.thickness = number("thickness");
    lens.radius = number("radius");
    Solid solid = checked(object_, [&] { return core::solid_of(lens); });
    if (described_ != nullptr) {
        solid.material = material_if_any();
        *described_ = std::move(solid);
        return;
    }
    const core::MaterialIndex own = material();
    checked(object_, [&] { builder_->add_solid(solid, own); });
}

/// Reads the place of one copy.
core::Placement placement_of(const JsonValue& value) {
    value.allow_only({"scale", "rotate", "translate"});
    core::Placement placement;
    if (const auto scale = value.find("scale")) placement.scale = scale->real();
    if (const auto rotate = value.find("rotate")) placement.rotate = rotate->real_vector();
    if (const auto translate = value.find("translate"))
        placement.translate = translate->real_vector();
    checked(value, [&] { core::validate(placement); });
    return placement;
}

/// Adds copies of a definition.
void ObjectReader::copies() {
    object_.allow_only({"type", "material", "of", "placements"});
    const Definition& definition = context_.definitions.named_by(object_.at("of"));
    std::vector<Solid> members = definition.solids;
    for (Solid& member : members) {
        if (member.material == core::no_material) member.material = material_if_any();
        if (member.material == core::no_material && member.made == Made::of_shape)
            static_cast<void>(object_.at("material")); // throws, as it is missing
    }
    std::vector<core::Placement> placements;
    for (const JsonValue& value : object_.at("placements").array("placements"))
        placements.push_back(placement_of(value));
    const bool are_kept = builder_->keeps_copies(members, placements);
    context_.definitions.count(are_kept ? definition.parts + placements.size()
                                        : definition.parts * placements.size(),
                               object_);
    checked(object_, [&] { builder_->add_copies(members, std::move(placements)); });
}

/// Adds the shapes of a group, an instance or a transformed object.
void ObjectReader::several() {
    if (object_.find("placements") && object_.at("type").string() == "instance") return copies();
    for (const Solid& solid : SolidReader(context_).described(object_, Use::member)) {
        if (solid.material == core::no_material && solid.made == Made::of_shape)
            static_cast<void>(object_.at("material")); // throws, as it is missing
        checked(object_, [&] { builder_->add_member(solid); });
    }
}

void ObjectReader::lattice() {
    refuse_unless_added();
    object_.allow_only({"type", "material", "strut_material", "corner", "center", "n", "spacing",
                        "sphere_radius", "strut_radius"});
    object_.exclude("corner", "center");
    core::Lattice lattice{.corner = core::Vec3d(0.0),
                          .n = integer("n"),
                          .spacing = object_.at("spacing").number(),
                          .sphere_radius = object_.at("sphere_radius").number(),
                          .strut_radius = object_.at("strut_radius").number()};
    if (const auto center = object_.find("center"))
        lattice.corner = core::corner_around(core::convert<double>(center->vector()), lattice.n,
                                             lattice.spacing);
    else
        lattice.corner = core::convert<double>(object_.at("corner").vector());
    const auto struts = object_.find("strut_material");
    const core::MaterialIndex own = material();
    const core::MaterialIndex strut_material = struts ? context_.material_of(*struts) : own;
    checked(object_, [&] {
        context_.definitions.count(count_of(lattice), object_);
        core::add(*builder_, lattice, own, strut_material);
    });
}

using Read = void (*)(ObjectReader&);

/// Returns the reader functions by JSON's "type".
const std::vector<std::pair<std::string_view, Read>>& readers() {
    static const auto known_types = [] {
        std::vector<std::pair<std::string_view, Read>> readers;
        core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            const std::string_view name = core::type_name_of(core::kind_of<Shape>);
            // Several kinds may share a name. The reader of the first kind distinguishes them.
            if (readers.empty() || readers.back().first != name)
                readers.push_back(
                    {name, [](ObjectReader& reader) { reader.read(std::type_identity<Shape>()); }});
        });
        readers.emplace_back("sphereflake", [](ObjectReader& reader) { reader.sphereflake(); });
        readers.emplace_back("lattice", [](ObjectReader& reader) { reader.lattice(); });
        readers.emplace_back("union", [](ObjectReader& reader) { reader.made(Made::by_union); });
        readers.emplace_back("intersection",
                             [](ObjectReader& reader) { reader.made(Made::by_intersection); });
        readers.emplace_back("difference",
                             [](ObjectReader& reader) { reader.made(Made::by_difference); });
        readers.emplace_back("clip", [](ObjectReader& reader) { reader.made(Made::by_clip); });
        readers.emplace_back("lens", [](ObjectReader& reader) { reader.lens(); });
        readers.emplace_back("group", [](ObjectReader& reader) { reader.several(); });
        readers.emplace_back("instance", [](ObjectReader& reader) { reader.several(); });
        return readers;
    }();
    return known_types;
}

void ObjectReader::read(const JsonValue& object, ObjectReader& reader) {
    object.at("type").choice(JsonValue::Choices<Read>(readers()))(reader);
}

std::vector<Solid> SolidReader::instance_of(const JsonValue& object, Use use) {
    const JsonValue name = object.at("of");
    const Definition& definition = context.definitions.named_by(name);
    parts_ += definition.parts;
    if (parts_ > max_parts)
        name.fail("must not expand to more than " + std::to_string(max_parts) +
                  " shapes in one object, or in all definitions");
    context.definitions.count(definition.parts, name);
    std::vector<Solid> solids = definition.solids;
    for (Solid& solid : solids)
        if (use == Use::part) solid = core::member_as_part(std::move(solid));
    return solids;
}

/// Returns all solids of an object, transformed by its keys, with the materials that it gives.
std::vector<Solid> SolidReader::described(const JsonValue& object, Use use) {
    std::vector<std::string_view> keys = {"type", "material"};
    keys.insert(keys.end(), transform_keys.begin(), transform_keys.end());
    const std::string_view type = object.at("type").string();
    std::vector<Solid> members;
    if (type == "group") {
        keys.emplace_back("objects");
        object.allow_only(keys);
        for (const JsonValue& member : object.at("objects").array("objects"))
            for (Solid& solid : described(member, use))
                members.push_back(std::move(solid));
    } else if (type == "instance") {
        keys.emplace_back("of");
        keys.emplace_back("placements");
        object.allow_only(keys);
        if (const auto placements = object.find("placements"))
            placements->fail("goes with an instance that is an object of the scene itself");
        members = instance_of(object, use);
    } else {
        ObjectReader reader(object, *this, use, members.emplace_back());
        ObjectReader::read(object, reader);
    }
    if (has_transform(object)) {
        const core::Transform transform = transform_of(object);
        std::optional<core::SpaceMover> move_space; // few objects need it
        for (Solid& solid : members) {
            solid = checked(object, [&] {
                return use == Use::part ? transform(solid)
                                        : core::transformed_member(std::move(solid), transform);
            });
            if (!context.builder.may_follow(solid)) continue;
            if (!move_space) move_space.emplace(transform);
            (*move_space)(solid);
        }
    }
    if (const auto material = object.find("material");
        material && (type == "group" || type == "instance"))
        for (Solid& solid : members)
            if (solid.material == core::no_material)
                solid.material = context.material_of(*material);
    return members;
}

} // namespace

const Definition& Definitions::named_by(const JsonValue& value) {
    const std::string_view name = value.string();
    const auto found = all_.find(name);
    if (found == all_.end()) {
        if (may_lack_some || !unknown_.emplace(name).second) throw consequence();
        value.fail_expecting("the name of an earlier definition");
    }
    if (!found->second) throw consequence();
    return *found->second;
}

void Definitions::count(std::size_t shapes, const JsonValue& value) {
    asked_for_ += shapes;
    if (asked_for_ > max_requested)
        value.fail("must not expand to more than " + std::to_string(max_requested) +
                   " shapes of instances, lattices and sphereflakes in one scene");
}

void add_object(const JsonValue& object, core::SceneBuilder& builder,
                const ObjectContext& context) {
    ObjectReader reader(object, builder, context);
    if (has_transform(object))
        reader.several();
    else
        ObjectReader::read(object, reader);
}

Definition described_object(const JsonValue& object, const ObjectContext& context) {
    SolidReader describer(context, context.definitions.kept_parts);
    Definition definition{describer.described(object, Use::member), 0};
    context.definitions.kept_parts = describer.parts();
    for (const Solid& solid : definition.solids) {
        definition.parts += core::count_parts(solid);
        if (core::depth_of(solid) > max_depth)
            object.fail("must not have solids nested more than " + std::to_string(max_depth) +
                        " deep");
    }
    return definition;
}

} // namespace raylane::scenes
