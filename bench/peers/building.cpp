#include "bench/by_id.hpp"
#include "bench/peers/measure.hpp"

namespace raylane::bench {

namespace {

/// Returns a builder with the scene's shapes, kind by kind.
core::SceneBuilder shapes_of(const core::Scene& scene) {
    core::SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        builder.reserve(table.size());
        for (const auto& [id, place] : places_by_id(table))
            builder.add(table.get(place), 0);
    });
    return builder;
}

} // namespace

Row measure_building(const core::Scene& scene, const Measuring& how) {
    std::vector<TimedRun> runs = {{"raylane", [&](int /*threads*/) {
                                       core::SceneBuilder builder = shapes_of(scene);
                                       std::optional<core::Scene> built;
                                       std::optional<simd::SceneData> data;
                                       return seconds_of([&] {
                                           built = std::move(builder).build();
                                           data.emplace(*built);
                                       });
                                   }}};
    if (auto peer = embree_building(scene, how.isa)) runs.push_back(std::move(*peer));
    Measuring alone = how;
    alone.threads = 1;
    return {"build", scene.shape_count(), /*is_speed=*/false, alternate(runs, alone)};
}

} // namespace raylane::bench
