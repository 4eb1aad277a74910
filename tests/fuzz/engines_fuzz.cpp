#include "simd/wavefront/render.hpp"
#include "tests/fuzz/shapes.hpp"

#include <string>

/// Renders small images of any scene. If shapes only show their colours, both engines must give the
/// same image. For any scene, the vector engine must give the same bits with other instruction
/// sets.
using namespace raylane;
using namespace raylane::fuzz;

namespace {

core::Material any_material(Bytes& bytes, bool plain) {
    core::Material material;
    const int look = bytes.byte();
    material.pattern.colors[0] =
        core::Color(static_cast<float>(look % 7), static_cast<float>(look % 5), 1.0F);
    material.visible = static_cast<core::Visible>(bytes.below(8) % 5 % 3);
    if (plain) { // rays that go on behind transparent surfaces start at a rounded point
        material.ambient = 1.0F;
        material.diffuse = 0.0F;
        return material;
    }
    if (bytes.below(4) == 0) material.opacity = static_cast<float>(bytes.below(5)) / 4.0F;
    const int sort = bytes.byte();
    material.specular = (sort & 1) != 0 ? 0.5F : 0.0F;
    material.reflectivity = (sort & 2) != 0 ? 0.75F : 0.0F;
    material.transmission = (sort & 4) != 0 ? 1.0F : 0.0F;
    material.reflection = static_cast<core::Reflection>((sort >> 3) % 3);
    material.index = 0.5F + static_cast<float>(bytes.below(32)) / 16.0F;
    if ((sort & 64) != 0) material.absorption = core::Vec3f(0.1F, 1.0F, 0.0F);
    return material;
}

void add_lights(Bytes& bytes, core::SceneBuilder& builder) {
    for (int i = bytes.below(3); i > 0; --i) {
        const core::Light light{.kind = static_cast<core::LightKind>(bytes.below(6)),
                                .position = bytes.vector<float>(),
                                .direction = bytes.vector<float>(),
                                .radius = std::abs(bytes.number<float>()),
                                .edge_u = bytes.vector<float>(),
                                .edge_v = bytes.vector<float>()};
        try {
            builder.add_light(light);
        } catch (const core::InvalidValue&) { // one light less
        }
    }
}

std::optional<core::Scene> any_scene(Bytes& bytes, bool plain) {
    core::SceneBuilder builder;
    builder.wants_light = false;
    builder.background = core::Color(0.5F, 0.25F, 8.0F);
    constexpr int materials = 4;
    for (int i = 0; i < materials; ++i)
        builder.add_material(any_material(bytes, plain));
    core::Settings& settings = builder.settings;
    settings.width = settings.height = 8;
    settings.grid = 1 + bytes.below(2);
    settings.max_depth = plain ? 0 : bytes.below(6);
    settings.max_transparent = 1 + bytes.below(8);
    settings.transparent_shadows = bytes.below(4) != 0;
    settings.light_samples = 1 + bytes.below(3);
    builder.camera.projection = static_cast<core::Projection>(bytes.below(2));
    builder.camera.from = bytes.vector<float>();
    builder.camera.at = bytes.vector<float>();
    if (bytes.below(8) == 0) builder.camera.lens_radius = 0.125F;
    if (!plain) add_lights(bytes, builder);
    core::MaterialIndex next = 0;
    for (const AnyShapeInDouble& any : shapes_of<AnyShapeInDouble>(bytes))
        std::visit([&](const auto& shape) { builder.add(shape, next++ % materials); }, any);
    try {
        return std::move(builder).build();
    } catch (const core::InvalidValue&) { // a camera that looks nowhere
        return std::nullopt;
    }
}

std::vector<core::Color> image(const core::Scene& scene, const simd::RenderOptions& options) {
    const simd::Rendering rendering = simd::render(scene, scene.settings(), options);
    if (!rendering.complete) found("not complete");
    return rendering.film.pixels();
}

void check_same(const std::vector<core::Color>& a, const std::vector<core::Color>& b,
                const char* what) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i] && !(std::isnan(a[i].x) && std::isnan(b[i].x)))
            found(std::string(what) + ": pixel " + std::to_string(i) + ", " +
                  std::to_string(a[i].x) + " " + std::to_string(a[i].y) + " and " +
                  std::to_string(b[i].x) + " " + std::to_string(b[i].y));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const bool plain = bytes.flag();
    const std::optional<core::Scene> scene = any_scene(bytes, plain);
    if (!scene) return 0;
    simd::RenderOptions options;
    options.threads = 1;
    const std::vector<core::Color> by_best = image(*scene, options);
    for (const core::Color& color : by_best)
        if (!(color.x >= 0.0F && color.y >= 0.0F && color.z >= 0.0F)) found("no colour");
    options.isa = simd::narrowest_isa();
    options.tile = 8;
    check_same(by_best, image(*scene, options), "by another instruction set");
    options.engine = simd::Engine::reference;
    const std::vector<core::Color> by_reference = image(*scene, options);
    if (plain) check_same(by_best, by_reference, "by the reference");
    return 0;
}
