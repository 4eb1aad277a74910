#pragma once

#include "scenes/errors.hpp"
#include "scenes/structure/readers.hpp"
#include "tests/scenes/message_of.hpp"

#include <string>
#include <vector>

/// What readers of atoms make of a text, which messages call "a".
namespace raylane::tests {

using namespace scenes;

using Open = std::unique_ptr<FrameReader> (*)(InputFile&);

inline std::vector<Structure> frames(Open open, const std::string& text) {
    InputFile file("a", text);
    const std::unique_ptr<FrameReader> reader = open(file);
    std::vector<Structure> all;
    for (Structure frame; reader->next(frame);)
        all.push_back(frame);
    return all;
}

inline std::string complaint(Open open, const std::string& text) {
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
