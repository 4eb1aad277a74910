#include "scenes/formats/pov/budget.hpp"

namespace raylane::scenes::pov {

void Budget::count_words(std::size_t words, const Place& place) {
    words_ += words;
    if (words_ > max_words + words_for_each * file_bytes_)
        fail(place,
             "must not expand to more than 100 million words, with 24 for each shape and texture");
}

void Budget::keep(std::size_t bytes, const Place& place) {
    if (*bytes_ + bytes > max_bytes + bytes_for_each * file_bytes_)
        fail(place, "must not take more than 256 MB for arrays, strings, objects and materials");
    *bytes_ += bytes;
}

std::shared_ptr<void> Budget::reserve(std::size_t bytes, const Place& place) {
    keep(bytes, place);
    return {nullptr, [all = bytes_, bytes](std::nullptr_t) { *all -= bytes; }};
}

} // namespace raylane::scenes::pov
