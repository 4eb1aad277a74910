#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/readers.hpp"
#include "tests/scenes/files/message_of.hpp"

#include <string>
#include <type_traits>
#include <vector>

/// Calls readers of atoms with a text, which messages call "a".
namespace raylane::tests {

using namespace scenes;

template <class Open>
std::vector<Structure> frames(const Open& open, const std::string& text,
                              std::vector<std::string>* remarks = nullptr) {
    InputFile file("a", text);
    const std::unique_ptr<FrameReader> reader = [&] {
        if constexpr (std::is_invocable_v<Open, InputFile&>)
            return open(file);
        else
            return open(file, {.atom_style = "", .on_remark = [=](const std::string& remark) {
                                   if (remarks != nullptr) remarks->push_back(remark);
                               }});
    }();
    std::vector<Structure> structures;
    for (Structure frame; reader->next(frame);)
        structures.push_back(frame);
    return structures;
}

template <class Open>
std::string complaint(const Open& open, const std::string& text) {
    return message_of<BadInput>([&] { frames(open, text); });
}

inline std::string elements_of(const Structure& structure) {
    std::string text;
    for (AtomIndex i = 0; i < structure.size(); ++i)
        text.append(data_of(structure.element(i)).symbol).append(" ");
    return text;
}

inline bool has_gemmi() {
    InputFile file("a", "x");
    return message_of<BadInput>([&] { open_pdb(file); }).find("without gemmi") == std::string::npos;
}

} // namespace raylane::tests
