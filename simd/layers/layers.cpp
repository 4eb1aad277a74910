#include "simd/layers/layers.hpp"

namespace raylane::simd {

void fill_layers(FirstHits& tracer, const core::Region& region, const core::Region& of,
                 core::Layers& layers) {
    std::vector<FirstHit> hits;
    tracer.trace(region, 1, hits);
    auto hit = hits.begin();
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x, ++hit) {
            const std::size_t pixel = layers.index(x - of.x0, y - of.y0);
            layers.depth[pixel] = static_cast<float>(hit->t);
            layers.normal[pixel] = core::convert<float>(hit->shading_normal);
            layers.shape[pixel] = hit->shape;
            layers.material[pixel] = hit->material;
        }
}

} // namespace raylane::simd
