#include "scenes/formats/structure/selection.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/atom_tree.hpp"
#include "scenes/formats/structure/elements.hpp"
#include "scenes/formats/structure/lines.hpp"
#include "scenes/formats/structure/named_selections.hpp"
#include "scenes/formats/structure/selection_words.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <utility>

namespace raylane::scenes {

namespace {

Selected atoms_within(const Structure& structure, const Selected& targets, float reach) {
    std::vector<AtomIndex> atoms;
    for (AtomIndex i = 0; i < targets.size(); ++i)
        if (targets[i] != 0) atoms.push_back(i);
    const AtomTree tree(structure.positions, atoms);
    Selected result = targets;
    for (AtomIndex i = 0; i < targets.size(); ++i)
        if (result[i] == 0 && tree.has_within(structure.positions[i], reach)) result[i] = 1;
    return result;
}

class Parser {
  public:
    Parser(const Structure& structure, std::string_view text, const std::string& option,
           std::vector<std::string>& unmatched)
        : structure_(structure), text_(text), option_(option), unmatched_(unmatched) {
        advance();
    }

    Selected all() {
        Selected result = any();
        if (!word_.empty())
            fail(R"(must be "and", "or" or the end, got ")" + printable(word_) + "\"");
        return result;
    }

  private:
    std::string place_of(std::string_view word) const {
        return "column " + std::to_string(word.data() - text_.data() + 1);
    }
    /// Throws for a word of the expression, which may be behind the parser already.
    [[noreturn]] void fail_at(std::string_view word, const std::string& message) const {
        throw BadInput(option_, place_of(word), message);
    }
    [[noreturn]] void fail(const std::string& message) const { fail_at(word_, message); }

    /// Notes the words of a list for which `is_there` is false.
    template <class Test>
    void note_unmatched(const std::vector<std::string_view>& words, const char* what,
                        const Test& is_there) const {
        for (const std::string_view word : words)
            if (!is_there(word))
                unmatched_.push_back(text_of({option_,
                                              {},
                                              place_of(word),
                                              "\"" + printable(word) + "\" matches no " + what}));
    }

    /// Goes to the next word. Words end at blanks, parentheses and comparisons.
    void advance() {
        while (position_ < text_.size() &&
               (text_[position_] == ' ' || text_[position_] == '\t' || text_[position_] == ','))
            ++position_;
        const std::size_t begin = position_;
        constexpr std::string_view signs = "()<>=!&|";
        const auto is_at = [&](std::string_view any) {
            return position_ < text_.size() && any.find(text_[position_]) != any.npos;
        };
        if (is_at(signs)) {
            const char first = text_[position_++]; // <=, >=, ==, && and || are words
            if ((is_at("=") && (first == '<' || first == '>' || first == '=')) ||
                (is_at("&") && first == '&') || (is_at("|") && first == '|'))
                ++position_;
        } else {
            while (position_ < text_.size() && !is_at(signs) && !is_at(" \t,"))
                ++position_;
        }
        word_ = text_.substr(begin, position_ - begin);
    }
    bool take(std::string_view word) {
        if (!is_same_word(word_, word)) return false;
        advance();
        return true;
    }
    /// Returns the current word for a message.
    std::string got() const { return word_.empty() ? "nothing" : '"' + printable(word_) + '"'; }
    std::string_view taken(const char* what) {
        if (word_.empty()) fail(std::string("must be ") + what + ", got nothing");
        const std::string_view word = word_;
        advance();
        return word;
    }

    Selected any() {
        Selected result = both();
        while (take("or") || take("|") || take("||")) {
            const Selected other = both();
            for (std::size_t i = 0; i < result.size(); ++i)
                result[i] = static_cast<char>(result[i] | other[i]);
        }
        return result;
    }
    Selected both() {
        Selected result = near();
        while (take("and") || take("&") || take("&&"))
            keep_both(result, near());
        return result;
    }
    /// Takes PyMOL's "A within 5 of B", "A around 5" and "A expand 5" as well.
    Selected near() {
        Selected result = one();
        while (true) {
            if (is_same_word(word_, "within") || is_same_word(word_, "exwithin"))
                keep_both(result, one());
            else if (take("around"))
                result = without(atoms_within(structure_, result, distance()), result);
            else if (take("expand"))
                result = atoms_within(structure_, result, distance());
            else
                return result;
        }
    }
    static void keep_both(Selected& result, const Selected& other) {
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = static_cast<char>(result[i] & other[i]);
    }
    Selected one() {
        if (++depth_ > 100) fail("must not be nested deeper than 100");
        Selected result = one_of_any_depth();
        --depth_;
        return result;
    }
    Selected one_of_any_depth() {
        if (take("not") || take("!")) return opposite(one());
        if (take("(")) {
            Selected result = any();
            if (!take(")")) fail(R"x(must be ")", got )x" + got());
            return result;
        }
        const bool excludes = is_same_word(word_, "exwithin");
        if (take("within") || take("exwithin")) {
            const float reach = distance();
            require("of");
            const Selected operand = one();
            Selected near = atoms_within(structure_, operand, reach);
            return excludes ? without(std::move(near), operand) : near;
        }
        if (is_same_word(keyword_of(word_), "byres")) {
            advance();
            return whole_residues(near());
        }
        if (take("same")) {
            require("residue");
            require("as");
            return whole_residues(near());
        }
        return words();
    }
    void require(const char* word) {
        if (!take(word)) fail("must be \"" + std::string(word) + "\", got " + got());
    }
    float distance() {
        const std::string_view word = word_;
        const double reach = number("a distance");
        if (!(reach >= 0.0)) fail_at(word, "a distance must not be negative");
        return static_cast<float>(reach);
    }
    /// Adds the other atoms of residues of which atoms are selected.
    Selected whole_residues(Selected selected) const {
        if (structure_.residues.empty()) return selected;
        std::vector<char> has_any(structure_.of_residue.size());
        for (AtomIndex i = 0; i < selected.size(); ++i)
            if (selected[i] != 0) has_any[structure_.residues[i]] = 1;
        return where(structure_, [&](AtomIndex i) { return has_any[structure_.residues[i]] != 0; });
    }

    double number(const char* what) {
        const std::string_view word = taken(what);
        const std::optional<double> value = number_in(word);
        if (!value)
            fail_at(word, std::string("must be ") + what + ", got \"" + printable(word) + "\"");
        return *value;
    }

    Selected words() {
        const std::string_view given = word_;
        const std::string word = keyword_of(taken("a selection"));
        if (is_comparison(word_)) return property(given);
        if (std::optional<Selected> named = named_selection(structure_, word))
            return *std::move(named);
        if (word == "chain") return chains();
        if (word == "residue") return residues(true, true);
        if (word == "resn") return residues(true, false);
        if (word == "resi") return residues(false, true);
        if (word == "element") return elements();
        if (word == "name") return names();
        if (word == "type") return types();
        if (word == "index") return indices();
        return property(given);
    }
    bool is_in_list() const {
        if (word_.empty() || word_ == "(" || word_ == ")") return false;
        if (is_any_word(word_, {"and", "or", "&", "|", "resn", "resi", "around", "expand", "same"}))
            return false;
        return is_same_word(word_, "ion") || // a residue of GROMOS
               std::none_of(selection_keywords.begin(), selection_keywords.end(),
                            [&](std::string_view keyword) { return is_same_word(word_, keyword); });
    }
    /// Returns the words up to a keyword; at least one. A word "20 to 30" has blanks.
    std::vector<std::string_view> list(const char* what) {
        if (!is_in_list()) fail(std::string("must be ") + what + ", got " + got());
        std::vector<std::string_view> result;
        while (is_in_list()) {
            const std::string_view first = taken(what);
            if (range_in(first) && is_same_word(word_, "to")) {
                advance();
                const std::string_view last = taken("the end of a range");
                const auto length = last.data() + last.size() - first.data();
                result.emplace_back(first.data(), static_cast<std::size_t>(length));
            } else {
                add_parts(first, result);
            }
        }
        return result;
    }
    /// Adds the parts of a word of PyMOL, such as CA+CB. "Na+" is one part.
    static void add_parts(std::string_view word, std::vector<std::string_view>& parts) {
        while (true) {
            const std::size_t plus = word.find('+', 1);
            const bool is_last = plus == std::string_view::npos || plus + 1 == word.size();
            parts.push_back(is_last ? word : word.substr(0, plus));
            if (is_last) return;
            word.remove_prefix(plus + 1);
        }
    }

    Selected chains() {
        const std::vector<std::string_view> wanted = list("the name of a chain");
        note_unmatched(wanted, "chain", [&](std::string_view word) {
            return std::find(structure_.chains.begin(), structure_.chains.end(), word) !=
                   structure_.chains.end();
        });
        return where_residue(structure_, [&](const Residue& residue) {
            return std::find(wanted.begin(), wanted.end(), structure_.chains[residue.chain]) !=
                   wanted.end();
        });
    }

    using Range = std::pair<long long, long long>;
    /// Parses "17", "20-30", "20:30" or "20 to 30"; a number may be negative.
    static std::optional<Range> range_in(std::string_view word) {
        Range range;
        const char* const end = word.data() + word.size();
        auto [stop, error] = std::from_chars(word.data(), end, range.first);
        if (error != std::errc()) return {};
        range.second = range.first;
        if (stop == end) return range;
        std::string_view rest(stop, static_cast<std::size_t>(end - stop));
        if (*stop == '-' || *stop == ':')
            rest.remove_prefix(1);
        else if (const std::size_t to = in_lower_case(rest).find("to"); to != rest.npos)
            rest = trimmed(rest.substr(to + 2));
        const auto [last, again] =
            std::from_chars(rest.data(), rest.data() + rest.size(), range.second);
        if (again != std::errc() || last != end) return {};
        return range;
    }
    static bool is_in(const std::vector<Range>& ranges, long long number) {
        return std::any_of(ranges.begin(), ranges.end(), [&](const Range& range) {
            return range.first <= number && number <= range.second;
        });
    }

    /// Takes names of residues, numbers, or both: some names are numbers.
    Selected residues(bool by_name, bool by_number) {
        const std::vector<std::string_view> words =
            list(!by_number ? "the name of a residue"
                 : by_name  ? "the name or number of a residue"
                            : "the number of a residue");
        std::vector<std::vector<Range>> ranges; // of each word: one or none
        for (const std::string_view word : words) {
            ranges.emplace_back();
            if (const std::optional<Range> range = range_in(word); by_number && range)
                ranges.back().push_back(*range);
            else if (!by_name)
                fail_at(word, "must be a number or a range such as 20-30, got \"" +
                                  printable(word) + "\"");
        }
        const auto has = [&](const Residue& residue, std::size_t k) {
            return is_in(ranges[k], residue.number) ||
                   (by_name && is_same_word(words[k], residue.name));
        };
        std::vector<char> is_matched(words.size());
        Selected result = where_residue(structure_, [&](const Residue& residue) {
            bool has_any = false;
            for (std::size_t k = 0; k < words.size(); ++k)
                if (has(residue, k)) {
                    is_matched[k] = 1;
                    has_any = true;
                }
            return has_any;
        });
        note_unmatched(words, "residue", [&](std::string_view word) {
            const auto k = std::find_if(words.begin(), words.end(), [&](std::string_view other) {
                return other.data() == word.data();
            });
            return is_matched[static_cast<std::size_t>(k - words.begin())] != 0;
        });
        return result;
    }

    Selected elements() {
        std::vector<char> wanted(element_count);
        const std::vector<std::string_view> words = list("an element");
        for (const std::string_view word : words) {
            const Element element = element_of(word);
            if (element == 0) fail_at(word, "must be an element, got \"" + printable(word) + "\"");
            wanted[element] = 1;
        }
        note_unmatched(words, "element", [&](std::string_view word) {
            return std::any_of(
                structure_.of_kind.begin(), structure_.of_kind.end(),
                [&](const AtomKind& kind) { return kind.element == element_of(word); });
        });
        return where(structure_, [&](AtomIndex i) { return wanted[structure_.element(i)] != 0; });
    }

    Selected names() {
        const std::vector<std::string_view> wanted = list("the name of an atom");
        note_unmatched(wanted, "atom", [&](std::string_view word) {
            return std::any_of(structure_.names.begin(), structure_.names.end(),
                               [&](const std::string& name) { return is_same_word(word, name); });
        });
        if (structure_.names.empty()) return Selected(structure_.size());
        return where(structure_, [&](AtomIndex i) {
            return std::any_of(wanted.begin(), wanted.end(), [&](std::string_view name) {
                return is_same_word(name, structure_.names[i]);
            });
        });
    }

    Selected types() {
        const std::vector<std::string_view> wanted = list("a type");
        note_unmatched(wanted, "type", [&](std::string_view word) {
            return std::any_of(structure_.of_kind.begin(), structure_.of_kind.end(),
                               [&](const AtomKind& kind) { return kind.label == word; });
        });
        std::vector<char> of_kind;
        for (const AtomKind& kind : structure_.of_kind)
            of_kind.push_back(
                std::find(wanted.begin(), wanted.end(), kind.label) != wanted.end() ? 1 : 0);
        return where(structure_, [&](AtomIndex i) { return of_kind[structure_.kinds[i]] != 0; });
    }

    Selected indices() {
        std::vector<Range> ranges;
        for (const std::string_view word : list("a number or a range of numbers")) {
            const std::optional<Range> range = range_in(word);
            if (!range)
                fail_at(word, "must be a number or a range such as 1-100, got \"" +
                                  printable(word) + "\"");
            ranges.push_back(*range);
        }
        return where(structure_,
                     [&](AtomIndex i) { return is_in(ranges, static_cast<long long>(i) + 1); });
    }

    /// Returns the values of x, y, z or a property of the file. Throws for other words.
    std::function<double(AtomIndex)> numbers_named(std::string_view name) const {
        const auto named = [&](std::string_view wanted) {
            return std::find_if(
                structure_.properties.begin(), structure_.properties.end(),
                [&](const AtomProperty& property) { return is_same_word(property.name, wanted); });
        };
        auto found = named(name);
        if (found == structure_.properties.end()) found = named(property_name_of(name));
        if (found != structure_.properties.end())
            return [values = &found->values](AtomIndex i) {
                return static_cast<double>((*values)[i]);
            };
        for (int axis = 0; axis < 3; ++axis)
            if (is_same_word(name,
                             std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1)))
                return [this, axis](AtomIndex i) {
                    return static_cast<double>(structure_.positions[i][axis]);
                };
        std::vector<std::string_view> known(selection_keywords.begin(), selection_keywords.end());
        known.insert(known.end(), {"x", "y", "z"});
        for (const AtomProperty& property : structure_.properties)
            known.push_back(property.name);
        std::string text;
        for (const std::string_view word : known)
            text.append(text.empty() ? "" : ", ").append(word);
        const bool is_element = std::any_of(
            structure_.of_kind.begin(), structure_.of_kind.end(), [&](const AtomKind& kind) {
                return kind.element != 0 && kind.element == element_of(name);
            });
        fail_at(name, "must be one of " + printable(text, 400) + ", got \"" + printable(name) +
                          "\"" +
                          (is_element ? ", did you mean \"element " + printable(name) + "\"?"
                                      : suggestion(name, known)));
    }

    static bool is_comparison(std::string_view word) {
        return is_any_word(word, {"<", "<=", ">", ">=", "=", "=="});
    }
    Selected property(std::string_view name) {
        const std::function<double(AtomIndex)> value_of = numbers_named(name);
        const std::string_view sign = taken("<, <=, >, >= or =");
        if (!is_comparison(sign))
            fail_at(sign, "must have <, <=, >, >= or = behind it, got \"" + printable(sign) + "\"");
        const double bound = number("a number");
        return where(structure_, [&](AtomIndex i) {
            const double value = value_of(i);
            if (sign == "<") return value < bound;
            if (sign == "<=") return value <= bound;
            if (sign == ">") return value > bound;
            if (sign == ">=") return value >= bound;
            return value == static_cast<double>(static_cast<float>(bound));
        });
    }

    const Structure& structure_;
    std::string_view text_, word_;
    const std::string& option_;
    std::size_t position_ = 0;
    int depth_ = 0;
    std::vector<std::string>& unmatched_;
};

} // namespace

std::vector<char> select_atoms(const Structure& structure, std::string_view expression,
                               std::vector<std::string>& unmatched, const std::string& option) {
    return Parser(structure, expression, option, unmatched).all();
}

} // namespace raylane::scenes
