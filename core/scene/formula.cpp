#include "core/scene/formula.hpp"

#include "core/numbers/primitives.hpp"
#include "core/scene/formula_values.hpp"
#include "core/shapes/checks.hpp"

#include <algorithm>
#include <charconv>
#include <numbers>

namespace raylane::core {

namespace {

using Operation = FormulaOperation;

struct Function {
    std::string_view name;
    Operation operation;
    int arguments;
};
constexpr Function functions[] = {
    {"min", Operation::min, 2},     {"max", Operation::max, 2},     {"abs", Operation::abs, 1},
    {"floor", Operation::floor, 1}, {"mod", Operation::mod, 2},     {"sqrt", Operation::sqrt, 1},
    {"sin", Operation::sin, 1},     {"cos", Operation::cos, 1},     {"exp", Operation::exp, 1},
    {"log", Operation::log, 1},     {"noise", Operation::noise, 3},
};
constexpr std::string_view variables[FormulaProgram::inputs] = {"x", "y", "z", "u", "v"};

/// A mistake in a text. `at`: bytes before it.
struct Wrong {
    std::size_t at;
    std::string message;
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

using Term = FormulaValues::Value;

/// Meaning of the names in a text.
struct Names {
    int channel;
    const Formula::ParameterOf& parameter_of;
    const FormulaTexts& point; ///< empty, or the texts that x, y and z stand for
    std::array<Term, 3> point_values;
};

/// Compiles the text of a channel, by recursive descent.
class Parser {
  public:
    Parser(std::string_view text, FormulaValues& values, const Names& names)
        : text_(text), values_(values), names_(names) {}

    /// Returns the value of the whole text. Throws Wrong.
    Term value() {
        if (text_.size() > Formula::max_length)
            throw Wrong{0, "expected at most " + std::to_string(Formula::max_length) +
                               " bytes, got " + std::to_string(text_.size())};
        skip_spaces();
        const Term value = conditional();
        if (at_ < text_.size()) expected("an operator or the end");
        resolved_.append(text_.substr(copied_));
        if (resolved_.size() > Formula::max_length)
            throw Wrong{0, "expected at most " + std::to_string(Formula::max_length) +
                               " bytes with all parameters and transforms"};
        return value;
    }

    /// Returns the text with numbers and formulas in place of names.
    const std::string& resolved() const { return resolved_; }

  private:
    static constexpr int max_depth = 100;
    static constexpr int depth_of_replaced = 4; ///< at most, of the texts that replace names

    /// Counts the parts around a part of the text: parentheses, signs, exponents and choices.
    class Nested {
      public:
        explicit Nested(Parser& parser) : parser_(parser) {
            parser_.require_depth(++parser_.depth_, max_depth, "nested parts");
        }
        ~Nested() { --parser_.depth_; }
        Nested(const Nested&) = delete;
        Nested& operator=(const Nested&) = delete;

      private:
        Parser& parser_;
    };

    void require_depth(int depth, int most, const char* what) const {
        if (depth > most) throw Wrong{at_, "expected at most " + std::to_string(most) + " " + what};
    }
    [[noreturn]] void expected(const std::string& what) const { expected(what, at_); }
    [[noreturn]] void expected(const std::string& what, std::size_t at) const {
        throw Wrong{at, "expected " + what + ", got " + quoted(at)};
    }
    /// Returns the word or the character at a place, in quotes.
    std::string quoted(std::size_t at) const {
        if (at >= text_.size()) return "the end";
        const auto byte = static_cast<unsigned char>(text_[at]);
        if (byte >= 0x7F) return "a character that is not ASCII";
        if (byte < ' ') return "a control character";
        constexpr std::size_t most = 30;
        std::size_t end = at + 1;
        while (end < text_.size() && end - at < most && continues_word(text_[at]) &&
               continues_word(text_[end]))
            ++end;
        return '"' + std::string(text_.substr(at, end - at)) + '"';
    }
    static bool continues_word(char c) { return is_letter(c) || is_digit(c); }

    void skip_spaces() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' ||
                                      text_[at_] == '\n' || text_[at_] == '\r'))
            ++at_;
    }
    bool take(std::string_view sign) {
        if (text_.substr(at_, sign.size()) != sign) return false;
        at_ += sign.size();
        skip_spaces();
        return true;
    }
    void require(std::string_view sign) {
        if (!take(sign)) expected('"' + std::string(sign) + '"');
    }
    std::string_view word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && continues_word(text_[at_]))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }

    /// Add a number, or the result of an operation, that ends here.
    Term constant(double number) {
        values_.place = {names_.channel, at_};
        return values_.constant(number);
    }
    Term result(Operation operation, Term a, Term b) { return result(operation, a, b, a); }
    Term result(Operation operation, Term a, Term b, Term c) {
        values_.place = {names_.channel, at_};
        return values_.result(operation, a, b, c);
    }

    Term conditional() {
        const Term condition = comparison();
        if (!take("?")) return condition;
        const Nested nested(*this);
        const Term one = conditional();
        require(":");
        const Term other = conditional();
        return result(Operation::choose, condition, one, other);
    }

    struct Comparison {
        Operation operation;
        bool is_swapped;
    };
    std::optional<Comparison> take_comparison() {
        if (take("<=")) return Comparison{Operation::not_more, false};
        if (take(">=")) return Comparison{Operation::not_more, true};
        if (take("==")) return Comparison{Operation::equal, false};
        if (take("!=")) return Comparison{Operation::unequal, false};
        if (take("<")) return Comparison{Operation::less, false};
        if (take(">")) return Comparison{Operation::less, true};
        return std::nullopt;
    }
    Term comparison() {
        const Term left = sum();
        const auto comparison = take_comparison();
        if (!comparison) return left;
        const Term right = sum();
        const std::size_t end = at_;
        if (take_comparison()) expected("no second comparison", end);
        return comparison->is_swapped ? result(comparison->operation, right, left)
                                      : result(comparison->operation, left, right);
    }

    Term sum() {
        Term value = product();
        for (;;) {
            if (take("+"))
                value = result(Operation::add, value, product());
            else if (take("-"))
                value = result(Operation::subtract, value, product());
            else
                return value;
        }
    }
    Term product() {
        Term value = with_sign();
        for (;;) {
            if (take("*"))
                value = result(Operation::multiply, value, with_sign());
            else if (take("/"))
                value = result(Operation::divide, value, with_sign());
            else
                return value;
        }
    }
    Term with_sign() {
        if (!take("-")) return power();
        const Nested nested(*this);
        return result(Operation::subtract, constant(0.0), with_sign());
    }
    Term power() {
        const Term base = operand();
        if (!take("^")) return base;
        const Nested nested(*this);
        const Term exponent = with_sign();
        const double n = values_.number_of(exponent).value_or(0.0);
        values_.place = {names_.channel, at_};
        constexpr double max_products = 16.0;
        if (n >= 1.0 && n <= max_products && n == static_cast<int>(n))
            return values_.power(base, static_cast<int>(n));
        return result(Operation::power, base, exponent);
    }

    Term operand() {
        if (at_ < text_.size()) {
            const char c = text_[at_];
            if (is_digit(c) || c == '.') return number();
            if (is_letter(c)) return named();
            if (c == '$') return parameter();
        }
        if (!take("(")) expected("a number, a name or \"(\"");
        const Nested nested(*this);
        const Term value = conditional();
        require(")");
        return value;
    }
    Term number() {
        double number = 0.0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
        if (error == std::errc::invalid_argument) expected("a number");
        if (error != std::errc()) throw Wrong{at_, "expected a number that a double can hold"};
        at_ += static_cast<std::size_t>(end - begin);
        skip_spaces();
        return constant(number);
    }
    Term named() {
        const std::size_t begin = at_;
        const std::string_view name = word();
        skip_spaces();
        for (int i = 0; i < FormulaProgram::inputs; ++i)
            if (name == variables[i]) return i < 3 ? coordinate(i, begin, name.size()) : i;
        if (name == "pi") return constant(std::numbers::pi);
        for (const Function& function : functions)
            if (name == function.name) return call(function);
        std::string known;
        for (const Function& function : functions)
            known.append(", ").append(function.name);
        expected("x, y, z, u, v, pi" + known, begin);
    }
    Term call(const Function& function) {
        require("(");
        const Nested nested(*this);
        std::array<Term, 3> arguments{};
        for (int i = 0; i < function.arguments; ++i) {
            if (i > 0) require(",");
            arguments[i] = conditional();
        }
        for (int i = function.arguments; i < 3; ++i)
            arguments[i] = arguments[0];
        require(")");
        return result(function.operation, arguments[0], arguments[1], arguments[2]);
    }
    Term coordinate(int axis, std::size_t begin, std::size_t length) {
        if (!names_.point[axis].empty())
            replace(begin, begin + length, "(" + names_.point[axis] + ")");
        return names_.point_values[axis];
    }
    Term parameter() {
        const std::size_t begin = at_++;
        const std::string_view name = word();
        if (name.empty() || is_digit(name[0]) || !names_.parameter_of)
            expected("a number, a name or \"(\"", begin);
        const double number = names_.parameter_of(names_.channel, name);
        const std::string text = checks::text_of(number);
        replace(begin, at_, number < 0.0 ? "(" + text + ")" : text);
        skip_spaces();
        return constant(number);
    }
    /// Replaces a part of the text in the resolved one.
    void replace(std::size_t begin, std::size_t end, const std::string& by) {
        require_depth(depth_, max_depth - depth_of_replaced, "nested parts around this name");
        resolved_.append(text_.substr(copied_, begin - copied_)).append(by);
        copied_ = end;
    }

    std::string_view text_;
    FormulaValues& values_;
    const Names& names_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::string resolved_; // the text up to copied_, in the end all of it
    std::size_t copied_ = 0;
};

/// Returns "line 1, column 5: ...".
std::string message_of(std::string_view text, const Wrong& wrong) {
    const std::string_view before = text.substr(0, wrong.at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1;
    return "line " + std::to_string(line) + ", column " +
           std::to_string(wrong.at - line_start + 1) + ": " + wrong.message;
}

} // namespace

Formula::Formula(const FormulaTexts& texts, const ParameterOf& parameter_of,
                 const FormulaTexts& point) {
    auto parts = std::make_shared<Parts>();
    parts->texts = texts;
    FormulaValues values;
    std::array<Term, 3> channels{};
    int channel = 0;
    try {
        Names names{0, parameter_of, point, {0, 1, 2}};
        const FormulaTexts themselves;
        for (int axis = 0; axis < 3; ++axis)
            if (!point[axis].empty())
                names.point_values[axis] =
                    Parser(point[axis], values, {0, {}, themselves, {0, 1, 2}}).value();
        for (; channel < 3; ++channel) {
            names.channel = channel;
            Parser parser(texts[channel], values, names);
            channels[channel] = parser.value();
            parts->texts[channel] = parser.resolved();
        }
        const FormulaValues::Size size = values.write(channels, parts->program);
        const auto require = [&](const FormulaValues::Count& count, int most, const char* what) {
            if (count.number <= most) return;
            channel = count.excess.channel;
            throw Wrong{count.excess.at, "expected at most " + std::to_string(most) + " " + what +
                                             " in all channels, got " +
                                             std::to_string(count.number)};
        };
        require(size.instructions, FormulaProgram::max_instructions, "different operations");
        require(size.constants, FormulaProgram::max_constants, "different numbers");
    } catch (const Wrong& wrong) {
        parts->mistake = {channel, message_of(texts[channel], wrong)};
    }
    parts_ = std::move(parts);
}

const FormulaTexts& Formula::texts() const {
    static const FormulaTexts none;
    return any() ? parts_->texts : none;
}

Vec3d color_of(const FormulaProgram& program, const Vec3d& point,
               const ShapeCoordinates& on_shape) {
    double values[FormulaProgram::max_values] = {point.x, point.y, point.z, on_shape.u, on_shape.v};
    FormulaOperations<double>::round_coordinates(values[0], values[1], values[2]);
    std::copy_n(program.constants, program.constant_count, values + FormulaProgram::inputs);
    double* next = values + FormulaProgram::inputs + program.constant_count;
    for (int i = 0; i < program.instruction_count; ++i) {
        const FormulaProgram::Instruction& instruction = program.instructions[i];
        *next++ = result_of(instruction.operation, values[instruction.a], values[instruction.b],
                            values[instruction.c]);
    }
    return {FormulaOperations<double>::channel(values[program.channels[0]]),
            FormulaOperations<double>::channel(values[program.channels[1]]),
            FormulaOperations<double>::channel(values[program.channels[2]])};
}

} // namespace raylane::core
