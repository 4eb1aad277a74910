#include "scenes/formats/tachyon/words.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <filesystem>

namespace raylane::scenes {

namespace {

char capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

} // namespace

bool is_keyword(std::string_view word, std::string_view keyword) {
    return word.size() == keyword.size() &&
           std::equal(word.begin(), word.end(), keyword.begin(),
                      [](char a, char b) { return capital(a) == b; });
}

TachyonWords::TachyonWords(InputFile& file, const OnRemark& on_remark) : on_remark_(on_remark) {
    sources_.push_back({nullptr, &file, std::make_unique<NffScanner>(file)});
}

bool TachyonWords::next_statement() {
    const std::string_view word = take();
    statement_ = word;
    statement_line_ = line();
    statement_depth_ = sources_.size();
    return !word.empty();
}

std::string_view TachyonWords::peek() {
    if (has_word_) return word_;
    word_ = sources_.back().scanner->word();
    while (word_.empty() && sources_.size() > 1) {
        sources_.pop_back();
        word_ = sources_.back().scanner->word();
    }
    has_word_ = true;
    return word_;
}

std::string_view TachyonWords::take() {
    const std::string_view word = peek();
    has_word_ = false;
    return word;
}

bool TachyonWords::accept(std::string_view keyword) {
    if (!is_keyword(peek(), keyword)) return false;
    has_word_ = false;
    return true;
}

void TachyonWords::expect(std::string_view keyword) {
    if (!accept(keyword)) refuse_next(keyword);
}

void TachyonWords::refuse_next(std::string_view must) {
    const std::string got = quoted_word(peek());
    refuse("", "must continue with " + std::string(must), got);
}

void TachyonWords::refuse_statement(std::string_view must) const {
    sources_.back().scanner->fail(statement_line_,
                                  std::string(must) + ", got " + quoted_word(statement_));
}

core::Vec3f TachyonWords::vector(std::string_view field) {
    const core::Vec3f v = triple(field);
    return {v.x, v.y, 0.0F - v.z}; // no -0
}

float TachyonWords::named_number(std::string_view keyword) {
    expect(keyword);
    return number(keyword);
}

core::Vec3f TachyonWords::named_triple(std::string_view keyword) {
    expect(keyword);
    return triple(keyword);
}

core::Vec3f TachyonWords::named_vector(std::string_view keyword) {
    expect(keyword);
    return vector(keyword);
}

void TachyonWords::include(const std::string& name) {
    const std::filesystem::path beside =
        std::filesystem::path(sources_.back().file->name()).parent_path() / name;
    std::unique_ptr<InputFile> file = included_.open(beside, name, sources_.size() - 1);
    auto scanner = std::make_unique<NffScanner>(*file);
    const InputFile* const opened = file.get();
    sources_.push_back({std::move(file), opened, std::move(scanner)});
}

void TachyonWords::remark(const std::string& what) {
    if (!on_remark_ || !remarks_.insert(what).second) return;
    // Remarks at the end of the scene have no line.
    const std::uint64_t place = is_keyword(statement_, "END_SCENE") ? 0 : line_of_statement();
    on_remark_(
        text_of({sources_.back().file->name(), {static_cast<std::size_t>(place), 0}, "", what}));
}

void TachyonWords::refuse(std::string_view field, std::string_view must,
                          std::string_view got) const {
    std::string message = printable(statement_);
    if (line() != line_of_statement()) message += " of line " + std::to_string(statement_line_);
    if (!field.empty()) message.append(": ").append(in_lower_case(field));
    sources_.back().scanner->fail(line(),
                                  message.append(": ").append(must).append(", got ").append(got));
}

void TachyonWords::refuse(const core::InvalidValue& invalid) const {
    sources_.back().scanner->fail(line_of_statement(),
                                  printable(statement_).append(": ").append(invalid.what()));
}

} // namespace raylane::scenes
