#include "scenes/formats/tachyon/reader.hpp"

#include "core/scene/validate.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/tachyon/objects.hpp"
#include "scenes/formats/tachyon/surroundings.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace raylane::scenes {

namespace {

using core::InvalidValue;

class Reader {
  public:
    Reader(InputFile& file, core::Workers* workers, const OnRemark& on_remark,
           const TachyonShading& over)
        : file_(file), words_(file, on_remark), over_(over), shading_(over),
          objects_(builder_, words_, shading_) {
        builder_.workers = workers;
        builder_.wants_light = false;
        builder_.on_light_moved = [this](std::size_t) {
            words_.remark("LIGHT: a light on a surface is moved off it");
        };
    }
    core::Scene read();

  private:
    void read_statement();
    void read_resolution();
    void read_sky_light();
    void add_lights();
    core::Scene build();

    InputFile& file_;
    TachyonWords words_;
    const TachyonShading& over_;
    TachyonShading shading_;
    core::SceneBuilder builder_;
    TachyonObjects objects_;
    TachyonCamera camera_;
    std::optional<TachyonFog> fog_;
    std::vector<core::Light> lights_;
    ShapeReserve reserve_;
};

core::Scene Reader::read() {
    if (!words_.next_statement() || !is_keyword(words_.statement(), "BEGIN_SCENE"))
        words_.refuse_statement("must be BEGIN_SCENE at the start of a scene");
    for (;;) {
        if (!words_.next_statement())
            throw BadInput(file_.name(), "", "must end with END_SCENE, got a truncated file");
        if (is_keyword(words_.statement(), "END_SCENE")) break;
        try {
            read_statement();
        } catch (const InvalidValue& invalid) {
            words_.refuse(invalid);
        }
        reserve_.update(builder_, words_.bytes_passed(), file_);
    }
    return build();
}

void Reader::read_statement() {
    if (objects_.read()) return;
    const auto is = [this](std::string_view word) { return is_keyword(words_.statement(), word); };
    if (is("RESOLUTION")) {
        read_resolution();
    } else if (is("SHADER_MODE")) {
        TachyonShading shading;
        read_shader_mode(words_, shading);
        shading_ = shading.overridden_by(over_);
    } else if (is("CAMERA")) {
        camera_ = read_camera(words_);
    } else if (is("LIGHT")) {
        lights_.push_back(read_point_light(words_));
    } else if (is("DIRECTIONAL_LIGHT")) {
        lights_.push_back(read_directional_light(words_));
    } else if (is("SPOTLIGHT")) {
        lights_.push_back(read_spotlight(words_));
    } else if (is("SKY_LIGHT")) {
        read_sky_light();
    } else if (is("BACKGROUND")) {
        builder_.background = words_.triple("color");
        core::validate_color("color", builder_.background);
    } else if (is("BACKGROUND_GRADIENT")) {
        builder_.background = read_background_gradient(words_);
        core::validate_color("color", builder_.background);
    } else if (is("FOG")) {
        fog_ = read_fog(words_);
    } else if (is("INCLUDE")) {
        words_.include(std::string(words_.take()));
    } else {
        words_.refuse_statement("must be an object or another statement of Tachyon");
    }
    if (!lights_.empty()) core::validate(lights_.back());
}

void Reader::read_resolution() {
    core::Settings& settings = builder_.settings;
    settings.width = words_.whole_number("width", 1, core::Settings::max_size);
    settings.height = words_.whole_number("height", 1, core::Settings::max_size);
    core::validate(settings);
}

void Reader::read_sky_light() {
    words_.expect("NUMSAMPLES");
    const int samples = words_.whole_number("NUMSAMPLES", 0, std::numeric_limits<int>::max());
    const core::Color color = words_.named_triple("COLOR");
    if (!over_.sky) shading_.sky = color;
    if (!over_.sky_samples) shading_.sky_samples = samples;
}

/// Adds the lights. The sky gives light if shadows are rendered; all other lights are scaled by
/// `direct`.
void Reader::add_lights() {
    using Quality = TachyonShading::Quality;
    const Quality quality = shading_.quality_or_full();
    for (core::Light& light : lights_) {
        light.color *= shading_.direct.value_or(1.0F);
        builder_.add_light(light);
    }
    if (quality == Quality::no_shadows && !lights_.empty())
        words_.remark("SHADER_MODE MEDIUM is not supported: objects cast shadows, same as FULL");
    if (quality != Quality::full || !shading_.sky) return;
    core::Light sky{.kind = core::LightKind::sky, .color = *shading_.sky, .ground = *shading_.sky};
    builder_.add_light(sky);
    if (shading_.sky_samples)
        builder_.settings.light_samples =
            std::clamp(*shading_.sky_samples, 1, core::Settings::max_light_samples);
}

core::Scene Reader::build() {
    try {
        if (shading_.ray_depth) camera_.ray_depth = *shading_.ray_depth;
        set_camera(builder_, camera_);
        add_lights();
        if (fog_ && shading_.quality_or_full() != TachyonShading::Quality::flat)
            set_fog(builder_, *fog_, camera_, shading_.planar_fog.value_or(false), words_);
        if (shading_.max_transparent_surfaces)
            builder_.settings.max_transparent = std::clamp(*shading_.max_transparent_surfaces, 1,
                                                           core::Settings::transparent_limit);
        return std::move(builder_).build();
    } catch (const InvalidValue& invalid) {
        throw BadInput(file_.name(), "", invalid.what());
    }
}

} // namespace

core::Scene read_tachyon(InputFile& file, core::Workers* workers, const OnRemark& on_remark,
                         const TachyonShading& over) {
    return Reader(file, workers, on_remark, over).read();
}

} // namespace raylane::scenes
