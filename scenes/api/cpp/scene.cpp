#include "core/scene/scene.hpp"

#include "core/hierarchy/emission.hpp"
#include "core/scene/auto_camera.hpp"
#include "core/scene/generators.hpp"
#include "core/scene/given_shapes.hpp"
#include "core/scene/validate.hpp"
#include "core/shapes/checks.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/group.hpp"
#include "raylane/scene.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"
#include "simd/threads/threads.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace raylane {

using library::converted;
using library::owning;
using library::translated;

namespace {

void require_index(std::size_t index, std::size_t count, const char* what) {
    if (index >= count)
        throw InvalidValue("", "must be one of " + std::to_string(count) + " " + what + ", got " +
                                   std::to_string(index));
}

template <class Number>
Scene moved(const core::Scene& scene, std::span<const Vec3Of<Number>> positions) {
    static_assert(sizeof(Vec3Of<Number>) == 3 * sizeof(Number));
    return translated([&] {
        simd::ParallelWorkers workers;
        const std::span coordinates(reinterpret_cast<const Number*>(positions.data()),
                                    3 * positions.size());
        return owning(scene.with_positions(coordinates, workers));
    });
}

template <class CoreShape, class Shape>
ShapesOf<Shape> shapes_of(const core::Scene& scene) {
    core::GivenShapes<CoreShape> given = core::given_shapes<CoreShape>(scene);
    ShapesOf<Shape> shapes{std::move(given.ids), {}, {}};
    shapes.material.reserve(shapes.id.size());
    for (const ShapeId id : shapes.id)
        shapes.material.push_back(scene.material_index_of(id));
    shapes.shape.reserve(shapes.id.size());
    for (const core::InDouble<CoreShape>& shape : given.shapes)
        shapes.shape.push_back(std::bit_cast<Shape>(shape));
    return shapes;
}

/// Returns the bounds that a hierarchy over all shapes has, those of copies included. It takes the
/// bounds of floats, which are rounded otherwise, for the shapes of a kind that are all in floats.
core::Bounds bounds_of_all(const core::Scene& scene) {
    struct OfKind {
        core::Bounds of_floats, of_doubles;
        bool has_doubles = false;
    };
    std::array<OfKind, core::kind_count> kinds;
    core::for_each_bounded_shape(scene, [&]<class Shape>(const Shape& shape, ShapeId) {
        using InFloat = core::InFloat<Shape>;
        OfKind& kind = kinds[static_cast<std::size_t>(core::kind_of<InFloat>)];
        kind.has_doubles = kind.has_doubles || !core::is_in_floats(shape);
        kind.of_doubles.include(core::padded(core::bounds_of(shape)));
        if (!kind.has_doubles)
            kind.of_floats.include(core::padded(core::bounds_of(core::to_floats(shape))));
    });
    core::Bounds bounds;
    for (const OfKind& kind : kinds)
        bounds.include(kind.has_doubles ? kind.of_doubles : kind.of_floats);
    return bounds;
}

/// Throws InvalidValue, field "auto_camera/...".
core::AutoCamera core_auto_camera(const AutoCamera& camera) {
    core::FitCamera fit_camera{.projection = static_cast<core::Projection>(camera.projection),
                               .direction = converted<core::Vec3f>(camera.direction),
                               .up = converted<core::Vec3f>(camera.up),
                               .field_of_view = camera.field_of_view,
                               .zoom = camera.zoom};
    if (camera.up == Vec3()) fit_camera.up = core::upright(fit_camera.direction);
    const core::AutoCamera result{.fit_camera = fit_camera, .depth_cue = camera.depth_cue};
    core::validate_in("auto_camera", result);
    return result;
}

} // namespace

Scene::Scene(std::shared_ptr<const core::Scene> scene,
             std::shared_ptr<const library::SceneAnnotations> annotations)
    : scene_(std::move(scene)), annotations_(std::move(annotations)) {}

std::size_t Scene::shape_count() const {
    return scene_->shape_count();
}

std::size_t Scene::material_count() const {
    return scene_->materials().size();
}

Bounds Scene::bounds() const {
    const core::Bounds bounds =
        scene_->copies() != nullptr ? bounds_of_all(*scene_) : scene_->hierarchy().bounds;
    return {converted<Vec3>(bounds.lower), converted<Vec3>(bounds.upper)};
}

MaterialIndex Scene::material_of(ShapeId shape) const {
    require_index(shape, shape_count(), "shapes");
    return scene_->material_index_of(shape);
}

ShapeId Scene::solid_of(ShapeId shape) const {
    require_index(shape, shape_count(), "shapes");
    return scene_->solids().solid_of(shape);
}

#define RAYLANE_GIVEN(Shape, name, text)                                                           \
    if (const auto* shape = std::get_if<core::InDouble<core::Shape>>(&given))                      \
        return std::bit_cast<Shape##Of<double>>(*shape);
ShapeVariant Scene::shape(ShapeId id) const {
    require_index(id, shape_count(), "shapes");
    const core::PartShape given = core::given_shape(*scene_, id);
    RAYLANE_SHAPES(RAYLANE_GIVEN)
    return {};
}
#undef RAYLANE_GIVEN

#define RAYLANE_GIVEN(Shape, name, text)                                                           \
    template <>                                                                                    \
    ShapesOf<Shape##Of<double>> Scene::shapes<Shape##Of>() const {                                 \
        return shapes_of<core::Shape, Shape##Of<double>>(*scene_);                                 \
    }
RAYLANE_SHAPES(RAYLANE_GIVEN)
#undef RAYLANE_GIVEN

Material Scene::material(MaterialIndex index) const {
    require_index(index, material_count(), "materials");
    return converted<Material>(scene_->materials()[index]);
}

std::string Scene::material_name(MaterialIndex index) const {
    require_index(index, material_count(), "materials");
    return std::string(scene_->material_name(index));
}

std::vector<Light> Scene::lights() const {
    std::vector<Light> lights;
    for (const core::Light& light : scene_->lights())
        lights.push_back(converted<Light>(light));
    return lights;
}

Fog Scene::fog() const {
    return converted<Fog>(scene_->fog());
}

Camera Scene::camera() const {
    return converted<Camera>(scene_->camera());
}

Color Scene::background() const {
    return converted<Color>(scene_->background());
}

Settings Scene::settings() const {
    return converted<Settings>(scene_->settings());
}

Scene Scene::seen_by(const Camera& camera) const {
    return translated([&] {
        return owning(core::Scene(*scene_).seen_by(converted<core::Camera>(camera)), annotations_);
    });
}

Scene Scene::with_positions(std::span<const Vec3> positions) const {
    return moved(*scene_, positions);
}

Scene Scene::with_positions(std::span<const Vec3Of<double>> positions) const {
    return moved(*scene_, positions);
}

Camera Scene::camera_on_all(const Vec3& direction, float aspect) const {
    if (!(aspect >= 1e-5F && aspect <= 1e5F))
        throw InvalidValue("aspect",
                           "must be from 0.00001 to 100000, got " + core::checks::text_of(aspect));
    return translated([&] {
        const auto way = converted<core::Vec3f>(direction);
        const double squared_length = core::squared_length(core::convert<double>(way));
        if (!(squared_length > 0.0 && squared_length < std::numeric_limits<double>::infinity()))
            throw InvalidValue("direction", "must be finite and not zero");
        core::Frame frame({.direction = way, .up = core::upright(way)},
                          static_cast<double>(aspect));
        core::include_shapes(*scene_, frame);
        if (frame.empty())
            throw InvalidValue("scene", "must have a shape other than planes to frame");
        const core::Camera found = frame.camera();
        try {
            core::validate(found);
        } catch (const core::InvalidValue&) {
            throw InvalidValue("scene", "is too large for an automatic camera, whose position "
                                        "would exceed 1e30: set a camera");
        }
        return converted<Camera>(found);
    });
}

SceneBuilder::SceneBuilder() = default;
SceneBuilder::~SceneBuilder() = default;
SceneBuilder::SceneBuilder(SceneBuilder&& other) noexcept {
    *this = std::move(other);
}
SceneBuilder& SceneBuilder::operator=(SceneBuilder&& other) noexcept {
    if (this == &other) return *this;
    camera = std::exchange(other.camera, {});
    background = std::exchange(other.background, {});
    fog = std::exchange(other.fog, {});
    settings = std::exchange(other.settings, {});
    wavelengths = std::exchange(other.wavelengths, {});
    merge_duplicates = std::exchange(other.merge_duplicates, true);
    keep_from = std::exchange(other.keep_from, core::kept_from);
    auto_camera = std::exchange(other.auto_camera, std::nullopt);
    camera_lights = std::exchange(other.camera_lights, false);
    default_material_ = std::exchange(other.default_material_, no_material);
    builder_ = std::move(other.builder_);
    return *this;
}

core::SceneBuilder& SceneBuilder::builder() {
    if (builder_ == nullptr) builder_ = std::make_unique<core::SceneBuilder>();
    return *builder_;
}

MaterialIndex SceneBuilder::add_material(const Material& material, std::string_view name) {
    return translated([&] {
        const MaterialIndex index = builder().add_material(converted<core::Material>(material));
        if (!name.empty()) builder().name_material(index, name);
        return index;
    });
}

template <class Add>
ShapeId SceneBuilder::add_with(MaterialIndex material, const Add& add) {
    return translated([&] {
        if (material != no_material) return add(material);
        const bool is_new = default_material_ == no_material;
        if (is_new) default_material_ = builder().add_material({});
        try {
            return add(default_material_);
        } catch (...) { // leaves the builder unchanged
            if (is_new) {
                builder().remove_last_material();
                default_material_ = no_material;
            }
            throw;
        }
    });
}

void SceneBuilder::add_light(const Light& light) {
    translated([&] { builder().add_light(converted<core::Light>(light)); });
}

#define RAYLANE_ADD(Shape, name, text)                                                             \
    template <>                                                                                    \
    ShapeId SceneBuilder::add(const Shape& shape, MaterialIndex material) {                        \
        return add_with(material, [&](MaterialIndex index) {                                       \
            return builder().add(library::core_shape<core::Shape>(shape), index);                  \
        });                                                                                        \
    }                                                                                              \
    template <>                                                                                    \
    ShapeId SceneBuilder::add(const Shape##Of<double>& shape, MaterialIndex material) {            \
        return add_with(material, [&](MaterialIndex index) {                                       \
            return builder().add(library::core_shape<core::InDouble<core::Shape>>(shape), index);  \
        });                                                                                        \
    }
RAYLANE_SHAPES(RAYLANE_ADD)
#undef RAYLANE_ADD

ShapeId SceneBuilder::add(const Solid& solid, MaterialIndex material) {
    const core::Solid& given = library::Internals::of(solid);
    if (material == no_material && core::has_materials(given))
        return translated([&] { return builder().add_solid(given, core::no_material); });
    return add_with(material,
                    [&](MaterialIndex index) { return builder().add_solid(given, index); });
}

/// Calls add(members) for the members of a group, all of which then have materials.
template <class Add>
ShapeId SceneBuilder::add_members(const Group& group, MaterialIndex material, const Add& add) {
    std::vector<core::Solid> members;
    bool all_have_materials = true;
    for (const Solid& member : library::Internals::members_of(group)) {
        members.push_back(library::Internals::of(member));
        all_have_materials = all_have_materials && core::has_materials(members.back());
    }
    if (material == no_material && all_have_materials)
        return translated([&] { return add(members); });
    return add_with(material, [&](MaterialIndex index) {
        for (core::Solid& member : members)
            if (member.material == core::no_material &&
                (material != no_material || !core::has_materials(member)))
                member.material = index;
        return add(members);
    });
}

ShapeId SceneBuilder::add(const Group& group, MaterialIndex material) {
    return add_members(group, material, [&](std::span<const core::Solid> members) {
        return builder().add_group(members);
    });
}

ShapeId SceneBuilder::add(const Group& group, std::span<const Placement> placements,
                          MaterialIndex material) {
    static_assert(sizeof(Placement) == sizeof(core::Placement));
    return add_members(group, material, [&](std::span<const core::Solid> members) {
        std::vector<core::Placement> places(placements.size());
        for (std::size_t i = 0; i < placements.size(); ++i)
            places[i] = std::bit_cast<core::Placement>(placements[i]);
        builder().keep_from = keep_from;
        return builder().add_copies(members, std::move(places));
    });
}

ShapeId SceneBuilder::add(const Sphereflake& flake, MaterialIndex material) {
    return add_with(material, [&](MaterialIndex index) {
        const auto first = static_cast<ShapeId>(builder().shape_count());
        builder().require_material(index);
        core::add(builder(),
                  {converted<core::Vec3f>(flake.center), flake.radius, flake.depth,
                   converted<core::Vec3f>(flake.up)},
                  index);
        return first;
    });
}

ShapeId SceneBuilder::add(const Lattice& lattice, MaterialIndex material,
                          MaterialIndex strut_material) {
    return add_with(material, [&](MaterialIndex index) {
        const auto first = static_cast<ShapeId>(builder().shape_count());
        const MaterialIndex of_struts = strut_material == no_material ? index : strut_material;
        builder().require_material(index);
        builder().require_material(of_struts);
        core::add(builder(),
                  {{lattice.corner.x, lattice.corner.y, lattice.corner.z},
                   lattice.n,
                   lattice.spacing,
                   lattice.sphere_radius,
                   lattice.strut_radius},
                  index, of_struts);
        return first;
    });
}

template <class CoreShape, class Shape>
ShapeId SceneBuilder::add_polygon_as(std::span<const Shape> triangles, MaterialIndex material) {
    std::vector<CoreShape> converted_triangles;
    converted_triangles.reserve(triangles.size());
    for (const Shape& triangle : triangles)
        converted_triangles.push_back(library::core_shape<CoreShape>(triangle));
    return translated([&] {
        return builder().add_polygon(std::span<const CoreShape>(converted_triangles), material);
    });
}

ShapeId SceneBuilder::add_polygon(std::span<const Triangle> triangles, MaterialIndex material) {
    return add_polygon_as<core::Triangle>(triangles, material);
}
ShapeId SceneBuilder::add_polygon(std::span<const SmoothTriangle> triangles,
                                  MaterialIndex material) {
    return add_polygon_as<core::SmoothTriangle>(triangles, material);
}
ShapeId SceneBuilder::add_polygon(std::span<const TriangleOf<double>> triangles,
                                  MaterialIndex material) {
    return add_polygon_as<core::TriangleOf<double>>(triangles, material);
}
ShapeId SceneBuilder::add_polygon(std::span<const SmoothTriangleOf<double>> triangles,
                                  MaterialIndex material) {
    return add_polygon_as<core::SmoothTriangleOf<double>>(triangles, material);
}

std::size_t SceneBuilder::shape_count() const {
    return builder_ != nullptr ? builder_->shape_count() : 0;
}

Scene SceneBuilder::build() {
    return translated([&] {
        simd::ParallelWorkers workers; // may throw, so before the builder is emptied
        SceneBuilder taken = std::move(*this);
        core::SceneBuilder& builder = taken.builder();
        if (taken.auto_camera)
            builder.auto_camera = core_auto_camera(*taken.auto_camera);
        else
            library::copy(taken.camera, builder.camera);
        builder.auto_camera.lights = taken.camera_lights;
        library::copy(taken.background, builder.background);
        library::copy(taken.fog, builder.fog);
        library::copy(taken.settings, builder.settings);
        builder.wavelengths = taken.wavelengths;
        builder.merge_duplicates = taken.merge_duplicates;
        builder.wants_light = false;
        builder.workers = &workers;
        return owning(std::move(builder).build());
    });
}

} // namespace raylane
