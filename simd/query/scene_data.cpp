#include "simd/query/scene_data.hpp"

#include "core/reference/containing.hpp"
#include "core/shapes/rounded_to_floats.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unistd.h>
#include <utility>

namespace raylane::simd {

namespace {

/// Number of shapes up to which testing all of them costs less than the hierarchy.
constexpr std::size_t few_shapes = 24;

/// Up to this number of slots, records are looked up in a table instead of being computed. The
/// table takes 1.3 MB, of which a tile needs little.
constexpr std::uint32_t table_slots = 1U << 16;

/// Returns the size in bytes of a core's own cache. A larger tree is fetched ahead of the rays.
/// That gains 5 to 15 % at a million spheres (measured on a noisy machine), and costs time where
/// the tree fits.
///
/// A thousand rays that are not near each other go by lists in trees of up to a sixteenth of that
/// size, and each by itself in larger ones. Lists gain 1.1 times at 1,000 balls, lose as much at
/// 3,000, and 1.3 times at 10,000 (2 MB; 1.4 and 1.0 at 1,000 and 10,000 shapes of a lattice of
/// balls and sticks). Lists of 8,192 rays gain 1.2 times at 10,000, nothing at 50,000 (1.5 MB), and
/// lose 1.3 times at 100,000.
std::size_t core_cache_bytes() {
#ifdef _SC_LEVEL2_CACHE_SIZE
    if (const long bytes = ::sysconf(_SC_LEVEL2_CACHE_SIZE); bytes > 0)
        return static_cast<std::size_t>(bytes);
#endif
    return std::size_t{1} << 20;
}

MaterialView view_of(const core::Material& material) {
    MaterialView view{};
    if (material.opacity == 0.0F) return view;
    view.ambient = static_cast<double>(material.ambient);
    view.diffuse = static_cast<double>(material.diffuse);
    view.specular = static_cast<double>(material.specular);
    view.exponent = static_cast<double>(material.exponent);
    view.reflectivity = static_cast<double>(material.reflectivity);
    view.transmission = static_cast<double>(material.transmission);
    view.index = static_cast<double>(material.index);
    view.opacity = static_cast<double>(material.opacity);
    view.reflection = material.reflection;
    view.highlight = material.highlight;
    view.transmits = material.transmits();
    view.reflects = material.reflects();

    const core::Pattern& pattern = material.pattern;
    view.pattern = pattern.kind;
    view.axes = pattern.axes;
    view.size = static_cast<double>(pattern.size);
    if (pattern.kind == core::PatternKind::formula) view.formula = &pattern.formula.program();
    view.is_on_surface = pattern.is_on_surface();
    view.in_object_space = pattern.follows_objects() && !view.is_on_surface;
    const core::Vec3d direction = core::normalized(core::convert<double>(pattern.direction));
    const core::Vec3d run = core::convert<double>(pattern.to) - core::convert<double>(pattern.from);
    for (int axis = 0; axis < 3; ++axis) {
        for (int which = 0; which < 2; ++which)
            view.colors[which][axis] = static_cast<double>(pattern.colors[which][axis]);
        view.direction[axis] = direction[axis];
        view.from[axis] = static_cast<double>(pattern.from[axis]);
        view.run[axis] = run[axis] / core::squared_length(run);
    }
    return view;
}

LightView view_of(const core::Light& light) {
    LightView view{};
    view.is_point = light.kind == core::LightKind::point;
    const core::Vec3d to_light = -core::normalized(core::convert<double>(light.direction));
    for (int axis = 0; axis < 3; ++axis) {
        view.position[axis] = static_cast<double>(light.position[axis]);
        view.to_light[axis] = to_light[axis];
        view.color[axis] = static_cast<double>(light.color[axis]);
    }
    return view;
}

FogView view_of(const core::Fog& fog) {
    FogView view{};
    view.kind = fog.kind;
    for (int axis = 0; axis < 3; ++axis)
        view.color[axis] = static_cast<double>(fog.color[axis]);
    view.start = static_cast<double>(fog.start);
    view.end = static_cast<double>(fog.end);
    view.density = static_cast<double>(fog.density);
    return view;
}

PackedView view_of(const core::PackedSpheres& packed) {
    static_assert(sizeof(PackedBlockView) == sizeof(core::PackedBlock));
    static_assert(offsetof(PackedBlockView, own_rows) == offsetof(core::PackedBlock, own_rows));
    static_assert(offsetof(PackedBlockView, steps) == offsetof(core::PackedBlock, steps));
    static_assert(offsetof(PackedBlockView, words) == offsetof(core::PackedBlock, words));
    static_assert(core::PackedBlock::empty == no_slot);
    // Without a tree, kernels read shapes where they are stored, so these must not be packed.
    static_assert(core::min_packed > few_shapes);
    static_assert(sizeof(core::PackedSpheres::Row) == sizeof(float[core::block_size]));
    return {reinterpret_cast<const PackedBlockView*>(packed.blocks.data()),
            reinterpret_cast<const float(*)[core::block_size]>(packed.rows.data()),
            packed.palette.radii(),
            static_cast<std::uint32_t>(packed.palette.size()),
            static_cast<std::uint32_t>(packed.palette.id_bits()),
            packed.palette.id_mask()};
}

std::uint32_t depth_below(const core::BigArray<core::WideNode>& nodes, std::uint32_t index) {
    std::uint32_t deepest = 0;
    for (const core::Child child : nodes[index].children)
        if (!child.empty() && !child.is_block())
            deepest = std::max(deepest, depth_below(nodes, child.index()));
    return deepest + 1;
}

/// See SceneView::orders.
std::vector<std::uint64_t> orders_of(const core::BigArray<core::WideNode>& nodes) {
    std::vector<std::uint64_t> orders;
    orders.reserve(8 * nodes.size());
    for (const core::WideNode& node : nodes)
        for (int octant = 0; octant < 8; ++octant) {
            std::array<std::pair<float, int>, core::block_size> entries;
            for (int entry = 0; entry < core::block_size; ++entry) {
                float distance = 0.0F;
                for (int axis = 0; axis < 3; ++axis) {
                    const float center =
                        0.5F * node.lower[axis][entry] + 0.5F * node.upper[axis][entry];
                    distance += (octant >> axis & 1) != 0 ? -center : center;
                }
                entries[entry] = {node.children[entry].empty()
                                      ? std::numeric_limits<float>::infinity()
                                      : distance,
                                  entry};
            }
            std::sort(entries.begin(), entries.end());
            std::uint64_t order = 0;
            for (int k = core::block_size; k-- > 0;)
                order = order << 4 | static_cast<unsigned>(entries[k].second);
            orders.push_back(order);
        }
    return orders;
}

float largest_coordinate(const core::Bounds& bounds) {
    float largest = 0.0F;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis])});
    return largest;
}

} // namespace

SceneData::SceneData(const core::Scene& scene, Transmissive transmissive)
    : scene_(scene), fog_(view_of(scene.fog())) {
    view_surroundings();
    view_tables();
    fill_records();
    view_hierarchy();
    find_plain_lanes(transmissive);
    clip_planes_.find(scene_, view_, slots_);
    if (transmissive == Transmissive::is_skipped) skip_passed_lanes();
    if (scene_.copies() != nullptr) view_copies(transmissive);
}

void SceneData::view_copies(Transmissive transmissive) {
    for (const core::Copies::Set& set : scene_.copies()->sets())
        prototypes_.push_back(std::make_unique<const SceneData>(*set.prototype, transmissive));
    core::Bounds bounds = scene_.hierarchy().bounds;
    bounds.include(scene_.copies()->bounds());
    radius_ = 0.5F * core::length(core::Vec3f(bounds.upper - bounds.lower));
    view_with_copies_ = view_;
    core::for_each_table(scene_.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        view_with_copies_.tables[static_cast<int>(core::kind_of<Shape>)].block_count +=
            static_cast<std::uint32_t>(table.copied_blocks());
    });
}

void SceneData::view_surroundings() {
    media_.push_back({0.0, 1.0, {0.0, 0.0, 0.0}});
    for (const core::Material& material : scene_.materials()) {
        materials_.push_back(view_of(material));
        media_.push_back({1.0,
                          static_cast<double>(material.index),
                          {static_cast<double>(material.absorption[0]),
                           static_cast<double>(material.absorption[1]),
                           static_cast<double>(material.absorption[2])}});
    }
    materials_.emplace_back(); // opacity 0
    for (const core::Light& light : scene_.lights())
        if (core::is_soft(light.kind))
            soft_lights_.push_back(core::prepared(light));
        else
            lights_.push_back(view_of(light));
}

void SceneData::view_tables() {
    double rounding = 0.0;
    core::for_each_table(scene_.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        const auto kind = static_cast<int>(core::kind_of<Shape>);
        const auto blocks = static_cast<std::uint32_t>(table.block_count());
        view_.tables[kind] = {reinterpret_cast<const float*>(table.plain_blocks().data()),
                              blocks,
                              sizeof(core::Block<Shape>) / sizeof(float),
                              core::number_count<Shape>,
                              slots_,
                              reinterpret_cast<const double*>(table.doubles().data()),
                              table.is_packed() ? view_of(*table.packed()) : PackedView{}};
        slots_ += (blocks + static_cast<std::uint32_t>(table.copied_blocks())) * core::block_size;
        if (table.has_doubles())
            core::for_each_shape(table, [&](const auto& shape, core::ShapeId) {
                rounding = std::max(rounding, core::change_in_floats(shape));
            });
        if (table.size() == 0) return;
        (core::is_bounded<Shape> ? bounded_kinds_ : unbounded_kinds_) |= 1U << kind;
        smooth_ |= core::has_shading_normals<Shape>;
    });
    view_.rounding = static_cast<float>(rounding * (1.0 + 0x1p-20)); // rounded up
}

void SceneData::fill_records() {
    if (slots_ > table_slots || scene_.copies() != nullptr) return;
    std::vector<ShapeRecord> records;
    for (std::uint32_t slot = 0; slot < slots_; ++slot)
        records.push_back(find_record(slot));
    records_ = std::move(records);
}

void SceneData::view_hierarchy() {
    static_assert(sizeof(NodeView) == sizeof(core::WideNode));
    const core::BigArray<core::WideNode>& nodes = scene_.hierarchy().nodes;
    view_.nodes = reinterpret_cast<const NodeView*>(nodes.data());
    std::size_t bytes = scene_.hierarchy().bytes();
    core::for_each_table(scene_.shapes(), [&](const auto& table) { bytes += table.bytes(); });
    view_.large = bytes > core_cache_bytes();
    view_.small = bytes <= core_cache_bytes() / 16;
    if (scene_.material_indices().stored_count() <= few_shapes || nodes.empty()) return;
    view_.tree_depth = depth_below(nodes, 0);
    orders_ = orders_of(nodes);
    view_.orders = orders_.data();
    const core::Bounds& bounds = scene_.hierarchy().bounds;
    view_.reach = largest_coordinate(bounds);
    radius_ = 0.5F * core::length(core::Vec3f(bounds.upper - bounds.lower));
}

/// Returns false if certainly no camera ray starts inside of a solid.
bool SceneData::may_see_inside(core::Solids::Index solid) const {
    const core::Camera& camera = scene_.camera();
    const core::Bounds& bounds = scene_.solids().bounds(solid);
    const core::Vec3d from = core::convert<double>(camera.from);
    // All camera rays start in one plane, with or without a lens.
    const core::Vec3d forward = core::convert<double>(camera.at) - from;
    bool is_in_front = core::is_finite(bounds);
    for (int corner = 0; is_in_front && corner < 8; ++corner) {
        core::Vec3d to_corner;
        for (int axis = 0; axis < 3; ++axis)
            to_corner[axis] = static_cast<double>(
                                  ((corner >> axis & 1) != 0 ? bounds.upper : bounds.lower)[axis]) -
                              from[axis];
        is_in_front = core::dot(to_corner, forward) >
                      0x1p-40 * core::length(to_corner) * core::length(forward);
    }
    if (is_in_front) return false;
    if (camera.projection != core::Projection::perspective || camera.lens_radius > 0.0F)
        return true;
    return core::PointSearcher(scene_).side_of(solid, from) != core::Side::outside;
}

/// Returns false if the surface of another shape may reach into a solid's bounds.
bool SceneData::is_apart(core::Solids::Index solid) const {
    const core::Solids& solids = scene_.solids();
    const core::Bounds& bounds = solids.bounds(solid);
    bool apart = core::is_finite(bounds);
    core::for_each_table(scene_.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        if (!apart) return;
        core::for_each_shape(table, [&](const auto& shape, core::ShapeId id) {
            const core::Solids::Index part = solids.part_of(id);
            if (part != core::Solids::none && solid <= part && part < solids.node(solid).end)
                return;
            if constexpr (core::is_bounded<Shape>) {
                const core::Bounds other = core::bounds_of(shape);
                bool beside = false;
                for (int axis = 0; axis < 3; ++axis)
                    beside = beside || other.upper[axis] < bounds.lower[axis] ||
                             bounds.upper[axis] < other.lower[axis];
                apart = apart && beside;
            } else {
                apart = apart &&
                        core::inside_of(shape, core::somewhere_in(bounds)) != core::Value::unknown;
            }
        });
    });
    return apart;
}

/// Returns the lanes of each block whose shapes, by their ids, are sought, as bits.
template <class IsSought>
std::vector<std::uint16_t> SceneData::lanes_with(const IsSought& is_sought) const {
    std::vector<std::uint16_t> lanes;
    lanes.reserve(slots_ / core::block_size);
    core::for_each_table(scene_.shapes(), [&](const auto& table) {
        for (const auto& block : table.blocks()) {
            unsigned sought = 0;
            for (int lane = 0; lane < core::block_size; ++lane)
                if (block.ids[lane] != core::no_shape && is_sought(block.ids[lane]))
                    sought |= 1U << lane;
            lanes.push_back(static_cast<std::uint16_t>(sought));
        }
        lanes.resize(lanes.size() + table.copied_blocks());
    });
    return lanes;
}

/// Lets occlusion queries skip the shapes that light passes. If these hide opaque shapes of
/// their solid, rays that meet the opaque shapes are in doubt anyway.
void SceneData::skip_passed_lanes() {
    const std::vector<core::Material>& materials = scene_.materials();
    if (std::none_of(materials.begin(), materials.end(),
                     [](const core::Material& material) { return material.lets_light_pass(); }))
        return;
    skipped_lanes_ =
        lanes_with([&](core::ShapeId id) { return scene_.material_of(id).lets_light_pass(); });
    if (view_.only_cut_lanes != nullptr)
        for (std::size_t block = 0; block < slots_ / core::block_size; ++block)
            skipped_lanes_[block] =
                static_cast<std::uint16_t>(skipped_lanes_[block] | view_.only_cut_lanes[block]);
    view_.only_cut_lanes = skipped_lanes_.data();
}

void SceneData::find_plain_lanes(Transmissive transmissive) {
    const auto is_plain = [transmissive](const core::Material& material) {
        return (transmissive == Transmissive::blocks || !material.lets_light_pass()) &&
               material.visible == core::Visible::both;
    };
    const std::vector<core::Material>& materials = scene_.materials();
    const core::Solids& solids = scene_.solids();
    if (std::all_of(materials.begin(), materials.end(), is_plain) && !solids.any()) return;
    one_sided_ = std::any_of(materials.begin(), materials.end(), [](const core::Material& m) {
        return m.visible != core::Visible::both;
    });
    // A part whose whole inside belongs to the solid (`fills`) blocks all rays that start outside
    // of the solid, wherever the solid's surface is. Rays of images start outside, unless the
    // camera is inside, or they leave surfaces that are seen inside of an open solid.
    std::vector<bool> blocks(solids.nodes().size());
    for (core::Solids::Index solid = 0, end = 0; solid < blocks.size(); solid = end) {
        end = solids.node(solid).end;
        bool is_opaque = transmissive != Transmissive::blocks && !may_see_inside(solid);
        for (core::Solids::Index part = solid; is_opaque && part < end; ++part) {
            const core::ShapeId id = solids.node(part).shape;
            is_opaque = solids.node(part).op != core::Solids::Op::part || id == core::no_shape ||
                        is_plain(scene_.material_of(id));
        }
        is_opaque = is_opaque && (!solids.node(solid).open || is_apart(solid));
        for (core::Solids::Index part = solid; is_opaque && part < end; ++part)
            blocks[part] = solids.node(part).fills;
    }
    const auto is_plain_shape = [&](core::ShapeId id) {
        return solids.has(id) ? blocks[solids.part_of(id)] : is_plain(scene_.material_of(id));
    };
    plain_lanes_ = lanes_with(is_plain_shape);
    view_.plain_lanes = plain_lanes_.data();
}

SceneData::ShapeRecord SceneData::find_record(std::uint32_t slot) const {
    static_assert(no_slot == core::no_shape);
    const core::Kind kind = kind_of(slot);
    const std::uint32_t place = slot - view_.tables[static_cast<int>(kind)].first_slot;
    const core::ShapeId id = core::with_table(scene_.shapes(), kind, [place](const auto& table) {
        return table.id(
            {place / core::block_size, static_cast<std::uint8_t>(place % core::block_size)});
    });
    if (id == core::no_shape) return {id, {id, id}, 0, kind, false, 0, false};
    return {id,
            scene_.coplanar_with(id),
            scene_.material_index_of(id),
            kind,
            scene_.solids().is_reversed(id),
            scene_.medium_index_of(id),
            is_flat_part(id)};
}

core::Place SceneData::place_of(std::uint32_t slot) const {
    const std::uint32_t place = slot - view_.tables[static_cast<int>(kind_of(slot))].first_slot;
    return {place / core::block_size, static_cast<std::uint8_t>(place % core::block_size)};
}

core::BigArray<std::uint32_t> SceneData::slots_by_id() const {
    const core::MaterialIndices& ids = scene_.material_indices();
    core::BigArray<std::uint32_t> slots(ids.stored_count());
    std::fill(slots.begin(), slots.end(), no_slot);
    for (const TableView& table : view_.tables)
        for (std::uint32_t i = 0; i < core::block_size * table.block_count; ++i) {
            const core::ShapeId id = find_record(table.first_slot + i).id;
            if (id != core::no_shape) slots[ids.stored_index(id)] = table.first_slot + i;
        }
    return slots;
}

std::uint32_t SceneData::slot_in_copy(const core::Copies::Copy& copy, std::uint32_t slot) const {
    const core::Copies& copies = *scene_.copies();
    const SceneData& prototype =
        *prototypes_[static_cast<std::size_t>(&copy.set - copies.sets().data())];
    const core::Kind kind = prototype.kind_of(slot);
    core::Place place = prototype.place_of(slot);
    place.block = core::Copies::block_of(copy, kind, place.block);
    copies.make(kind, place.block);
    return slot_of(kind, place);
}

std::uint32_t SceneData::slot_of(core::Kind kind, core::Place place) const {
    return view_.tables[static_cast<int>(kind)].first_slot + core::block_size * place.block +
           place.lane;
}

} // namespace raylane::simd
