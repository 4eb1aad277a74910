#include "scenes/tool/annotator.hpp"

#include "scenes/files/atomic_file.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/tool/sequence/frame_sequence.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace raylane::scenes {

namespace {

std::string code_of(std::uint32_t color) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(color & 0xFFFFFF));
    return text;
}

} // namespace

Overlay overlay_for(const std::string& what_fails, const std::optional<std::string>& font,
                    const OnRemark& on_remark) {
    Overlay overlay(what_fails);
    const auto used = font ? overlay.replaced_font(*font) : std::nullopt;
    if (used && on_remark)
        on_remark("--font: \"" + printable(*font) + "\" is not installed: texts are in " +
                  printable(*used));
    return overlay;
}

Annotator::Annotator(const RenderArguments& arguments)
    : annotations_(arguments.annotations()), file_(arguments.annotation.annotations.value_or("")),
      first_option_(arguments.annotation.first_given()),
      wants_legend_(annotations_.any() || arguments.stats) {
    legend_.wants_atoms = annotations_.any();
    if (!annotations_.any()) return;
    if (!file_.empty()) {
        // The name for a single image has no number.
        file_names_ = [file = file_](std::size_t) { return file; };
        if (arguments.has_sequence() || arguments.frames.is_one())
            file_names_ = numbered_names("--annotations", file_, arguments.has_sequence());
        return;
    }
    overlay_ = overlay_for(first_option_ + ": cannot write on an image; --annotations FILE.svg can",
                           arguments.annotation.font.value(),
                           [this](const std::string& remark) { remarks_.push_back(remark); });
}

void Annotator::require_whole() const {
    if (annotations_.any())
        throw BadInput(first_option_, "", "goes with a whole image, without --part");
}

void Annotator::compose(const core::Scene& scene, const Legend& legend,
                        const core::Settings& settings, const OnRemark& on_remark) {
    if (!annotations_.any()) return;
    if (covers_image() && std::max(settings.width, settings.height) > Overlay::most)
        throw BadInput("--size", "",
                       "must be at most " + std::to_string(Overlay::most) +
                           " pixels on each side with annotations, unless --annotations puts them "
                           "into a file");
    for (const std::string& remark : remarks_)
        if (on_remark) on_remark(remark);
    const core::Color background = settings.alpha ? core::Color(1.0F) : scene.background();
    sheet_ = SheetComposer(annotations_, legend, on_remark)
                 .compose({scene.camera(), settings.width, settings.height, background, &scene},
                          on_remark);
}

void Annotator::cover(core::Film& film, const core::Region& part, core::Transfer transfer) const {
    overlay_->cover(sheet_, part, transfer, film);
}

void Annotator::write_file(std::size_t number) const {
    if (file_.empty()) return;
    AtomicFile file(file_names_(number));
    file.write(svg_of(sheet_));
    file.commit();
}

nlohmann::ordered_json Annotator::stats() const {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    constexpr int colors = 8;
    for (const ColorKey& key : legend_.colors) {
        nlohmann::ordered_json one;
        if (key.property.empty()) {
            for (const auto& [name, color] : key.entries)
                one["colors"][printable(name)] = code_of(color);
        } else {
            one["property"] = printable(key.property);
            one["range"] = {key.range.first, key.range.second};
            for (int i = 0; i <= colors; ++i)
                one["colors"].push_back(
                    code_of(ramp_at(static_cast<double>(i) / colors, key.palette)));
        }
        list.push_back(std::move(one));
    }
    return list;
}

} // namespace raylane::scenes
