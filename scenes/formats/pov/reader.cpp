#include "scenes/formats/pov/reader.hpp"

#include "core/shapes/invalid_value.hpp"
#include "scenes/formats/pov/assembly.hpp"
#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/objects.hpp"
#include "scenes/formats/pov/surroundings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace raylane::scenes {

namespace {

using namespace pov;

pov::Source source_of(InputFile& file) {
    std::filesystem::path folder = std::filesystem::path(file.name()).parent_path();
    if (folder.empty()) folder = ".";
    std::string text = file.read_all();
    return {file.name(), std::move(text), folder};
}

/// Returns the number after `option` in a comment at the beginning of the text, or 0.
int told(std::string_view text, std::string_view option) {
    while (text.starts_with("//") || text.starts_with('\n') || text.starts_with('\r')) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::size_t at = line.find(option);
        if (at == std::string_view::npos) continue;
        int number = 0;
        const char* begin = line.data() + at + option.size();
        std::from_chars(begin, line.data() + line.size(), number);
        if (number > 0 && number <= core::Settings::max_size) return number;
    }
    return 0;
}

class Reader {
  public:
    Reader(InputFile& file, core::Workers* workers, const OnRemark& on_remark)
        : tokens_(source_of(file), on_remark), assembly_(builder_, tokens_) {
        builder_.workers = workers;
        builder_.wants_light = false;
        builder_.on_light_moved = [this](std::size_t i) {
            tokens_.remark(assembly_.lights[i].place, "lights on a surface are moved off it");
        };
    }

    core::Scene read() {
        const Place beginning = tokens_.peek().place;
        while (tokens_.peek().kind != TokenKind::end)
            read_statement();
        if (!has_camera_) set_camera(Camera{}, beginning);
        const bool has_fog = builder_.fog.kind != core::FogKind::none;
        if (has_fog && assembly_.fog_differs_at)
            tokens_.remark(*assembly_.fog_differs_at, "hollow is ignored in fog: fog fills exactly "
                                                      "the transparent objects without an ior");
        for (const LightSource& light : assembly_.lights) {
            if (light.is_dimmed && has_fog)
                tokens_.remark(
                    light.place,
                    "dimming of lights by fog is not supported: lights keep their brightness");
            try {
                builder_.add_light(light_of(light));
            } catch (const core::InvalidValue& invalid) {
                fail(light.place, invalid.what());
            }
        }
        set_image();
        try {
            return std::move(builder_).build();
        } catch (const core::InvalidValue& invalid) {
            fail(camera_place_, invalid.what());
        }
    }

  private:
    void read_statement() {
        const Token word = tokens_.peek();
        if (begins_object(tokens_, word)) return add(read_object(tokens_));
        if (tokens_.accept(";")) return;
        if (tokens_.accept("camera")) {
            const Camera camera = read_camera(tokens_);
            set_camera(camera, word.place);
        } else if (tokens_.accept("background")) {
            tokens_.expect("{");
            background_ = read_color(tokens_);
            tokens_.expect("}");
            has_background_ = true;
        } else if (tokens_.accept("default")) {
            read_default(tokens_);
        } else if (tokens_.accept("fog")) {
            builder_.fog = read_fog(tokens_);
        } else if (tokens_.accept("global_settings")) {
            const bool was_dark = settings_.ambient_light == 1.0;
            read_global_settings(tokens_, settings_);
            if (was_dark && settings_.ambient_light != 1.0 && builder_.shape_count() > 0)
                tokens_.remark(word.place, "ambient_light does not apply to the objects before it");
            assembly_.materials.ambient_light = settings_.ambient_light;
        } else if (tokens_.accept("sky_sphere")) {
            const Sky sky = read_sky(tokens_);
            if (!has_background_) background_ = sky.color;
            tokens_.remark(word.place, "sky_sphere is not supported: its mean colour is used");
        } else if (word.is("rainbow") || word.is("media")) {
            tokens_.next();
            tokens_.skip_braces();
            tokens_.remark(word.place, word.quoted() + " is ignored");
        } else {
            read_object(tokens_); // throws, with the reason
        }
    }

    /// Adds an object. Before the first camera, stores it: the camera decides whether z is negated.
    void add(Shared<Object> object) {
        tokens_.budget.count_words(Budget::words_of_item * object->count, object->place);
        added_lights_ += object->lights;
        if (added_lights_ > max_lights)
            fail(object->place, "must be one of at most " + std::to_string(max_lights) + " lights");
        if (has_camera_)
            assembly_.add(*object, tokens_.default_texture);
        else
            waiting_.push_back({std::move(object), tokens_.default_texture});
    }

    void set_camera(const Camera& camera, const Place& place) {
        const View view = view_of(camera, tokens_, place);
        if (has_camera_ && view.mirrored != mirrored_)
            fail(place, "must have the same handedness as the camera before it");
        camera_place_ = place;
        builder_.camera = view.camera;
        aspect_ = view.aspect;
        if (has_camera_) return;
        has_camera_ = true;
        mirrored_ = view.mirrored;
        if (mirrored_) assembly_.set_mirrored();
        for (const auto& [object, texture] : waiting_)
            assembly_.add(*object, texture);
        waiting_.clear();
    }

    void set_image() {
        core::Settings& image = builder_.settings;
        for (int channel = 0; channel < 3; ++channel)
            builder_.background[channel] = static_cast<float>(
                std::max(background_.at[static_cast<std::size_t>(channel)], 0.0));
        constexpr double usual = 640.0;
        const int width = told(tokens_.main().text, "+W"), height = told(tokens_.main().text, "+H");
        const double wide = width > 0    ? width
                            : height > 0 ? height * aspect_
                                         : std::min(usual, usual * aspect_);
        const auto pixels = [](double size) {
            return static_cast<int>(std::clamp(std::round(size), 1.0, 65535.0));
        };
        image.width = pixels(wide);
        image.height = pixels(wide / aspect_);
        image.grid = 3;
        image.max_depth = settings_.max_trace_level - 1;
        image.min_weight = static_cast<float>(settings_.adc_bailout);
        const double gamma = tokens_.gamma();
        constexpr double in_between = 1.6;
        image.transfer =
            gamma > 0.0 && gamma < in_between ? core::Transfer::srgb : core::Transfer::linear;
        if (gamma != 0.0 && gamma != 1.0 && std::abs(gamma - 2.2) > 0.01)
            tokens_.remark(
                camera_place_,
                "an assumed_gamma other than 1 and 2.2 is not supported: the nearer one is used");
    }

    Tokens tokens_;
    core::SceneBuilder builder_;
    Assembly assembly_;
    GlobalSettings settings_;
    struct Waiting {
        Shared<Object> object;
        Shared<Texture> texture; ///< the default at the object's place
    };
    std::vector<Waiting> waiting_;
    Tuple background_{{}, 5};
    Place camera_place_{};
    double aspect_ = 1.0;
    std::size_t added_lights_ = 0;
    bool has_background_ = false, has_camera_ = false, mirrored_ = false;
};

} // namespace

core::Scene read_pov(InputFile& file, core::Workers* workers, const OnRemark& on_remark) {
    return Reader(file, workers, on_remark).read();
}

} // namespace raylane::scenes
