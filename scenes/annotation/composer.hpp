#pragma once

#include "core/scene/scene.hpp"
#include "scenes/annotation/annotations.hpp"
#include "scenes/annotation/atom_visibility.hpp"
#include "scenes/annotation/sheet.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// The image that annotations lie over.
struct AnnotatedView {
    core::Camera camera;
    int width, height;
    core::Color background;
    const core::Scene* scene = nullptr; ///< whose shapes hide labels; null: none are hidden
};

/// Composes the annotations of images of one scene. It finds the selected atoms once, for all
/// cameras. A scene that is not from atoms has lengths without a unit.
class SheetComposer {
  public:
    /// Both must outlive it. Throws BadInput, with the option, for selections without atoms,
    /// annotations of atoms without a file of atoms, axes of a cell without a cell, and a legend
    /// without colours. `on_remark` receives names that select nothing, and labels and distances
    /// whose atoms the image does not show.
    SheetComposer(const Annotations& annotations, const Legend& legend, const OnRemark& on_remark);

    /// Returns the annotations of an image as vector graphics. Throws BadInput, with the option,
    /// for a scale bar that is not in the image.
    ///
    /// `on_remark` receives:
    /// - labels and distances that are left out;
    /// - legend, axes and scale bar that have no room, or small texts for lack of it;
    /// - texts that are too small or too large;
    /// - that the scale bar of a perspective holds at one depth only.
    Sheet compose(const AnnotatedView& view, const OnRemark& on_remark) const;

  private:
    struct Image;

    /// A place of a label.
    struct Site {
        std::vector<AtomIndex> atoms; // ascending
        core::Vec3d place;
        std::string text;
    };
    struct Label {
        const LabelWords& words;
        std::vector<Site> sites = {};
        bool may_be_hidden = false;
        bool is_at_one_site = false; // the first one that is not hidden
    };
    struct Distance {
        const DistanceWords& words;
        core::Vec3d a, b;
    };

    std::vector<AtomIndex> selected(const std::string& option, const std::string& select,
                                    std::vector<std::string>& remarks) const;
    core::Vec3d middle_of(const std::vector<AtomIndex>& atoms) const;
    bool shows_any(const std::vector<AtomIndex>& atoms) const;
    void add_label(std::size_t number, std::vector<std::string>& remarks);
    void add_sites_of_residues(Label& label, const std::vector<AtomIndex>& atoms) const;
    void add_distance(std::size_t number, std::vector<std::string>& remarks);

    const Annotations& annotations_;
    const Legend& legend_;
    ShownAtoms shown_;
    std::vector<Label> labels_;
    std::vector<Distance> distances_;
};

} // namespace raylane::scenes
