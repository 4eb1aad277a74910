#include "scenes/formats/structure/selection.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/atom_tree.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <utility>

namespace raylane::scenes {

namespace {

using Selected = std::vector<char>;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    const std::string lower = in_lower_case(word);
    return std::find(words.begin(), words.end(), lower) != words.end();
}

bool is_same(std::string_view a, std::string_view b) {
    return in_lower_case(a) == in_lower_case(b);
}

bool is_water(const Residue& residue) {
    return is_one_of(residue.name, {"hoh", "wat", "sol", "h2o", "dod", "tip3", "tip4", "spc"});
}
bool is_amino_acid(const Residue& residue) {
    return is_one_of(residue.name,
                     {"ala", "arg", "asn", "asp", "cys", "gln", "glu", "gly", "his", "ile", "leu",
                      "lys", "met", "phe", "pro", "ser", "thr", "trp", "tyr", "val", "asx", "glx",
                      "sec", "pyl", "mse", "hid", "hie", "hip", "hsd", "hse", "hsp", "cyx"});
}
bool is_nucleotide(const Residue& residue) {
    return is_one_of(residue.name,
                     {"a", "c", "g", "u", "t", "i", "da", "dc", "dg", "dt", "du", "di"});
}

Selected atoms_within(const Structure& structure, const Selected& of, float reach) {
    std::vector<AtomIndex> atoms;
    for (AtomIndex i = 0; i < of.size(); ++i)
        if (of[i] != 0) atoms.push_back(i);
    const AtomTree tree(structure.positions, atoms);
    Selected result = of;
    for (AtomIndex i = 0; i < of.size(); ++i)
        if (result[i] == 0 && tree.has_within(structure.positions[i], reach)) result[i] = 1;
    return result;
}

/// Words of the language, except and, or and of.
constexpr std::array<std::string_view, 16> keywords = {
    "all",   "none",    "protein", "nucleic", "water", "hetero", "hydrogen", "backbone",
    "chain", "residue", "element", "name",    "type",  "index",  "within",   "not"};

class Parser {
  public:
    Parser(const Structure& structure, std::string_view text, std::vector<std::string>& unmatched)
        : structure_(structure), text_(text), unmatched_(unmatched) {
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
        throw BadInput("--select", place_of(word), message);
    }
    [[noreturn]] void fail(const std::string& message) const { fail_at(word_, message); }

    /// Notes the words of a list for which `is_there` is false.
    template <class Test>
    void note_unmatched(const std::vector<std::string_view>& words, const char* what,
                        const Test& is_there) const {
        for (const std::string_view word : words)
            if (!is_there(word))
                unmatched_.push_back(text_of({"--select",
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
        constexpr std::string_view signs = "()<>=";
        if (position_ < text_.size() && signs.find(text_[position_]) != std::string_view::npos) {
            const char first = text_[position_++];
            if ((first == '<' || first == '>') && position_ < text_.size() &&
                text_[position_] == '=')
                ++position_;
        } else {
            while (position_ < text_.size() &&
                   std::string_view("()<>= \t,").find(text_[position_]) == std::string_view::npos)
                ++position_;
        }
        word_ = text_.substr(begin, position_ - begin);
    }
    bool take(std::string_view word) {
        if (!is_same(word_, word)) return false;
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
        while (take("or")) {
            const Selected other = both();
            for (std::size_t i = 0; i < result.size(); ++i)
                result[i] = static_cast<char>(result[i] | other[i]);
        }
        return result;
    }
    Selected both() {
        Selected result = one();
        while (take("and")) {
            const Selected other = one();
            for (std::size_t i = 0; i < result.size(); ++i)
                result[i] = static_cast<char>(result[i] & other[i]);
        }
        return result;
    }

    Selected one() {
        if (++depth_ > 100) fail("must not be nested deeper than 100");
        Selected result = one_of_any_depth();
        --depth_;
        return result;
    }
    Selected one_of_any_depth() {
        if (take("not")) {
            Selected result = one();
            for (char& is_selected : result)
                is_selected = static_cast<char>(1 - is_selected);
            return result;
        }
        if (take("(")) {
            Selected result = any();
            if (!take(")")) fail(R"x(must be ")", got )x" + got());
            return result;
        }
        if (take("within")) {
            const std::string_view distance = word_;
            const double reach = number("a distance");
            if (!(reach >= 0.0)) fail_at(distance, "a distance must not be negative");
            if (!take("of")) fail(R"(must be "of", got )" + got());
            return atoms_within(structure_, one(), static_cast<float>(reach));
        }
        return words();
    }

    double number(const char* what) {
        const std::string_view word = taken(what);
        const std::optional<double> value = number_in(word);
        if (!value)
            fail_at(word, std::string("must be ") + what + ", got \"" + printable(word) + "\"");
        return *value;
    }

    template <class Test>
    Selected where(const Test& test) const {
        Selected result(structure_.size());
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = test(static_cast<AtomIndex>(i)) ? 1 : 0;
        return result;
    }
    template <class Test>
    Selected where_residue(const Test& test) const {
        if (structure_.residues.empty()) return Selected(structure_.size());
        std::vector<char> of_residue;
        for (const Residue& residue : structure_.of_residue)
            of_residue.push_back(test(residue) ? 1 : 0);
        return where([&](AtomIndex i) { return of_residue[structure_.residues[i]] != 0; });
    }

    Selected words() {
        const std::string_view given = word_;
        const std::string word = in_lower_case(taken("a selection"));
        if (word == "all") return Selected(structure_.size(), 1);
        if (word == "none") return Selected(structure_.size(), 0);
        if (word == "protein") return where_residue(is_amino_acid);
        if (word == "nucleic") return where_residue(is_nucleotide);
        if (word == "water") return where_residue(is_water);
        if (word == "hetero")
            return where_residue([](const Residue& residue) { return residue.is_hetero; });
        if (word == "hydrogen")
            return where([&](AtomIndex i) { return structure_.element(i) == 1; });
        if (word == "backbone") return backbone();
        if (word == "chain") return chains();
        if (word == "residue") return residues();
        if (word == "element") return elements();
        if (word == "name") return names();
        if (word == "type") return types();
        if (word == "index") return indices();
        return property(given);
    }

    Selected backbone() const {
        Selected of_protein = where_residue(is_amino_acid);
        if (structure_.names.empty()) return of_protein;
        return where([&](AtomIndex i) {
            return of_protein[i] != 0 &&
                   is_one_of(structure_.names[i], {"n", "ca", "c", "o", "oxt"});
        });
    }

    bool is_in_list() const {
        return !word_.empty() && word_ != "(" && word_ != ")" && !is_one_of(word_, {"and", "or"}) &&
               std::none_of(keywords.begin(), keywords.end(),
                            [&](std::string_view keyword) { return is_same(word_, keyword); });
    }
    /// Returns the words up to a keyword; at least one.
    std::vector<std::string_view> list(const char* what) {
        if (!is_in_list()) fail(std::string("must be ") + what + ", got " + got());
        std::vector<std::string_view> result;
        while (is_in_list())
            result.push_back(taken(what));
        return result;
    }

    Selected chains() {
        const std::vector<std::string_view> wanted = list("the name of a chain");
        note_unmatched(wanted, "chain", [&](std::string_view word) {
            return std::find(structure_.chains.begin(), structure_.chains.end(), word) !=
                   structure_.chains.end();
        });
        return where_residue([&](const Residue& residue) {
            return std::find(wanted.begin(), wanted.end(), structure_.chains[residue.chain]) !=
                   wanted.end();
        });
    }

    using Range = std::pair<long long, long long>;
    /// Parses "17" or "20-30"; a number may be negative.
    static std::optional<Range> range_in(std::string_view word) {
        Range range;
        const char* const end = word.data() + word.size();
        auto [stop, error] = std::from_chars(word.data(), end, range.first);
        if (error != std::errc()) return {};
        range.second = range.first;
        if (stop == end) return range;
        if (*stop != '-') return {};
        const auto [last, again] = std::from_chars(stop + 1, end, range.second);
        if (again != std::errc() || last != end) return {};
        return range;
    }
    static bool is_in(const std::vector<Range>& ranges, long long number) {
        return std::any_of(ranges.begin(), ranges.end(), [&](const Range& range) {
            return range.first <= number && number <= range.second;
        });
    }

    Selected residues() {
        std::vector<Range> ranges;
        const std::vector<std::string_view> names = list("the name or number of a residue");
        for (const std::string_view word : names) // some names are numbers
            if (const std::optional<Range> range = range_in(word)) ranges.push_back(*range);
        note_unmatched(names, "residue", [&](std::string_view word) {
            const std::optional<Range> range = range_in(word);
            return std::any_of(structure_.of_residue.begin(), structure_.of_residue.end(),
                               [&](const Residue& residue) {
                                   return is_same(word, residue.name) ||
                                          (range && range->first <= residue.number &&
                                           residue.number <= range->second);
                               });
        });
        return where_residue([&](const Residue& residue) {
            return is_in(ranges, residue.number) ||
                   std::any_of(names.begin(), names.end(),
                               [&](std::string_view name) { return is_same(name, residue.name); });
        });
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
        return where([&](AtomIndex i) { return wanted[structure_.element(i)] != 0; });
    }

    Selected names() {
        const std::vector<std::string_view> wanted = list("the name of an atom");
        note_unmatched(wanted, "atom", [&](std::string_view word) {
            return std::any_of(structure_.names.begin(), structure_.names.end(),
                               [&](const std::string& name) { return is_same(word, name); });
        });
        if (structure_.names.empty()) return Selected(structure_.size());
        return where([&](AtomIndex i) {
            return std::any_of(wanted.begin(), wanted.end(), [&](std::string_view name) {
                return is_same(name, structure_.names[i]);
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
        return where([&](AtomIndex i) { return of_kind[structure_.kinds[i]] != 0; });
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
        return where([&](AtomIndex i) { return is_in(ranges, static_cast<long long>(i) + 1); });
    }

    Selected property(std::string_view name) {
        const auto found = std::find_if(
            structure_.properties.begin(), structure_.properties.end(),
            [&](const AtomProperty& property) { return is_same(property.name, name); });
        if (found == structure_.properties.end()) {
            std::vector<std::string_view> known(keywords.begin(), keywords.end());
            for (const AtomProperty& property : structure_.properties)
                known.push_back(property.name);
            std::string all;
            for (const std::string_view word : known)
                all.append(all.empty() ? "" : ", ").append(word);
            fail_at(name, "must be one of " + printable(all, 400) + ", got \"" + printable(name) +
                              "\"" + suggestion(name, known));
        }
        const std::string_view sign = taken("<, <=, >, >= or =");
        if (sign != "<" && sign != "<=" && sign != ">" && sign != ">=" && sign != "=")
            fail_at(sign, "must have <, <=, >, >= or = behind it, got \"" + printable(sign) + "\"");
        const double bound = number("a number");
        return where([&](AtomIndex i) {
            const auto value = static_cast<double>(found->values[i]);
            if (sign == "<") return value < bound;
            if (sign == "<=") return value <= bound;
            if (sign == ">") return value > bound;
            if (sign == ">=") return value >= bound;
            return value == static_cast<double>(static_cast<float>(bound));
        });
    }

    const Structure& structure_;
    std::string_view text_, word_;
    std::size_t position_ = 0;
    int depth_ = 0;
    std::vector<std::string>& unmatched_;
};

} // namespace

std::vector<char> select_atoms(const Structure& structure, std::string_view expression,
                               std::vector<std::string>& unmatched) {
    return Parser(structure, expression, unmatched).all();
}

} // namespace raylane::scenes
