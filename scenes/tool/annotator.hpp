#pragma once

#include "core/scene/film.hpp"
#include "core/scene/scene.hpp"
#include "scenes/annotation/annotations.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "scenes/tool/options/render_options.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace raylane::scenes {

/// Puts the annotations of a command line over an image, or into a file.
class Annotator {
  public:
    /// Throws SystemRefused if annotations are to be rendered, but raylane was built without pango.
    explicit Annotator(const RenderArguments& arguments);

    /// Returns the legend that loading the scene has to fill in for compose(); null if no
    /// annotation needs it.
    Legend* legend() { return wants_legend_ ? &legend_ : nullptr; }
    /// Throws BadInput for annotations of a sequence.
    void require_single() const;

    /// Makes the annotations of a scene's image. Throws BadInput.
    void compose(const core::Scene& scene, const core::Settings& settings,
                 const OnRemark& on_remark);
    /// Returns true if annotations belong over the image.
    bool covers_image() const { return annotations_.any() && file_.empty(); }
    /// Puts the annotations over a film, which shows this part of the image.
    void cover(core::Film& film, const core::Region& part, core::Transfer transfer) const;
    /// Writes the file of annotations, if one is wanted. Throws SystemRefused.
    void write_file() const;
    /// Returns the meanings of the colours, for --stats.
    nlohmann::ordered_json stats() const;

  private:
    Annotations annotations_;
    std::string file_; ///< empty: none
    std::string first_option_;
    std::string remark_; ///< on the font
    bool wants_legend_;
    RenderSheet render_ = nullptr;
    Legend legend_;
    Sheet sheet_;
};

} // namespace raylane::scenes
