#pragma once

#include "core/numbers/formula_program.hpp"
#include "core/numbers/vector.hpp"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace raylane::core {

/// Texts of the channels red, green and blue.
using FormulaTexts = std::array<std::string, 3>;

/// A colour as a formula of the point x, y, z, and of its coordinates u and v on the shape. Copies
/// share the texts and the program. A formula that is not set takes the space of two pointers, and
/// no time.
///
/// The language, from loose to tight binding: a ? b : c; one of < <= > >= == != between two sides;
/// + -; * /; the sign -; ^ (from the right). Then numbers, pi, x, y, z, u, v, $name (a
/// parameter), parentheses, and the functions min, max, mod (two numbers), abs, floor, sqrt, sin,
/// cos (radians), exp, log (one), noise (three).
class Formula {
  public:
    /// Returns the value of $name in the text of a channel. May throw.
    using ParameterOf = std::function<double(int channel, std::string_view name)>;

    static constexpr std::size_t max_length = 10'000; ///< bytes of a text

    /// The first mistake of a text.
    struct Mistake {
        int channel;
        std::string message; ///< with line and column, both from 1; the column in bytes
    };

    Formula() = default;
    /// Compiles texts. A text with a mistake is kept, see mistake(). By default a parameter is a
    /// mistake. `point`: formulas that x, y and z stand for, without parameters; empty: themselves.
    explicit Formula(const FormulaTexts& texts, const ParameterOf& parameter_of = {},
                     const FormulaTexts& point = {});

    bool any() const { return parts_ != nullptr; }
    /// Returns the texts, with numbers in place of parameters, and with the formulas that x, y and
    /// z stand for; empty ones if the formula is unset.
    const FormulaTexts& texts() const;
    const std::optional<Mistake>& mistake() const { return parts_->mistake; }
    /// Returns the program of a formula without mistakes.
    const FormulaProgram& program() const { return parts_->program; }

    bool operator==(const Formula& other) const { return texts() == other.texts(); }

  private:
    struct Parts {
        FormulaTexts texts;
        FormulaProgram program;
        std::optional<Mistake> mistake;
    };
    std::shared_ptr<const Parts> parts_;
};

/// Coordinates of a point on the surface of a shape: see coordinates_on().
struct ShapeCoordinates {
    double u = 0.0, v = 0.0;
};

/// Returns the colour of a program at a point and its coordinates on the shape. Each channel is
/// from 0 to 1e10.
Vec3d color_of(const FormulaProgram& program, const Vec3d& point, const ShapeCoordinates& on_shape);

} // namespace raylane::core
