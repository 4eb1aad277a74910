#include "bench/peers/measure.hpp"
#include "simd/query/tracing.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::bench {

namespace {

/// Returns the number of pixels that differ visibly: by more than 1 of 255 steps in some channel.
std::size_t different_pixels(const core::Film& a, const core::Film& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        float most = 0.0F;
        for (int channel = 0; channel < 3; ++channel)
            most = std::max(most, std::abs(std::min(a.pixels()[i][channel], 1.0F) -
                                           std::min(b.pixels()[i][channel], 1.0F)));
        different += static_cast<std::size_t>(most > 1.0F / 255.0F);
    }
    return different;
}

Drawing own_drawing(const std::string& name, const simd::SceneData& scene, simd::Isa isa,
                    core::Precision precision) {
    const simd::Tracing tracing{&simd::kernels_of(isa), precision};
    return {name,
            [&scene, tracing](const core::Settings& settings, const simd::RenderOptions& options) {
                return simd::render_vector(scene, settings, options, tracing);
            }};
}

} // namespace

Row measure_image(const simd::SceneData& scene, const Measuring& how) {
    std::vector<Drawing> drawings = {
        own_drawing("raylane", scene, how.isa, core::Precision::exact),
        own_drawing("raylane robust", scene, how.isa, core::Precision::robust)};
    for (Drawing& drawing : embree_drawings(scene, how.isa))
        drawings.push_back(std::move(drawing));

    core::Settings settings = scene.scene().settings();
    settings.width = settings.height = how.side;
    settings.grid = 1;
    std::vector<std::optional<core::Film>> films(drawings.size());
    std::vector<TimedRun> runs;
    for (std::size_t i = 0; i < drawings.size(); ++i)
        runs.push_back({drawings[i].name, [&, i](int threads) {
                            const simd::RenderOptions options{.threads = threads};
                            return seconds_of(
                                [&] { films[i] = drawings[i].draw(settings, options).film; });
                        }});
    Row row{"picture", 0, /*is_speed=*/false, alternate(runs, how)};
    row.count = films[0]->pixels().size();
    for (std::size_t i = 0; i < films.size(); ++i)
        row.by[i].wrong = different_pixels(*films[i], *films[0]);
    return row;
}

} // namespace raylane::bench
