#include "scenes/formats/structure/chain_layer.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/cartoon/cartoon.hpp"

#include <type_traits>

namespace raylane::scenes {

namespace {

ChainLook chain_look_of(const Look& look) {
    const Style style = *look.style;
    return {.style = style == Style::tube    ? ChainStyle::tube
                     : style == Style::trace ? ChainStyle::trace
                                             : ChainStyle::cartoon,
            .cylinders = style == Style::cylinders,
            .radius = look.radius.of_all,
            .scale = look.scale.of_all.value_or(1.0F)};
}

} // namespace

std::string add_chain_layer(const DrawnAtoms& atoms, const AtomLayer& layer, DrawnShapes& shapes,
                            bool is_only_look) {
    const float opacity = *layer.look.opacity;
    Palette palette(shapes.builder(), opacity, layer.look.finish);
    const ChainRemainder rest = add_chains(
        atoms.structure, chain_look_of(layer.look),
        [&](AtomIndex atom) { return atoms.representations[atom] == layer.representation; },
        [&](const CartoonShape& shape, AtomIndex atom) {
            const core::MaterialIndex material =
                palette.of(layer.colors.of(atom), [&] { return layer.colors.meaning_of(atom); });
            for (const core::Vec3f& image : atoms.images)
                std::visit(
                    [&]<class Piece>(const Piece& piece) {
                        if constexpr (std::is_same_v<Piece, RibbonPiece>)
                            shapes.add(moved(piece, image), material, {atom, atom});
                        else
                            shapes.add(moved(piece, image), material, *layer.look.style, opacity,
                                       {atom, atom});
                    },
                    shape);
        });
    if (rest.drawn == 0)
        throw BadInput(layer.option, "",
                       "must be a style of atoms here: the selection has no proteins or nucleic "
                       "acids of two residues");
    return rest.remark(atoms.structure, is_only_look);
}

} // namespace raylane::scenes
