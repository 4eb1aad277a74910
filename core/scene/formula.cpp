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

/// Compiles the text of a channel, by recursive descent.
class Parser {
  public:
    using Value = FormulaValues::Value;

    Parser(const FormulaTexts& texts, int channel, FormulaValues& values,
           const Formula::ParameterOf& parameter_of)
        : text_(texts[channel]), channel_(channel), values_(values), parameter_of_(parameter_of) {}

    /// Returns the value of the whole text. Throws Wrong.
    Value value() {
        if (text_.size() > Formula::max_length)
            throw Wrong{0, "expected at most " + std::to_string(Formula::max_length) +
                               " bytes, got " + std::to_string(text_.size())};
        skip_spaces();
        const Value value = conditional();
        if (at_ < text_.size()) expected("an operator or the end");
        return value;
    }

    /// Returns the text with numbers in place of parameters.
    std::string with_numbers() const { return resolved_ + std::string(text_.substr(copied_)); }

  private:
    static constexpr int max_depth = 100;

    /// Counts what a part of the text is nested in.
    class Nested {
      public:
        explicit Nested(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > max_depth)
                throw Wrong{parser_.at_,
                            "expected at most " + std::to_string(max_depth) + " nested parts"};
        }
        ~Nested() { --parser_.depth_; }
        Nested(const Nested&) = delete;
        Nested& operator=(const Nested&) = delete;

      private:
        Parser& parser_;
    };

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

    Value conditional() {
        const Nested nested(*this);
        const Value condition = comparison();
        if (!take("?")) return condition;
        const Value one = conditional();
        require(":");
        const Value other = conditional();
        return values_.result(Operation::choose, condition, one, other);
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
    Value comparison() {
        const Value left = sum();
        const auto comparison = take_comparison();
        if (!comparison) return left;
        const Value right = sum();
        const std::size_t end = at_;
        if (take_comparison()) expected("no second comparison", end);
        return comparison->is_swapped ? values_.result(comparison->operation, right, left)
                                      : values_.result(comparison->operation, left, right);
    }

    Value sum() {
        Value value = product();
        for (;;) {
            if (take("+"))
                value = values_.result(Operation::add, value, product());
            else if (take("-"))
                value = values_.result(Operation::subtract, value, product());
            else
                return value;
        }
    }
    Value product() {
        Value value = with_sign();
        for (;;) {
            if (take("*"))
                value = values_.result(Operation::multiply, value, with_sign());
            else if (take("/"))
                value = values_.result(Operation::divide, value, with_sign());
            else
                return value;
        }
    }
    Value with_sign() {
        const Nested nested(*this);
        if (!take("-")) return power();
        return values_.result(Operation::subtract, values_.constant(0.0), with_sign());
    }
    Value power() {
        const Value base = operand();
        if (!take("^")) return base;
        const Value exponent = with_sign();
        const double n = values_.number_of(exponent).value_or(0.0);
        constexpr double most_products = 16.0;
        if (n >= 1.0 && n <= most_products && n == static_cast<int>(n))
            return values_.power(base, static_cast<int>(n));
        return values_.result(Operation::power, base, exponent);
    }

    Value operand() {
        if (at_ < text_.size()) {
            const char c = text_[at_];
            if (is_digit(c) || c == '.') return number();
            if (is_letter(c)) return named();
            if (c == '$') return parameter();
        }
        if (!take("(")) expected("a number, a name or \"(\"");
        const Value value = conditional();
        require(")");
        return value;
    }
    Value number() {
        double number = 0.0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
        if (error == std::errc::invalid_argument) expected("a number");
        if (error != std::errc()) throw Wrong{at_, "expected a number that a double can hold"};
        at_ += static_cast<std::size_t>(end - begin);
        skip_spaces();
        return values_.constant(number);
    }
    Value named() {
        const std::size_t begin = at_;
        const std::string_view name = word();
        skip_spaces();
        for (int i = 0; i < FormulaProgram::inputs; ++i)
            if (name == variables[i]) return i;
        if (name == "pi") return values_.constant(std::numbers::pi);
        for (const Function& function : functions)
            if (name == function.name) return call(function);
        std::string known;
        for (const Function& function : functions)
            known.append(", ").append(function.name);
        expected("x, y, z, u, v, pi" + known, begin);
    }
    Value call(const Function& function) {
        require("(");
        std::array<Value, 3> arguments{};
        for (int i = 0; i < function.arguments; ++i) {
            if (i > 0) require(",");
            arguments[i] = conditional();
        }
        for (int i = function.arguments; i < 3; ++i)
            arguments[i] = arguments[0];
        require(")");
        return values_.result(function.operation, arguments[0], arguments[1], arguments[2]);
    }
    Value parameter() {
        const std::size_t begin = at_++;
        const std::string_view name = word();
        if (name.empty() || is_digit(name[0]) || !parameter_of_)
            expected("a number, a name or \"(\"", begin);
        const double number = parameter_of_(channel_, name);
        const std::string text = checks::text_of(number);
        resolved_.append(text_.substr(copied_, begin - copied_))
            .append(number < 0.0 ? "(" + text + ")" : text);
        copied_ = at_;
        skip_spaces();
        return values_.constant(number);
    }

    std::string_view text_;
    int channel_;
    FormulaValues& values_;
    const Formula::ParameterOf& parameter_of_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::string resolved_; // the text up to copied_
    std::size_t copied_ = 0;
};

/// Returns "line 1, column 5: ...".
std::string message_of(std::string_view text, const Wrong& wrong) {
    const std::string_view before = text.substr(0, wrong.at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1; // 0 if there is none
    return "line " + std::to_string(line) + ", column " +
           std::to_string(wrong.at - line_start + 1) + ": " + wrong.message;
}

} // namespace

Formula::Formula(const FormulaTexts& texts, const ParameterOf& parameter_of) {
    auto parts = std::make_shared<Parts>();
    parts->texts = texts;
    FormulaValues values;
    std::array<FormulaValues::Value, 3> channels{};
    int channel = 0;
    try {
        for (; channel < 3; ++channel) {
            Parser parser(texts, channel, values, parameter_of);
            channels[channel] = parser.value();
            parts->texts[channel] = parser.with_numbers();
        }
        const FormulaValues::Size size = values.write(channels, parts->program);
        const auto require = [&](int count, int most, const char* what) {
            if (count <= most) return;
            channel = 2;
            throw Wrong{texts[channel].size(), "expected at most " + std::to_string(most) + " " +
                                                   what + " in all channels, got " +
                                                   std::to_string(count)};
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
