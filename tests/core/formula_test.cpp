#include "core/numbers/primitives.hpp"
#include "core/scene/formula.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <random>
#include <string>

using namespace raylane::core;

namespace {

/// Returns a formula whose red channel has this text.
Formula red(const std::string& text, const Formula::ParameterOf& parameter_of = {}) {
    return Formula({text, "0", "0"}, parameter_of);
}

/// Returns the first channel of a text at x = 2, y = 3, z = -5, u = 0.25, v = 0.75.
double at(const std::string& text, const Vec3d& point = {2, 3, -5}) {
    const Formula formula = red(text);
    INFO(text);
    if (formula.mistake()) FAIL(formula.mistake()->message);
    return color_of(formula.program(), point, {0.25, 0.75}).x;
}

std::string mistake(const std::string& text) {
    const Formula formula = red(text);
    return formula.mistake() ? formula.mistake()->message : "";
}

} // namespace

TEST_CASE("a formula has the precedence and the functions of mathematics") {
    CHECK(at("1 + 2 * 3") == 7.0);
    CHECK(at("(1 + 2) * 3") == 9.0);
    CHECK(at("9 - 4 - 3") == 2.0);
    CHECK(at("16 / 4 / 2") == 2.0);
    CHECK(at("2 ^ 3 ^ 2") == 512.0);
    CHECK(at("10 - 2 ^ 2") == 6.0);
    CHECK(at("5 + -2 ^ 2") == 1.0);
    CHECK(at("2 ^ -1") == 0.5);
    CHECK(at("2 * -3 + 7") == 1.0);
    CHECK(at("- -x") == 2.0);
    CHECK(at("x + 10 * y - z") == 37.0);
    CHECK(at("u + 10 * v") == 7.75);
    CHECK(at("x < y") == 1.0);
    CHECK(at("x > y") == 0.0);
    CHECK(at("x + 1 >= y") == 1.0);
    CHECK(at("x + 1 <= y") == 1.0);
    CHECK(at("x == 2") == 1.0);
    CHECK(at("x != 2") == 0.0);
    CHECK(at("x < y ? 4 : 5") == 4.0);
    CHECK(at("x > y ? 4 : y > 2 ? 6 : 5") == 6.0);
    CHECK(at("x < y ? z < 0 ? 7 : 8 : 9") == 7.0);
    CHECK(at("min(x, y) + 10 * max(x, y)") == 32.0);
    CHECK(at("abs(z) + floor(x + 0.75) + floor(5 - x / 8)") == 11.0);
    CHECK(at("mod(z, 3) + mod(y, x)") == 2.0);
    CHECK(at("sqrt(x * 8)") == 4.0);
    CHECK(at("sin(x)") == Approx(std::sin(2.0)).epsilon(1e-15));
    CHECK(at("abs(cos(y))") == Approx(-std::cos(3.0)).epsilon(1e-15));
    CHECK(at("exp(x)") == Approx(std::exp(2.0)).epsilon(1e-15));
    CHECK(at("log(y)") == Approx(std::log(3.0)).epsilon(1e-15));
    CHECK(at("pi") == 3.141592653589793);
    CHECK(at(" 1e1\t+\n.5 ") == 10.5);
}

TEST_CASE("whole powers are products, and negative numbers have only whole powers") {
    CHECK(at("z ^ 2") == 25.0);
    CHECK(at("-(z ^ 3)") == 125.0);
    CHECK(at("x ^ 15 + x ^ 16") == 98304.0);
    CHECK(at("-z ^ x") == 0.0); // -((-5)^2)
    CHECK(at("z ^ x") == Approx(25.0).epsilon(1e-15));
    CHECK(at("-(z ^ y)") == Approx(125.0).epsilon(1e-15));
    CHECK(at("x ^ 0.5") == Approx(std::sqrt(2.0)).epsilon(1e-15));
    CHECK(at("z ^ 0.5 == z ^ 0.5") == 0.0); // undefined
    CHECK(at("z ^ (x / 4) == 0") == 0.0);
    CHECK(at("0 ^ (x - 2)") == 1.0);
    CHECK(at("(x - 2) ^ 17") == 0.0);
    CHECK(at("(x - 2) ^ -1") == 1e10);
}

TEST_CASE("each channel is a number from 0 to 1e10, whatever the formula") {
    for (const char* undefined : {"sqrt(z)", "log(z)", "(x - 2) / (x - 2)", "sin(1 / (x - 2))",
                                  "cos(exp(1e3 * x))", "noise(1 / (x - 2), 0, 0)", "z ^ 0.1",
                                  "exp(sqrt(z))", "mod(x, 0)", "floor(sqrt(z))", "abs(sqrt(z))"})
        CHECK(at(undefined) == 0.0);
    for (const char* negative : {"z", "log(x - 2)", "-1 / (x - 2)", "-1e300 * 1e300 * x"})
        CHECK(at(negative) == 0.0);
    for (const char* huge : {"1 / (x - 2)", "exp(1e3 * x)", "1e11 * x", "1e300 * x * 1e300"})
        CHECK(at(huge) == 1e10);
    // Comparisons with an undefined number are false, except !=. It is a false condition.
    CHECK(at("sqrt(z) < 1 ? 2 : 3") == 3.0);
    CHECK(at("sqrt(z) > 1 ? 2 : 3") == 3.0);
    CHECK(at("sqrt(z) != sqrt(z) ? 2 : 3") == 2.0);
    CHECK(at("sqrt(z) ? 2 : 3") == 3.0);
    CHECK(at("1 + 0 * x ? 2 : 3") == 2.0);

    std::mt19937_64 engine(1);
    const auto number = [&] { return std::ldexp(static_cast<double>(engine()) - 0x1p63, -60); };
    const Formula formula({"noise(x, y, z) ^ log(x) / sqrt(y)", "exp(x * y) * sin(z) / mod(x, y)",
                           "min(x, 1 / y) - max(log(z), x ^ y)"});
    REQUIRE(!formula.mistake());
    for (int i = 0; i < 10000; ++i) {
        Vec3d point(number(), number(), number());
        if (i % 10 == 0) point[i / 10 % 3] = i % 20 == 0 ? HUGE_VAL : 0.0;
        const Vec3d color = color_of(formula.program(), point, {});
        for (int channel = 0; channel < 3; ++channel)
            if (!(color[channel] >= 0.0 && color[channel] <= 1e10)) FAIL(i);
    }
}

TEST_CASE("noise is smooth, 0 at whole points and between -1 and 1") {
    const auto noise = [](double x, double y, double z) {
        return FormulaOperations<double>::noise(x, y, z);
    };
    std::mt19937_64 engine(2);
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-47 - 32.0; };
    double least = 0.0, most = 0.0, sum = 0.0, steepest = 0.0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const double x = uniform(), y = uniform(), z = uniform(), value = noise(x, y, z);
        least = std::min(least, value);
        most = std::max(most, value);
        sum += value;
        steepest = std::max(steepest, std::abs(noise(x + 1e-3, y, z) - value) * 1e3);
    }
    CHECK(least > -1.0);
    CHECK(least < -0.5);
    CHECK(most < 1.0);
    CHECK(most > 0.5);
    CHECK(std::abs(sum) / count < 0.01);
    CHECK(steepest < 4.0);
    for (const double x : {-3.0, 0.0, 7.0, 1e9, 1e300})
        CHECK(noise(x, 2.0, -x) == 0.0);
    // Across a whole coordinate, from both sides.
    CHECK(std::abs(noise(5.0 - 1e-9, 0.3, 0.6) - noise(5.0, 0.3, 0.6)) < 1e-8);
    CHECK(noise(0.3, 0.4, 0.6) != noise(1.3, 0.4, 0.6));
}

TEST_CASE("a mistake names its line and column") {
    CHECK(mistake("") == "line 1, column 1: expected a number, a name or \"(\", got the end");
    CHECK(mistake("1 +") == "line 1, column 4: expected a number, a name or \"(\", got the end");
    CHECK(mistake("1 2") == "line 1, column 3: expected an operator or the end, got \"2\"");
    CHECK(mistake("2 x") == "line 1, column 3: expected an operator or the end, got \"x\"");
    CHECK(mistake("cos(x") == "line 1, column 6: expected \")\", got the end");
    CHECK(mistake("cos x") == "line 1, column 5: expected \"(\", got \"x\"");
    CHECK(mistake("min(x)") == "line 1, column 6: expected \",\", got \")\"");
    CHECK(mistake("cos(x, y)") == "line 1, column 6: expected \")\", got \",\"");
    CHECK(mistake("x ? 1") == "line 1, column 6: expected \":\", got the end");
    CHECK(mistake("0 < x < 1") == "line 1, column 7: expected no second comparison, got \"<\"");
    CHECK(mistake("x +\n  y *\n sine(x)") ==
          "line 3, column 2: expected x, y, z, u, v, pi, min, max, abs, floor, mod, sqrt, sin, "
          "cos, exp, log, noise, got \"sine\"");
    CHECK(mistake("1e999") == "line 1, column 1: expected a number that a double can hold");
    CHECK(mistake(".") == "line 1, column 1: expected a number, got \".\"");
    CHECK(mistake("$a") == "line 1, column 1: expected a number, a name or \"(\", got \"$\"");
    CHECK(mistake("x + \xC3\xA9")
              .find("column 5: expected a number, a name or \"(\", got a character that is not "
                    "ASCII") != std::string::npos);
    CHECK(mistake(std::string("x\0y", 3)) ==
          "line 1, column 2: expected an operator or the end, got a control character");
    CHECK(mistake(std::string(10001, ' ')).find("at most 10000 bytes, got 10001") !=
          std::string::npos);
    const auto nested = [](int depth) {
        return std::string(depth, '(') + "x" + std::string(depth, ')');
    };
    CHECK(mistake(nested(100)) == "");
    CHECK(mistake(nested(101)) == "line 1, column 102: expected at most 100 nested parts");
    CHECK(mistake(std::string(100, '-') + "1") == "");
    CHECK(mistake(std::string(5000, '-')) ==
          "line 1, column 102: expected at most 100 nested parts");
    for (const char* part : {"cos(", "x ^ ", "y ? 1 : ", "-(2 * "}) {
        CAPTURE(part);
        std::string text = "x";
        for (int i = 0; i < 101; ++i)
            text = part + text;
        CHECK(mistake(text).find("at most 100 nested parts") != std::string::npos);
    }
    const Formula blue({"x", "y", "cos("});
    REQUIRE(blue.mistake());
    CHECK(blue.mistake()->channel == 2);
}

TEST_CASE("a program has at most 64 different operations and numbers") {
    const auto sum_of = [](int terms, const char* form) {
        std::string text = "x";
        for (int i = 1; i < terms; ++i)
            text += " + " + std::string(form) + (i % 2 == 0 ? "x" : "y");
        return text;
    };
    CHECK(Formula({sum_of(65, ""), "x", "x"}).program().instruction_count == 64);
    // The place is that behind the 65th operation.
    const std::string too_many = "expected at most 64 different operations in all channels, got ";
    CHECK(mistake(sum_of(66, "")) == "line 1, column 262: " + too_many + "65");
    const Formula green({sum_of(60, ""), "x * y\n + " + sum_of(9, "2 * "), "x"});
    REQUIRE(green.mistake());
    CHECK(green.mistake()->channel == 1);
    CHECK(green.mistake()->message == "line 2, column 22: " + too_many + "71");
    // Equal operations count once, operations of numbers not at all.
    CHECK(Formula({sum_of(60, ""), sum_of(60, ""), "x + y + x"}).program().instruction_count == 59);
    CHECK(Formula({"sqrt(2 * pi) / 3 + x", "x", "x"}).program().instruction_count == 1);
    CHECK(Formula({"x + 1", "2 * (x + 1)", "7"}).program().instruction_count == 2);
    CHECK(Formula({"1 ? x : cos(y)", "0", "0"}).program().instruction_count == 0);
    CHECK(Formula({"x ^ 4", "x ^ 2", "0"}).program().instruction_count == 2);
    std::string numbers = "x";
    for (int i = 2; i < 67; ++i)
        numbers = "max(" + numbers + ", " + std::to_string(i) + ")";
    CHECK(mistake(numbers).find("at most") != std::string::npos);
    std::string sum = "x";
    for (int i = 2; i < 67; ++i)
        sum += " + " + std::to_string(i) + " * (x < " + std::to_string(i) + ")";
    CHECK(mistake(sum).find("different") != std::string::npos);
    CHECK(!Formula({"x", "y", "z"}).program().needs_shape);
    CHECK(Formula({"x", "y", "v"}).program().needs_shape);
}

TEST_CASE("parameters become numbers of the text") {
    const auto value = [](int channel, std::string_view name) {
        CHECK(channel == 0);
        return name == "low" ? -0.5 : 0.1;
    };
    const Formula formula = red("cos($low * x)\n + $high_2", value);
    REQUIRE(!formula.mistake());
    CHECK(formula.texts()[0] == "cos((-0.5) * x)\n + 0.1");
    CHECK(red(formula.texts()[0]) == formula);
    CHECK(color_of(formula.program(), {2, 0, 0}, {}).x ==
          Approx(std::cos(-1.0) + 0.1).epsilon(1e-15));
}

TEST_CASE("x, y and z may stand for formulas, which become parts of the text") {
    const Formula moved({"x ^ 2 + u", "y", "cos(z)"}, {}, {"x - 1", "", "2 * (z + 3)"});
    REQUIRE(!moved.mistake());
    CHECK(moved.texts() == FormulaTexts{"(x - 1) ^ 2 + u", "y", "cos((2 * (z + 3)))"});
    CHECK(color_of(moved.program(), {4, 5, -3}, {0.25, 0}) == Vec3d(9.25, 5, 1));
    CHECK(Formula(moved.texts()) == moved);
    // The text that is written can be read.
    const std::string nested = std::string(96, '(') + "x" + std::string(96, ')');
    CHECK(!Formula({nested, "0", "0"}).mistake());
    CHECK(!Formula(Formula({nested, "0", "0"}, {}, {"1 * (y + -2)", "", ""}).texts()).mistake());
    CHECK(!Formula({nested, "0", "0"}, {}, {"-1 * (x + -2)", "", ""}).mistake());
    CHECK(!Formula(Formula({nested, "0", "0"}, {}, {"-1 * (x + -2)", "", ""}).texts()).mistake());
    const std::string deep = std::string(97, '(') + "x" + std::string(97, ')');
    CHECK(Formula({deep, "0", "0"}, {}, {"x - 1", "", ""}).mistake()->message ==
          "line 1, column 99: expected at most 96 nested parts around this name");
    std::string wide = "x";
    while (wide.size() < 9000)
        wide += "+x";
    CHECK(Formula({wide, "0", "0"}, {}, {"x - 1", "", ""})
              .mistake()
              ->message.find("at most 10000 bytes") != std::string::npos);
}

TEST_CASE("a formula that is not set takes two pointers, and copies share one that is") {
    CHECK(sizeof(Formula) == 2 * sizeof(void*));
    CHECK(!Formula().any());
    CHECK(Formula() == Formula());
    CHECK(Formula().texts()[2].empty());
    const Formula formula = red("x"), copy = formula;
    CHECK(&copy.program() == &formula.program());
    CHECK(copy == red("x"));
    CHECK(!(copy == red("y")));
}

TEST_CASE("formulas ignore the last bits of a point") {
    for (const double off : {-0x1p-50, 0.0, 0x1p-50}) {
        CHECK(at("z == -4", {2.5, 0.25, -4.0 + 4.0 * off}) == 1.0);
        CHECK(at("floor(z) + 5", {2.5, 0.25, -4.0 + 4.0 * off}) == 1.0);
        CHECK(at("z == 0", {1e-5, -3e4, 3e4 * off}) == 1.0);
        CHECK(at("1e30 * x", {1e-30 + 1e-30 * off, 0.0, 0.0}) == Approx(1.0));
    }
    CHECK(at("x + y + z", {0.0, 0.0, 0.0}) == 0.0);
    CHECK(at("x == 1 + 1e-8", {1.0 + 1e-8, 0.0, 0.0}) == 0.0); // a multiple of 2^-28 is near
    CHECK(at("x > 1", {1.0 + 1e-8, 0.0, 0.0}) == 1.0);
}
