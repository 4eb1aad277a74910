#pragma once

#include "core/scene/scene.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"

#include <string>

/// Reads scenes in POV-Ray's language.
namespace raylane::tests {

/// A right-handed camera as in raylane, so that coordinates are read as they are written.
inline const std::string camera = "camera { location <0, 0, 9> look_at 0 right -x up y }\n";

struct Read {
    core::Scene scene;
    std::string remarks;

    const core::Material& material_of(core::ShapeId id = 0) const { return scene.material_of(id); }
    bool remarks_on(const std::string& what) const {
        return remarks.find(what) != std::string::npos;
    }
};

inline Read read(const std::string& text, const std::string& before = camera) {
    std::string remarks;
    scenes::LoadOptions options;
    options.on_remark = [&](const std::string& remark) { remarks += remark + "\n"; };
    core::Scene scene = scenes::parse_scene("a.pov", before + text, options);
    return {std::move(scene), std::move(remarks)};
}

inline std::string complaint(const std::string& text) {
    return message_of<scenes::BadInput>([&] { scenes::parse_scene("a.pov", text); });
}

/// Returns the value of an expression after some statements, as text.
inline std::string number(const std::string& expression, const std::string& before = "") {
    const Read result = read(before + " sphere { <" + expression + ", 0, 0>, 1 }");
    std::string text;
    scenes::for_each_by_id(result.scene, [&](const auto& shape, core::ShapeId) {
        text = scenes::to_text(static_cast<float>(core::numbers_of(shape)[0]));
    });
    return text;
}

} // namespace raylane::tests
