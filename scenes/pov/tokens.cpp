#include "scenes/pov/tokens.hpp"

#include "scenes/pov/expressions.hpp"
#include "scenes/pov/finishes.hpp"
#include "scenes/pov/includes.hpp"

#include <array>
#include <utility>

namespace raylane::scenes::pov {

Tokens::Tokens(Source source, const OnRemark& on_remark) : on_remark_(on_remark) {
    sources_.push_back(std::move(source));
    frames_.push_back({Scanner(sources_.front()), FrameKind::file});
}

void Tokens::remark(const Place& place, const std::string& what) {
    if (!on_remark_ || !remarks_.insert(what).second) return;
    on_remark_(text_of({place.source->name, position_of(place), "", what}));
}

Token Tokens::raw() {
    for (;;) {
        const Token token = frames_.back().scanner.next();
        if (++tokens_ > most_tokens) fail(token.place, "must expand to at most 1e9 words");
        if (token.kind != TokenKind::end || !leave_frame(token.place)) return token;
    }
}

/// At the end of a text; false at that of all.
bool Tokens::leave_frame(const Place& end) {
    const Frame& frame = frames_.back();
    if (!frame.conditions.empty())
        fail(frame.conditions.back().place, "must have an #end, and " + end.source->name + " ends");
    if (frame.kind == FrameKind::macro) fail(frame.place, "must be of a macro that has an #end");
    if (frames_.size() == 1) return false;
    frames_.pop_back();
    return true;
}

Token Tokens::next() {
    if (peeked_ && is_expanded_) return *std::exchange(peeked_, std::nullopt);
    for (;;) {
        const Token token = peeked_ ? *std::exchange(peeked_, std::nullopt) : raw();
        if (token.is("#")) {
            directive(token.place);
        } else if (const Value* value = token.kind == TokenKind::word ? find(token.text) : nullptr;
                   value != nullptr && value->get_if<Shared<Macro>>() != nullptr) {
            call(*value->get_if<Shared<Macro>>(), token.place);
        } else {
            return token;
        }
    }
}

const Token& Tokens::peek() {
    if (peeked_ && is_expanded_) return *peeked_;
    const Token token = next();
    is_expanded_ = true;
    return peeked_.emplace(token);
}

const Token& Tokens::ahead() {
    while (!peeked_) {
        const Token token = raw();
        if (token.is("#")) {
            Scanner beyond = frames_.back().scanner;
            if (beyond.next().is("end")) {
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
    peeked_.reset();
    return true;
}

void Tokens::expect(std::string_view what) {
    const Token token = next();
    if (!token.is(what))
        fail(token.place, "must be \"" + std::string(what) + "\", got " + token.quoted());
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

const Value* Tokens::find(std::string_view name) const {
    for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
        if (const auto found = frame->names.find(name); found != frame->names.end())
            return &found->second;
    return nullptr;
}

void Tokens::declare_here(std::string_view name, Value value) {
    frames_.back().names.insert_or_assign(name, std::move(value));
}

/// What is not local is all files', unless this one has a name for something of its own.
void Tokens::declare(std::string_view name, Value value, bool is_local) {
    if (is_local || frames_.back().names.contains(name))
        declare_here(name, std::move(value));
    else
        frames_.front().names.insert_or_assign(name, std::move(value));
}

Token Tokens::raw_word(const char* what) {
    const Token token = frames_.back().scanner.next();
    if (token.kind != TokenKind::word)
        fail(token.place, std::string("must be ") + what + ", got " + token.quoted());
    return token;
}

void Tokens::count_turn(const Place& place) {
    if (++turns_ > most_turns)
        fail(place, "must not go round loops and macros more than 20 million times");
}

void Tokens::enter(Frame frame) {
    if (frames_.size() >= static_cast<std::size_t>(deepest))
        fail(frame.place, "must not be of files and macros that are in each other more than " +
                              std::to_string(deepest) + " deep");
    frames_.push_back(std::move(frame));
}

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
        return begin_if(is_declared() == (name == "ifdef"), hash);
    if (name == "while") return begin_while(hash);
    if (name == "for") return begin_for(hash);
    if (name == "break") return leave_loop(hash);
    if (name == "end") return end(hash);
    if (name == "else" || name == "elseif") { // of what held
        auto& conditions = frames_.back().conditions;
        if (conditions.empty() || conditions.back().kind != Condition::Kind::choice)
            fail(hash, "must be in an #if, got " + word.quoted());
        skip_to(conditions.back().place, false);
        conditions.pop_back();
        return;
    }
    if (name == "version") {
        accept("unofficial");
        const double number = read_number(*this);
        if (frames_.size() == 1) version = number;
        accept(";");
        return;
    }
    if (name == "default") return read_default(*this);
    if (name == "undef") {
        const Token undefined = raw_word("a name");
        for (Frame& frame : frames_)
            frame.names.erase(undefined.text);
        return;
    }
    if (std::find(messages.begin(), messages.end(), name) != messages.end()) {
        read_string(*this);
        return;
    }
    if (name == "error")
        fail(hash, "is refused by the file itself: " + printable(read_string(*this), 200));
    fail(hash, "must be a directive that is read, got \"#" + printable(name) + "\"");
}

void Tokens::declaration(const Token& word) {
    const Token name = raw_word("a name");
    const bool is_local = word.text == "local";
    if (at("[")) {
        const std::vector<std::size_t> indices = read_indices(*this);
        expect("=");
        Value value = read_value(*this);
        element_of(*this, name, indices) = std::move(value);
    } else {
        expect("=");
        Value value = read_value(*this);
        declare(name.text, std::move(value), is_local);
    }
    if (ahead().is(";")) peeked_.reset();
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
    skip_to(name.place, false);
    declare(name.text, Value{Shared<Macro>(std::move(macro))}, false);
}

void Tokens::call(const Shared<Macro> macro, const Place& place) {
    count_turn(place);
    const Level level(depth, place);
    expect("(");
    Frame frame{macro->body, FrameKind::macro, place};
    for (const std::string_view parameter : macro->parameters) {
        if (at(")"))
            fail(place, "must be called with " + std::to_string(macro->parameters.size()) +
                            " arguments, got fewer");
        frame.names.insert_or_assign(parameter, read_value(*this));
        accept(",");
    }
    if (!at(")"))
        fail(peek().place, "must be \")\" behind the last argument, got " + peek().quoted());
    peeked_.reset();
    enter(std::move(frame));
}

void Tokens::include() {
    const Token token = peek();
    const std::string name = read_string(*this);
    count_turn(token.place);
    open(name, token.place);
}

/// Beside the file that includes it, or of those that come with POV-Ray, or where Open Babel has
/// its own.
void Tokens::open(const std::string& name, const Place& place) {
    if (const auto known = included_.find(name); known != included_.end())
        return enter({Scanner(*known->second), FrameKind::file, place});
    std::optional<std::string> text;
    std::filesystem::path path;
    for (const std::filesystem::path& folder : {place.source->folder, sources_.front().folder}) {
        std::error_code none;
        if (!folder.empty() && std::filesystem::is_regular_file(folder / name, none)) {
            path = folder / name;
            break;
        }
    }
    if (path.empty()) text = standard_include(name);
    const std::filesystem::path installed = "/usr/share/povray/include";
    if (std::error_code none; path.empty() && !text && name == "babel_povray3.inc" &&
                              std::filesystem::is_regular_file(installed / name, none))
        path = installed / name;
    if (path.empty() && !text)
        fail(place,
             "must be a file beside this one, or one of POV-Ray's that are known here, got \"" +
                 printable(name) + "\"");
    if (!text) text = InputFile(path).read_all();
    sources_.push_back({path.empty() ? name : path.string(), std::move(*text), path.parent_path()});
    included_.emplace(name, &sources_.back());
    enter({Scanner(sources_.back()), FrameKind::file, place});
}

bool Tokens::condition() {
    expect("(");
    const Tuple value = read_relation(*this);
    expect(")");
    return value.at[0] != 0.0;
}

bool Tokens::is_declared() {
    Scanner& scanner = frames_.back().scanner;
    Token token = scanner.next();
    if (!token.is("(")) fail(token.place, "must be \"(\", got " + token.quoted());
    const Token name = raw_word("a name");
    do {
        token = scanner.next();
        if (token.kind == TokenKind::end) fail(token.place, "must be \")\", got " + token.quoted());
    } while (!token.is(")"));
    return find(name.text) != nullptr;
}

/// Past the #end of what has begun or, `at_branches`, its #else or #elseif.
Token Tokens::skip_to(const Place& place, bool at_branches) {
    static constexpr std::array<std::string_view, 7> beginnings = {
        "if", "ifdef", "ifndef", "while", "for", "switch", "macro"};
    Scanner& scanner = frames_.back().scanner;
    for (std::size_t open = 0;;) {
        Token token = scanner.next();
        if (token.kind == TokenKind::end) fail(place, "must have an #end, and the file ends");
        if (!token.is("#")) continue;
        token = scanner.next();
        if (token.is("end")) {
            if (open == 0) return token;
            --open;
        } else if (std::find(beginnings.begin(), beginnings.end(), token.text) !=
                   beginnings.end()) {
            ++open;
        } else if (at_branches && open == 0 && (token.is("else") || token.is("elseif"))) {
            return token;
        }
    }
}

void Tokens::begin_if(bool holds, const Place& place) {
    while (!holds) {
        const Token branch = skip_to(place, true);
        if (branch.is("end")) return;
        holds = branch.is("else") || condition();
    }
    frames_.back().conditions.push_back({Condition::Kind::choice, place});
}

void Tokens::begin_while(const Place& place) {
    const Scanner again = frames_.back().scanner;
    if (!condition()) {
        skip_to(place, false);
        return;
    }
    frames_.back().conditions.push_back({Condition::Kind::while_loop, place, again});
}

void Tokens::begin_for(const Place& place) {
    expect("(");
    const Token counter = raw_word("a name");
    expect(",");
    const double first = read_number(*this);
    expect(",");
    const double last = read_number(*this);
    const double step = accept(",") ? read_number(*this) : 1.0;
    expect(")");
    if (step == 0.0) fail(place, "must have steps other than 0");
    if (step > 0.0 ? first > last : first < last) {
        skip_to(place, false);
        return;
    }
    declare_here(counter.text, Value{Tuple::of(first)});
    frames_.back().conditions.push_back(
        {Condition::Kind::for_loop, place, frames_.back().scanner, counter.text, last, step});
}

void Tokens::leave_loop(const Place& place) {
    auto& conditions = frames_.back().conditions;
    for (;;) {
        if (conditions.empty()) fail(place, "must be in a loop");
        const Condition left = conditions.back();
        conditions.pop_back();
        skip_to(left.place, false);
        if (left.kind != Condition::Kind::choice) return;
    }
}

void Tokens::end(const Place& place) {
    Frame& frame = frames_.back();
    if (frame.conditions.empty()) {
        if (frame.kind != FrameKind::macro)
            fail(place, "must end something, and nothing has begun");
        frames_.pop_back();
        return;
    }
    const Condition ended = frame.conditions.back();
    frame.conditions.pop_back();
    if (ended.kind == Condition::Kind::choice) return;
    count_turn(place);
    const Scanner behind = frame.scanner;
    frame.scanner = *ended.again;
    if (ended.kind == Condition::Kind::while_loop) {
        if (condition()) {
            frames_.back().conditions.push_back(ended);
            return;
        }
    } else {
        const Value* counter = find(ended.counter);
        const Tuple* value = counter != nullptr ? counter->get_if<Tuple>() : nullptr;
        const double next = value != nullptr ? value->at[0] + ended.step : ended.last + ended.step;
        declare_here(ended.counter, Value{Tuple::of(next)});
        if (ended.step > 0.0 ? next <= ended.last : next >= ended.last) {
            frame.conditions.push_back(ended);
            return;
        }
    }
    frames_.back().scanner = behind;
}

} // namespace raylane::scenes::pov
