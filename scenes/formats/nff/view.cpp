#include "scenes/formats/nff/view.hpp"

#include "core/scene/field_of_view.hpp"
#include "core/scene/validate.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <array>

namespace raylane::scenes {

namespace {

/// Returns the camera's field of view from edge to edge. `angle` is "from the center of top pixel
/// row to bottom pixel row". Both are in degrees.
float field_of_view(float angle, int rows) {
    if (rows == 1) return angle;
    return core::field_of_view(core::slope_of_view(angle) * rows / (rows - 1));
}

constexpr std::array<std::string_view, 6> names = {"from",  "at",     "up",
                                                   "angle", "hither", "resolution"};
enum ViewPart : std::size_t { from, at, up, angle, hither, resolution };

/// Reads the name of a part that has not yet come.
ViewPart next_part(NffFields& fields, const std::array<bool, names.size()>& seen) {
    const std::string_view word = fields.take();
    const auto part =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), word) - names.begin());
    if (part < names.size() && !seen[part]) return static_cast<ViewPart>(part);
    std::string missing;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!seen[i]) missing.append(missing.empty() ? "" : ", ").append(names[i]);
    fields.refuse("", "must continue with each of " + missing, quoted_word(word));
}

} // namespace

NffView read_nff_view(NffFields& fields) {
    NffView view;
    float degrees = 0.0F;
    std::array<bool, names.size()> seen{};
    for (std::size_t count = 0; count < names.size(); ++count) {
        const ViewPart part = next_part(fields, seen);
        seen[part] = true;
        switch (part) {
        case from:
            view.camera.from = fields.triple("from");
            break;
        case at:
            view.camera.at = fields.triple("at");
            break;
        case up:
            view.camera.up = fields.triple("up");
            break;
        case angle:
            degrees = fields.number("angle");
            break;
        // "Mostly needed for hidden surface algorithms": a ray tracer also shows nearer objects.
        case hither:
            fields.number("hither");
            break;
        case resolution:
            view.width = fields.whole_number("resolution", 1, core::Settings::max_size);
            view.height = fields.whole_number("resolution", 1, core::Settings::max_size);
        }
    }
    if (!(degrees > 0.0F && degrees < 180.0F))
        throw core::InvalidValue("angle", "must be between 0 and 180 degrees, both excluded, got " +
                                              to_text(degrees));
    view.camera.field_of_view = field_of_view(degrees, view.height);
    core::validate(view.camera);
    return view;
}

} // namespace raylane::scenes
