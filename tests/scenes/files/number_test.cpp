#include "scenes/files/number.hpp"
#include "tests/support/catch.hpp"

#include <charconv>
#include <cmath>
#include <random>

using raylane::scenes::as_printed;
using raylane::scenes::to_float;
using raylane::scenes::to_int;
using raylane::scenes::to_text;

TEST_CASE("a decimal number is the nearest float") {
    CHECK(to_float("0") == 0.0F);
    CHECK(to_float("1.") == 1.0F);
    CHECK(to_float(".5") == 0.5F);
    CHECK(to_float("+1.5") == 1.5F);
    CHECK(to_float("-1.5e+2") == -150.0F);
    CHECK(to_float("1E-3") == 0.001F);
    CHECK(to_float("0.10000000149011612") == 0.1F);
    CHECK(to_float("16777217") == 16777216.0F);
    CHECK(to_float("3.4028235e38") == 3.4028235e38F);
    CHECK(std::signbit(to_float("-0").value()));
    CHECK(std::signbit(to_float("-0.000").value()));

    std::mt19937 random(1);
    int wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        std::string text = random() % 2 == 0 ? "-" : "";
        for (auto digits = random() % 12; digits > 0; --digits)
            text += static_cast<char>('0' + random() % 10);
        if (random() % 4 != 0) text += '.';
        for (auto digits = random() % 12; digits > 0; --digits)
            text += static_cast<char>('0' + random() % 10);
        float expected = 0.0F;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, expected);
        const std::optional<float> value = to_float(text);
        const bool is_number = error == std::errc() && stop == end;
        if (value.has_value() != is_number || (is_number && *value != expected)) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a number too small for a float is 0 and one too large is refused") {
    for (const char* small : {"1e-50", "7e-46", "0.01e-44", "1000e-60", "1e-400",
                              "1e-99999999999999999999", "0.0000000000000000000000000000001e-20"})
        CHECK(to_float(small) == 0.0F);
    CHECK(std::signbit(to_float("-1e-50").value()));
    CHECK(to_float("1e-45").value() > 0.0F);
    CHECK(to_float("0e99999999999999999999") == 0.0F);
    for (const char* large : {"1e39", "3.5e38", "0.001e50", "1e400", "1e99999999999999999999",
                              "1e+99999999999999999999", "inf", "nan", "-infinity", "NaN"})
        CHECK_FALSE(to_float(large));
}

TEST_CASE("a text that is not wholly a number is refused") {
    for (const char* text : {"", "-", "+", ".", "-.", "1e", "1e+", "--1", "+-1", "1,5", "0x10",
                             "1.2.3", "12a", "a12", " 1", "1 ", "1e5.0", "1f"})
        CHECK_FALSE(to_float(text));
    CHECK(to_int("12") == 12);
    CHECK(to_int("+12") == 12);
    CHECK(to_int("-12") == -12);
    for (const char* text : {"", "-", "+", "1.0", "1e3", "12a", "2147483648", "+-1"})
        CHECK_FALSE(to_int(text));
}

TEST_CASE("a float's text is the shortest that reads as this float") {
    CHECK(to_text(0.1F) == "0.1");
    CHECK(to_text(-2.0F) == "-2");
    CHECK(to_text(1e30F) == "1e+30");
    CHECK(as_printed(0.1F) == 0.1);
    CHECK(as_printed(-0.001F) == -0.001);
    CHECK(as_printed(3.4028235e38F) == 3.4028235e38);
    CHECK(as_printed(0.0F) == 0.0);
}
