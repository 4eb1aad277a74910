#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"
#include "scenes/files/included_files.hpp"
#include "scenes/formats/nff/scanner.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

inline constexpr int max_int = std::numeric_limits<int>::max();

/// The words of a Tachyon scene and of the files that it includes, regardless of line ends.
/// Keywords are in any case, and are named here in capitals. Throws BadInput with the line, the
/// statement and the field for unexpected input.
///
/// Tachyon's axes are left-handed: seen along z, y is up and x to the right. A scene in raylane has
/// the opposite z, which is exact and does not change the image.
class TachyonWords : public NumberFields<TachyonWords> {
  public:
    TachyonWords(InputFile& file, const OnRemark& on_remark);

    /// Goes to the next statement and takes its first word. Returns false at the end of the file.
    bool next_statement();
    /// The first word of the statement.
    const std::string& statement() const { return statement_; }

    /// Returns the next word without taking it; empty at the end of the file.
    std::string_view peek();
    /// Takes and returns the next word. The word is valid until the next call.
    std::string_view take();
    /// Takes the next word and returns true if it is this keyword. Otherwise takes nothing and
    /// returns false.
    bool accept(std::string_view keyword);
    /// Takes the next word, and throws if it is not this keyword.
    void expect(std::string_view keyword);
    /// Throws the error of expect() where one of several keywords would be valid.
    [[noreturn]] void refuse_next(std::string_view must);
    /// Throws for the first word of the statement.
    [[noreturn]] void refuse_statement(std::string_view must) const;

    /// Reads a point or a direction, and converts it to the scene's axes.
    core::Vec3f vector(std::string_view field);
    /// Read a keyword and the value that follows it.
    float named_number(std::string_view keyword);
    core::Vec3f named_triple(std::string_view keyword);
    core::Vec3f named_vector(std::string_view keyword);

    /// Continues with another file, whose name is relative to the current file. After its end,
    /// continues in the current file behind the last word taken.
    void include(const std::string& name);

    /// Reports an unsupported feature, once for each `what`.
    void remark(const std::string& what);
    [[noreturn]] void refuse(std::string_view field, std::string_view must,
                             std::string_view got) const;
    /// Throws for a statement that core refused.
    [[noreturn]] void refuse(const core::InvalidValue& invalid) const;

    /// Returns the number of bytes that have been read of the first file.
    std::uint64_t bytes_passed() const { return sources_.front().scanner->bytes_passed(); }

  private:
    struct Source {
        std::unique_ptr<InputFile> included; // null: the first file
        const InputFile* file;
        std::unique_ptr<NffScanner> scanner;
    };
    /// Returns the line of the last word, or of the next word if it was peeked at.
    std::uint64_t line() const { return sources_.back().scanner->line(); }
    /// Returns the line on which the statement begins, in the current file.
    std::uint64_t line_of_statement() const {
        return sources_.size() == statement_depth_ ? statement_line_ : line();
    }

    std::vector<Source> sources_; // the current file is the last
    IncludedFiles included_;
    const OnRemark& on_remark_;
    std::set<std::string> remarks_;
    std::string_view word_;
    bool has_word_ = false;
    std::string statement_;
    std::size_t statement_depth_ = 0; // number of nested files
    std::uint64_t statement_line_ = 0;
};

/// Returns true if the word is a keyword, which is given in capitals.
bool is_keyword(std::string_view word, std::string_view keyword);

} // namespace raylane::scenes
