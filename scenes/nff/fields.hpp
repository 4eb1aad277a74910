#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"
#include "scenes/nff/scanner.hpp"

#include <string>

namespace raylane::scenes {

/// The entities of an NFF file and their fields, one after the other. Fields may be spread over
/// lines as they like; an entity begins on a line of its own. What is not as expected is a BadInput
/// that names the line, the entity and the field.
class NffFields {
  public:
    explicit NffFields(InputFile& file) : scanner_(file) {}

    /// Goes on to the next entity. False at the end of the file.
    bool next_entity();
    const std::string& entity() const { return entity_; }
    /// Line on which the entity begins.
    std::uint64_t line() const { return line_; }
    std::uint64_t bytes_passed() const { return scanner_.bytes_passed(); }

    std::string_view word() { return scanner_.word(); }
    float number(std::string_view field);
    int whole_number(std::string_view field, int least, int most);
    core::Vec3f vector(std::string_view field);
    /// Vector, all on the line that has been begun.
    core::Vec3f vector_on_line(std::string_view field);
    bool at_line_end() { return scanner_.at_line_end(); }

    /// The fields that follow are of vertex `number` (from 1) of `count`.
    void begin_vertex(int number, int count);

    /// "line N: entity: field: must, got what": N is where the last word is.
    [[noreturn]] void refuse(std::string_view field, std::string_view must,
                             std::string_view what) const;
    /// For what core says of the entity.
    [[noreturn]] void refuse(const core::InvalidValue& invalid) const;
    /// "line N: message" for another place.
    [[noreturn]] void fail(std::uint64_t line, std::string_view message) const {
        scanner_.fail(line, message);
    }

  private:
    NffScanner scanner_;
    std::string entity_;
    std::uint64_t line_ = 0;
    int vertex_ = 0;
    int vertex_count_ = 0;
    std::string vanished_; // the latest number of the entity whose float is 0, and it is not
};

} // namespace raylane::scenes
