#include "scenes/pov/objects.hpp"

#include "scenes/pov/expressions.hpp"
#include "scenes/pov/finishes.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes::pov {

namespace {

using core::Ends, core::Vec3d;

core::PartShape read_sphere(Tokens& tokens) {
    core::SphereOf<double> sphere{};
    sphere.center = read_vector(tokens);
    skip_comma(tokens);
    sphere.radius = read_number(tokens);
    return sphere;
}

core::PartShape read_box(Tokens& tokens) {
    const Vec3d a = read_vector(tokens);
    skip_comma(tokens);
    const Vec3d b = read_vector(tokens);
    Vec3d lower, size;
    for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(a[axis], b[axis]);
        size[axis] = std::max(a[axis], b[axis]) - lower[axis];
    }
    return core::BoxOf<double>{lower, {size.x, 0.0, 0.0}, {0.0, size.y, 0.0}, {0.0, 0.0, size.z}};
}

core::PartShape read_cylinder(Tokens& tokens) {
    const Vec3d base = read_vector(tokens);
    skip_comma(tokens);
    const Vec3d axis = read_vector(tokens) - base;
    skip_comma(tokens);
    const double radius = read_number(tokens);
    if (tokens.accept("open")) return core::CylinderOf<double, Ends::open>{base, axis, radius};
    return core::CylinderOf<double, Ends::capped>{base, axis, radius};
}

core::PartShape read_cone(Tokens& tokens) {
    const Vec3d base = read_vector(tokens);
    skip_comma(tokens);
    const double base_radius = read_number(tokens);
    skip_comma(tokens);
    const Vec3d axis = read_vector(tokens) - base;
    skip_comma(tokens);
    const double top_radius = read_number(tokens);
    if (tokens.accept("open"))
        return core::ConeOf<double, Ends::open>{base, axis, base_radius, top_radius};
    return core::ConeOf<double, Ends::capped>{base, axis, base_radius, top_radius};
}

core::PartShape read_plane(Tokens& tokens) {
    const Vec3d normal = read_vector(tokens);
    skip_comma(tokens);
    const double distance = read_number(tokens);
    const double size = core::length(normal);
    // No zero of it is negative.
    const Vec3d point = size > 0.0 ? distance / size * normal + Vec3d(0.0) : normal;
    return core::PlaneOf<double>{point, normal};
}

core::PartShape read_disc(Tokens& tokens) {
    const Place place = tokens.peek().place;
    core::DiscOf<double> disc{};
    disc.center = read_vector(tokens);
    skip_comma(tokens);
    disc.normal = read_vector(tokens);
    skip_comma(tokens);
    disc.radius = read_number(tokens);
    if (tokens.accept(",") && read_number(tokens) != 0.0)
        tokens.remark(place, "has a hole in a disc, which is not drawn");
    return disc;
}

core::PartShape read_triangle(Tokens& tokens) {
    core::TriangleOf<double> triangle{};
    for (Vec3d* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        *corner = read_vector(tokens);
        skip_comma(tokens);
    }
    return triangle;
}

core::PartShape read_smooth_triangle(Tokens& tokens) {
    core::SmoothTriangleOf<double> t{};
    for (Vec3d* v : {&t.a, &t.normal_a, &t.b, &t.normal_b, &t.c, &t.normal_c}) {
        *v = read_vector(tokens);
        skip_comma(tokens);
    }
    return t;
}

core::PartShape read_quadric(Tokens& tokens) {
    Vec3d rows[3];
    for (Vec3d& row : rows) {
        row = read_vector(tokens);
        skip_comma(tokens);
    }
    core::QuadricOf<double> q{};
    q.xx = rows[0].x;
    q.yy = rows[0].y;
    q.zz = rows[0].z;
    q.xy = 0.5 * rows[1].x;
    q.xz = 0.5 * rows[1].y;
    q.yz = 0.5 * rows[1].z;
    q.x = 0.5 * rows[2].x;
    q.y = 0.5 * rows[2].y;
    q.z = 0.5 * rows[2].z;
    q.one = read_number(tokens);
    q.lower = Vec3d(-1.0);
    q.upper = Vec3d(1.0);
    return q;
}

template <class Read>
struct Named {
    std::string_view name;
    Read read;
};
const Named<core::PartShape (*)(Tokens&)> shapes[] = {
    {"sphere", read_sphere},     {"cylinder", read_cylinder},
    {"cone", read_cone},         {"box", read_box},
    {"plane", read_plane},       {"disc", read_disc},
    {"triangle", read_triangle}, {"smooth_triangle", read_smooth_triangle},
    {"quadric", read_quadric}};
const Named<Shared<Mesh> (*)(Tokens&)> meshes[] = {
    {"mesh", read_mesh}, {"mesh2", read_mesh2}, {"polygon", read_polygon}};
const Named<ObjectKind> compounds[] = {{"union", ObjectKind::all_in_one},
                                       {"merge", ObjectKind::merge},
                                       {"intersection", ObjectKind::intersection},
                                       {"difference", ObjectKind::difference}};
constexpr std::string_view not_read[] = {"bicubic_patch",  "blob",          "cubic", "height_field",
                                         "isosurface",     "julia_fractal", "lathe", "light_group",
                                         "ovus",           "parametric",    "poly",  "polynomial",
                                         "prism",          "quartic",       "sor",   "sphere_sweep",
                                         "superellipsoid", "text",          "torus"};

template <class Table>
auto* entry(Table& table, const Token& token) {
    const auto found = std::find_if(std::begin(table), std::end(table),
                                    [&](const auto& entry) { return token.is(entry.name); });
    return found == std::end(table) ? nullptr : found;
}

const Shared<Object>* named_object(const Tokens& tokens, const Token& token) {
    const Value* value = token.kind == TokenKind::word ? tokens.find(token.text) : nullptr;
    if (value == nullptr) return nullptr;
    if (const auto* array = value->get_if<std::shared_ptr<Array>>())
        value = tokens.is_before("[") ? first_of(**array) : nullptr;
    return value != nullptr ? value->get_if<Shared<Object>>() : nullptr;
}

Shared<Object> read_named(Tokens& tokens) {
    const Token name = tokens.next();
    const Value* found = tokens.find(name.text);
    Value value = found != nullptr ? *found : Value{};
    if (value.get_if<std::shared_ptr<Array>>() != nullptr) value = read_element(tokens, name);
    const auto* object = value.get_if<Shared<Object>>();
    if (object == nullptr) fail(name.place, "must be an object, got " + name.quoted());
    return *object;
}

/// Counts what is so many times in an object from then on.
void count_in(Object& object, const Object& part, std::size_t times) {
    object.count += times * part.count;
    object.depth = std::max(object.depth, part.depth + 1);
    if (object.depth > deepest)
        fail(object.place, "must not be nested more than " + std::to_string(deepest) + " deep");
    if (object.count > most_shapes)
        fail(object.place, "must not be of more than " + std::to_string(most_shapes) + " shapes");
}

/// Reads what comes behind an object's numbers.
class Modifiers {
  public:
    Modifiers(Tokens& tokens, Object& object) : tokens_(tokens), object_(object) {}

    /// As far as the brace; past it.
    void read() {
        while (!tokens_.accept("}")) {
            if (const auto motion = read_motion(tokens_))
                move(motion);
            else
                read_one(tokens_.next());
        }
    }

  private:
    void move(const Shared<Motion>& motion) {
        object_.motion = both(object_.motion, motion);
        if (object_.texture == nullptr || object_.texture->pigment.kind == PigmentKind::color)
            return;
        Texture texture = *object_.texture;
        texture.pigment.motion = both(texture.pigment.motion, motion);
        object_.texture = std::make_shared<const Texture>(std::move(texture));
    }

    Texture own_texture() const {
        return object_.texture != nullptr ? *object_.texture : *tokens_.default_texture;
    }
    void set(Texture texture) {
        object_.texture = std::make_shared<const Texture>(std::move(texture));
    }

    void read_one(const Token& word) {
        if (word.is("texture")) {
            Shared<Texture> texture = read_texture(tokens_);
            const Tuple& color = texture->pigment.color;
            if (object_.texture != nullptr && (color.at[3] != 0.0 || color.at[4] != 0.0))
                tokens_.remark(word.place, "has layers of textures, of which the last is drawn");
            object_.texture = std::move(texture);
        } else if (word.is("pigment")) {
            Texture texture = own_texture();
            texture.pigment = read_pigment(tokens_, texture.pigment);
            set(std::move(texture));
        } else if (word.is("finish")) {
            Texture texture = own_texture();
            texture.finish = read_finish(tokens_, texture.finish);
            set(std::move(texture));
        } else if (word.is("material")) {
            const Material material = read_material(tokens_);
            if (material.texture != nullptr) object_.texture = material.texture;
            if (material.interior != nullptr) object_.interior = material.interior;
        } else if (word.is("interior")) {
            object_.interior = std::make_shared<const Interior>(read_interior(tokens_));
        } else if (word.is("clipped_by") || word.is("bounded_by")) {
            read_clip(word.is("clipped_by"));
        } else if (word.is("inverse")) {
            object_.inverse = !object_.inverse;
        } else {
            read_flag(word);
        }
    }

    void read_clip(bool clips) {
        tokens_.expect("{");
        while (!tokens_.accept("}")) {
            if (tokens_.accept("bounded_by") || tokens_.accept("clipped_by")) continue;
            Shared<Object> by = read_object(tokens_);
            if (!clips) continue; // it should bound what it is around of, which we do ourselves
            if (object_.count == 0) continue;            // nothing to clip
            if (object_.motion != nullptr) put_within(); // which does not move what comes later
            count_in(object_, *by, object_.pieces);
            object_.clips.push_back(std::move(by));
        }
    }

    void put_within() {
        Object inner = std::move(object_);
        object_ = {.kind = ObjectKind::all_in_one,
                   .place = inner.place,
                   .count = 0,
                   .pieces = inner.pieces};
        object_.texture = inner.texture;
        object_.interior = inner.interior;
        count_in(object_, inner, 1);
        object_.parts.push_back(std::make_shared<const Object>(std::move(inner)));
    }

    void read_flag(const Token& word) {
        static constexpr std::string_view without_meaning[] = {
            "hollow",      "double_illuminate", "sturm", "hierarchy",
            "split_union", "cutaway_textures",  "orient"};
        const bool is_ignored = std::find(std::begin(without_meaning), std::end(without_meaning),
                                          word.text) != std::end(without_meaning);
        if (is_ignored || word.is("no_shadow") || word.is("no_reflection") || word.is("no_image") ||
            word.is("no_radiosity")) {
            const bool holds = !at_tuple(tokens_) || read_number(tokens_) != 0.0;
            if (word.is("no_image") && holds) object_.is_hidden = true;
            if ((word.is("no_shadow") || word.is("no_image") || word.is("no_reflection")) && holds)
                tokens_.remark(word.place,
                               word.is("no_shadow")
                                   ? "has objects without shadows, which have them here"
                               : word.is("no_image")
                                   ? "has objects without an image, which are left out"
                                   : "has objects without a reflection, which have one here");
        } else if (word.is("normal") || word.is("photons") || word.is("radiosity") ||
                   word.is("interior_texture") || word.is("uv_vectors")) {
            if (!word.is("uv_vectors")) tokens_.skip_braces();
            tokens_.remark(word.place, "has " + word.quoted() + ", which is not drawn");
        } else {
            fail(word.place, "must be of an object, got " + word.quoted());
        }
    }

    Tokens& tokens_;
    Object& object_;
};

void add_part(Tokens& tokens, Object& object) {
    Shared<Object> part = read_object(tokens);
    count_in(object, *part, 1);
    if (object.kind == ObjectKind::all_in_one) object.pieces += part->pieces;
    object.parts.push_back(std::move(part));
}

/// Leaves out what has no size, as PyMOL writes it.
void leave_out_if_flat(Tokens& tokens, Object& object) {
    const bool is_flat = std::visit(
        [&](const auto& shape) {
            if constexpr (requires {
                              shape.a;
                              shape.b;
                              shape.c;
                          })
                return has_no_area(tokens, {shape.a, shape.b, shape.c}, object.place);
            else if constexpr (requires { shape.axis; })
                return shape.axis == Vec3d(0.0);
            else
                return false;
        },
        object.shape);
    if (!is_flat) return;
    tokens.remark(object.place, "has cylinders without a length, or triangles without an area, "
                                "which are left out");
    object.kind = ObjectKind::all_in_one;
    object.count = 0;
}

} // namespace

bool has_no_area(Tokens& tokens, const core::TriangleOf<double>& triangle, const Place& place) {
    if (!core::checks::are_collinear(triangle.a, triangle.b, triangle.c)) return false;
    tokens.remark(place, "has cylinders without a length, or triangles without an area, "
                         "which are left out");
    return true;
}

bool begins_object(const Tokens& tokens, const Token& token) {
    return entry(shapes, token) != nullptr || entry(compounds, token) != nullptr ||
           entry(meshes, token) != nullptr || token.is("object") ||
           named_object(tokens, token) != nullptr;
}

Shared<Object> read_object(Tokens& tokens) {
    const Token word = tokens.peek();
    const Level level(tokens.depth, word.place);
    if (named_object(tokens, word) != nullptr) return read_named(tokens);
    tokens.next();
    Object object{.place = word.place};
    const auto* shape = entry(shapes, word);
    const auto* mesh = entry(meshes, word);
    const auto* compound = entry(compounds, word);
    if (shape == nullptr && mesh == nullptr && compound == nullptr && !word.is("object")) {
        if (std::find(std::begin(not_read), std::end(not_read), word.text) != std::end(not_read))
            fail(word.place,
                 "must be made of quadrics, and " + word.quoted() + " is not: it is not read");
        fail(word.place, "must be an object that is read, got " + word.quoted());
    }
    tokens.expect("{");
    if (shape != nullptr) {
        object.shape = shape->read(tokens);
        leave_out_if_flat(tokens, object);
    } else if (mesh != nullptr) {
        object.kind = ObjectKind::mesh;
        object.mesh = mesh->read(tokens);
        object.count = object.mesh->triangles.size();
    } else if (compound != nullptr) {
        object.kind = compound->read;
        object.count = 0;
        if (object.kind == ObjectKind::all_in_one) object.pieces = 0;
        while (begins_object(tokens, tokens.peek()) ||
               std::find(std::begin(not_read), std::end(not_read), tokens.peek().text) !=
                   std::end(not_read))
            add_part(tokens, object);
    } else {
        object = *read_object(tokens);
        object.place = word.place;
    }
    Modifiers(tokens, object).read();
    return std::make_shared<const Object>(std::move(object));
}

} // namespace raylane::scenes::pov
