#pragma once

#include "core/scene/solid_description.hpp"
#include "core/solids/transform.hpp"
#include "tests/support/any_shape.hpp"

#include <vector>

namespace raylane::tests {

/// A copy of a scene whose lengths are all multiplied by `factor`, a power of two. A formula has
/// no scale, so its material becomes a plain one for any factor.
class ScaledScene {
  public:
    ScaledScene(const core::Scene& scene, float factor)
        : scene_(scene), factor_(factor), placing_(Vec3f(0), factor) {}

    core::Scene build() const {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.background = scene_.background();
        builder.settings = scene_.settings();
        builder.camera = scene_.camera();
        builder.camera.from *= factor_;
        builder.camera.at *= factor_;
        builder.camera.height *= factor_;
        builder.camera.lens_radius *= factor_;
        builder.camera.focus_distance *= factor_;
        builder.fog = scene_.fog();
        builder.fog.start *= factor_;
        builder.fog.end *= factor_;
        builder.fog.density /= factor_;
        for (core::Light light : scene_.lights()) {
            light.position *= factor_;
            light.radius *= factor_;
            light.edge_u *= factor_;
            light.edge_v *= factor_;
            light.reach *= factor_;
            builder.add_light(light);
        }
        for (const core::Material& material : scene_.materials())
            builder.add_material(scaled(material));
        builder.wavelengths = scene_.wavelengths();
        add_shapes(builder);
        return std::move(builder).build();
    }

  private:
    core::Material scaled(core::Material material) const {
        core::Pattern& pattern = material.pattern;
        if (pattern.kind == core::PatternKind::formula) pattern.kind = core::PatternKind::solid;
        pattern.size *= factor_;
        pattern.from *= factor_;
        pattern.to *= factor_;
        material.absorption /= factor_;
        return material;
    }

    void add_shapes(core::SceneBuilder& builder) const {
        std::vector<AnyShape> shapes(scene_.shape_count());
        core::for_each_table(scene_.shapes(), [&](const auto& table) {
            for (const auto& block : table.blocks())
                for (int lane = 0; lane < core::block_size; ++lane)
                    if (block.ids[lane] != core::no_shape)
                        shapes[block.ids[lane]] = placing_(block.get(lane));
        });
        const core::Solids& solids = scene_.solids();
        for (core::ShapeId id = 0; id < shapes.size();) {
            if (solids.has(id)) {
                const core::Solids::Index solid = solids.root_of(solids.part_of(id));
                const core::Solid described = core::description_of(scene_, solid);
                const auto scaling =
                    core::Transform::scaling(core::Vec3d(static_cast<double>(factor_)));
                builder.add_solid(scaling(described), described.material);
                while (id < shapes.size() && solids.has(id) &&
                       solids.root_of(solids.part_of(id)) == solid)
                    ++id;
                continue;
            }
            const core::IdRange range = scene_.coplanar_with(id);
            std::visit([&](const auto& shape) { add(builder, shape, shapes, range); }, shapes[id]);
            id = range.last + 1;
        }
    }

    template <class Shape>
    void add(core::SceneBuilder& builder, const Shape& first, const std::vector<AnyShape>& shapes,
             const core::IdRange& range) const {
        const core::MaterialIndex material = scene_.material_index_of(range.first);
        if constexpr (Nature<Shape>::tiles_polygons) {
            if (range.first != range.last) {
                std::vector<Shape> polygon;
                for (core::ShapeId id = range.first; id <= range.last; ++id)
                    polygon.push_back(std::get<Shape>(shapes[id]));
                builder.add_polygon<Shape>(polygon, material);
                return;
            }
        }
        builder.add(first, material);
    }

    const core::Scene& scene_;
    float factor_;
    Placing placing_;
};

} // namespace raylane::tests
