#include "scenes/json/object.hpp"

#include "scenes/generators.hpp"

#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

using core::Ends;

/// Reads and adds one object.
class ObjectReader {
  public:
    ObjectReader(const JsonValue& object, core::SceneBuilder& builder,
                 const MaterialOf& material_of)
        : object_(object), builder_(builder), material_of_(material_of) {}
    /// Of a part of a solid, which is put there.
    ObjectReader(const JsonValue& object, core::SceneBuilder& builder,
                 const MaterialOf& material_of, core::Solid& part)
        : object_(object), builder_(builder), material_of_(material_of), part_(&part) {}

    void read(std::type_identity<core::Sphere>) {
        object_.allow_only({"type", "material", "center", "radius"});
        add(core::SphereOf<double>{vector("center"), number("radius")});
    }

    void read(std::type_identity<core::Plane>) {
        object_.allow_only({"type", "material", "point", "normal"});
        add(core::PlaneOf<double>{vector("point"), vector("normal")});
    }

    void read(std::type_identity<core::Disc>) {
        object_.allow_only({"type", "material", "center", "normal", "radius"});
        add(core::DiscOf<double>{vector("center"), vector("normal"), number("radius")});
    }

    void read(std::type_identity<core::Triangle>) {
        object_.allow_only({"type", "material", "a", "b", "c", "normals"});
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
        object_.allow_only({"type", "material", "base", "axis", "radius", "capped"});
        if (capped())
            add(cylinder_with<Ends::capped>());
        else
            add(cylinder_with<Ends::open>());
    }

    template <Ends ends>
    void read(std::type_identity<core::Cone<ends>>) {
        object_.allow_only(
            {"type", "material", "base", "axis", "base_radius", "top_radius", "capped"});
        if (capped())
            add(cone_with<Ends::capped>());
        else
            add(cone_with<Ends::open>());
    }

    void read(std::type_identity<core::Quadric>);

    void read(std::type_identity<core::Ellipsoid>) {
        object_.allow_only({"type", "material", "center", "axes"});
        const core::Vec3d center = vector("center");
        const std::vector<JsonValue> axes = object_.at("axes").array(3, "vectors");
        add(core::EllipsoidOf<double>{center, axes[0].real_vector(), axes[1].real_vector(),
                                      axes[2].real_vector()});
    }

    void made(core::Made by);

    void sphereflake() {
        refuse_as_part();
        object_.allow_only({"type", "material", "center", "radius", "depth", "up"});
        Sphereflake flake{.center = object_.at("center").vector(),
                          .radius = object_.at("radius").number(),
                          .depth = integer("depth")};
        if (const auto up = object_.find("up")) flake.up = up->vector();
        const core::MaterialIndex own = material();
        checked(object_, [&] { scenes::add(builder_, flake, own); });
    }

    void lattice();

    /// Has an object read by what its type says.
    static void read(const JsonValue& object, ObjectReader& reader);

  private:
    core::Vec3d vector(std::string_view key) const { return object_.at(key).real_vector(); }
    double number(std::string_view key) const { return object_.at(key).real(); }
    int integer(std::string_view key) const { return object_.at(key).integer(); }
    bool capped() const {
        const auto value = object_.find("capped");
        return !value || value->boolean();
    }
    core::MaterialIndex material() const { return material_of_(object_.at("material")); }

    template <class Shape>
    void add(const Shape& shape) {
        if (part_ != nullptr) {
            *part_ = {.shape = shape, .material = material_of_part()};
            return;
        }
        const core::MaterialIndex own = material();
        checked(object_, [&] { builder_.add(shape, own); });
    }

    /// Its own, or none: that of the whole.
    core::MaterialIndex material_of_part() const {
        const auto own = object_.find("material");
        return own ? material_of_(*own) : core::no_material;
    }
    void refuse_as_part() const {
        if (part_ != nullptr)
            object_.at("type").fail("must be of one solid, a plane or a quadric, got \"" +
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
    core::SceneBuilder& builder_;
    const MaterialOf& material_of_;
    core::Solid* part_ = nullptr;
};

void ObjectReader::read(std::type_identity<core::Box>) {
    object_.allow_only({"type", "material", "corner", "edges", "min", "max"});
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
    const core::Vec3d size = upper - lower;
    const core::BoxOf<double> box{
        lower, {size.x, 0.0, 0.0}, {0.0, size.y, 0.0}, {0.0, 0.0, size.z}};
    if (part_ != nullptr) return add(box);
    const core::MaterialIndex own = material();
    checked(object_, [&] {
        try {
            builder_.add(box, own);
        } catch (const core::InvalidValue& invalid) {
            const bool corner = invalid.field.starts_with("corner");
            throw core::InvalidValue(corner ? "min" : "max", invalid.expectation);
        }
    });
}

void ObjectReader::read(std::type_identity<core::Quadric>) {
    object_.allow_only({"type", "material", "center", "matrix", "lower", "upper"});
    double matrix[4][4];
    const std::vector<JsonValue> rows = object_.at("matrix").array(4, "rows");
    for (int row = 0; row < 4; ++row) {
        const std::vector<JsonValue> values = rows[row].array(4, "numbers");
        for (int column = 0; column < 4; ++column) {
            matrix[row][column] = values[column].real();
            if (column < row && matrix[row][column] != matrix[column][row])
                values[column].fail_expecting("equal to matrix/" + std::to_string(column) + "/" +
                                              std::to_string(row) +
                                              ", for the matrix is symmetric");
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
    if (part_ == nullptr) {
        quadric.lower = vector("lower");
        quadric.upper = vector("upper");
    } else {
        for (const std::string_view key : {"lower", "upper"})
            if (const auto end = object_.find(key))
                end->fail("must not be given in a solid, where a quadric is the half-space of its "
                          "inside: intersect it with a box");
    }
    add(quadric);
}

void ObjectReader::made(core::Made by) {
    object_.allow_only({"type", "material", "objects"});
    core::Solid solid{.made = by, .material = material_of_part()};
    const std::vector<JsonValue> objects = object_.at("objects").array("objects");
    solid.parts.resize(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ObjectReader reader(objects[i], builder_, material_of_, solid.parts[i]);
        read(objects[i], reader);
    }
    if (part_ != nullptr) {
        *part_ = std::move(solid);
        return;
    }
    checked(object_, [&] { builder_.add_solid(solid, core::no_material); });
}

void ObjectReader::lattice() {
    refuse_as_part();
    object_.allow_only({"type", "material", "strut_material", "corner", "center", "n", "spacing",
                        "sphere_radius", "strut_radius"});
    object_.exclude("corner", "center");
    Lattice lattice{.corner = core::Vec3d(0.0),
                    .n = integer("n"),
                    .spacing = object_.at("spacing").number(),
                    .sphere_radius = object_.at("sphere_radius").number(),
                    .strut_radius = object_.at("strut_radius").number()};
    if (const auto center = object_.find("center"))
        lattice.corner =
            core::convert<double>(center->vector()) -
            core::Vec3d(0.5 * (lattice.n - 1.0) * static_cast<double>(lattice.spacing));
    else
        lattice.corner = core::convert<double>(object_.at("corner").vector());
    const auto struts = object_.find("strut_material");
    const core::MaterialIndex own = material();
    const core::MaterialIndex strut_material = struts ? material_of_(*struts) : own;
    checked(object_, [&] { scenes::add(builder_, lattice, own, strut_material); });
}

using Read = void (*)(ObjectReader&);

/// Readers by JSON's "type".
const std::vector<std::pair<std::string_view, Read>>& readers() {
    static const auto all = [] {
        std::vector<std::pair<std::string_view, Read>> readers;
        core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            const std::string_view name = core::type_name_of(core::kind_of<Shape>);
            // Of kinds that share a name, the first looks which it is.
            if (readers.empty() || readers.back().first != name)
                readers.push_back(
                    {name, [](ObjectReader& of) { of.read(std::type_identity<Shape>()); }});
        });
        readers.emplace_back("sphereflake", [](ObjectReader& of) { of.sphereflake(); });
        readers.emplace_back("lattice", [](ObjectReader& of) { of.lattice(); });
        readers.emplace_back("union", [](ObjectReader& of) { of.made(core::Made::by_union); });
        readers.emplace_back("intersection",
                             [](ObjectReader& of) { of.made(core::Made::by_intersection); });
        readers.emplace_back("difference",
                             [](ObjectReader& of) { of.made(core::Made::by_difference); });
        readers.emplace_back("clip", [](ObjectReader& of) { of.made(core::Made::by_clip); });
        return readers;
    }();
    return all;
}

void ObjectReader::read(const JsonValue& object, ObjectReader& reader) {
    object.at("type").choice(JsonValue::Choices<Read>(readers()))(reader);
}

} // namespace

void add_object(const JsonValue& object, core::SceneBuilder& builder,
                const MaterialOf& material_of) {
    ObjectReader reader(object, builder, material_of);
    ObjectReader::read(object, reader);
}

} // namespace raylane::scenes
