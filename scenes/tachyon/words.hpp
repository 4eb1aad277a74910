#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"
#include "scenes/included_files.hpp"
#include "scenes/nff/scanner.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

inline constexpr int max_int = std::numeric_limits<int>::max();

/// The words of a Tachyon scene, wherever its lines end, and those of the files that it includes
/// where it does. Keywords are in any case, and are named here in capitals. What is not as expected
/// is a BadInput that names the line, the statement and the field.
///
/// Tachyon's axes are left-handed: seen along z, y is up and x to the right. A scene here has its z
/// the other way round, which is exact and leaves each picture as it is.
class TachyonWords {
  public:
    TachyonWords(InputFile& file, const OnRemark& on_remark);

    /// Goes on to the next statement and is at its first word. False at the end of the file.
    bool next_statement();
    /// The first word of the statement.
    const std::string& statement() const { return statement_; }

    /// The next word, which stays the next one; empty at the end of the file.
    std::string_view peek();
    /// The next word. It is there until the next call.
    std::string_view take();
    /// True if the next word is that keyword, and then behind it.
    bool accept(std::string_view keyword);
    /// Refuses what is not that keyword.
    void expect(std::string_view keyword);
    /// What `expect` says if none of several is there.
    [[noreturn]] void refuse_next(std::string_view must);
    /// Refuses the word that the statement begins with.
    [[noreturn]] void refuse_statement(std::string_view must) const;

    float number(std::string_view field);
    int whole_number(std::string_view field, int least, int most);
    /// As the file has it: a colour.
    core::Vec3f triple(std::string_view field);
    /// Point or direction, in the scene's axes.
    core::Vec3f vector(std::string_view field);
    /// A keyword, and what it is the name of.
    float named_number(std::string_view keyword);
    core::Vec3f named_triple(std::string_view keyword);
    core::Vec3f named_vector(std::string_view keyword);

    /// Goes on with another file, which is beside this one, and then behind this word.
    void include(const std::string& name);

    /// Says once for each `what` of something that the scene does not have.
    void remark(const std::string& what);
    [[noreturn]] void refuse(std::string_view field, std::string_view must,
                             std::string_view got) const;
    /// For what core says of the statement.
    [[noreturn]] void refuse(const core::InvalidValue& invalid) const;

    /// Bytes of the first file that have been read.
    std::uint64_t bytes_passed() const { return sources_.front().scanner->bytes_passed(); }

  private:
    struct Source {
        std::unique_ptr<InputFile> included; // none: the first
        const InputFile* file;
        std::unique_ptr<NffScanner> scanner;
    };
    /// Of the last word, which may be the next one.
    std::uint64_t line() const { return sources_.back().scanner->line(); }
    /// Where the statement begins, in the file that is read.
    std::uint64_t line_of_statement() const {
        return sources_.size() == statement_depth_ ? statement_line_ : line();
    }

    std::vector<Source> sources_; // the one that is read is the last
    IncludedFiles included_;
    const OnRemark& on_remark_;
    std::set<std::string> remarks_;
    std::string_view word_;
    bool has_word_ = false;
    std::string statement_;
    std::size_t statement_depth_ = 0; // of files in each other
    std::uint64_t statement_line_ = 0;
};

/// True if the word is a keyword, which is given in capitals.
bool is_keyword(std::string_view word, std::string_view keyword);

} // namespace raylane::scenes
