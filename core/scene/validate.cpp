#include "core/scene/validate.hpp"

#include "core/numbers/bounded.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace raylane::core {

namespace {

std::string text_of(float value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string text_of(const Vec3f& v) {
    return "[" + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + "]";
}

/// The place of a number. Only a refusal puts it into words: ten million spheres have forty million
/// places.
struct Field {
    const char* name;
    int row = -1;
    int column = -1;

    Field(const char* name_) : name(name_) {}
    Field at(int index) const {
        Field element = *this;
        (row < 0 ? element.row : element.column) = index;
        return element;
    }
    std::string text() const {
        std::string text = name;
        for (const int index : {row, column})
            if (index >= 0) text.append("/").append(std::to_string(index));
        return text;
    }
};

[[noreturn]] void refuse(const Field& field, const std::string& must, float got) {
    throw InvalidValue(field.text(), must + ", got " + text_of(got));
}

void require(bool good, const Field& field, const char* must, float got) {
    if (!good) refuse(field, must, got);
}

void require_coordinate(const Field& field, float value) {
    require(std::abs(value) <= coordinate_limit, field, "must be a number from -1e30 to 1e30",
            value);
}

void require_point(const Field& field, const Vec3f& point) {
    for (int axis = 0; axis < 3; ++axis)
        require_coordinate(field.at(axis), point[axis]);
}

void require_direction(const Field& field, const Vec3f& direction) {
    require_point(field, direction);
    if (direction == Vec3f(0.0F))
        throw InvalidValue(field.text(), "must not be the zero vector, got [0, 0, 0]");
}

void require_positive(const Field& field, float value) {
    require(value > 0.0F, field, "must be positive", value);
    require_coordinate(field, value);
}

void require_not_negative(const Field& field, float value) {
    require(value >= 0.0F, field, "must not be negative", value);
    require_coordinate(field, value);
}

void require_fraction(const Field& field, float value) {
    require(value >= 0.0F && value <= 1.0F, field, "must be from 0 to 1", value);
}

void require_count(const char* field, int value, int least, int most) {
    if (value < least || value > most)
        throw InvalidValue(field, "must be from " + std::to_string(least) + " to " +
                                      std::to_string(most) + ", got " + std::to_string(value));
}

using Wide = Bounded<DoubleDouble>;

/// Whether an exact product of float coordinates is 0, or cannot be told from it in 106 bits.
bool vanishes(const Wide& a) {
    return !(a.magnitude() > a.error);
}

Vec3<Wide> wide(const Vec3f& v) {
    return {Wide(static_cast<double>(v.x)), Wide(static_cast<double>(v.y)),
            Wide(static_cast<double>(v.z))};
}

bool parallel(const Vec3<Wide>& a, const Vec3<Wide>& b) {
    const Vec3<Wide> product = cross(a, b);
    return vanishes(product.x) && vanishes(product.y) && vanishes(product.z);
}

void validate_corners(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    require_point("a", a);
    require_point("b", b);
    require_point("c", c);
    if (parallel(wide(b) - wide(a), wide(c) - wide(a)))
        throw InvalidValue("", "must have three corners that are not in one line, got " +
                                   text_of(a) + ", " + text_of(b) + ", " + text_of(c));
}

void validate_cylinder(const Vec3f& base, const Vec3f& axis, float radius) {
    require_point("base", base);
    require_direction("axis", axis);
    require_positive("radius", radius);
}

void validate_cone(const Vec3f& base, const Vec3f& axis, float base_radius, float top_radius) {
    require_point("base", base);
    require_direction("axis", axis);
    require_not_negative("base_radius", base_radius);
    require_not_negative("top_radius", top_radius);
    if (base_radius == 0.0F && top_radius == 0.0F)
        throw InvalidValue("base_radius", "must be positive where top_radius is 0, got 0");
}

void validate(const Pattern& pattern) {
    validate_color("colors/0", pattern.colors[0]);
    validate_color("colors/1", pattern.colors[1]);
    require_positive("size", pattern.size);
    require_direction("direction", pattern.direction);
    require_point("from", pattern.from);
    require_point("to", pattern.to);
    if (pattern.kind == PatternKind::gradient && pattern.from == pattern.to)
        throw InvalidValue("to", "must differ from \"from\", got " + text_of(pattern.to));
    if (pattern.axes == 0 || pattern.axes > 7)
        throw InvalidValue("axes", "must be one or more of x, y and z");
}

} // namespace

void validate_color(const char* field, const Color& color) {
    for (int channel = 0; channel < 3; ++channel)
        require_not_negative(Field(field).at(channel), color[channel]);
}

void validate(const Sphere& sphere) {
    require_point("center", sphere.center);
    require_positive("radius", sphere.radius);
}

void validate(const Plane& plane) {
    require_point("point", plane.point);
    require_direction("normal", plane.normal);
}

void validate(const Disc& disc) {
    require_point("center", disc.center);
    require_direction("normal", disc.normal);
    require_positive("radius", disc.radius);
}

void validate(const Triangle& triangle) {
    validate_corners(triangle.a, triangle.b, triangle.c);
}

void validate(const SmoothTriangle& triangle) {
    validate_corners(triangle.a, triangle.b, triangle.c);
    require_direction("normals/0", triangle.normal_a);
    require_direction("normals/1", triangle.normal_b);
    require_direction("normals/2", triangle.normal_c);
}

void validate(const Box& box) {
    require_point("corner", box.corner);
    require_direction("edges/0", box.edge_u);
    require_direction("edges/1", box.edge_v);
    require_direction("edges/2", box.edge_w);
    if (vanishes(dot(cross(wide(box.edge_u), wide(box.edge_v)), wide(box.edge_w))))
        throw InvalidValue("edges", "must span a volume, got " + text_of(box.edge_u) + ", " +
                                        text_of(box.edge_v) + ", " + text_of(box.edge_w));
}

void validate(const OpenCylinder& c) {
    validate_cylinder(c.base, c.axis, c.radius);
}
void validate(const CappedCylinder& c) {
    validate_cylinder(c.base, c.axis, c.radius);
}
void validate(const OpenCone& c) {
    validate_cone(c.base, c.axis, c.base_radius, c.top_radius);
}
void validate(const CappedCone& c) {
    validate_cone(c.base, c.axis, c.base_radius, c.top_radius);
}

void validate(const Quadric& q) {
    require_point("center", q.center);
    const float rows[4][4] = {{q.xx, q.xy, q.xz, q.x},
                              {q.xy, q.yy, q.yz, q.y},
                              {q.xz, q.yz, q.zz, q.z},
                              {q.x, q.y, q.z, q.one}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            require_coordinate(Field("matrix").at(row).at(column), rows[row][column]);
    const bool constant = q.xx == 0 && q.yy == 0 && q.zz == 0 && q.xy == 0 && q.xz == 0 &&
                          q.yz == 0 && q.x == 0 && q.y == 0 && q.z == 0;
    if (constant) throw InvalidValue("matrix", "must not be constant, got no entry but the last");
    require_point("lower", q.lower);
    require_point("upper", q.upper);
    for (int axis = 0; axis < 3; ++axis)
        if (!(q.lower[axis] < q.upper[axis]))
            refuse(Field("upper").at(axis), "must be more than lower's " + text_of(q.lower[axis]),
                   q.upper[axis]);
}

void validate(const Material& material) {
    try {
        validate(material.pattern);
    } catch (const InvalidValue& invalid) {
        throw InvalidValue("pattern/" + invalid.field, invalid.expectation);
    }
    require_not_negative("ambient", material.ambient);
    require_not_negative("diffuse", material.diffuse);
    require_not_negative("specular", material.specular);
    require_not_negative("exponent", material.exponent);
    require_fraction("reflectivity", material.reflectivity);
    require_fraction("transmission", material.transmission);
    require_positive("index", material.index);
    validate_color("absorption", material.absorption);
}

void validate(const Light& light) {
    require_point("position", light.position);
    if (light.kind == LightKind::directional) require_direction("direction", light.direction);
    validate_color("color", light.color);
}

void validate(const Fog& fog) {
    if (fog.kind == FogKind::none) return;
    validate_color("color", fog.color);
    if (fog.kind == FogKind::exponential) {
        require_positive("density", fog.density);
        return;
    }
    require_coordinate("start", fog.start);
    require_coordinate("end", fog.end);
    if (fog.kind == FogKind::linear) {
        require_not_negative("start", fog.start);
        if (!(fog.end > fog.start))
            refuse("end", "must be more than start's " + text_of(fog.start), fog.end);
    }
    require(fog.end != fog.start, "end", "must differ from start", fog.end);
}

void validate(const Camera& camera) {
    require_point("from", camera.from);
    require_point("at", camera.at);
    require_direction("up", camera.up);
    if (camera.from == camera.at)
        throw InvalidValue("at", "must differ from \"from\", got " + text_of(camera.at));
    // Within the rounding of the inputs the direction of up across the line of sight would be
    // noise.
    const Vec3d sight = normalized(convert<double>(camera.at) - convert<double>(camera.from));
    const Vec3d up = normalized(convert<double>(camera.up));
    if (!(length(cross(sight, up)) > 0x1p-22))
        throw InvalidValue("up", "must not be along the line of sight, got " + text_of(camera.up));
    if (camera.projection == Projection::perspective)
        require(camera.field_of_view > 0.0F && camera.field_of_view < 180.0F, "field_of_view",
                "must be between 0 and 180 degrees, both excluded", camera.field_of_view);
    else
        require_positive("height", camera.height);
}

void validate(const Settings& settings) {
    require_count("width", settings.width, 1, Settings::max_size);
    require_count("height", settings.height, 1, Settings::max_size);
    if (std::int64_t{settings.width} * settings.height > Settings::max_pixels)
        throw InvalidValue("width", "must make at most " + std::to_string(Settings::max_pixels) +
                                        " pixels, got " + std::to_string(settings.width) + " x " +
                                        std::to_string(settings.height));
    require_count("grid", settings.grid, 1, Settings::max_grid);
    require_count("max_depth", settings.max_depth, 0, Settings::depth_limit);
    require_fraction("min_weight", settings.min_weight);
}

} // namespace raylane::core
