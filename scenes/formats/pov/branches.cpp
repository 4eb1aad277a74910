#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/tokens.hpp"

#include <algorithm>
#include <array>

/// Conditions and loops among the directives.
namespace raylane::scenes::pov {

bool Tokens::condition() {
    expect("(");
    const Tuple value = read_relation(*this);
    expect(")");
    return value.at[0] != 0.0;
}

bool Tokens::read_is_declared() {
    expect("(");
    const Token name = raw_word("a name");
    const Value* found = find(name.text);
    Value value = found != nullptr ? *found : Value{};
    while (is_before("[")) {
        const auto* known = value.get_if<std::shared_ptr<Array>>();
        const std::shared_ptr<Array> array = known != nullptr ? *known : nullptr;
        if (array == nullptr)
            fail(name.place, "must be the name of an array, got " + name.quoted());
        const std::vector<std::size_t> indices = read_indices(*this, array->sizes.size());
        value = array->values[index_in(*array, name, indices)];
    }
    expect(")");
    return value.get_if<std::monostate>() == nullptr ||
           (found == nullptr && standard_names_.contains(name.text));
}

/// Skips the rest of the block that begins at `place`, up to its #end or the first word of its next
/// branch. Returns that word.
Token Tokens::skip_to(const Place& place, Until until) {
    static constexpr std::array<std::string_view, 7> beginnings = {
        "if", "ifdef", "ifndef", "while", "for", "switch", "macro"};
    Scanner& scanner = frames_.back().scanner;
    for (std::size_t open = 0;;) {
        Token token = scanner.next();
        if (token.kind == TokenKind::end) fail(place, "must have an #end, got the end of the file");
        if (!token.is("#")) continue;
        token = scanner.next();
        if (token.is("end")) {
            if (open == 0) return token;
            --open;
        } else if (std::find(beginnings.begin(), beginnings.end(), token.text) !=
                   beginnings.end()) {
            ++open;
        } else if (open == 0 && until != Until::end &&
                   (token.is("else") ||
                    (until == Until::branch ? token.is("elseif")
                                            : token.is("case") || token.is("range")))) {
            return token;
        }
    }
}

void Tokens::begin_if(bool holds, const Place& place) {
    while (!holds) {
        const Token branch = skip_to(place, Until::branch);
        if (branch.is("end")) return;
        holds = branch.is("else") || condition();
    }
    frames_.back().conditions.push_back({Condition::Kind::choice, place});
}

std::array<double, 2> Tokens::read_in_parentheses() {
    expect("(");
    const double first = read_number(*this);
    const double second = accept(",") ? read_number(*this) : first;
    expect(")");
    return {first, second};
}

/// Continues at the first #case that is equal, at the first #range that contains the value, or at
/// #else.
void Tokens::begin_switch(const Place& place) {
    const double value = read_in_parentheses()[0];
    for (bool holds = false; !holds;) {
        const Token branch = skip_to(place, Until::switch_case);
        if (branch.is("end")) return;
        holds = branch.is("else");
        if (holds) break;
        const auto [least, most] = read_in_parentheses();
        holds = least <= value && value <= most;
    }
    frames_.back().conditions.push_back({Condition::Kind::switch_case, place});
}

void Tokens::begin_while(const Place& place) {
    const Scanner again = frames_.back().scanner;
    if (!condition()) {
        skip_to(place, Until::end);
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
    if (step == 0.0) fail(place, "must have a step other than 0");
    if (step > 0.0 ? first > last : first < last) {
        skip_to(place, Until::end);
        return;
    }
    declare_here(counter.text, Value{Tuple::of(first)});
    frames_.back().conditions.push_back(
        {Condition::Kind::for_loop, place, frames_.back().scanner, counter.text, last, step});
}

/// Leaves the innermost loop or #switch.
void Tokens::leave_loop(const Place& place) {
    auto& conditions = frames_.back().conditions;
    for (;;) {
        if (conditions.empty()) fail(place, "must be in a loop or a #switch");
        const Condition left = conditions.back();
        conditions.pop_back();
        skip_to(left.place, Until::end);
        if (left.kind != Condition::Kind::choice) return;
    }
}

void Tokens::end(const Place& place) {
    Frame& frame = frames_.back();
    if (frame.conditions.empty()) {
        if (frame.kind != FrameKind::macro) fail(place, "must end a block, got none open");
        frames_.pop_back();
        return;
    }
    const Condition ended = frame.conditions.back();
    frame.conditions.pop_back();
    if (!ended.again) return;
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
