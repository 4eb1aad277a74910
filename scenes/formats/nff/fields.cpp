#include "scenes/formats/nff/fields.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"

namespace raylane::scenes {

bool NffFields::next_entity() {
    if (line_ != 0 && !scanner_.at_line_end()) {
        const std::string got = quoted_word(scanner_.word());
        fail(scanner_.line(), "must be the end of the line, got " + got);
    }
    const std::string_view word = scanner_.word();
    entity_ = word;
    line_ = scanner_.line();
    vertex_ = 0;
    vanished_.clear();
    return !word.empty();
}

void NffFields::has_read(std::string_view word, float value) {
    if (value == 0.0F && vanishes_in_float(word)) vanished_ = word;
}

core::Vec3f NffFields::vector_on_line(std::string_view field) {
    core::Vec3f vector;
    for (int axis = 0; axis < 3; ++axis) {
        if (at_line_end()) refuse(field, "must be three numbers", "the end of the line");
        vector[axis] = number(field);
    }
    return vector;
}

void NffFields::begin_vertex(int number, int count) {
    vertex_ = number;
    vertex_count_ = count;
}

void NffFields::refuse(std::string_view field, std::string_view must, std::string_view what) const {
    std::string message = entity_;
    if (scanner_.line() != line_) message += " of line " + std::to_string(line_);
    if (vertex_ != 0)
        message += ": vertex " + std::to_string(vertex_) + " of " + std::to_string(vertex_count_);
    if (!field.empty()) message.append(": ").append(field);
    fail(scanner_.line(), message.append(": ").append(must).append(", got ").append(what));
}

void NffFields::refuse(const core::InvalidValue& invalid) const {
    std::string message = entity_ + ": " + invalid.what();
    if (!vanished_.empty() && message.ends_with("got 0"))
        message.append(", the float nearest to ").append(printable(vanished_));
    fail(line_, message);
}

} // namespace raylane::scenes
