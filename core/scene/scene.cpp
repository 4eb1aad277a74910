#include "core/scene/scene.hpp"

#include "core/hierarchy/moved_spheres.hpp"
#include "core/scene/surface.hpp"
#include "core/scene/validate.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/group.hpp"
#include "core/solids/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

std::size_t rank_in_groups(std::span<const IdRange> groups, ShapeId id) {
    std::size_t rank = id;
    for (const IdRange& group : groups) {
        if (id < group.first) break;
        rank -= std::min(id, group.last) - group.first;
    }
    return rank;
}

IdRange Scene::coplanar_with(ShapeId id) const {
    const IdRange* polygon = range_with(polygons_, id);
    return polygon != nullptr ? *polygon : IdRange{id, id};
}

std::optional<ObjectSpace> Scene::object_space(ShapeId id) const {
    if (material_of_.stored_index(id) == MaterialIndices::no_index) {
        const Copies::Copy copy = copies_->copy_with(id);
        const ObjectSpace of_copy =
            space_moved_by(copies_->placement(copy.set.first_copy + copy.number));
        const auto before = copy.set.prototype->object_space(id - Copies::first_id_of(copy));
        return before ? moved(*before, of_copy) : of_copy;
    }
    const auto found = std::ranges::lower_bound(object_spaces_, id, {},
                                                [](const auto& entry) { return entry.first; });
    if (found == object_spaces_.end() || found->first != id) return std::nullopt;
    return *found->second;
}

void Scene::find_transmissive() {
    const auto transmits = [](const Material& material) { return material.transmits(); };
    if (std::none_of(materials_.begin(), materials_.end(), transmits)) return;
    for_each_table(shapes_, [&](const auto& table) {
        for_each_shape(table, [&]<class Shape>(const Shape& shape, ShapeId id) {
            if (!bounds_medium(material_of_[id], medium_index_of(id))) return;
            transmissive_.any = true;
            if (solids_.has(id)) {
                const Bounds& bounds = solids_.bounds(solids_.root_of(solids_.part_of(id)));
                if (is_finite(bounds)) transmissive_.bounds.include(bounds);
                return;
            }
            if constexpr (is_bounded<Shape>) {
                const Bounds bounds = bounds_of(shape);
                transmissive_.bounds.include(bounds);
                if (!is_solid<Shape>) transmissive_.open.include(bounds);
            }
        });
    });
}

std::size_t Scene::bytes() const {
    std::size_t bytes = (copies_ != nullptr ? copies_->bytes() : 0) + hierarchy_.bytes() +
                        solids_.bytes() + material_of_.bytes() +
                        polygons_.capacity() * sizeof(IdRange) +
                        materials_.capacity() * sizeof(Material) +
                        object_spaces_.capacity() * sizeof object_spaces_[0];
    for (const std::vector<MergedShape>& merged : merged_)
        bytes += merged.capacity() * sizeof(MergedShape);
    for_each_table(shapes_, [&](const auto& table) { bytes += table.bytes(); });
    return bytes;
}

std::size_t Scene::double_bytes() const {
    std::size_t bytes = 0;
    for_each_table(shapes_, [&](const auto& table) { bytes += table.doubles().bytes(); });
    return bytes;
}

Scene Scene::in_light_of(double wavelength) const {
    Scene scene = *this;
    scene.wavelengths_.clear();
    for (Material& material : scene.materials_)
        if (material.glass.any())
            material.index = static_cast<float>(index_at(material.glass, wavelength));
    return scene;
}

void SceneBuilder::require_material(MaterialIndex material) const {
    if (material >= scene_.materials_.size())
        throw InvalidValue("material",
                           "must be the index of a material, got " + std::to_string(material));
}

void SceneBuilder::require_room(std::size_t count) const {
    if (count > no_shape - shape_count())
        throw InvalidValue("", "must be one of at most 4294967295 shapes");
}

MaterialIndex SceneBuilder::add_material(const Material& material) {
    validate(material);
    scene_.materials_.push_back(material);
    if (material.glass.any())
        scene_.materials_.back().index = static_cast<float>(index_at(material.glass, line_d));
    return static_cast<MaterialIndex>(scene_.materials_.size() - 1);
}

MaterialIndex SceneBuilder::add_placeholder() {
    const MaterialIndex material = add_material({});
    placeholders_.insert(material);
    return material;
}

void SceneBuilder::name_material(MaterialIndex material, std::string_view name) {
    require_material(material);
    if (material >= scene_.material_names_.size()) scene_.material_names_.resize(material + 1U);
    if (scene_.material_names_[material].empty()) scene_.material_names_[material] = name;
}

void SceneBuilder::add_light(const Light& light) {
    validate(light);
    scene_.lights_.push_back(light);
}

void SceneBuilder::renumber_materials(std::span<const MaterialIndex> new_index) {
    for (KeptCopies& copies : kept_)
        for (Solid& member : copies.members)
            member.material = new_index[member.material];
    std::vector<Material> renumbered;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < new_index.size(); ++i) {
        renumbered.resize(std::max<std::size_t>(renumbered.size(), new_index[i] + std::size_t{1}));
        renumbered[new_index[i]] = scene_.materials_[i];
        names.resize(renumbered.size());
        names[new_index[i]] = scene_.material_name(static_cast<MaterialIndex>(i));
    }
    scene_.materials_ = std::move(renumbered);
    scene_.material_names_ = std::move(names);
    scene_.material_of_ = scene_.material_of_.renumbered(new_index);
    solids_.renumber_materials(new_index);
}

template <class Shape>
ShapeId SceneBuilder::append(const Shape& shape, MaterialIndex material) {
    const auto id = static_cast<ShapeId>(shape_count());
    std::get<ShapeList<InFloat<Shape>>>(lists_).add(shape, id);
    scene_.material_of_.push_back(material);
    constexpr std::size_t now_and_then = std::size_t{1} << 16;
    if (shape_count() % now_and_then == 0 && workers != nullptr) workers->added(shape_count());
    return id;
}

void SceneBuilder::note_space(ShapeId id, MaterialIndex material,
                              const std::shared_ptr<const ObjectSpace>& space) {
    if (space != nullptr && may_follow(material)) scene_.object_spaces_.emplace_back(id, space);
}

bool SceneBuilder::may_follow(const Solid& solid, MaterialIndex material) const {
    if (solid.material != no_material) material = solid.material;
    if (solid.made == Made::of_shape) return material == no_material || may_follow(material);
    return std::any_of(solid.parts.begin(), solid.parts.end(),
                       [&](const Solid& part) { return may_follow(part, material); });
}

template <class Shape>
ShapeId SceneBuilder::add(const Shape& shape, MaterialIndex material) {
    validate(shape);
    require_material(material);
    require_room(1);
    return append(shape, material);
}

template <class AnyTriangle>
ShapeId SceneBuilder::add_polygon(std::span<const AnyTriangle> triangles, MaterialIndex material) {
    if (triangles.empty()) throw InvalidValue("", "must have at least one triangle, got none");
    std::size_t number = 0;
    try {
        for (; number < triangles.size(); ++number)
            validate(triangles[number]);
    } catch (const InvalidValue& invalid) {
        throw InvalidValue(std::to_string(number) + (invalid.field.empty() ? "" : "/") +
                               invalid.field,
                           invalid.expectation);
    }
    if (number = first_off_plane(triangles); number < triangles.size())
        throw InvalidValue(std::to_string(number), "must be in one plane with the other triangles");
    require_material(material);
    require_room(triangles.size());
    const ShapeId first = append(triangles.front(), material);
    for (const AnyTriangle& triangle : triangles.subspan(1))
        append(triangle, material);
    const auto last = static_cast<ShapeId>(shape_count() - 1);
    if (last != first) scene_.polygons_.push_back({first, last});
    return first;
}

/// Checks a solid. Ignores the bounds of quadrics.
void SceneBuilder::check_solid(const Solid& solid, bool has_material,
                               const std::string& place) const {
    const auto in = [&](const std::string& field) {
        return place.empty() ? field : field.empty() ? place : place + "/" + field;
    };
    if (solid.material != no_material) {
        if (solid.material >= scene_.materials_.size()) require_material(solid.material);
        has_material = true;
    }
    if (solid.made != Made::of_shape) {
        const std::size_t least = solid.made == Made::by_clip ? 2 : 1;
        if (solid.parts.size() < least)
            throw InvalidValue(in("objects"), "must have at least " + std::to_string(least) +
                                                  (least == 1 ? " object" : " objects") + ", got " +
                                                  std::to_string(solid.parts.size()));
        for (std::size_t i = 0; i < solid.parts.size(); ++i) {
            const bool cuts = solid.made == Made::by_clip && i != 0;
            check_solid(solid.parts[i], has_material || cuts, in("objects/" + std::to_string(i)));
        }
        return;
    }
    try {
        validate_part(solid.shape);
    } catch (const InvalidValue& invalid) {
        throw InvalidValue(in(invalid.field), invalid.expectation);
    }
    const auto kind = static_cast<Kind>(solid.shape.index());
    if (!with_shape_type(kind, []<class Shape>(std::type_identity<Shape>) {
            return has_inside<Shape> || kind_of<Shape> == Kind::open_cylinder ||
                   kind_of<Shape> == Kind::open_cone;
        }))
        throw InvalidValue(in("type"), "must be of a solid, a plane or a quadric, got " +
                                           std::string(name_of(kind)));
    if (!has_material)
        throw InvalidValue(in("material"), "must be given, here or for the whole solid");
}

ShapeId SceneBuilder::add_solid(const Solid& solid, MaterialIndex material) {
    if (material != no_material) require_material(material);
    check_solid(solid, material != no_material, "");
    require_room(count_parts(solid));
    if (!kept_.empty()) give_up_copies();
    const auto first = static_cast<ShapeId>(shape_count());
    const std::size_t spaces = scene_.object_spaces_.size();
    try {
        solids_.add(solid, material, [&](MaterialIndex of_part, const auto& space) {
            scene_.material_of_.push_back(of_part);
            const auto id = static_cast<ShapeId>(shape_count() - 1);
            note_space(id, of_part, space);
            return id;
        });
    } catch (const InvalidValue&) {
        scene_.material_of_.truncate(first);
        scene_.object_spaces_.resize(spaces);
        throw;
    }
    return first;
}

ShapeId SceneBuilder::add_member(const Solid& member) {
    if (member.made != Made::of_shape) return add_solid(member, no_material);
    const ShapeId id =
        std::visit([&](const auto& shape) { return add(shape, member.material); }, member.shape);
    note_space(id, member.material, member.space);
    return id;
}

/// Throws if add_member() would.
void SceneBuilder::check_member(const Solid& member) const {
    if (member.made == Made::of_shape) {
        std::visit([](const auto& shape) { validate(shape); }, member.shape);
        return require_material(member.material);
    }
    check_solid(member, false, "");
    SolidCollector trial; // refuses unbounded solids
    trial.add(member, no_material, [](MaterialIndex, const auto&) { return ShapeId{0}; });
}

namespace {

/// Checks members, by `check`, and returns the number of their parts.
template <class Check>
std::size_t checked_parts(std::span<const Solid> members, const Check& check) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        check_object(i, [&] { check(members[i]); });
        count += count_parts(members[i]);
    }
    return count;
}

} // namespace

ShapeId SceneBuilder::add_group(std::span<const Solid> members) {
    require_room(checked_parts(members, [&](const Solid& member) { check_member(member); }));
    const auto first = static_cast<ShapeId>(shape_count());
    for (const Solid& member : members)
        add_member(member);
    return first;
}

namespace {

/// Returns true for numbers for which the errors of maps into a copy's space are far below those of
/// floats.
bool is_ordinary(const Vec3d& point) {
    return std::abs(point.x) <= 0x1p40 && std::abs(point.y) <= 0x1p40 &&
           std::abs(point.z) <= 0x1p40;
}

bool can_copy(const PartShape& shape) {
    return can_place(shape) && std::visit(
                                   []<class Shape>(const Shape& given) {
                                       if constexpr (is_bounded<InFloat<Shape>>) {
                                           const Bounds bounds = bounds_of(given);
                                           // No number that is above 0 becomes 0 in a copy.
                                           return is_ordinary(convert<double>(bounds.lower)) &&
                                                  is_ordinary(convert<double>(bounds.upper)) &&
                                                  length(bounds.upper - bounds.lower) >= 0x1p-40F;
                                       } else {
                                           return false;
                                       }
                                   },
                                   shape);
}

} // namespace

bool SceneBuilder::keeps_copies(std::span<const Solid> members,
                                std::span<const Placement> placements) const {
    const std::size_t count = placements.size() * members.size();
    if (count == 0 || count < keep_from || solids_.any()) return false;
    return std::all_of(members.begin(), members.end(),
                       [&](const Solid& member) {
                           return member.made == Made::of_shape && can_copy(member.shape) &&
                                  member.material < scene_.materials_.size() &&
                                  !scene_.materials_[member.material].transmits();
                       }) &&
           std::all_of(placements.begin(), placements.end(), [](const Placement& placement) {
               return placement.scale >= 0x1p-20 && placement.scale <= 0x1p20 &&
                      is_ordinary(placement.translate);
           });
}

ShapeId SceneBuilder::add_copies(std::span<const Solid> members,
                                 std::vector<Placement> placements) {
    const std::size_t count =
        checked_parts(members, [&](const Solid& member) { check_member(member); });
    const auto check_placements = [&](const auto& check) {
        for (std::size_t i = 0; i < placements.size(); ++i) {
            try {
                check(placements[i]);
            } catch (const InvalidValue& invalid) {
                throw InvalidValue("placements/" + std::to_string(i) + "/" + invalid.field,
                                   invalid.expectation);
            }
        }
    };
    check_placements([](const Placement& placement) { validate(placement); });
    require_room(count * placements.size());
    const auto first = static_cast<ShapeId>(shape_count());
    if (!keeps_copies(members, placements)) {
        // All are checked before one is added.
        check_placements([&](const Placement& placement) {
            const Transform transform = transform_of(placement);
            for (const Solid& member : members)
                check_member(transformed_member(member, transform));
        });
        const bool follow = std::any_of(members.begin(), members.end(),
                                        [&](const Solid& member) { return may_follow(member); });
        for (const Placement& placement : placements) {
            const Transform transform = transform_of(placement);
            std::optional<SpaceMover> mover;
            if (follow) mover.emplace(placement);
            for (const Solid& member : members) {
                Solid copy = transformed_member(member, transform);
                if (mover) (*mover)(copy);
                add_member(copy);
            }
        }
        return first;
    }
    MaterialIndices of_one;
    for (const Solid& member : members)
        of_one.push_back(member.material);
    scene_.material_of_.push_back_repeated(of_one, placements.size());
    kept_.push_back({{members.begin(), members.end()}, std::move(placements), first});
    return first;
}

void SceneBuilder::give_up_copies() {
    constexpr std::size_t max_given_up = std::size_t{1} << 26;
    std::size_t count = 0;
    for (const KeptCopies& copies : kept_)
        count += copies.members.size() * copies.placements.size();
    if (count > max_given_up)
        throw InvalidValue("", "must not be a constructed solid, as the scene's copies have " +
                                   std::to_string(count) + " shapes, more than " +
                                   std::to_string(max_given_up));
    scene_.material_of_ = scene_.material_of_.all_stored();
    for (const KeptCopies& copies : kept_) {
        ShapeId id = copies.first_id;
        for (const Placement& placement : copies.placements) {
            const Transform transform = transform_of(placement);
            for (const Solid& member : copies.members) {
                if (may_follow(member.material))
                    note_space(id, member.material, SpaceMover(placement)(member.space));
                std::visit(
                    [&]<class Shape>(const Shape& shape) {
                        std::get<ShapeList<InFloat<Shape>>>(lists_).add(shape, id++);
                    },
                    transform(member).shape);
            }
        }
    }
    kept_.clear();
}

void SceneBuilder::build_copies() {
    std::vector<Copies::Group> groups;
    for (KeptCopies& copies : kept_) {
        SceneBuilder builder;
        builder.scene_.materials_ = scene_.materials_;
        builder.wants_light = false;
        builder.merge_duplicates = merge_duplicates;
        builder.pack_from = std::numeric_limits<std::size_t>::max();
        for (const Solid& member : copies.members)
            builder.add_member(member);
        groups.push_back({std::make_shared<const Scene>(std::move(builder).build()),
                          std::move(copies.placements), copies.first_id});
    }
    scene_.copies_ = std::make_shared<const Copies>(std::move(groups), scene_.shapes_);
}

void SceneBuilder::reserve(std::size_t count) {
    scene_.material_of_.reserve(shape_count() + count);
}

void SceneBuilder::check_wavelengths() const {
    const std::string field = "spectrum/wavelengths";
    constexpr std::size_t most = 64;
    if (wavelengths.size() > most)
        throw InvalidValue(field,
                           "must be at most 64 numbers, got " + std::to_string(wavelengths.size()));
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
        const std::string place = field + "/" + std::to_string(i);
        if (!(wavelengths[i] >= 380.0 && wavelengths[i] <= 780.0))
            throw InvalidValue(place,
                               "must be from 380 to 780, got " + checks::text_of(wavelengths[i]));
        for (const Material& material : scene_.materials_)
            if (material.glass.any() && !is_index(index_at(material.glass, wavelengths[i])))
                throw InvalidValue(place,
                                   "must be a wavelength for which all glasses have an index "
                                   "of refraction, got " +
                                       checks::text_of(wavelengths[i]));
    }
}

void SceneBuilder::check_as_a_whole() const {
    validate_in("settings", settings);
    validate_in("camera", camera);
    validate_in("fog", fog);
    validate_color("background", background);
    check_wavelengths();
}

void SceneBuilder::build_shapes() {
    if (solids_.any()) solids_.list(lists_);
    Workers alone;
    Workers& threads = workers != nullptr ? *workers : alone;
    {
        const Duplicates duplicates(lists_, scene_.material_of_, scene_.polygons_,
                                    &solids_.solids(), merge_duplicates);
        scene_.merges_duplicates_ = merge_duplicates;
        scene_.hierarchy_ = build_hierarchy(lists_, duplicates, threads, scene_.shapes_);
        scene_.merged_ = duplicates.merged();
    }
    lists_ = {};
    scene_.material_of_.shrink_to_fit();
    std::erase_if(scene_.object_spaces_, [&](const auto& entry) {
        return !scene_.material_of(entry.first).pattern.follows_objects();
    });
    std::ranges::sort(scene_.object_spaces_, {}, [](const auto& entry) { return entry.first; });
    if (!kept_.empty())
        build_copies();
    else
        pack_spheres(std::get<Table<Sphere>>(scene_.shapes_), shape_count(), pack_from, threads);
    if (solids_.any()) scene_.solids_ = solids_.finish(scene_.shapes_);
}

void SceneBuilder::finish(const NameOfShape& name_of_shape) {
    scene_.find_transmissive();
    for (std::size_t i = 0; i < scene_.lights_.size(); ++i) {
        Light& light = scene_.lights_[i];
        if (light.kind != LightKind::point) continue;
        const ShapeId id = surface_through(scene_, light.position);
        if (id == no_shape) continue;
        if (on_light_moved)
            if (const auto beside = point_beside_surface(scene_, light.position, camera)) {
                light.position = *beside;
                on_light_moved(i);
                continue;
            }
        const std::string name = name_of_shape ? name_of_shape(id) : "";
        throw Scene::light_on(i, name.empty() ? "shape " + std::to_string(id) : name);
    }
    scene_.camera_ = camera;
    scene_.background_ = background;
    scene_.fog_ = fog;
    scene_.settings_ = settings;
    scene_.wavelengths_ = wavelengths;
    scene_.own_light_count_ = scene_.lights_.size();
}

Scene SceneBuilder::build(const NameOfShape& name_of_shape) && {
    check_as_a_whole();
    if (wants_light && !auto_camera.lights && scene_.lights_.empty() && shape_count() > 0)
        throw InvalidValue("lights", "must have at least one light if there are objects, got none");
    build_shapes();
    finish(name_of_shape);
    if (!auto_camera.any()) return std::move(scene_);
    const View view = staged(scene_, auto_camera, settings);
    return std::move(scene_).seen(auto_camera, view);
}

Scene SceneBuilder::build(BuiltShapes shapes) && {
    if (shape_count() > 0) throw InvalidValue("objects", "must be empty if built shapes are given");
    check_as_a_whole();
    Workers alone;
    check(shapes, scene_.materials_.size(), workers != nullptr ? *workers : alone);
    scene_.shapes_ = std::move(shapes.tables);
    scene_.material_of_ = std::move(shapes.material_of);
    scene_.polygons_ = std::move(shapes.polygons);
    scene_.merged_ = std::move(shapes.merged);
    scene_.hierarchy_ = std::move(shapes.hierarchy);
    finish(nullptr);
    scene_.auto_camera_ = shapes.auto_camera;
    scene_.own_light_count_ = std::min(shapes.own_light_count, scene_.lights_.size());
    return std::move(scene_);
}

Scene Scene::seen(const AutoCamera& auto_camera, const View& view) && {
    validate_in("camera", view.camera);
    validate_in("fog", view.fog);
    for (const Light& light : view.lights)
        validate(light);
    auto_camera_ = auto_camera;
    camera_ = view.camera;
    fog_ = view.fog;
    lights_.resize(own_light_count_);
    lights_.insert(lights_.end(), view.lights.begin(), view.lights.end());
    return std::move(*this);
}

Scene Scene::seen_by(const Camera& camera) && {
    AutoCamera auto_camera = auto_camera_;
    auto_camera.fit_camera.reset(); // the new camera's position is given
    Scene same = std::move(*this).seen(auto_camera, {camera, fog_, {}});
    if (!auto_camera.any()) return same;
    const View view = staged(same, auto_camera, same.settings());
    return std::move(same).seen(auto_camera, view);
}

InvalidValue Scene::light_on(std::size_t light, const std::string& shape) {
    return {"lights/" + std::to_string(light) + "/position",
            "must not be on a surface, got a point of " + shape};
}

template <class Number>
Scene Scene::with_positions(std::span<const Number> coordinates, Workers& workers) const {
    if (copies_ != nullptr)
        throw InvalidValue("positions", "must be for a scene without kept copies of groups");
    for (const Material& material : materials_)
        if (material.pattern.follows_objects() && material.pattern.kind != PatternKind::image)
            throw InvalidValue("positions", "must be for a scene without patterns in object space");
    Scene scene = *this;
    move_spheres(coordinates,
                 {scene.shapes_, scene.hierarchy_,
                  scene.merged_[static_cast<std::size_t>(Kind::sphere)], material_of_, polygons_,
                  solids_, merges_duplicates_},
                 workers);
    if (solids_.any()) scene.solids_.find_places(scene.shapes_);
    scene.transmissive_ = {};
    scene.find_transmissive();
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (lights_[i].kind != LightKind::point) continue;
        const ShapeId id = surface_through(scene, lights_[i].position);
        if (id != no_shape) throw light_on(i, "shape " + std::to_string(id));
    }
    return auto_camera_.any() ? std::move(scene).seen_by(camera_) : scene;
}

template Scene Scene::with_positions(std::span<const float>, Workers&) const;
template Scene Scene::with_positions(std::span<const double>, Workers&) const;

#define RAYLANE_INSTANTIATE(Shape, name, text)                                                     \
    template ShapeId SceneBuilder::add(const Shape&, MaterialIndex);                               \
    template ShapeId SceneBuilder::add(const InDouble<Shape>&, MaterialIndex);
RAYLANE_SHAPES(RAYLANE_INSTANTIATE)
#undef RAYLANE_INSTANTIATE
template ShapeId SceneBuilder::add_polygon(std::span<const Triangle>, MaterialIndex);
template ShapeId SceneBuilder::add_polygon(std::span<const InDouble<Triangle>>, MaterialIndex);
template ShapeId SceneBuilder::add_polygon(std::span<const SmoothTriangle>, MaterialIndex);
template ShapeId SceneBuilder::add_polygon(std::span<const InDouble<SmoothTriangle>>,
                                           MaterialIndex);

} // namespace raylane::core
