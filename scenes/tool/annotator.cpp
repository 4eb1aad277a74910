#include "scenes/tool/annotator.hpp"

#include "scenes/files/atomic_file.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/module.hpp"
#include "scenes/formats/structure/colors.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace raylane::scenes {

namespace {

std::string code_of(std::uint32_t color) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(color & 0xFFFFFF));
    return text;
}

} // namespace

Annotator::Annotator(const RenderArguments& arguments)
    : annotations_(arguments.annotations()), file_(arguments.annotation.annotations.value_or("")),
      first_option_(arguments.annotation.first_given()),
      wants_legend_(annotations_.any() || arguments.stats) {
    legend_.wants_atoms = annotations_.any();
    if (!annotations_.any()) {
        if (!first_option_.empty())
            throw BadInput(first_option_, "",
                           "goes with --legend, --scale-bar, --triad, --label or --distance");
        return;
    }
    if (!file_.empty()) return;
    const auto function = [&](const char* name) {
        return function_of(
            {"raylane-annotation.so", name, "pango at build time (Debian: libpango1.0-dev)"},
            first_option_ + ": cannot write on an image; --annotations FILE.svg can");
    };
    render_ = reinterpret_cast<RenderSheet>(function(render_sheet_name));
    if (!arguments.annotation.font) return;
    const auto replaced = reinterpret_cast<ReplacedFont>(function(replaced_font_name));
    if (const char* const used = replaced(annotations_.font.c_str()))
        remark_ = "--font: \"" + printable(annotations_.font) +
                  "\" is not installed: texts are in " + printable(used);
}

void Annotator::require_single() const {
    if (annotations_.any())
        throw BadInput(
            first_option_, "",
            "goes with a single image, without --turn, --frames, --part and sweeps of --set");
}

void Annotator::compose(const core::Scene& scene, const core::Settings& settings,
                        const OnRemark& on_remark) {
    if (!annotations_.any()) return;
    constexpr int most = 32767; // of a surface of cairo
    if (covers_image() && std::max(settings.width, settings.height) > most)
        throw BadInput("--size", "",
                       "must be at most " + std::to_string(most) +
                           " pixels on each side with annotations, unless --annotations puts them "
                           "into a file");
    if (!remark_.empty() && on_remark) on_remark(remark_);
    const core::Color background = settings.alpha ? core::Color(1.0F) : scene.background();
    sheet_ =
        sheet_of(annotations_, legend_,
                 {scene.camera(), settings.width, settings.height, background, &scene}, on_remark);
}

void Annotator::cover(core::Film& film, const core::Region& part, core::Transfer transfer) const {
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(sheet_.width) *
                                      static_cast<std::size_t>(sheet_.height));
    if (const char* const why = render_(&sheet_, pixels.data()))
        throw SystemRefused(std::string("annotations: cannot be rendered: ") + why);
    blend(pixels, sheet_.width, part, transfer, film);
}

void Annotator::write_file() const {
    if (file_.empty()) return;
    AtomicFile file(file_);
    file.write(svg_of(sheet_));
    file.commit();
}

nlohmann::ordered_json Annotator::stats() const {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
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
        all.push_back(std::move(one));
    }
    return all;
}

} // namespace raylane::scenes
