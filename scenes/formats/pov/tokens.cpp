#include "scenes/formats/pov/tokens.hpp"

#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace raylane::scenes::pov {

namespace {

constexpr std::size_t words_of_call = 16; ///< of a macro, without its body

} // namespace

Tokens::Tokens(Source source, const OnRemark& on_remark) : on_remark_(on_remark) {
    sources_.push_back(std::move(source));
    budget.add_file(sources_.front().text.size());
    frames_.push_back({Scanner(sources_.front()), FrameKind::file});
}

std::string Tokens::origin_of(const Token& name) const {
    const auto standard = standard_names_.find(name.text);
    if (name.kind != TokenKind::word || standard == standard_names_.end()) return "";
    return ", which is declared in \"" + std::string(standard->second.file) +
           "\" and not supported";
}

bool Tokens::is_by_convert() const {
    // The first line has the size and the samples. The version follows.
    const std::string_view text = main().text;
    const std::string_view first = text.substr(0, text.find('\n') + 1);
    return first.starts_with("// povray +W") && first.ends_with(" +A0.3\n") &&
           text.substr(first.size()).starts_with("#version 3.7;\nglobal_settings { assumed_gamma ");
}

void Tokens::remark(const Place& place, const std::string& what) {
    if (!on_remark_ || !remarks_.insert(what).second) return;
    const Place& at = standard_use_ ? *standard_use_ : place;
    on_remark_(text_of({at.source->name, position_of(at), "", what}));
}

Token Tokens::raw() {
    for (;;) {
        const Token token = frames_.back().scanner.next();
        budget.count_words(1, token.place);
        if (token.is("}") && frames_.back().kind == FrameKind::function) {
            frames_.pop_back();
            return {TokenKind::symbol, ")", 0.0, token.place};
        }
        if (token.kind != TokenKind::end || !leave_frame(token.place)) return token;
    }
}

/// Leaves the innermost file, macro or function at its end. Returns false at the end of the main
/// file.
bool Tokens::leave_frame(const Place& end) {
    const Frame& frame = frames_.back();
    if (!frame.conditions.empty())
        fail(frame.conditions.back().place,
             "must have an #end before the end of " + end.source->name);
    if (frame.kind == FrameKind::macro) fail(frame.place, "must be a macro with an #end");
    if (frames_.size() == 1) return false;
    frames_.pop_back();
    return true;
}

Token Tokens::expanded() {
    if (peeked_ && is_expanded_) return *std::exchange(peeked_, std::nullopt);
    for (;;) {
        const Token token = peeked_ ? *std::exchange(peeked_, std::nullopt) : raw();
        if (token.is("#")) {
            directive(token.place);
        } else if (const Value* value = token.kind == TokenKind::word ? find(token.text) : nullptr;
                   value != nullptr && value->get_if<Shared<Macro>>() != nullptr) {
            call(*value->get_if<Shared<Macro>>(), token.place);
        } else if (value == nullptr && declare_standard(token)) {
            peeked_ = token;
            is_expanded_ = false;
        } else {
            const auto* array =
                value != nullptr ? value->get_if<std::shared_ptr<Array>>() : nullptr;
            return array != nullptr && is_before("[") ? element_of(token, *array) : token;
        }
    }
}

/// Reads "NAME[1][0]", where elements may be arrays.
Token Tokens::element_of(Token name, std::shared_ptr<Array> array) {
    for (;;) {
        const std::vector<std::size_t> indices = read_indices(*this, array->sizes.size());
        const Value& element = array->values[index_in(*array, name, indices)];
        const auto* inner = element.get_if<std::shared_ptr<Array>>();
        if (inner == nullptr || !is_before("[")) {
            if (element.get_if<std::monostate>() != nullptr)
                fail(name.place,
                     "must be an element with a value, got an unset element of " + name.quoted());
            element_ = element;
            break;
        }
        array = std::shared_ptr<Array>(*inner);
    }
    name.kind = TokenKind::element;
    return name;
}

Token Tokens::next() {
    const Token token = expanded();
    if (token.is("(") || token.is("[") || token.is("{")) ++open_brackets;
    if (token.is(")") || token.is("]") || token.is("}")) --open_brackets;
    return token;
}

const Token& Tokens::peek() {
    if (peeked_ && is_expanded_) return *peeked_;
    const Token token = expanded();
    is_expanded_ = true;
    return peeked_.emplace(token);
}

bool Tokens::ends_expression(const Token& directive) const {
    if (open_brackets != declared_at_) return false;
    static constexpr std::array<std::string_view, 5> ends_of_branches = {"else", "elseif", "case",
                                                                         "range", "break"};
    const auto& conditions = frames_.back().conditions;
    if (directive.is("end")) return !conditions.empty() && conditions.back().again;
    return std::find(ends_of_branches.begin(), ends_of_branches.end(), directive.text) ==
           ends_of_branches.end();
}

const Token& Tokens::ahead() {
    while (!peeked_) {
        const Token token = raw();
        if (token.is("#")) {
            Scanner beyond = frames_.back().scanner;
            if (!ends_expression(beyond.next())) {
                directive(token.place);
                continue;
            }
        }
        peeked_ = token;
        is_expanded_ = false;
    }
    return *peeked_;
}

bool Tokens::accept(std::string_view what) {
    if (!at(what)) return false;
    next();
    return true;
}

void Tokens::expect(std::string_view what) {
    const Token token = next();
    if (!token.is(what))
        fail(token.place, "must be \"" + std::string(what) + "\", got " + token.quoted());
}

bool Tokens::is_before(std::string_view what) const {
    Scanner beyond = frames_.back().scanner;
    return beyond.next().is(what);
}

void Tokens::skip_braces() {
    expect("{");
    for (std::size_t open = 1; open > 0;) {
        const Token token = next();
        if (token.kind == TokenKind::end)
            fail(token.place, "must be \"}\", got the end of the file");
        if (token.is("{")) ++open;
        if (token.is("}")) --open;
    }
}

Tokens::Found Tokens::found(std::string_view name) const {
    for (std::size_t i = frames_.size(); i-- > 0;) {
        const Frame& frame = frames_[i];
        if (const auto found = frame.names.find(name); found != frame.names.end())
            return {&found->second, i, name};
        for (const Alias& alias : frame.aliases) {
            if (alias.parameter != name) continue;
            const auto& names = frames_[alias.frame].names;
            const auto found = names.find(alias.name);
            return {found != names.end() ? &found->second : nullptr, alias.frame, alias.name};
        }
    }
    return {nullptr, 0, name};
}

const Value* Tokens::find(std::string_view name) const {
    return found(name).value;
}

const Value* Tokens::value_of(const Token& token) const {
    if (token.kind == TokenKind::element) return &element_;
    return token.kind == TokenKind::word ? find(token.text) : nullptr;
}

/// Declares a name in the current scope. If the name is a parameter that stands for an outer name,
/// declares the outer name.
void Tokens::declare_here(std::string_view name, Value value) {
    for (const Alias& alias : frames_.back().aliases)
        if (alias.parameter == name) return declare(name, std::move(value), false);
    frames_.back().names.insert_or_assign(name, std::move(value));
}

/// Declares a name. A local name is declared in the current scope. Any other name is declared in
/// the innermost scope that has it or, if no scope has it, globally.
void Tokens::declare(std::string_view name, Value value, bool is_local) {
    if (is_local) return declare_here(name, std::move(value));
    const Found place = found(name);
    frames_[place.frame].names.insert_or_assign(place.name, std::move(value));
}

Token Tokens::raw_word(const char* what) {
    const Token token = frames_.back().scanner.next();
    if (token.kind != TokenKind::word)
        fail(token.place, std::string("must be ") + what + ", got " + token.quoted());
    return token;
}

void Tokens::enter(Frame frame) {
    if (frames_.size() >= static_cast<std::size_t>(deepest))
        fail(frame.place,
             "must not nest files and macros more than " + std::to_string(deepest) + " deep");
    frame.serial = ++frames_entered_;
    frames_.push_back(std::move(frame));
}

namespace {

/// Gives textures, pigments and materials the name by which they are declared.
Value named(Value value, std::string_view name) {
    const auto texture_named = [&](const Texture& texture) {
        auto copy = std::make_shared<Texture>(texture);
        copy->name = name;
        return copy;
    };
    if (const auto* pigment = value.get_if<Shared<Pigment>>()) {
        auto copy = std::make_shared<Pigment>(**pigment);
        copy->name = name;
        return {Shared<Pigment>(std::move(copy))};
    }
    if (const auto* texture = value.get_if<Shared<Texture>>())
        return {Shared<Texture>(texture_named(**texture))};
    if (const auto* material = value.get_if<Shared<Material>>();
        material != nullptr && (*material)->texture != nullptr) {
        auto copy = std::make_shared<Material>(**material);
        copy->texture = texture_named(*copy->texture);
        return {Shared<Material>(std::move(copy))};
    }
    return value;
}

} // namespace

void Tokens::directive(const Place& hash) {
    const Token word = raw_word("a directive");
    const std::string_view name = word.text;
    static constexpr std::array<std::string_view, 4> messages = {"debug", "render", "warning",
                                                                 "statistics"};
    if (name == "declare" || name == "local") return declaration(word);
    if (name == "macro") return begin_macro();
    if (name == "include") return include();
    if (name == "if") return begin_if(condition(), hash);
    if (name == "ifdef" || name == "ifndef")
        return begin_if(read_is_declared() == (name == "ifdef"), hash);
    if (name == "switch") return begin_switch(hash);
    if (name == "while") return begin_while(hash);
    if (name == "for") return begin_for(hash);
    if (name == "break") return leave_loop(hash);
    if (name == "end") return end(hash);
    auto& conditions = frames_.back().conditions;
    if (!conditions.empty() && conditions.back().kind == Condition::Kind::switch_case) {
        if (name == "else") return; // falls through from the chosen case
        if (name == "case" || name == "range") {
            read_in_parentheses();
            return;
        }
    }
    if (name == "else" || name == "elseif") { // ends the chosen branch
        if (conditions.empty() || conditions.back().kind != Condition::Kind::choice)
            fail(hash, "must be in an #if, got " + word.quoted());
        skip_to(conditions.back().place, Until::end);
        conditions.pop_back();
        return;
    }
    if (name == "version") {
        const int outer = std::exchange(declared_at_, open_brackets);
        accept("unofficial");
        version = read_number(*this);
        if (ahead().is(";")) peeked_.reset();
        declared_at_ = outer;
        return;
    }
    if (name == "default") return read_default(*this);
    if (name == "undef") {
        const Token undefined = raw_word("a name");
        const Found place = found(undefined.text);
        frames_[place.frame].names.erase(place.name);
        return;
    }
    if (std::find(messages.begin(), messages.end(), name) != messages.end()) {
        read_string(*this);
        return;
    }
    if (name == "fopen" || name == "write" || name == "fclose") return file_directive(word);
    if (name == "error") fail(hash, "#error: " + printable(read_string(*this), 200));
    fail(hash, "must be a supported directive, got \"#" + printable(name) + "\"");
}

/// Skips "#fopen NAME "file" write", "#write(NAME, ...)" and "#fclose NAME".
void Tokens::file_directive(const Token& word) {
    if (word.is("write")) {
        expect("(");
        for (int open = 1; open > 0;) {
            const Token token = next();
            if (token.kind == TokenKind::end)
                fail(word.place, "must have a \")\", got the end of the file");
            open += token.is("(") ? 1 : token.is(")") ? -1 : 0;
        }
        return;
    }
    raw_word("a name");
    if (word.is("fclose")) return;
    read_string(*this);
    const Token mode = next();
    if (!mode.is("write") && !mode.is("append"))
        fail(mode.place, "must be write or append, got " + mode.quoted());
    remark(word.place, "output to files is ignored");
}

void Tokens::declaration(const Token& word) {
    Token name = raw_word("a name");
    const bool is_local = word.text == "local";
    if (name.is("deprecated")) { // "deprecated once MESSAGE NAME"
        if (accept("once"); begins_string(peek())) read_string(*this);
        name = next();
    }
    const int outer = std::exchange(declared_at_, open_brackets);
    if (at("[")) {
        const std::vector<std::size_t> indices = read_indices(*this);
        expect("=");
        Value value = copied(read_value(*this), name.place);
        const Value* found = find(name.text);
        const auto* array = found != nullptr ? found->get_if<std::shared_ptr<Array>>() : nullptr;
        if (array == nullptr)
            fail(name.place, "must be the name of an array, got " + name.quoted());
        assign(**array, indices, std::move(value), name);
    } else {
        expect("=");
        Value value = named(copied(read_value(*this), name.place), name.text);
        declare(name.text, std::move(value), is_local);
    }
    if (ahead().is(";")) peeked_.reset();
    declared_at_ = outer;
}

/// Assigns an element. Copies inner arrays that others share.
void Tokens::assign(Array& array, std::span<const std::size_t> indices, Value value,
                    const Token& name) {
    const std::size_t own = std::min(indices.size(), array.sizes.size());
    const std::size_t index = index_in(array, name, indices.first(own));
    if (own < indices.size()) {
        Value& element = array.values[index];
        if (const auto* inner = element.get_if<std::shared_ptr<Array>>();
            inner != nullptr && inner->use_count() > 1)
            element = copied(element, name.place);
        const auto* inner = element.get_if<std::shared_ptr<Array>>();
        if (inner == nullptr) fail(name.place, "must have fewer indices");
        assign(**inner, indices.subspan(own), std::move(value), name);
        value = element;
    }
    set_element(budget, array, index, std::move(value), name.place);
}

/// Copies an array, so that no two names share one. Inner arrays are copied when they change.
Value Tokens::copied(Value value, const Place& place) {
    const auto* array = value.get_if<std::shared_ptr<Array>>();
    if (array == nullptr) return value;
    const std::size_t count = (*array)->values.size();
    budget.count_words(count, place);
    std::shared_ptr<void> room = budget.reserve(count * sizeof(Value), place);
    auto copy = std::make_shared<Array>(**array);
    copy->room = std::move(room);
    return {std::move(copy)};
}

void Tokens::begin_macro() {
    const Token name = raw_word("a name");
    auto macro = std::make_shared<Macro>(Macro{name.text, {}, frames_.back().scanner});
    Scanner& scanner = frames_.back().scanner;
    Token token = scanner.next();
    if (!token.is("(")) fail(token.place, "must be \"(\", got " + token.quoted());
    for (token = scanner.next(); !token.is(")"); token = scanner.next()) {
        if (token.is(",") || token.is("optional")) continue;
        if (token.kind != TokenKind::word)
            fail(token.place, "must be a parameter's name, got " + token.quoted());
        macro->parameters.push_back(token.text);
    }
    macro->body = scanner;
    skip_to(name.place, Until::end);
    declare(name.text, Value{Shared<Macro>(std::move(macro))}, false);
}

Value Tokens::read_function_value() {
    Macro macro{"function", {"x", "y", "z"}, frames_.back().scanner, true};
    if (accept("(")) {
        macro.parameters.clear();
        for (Token token = next(); !token.is(")"); token = next())
            if (!token.is(",")) macro.parameters.push_back(token.text);
    }
    expect("{");
    Scanner& scanner = frames_.back().scanner;
    macro.body = scanner;
    Token token = scanner.next();
    const Place begin = token.place;
    // Braces in the function are those of a pigment, a pattern, a transformation or a spline.
    bool is_expression = true;
    for (int open = 1;; token = scanner.next()) {
        if (token.kind == TokenKind::end) fail(begin, "must be a function that has a \"}\"");
        if (token.is("{")) is_expression = false;
        open += token.is("{") ? 1 : token.is("}") ? -1 : 0;
        if (open == 0) break;
    }
    --open_brackets;
    if (!is_expression) return {NotDrawn{}};
    return {std::make_shared<const Macro>(std::move(macro))};
}

void Tokens::call(const Shared<Macro> macro, const Place& place) {
    budget.count_words(words_of_call, place);
    const Level level(depth, place);
    expect("(");
    Frame frame{macro->body, macro->is_function ? FrameKind::function : FrameKind::macro, place};
    for (const std::string_view parameter : macro->parameters) {
        if (at(")"))
            fail(place, "must be called with " + std::to_string(macro->parameters.size()) +
                            " arguments, got fewer");
        read_argument(frame, parameter);
        accept(",");
    }
    // The scope of an alias may have ended while later arguments were read.
    std::erase_if(frame.aliases, [&](const Alias& alias) {
        return alias.frame >= frames_.size() || frames_[alias.frame].serial != alias.serial;
    });
    for (const Alias& alias : frame.aliases)
        frame.names.erase(alias.parameter);
    if (!at(")"))
        fail(peek().place, "must be \")\" behind the last argument, got " + peek().quoted());
    next();
    enter(std::move(frame));
    if (macro->is_function) { // the value is in parentheses
        peeked_ = Token{TokenKind::symbol, "(", 0.0, place};
        is_expanded_ = true;
    }
}

/// Reads an argument. A single name stands for its variable, which the macro may change.
void Tokens::read_argument(Frame& frame, std::string_view parameter) {
    const Token word = peek();
    const Found named = word.kind == TokenKind::word ? found(word.text) : Found{};
    if (named.value == nullptr || !(is_before(",") || is_before(")"))) {
        frame.names.insert_or_assign(parameter, copied(read_value(*this), word.place));
        return;
    }
    frame.aliases.push_back({parameter, named.frame, frames_[named.frame].serial, named.name});
    frame.names.insert_or_assign(parameter, *named.value);
    next();
}

void Tokens::include() {
    const Token token = peek();
    const std::string name = read_string(*this);
    budget.count_words(words_of_call, token.place);
    open(name, token.place);
}

/// Registers the names that one of POV-Ray's own files declares, and those of the files that it
/// includes. Each of these names is declared when it is first used.
void Tokens::include_standard(const StandardFile& file) {
    // Each of POV-Ray's own files ends by setting #version to the value that `version` had before
    // the file. Without an earlier #version, this value is 3.7.
    if (!version) version = 3.7;
    if (!standard_files_.insert(file.name).second) return;
    for (const std::string_view other : file.includes)
        include_standard(*standard_file(other));
    for (const auto& [name, declaration] : file.declarations) {
        standard_names_.insert_or_assign(name, StandardName{file.name, declaration});
        frames_.front().names.erase(name);
    }
}

/// Declares a name if one of POV-Ray's own files declares it. Returns true if so.
bool Tokens::declare_standard(const Token& name) {
    const auto standard = standard_names_.find(name.text);
    if (name.kind != TokenKind::word || standard == standard_names_.end() ||
        standard->second.declaration.empty())
        return false;
    const StandardName declared = standard->second;
    standard_names_.erase(standard);
    const std::optional<Place> use = standard_use_;
    if (!standard_use_) standard_use_ = name.place;
    sources_.push_back({std::string(declared.file), std::string(declared.declaration), {}});
    enter({Scanner(sources_.back()), FrameKind::file, name.place});
    directive(raw().place);
    frames_.pop_back();
    standard_use_ = use;
    return true;
}

std::optional<std::filesystem::path> Tokens::file_beside(const std::string& name,
                                                         const Place& place) const {
    for (const std::filesystem::path& folder : {place.source->folder, sources_.front().folder}) {
        std::error_code none;
        if (!folder.empty() && std::filesystem::is_regular_file(folder / name, none))
            return folder / name;
    }
    return std::nullopt;
}

/// Opens a file beside the file that includes it, one that comes with POV-Ray, or the one that Open
/// Babel installs.
void Tokens::open(const std::string& name, const Place& place) {
    if (const auto known = included_.find(name); known != included_.end())
        return enter({Scanner(*known->second), FrameKind::file, place});
    std::filesystem::path path = file_beside(name, place).value_or("");
    if (path.empty())
        if (const StandardFile* file = standard_file(name)) return include_standard(*file);
    const std::filesystem::path installed = "/usr/share/povray/include";
    if (std::error_code none; path.empty() && name == "babel_povray3.inc" &&
                              std::filesystem::is_regular_file(installed / name, none))
        path = installed / name;
    if (path.empty())
        fail(place,
             "must be a file in the folder of this file, or an include file of POV-Ray, got \"" +
                 printable(name) + "\"");
    const auto files = std::count_if(frames_.begin(), frames_.end(), [](const Frame& frame) {
        return frame.kind == FrameKind::file;
    });
    try {
        sources_.push_back(
            {path.string(),
             opener_.open(path, name, static_cast<std::size_t>(files) - 1)->read_all(),
             path.parent_path()});
    } catch (const core::InvalidValue& invalid) {
        fail(place, invalid.expectation);
    }
    included_.emplace(name, &sources_.back());
    budget.add_file(sources_.back().text.size());
    enter({Scanner(sources_.back()), FrameKind::file, place});
}

} // namespace raylane::scenes::pov
