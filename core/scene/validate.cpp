#include "core/scene/validate.hpp"

#include "core/scene/fields.hpp"
#include "core/shapes/checks.hpp"

namespace raylane::core {

using namespace checks;
using fields::Kinds, fields::Rule, fields::Valid;

namespace {

/// Returns "must be between 0 and 32 pixels", "must be from 0 to 1", ...
std::string expectation_of(const Valid& valid) {
    const std::string least = text_of(valid.least), most = text_of(valid.most);
    if (*valid.unit == '\0') return "must be from " + least + " to " + most;
    const std::string range = "between " + least + " and " + most + " " + valid.unit;
    if (valid.rule == Rule::inside) return "must be " + range + ", both excluded";
    return valid.rule == Rule::number_or_0 ? "must be 0 or " + range : "must be " + range;
}

/// Checks a channel of a colour, also a light's, or a material's ambient, diffuse or specular. A
/// pixel is a sum of products of three of them. It stays finite: a float has room for 10^8 such
/// products.
void require_brightness(const Field& place, float value) {
    require(value >= 0.0F, place, "must not be negative", value);
    require(value <= 1e10F, place, "must be at most 1e10", value);
}

void check(const Field& place, const Valid& valid, float value) {
    const auto number = static_cast<double>(value);
    switch (valid.rule) {
    case Rule::positive:
        if (valid.most == fields::limit)
            require_positive(place, value);
        else
            require(value > 0.0F, place, "must be positive", value);
        return;
    case Rule::inside:
        if (number > valid.least && number < valid.most) return;
        break;
    case Rule::number_or_0:
        if (value == 0.0F) return;
        [[fallthrough]];
    default:
        if (valid.least == -fields::limit) return require_coordinate(place, value);
        if (valid.most == fields::limit) return require_not_negative(place, value);
        if (valid.most == fields::brightness.most) return require_brightness(place, value);
        if (number >= valid.least && number <= valid.most) return;
    }
    refuse(place, expectation_of(valid), value);
}

void check(const Field& place, const Valid& valid, const Vec3f& vector) {
    if (valid.rule == Rule::direction) return require_direction(place, vector);
    for (int i = 0; i < 3; ++i)
        check(place.at(i), valid, vector[i]);
}

void require_no_mistake(const Field& place, const Formula& formula) {
    if (!formula.any() || !formula.mistake()) return;
    throw InvalidValue(place.at(formula.mistake()->channel).text(),
                       "must be a formula: " + formula.mistake()->message);
}

/// Compares floats, so that the float nearest to a decimal limit is valid.
void require_between(const Field& place, float value, float least, float most) {
    if (!(value >= least && value <= most))
        refuse(place, "must be from " + text_of(least) + " to " + text_of(most), value);
}

template <class Of>
void check_fields(const Of& object, Kinds kinds) {
    fields::for_each_field(
        [&]<class Value>(const fields::Field& field, const Value& value) {
            if ((field.use.used & kinds) == 0) return;
            if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, Vec3f>)
                check(field.name, field.valid, value);
            else if constexpr (std::is_same_v<Value, std::array<Color, 2>>)
                for (int i = 0; i < 2; ++i)
                    check(Field(field.name).at(i), field.valid, value[i]);
            else if constexpr (std::is_same_v<Value, Formula>)
                require_no_mistake(field.name, value);
            else if constexpr (std::is_same_v<Value, int>)
                require_count(field.name, value, static_cast<int>(field.valid.least),
                              static_cast<int>(field.valid.most));
            else if constexpr (std::is_enum_v<Value>)
                require_enumerator(field.name, value,
                                   static_cast<Value>(field.valid.words.size() - 1));
            else if constexpr (fields::PatternLike<Value> || fields::OutlineLike<Value>)
                validate_in(field.name, value);
        },
        object);
}

} // namespace

void validate_color(const char* field, const Color& color) {
    check(field, fields::color, color);
}

void validate(const Pattern& pattern) {
    check_fields(pattern, fields::every);
    if (pattern.kind == PatternKind::formula && !pattern.formula.any())
        throw InvalidValue("formula", "must be three formulas, got none");
    if (pattern.kind == PatternKind::image && !pattern.image.any())
        throw InvalidValue("image", "must be an image, got none");
    if (pattern.kind == PatternKind::gradient && pattern.from == pattern.to)
        throw InvalidValue("to", "must differ from \"from\", got " + text_of(pattern.to));
    if ((pattern.axes & 7) == 0 || pattern.axes > 63)
        throw InvalidValue("axes", "must be one or more of x, y and z");
}

void validate(const Material& material) {
    check_fields(material, fields::every);
    if (material.glass.any() && !is_index(index_at(material.glass, line_d)))
        throw InvalidValue("glass", "must have an index of refraction for 587.56 nm");
}

void validate(const Light& light) {
    check("position", fields::coordinate, light.position); // also if it is unused
    check_fields(light, fields::kind_of(light));
    // The edges are rounded separately.
    if (light.kind == LightKind::rectangle &&
        !(std::abs(dot(normalized(convert<double>(light.edge_u)),
                       normalized(convert<double>(light.edge_v)))) < 0x1p-20))
        throw InvalidValue("edge_v", "must be perpendicular to edge_u's " + text_of(light.edge_u) +
                                         ", got " + text_of(light.edge_v));
}

void validate(const Fog& fog) {
    check_fields(fog, fields::kind_of(fog));
    if (fog.kind == FogKind::linear && !(fog.end > fog.start))
        refuse("end", "must be more than start's " + text_of(fog.start), fog.end);
    require(fog.kind != FogKind::linear_z || fog.end != fog.start, "end", "must differ from start",
            fog.end);
}

void validate(const Camera& camera) {
    check_fields(camera, fields::kind_of(camera));
    if (camera.from == camera.at)
        throw InvalidValue("at", "must differ from \"from\", got " + text_of(camera.at));
    // If `up` is this close to the line of sight, rounding of the inputs decides its direction
    // across.
    const Vec3d sight = normalized(convert<double>(camera.at) - convert<double>(camera.from));
    const Vec3d up = normalized(convert<double>(camera.up));
    if (!(length(cross(sight, up)) > 0x1p-22))
        throw InvalidValue("up", "must not be along the line of sight, got " + text_of(camera.up));
}

void validate(const AutoCamera& auto_camera) {
    require_between("depth_cue", auto_camera.depth_cue, 0.0F, 0.99F);
    if (!auto_camera.fit_camera) return;
    const FitCamera& fit_camera = *auto_camera.fit_camera;
    require_enumerator("projection", fit_camera.projection, Projection::orthographic);
    check("direction", fields::direction, fit_camera.direction);
    check("up", fields::coordinate, fit_camera.up);
    if (cross(convert<double>(fit_camera.up), convert<double>(fit_camera.direction)) == Vec3d(0.0))
        throw InvalidValue("up", "must not be 0 or parallel to the direction of view");
    require_between("zoom", fit_camera.zoom, 0.01F, 1000.0F);
    if (fit_camera.projection == Projection::perspective)
        require_between("field_of_view", fit_camera.field_of_view, 0.01F, 179.0F);
}

void validate(const Outline& outline) {
    check_fields(outline, fields::every);
}

void validate(const Settings& settings) {
    check_fields(settings, fields::every);
    if (std::int64_t{settings.width} * settings.height > Settings::max_pixels)
        throw InvalidValue("width", "must make at most " + std::to_string(Settings::max_pixels) +
                                        " pixels, got " + std::to_string(settings.width) + " x " +
                                        std::to_string(settings.height));
}

} // namespace raylane::core
