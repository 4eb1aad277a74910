#include "scenes/nff/object_name.hpp"

#include "scenes/nff/scanner.hpp"

namespace raylane::scenes {

std::string nff_object_name(InputFile& file, std::size_t objects_before) {
    if (!file.rewind()) return "";
    NffScanner scanner(file);
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
        // No field is called like an entity.
        const bool object = word == "s" || word == "c" || word == "p" || word == "pp";
        if (object && objects_before-- == 0)
            return "the " + std::string(word) + " of line " + std::to_string(scanner.line());
    }
    return "";
}

} // namespace raylane::scenes
