#pragma once

#include "core/scene/film.hpp"
#include "core/scene/scene.hpp"
#include "scenes/annotation/composer.hpp"
#include "scenes/annotation/overlay.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "scenes/tool/options/render_options.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>

namespace raylane::scenes {

/// Returns the module for annotations over images. A remark names the font that texts have in place
/// of `font`, if the user named that. Throws SystemRefused, with `what_fails` and the reason.
Overlay overlay_for(const std::string& what_fails, const std::optional<std::string>& font,
                    const OnRemark& on_remark);

/// Puts the annotations of a command line over images, or into files.
class Annotator {
  public:
    /// Throws BadInput, and SystemRefused if annotations are to be rendered, but raylane was built
    /// without pango.
    explicit Annotator(const RenderArguments& arguments);

    bool has_any() const { return annotations_.any(); }
    /// Returns the legend that loading a single scene has to fill in. Null: annotations and
    /// statistics do not need it.
    Legend* legend() { return wants_legend_ ? &legend_ : nullptr; }
    /// Throws BadInput for annotations of an image in parts.
    void require_whole() const;

    /// Makes the annotations of a scene's image. Throws BadInput.
    void compose(const core::Scene& scene, const Legend& legend, const core::Settings& settings,
                 const OnRemark& on_remark);
    /// Does the same for a single scene, whose loading has filled in legend().
    void compose(const core::Scene& scene, const core::Settings& settings,
                 const OnRemark& on_remark) {
        compose(scene, legend_, settings, on_remark);
    }
    /// Returns true if annotations belong over the image.
    bool covers_image() const { return annotations_.any() && file_.empty(); }
    /// Puts the annotations over a film, which shows this part of the image.
    void cover(core::Film& film, const core::Region& part, core::Transfer transfer) const;
    /// Writes the file of annotations for an image with a number, if one is wanted. Throws
    /// SystemRefused.
    void write_file(std::size_t number) const;
    /// Returns the meanings of the colours, for --stats.
    nlohmann::ordered_json stats() const;

  private:
    Annotations annotations_;
    std::string file_; ///< empty: none
    std::function<std::string(std::size_t)> file_names_;
    std::string first_option_;
    std::vector<std::string> remarks_; ///< on the font
    bool wants_legend_;
    std::optional<Overlay> overlay_;
    Legend legend_;
    Sheet sheet_;
};

} // namespace raylane::scenes
