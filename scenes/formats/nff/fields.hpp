#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"
#include "scenes/formats/nff/scanner.hpp"

#include <string>

namespace raylane::scenes {

/// The entities of an NFF file and their fields, one after the other. Fields may be spread over any
/// number of lines; an entity begins on a new line. Throws BadInput with the line, the entity and
/// the field for unexpected input.
class NffFields : public NumberFields<NffFields> {
  public:
    explicit NffFields(InputFile& file) : scanner_(file) {}

    /// Goes to the next entity. Returns false at the end of the file.
    bool next_entity();
    const std::string& entity() const { return entity_; }
    /// Line on which the entity begins.
    std::uint64_t line() const { return line_; }
    std::uint64_t bytes_passed() const { return scanner_.bytes_passed(); }

    std::string_view take() { return scanner_.word(); }
    /// Remembers a number that is not 0, but whose float is.
    void has_read(std::string_view word, float value);
    /// Reads a vector that must be complete on the current line.
    core::Vec3f vector_on_line(std::string_view field);
    bool at_line_end() { return scanner_.at_line_end(); }

    /// Sets that the following fields belong to vertex `number` (from 1) of `count`.
    void begin_vertex(int number, int count);

    /// Throws "line N: entity: field: must, got what", with the line N of the last word.
    [[noreturn]] void refuse(std::string_view field, std::string_view must,
                             std::string_view what) const;
    /// Throws for an entity that core refused.
    [[noreturn]] void refuse(const core::InvalidValue& invalid) const;
    /// Throws "line N: message" for another line.
    [[noreturn]] void fail(std::uint64_t line, std::string_view message) const {
        scanner_.fail(line, message);
    }

  private:
    NffScanner scanner_;
    std::string entity_;
    std::uint64_t line_ = 0;
    int vertex_ = 0;
    int vertex_count_ = 0;
    std::string vanished_; // the entity's latest number that is not 0, but whose float is
};

} // namespace raylane::scenes
